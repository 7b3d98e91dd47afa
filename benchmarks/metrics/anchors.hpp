// The two ends of the scale of skill: what anyone can do with a sample, and what the sample could give at
// best.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "benchmarks/base/names.hpp"
#include "benchmarks/metrics/prepared_truth.hpp"

namespace hullbench::metrics {

/// l2 of two shapes made of a case's points. With fewer than 3 points, or all on a line, both shapes are
/// empty and both are 1.
struct Anchors {
  double l2_convex_hull = 1;  ///< of the points' convex hull: skill 0
  /// Of the union of the Delaunay triangles whose centroid lies in the ground truth or on its boundary:
  /// skill 1.
  double l2_best_triangles = 1;
};

/// `prepared` is `truth`. Throws as polylidar::delaunay, and std::runtime_error when GEOS fails.
Anchors find_anchors(std::span<const Point> points, const MultiPolygon& truth, const PreparedTruth& prepared);

/// (l2_convex_hull - l2) / (l2_convex_hull - l2_best_triangles): 0 for the convex hull, 1 for the best
/// triangles, negative for worse than the hull, above 1 for better than the triangles. Empty when the hull is
/// worse than the triangles by no more than 1 / `points`, the part of the area that one point stands for: a
/// sample does not tell less, and dividing by it would blow up what is chance.
std::optional<double> skill(const std::optional<double>& l2, const Anchors& anchors, std::size_t points);

}  // namespace hullbench::metrics
