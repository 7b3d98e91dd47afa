#include "polylidar/concave_hull.hpp"

#include <cmath>
#include <stdexcept>

#include "boundary.hpp"
#include "delaunay_builder.hpp"
#include "region.hpp"

namespace polylidar {

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
  triangulate(points, options.threads);
  extract_regions(options);
  return extract_polygons();
}

void Extractor::triangulate(std::span<const Point> points, unsigned threads) {
  if (threads == 0) throw std::invalid_argument("threads must be one or more");
  state_->pool.use(threads);
  state_->boundary.clear();
  state_->builder.build(points, state_->pool);
}

void Extractor::extract_regions(const Options& options) {
  if (!(options.alpha >= 0)) throw std::invalid_argument("alpha must be zero or more");
  if (!(options.max_edge_length >= 0)) throw std::invalid_argument("max_edge_length must be zero or more");
  if (options.threads == 0) throw std::invalid_argument("threads must be one or more");
  state_->pool.use(options.threads);
  detail::DelaunayBuilder& builder = state_->builder;
  state_->filter.run(builder.mesh(), builder.vertices(), std::ldexp(options.alpha, builder.scale_exponent()),
                     std::ldexp(options.max_edge_length, builder.scale_exponent()), state_->pool,
                     state_->boundary);
}

const IndexedMultiPolygon& Extractor::extract_polygons() {
  detail::DelaunayBuilder& builder = state_->builder;
  state_->tracer.trace(builder.mesh(), builder.vertices(), builder.vertex_count(), builder.caller_index(),
                       state_->boundary, state_->shape);
  return state_->shape;
}

std::vector<double> Extractor::sample_edge_lengths(std::size_t most) const {
  using detail::Mesh;
  if (most == 0) throw std::invalid_argument("most must be one or more");
  const Mesh& mesh = state_->builder.mesh();
  const Point* vertices = state_->builder.vertices();
  std::vector<double> lengths;
  const auto add_edges_of = [&](Mesh::Index t) {
    if (mesh.is_ghost(t)) return;
    for (Mesh::Index e = Mesh::kStride * t; e < Mesh::kStride * t + 3; ++e) {
      // Of an edge's two sides the lower one counts, or the only one.
      if (mesh.twin(e) < e && !mesh.is_ghost(Mesh::triangle_of(mesh.twin(e)))) continue;
      const Point& a = vertices[mesh.origin(e)];
      const Point& b = vertices[mesh.origin(Mesh::next(e))];
      lengths.push_back(std::ldexp(std::hypot(a.x - b.x, a.y - b.y), -state_->builder.scale_exponent()));
    }
  };
  const auto sample = [&](std::size_t step) {
    for (std::size_t t = 0; t < mesh.triangle_count(); t += step) add_edges_of(static_cast<Mesh::Index>(t));
  };
  // At most 3/2 edges a triangle. Records come in pairs, of which an even step would only see the first.
  const std::size_t step = (std::size_t{3} * mesh.triangle_count() / 2 / most) | 1U;
  sample(step);
  if (step > 1 && lengths.size() < most / 4 + 1) {  // most points repeat others and leave records unused
    lengths.clear();
    sample(1);
  }
  return lengths;
}

std::vector<std::size_t> Extractor::count_triangles() const {
  return state_->tracer.count_triangles(state_->builder.mesh());
}

IndexedMultiPolygon concave_hull(std::span<const Point> points, const Options& options) {
  return Extractor().extract(points, options);
}

}  // namespace polylidar
