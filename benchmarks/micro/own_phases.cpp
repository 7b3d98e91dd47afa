// The phases of a hull whose interior is left out, each by itself. What a phase needs of those before it is
// made once.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "benchmarks/micro/measure.hpp"
#include "benchmarks/micro/measured_functions.hpp"
#include "core/src/automatic_limit.hpp"
#include "core/src/boundary.hpp"
#include "core/src/coordinate_range.hpp"
#include "core/src/delaunay_builder.hpp"
#include "core/src/filter_rules.hpp"
#include "core/src/interior.hpp"
#include "core/src/region.hpp"
#include "core/src/thread_pool.hpp"

namespace hullbench::micro {
namespace {

using namespace polylidar::detail;

/// All phases up to the rings, with the perimeter of concave_hull_perimeter.
struct Phases {
  explicit Phases(const SpeedPointSet& from) : set(from) {
    limits.max_perimeter = 6.2 * set.alpha;
    range = measure_coordinates(set.points, pool);
    is_left_out = !part.choose(set.points, range, least_dropped_radius(limits), false, InteriorGuard(), pool)
                       .has_value();
    if (!is_left_out) return;
    triangulate();
    for (std::size_t v = 0; v < part.points().size(); ++v) {
      const std::uint32_t point = builder.caller_index()[v];
      is_tested.push_back(part.is_uncertain()[point]);
      caller_index.push_back(part.caller_index()[point]);
    }
    is_left_out = !filter_triangles().has_value();
  }

  void triangulate() { builder.build(part.points(), range, pool); }
  std::optional<polylidar::Way> filter_triangles() {
    return filter.run_on_part(builder.mesh(), builder.vertices(), is_tested.data(), filter_rules(limits),
                              false, pool, boundary);
  }
  void trace() {
    tracer.trace(builder.mesh(), builder.vertices(), caller_index.size(), caller_index.data(), boundary,
                 shape);
  }

  const SpeedPointSet& set;
  polylidar::Limits limits;
  ThreadPool pool;
  CoordinateRange range;
  InteriorPart part;
  bool is_left_out = false;
  DelaunayBuilder builder;
  std::vector<std::uint8_t> is_tested;
  std::vector<std::uint32_t> caller_index;
  RegionFilter filter;
  std::vector<Mesh::Index> boundary;
  BoundaryTracer tracer;
  polylidar::IndexedMultiPolygon shape;
};

/// Measures work(phases) where the interior is left out; prepare(phases) is done once before.
template <typename Work, typename Prepare>
void measure_phase(benchmark::State& state, const SpeedPointSet& set, const Work& work,
                   const Prepare& prepare) {
  Phases phases(set);
  if (!phases.is_left_out) {
    state.SkipWithError("the interior of these points is not left out");
    return;
  }
  prepare(phases);
  measure(state, set, 0, Memory::kNotCounted, [&] {
    work(phases);
    return set.points.size();
  });
}

template <typename Work>
void measure_phase(benchmark::State& state, const SpeedPointSet& set, const Work& work) {
  measure_phase(state, set, work, [](Phases&) {});
}

void coordinates(benchmark::State& state, const SpeedPointSet& set) {
  measure_phase(state, set,
                [](Phases& p) { benchmark::DoNotOptimize(measure_coordinates(p.set.points, p.pool)); });
}

/// Of a limit that is chosen only.
void windows(benchmark::State& state, const SpeedPointSet& set) {
  AutomaticLimit limit;
  measure_phase(state, set, [&](Phases& p) {
    benchmark::DoNotOptimize(limit.look(passes_over(p.set.points, p.pool), p.range.box, p.pool));
  });
}

void cells(benchmark::State& state, const SpeedPointSet& set) {
  measure_phase(state, set, [](Phases& p) { p.part.fill_cells(p.set.points, p.pool); });
}

void certified_cells(benchmark::State& state, const SpeedPointSet& set) {
  measure_phase(state, set, [](Phases& p) { p.part.find_uncertain_cells(p.pool); });
}

void certified_points(benchmark::State& state, const SpeedPointSet& set) {
  measure_phase(
      state, set, [](Phases& p) { p.part.find_uncertain_points(p.set.points, p.pool); },
      [](Phases& p) { p.part.find_uncertain_cells(p.pool); });
}

void gather(benchmark::State& state, const SpeedPointSet& set) {
  measure_phase(state, set, [](Phases& p) {
    p.part.mark_reach(p.pool);
    p.part.gather(p.set.points, p.pool);
  });
}

void triangulation(benchmark::State& state, const SpeedPointSet& set) {
  measure_phase(state, set, [](Phases& p) { p.triangulate(); });
}

void filter(benchmark::State& state, const SpeedPointSet& set) {
  measure_phase(state, set, [](Phases& p) { p.filter_triangles(); });
}

void rings(benchmark::State& state, const SpeedPointSet& set) {
  measure_phase(state, set, [](Phases& p) { p.trace(); });
}

constexpr std::size_t kMostPoints = 1'000'000;
constexpr std::size_t kLeastPoints = 8'000;
constexpr MeasuredFunction kFunctions[] = {
    {"phase_1_coordinates", &coordinates, kMostPoints, kLeastPoints, true},
    {"phase_2_windows", &windows, kMostPoints, kLeastPoints, true},
    {"phase_3_cells", &cells, kMostPoints, kLeastPoints, true},
    {"phase_4_certified_cells", &certified_cells, kMostPoints, kLeastPoints, true},
    {"phase_5_certified_points", &certified_points, kMostPoints, kLeastPoints, true},
    {"phase_6_gather", &gather, kMostPoints, kLeastPoints, true},
    {"phase_7_triangulation", &triangulation, kMostPoints, kLeastPoints, true},
    {"phase_8_filter", &filter, kMostPoints, kLeastPoints, true},
    {"phase_9_rings", &rings, kMostPoints, kLeastPoints, true}};

}  // namespace

std::span<const MeasuredFunction> own_phases() {
  return kFunctions;
}

}  // namespace hullbench::micro
