// Boundary IoU: how well two shapes agree close to their boundaries.
#pragma once

#include <optional>

#include "benchmarks/metrics/geos_session.hpp"

namespace hullbench::metrics {

/// Width of the bands in nominal spacings h: what a sample leaves open at its edge, about h, is a half of it.
inline constexpr double kBandWidthInH = 2;

/// The part of the valid `shape` that is less than `width` from its boundary. GEOS draws arcs as 8 chords a
/// quarter and leaves out bends of 1 % of the width, so the band ends within about 1 % of the width.
GeosSession::Geometry inner_band(const GeosSession& geos, const GeosSession::Geometry& shape, double width);

/// Intersection over union of two bands, or of any two valid shapes. Empty when both are.
std::optional<double> band_iou(const GeosSession& geos, const GeosSession::Geometry& a,
                               const GeosSession::Geometry& b);

}  // namespace hullbench::metrics
