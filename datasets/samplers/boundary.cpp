#include "datasets/samplers/boundary.hpp"

#include <algorithm>
#include <cmath>

#include "datasets/random.hpp"
#include "datasets/samplers/draw.hpp"
#include "datasets/sampling.hpp"

namespace hullbench {

using polylidar::MultiPolygon;
using polylidar::Point;
using polylidar::Polygon;
using polylidar::Ring;

namespace {

struct RingEdge {
  Point start;
  Point end;
  double length_before = 0;  ///< of all edges before it
};

std::vector<RingEdge> ring_edges(const MultiPolygon& shape, double& length) {
  std::vector<RingEdge> edges;
  length = 0;
  const auto add = [&](const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const RingEdge edge = {ring[i], ring[(i + 1) % ring.size()], length};
      const double dx = edge.end.x - edge.start.x;
      const double dy = edge.end.y - edge.start.y;
      length += std::sqrt(dx * dx + dy * dy);
      edges.push_back(edge);
    }
  };
  for (const Polygon& polygon : shape) {
    add(polygon.shell);
    for (const Ring& hole : polygon.holes) add(hole);
  }
  return edges;
}

}  // namespace

std::vector<Point> sample_boundary(const MultiPolygon& shape, std::size_t n, double level,
                                   std::uint64_t seed) {
  std::vector<Point> points = sample_uniform(shape, n - share(n, level), seed);
  double length = 0;
  const std::vector<RingEdge> edges = ring_edges(shape, length);
  Random random(derive_seed(seed, "boundary"));
  while (points.size() < n) {
    const double place = length * random.uniform();
    const auto behind =
        std::upper_bound(edges.begin(), edges.end(), place,
                         [](double value, const RingEdge& edge) { return value < edge.length_before; });
    const RingEdge& edge = *(behind - 1);
    const double end = behind == edges.end() ? length : behind->length_before;
    const double part = (place - edge.length_before) / (end - edge.length_before);
    points.push_back({edge.start.x + part * (edge.end.x - edge.start.x),
                      edge.start.y + part * (edge.end.y - edge.start.y)});
  }
  return points;
}

}  // namespace hullbench
