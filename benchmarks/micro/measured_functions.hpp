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
  /// The fewest that it makes sense for.
  std::size_t least_points = 0;
  /// The point sets that it makes sense for; all if empty.
  std::span<const std::string_view> sets = {};
};

/// `concave_hull` (memory kept between calls), `concave_hull_whole` (by way of all triangles),
/// `concave_hull_perimeter` (a wider limit), `concave_hull_automatic` (its limit chosen from the points), the
/// first and the last also with 2 threads (`concave_hull_2_threads`, `concave_hull_auto_2_threads`),
/// `concave_hull_once` (fresh memory at every call), `two_hulls_at_once` (by two threads) and the three steps
/// of the whole way, `triangulation`, `regions` and `polygons`.
std::span<const MeasuredFunction> own_functions();
/// The phases of a hull whose interior is left out, numbered as they come: `phase_1_coordinates` and so on,
/// with the limit of concave_hull_perimeter. Those that only other limits have share a number with what they
/// come beside: `phase_2_windows`, `phase_2_places` (windows of places), `phase_8_chosen_limit`,
/// `phase_8_chosen_filter` and `phase_8_enlargement` are of a chosen limit, `phase_4_close_pairs` is of a
/// limit on circumradii. `phase_3_guard` is all that is done until leaving the interior out is given up.
std::span<const MeasuredFunction> own_phases();
/// `cgal_delaunay` and `cgal_alpha_shape`.
std::span<const MeasuredFunction> cgal_functions();
/// `geos_delaunay`, `geos_concave_hull` and `geos_concave_hull_with_holes`.
std::span<const MeasuredFunction> geos_functions();

}  // namespace hullbench::micro
