#include "polylidar/stream.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
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

/// The points near the outline, by ascending number.
struct Part {
  std::vector<Point> points;
  std::vector<std::uint64_t> numbers;
  std::vector<std::uint8_t> is_uncertain;
};

class Stream {
 public:
  Stream(const PointSource& source, const Options& options, const StreamOptions& stream_options)
      : source_(source), stream_options_(stream_options), limits_(detail::checked_limits(options)) {
    pool_.use(options.threads);
  }

  StreamedHull extract(const Options& options);

 private:
  template <class Visit>
  void pass(const Visit& visit);
  template <class Visit>
  void pass_over_cells(const Visit& visit);
  void choose_grid();
  void find_uncertain_cells();
  void find_uncertain_points();
  void gather();
  StreamedHull trace(bool fill_single);
  StreamedHull extract_in_memory(const Options& options);

  const PointSource& source_;
  const StreamOptions& stream_options_;
  Limits limits_;
  detail::ThreadPool pool_;
  StreamProgress progress_;
  std::uint64_t count_ = 0;
  detail::CoordinateRange range_;
  Grid grid_;
  std::optional<Bitmap> occupied_;
  std::optional<Bitmap> marked_;  ///< uncertain cells, then those within reach of uncertain points
  std::vector<std::uint64_t> uncertain_;
  Part part_;
};

/// visit(block, number of its first point) for each block.
template <class Visit>
void Stream::pass(const Visit& visit) {
  ++progress_.pass;
  progress_.points = 0;
  source_([&](std::span<const Point> block) {
    visit(block, progress_.points);
    progress_.points += block.size();
    if (stream_options_.progress) stream_options_.progress(progress_);
  });
}

/// As pass(), after the first one: visit(point, cell, number, chunk) on all threads, where all points lie in
/// the grid; chunks are those of the block, in its order.
template <class Visit>
void Stream::pass_over_cells(const Visit& visit) {
  const Box& box = range_.box;
  pass([&](std::span<const Point> block, std::uint64_t first) {
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
        visit.point(p, grid_.cell(p), first + i, c);
      }
    });
    if (!is_same) throw has_changed();
    visit.end();
  });
  if (progress_.points != count_) throw has_changed();
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

void Stream::choose_grid() {
  const Box& box = range_.box;
  const double most_cells = std::min(8 * stream_options_.most_map_bytes,
                                     static_cast<double>(std::numeric_limits<Grid::Cell>::max()) / 2);
  const double widest = detail::least_dropped_radius(limits_) * (1 - detail::kSafety);
  const double area = (box.max.x - box.min.x) * (box.max.y - box.min.y);
  double radius = std::min(widest, detail::kWidestInSpacings * std::sqrt(area / static_cast<double>(count_)));
  constexpr double kWider = 1.1;
  const auto fits = [&] {
    return std::isfinite(Grid::cell_count(box, detail::kRadius / radius, most_cells));
  };
  while (!fits() && radius < widest) radius = std::min(radius * kWider, widest);
  if (!fits()) {
    throw std::invalid_argument(
        "the limit is too small for the distances between the points: give a larger one, or more memory");
  }
  grid_ = Grid(box, detail::kRadius / radius);
}

void Stream::find_uncertain_cells() {
  occupied_.emplace().clear(grid_.word_count());
  const auto mark = [&](const Point&, Grid::Cell cell, std::uint64_t, std::size_t) {
    occupied_->set_shared(cell);
  };
  pass_over_cells(Visit{[](std::size_t) {}, mark, [] {}});
  marked_.emplace().clear(grid_.word_count());
  constexpr Grid::Cell kRowsOfBand = 64;
  const Grid::Cell bands = (grid_.rows() + kRowsOfBand - 1) / kRowsOfBand;
  pool_.for_each(bands, [&](std::size_t band) {
    detail::find_uncertain_cells(grid_, *occupied_, band * kRowsOfBand,
                                 std::min(grid_.rows(), (band + 1) * kRowsOfBand), *marked_);
  });
}

void Stream::find_uncertain_points() {
  const detail::PointCertificate& certificate = detail::PointCertificate::instance();
  std::vector<std::vector<std::pair<std::uint64_t, Grid::Cell>>> found;
  std::vector<Grid::Cell> cells;
  const auto begin = [&](std::size_t chunks) {
    found.resize(std::max(found.size(), chunks));
    for (auto& of_chunk : found) of_chunk.clear();
  };
  const auto look = [&](const Point& p, Grid::Cell cell, std::uint64_t number, std::size_t chunk) {
    if (!marked_->test(cell) || certificate.is_certified(p, cell, grid_, *occupied_)) return;
    found[chunk].emplace_back(number, cell);
  };
  const auto end = [&] {
    for (const auto& of_chunk : found) {
      for (const auto& [number, cell] : of_chunk) {
        if (uncertain_.size() == kMaxPoints) throw too_much_outline();
        uncertain_.push_back(number);
        if (cells.empty() || cells.back() != cell) cells.push_back(cell);
      }
    }
  };
  pass_over_cells(Visit{begin, look, end});
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
        part_.is_uncertain.push_back(is_uncertain ? 1 : 0);
      }
    }
    if (part_.points.size() > kMaxPoints) throw too_much_outline();
  };
  pass_over_cells(Visit{begin, look, end});
  if (next != uncertain_.end()) throw has_changed();
}

StreamedHull Stream::trace(bool fill_single) {
  detail::DelaunayBuilder builder;
  builder.build(part_.points, range_, pool_);
  const std::size_t count = part_.points.size();
  std::vector<std::uint8_t> is_tested(count);
  for (std::size_t v = 0; v < count; ++v) is_tested[v] = part_.is_uncertain[builder.caller_index()[v]];
  detail::RegionFilter filter;
  std::vector<detail::Mesh::Index> boundary;
  if (filter.run_on_part(builder.mesh(), builder.vertices(), is_tested.data(), detail::filter_rules(limits_),
                         fill_single, pool_, boundary)) {
    throw std::invalid_argument(
        "the rounding of a triangle's size decides whether it is kept: make the limit a little larger or "
        "smaller");
  }
  detail::BoundaryTracer tracer;
  IndexedMultiPolygon shape;
  tracer.trace(builder.mesh(), builder.vertices(), count, builder.caller_index(), boundary, shape);
  StreamedHull hull;
  hull.polygons = to_coordinates(shape, part_.points);
  for (const std::uint32_t vertex : shape.vertices) hull.vertices.push_back(part_.numbers[vertex]);
  hull.points = count_;
  hull.triangulated_points = count;
  return hull;
}

StreamedHull Stream::extract_in_memory(const Options& options) {
  std::vector<Point> points;
  progress_.passes = 2;
  pass([&](std::span<const Point> block, std::uint64_t) {
    if (points.size() + block.size() > count_) throw has_changed();
    points.insert(points.end(), block.begin(), block.end());
  });
  if (points.size() != count_) throw has_changed();
  Extractor extractor;
  const IndexedMultiPolygon& shape = extractor.extract(points, options);
  StreamedHull hull;
  hull.polygons = to_coordinates(shape, points);
  hull.vertices.assign(shape.vertices.begin(), shape.vertices.end());
  hull.points = count_;
  hull.triangulated_points = extractor.statistics().triangulated_points;
  return hull;
}

StreamedHull Stream::extract(const Options& options) {
  detail::RangeOfBlocks range;
  pass([&](std::span<const Point> block, std::uint64_t) { range.add(block, pool_); });
  count_ = range.count();
  if (count_ <= kFewPoints) return extract_in_memory(options);
  if (!detail::is_any_limit_given(options)) {
    throw std::invalid_argument(
        "a stream of more than 65536 points needs a limit: give alpha, max_edge_length or "
        "max_perimeter");
  }
  range_ = range.range();
  if (range_.scale_exponent != 0) {
    throw std::invalid_argument("coordinates as large or as small as these cannot be streamed: scale them");
  }
  const Box& box = range_.box;
  if (box.min.x == box.max.x || box.min.y == box.max.y) {  // points on a line
    StreamedHull none;
    none.points = count_;
    return none;
  }
  choose_grid();
  find_uncertain_cells();
  find_uncertain_points();
  occupied_.reset();
  gather();
  marked_.reset();
  return trace(options.fill_single_triangles.value_or(false));
}

}  // namespace

StreamedHull concave_hull_of_stream(const PointSource& source, const Options& options,
                                    const StreamOptions& stream_options) {
  return Stream(source, options, stream_options).extract(options);
}

}  // namespace polylidar
