#include "polylidar/stream.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <queue>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "certificate.hpp"
#include "coordinate_range.hpp"
#include "interior.hpp"
#include "options_check.hpp"

namespace polylidar {
namespace {

using detail::Bitmap;
using detail::Grid;

/// From so few points on they are put into memory.
constexpr std::uint64_t kFewPoints = std::uint64_t{1} << 16U;

std::runtime_error has_changed() {
  return std::runtime_error("the source has other points than when it was read before");
}

std::invalid_argument too_much_outline() {
  return std::invalid_argument("more than 2^28 points are near the outline: give a larger limit");
}

std::string name_of(const Shard& shard) {
  return "shard " + std::to_string(shard.number) + " of " + std::to_string(shard.count);
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
// radii. On less, points would be taken for uncertain that are not, or the other way round.
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

/// Whether all points are on a line parallel to an axis, where a grid has no cells.
bool is_flat(const Box& box) {
  return box.min.x == box.max.x || box.min.y == box.max.y;
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
      throw std::invalid_argument("there is no " + name_of(shard));
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
    const auto& [points, box] = extents_[s];
    const std::uint64_t end = progress_.points + points;
    if (points > 0 && rows.meets({grid_.row_number(box.min), grid_.row_number(box.max) + 1})) {
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
          if (uncertain_.size() == kMaxPoints) throw too_much_outline();
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
    if (part_.points.size() > kMaxPoints) throw too_much_outline();
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
  if (is_flat(part_.box)) return std::move(part_);
  choose_grid();
  if (own_.empty()) return std::move(part_);  // more shards than rows
  find_uncertain_cells();
  find_uncertain_points();
  occupied_.reset();
  gather();
  return std::move(part_);
}

// ---- from the shards to the hull
// ---------------------------------------------------------------------------

std::invalid_argument do_not_fit() {
  return std::invalid_argument(
      "the shards do not fit together: their points are not those of one source; make them again");
}

/// Throws unless all shards are there, once each, and are of one source and asked for the same.
void check_together(std::span<const StreamShard> shards) {
  if (shards.empty()) throw std::invalid_argument("there is no shard");
  const StreamShard& first = shards.front();
  std::vector<std::uint32_t> numbers;
  for (const StreamShard& other : shards) {
    const std::string both = name_of(first.shard) + " and " + name_of(other.shard);
    if (other.shard.number < 1 || other.shard.number > other.shard.count) {
      throw std::invalid_argument("there is no " + name_of(other.shard));
    }
    if (other.shard.count != first.shard.count) {
      throw std::invalid_argument(both +
                                  " do not belong together: cut the source into as many shards for each");
    }
    Options options = other.options;
    options.threads = first.options.threads;
    if (options != first.options) {
      throw std::invalid_argument(both +
                                  " were made with different limits or options: make them with the same");
    }
    if (other.source_points != first.source_points || other.source_checksum != first.source_checksum ||
        other.box != first.box) {
      throw std::invalid_argument(both +
                                  " are of different points, or of a source that changed in between: "
                                  "make them of the same");
    }
    if (other.cells_per_length != first.cells_per_length) {
      throw std::invalid_argument(both + " have different grids: let all use as much memory for their maps");
    }
    numbers.push_back(other.shard.number);
  }
  std::sort(numbers.begin(), numbers.end());
  const auto twice = std::adjacent_find(numbers.begin(), numbers.end());
  if (twice != numbers.end()) {
    throw std::invalid_argument(name_of({*twice, first.shard.count}) + " is there twice");
  }
  std::uint32_t missing = 1;
  while (missing <= numbers.size() && numbers[missing - 1] == missing) ++missing;
  if (missing <= first.shard.count) {
    throw std::invalid_argument(name_of({missing, first.shard.count}) + " is missing");
  }
}

/// All points of the shards by their numbers, as if one had found them.
StreamShard joined(std::span<const StreamShard> shards) {
  StreamShard all = shards.front();
  all.points.clear();
  all.numbers.clear();
  all.uncertain.clear();
  std::size_t count = 0;
  for (const StreamShard& shard : shards) count += shard.points.size();
  all.points.reserve(count);
  all.numbers.reserve(count);
  all.uncertain.reserve(count);
  struct Next {
    std::uint64_t number;
    const StreamShard* shard;
    std::size_t place;
    bool operator<(const Next& other) const { return number > other.number; }  // the least on top
  };
  std::priority_queue<Next> queue;
  const auto push = [&](const StreamShard& shard, std::size_t place) {
    if (place < shard.numbers.size()) queue.push({shard.numbers[place], &shard, place});
  };
  for (const StreamShard& shard : shards) push(shard, 0);
  while (!queue.empty()) {
    const Next next = queue.top();
    queue.pop();
    all.points.push_back(next.shard->points[next.place]);
    all.numbers.push_back(next.number);
    all.uncertain.push_back(next.shard->uncertain[next.place]);
    push(*next.shard, next.place + 1);
  }
  return all;
}

StreamedHull extract_in_memory(const StreamShard& all, unsigned threads) {
  if (all.points.size() != all.source_points) throw do_not_fit();
  Options options = all.options;
  options.threads = threads;
  Extractor extractor;
  const IndexedMultiPolygon& shape = extractor.extract(all.points, options);
  StreamedHull hull;
  hull.polygons = to_coordinates(shape, all.points);
  hull.vertices.assign(shape.vertices.begin(), shape.vertices.end());
  hull.triangulated_points = extractor.statistics().triangulated_points;
  return hull;
}

StreamedHull extract_from_part(const StreamShard& all, unsigned threads) {
  const std::size_t count = all.points.size();
  if (count > kMaxPoints) throw too_much_outline();
  const Limits limits = detail::checked_limits(all.options);
  detail::ThreadPool pool;
  pool.use(threads);
  detail::RangeOfBlocks range_of_blocks;
  range_of_blocks.add(all.points, pool);
  // The corners of the convex hull are uncertain, so that the part reaches as far as all points.
  if (range_of_blocks.box() != all.box) throw do_not_fit();
  const detail::CoordinateRange range = range_of_blocks.range();
  if (range.scale_exponent != 0) throw do_not_fit();
  detail::DelaunayBuilder builder;
  builder.build(all.points, range, pool);
  std::vector<std::uint8_t> is_tested(count);
  for (std::size_t v = 0; v < count; ++v) is_tested[v] = all.uncertain[builder.caller_index()[v]];
  detail::RegionFilter filter;
  std::vector<detail::Mesh::Index> boundary;
  if (filter.run_on_part(builder.mesh(), builder.vertices(), is_tested.data(), detail::filter_rules(limits),
                         all.options.fill_single_triangles.value_or(false), pool, boundary)) {
    throw std::invalid_argument(
        "the rounding of a triangle's size decides whether it is kept: make the limit a little larger or "
        "smaller");
  }
  detail::BoundaryTracer tracer;
  IndexedMultiPolygon shape;
  tracer.trace(builder.mesh(), builder.vertices(), count, builder.caller_index(), boundary, shape);
  StreamedHull hull;
  hull.polygons = to_coordinates(shape, all.points);
  for (const std::uint32_t vertex : shape.vertices) hull.vertices.push_back(all.numbers[vertex]);
  hull.triangulated_points = count;
  return hull;
}

/// Throws unless the numbers are those of points of the source, ascending.
void check_numbers(const StreamShard& all) {
  const std::vector<std::uint64_t>& numbers = all.numbers;
  const bool ascend =
      std::adjacent_find(numbers.begin(), numbers.end(), std::greater_equal<>()) == numbers.end();
  if (!ascend || (!numbers.empty() && numbers.back() >= all.source_points)) throw do_not_fit();
}

StreamedHull hull_of_part(const StreamShard& all, unsigned threads) {
  check_numbers(all);
  StreamedHull hull;
  if (all.source_points <= kFewPoints) {
    hull = extract_in_memory(all, threads);
  } else if (!is_flat(all.box)) {
    hull = extract_from_part(all, threads);
  }
  hull.points = all.source_points;
  return hull;
}

}  // namespace

StreamShard part_of_stream(std::span<const PointSource> sources, const Options& options, const Shard& shard,
                           const StreamOptions& stream_options) {
  return Stream(sources, options, shard, stream_options).find_part();
}

StreamedHull concave_hull_of_shards(std::span<const StreamShard> shards, unsigned threads) {
  detail::check_threads(threads);
  for (const StreamShard& shard : shards) {
    if (shard.numbers.size() != shard.points.size() || shard.uncertain.size() != shard.points.size()) {
      throw do_not_fit();
    }
  }
  check_together(shards);
  return shards.size() == 1 ? hull_of_part(shards.front(), threads) : hull_of_part(joined(shards), threads);
}

StreamedHull concave_hull_of_stream(const PointSource& source, const Options& options,
                                    const StreamOptions& stream_options) {
  const StreamShard all = part_of_stream({&source, 1}, options, Shard(), stream_options);
  return concave_hull_of_shards({&all, 1}, options.threads);
}

}  // namespace polylidar
