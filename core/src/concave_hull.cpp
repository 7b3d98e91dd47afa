#include "polylidar/concave_hull.hpp"

#include <cmath>
#include <stdexcept>

#include "automatic_limit.hpp"
#include "boundary.hpp"
#include "delaunay_builder.hpp"
#include "region.hpp"

namespace polylidar {
namespace {

void check_threads(unsigned threads) {
  if (threads == 0) throw std::invalid_argument("threads must be one or more");
}

/// The limits that were given. Throws std::invalid_argument where an option has no meaning.
Limits checked_limits(const Options& options) {
  const Limits limits{options.alpha.value_or(kNoLimit), options.max_edge_length.value_or(kNoLimit),
                      options.max_perimeter.value_or(kNoLimit)};
  if (!(limits.alpha >= 0)) throw std::invalid_argument("alpha must be zero or more");
  if (!(limits.max_edge_length >= 0)) throw std::invalid_argument("max_edge_length must be zero or more");
  if (!(limits.max_perimeter >= 0)) throw std::invalid_argument("max_perimeter must be zero or more");
  check_threads(options.threads);
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
  Limits limits = checked_limits(options);
  state_->pool.use(options.threads);
  detail::DelaunayBuilder& builder = state_->builder;
  const int exponent = builder.scale_exponent();
  Limits scaled{std::ldexp(limits.alpha, exponent), std::ldexp(limits.max_edge_length, exponent),
                std::ldexp(limits.max_perimeter, exponent)};
  const bool is_automatic = !options.alpha && !options.max_edge_length && !options.max_perimeter;
  std::span<const float> perimeters;
  if (is_automatic) {
    scaled.max_perimeter = state_->automatic_limit.choose(builder.mesh(), builder.vertices());
    perimeters = state_->automatic_limit.perimeters();
    limits.max_perimeter = std::ldexp(scaled.max_perimeter, -exponent);
  }
  state_->limits = limits;
  state_->filter.run(builder.mesh(), builder.vertices(), scaled, perimeters,
                     options.fill_single_triangles.value_or(is_automatic), state_->pool, state_->boundary);
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

}  // namespace polylidar
