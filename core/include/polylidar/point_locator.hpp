// Which points a shape covers: exact, and fast for many points in one shape.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "polylidar/geometry.hpp"

namespace polylidar {

/// Answers whether points lie in a multipolygon with holes, such as the hull of other points. The plane is
/// cut into horizontal strips that list their edges, so that a query looks at the edges near its own height
/// only. Decided by orient2d, so exact for coordinates in its range: no tolerance. Queries from several
/// threads at the same time are safe.
class PointLocator {
 public:
  /// O(m) time and memory for m edges. An empty shape contains nothing. Throws std::invalid_argument if a
  /// coordinate is not finite or larger than 2^150.
  explicit PointLocator(const MultiPolygon& shape);

  /// Whether `point` lies inside the shape by the even-odd rule, or on one of its rings: the shape is closed,
  /// the boundary of a hole included. False for coordinates that are not finite. O(edges in its strip).
  bool contains(const Point& point) const;

  /// The polygon, as its place in the shape, that has `point` inside or on its boundary; where two meet, one
  /// of them; nothing outside. Of polygons that overlap, the first, or one on whose boundary the point lies.
  /// O(edges in its strip).
  std::optional<std::size_t> polygon_of(const Point& point) const;

  /// The box round the shape; see bounding_box.
  const Box& bounds() const { return bounds_; }

 private:
  /// low.y <= high.y.
  struct Edge {
    Point low;
    Point high;
    std::uint32_t polygon;
  };

  void add(const Ring& ring, std::uint32_t polygon, std::vector<Edge>& edges);
  std::size_t strip_of(double y) const;
  template <class Cross>
  std::optional<std::uint32_t> look_right(const Point& point, const Cross& cross) const;

  Box bounds_;
  /// Strip s is edges_[strip_starts_[s] .. strip_starts_[s + 1]); one entry more than there are strips.
  std::vector<std::size_t> strip_starts_;
  /// Strip after strip; an edge is in every strip that it meets.
  std::vector<Edge> edges_;
};

}  // namespace polylidar
