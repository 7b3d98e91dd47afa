// A shape for each group of points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "polylidar/concave_hull.hpp"
#include "polylidar/widened_hull.hpp"
#include "tool/shapes/index_shape.hpp"

namespace polylidar::tool {

/// What is done to the core's shape, in this order.
struct HullOptions {
  /// Of the core; `threads` is not used here.
  Options core = {};
  Wanted wanted = {};
  std::size_t min_triangles = 0;  ///< polygons of fewer Delaunay triangles are dropped
  double min_area = 0;            ///< squared units; smaller holes are filled, then smaller polygons dropped
  std::optional<std::size_t> max_parts = {};  ///< only so many polygons are kept, the largest
  double simplify = 0;                        ///< how far the outline may move; 0: not at all
  Latitude latitude = {};                     ///< of the points; areas are then those on the sphere
};

/// The shape of one group.
struct GroupHull {
  std::vector<std::uint32_t> members;  ///< indices into all points, ascending; empty: all of them
  IndexShape shape;                    ///< indices into all points
  std::size_t points = 0;
  std::size_t extracted = 0;   ///< polygons before any was dropped
  double area = 0;             ///< of the shape, in squared units, of degrees on the sphere
  bool has_triangles = false;  ///< there are three distinct points that are not on a line
  Options limits;              ///< what the limits that were given became
  std::optional<ChosenSizes> sizes;
  bool by_outlines = false;  ///< Statistics::by_outlines: no size decided
};

/// Drops and fills what `options` says by area and number, and simplifies what is left.
void clean(IndexShape& shape, std::span<const Point> points, const HullOptions& options);

/// Told what is done, such as "group 3 of 10", by one thread at a time; what it throws ends the work.
using OnStep = std::function<void(const std::string& doing)>;

/// One hull for each of `group_count` groups; groups[i] is that of point i; no groups at all: all points are
/// one. Groups with many points have all `threads` >= 1 to themselves, the others share them. `on_step` is
/// told of each group that is done; without groups, of the steps to the hull. Coordinates must be finite;
/// throws std::invalid_argument where a group's span more than concave_hull() takes.
std::vector<GroupHull> group_hulls(std::span<const Point> points, std::span<const std::uint32_t> groups,
                                   std::size_t group_count, const HullOptions& options, unsigned threads,
                                   const OnStep& on_step = {});

}  // namespace polylidar::tool
