#include "tool/shapes/point_locator.hpp"

#include <algorithm>
#include <cmath>

#include "polylidar/predicates.hpp"

namespace polylidar::tool {

PointLocator::PointLocator(const IndexShape& shape, std::span<const Point> points) {
  const auto add = [&](const IndexRing& ring, std::size_t polygon) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point& from = points[ring[i]];
      const Point& to = points[ring[(i + 1) % ring.size()]];
      const bool is_upward = from.y < to.y;
      edges_.push_back({is_upward ? from : to, is_upward ? to : from, static_cast<std::uint32_t>(polygon)});
    }
  };
  for (std::size_t p = 0; p < shape.size(); ++p) {
    add(shape[p].shell, p);
    for (const IndexRing& hole : shape[p].holes) add(hole, p);
  }
  if (edges_.empty()) return;
  bottom_ = edges_[0].low.y;
  top_ = edges_[0].high.y;
  double climb = 0;
  for (const Edge& edge : edges_) {
    bottom_ = std::min(bottom_, edge.low.y);
    top_ = std::max(top_, edge.high.y);
    climb += edge.high.y - edge.low.y;
  }
  // An edge is listed in every strip that it meets; this many strips make about four entries an edge.
  const auto edge_count = static_cast<double>(edges_.size());
  const double strips = 3 * edge_count * ((top_ - bottom_) / climb);
  if (std::isfinite(strips)) strip_count_ = static_cast<std::size_t>(std::clamp(strips, 1.0, edge_count));
  strip_ends_.assign(strip_count_ + 1, 0);
  for (const Edge& edge : edges_) {
    for (std::size_t s = strip_of(edge.low.y); s <= strip_of(edge.high.y); ++s) ++strip_ends_[s + 1];
  }
  for (std::size_t s = 0; s < strip_count_; ++s) strip_ends_[s + 1] += strip_ends_[s];
  strip_edges_.resize(strip_ends_.back());
  std::vector<std::uint32_t> next(strip_ends_.begin(), strip_ends_.end() - 1);
  for (std::uint32_t e = 0; e < edges_.size(); ++e) {
    for (std::size_t s = strip_of(edges_[e].low.y); s <= strip_of(edges_[e].high.y); ++s) {
      strip_edges_[next[s]++] = e;
    }
  }
}

/// Never decreases with y, so that an edge is in the strips of all its heights.
std::size_t PointLocator::strip_of(double y) const {
  const double share = top_ > bottom_ ? (y - bottom_) / (top_ - bottom_) : 0;
  return std::min(strip_count_ - 1, static_cast<std::size_t>(share * static_cast<double>(strip_count_)));
}

std::optional<std::size_t> PointLocator::polygon_of(const Point& p) const {
  if (edges_.empty() || !(p.y >= bottom_ && p.y <= top_)) return {};
  // p is inside the polygon that has an odd number of edges to the right at its height.
  std::vector<std::uint32_t> crossed;
  const std::size_t strip = strip_of(p.y);
  for (std::uint32_t i = strip_ends_[strip]; i < strip_ends_[strip + 1]; ++i) {
    const Edge& edge = edges_[strip_edges_[i]];
    if (p.y < edge.low.y || p.y > edge.high.y || p.x > std::max(edge.low.x, edge.high.x)) continue;
    const bool is_beside = p.x >= std::min(edge.low.x, edge.high.x);
    const double side = is_beside ? orient2d(edge.low, edge.high, p) : 1;
    if (is_beside && side == 0) return edge.polygon;
    // Half-open, so that a vertex counts once.
    if (side > 0 && p.y < edge.high.y) crossed.push_back(edge.polygon);
  }
  std::sort(crossed.begin(), crossed.end());
  for (std::size_t i = 0; i < crossed.size();) {
    const auto end = std::upper_bound(crossed.begin(), crossed.end(), crossed[i]);
    const auto next = static_cast<std::size_t>(end - crossed.begin());
    if ((next - i) % 2 == 1) return crossed[i];
    i = next;
  }
  return {};
}

std::vector<std::uint32_t> points_outside(const IndexShape& shape, std::span<const Point> points) {
  const PointLocator locator(shape, points);
  std::vector<std::uint32_t> outside;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (!locator.covers(points[i])) outside.push_back(i);
  }
  return outside;
}

}  // namespace polylidar::tool
