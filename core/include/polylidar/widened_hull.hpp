// Hulls that leave no point outside, or are one polygon: the limit is widened until they do.
#pragma once

#include <functional>
#include <span>

#include "polylidar/concave_hull.hpp"

namespace polylidar {

/// A hull, and the limit that gave it.
struct WidenedHull {
  IndexedMultiPolygon shape;  ///< by indices into the points
  /// The caller's, with wider limits, or with less detail if none was given.
  Options options;
};

/// The hull of `points` with the least limit that gives what is wanted, to a thousandth. All limits that are
/// given are widened by one factor; if none is given, `detail` is divided by it. Doubling and halving finds a
/// factor for which it holds. It is the least one if wider limits lose no triangle: that is so if limits are
/// given. If the core chooses them, it may drop a small region once another one has grown. Beyond a factor of
/// 2^60 the shape is the convex hull, and what was given is kNoLimit, or alpha if nothing was. If one polygon
/// is wanted and the caller's limit keeps no triangle, the polygon covers all points. The shape is empty if
/// all points lie on a line.
///
/// O(n log n). All points are triangulated, once; then there are about 20 steps, each of which makes a shape.
/// `on_step` is called before each step; what it throws ends the work. Afterwards `extractor` is as after
/// extract_polygons() with WidenedHull::options, so chosen_sizes() tells the sizes. Throws as concave_hull.
WidenedHull widened_hull(Extractor& extractor, std::span<const Point> points, const Options& options,
                         const Wanted& wanted, const std::function<void()>& on_step = {});

}  // namespace polylidar
