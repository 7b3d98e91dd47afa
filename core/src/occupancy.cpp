#include "occupancy.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>

#include "polylidar/delaunay.hpp"

namespace polylidar::detail {

namespace {

/// Whether two different points lie within `distance` of each other in x and in y.
bool are_close(const Point& p, const Point& q, double distance) {
  return std::abs(p.x - q.x) <= distance && std::abs(p.y - q.y) <= distance && p != q;
}

/// A coordinate in cells with so many bits behind the point.
constexpr unsigned kFineBits = 28;
constexpr std::int64_t kCell = std::int64_t{1} << kFineBits;
static_assert(1.0 / static_cast<double>(kCell) > Grid::kSlack);

std::int64_t fine(double u) {
  return static_cast<std::int64_t>(u * static_cast<double>(kCell));
}

/// Whether a coordinate is within kSlack of the border between two columns or rows; 0 is the box's side.
bool is_on_border(std::int64_t fine) {
  return fine > kCell / 2 && ((fine + 1) & (kCell - 1)) < 2;
}

/// The place within a cell, roughly: of close points in one cell both differ by at most 1.
std::uint16_t rough(std::int64_t fine) {
  return static_cast<std::uint16_t>(fine >> (kFineBits - 16U));
}

}  // namespace

void Bitmap::clear(std::size_t words) {
  words_ = storage_.reserve(words);
  std::fill_n(words_, words, Word{0});
}

bool ClosePairs::may_exist(std::span<const Point> points, const Grid& grid, const std::uint32_t* cells,
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
    const std::int64_t x = fine(grid.column(points[p]));
    const std::int64_t y = fine(grid.row(points[p]));
    if (is_on_border(x) || is_on_border(y)) on_borders_.push_back(p);
    const Grid::Cell cell = cells[p];
    const Grid::Cell word = cell / Grid::kWordBits;
    const Bitmap::Word bit = Bitmap::Word{1} << (cell % Grid::kWordBits);
    if ((shared.words()[word] & bit) == 0) continue;
    std::uint32_t& last =
        last_[rank_[word] + static_cast<std::uint32_t>(std::popcount(shared.words()[word] & (bit - 1)))];
    std::size_t in_cell = 0;
    bool is_new = true;
    const Link own{p, last, rough(x), rough(y)};
    for (std::uint32_t l = last; l != kNone && is_new; l = links_[l].before) {
      const Link& link = links_[l];
      if (++in_cell == kMostInACell) return true;
      if (std::abs(link.x - own.x) > 1 || std::abs(link.y - own.y) > 1) continue;
      if (are_close(points[p], points[link.point], distance)) return true;
      is_new = points[p] != points[link.point];
    }
    if (!is_new) continue;
    links_.push_back(own);
    last = static_cast<std::uint32_t>(links_.size() - 1);
  }
  if (on_borders_.size() > kMostOnBorders) return true;
  return std::any_of(on_borders_.begin(), on_borders_.end(), [&](std::uint32_t p) {
    return std::any_of(points.begin(), points.end(),
                       [&](const Point& other) { return are_close(points[p], other, distance); });
  });
}

}  // namespace polylidar::detail
