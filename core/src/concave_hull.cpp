#include "polylidar/concave_hull.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "automatic_limit.hpp"
#include "boundary.hpp"
#include "coordinate_range.hpp"
#include "delaunay_builder.hpp"
#include "interior.hpp"
#include "options_check.hpp"
#include "polylidar/widened_hull.hpp"
#include "region.hpp"

namespace polylidar {

using detail::check_threads;
using detail::checked_limits;
using detail::is_any_limit_given;
using detail::is_filled;
using detail::scaled;

void IndexedMultiPolygon::clear() {
  vertices.clear();
  ring_ends.clear();
  polygon_ends.clear();
}

MultiPolygon to_coordinates(const IndexedMultiPolygon& shape, std::span<const Point> points) {
  MultiPolygon result(shape.polygon_ends.size());
  std::size_t ring = 0;
  std::size_t vertex = 0;
  const auto next_ring = [&] {
    Ring coordinates(shape.ring_ends[ring] - vertex);
    for (Point& p : coordinates) p = points[shape.vertices[vertex++]];
    ++ring;
    return coordinates;
  };
  for (std::size_t p = 0; p < result.size(); ++p) {
    result[p].shell = next_ring();
    result[p].holes.reserve(shape.polygon_ends[p] - ring);
    while (ring < shape.polygon_ends[p]) result[p].holes.push_back(next_ring());
  }
  return result;
}

struct Extractor::State {
  bool extract_part(std::span<const Point> given, const detail::CoordinateRange& range,
                    const Limits& given_limits, const Options& given_options);
  void choose_sizes(double detail);
  void find_regions(const Options& given_options);
  void mesh_is_whole();
  void triangulate_the_rest();

  detail::ThreadPool pool;
  detail::DelaunayBuilder builder;
  detail::AutomaticLimit automatic_limit;
  Limits limits;
  std::optional<ChosenSizes> chosen_sizes;
  detail::RegionFilter filter;
  std::vector<detail::Mesh::Index> boundary;
  detail::BoundaryTracer tracer;
  IndexedMultiPolygon shape;

  detail::InteriorPath interior;
  Statistics statistics;
  /// What automatic_limit found when it looked at the points; none where it has not.
  std::optional<detail::SizesBy> sizes_by;
  // Where the mesh is that of a part: what was asked for, should the rest be needed.
  bool is_part = false;
  std::span<const Point> points;
  Options options;
};

/// extract() without the interior; false where that cannot be or does not pay.
bool Extractor::State::extract_part(std::span<const Point> given, const detail::CoordinateRange& range,
                                    const Limits& given_limits, const Options& given_options) {
  const detail::Steps steps{pool, builder, filter, boundary, tracer};
  const bool fill_single = is_filled(given_options);
  if (is_any_limit_given(given_options)) {
    statistics = interior.extract(given, range, given_limits, fill_single, steps, shape);
  } else {
    statistics = {Way::kWhole, given.size(), given.size(), given.size()};
    if (given.size() < detail::WindowSample::kLeastPoints) statistics.way = Way::kFewPoints;
    if (range.scale_exponent != 0) statistics.way = Way::kExtremeCoordinates;
    if (statistics.way != Way::kWhole) return false;
    sizes_by = automatic_limit.look(detail::passes_over(given, pool), range.box, pool);
    if (sizes_by == detail::SizesBy::kBlocks) return false;
    const double how_fine = given_options.detail;
    const double radius = automatic_limit.wide_radius() / std::max(how_fine, 1.0);
    const auto choose_field = [&](const std::uint8_t* is_tested) -> const detail::SizeField& {
      automatic_limit.choose_found(builder, is_tested, how_fine, pool);
      return automatic_limit.field();
    };
    statistics = interior.extract(given, range, radius, choose_field, fill_single, steps, shape);
  }
  if (statistics.way != Way::kInteriorLeftOut) return false;
  limits = given_limits;
  chosen_sizes.reset();
  if (sizes_by) chosen_sizes = automatic_limit.range();
  is_part = true;
  points = given;
  options = given_options;
  return true;
}

/// After the builder triangulated all points.
void Extractor::State::mesh_is_whole() {
  is_part = false;
  sizes_by.reset();
  boundary.clear();
}

/// Where the mesh is that of a part: makes it that of all points.
void Extractor::State::triangulate_the_rest() {
  if (!is_part) return;
  builder.build(points, pool);
  mesh_is_whole();
  statistics = {Way::kWhole, points.size(), points.size(), points.size()};
}

/// From the triangulation of all points.
void Extractor::State::choose_sizes(double detail) {
  if (!sizes_by) {
    automatic_limit.choose(builder, detail, pool);
  } else if (*sizes_by == detail::SizesBy::kBlocks) {
    automatic_limit.choose_by_blocks(builder, detail, pool);
  } else {
    automatic_limit.choose_found(builder, nullptr, detail, pool);
  }
  sizes_by = automatic_limit.sizes_by();  // another detail may be asked for next, of the same points
  const int exponent = builder.scale_exponent();
  if (const auto& sizes = automatic_limit.range()) {
    chosen_sizes = {std::ldexp(sizes->least, -exponent), std::ldexp(sizes->median, -exponent),
                    std::ldexp(sizes->most, -exponent)};
  }
}

/// The triangulation is that of all points.
void Extractor::State::find_regions(const Options& given_options) {
  chosen_sizes.reset();
  statistics.by_outlines = false;
  statistics.outline_step = 0;
  if (is_any_limit_given(given_options)) {
    filter.run(builder.mesh(), builder.vertices(),
               detail::filter_rules(scaled(limits, builder.scale_exponent())), is_filled(given_options), pool,
               boundary);
  } else {
    choose_sizes(given_options.detail);
    statistics.by_outlines = filter.run(builder.mesh(), builder.vertices(), automatic_limit.field(),
                                        is_filled(given_options), pool, boundary);
    if (statistics.by_outlines) {
      const double step = std::sqrt(automatic_limit.field().outlines->squared_step);
      statistics.outline_step = std::ldexp(step, -builder.scale_exponent());
    }
  }
}

Extractor::Extractor() : state_(std::make_unique<State>()) {}
Extractor::~Extractor() = default;
Extractor::Extractor(Extractor&&) noexcept = default;
Extractor& Extractor::operator=(Extractor&&) noexcept = default;

const IndexedMultiPolygon& Extractor::extract(std::span<const Point> points, const Options& options) {
  const Limits limits = checked_limits(options);  // before the points are triangulated in vain
  if (points.empty() || points.size() > kMaxPoints) {
    triangulate(points, options.threads);
  } else {
    state_->pool.use(options.threads);
    const detail::CoordinateRange range = detail::measure_coordinates(points, state_->pool);
    state_->sizes_by.reset();
    if (state_->extract_part(points, range, limits, options)) return state_->shape;
    const std::optional<detail::SizesBy> sizes_by = state_->sizes_by;
    state_->builder.build(points, range, state_->pool);
    state_->mesh_is_whole();
    state_->sizes_by = sizes_by;
  }
  state_->limits = limits;
  state_->find_regions(options);
  return extract_polygons();
}

void Extractor::triangulate(std::span<const Point> points, unsigned threads) {
  check_threads(threads);
  state_->pool.use(threads);
  state_->builder.build(points, state_->pool);
  state_->mesh_is_whole();
  state_->statistics = {Way::kWhole, points.size(), points.size(), points.size()};
}

void Extractor::extract_regions(const Options& options) {
  state_->limits = checked_limits(options);
  state_->pool.use(options.threads);
  state_->triangulate_the_rest();
  state_->find_regions(options);
}

std::optional<ChosenSizes> Extractor::chosen_sizes() const {
  return state_->chosen_sizes;
}

Limits Extractor::limits() const {
  return state_->limits;
}

const IndexedMultiPolygon& Extractor::extract_polygons() {
  detail::DelaunayBuilder& builder = state_->builder;
  const std::uint32_t* const caller_index =
      state_->is_part ? state_->interior.caller_index() : builder.caller_index();
  state_->tracer.trace(builder.mesh(), builder.vertices(), builder.vertex_count(), caller_index,
                       state_->boundary, state_->shape);
  return state_->shape;
}

bool Extractor::has_triangles() const {
  const detail::Mesh& mesh = state_->builder.mesh();
  detail::Mesh::Index t = 0;
  while (t < mesh.triangle_count() && mesh.is_ghost(t)) ++t;
  return t < mesh.triangle_count();
}

std::vector<std::size_t> Extractor::count_triangles() const {
  if (state_->is_part) {
    Extractor whole;  // the shape that the caller holds stays where it is
    whole.triangulate(state_->points, state_->options.threads);
    whole.extract_regions(state_->options);
    whole.extract_polygons();
    return whole.count_triangles();
  }
  return state_->tracer.count_triangles(state_->builder.mesh());
}

const Statistics& Extractor::statistics() const {
  return state_->statistics;
}

IndexedMultiPolygon concave_hull(std::span<const Point> points, const Options& options,
                                 const Wanted& wanted) {
  Extractor extractor;
  if (wanted == Wanted()) return extractor.extract(points, options);
  return widened_hull(extractor, points, options, wanted).shape;
}

std::vector<LabelledHull> concave_hulls(std::span<const Point> points, std::span<const std::int64_t> labels,
                                        const Options& options, const Wanted& wanted) {
  if (labels.size() != points.size()) throw std::invalid_argument("there must be one label a point");
  detail::check_point_count(points.size());
  checked_limits(options);
  if (!points.empty()) {  // by the caller's indices
    detail::ThreadPool this_thread;
    detail::measure_coordinates(points, this_thread);
  }
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return labels[a] < labels[b]; });
  std::vector<LabelledHull> hulls;
  std::vector<std::size_t> begins;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i > 0 && labels[order[i]] == labels[order[i - 1]]) continue;
    hulls.push_back({labels[order[i]], {}});
    begins.push_back(i);
  }
  begins.push_back(order.size());

  detail::ThreadPool pool;
  pool.use(hulls.size() > 1 ? options.threads : 1);
  Options of_one = options;
  of_one.threads = hulls.size() > 1 ? 1 : options.threads;
  pool.for_each(hulls.size(), [&](std::size_t h) {
    const std::span<const std::uint32_t> members =
        std::span(order).subspan(begins[h], begins[h + 1] - begins[h]);
    std::vector<Point> own(members.size());
    std::transform(members.begin(), members.end(), own.begin(), [&](std::uint32_t i) { return points[i]; });
    hulls[h].shape = concave_hull(own, of_one, wanted);
    for (std::uint32_t& vertex : hulls[h].shape.vertices) vertex = members[vertex];
  });
  return hulls;
}

}  // namespace polylidar
