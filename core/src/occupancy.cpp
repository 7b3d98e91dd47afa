#include "occupancy.hpp"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <utility>

#include "polylidar/delaunay.hpp"
#include "selected.hpp"

namespace polylidar::detail {

namespace {

/// Whether two different points lie within `distance` of each other in x and in y.
bool are_close(const Point& p, const Point& q, double distance) {
  return std::abs(p.x - q.x) <= distance && std::abs(p.y - q.y) <= distance && p != q;
}

/// The place within a cell, roughly: of close points in one cell both differ by at most 1.
std::uint16_t rough(double u) {
  constexpr double kSteps = 0x1p16;  // to a cell
  return static_cast<std::uint16_t>(static_cast<std::int64_t>(u * kSteps));
}

}  // namespace

void Bitmap::clear(std::size_t words) {
  words_ = storage_.reserve(words);
  std::fill_n(words_, words, Word{0});
}

void Bitmap::clear(std::size_t words, ThreadPool& pool) {
  words_ = storage_.reserve(words);
  const Chunks chunks(pool, words);
  pool.for_each(chunks.size(),
                [&](std::size_t c) { std::fill(words_ + chunks.begin(c), words_ + chunks.end(c), Word{0}); });
}

void FewCells::fill(const Grid& grid, Grid::Cell begin, Grid::Cell rows_end, const Find& find,
                    ThreadPool& pool) {
  constexpr Grid::Cell kRowsATime = 128;  // those round them are looked at twice
  constexpr std::size_t kSharesAThread = 4;
  const std::size_t groups = grid.word_count() / Grid::kWordBits + 1;
  has_any_.clear(groups);
  const std::size_t shares = pool.threads() == 1 ? 1 : kSharesAThread * pool.threads();
  std::vector<std::vector<Bitmap::Word>> words_of(shares);
  pool.for_each(shares, [&](std::size_t s) {
    Bitmap found;
    const Grid::Cell end = begin + (rows_end - begin) * (s + 1) / shares;
    for (Grid::Cell row = begin + (rows_end - begin) * s / shares; row < end; row += kRowsATime) {
      const Grid rows = grid.band(row, std::min(end, row + kRowsATime));
      found.clear(rows.word_count());
      find(row, row + rows.rows(), found);
      const std::size_t first = rows.first_word(0);
      const std::size_t in_grid = grid.first_word(row);
      for (std::size_t w = 0; w < rows.rows() * rows.row_words(); ++w) {
        if (found.words()[first + w] == 0) continue;
        has_any_.set_shared(in_grid + w);
        words_of[s].push_back(found.words()[first + w]);
      }
    }
  });
  before_group_.resize(groups);
  std::uint32_t before = 0;
  for (std::size_t g = 0; g < groups; ++g) {
    before_group_[g] = before;
    before += static_cast<std::uint32_t>(std::popcount(has_any_.words()[g]));
  }
  words_.clear();
  words_.reserve(before);
  for (std::vector<Bitmap::Word>& words : words_of) {
    words_.insert(words_.end(), words.begin(), words.end());
    words = std::vector<Bitmap::Word>();  // gives its memory back, as {} would not
  }
  count_ = 0;
  for (const Bitmap::Word word : words_) count_ += static_cast<std::size_t>(std::popcount(word));
}

/// Of points [begin, end).
void ClosePairs::look_at(std::span<const Point> points, std::size_t begin, std::size_t end, const Grid& grid,
                         const std::uint32_t* cells, const Bitmap& shared, Chunk& chunk) const {
  chunk.in_shared.resize(bands_.size());
  for (std::vector<Link>& of_band : chunk.in_shared) of_band.clear();
  chunk.on_borders.clear();
  const std::size_t words_in_band = words_of_band(grid, 1).begin;
  constexpr std::size_t kBlock = 512;
  for (; begin < end; begin += kBlock) {
    const std::size_t stop = std::min(begin + kBlock, end);
    if (any_near_border(points.subspan(begin, stop - begin), grid.numbering())) {
      for (std::size_t i = begin; i < stop; ++i) {
        if (is_near_border(grid.column(points[i])) || is_near_border(grid.row(points[i]))) {
          chunk.on_borders.push_back(static_cast<std::uint32_t>(i));
        }
      }
    }
    for_each_selected(
        begin, stop, [&](std::size_t i) { return shared.test(cells[i]); },
        [&](std::uint32_t i) {
          chunk.in_shared[cells[i] / Grid::kWordBits / words_in_band].push_back(
              {i, kNone, rough(grid.column(points[i])), rough(grid.row(points[i]))});
        });
  }
}

ClosePairs::Words ClosePairs::words_of_band(const Grid& grid, std::size_t band) const {
  const std::size_t words = (grid.word_count() + bands_.size() - 1) / bands_.size();
  return {std::min(words * band, grid.word_count()), std::min(words * (band + 1), grid.word_count())};
}

/// Whether two different points may lie within `distance` of each other in a shared cell of a band.
bool ClosePairs::are_in_band(std::size_t number, std::span<const Point> points, const Grid& grid,
                             const std::uint32_t* cells, const Bitmap& shared, double distance,
                             std::span<const Chunk> looked_at) {
  constexpr std::size_t kMostInACell = 32;
  Band& band = bands_[number];
  const Words words = words_of_band(grid, number);
  std::uint32_t cell_count = 0;
  for (std::size_t w = words.begin; w < words.end; ++w) {
    rank_[w] = cell_count;
    cell_count += static_cast<std::uint32_t>(std::popcount(shared.words()[w]));
  }
  band.last.assign(cell_count, kNone);
  band.links.clear();
  for (const Chunk& chunk : looked_at) {
    for (Link own : chunk.in_shared[number]) {
      const Grid::Cell word = cells[own.point] / Grid::kWordBits;
      const Bitmap::Word below = (Bitmap::Word{1} << (cells[own.point] % Grid::kWordBits)) - 1;
      std::uint32_t& last =
          band.last[rank_[word] + static_cast<std::uint32_t>(std::popcount(shared.words()[word] & below))];
      std::size_t in_cell = 0;
      bool is_new = true;
      for (std::uint32_t l = last; l != kNone && is_new; l = band.links[l].before) {
        const Link& link = band.links[l];
        if (++in_cell == kMostInACell) return true;
        if (std::abs(link.x - own.x) > 1 || std::abs(link.y - own.y) > 1) continue;
        if (are_close(points[own.point], points[link.point], distance)) return true;
        is_new = points[own.point] != points[link.point];
      }
      if (!is_new) continue;
      own.before = std::exchange(last, static_cast<std::uint32_t>(band.links.size()));
      band.links.push_back(own);
    }
  }
  return false;
}

bool ClosePairs::may_exist(std::span<const Point> points, const Grid& grid, const std::uint32_t* cells,
                           const Bitmap& shared, double distance, ThreadPool& pool) {
  constexpr std::size_t kMostOnBorders = 8;
  bands_.resize(pool.threads());
  const Chunks chunks(pool, points.size());
  chunks_.resize(std::max(chunks_.size(), chunks.size()));
  pool.for_each(chunks.size(), [&](std::size_t c) {
    look_at(points, chunks.begin(c), chunks.end(c), grid, cells, shared, chunks_[c]);
  });
  const std::span<const Chunk> looked_at(chunks_.data(), chunks.size());
  std::size_t on_borders = 0;
  for (const Chunk& chunk : looked_at) on_borders += chunk.on_borders.size();
  if (on_borders > kMostOnBorders) return true;

  rank_.resize(grid.word_count());
  std::atomic<bool> may_exist = false;
  pool.for_each(bands_.size(), [&](std::size_t b) {
    if (are_in_band(b, points, grid, cells, shared, distance, looked_at)) may_exist = true;
  });
  if (may_exist) return true;
  return std::any_of(looked_at.begin(), looked_at.end(), [&](const Chunk& chunk) {
    return std::any_of(chunk.on_borders.begin(), chunk.on_borders.end(), [&](std::uint32_t p) {
      return std::any_of(points.begin(), points.end(),
                         [&](const Point& other) { return are_close(points[p], other, distance); });
    });
  });
}

}  // namespace polylidar::detail
