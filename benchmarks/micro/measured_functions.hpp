// What core_benchmarks measures: ours, CGAL's and GEOS's functions, by name.
#pragma once

#include <benchmark/benchmark.h>

#include <cstddef>
#include <span>
#include <string_view>

#include "benchmarks/micro/point_sets.hpp"

namespace hullbench::micro {

struct MeasuredFunction {
  std::string_view name;
  void (*run)(benchmark::State&, const SpeedPointSet&);
  /// The most points it is given; the slower ones would take minutes on more.
  std::size_t most_points;
  /// The fewest that it makes sense for, and whether it does for points that are near an outline for the most
  /// part.
  std::size_t least_points = 0;
  bool needs_interior = false;
};

/// `concave_hull` (memory kept between calls), the same with 2 threads, `concave_hull_whole` (by way of all
/// triangles), `concave_hull_perimeter` (a wider limit), `concave_hull_automatic` (its limit chosen from the
/// points), `concave_hull_once` (fresh memory at every call) and the three steps of the whole way,
/// `triangulation`, `regions` and `polygons`.
std::span<const MeasuredFunction> own_functions();
/// The phases of concave_hull_perimeter where the interior is left out, by number: `phase_1_coordinates` and
/// so on. `phase_2_windows` is of a chosen limit only.
std::span<const MeasuredFunction> own_phases();
/// `cgal_delaunay` and `cgal_alpha_shape`.
std::span<const MeasuredFunction> cgal_functions();
/// `geos_delaunay`, `geos_concave_hull` and `geos_concave_hull_with_holes`.
std::span<const MeasuredFunction> geos_functions();

}  // namespace hullbench::micro
