#include "polylidar/concave_hull.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

#include "automatic_limit.hpp"
#include "boundary.hpp"
#include "coordinate_range.hpp"
#include "delaunay_builder.hpp"
#include "region.hpp"

namespace polylidar {
namespace {

/// A limit by its name and by where it stands in what is asked for and in what is kept to.
struct LimitField {
  const char* name;
  std::optional<double> Options::*option;
  double Limits::*limit;
};
constexpr std::array kLimitFields{
    LimitField{"alpha", &Options::alpha, &Limits::alpha},
    LimitField{"max_edge_length", &Options::max_edge_length, &Limits::max_edge_length},
    LimitField{"max_perimeter", &Options::max_perimeter, &Limits::max_perimeter}};

void check_threads(unsigned threads) {
  if (threads == 0) throw std::invalid_argument("threads must be one or more");
}

/// The limits that were given. Throws std::invalid_argument where an option has no meaning.
Limits checked_limits(const Options& options) {
  Limits limits;
  for (const auto& [name, option, limit] : kLimitFields) {
    limits.*limit = (options.*option).value_or(kNoLimit);
    if (!(limits.*limit >= 0)) throw std::invalid_argument(std::string(name) + " must be zero or more");
  }
  if (!(options.detail > 0 && std::isfinite(options.detail))) {
    throw std::invalid_argument("detail must be positive and finite");
  }
  check_threads(options.threads);
  return limits;
}

bool is_any_limit_given(const Options& options) {
  return std::any_of(kLimitFields.begin(), kLimitFields.end(),
                     [&](const LimitField& field) { return (options.*field.option).has_value(); });
}

/// `limits` in the unit of coordinates that are 2^exponent times as large.
Limits scaled(Limits limits, int exponent) {
  for (const LimitField& field : kLimitFields) {
    limits.*field.limit = std::ldexp(limits.*field.limit, exponent);
  }
  return limits;
}

}  // namespace

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
  detail::ThreadPool pool;
  detail::DelaunayBuilder builder;
  detail::AutomaticLimit automatic_limit;
  Limits limits;
  std::optional<ChosenSizes> chosen_sizes;
  detail::RegionFilter filter;
  std::vector<detail::Mesh::Index> boundary;
  detail::BoundaryTracer tracer;
  IndexedMultiPolygon shape;
};

Extractor::Extractor() : state_(std::make_unique<State>()) {}
Extractor::~Extractor() = default;
Extractor::Extractor(Extractor&&) noexcept = default;
Extractor& Extractor::operator=(Extractor&&) noexcept = default;

const IndexedMultiPolygon& Extractor::extract(std::span<const Point> points, const Options& options) {
  checked_limits(options);  // before the points are triangulated in vain
  triangulate(points, options.threads);
  extract_regions(options);
  return extract_polygons();
}

void Extractor::triangulate(std::span<const Point> points, unsigned threads) {
  check_threads(threads);
  state_->pool.use(threads);
  state_->builder.build(points, state_->pool);
  state_->boundary.clear();
}

void Extractor::extract_regions(const Options& options) {
  state_->limits = checked_limits(options);
  state_->pool.use(options.threads);
  state_->chosen_sizes.reset();
  detail::DelaunayBuilder& builder = state_->builder;
  const int exponent = builder.scale_exponent();
  if (is_any_limit_given(options)) {
    const auto rules = detail::filter_rules(scaled(state_->limits, exponent));
    state_->filter.run(builder.mesh(), builder.vertices(), rules,
                       options.fill_single_triangles.value_or(false), state_->pool, state_->boundary);
    return;
  }
  detail::AutomaticLimit& automatic = state_->automatic_limit;
  automatic.choose(builder, options.detail, state_->pool);
  if (const auto& sizes = automatic.range()) {
    state_->chosen_sizes = {std::ldexp(sizes->least, -exponent), std::ldexp(sizes->median, -exponent),
                            std::ldexp(sizes->most, -exponent)};
  }
  state_->filter.run(builder.mesh(), builder.vertices(), automatic.field(),
                     options.fill_single_triangles.value_or(true), state_->pool, state_->boundary);
}

std::optional<ChosenSizes> Extractor::chosen_sizes() const {
  return state_->chosen_sizes;
}

Limits Extractor::limits() const {
  return state_->limits;
}

const IndexedMultiPolygon& Extractor::extract_polygons() {
  detail::DelaunayBuilder& builder = state_->builder;
  state_->tracer.trace(builder.mesh(), builder.vertices(), builder.vertex_count(), builder.caller_index(),
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
  return state_->tracer.count_triangles(state_->builder.mesh());
}

IndexedMultiPolygon concave_hull(std::span<const Point> points, const Options& options) {
  return Extractor().extract(points, options);
}

std::vector<LabelledHull> concave_hulls(std::span<const Point> points, std::span<const std::int64_t> labels,
                                        const Options& options) {
  if (labels.size() != points.size()) throw std::invalid_argument("there must be one label a point");
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
    hulls[h].shape = concave_hull(own, of_one);
    for (std::uint32_t& vertex : hulls[h].shape.vertices) vertex = members[vertex];
  });
  return hulls;
}

}  // namespace polylidar
