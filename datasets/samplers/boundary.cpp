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

/// Uniform over the length of a shape's rings.
class RingPoints {
 public:
  explicit RingPoints(const MultiPolygon& shape) {
    for (const Polygon& polygon : shape) {
      add(polygon.shell);
      for (const Ring& hole : polygon.holes) add(hole);
    }
  }

  double length() const { return length_; }

  Point draw(Random& random) const {
    const double place = length_ * random.uniform();
    const auto behind =
        std::upper_bound(edges_.begin(), edges_.end(), place,
                         [](double value, const RingEdge& edge) { return value < edge.length_before; });
    const RingEdge& edge = *(behind - 1);
    const double end = behind == edges_.end() ? length_ : behind->length_before;
    const double part = (place - edge.length_before) / (end - edge.length_before);
    return {edge.start.x + part * (edge.end.x - edge.start.x),
            edge.start.y + part * (edge.end.y - edge.start.y)};
  }

 private:
  struct RingEdge {
    Point start;
    Point end;
    double length_before = 0;  ///< of all edges before it
  };

  void add(const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const RingEdge edge = {ring[i], ring[(i + 1) % ring.size()], length_};
      const double dx = edge.end.x - edge.start.x;
      const double dy = edge.end.y - edge.start.y;
      length_ += std::sqrt(dx * dx + dy * dy);
      edges_.push_back(edge);
    }
  }

  std::vector<RingEdge> edges_;
  double length_ = 0;
};

}  // namespace

std::vector<Point> sample_boundary(const MultiPolygon& shape, std::size_t n, double level,
                                   std::uint64_t seed) {
  std::vector<Point> points = sample_uniform(shape, n - share(n, level), seed);
  const RingPoints rings(shape);
  Random random(derive_seed(seed, "boundary"));
  while (points.size() < n) points.push_back(rings.draw(random));
  return points;
}

std::vector<Point> sample_outline(const MultiPolygon& shape, std::size_t n, double level,
                                  std::uint64_t seed) {
  const UniformPoints refuses_shapes_without_area(shape, seed);
  const RingPoints rings(shape);
  const double deviation = level * (rings.length() / static_cast<double>(n));
  Random random(derive_seed(seed, "outline"));
  std::vector<Point> points(n);
  for (Point& point : points) {
    const Point on_ring = rings.draw(random);
    // Drawn at every level, so that levels share their places on the rings.
    point = moved_by_gaussian(on_ring, deviation, random);
  }
  return points;
}

}  // namespace hullbench
