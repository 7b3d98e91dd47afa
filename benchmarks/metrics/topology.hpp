// Whether a result has the right polygons and holes.
#pragma once

#include <cstdint>
#include <optional>

#include "benchmarks/base/names.hpp"

namespace hullbench::metrics {

/// A hole of the result and one of the truth are the same hole when their intersection over union is more
/// than this. Then neither can have another partner, unless a hole lies within a hole.
inline constexpr double kHoleIou = 0.5;

/// A polygon or a hole is a sliver when its area is below this many h^2: of n points spread at random as many
/// are expected on that area, and it stays empty by chance with probability e^-4 = 1.8 %, so that its being
/// there says nothing about the shape.
inline constexpr double kSliverAreaInH2 = 4;

struct ShapeCounts {
  std::int64_t polygons_error = 0;  ///< the result's polygons less the truth's
  std::int64_t holes_error = 0;     ///< the result's holes less the truth's
  std::int64_t slivers = 0;         ///< polygons (whole shells) and holes of the result below kSliverAreaInH2
};

/// Of any shapes, valid or not; h: the nominal spacing of the points.
ShapeCounts count_shape(const MultiPolygon& result, const MultiPolygon& truth, double h);

/// Empty when neither shape has holes; 0 when only one has.
struct HoleScores {
  std::optional<double> precision;  ///< share of the result's holes that are holes of the truth
  std::optional<double> recall;     ///< share of the truth's holes that are holes of the result
  std::optional<double> f1;         ///< harmonic mean of both, 2 matched / (holes of both)
};

/// Matches the holes of two valid shapes one to one, the pair that agrees best first. A hole is all that its
/// ring encloses, a polygon that lies in it too. Throws std::runtime_error when GEOS fails.
HoleScores match_holes(const MultiPolygon& result, const MultiPolygon& truth);

}  // namespace hullbench::metrics
