#include "datasets/point_locator.hpp"

#include <algorithm>
#include <utility>

#include "polylidar/predicates.hpp"

namespace hullbench {

using polylidar::MultiPolygon;
using polylidar::Point;
using polylidar::Polygon;
using polylidar::Ring;

namespace {

constexpr std::size_t kMaxBands = 1U << 16U;

std::vector<Point> all_vertices(const MultiPolygon& shape) {
  std::vector<Point> vertices;
  for (const Polygon& polygon : shape) {
    vertices.insert(vertices.end(), polygon.shell.begin(), polygon.shell.end());
    for (const Ring& hole : polygon.holes) vertices.insert(vertices.end(), hole.begin(), hole.end());
  }
  return vertices;
}

bool is_lower(const Point& a, const Point& b) {
  return a.y < b.y || (a.y == b.y && a.x < b.x);
}

}  // namespace

PointLocator::PointLocator(const MultiPolygon& shape)
    : bounds_(polylidar::bounding_box(all_vertices(shape))) {
  std::vector<Edge> edges;
  const auto add_ring = [&edges](const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      Edge edge{ring[i], ring[(i + 1) % ring.size()]};
      if (is_lower(edge.high, edge.low)) std::swap(edge.low, edge.high);
      edges.push_back(edge);
    }
  };
  for (const Polygon& polygon : shape) {
    add_ring(polygon.shell);
    for (const Ring& hole : polygon.holes) add_ring(hole);
  }

  // A counting sort by band: count, sum up, place.
  band_starts_.assign(std::clamp<std::size_t>(edges.size(), 1, kMaxBands) + 1, 0);
  for (const Edge& edge : edges) {
    for (std::size_t band = band_of(edge.low.y); band <= band_of(edge.high.y); ++band)
      ++band_starts_[band + 1];
  }
  for (std::size_t band = 1; band < band_starts_.size(); ++band) band_starts_[band] += band_starts_[band - 1];
  edges_.resize(band_starts_.back());
  std::vector<std::size_t> next(band_starts_);
  for (const Edge& edge : edges) {
    for (std::size_t band = band_of(edge.low.y); band <= band_of(edge.high.y); ++band)
      edges_[next[band]++] = edge;
  }
}

std::size_t PointLocator::band_of(double y) const {
  // Every step rounds monotonically, so a point between the ends of an edge falls into one of the edge's
  // bands.
  const double height = bounds_.max.y - bounds_.min.y;
  const std::size_t bands = band_starts_.size() - 1;
  if (!(height > 0)) return 0;
  const double position = (y - bounds_.min.y) / height * static_cast<double>(bands);
  return std::min(static_cast<std::size_t>(position), bands - 1);
}

bool PointLocator::contains(const Point& point) const {
  const bool in_box = point.x >= bounds_.min.x && point.x <= bounds_.max.x && point.y >= bounds_.min.y &&
                      point.y <= bounds_.max.y;
  if (!in_box) return false;
  const std::size_t band = band_of(point.y);
  bool inside = false;
  for (std::size_t i = band_starts_[band]; i < band_starts_[band + 1]; ++i) {
    const auto& [low, high] = edges_[i];
    if (point.y < low.y || point.y > high.y) continue;
    const double side = polylidar::orient2d(low, high, point);
    if (side == 0) {
      const bool horizontal = low.y == high.y;
      if (!horizontal || (low.x <= point.x && point.x <= high.x)) return true;
    } else if (side > 0 && point.y < high.y) {
      // The ray to the right crosses the edge. Its upper end does not count, so that a ray through a vertex
      // counts each of the two edges there once or not at all.
      inside = !inside;
    }
  }
  return inside;
}

}  // namespace hullbench
