// What is quoted first of a run: the fastest rival that gives the same polygons.
#pragma once

#include "benchmarks/base/names.hpp"
#include "benchmarks/report/measurements.hpp"

namespace hullbench::report {

/// How far areas and errors of the same polygons may lie apart, as a part of the larger one. The same shape
/// written in another order differs by the rounding of its area, some 1e-13 of it; other triangles differ by
/// more than a part in a million.
inline constexpr double kSamePolygons = 1e-9;

/// Whether two methods gave the same polygons on every case that both solved, of which there must be one: the
/// same number of polygons, holes and vertices, and area and l2 equal to within kSamePolygons. It is decided
/// from the records, never from a list of methods.
bool same_polygons(const Measurements& measurements, const Line& one, const Line& other);

/// The member `headline` of a report's summary: the times of the reference method's rivals over its own.
///   {"reference": {"method", "protocol"}, "rivals": [...]}
/// A rival is {"method", "protocol", "same_polygons", "cases", "failures", "median", "low", "high", "least",
/// "most"} (see Ratios; null: infinite, or no interval), the paper's rival with "does_more", a sentence.
/// First stands the one with the least median of those that give the same polygons, if there is one; then
/// those of them that are not slower than it beyond doubt; then the paper's rival, if it is another one. Who
/// failed in most of its cases cannot be the fastest; who was measured on few cases can. null: there are no
/// times, the reference has no result, or nobody is beside it.
json make_headline(const Measurements& measurements);

}  // namespace hullbench::report
