#include "occupancy.hpp"

#include <algorithm>
#include <bit>

#include "polylidar/delaunay.hpp"

namespace polylidar::detail {

namespace {

/// Whether two different points lie within `distance` of each other in x and in y.
bool are_close(const Point& p, const Point& q, double distance) {
  return std::abs(p.x - q.x) <= distance && std::abs(p.y - q.y) <= distance && p != q;
}

/// Whether a coordinate in cells is within kSlack of the border between two columns or rows; 0 is the box's
/// side.
bool is_on_border(double u) {
  constexpr std::int64_t kOne = std::int64_t{1} << 28U;
  static_assert(1.0 / static_cast<double>(kOne) > Grid::kSlack);
  const auto fixed = static_cast<std::int64_t>(u * static_cast<double>(kOne));
  return fixed > kOne / 2 && ((fixed + 1) & (kOne - 1)) < 2;
}

}  // namespace

void Bitmap::clear(std::size_t words) {
  words_ = storage_.reserve(words);
  std::fill_n(words_, words, Word{0});
}

bool ClosePairs::may_exist(std::span<const Point> points, const Grid& grid, const Grid::Cell* cells,
                           const Bitmap& shared, double distance) {
  constexpr std::size_t kMostInACell = 32;
  constexpr std::size_t kMostOnBorders = 8;
  rank_.resize(grid.word_count());
  std::uint32_t cell_count = 0;
  for (std::size_t w = 0; w < rank_.size(); ++w) {
    rank_[w] = cell_count;
    cell_count += static_cast<std::uint32_t>(std::popcount(shared.words()[w]));
  }
  last_.assign(cell_count, kNone);
  links_.clear();
  on_borders_.clear();

  const auto count = static_cast<std::uint32_t>(points.size());
  for (std::uint32_t p = 0; p < count; ++p) {
    if (is_on_border(grid.column(points[p])) || is_on_border(grid.row(points[p]))) on_borders_.push_back(p);
    const Grid::Cell cell = cells[p];
    const Grid::Cell word = cell / Grid::kWordBits;
    const Bitmap::Word bit = Bitmap::Word{1} << (cell % Grid::kWordBits);
    if ((shared.words()[word] & bit) == 0) continue;
    std::uint32_t& last =
        last_[rank_[word] + static_cast<std::uint32_t>(std::popcount(shared.words()[word] & (bit - 1)))];
    std::size_t in_cell = 0;
    bool is_new = true;
    for (std::uint32_t link = last; link != kNone && is_new; link = links_[link].before) {
      const Point& other = points[links_[link].point];
      if (are_close(points[p], other, distance) || ++in_cell == kMostInACell) return true;
      is_new = points[p] != other;
    }
    if (!is_new) continue;
    links_.push_back({p, last});
    last = static_cast<std::uint32_t>(links_.size() - 1);
  }
  if (on_borders_.size() > kMostOnBorders) return true;
  return std::any_of(on_borders_.begin(), on_borders_.end(), [&](std::uint32_t p) {
    return std::any_of(points.begin(), points.end(),
                       [&](const Point& other) { return are_close(points[p], other, distance); });
  });
}

}  // namespace polylidar::detail
