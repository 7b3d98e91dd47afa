#include "polylidar/point_locator.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "polylidar/predicates.hpp"

namespace polylidar {

namespace {

constexpr double kLargest = 0x1p150;  ///< orient2d's range

}  // namespace

PointLocator::PointLocator(const MultiPolygon& shape) : bounds_(bounding_box({})) {
  std::vector<Edge> edges;
  for (std::uint32_t p = 0; p < shape.size(); ++p) {
    add(shape[p].shell, p, edges);
    for (const Ring& hole : shape[p].holes) add(hole, p, edges);
  }
  double climb = 0;
  for (const Edge& edge : edges) climb += edge.high.y - edge.low.y;
  // An edge is listed in every strip that it meets; so many strips make about four entries an edge.
  const auto edge_count = static_cast<double>(edges.size());
  const double strips = 3 * edge_count * ((bounds_.max.y - bounds_.min.y) / climb);
  const double strip_count = std::isfinite(strips) ? std::clamp(strips, 1.0, std::max(edge_count, 1.0)) : 1;
  strip_starts_.assign(static_cast<std::size_t>(strip_count) + 1, 0);
  // A counting sort: count, sum up, place.
  const auto for_each_strip = [this](const Edge& edge, const auto& visit) {
    for (std::size_t s = strip_of(edge.low.y); s <= strip_of(edge.high.y); ++s) visit(s);
  };
  for (const Edge& edge : edges) for_each_strip(edge, [this](std::size_t s) { ++strip_starts_[s + 1]; });
  std::partial_sum(strip_starts_.begin(), strip_starts_.end(), strip_starts_.begin());
  edges_.resize(strip_starts_.back());
  std::vector<std::size_t> next(strip_starts_);
  for (const Edge& edge : edges) for_each_strip(edge, [&](std::size_t s) { edges_[next[s]++] = edge; });
}

void PointLocator::add(const Ring& ring, std::uint32_t polygon, std::vector<Edge>& edges) {
  bounds_ = joined(bounds_, bounding_box(ring));
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point& from = ring[i];
    const Point& to = ring[(i + 1) % ring.size()];
    if (!(std::abs(from.x) <= kLargest && std::abs(from.y) <= kLargest)) {
      throw std::invalid_argument("a shape's coordinates must be finite and at most 2^150; scale them");
    }
    const bool is_upward = from.y < to.y;
    edges.push_back({is_upward ? from : to, is_upward ? to : from, polygon});
  }
}

/// Never decreases with y, so that an edge is in the strips of all its heights.
std::size_t PointLocator::strip_of(double y) const {
  const double height = bounds_.max.y - bounds_.min.y;
  const std::size_t strips = strip_starts_.size() - 1;
  const double share = height > 0 ? (y - bounds_.min.y) / height : 0;
  return std::min(strips - 1, static_cast<std::size_t>(share * static_cast<double>(strips)));
}

/// Calls cross(polygon) for every edge that a ray from `point` to the right crosses. Returns the polygon of
/// an edge that `point` lies on, if there is one; the edges behind it are not looked at then.
template <class Cross>
std::optional<std::uint32_t> PointLocator::look_right(const Point& point, const Cross& cross) const {
  const bool is_in_box = point.x >= bounds_.min.x && point.x <= bounds_.max.x && point.y >= bounds_.min.y &&
                         point.y <= bounds_.max.y;
  if (!is_in_box) return {};
  const std::size_t strip = strip_of(point.y);
  for (std::size_t i = strip_starts_[strip]; i < strip_starts_[strip + 1]; ++i) {
    const Edge& edge = edges_[i];
    if (point.y < edge.low.y || point.y > edge.high.y || point.x > std::max(edge.low.x, edge.high.x))
      continue;
    const bool is_beside = point.x >= std::min(edge.low.x, edge.high.x);
    const double side = is_beside ? orient2d(edge.low, edge.high, point) : 1;
    if (side == 0) return edge.polygon;
    // The upper end does not count, so that a ray through a vertex counts each of the two edges there once or
    // not at all.
    if (side > 0 && point.y < edge.high.y) cross(edge.polygon);
  }
  return {};
}

bool PointLocator::contains(const Point& point) const {
  bool is_inside = false;
  return look_right(point, [&](std::uint32_t) { is_inside = !is_inside; }) || is_inside;
}

std::optional<std::size_t> PointLocator::polygon_of(const Point& point) const {
  std::vector<std::uint32_t> crossed;
  if (const auto polygon = look_right(point, [&](std::uint32_t p) { crossed.push_back(p); })) return polygon;
  // The point is inside a polygon of which it has an odd number of edges to its right.
  std::sort(crossed.begin(), crossed.end());
  for (auto begin = crossed.begin(); begin != crossed.end();) {
    const auto end = std::upper_bound(begin, crossed.end(), *begin);
    if ((end - begin) % 2 == 1) return *begin;
    begin = end;
  }
  return {};
}

}  // namespace polylidar
