// Which points a shape covers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "tool/shapes/index_shape.hpp"

namespace polylidar::tool {

/// The edges of a valid shape by height, so that a query looks at those at its own height only. Decided by
/// exact predicates, for coordinates in their range.
class PointLocator {
 public:
  PointLocator(const IndexShape& shape, std::span<const Point> points);

  /// The polygon that has `p` inside or on its boundary, where two meet one of them; nothing outside. O(edges
  /// at its height).
  std::optional<std::size_t> polygon_of(const Point& p) const;
  bool covers(const Point& p) const { return polygon_of(p).has_value(); }

 private:
  struct Edge {
    Point low;  ///< low.y <= high.y
    Point high;
    std::uint32_t polygon = 0;
  };

  std::size_t strip_of(double y) const;

  std::vector<Edge> edges_;
  double bottom_ = 0;
  double top_ = 0;
  std::size_t strip_count_ = 1;
  std::vector<std::uint32_t> strip_ends_;  ///< strip s is strip_edges_[strip_ends_[s - 1] .. strip_ends_[s])
  std::vector<std::uint32_t> strip_edges_;
};

/// The points that `shape` leaves outside, by ascending index.
std::vector<std::uint32_t> points_outside(const IndexShape& shape, std::span<const Point> points);

}  // namespace polylidar::tool
