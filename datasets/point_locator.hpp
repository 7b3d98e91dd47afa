// Point in multipolygon, exact, and fast for many points in one shape.
#pragma once

#include <cstddef>
#include <vector>

#include "polylidar/geometry.hpp"

namespace hullbench {

/// Answers whether points lie in a multipolygon with holes. The plane is cut into horizontal bands of equal
/// height, about as many as there are edges; a band lists the edges that reach into it, so that a query looks
/// at a handful of them. Every sign comes from polylidar::orient2d: no tolerance.
class PointLocator {
 public:
  /// O(m) time and memory for m edges of usual outlines, O(m^2) when most edges span the whole height. An
  /// empty shape contains nothing.
  explicit PointLocator(const polylidar::MultiPolygon& shape);

  /// Whether `point` lies inside the shape by the even-odd rule, or exactly on one of its rings: the shape is
  /// closed, the boundary of a hole included.
  bool contains(const polylidar::Point& point) const;

  /// Of the shape; see polylidar::bounding_box.
  const polylidar::Box& bounds() const { return bounds_; }

 private:
  /// low.y <= high.y; low.x <= high.x when the edge is horizontal.
  struct Edge {
    polylidar::Point low;
    polylidar::Point high;
  };

  std::size_t band_of(double y) const;

  polylidar::Box bounds_;
  /// band b is edges_[band_starts_[b] .. band_starts_[b + 1]); one entry more than there are bands.
  std::vector<std::size_t> band_starts_;
  /// Band after band; an edge is repeated in every band it reaches into.
  std::vector<Edge> edges_;
};

}  // namespace hullbench
