#include "polylidar/stream.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "certificate.hpp"
#include "coordinate_range.hpp"
#include "interior.hpp"
#include "options_check.hpp"
#include "shards.hpp"

namespace polylidar {
namespace {

using detail::Bitmap;
using detail::Grid;
using detail::kFewPoints;

std::runtime_error has_changed() {
  return std::runtime_error("the source has other points than when it was read before");
}

/// Rows from `begin` on, before `end`.
struct Rows {
  Grid::Cell begin = 0;
  Grid::Cell end = 0;

  bool empty() const { return begin == end; }
  bool has(Grid::Cell row) const { return row >= begin && row < end; }
  bool meets(const Rows& other) const { return begin < other.end && other.begin < end; }
  /// With so many more on either side, as far as there are any.
  Rows with_halo(Grid::Cell halo, Grid::Cell rows) const {
    return {begin - std::min(begin, halo), std::min(end + halo, rows)};
  }
};

// What a shard must know beyond its band. A point of the band is in the part where an uncertain one lies at
// most kReachedRows away, so these are looked for there. Whether one is uncertain is decided by the cells
// at most kReach rows away from its own, so cells are marked as occupied there, too: 24 rows, which are 4
// radii. On less, points of the part would be missing, and points be taken for uncertain that are not.
constexpr Grid::Cell kHaloOfUncertain = detail::kReachedRows;
constexpr Grid::Cell kHaloOfOccupied = kHaloOfUncertain + detail::kReach;
// What is marked beyond them falls into the margin.
static_assert(kHaloOfUncertain + detail::kReachedRows <= kHaloOfOccupied + Grid::kMargin);

Rows band(const Shard& shard, Grid::Cell rows) {
  const auto begin = [&](std::uint64_t number) {
    return static_cast<Grid::Cell>(std::uint64_t{rows} * number / shard.count);
  };
  return {begin(shard.number - 1), begin(shard.number)};
}

/// How many rows the map of a shard can have.
Grid::Cell most_rows(const Shard& shard, Grid::Cell rows) {
  return std::min(rows, (rows + shard.count - 1) / shard.count + 2 * kHaloOfOccupied);
}

/// The same whatever blocks the points come in.
std::uint64_t checksum(std::span<const Point> block, std::uint64_t first, detail::ThreadPool& pool) {
  const detail::Chunks chunks(pool, block.size());
  std::vector<std::uint64_t> sums(chunks.size());
  pool.for_each(chunks.size(), [&](std::size_t c) {
    std::uint64_t sum = 0;
    for (std::size_t i = chunks.begin(c); i < chunks.end(c); ++i) {
      // Odd numbers with many bits, and shifts between the products, as in splitmix64.
      std::uint64_t mixed = std::bit_cast<std::uint64_t>(block[i].x) + (first + i) * 0x9E3779B97F4A7C15U;
      mixed = (mixed ^ mixed >> 30U) * 0xBF58476D1CE4E5B9U;
      mixed += std::bit_cast<std::uint64_t>(block[i].y);
      mixed = (mixed ^ mixed >> 27U) * 0x94D049BB133111EBU;
      sum += mixed ^ mixed >> 31U;
    }
    sums[c] = sum;
  });
  return std::accumulate(sums.begin(), sums.end(), std::uint64_t{0});
}

/// The passes over the sources.
class Stream {
 public:
  Stream(std::span<const PointSource> sources, const Options& options, const Shard& shard,
         const StreamOptions& stream_options)
      : sources_(sources), stream_options_(stream_options), limits_(detail::checked_limits(options)) {
    if (shard.number < 1 || shard.number > shard.count) {
      throw std::invalid_argument("there is no " + detail::name_of(shard));
    }
    pool_.use(options.threads);
    part_.shard = shard;
    part_.options = options;
  }

  StreamShard find_part();

 private:
  /// What the first pass finds of a source.
  struct Extent {
    std::uint64_t points = 0;
    Box box;
  };

  void begin_pass();
  template <class Visit>
  void read(const PointSource& source, const Visit& visit);
  template <class Visit>
  void pass_over_cells(const Rows& rows, const Visit& visit);
  detail::RangeOfBlocks find_extents();
  void choose_grid();
  void find_uncertain_cells();
  void find_uncertain_points();
  void gather();
  void take_all();

  std::span<const PointSource> sources_;
  const StreamOptions& stream_options_;
  Limits limits_;
  detail::ThreadPool pool_;
  StreamProgress progress_;
  std::vector<Extent> extents_;  ///< one a source
  Rows own_;                     ///< the shard's band
  Rows tested_;                  ///< in which uncertain points are looked for
  Rows seen_;                    ///< in which cells are marked as occupied
  Grid grid_;                    ///< the rows seen_ of the grid over the box
  std::optional<Bitmap> occupied_;
  std::optional<Bitmap> marked_;          ///< uncertain cells, then those within reach of uncertain points
  std::vector<std::uint64_t> uncertain_;  ///< of the shard's own band, ascending
  StreamShard part_;
};

void Stream::begin_pass() {
  ++progress_.pass;
  progress_.points = 0;
}

/// visit(block, number of its first point) for each block.
template <class Visit>
void Stream::read(const PointSource& source, const Visit& visit) {
  source([&](std::span<const Point> block) {
    visit(block, progress_.points);
    progress_.points += block.size();
    if (stream_options_.progress) stream_options_.progress(progress_);
  });
}

/// The first pass.
detail::RangeOfBlocks Stream::find_extents() {
  begin_pass();
  detail::RangeOfBlocks range;
  for (const PointSource& source : sources_) {
    Extent& extent = extents_.emplace_back(Extent{0, bounding_box({})});
    read(source, [&](std::span<const Point> block, std::uint64_t first) {
      const Box box = range.add(block, pool_);
      extent.points += block.size();
      extent.box = {{std::min(extent.box.min.x, box.min.x), std::min(extent.box.min.y, box.min.y)},
                    {std::max(extent.box.max.x, box.max.x), std::max(extent.box.max.y, box.max.y)}};
      part_.source_checksum += checksum(block, first, pool_);
    });
  }
  part_.source_points = range.count();
  part_.box = range.box();
  return range;
}

/// A later pass: visit(point, cell, number, chunk) on all threads for the points in these rows, which are
/// among seen_; chunks are those of the block, in its order. Sources without such points are not read.
template <class Visit>
void Stream::pass_over_cells(const Rows& rows, const Visit& visit) {
  begin_pass();
  const auto look_at = [&](std::span<const Point> block, std::uint64_t first, const Box& box) {
    std::atomic<bool> is_same = true;
    const detail::Chunks chunks(pool_, block.size());
    visit.begin(chunks.size());
    pool_.for_each(chunks.size(), [&](std::size_t c) {
      for (std::size_t i = chunks.begin(c); i < chunks.end(c); ++i) {
        const Point& p = block[i];
        if (!(p.x >= box.min.x && p.x <= box.max.x && p.y >= box.min.y && p.y <= box.max.y)) {
          is_same = false;
          return;
        }
        if (rows.has(grid_.row_number(p))) visit.point(p, grid_.cell(p), first + i, c);
      }
    });
    if (!is_same) throw has_changed();
    visit.end();
  };
  for (std::size_t s = 0; s < sources_.size(); ++s) {
    const Box& box = extents_[s].box;
    const std::uint64_t end = progress_.points + extents_[s].points;
    if (extents_[s].points > 0 && rows.meets({grid_.row_number(box.min), grid_.row_number(box.max) + 1})) {
      read(sources_[s],
           [&](std::span<const Point> block, std::uint64_t first) { look_at(block, first, box); });
      if (progress_.points != end) throw has_changed();
    }
    progress_.points = end;
  }
}

/// What is done with the points of a block, and before and after it.
template <class Begin, class OfPoint, class End>
struct Visit {
  Begin begin;
  OfPoint point;
  End end;
};
template <class Begin, class OfPoint, class End>
Visit(Begin, OfPoint, End) -> Visit<Begin, OfPoint, End>;

/// The same for all shards, and where the shard has its band in it.
void Stream::choose_grid() {
  const Box& box = part_.box;
  const double widest = detail::least_dropped_radius(limits_) * (1 - detail::kSafety);
  const double area = (box.max.x - box.min.x) * (box.max.y - box.min.y);
  double radius = std::min(
      widest, detail::kWidestInSpacings * std::sqrt(area / static_cast<double>(part_.source_points)));
  constexpr double kWider = 1.1;
  const auto fits = [&] {
    if (!std::isfinite(Grid::cell_count(box, detail::kRadius / radius, HUGE_VAL))) return false;
    const Grid grid(box, detail::kRadius / radius);
    const std::size_t words = grid.band(0, most_rows(part_.shard, grid.rows())).word_count();
    return sizeof(Bitmap::Word) * static_cast<double>(words) <= stream_options_.most_map_bytes;
  };
  while (!fits() && radius < widest) radius = std::min(radius * kWider, widest);
  if (!fits()) {
    throw std::invalid_argument(
        "the limit is too small for the distances between the points: give a larger one, or more memory");
  }
  const Grid grid(box, detail::kRadius / radius);
  part_.cells_per_length = grid.cells_per_length();
  own_ = band(part_.shard, grid.rows());
  tested_ = own_.with_halo(kHaloOfUncertain, grid.rows());
  seen_ = own_.with_halo(kHaloOfOccupied, grid.rows());
  grid_ = grid.band(seen_.begin, seen_.end);
}

void Stream::find_uncertain_cells() {
  occupied_.emplace().clear(grid_.word_count());
  const auto mark = [&](const Point&, Grid::Cell cell, std::uint64_t, std::size_t) {
    occupied_->set_shared(cell);
  };
  pass_over_cells(seen_, Visit{[](std::size_t) {}, mark, [] {}});
  marked_.emplace().clear(grid_.word_count());
  constexpr Grid::Cell kRowsATime = 64;
  const Rows tested{tested_.begin - seen_.begin, tested_.end - seen_.begin};
  pool_.for_each((tested.end - tested.begin + kRowsATime - 1) / kRowsATime, [&](std::size_t i) {
    const Grid::Cell begin = tested.begin + i * kRowsATime;
    detail::find_uncertain_cells(grid_, *occupied_, begin, std::min(tested.end, begin + kRowsATime),
                                 *marked_);
  });
}

void Stream::find_uncertain_points() {
  const detail::PointCertificate& certificate = detail::PointCertificate::instance();
  struct Uncertain {
    std::uint64_t number;
    Grid::Cell cell;
    bool is_own;
  };
  std::vector<std::vector<Uncertain>> found;
  std::vector<Grid::Cell> cells;
  const auto begin = [&](std::size_t chunks) {
    found.resize(std::max(found.size(), chunks));
    for (auto& of_chunk : found) of_chunk.clear();
  };
  const auto look = [&](const Point& p, Grid::Cell cell, std::uint64_t number, std::size_t chunk) {
    if (!marked_->test(cell) || certificate.is_certified(p, cell, grid_, *occupied_)) return;
    found[chunk].push_back({number, cell, own_.has(grid_.row_number(p))});
  };
  const auto end = [&] {
    for (const auto& of_chunk : found) {
      for (const auto& [number, cell, is_own] : of_chunk) {
        if (is_own) {
          if (uncertain_.size() == kMaxPoints) throw detail::too_much_outline();
          uncertain_.push_back(number);
        }
        if (cells.empty() || cells.back() != cell) cells.push_back(cell);
      }
    }
  };
  pass_over_cells(tested_, Visit{begin, look, end});
  marked_->clear(grid_.word_count());
  for (const Grid::Cell cell : cells) detail::mark_reach(grid_, cell, *marked_);
}

void Stream::gather() {
  std::vector<std::vector<std::pair<std::uint64_t, Point>>> found;
  auto next = uncertain_.begin();
  const auto begin = [&](std::size_t chunks) {
    found.resize(std::max(found.size(), chunks));
    for (auto& of_chunk : found) of_chunk.clear();
  };
  const auto look = [&](const Point& p, Grid::Cell cell, std::uint64_t number, std::size_t chunk) {
    if (marked_->test(cell)) found[chunk].emplace_back(number, p);
  };
  const auto end = [&] {
    for (const auto& of_chunk : found) {
      for (const auto& [number, point] : of_chunk) {
        const bool is_uncertain = next != uncertain_.end() && *next == number;
        if (is_uncertain) ++next;
        part_.points.push_back(point);
        part_.numbers.push_back(number);
        part_.uncertain.push_back(is_uncertain ? 1 : 0);
      }
    }
    if (part_.points.size() > kMaxPoints) throw detail::too_much_outline();
  };
  pass_over_cells(own_, Visit{begin, look, end});
  if (next != uncertain_.end()) throw has_changed();
}

/// Of so few points that the part is the whole of them: the first shard has it.
void Stream::take_all() {
  if (part_.shard.number > 1) return;
  progress_.passes = 2;
  begin_pass();
  std::vector<Point>& points = part_.points;
  for (const PointSource& source : sources_) {
    read(source, [&](std::span<const Point> block, std::uint64_t) {
      if (points.size() + block.size() > part_.source_points) throw has_changed();
      points.insert(points.end(), block.begin(), block.end());
    });
  }
  if (points.size() != part_.source_points) throw has_changed();
  part_.numbers.resize(points.size());
  std::iota(part_.numbers.begin(), part_.numbers.end(), std::uint64_t{0});
  part_.uncertain.assign(points.size(), 1);
}

StreamShard Stream::find_part() {
  const detail::RangeOfBlocks range = find_extents();
  if (part_.source_points <= kFewPoints) {
    take_all();
    return std::move(part_);
  }
  if (!detail::is_any_limit_given(part_.options)) {
    throw std::invalid_argument(
        "a stream of more than 65536 points needs a limit: give alpha, max_edge_length or "
        "max_perimeter");
  }
  if (range.range().scale_exponent != 0) {
    throw std::invalid_argument("coordinates as large or as small as these cannot be streamed: scale them");
  }
  if (detail::is_flat(part_.box)) return std::move(part_);
  choose_grid();
  if (own_.empty()) return std::move(part_);  // more shards than rows
  find_uncertain_cells();
  find_uncertain_points();
  occupied_.reset();
  gather();
  return std::move(part_);
}

}  // namespace

StreamShard part_of_stream(std::span<const PointSource> sources, const Options& options, const Shard& shard,
                           const StreamOptions& stream_options) {
  return Stream(sources, options, shard, stream_options).find_part();
}

StreamedHull concave_hull_of_stream(const PointSource& source, const Options& options,
                                    const StreamOptions& stream_options) {
  const StreamShard all = part_of_stream({&source, 1}, options, Shard(), stream_options);
  return concave_hull_of_shards({&all, 1}, options.threads);
}

}  // namespace polylidar
