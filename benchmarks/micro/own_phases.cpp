// The phases of a hull whose interior is left out, each by itself. What a phase needs of those before it is
// made once.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
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

enum class LimitBy { kPerimeter, kChoice };

/// All phases up to the rings, with the perimeter of concave_hull_perimeter or a chosen limit.
struct Phases {
  Phases(const SpeedPointSet& from, LimitBy limit_by) : set(from) {
    const bool is_chosen = limit_by == LimitBy::kChoice;
    limits.max_perimeter = 6.2 * set.alpha;
    range = measure_coordinates(set.points, pool);
    if (is_chosen && look() == SizesBy::kBlocks) return;
    const double radius = is_chosen ? chosen.wide_radius() : least_dropped_radius(limits);
    if (part.choose(set.points, range, radius, false, InteriorGuard(), pool)) return;
    triangulate();
    for (std::size_t v = 0; v < part.points().size(); ++v) {
      const std::uint32_t point = builder.caller_index()[v];
      is_tested.push_back(part.is_uncertain()[point]);
      caller_index.push_back(part.caller_index()[point]);
    }
    if (is_chosen) choose_limit();
    const auto why = is_chosen ? filter_by_size() : filter_triangles();
    is_left_out = !why || why == polylidar::Way::kReachesFar;  // then the part is enlarged
  }

  SizesBy look() { return chosen.look(passes_over(set.points, pool), range.box, pool); }
  void triangulate() { builder.build(part.points(), range, pool); }
  std::optional<polylidar::Way> filter_triangles() {
    return filter.run_on_part(builder.mesh(), builder.vertices(), is_tested.data(), filter_rules(limits),
                              false, pool, boundary);
  }
  void choose_limit() { chosen.choose_found(builder, is_tested.data(), 1, pool); }
  std::optional<polylidar::Way> filter_by_size() {
    const auto is_sure = [&](const Triangle& triangle) { return part.is_surely_whole(triangle); };
    return filter.run_on_part(builder.mesh(), builder.vertices(), is_tested.data(), chosen.field(), is_sure,
                              true, pool, boundary);
  }
  void trace() {
    tracer.trace(builder.mesh(), builder.vertices(), caller_index.size(), caller_index.data(), boundary,
                 shape);
  }

  const SpeedPointSet& set;
  polylidar::Limits limits;
  ThreadPool pool;
  CoordinateRange range;
  AutomaticLimit chosen;
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
template <LimitBy limit_by, typename Work, typename Prepare>
void measure_phase(benchmark::State& state, const SpeedPointSet& set, const Work& work,
                   const Prepare& prepare) {
  Phases phases(set, limit_by);
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

template <LimitBy limit_by = LimitBy::kPerimeter, typename Work>
void measure_phase(benchmark::State& state, const SpeedPointSet& set, const Work& work) {
  measure_phase<limit_by>(state, set, work, [](Phases&) {});
}

void coordinates(benchmark::State& state, const SpeedPointSet& set) {
  measure_phase(state, set,
                [](Phases& p) { benchmark::DoNotOptimize(measure_coordinates(p.set.points, p.pool)); });
}

template <LimitBy limit_by>
void windows(benchmark::State& state, const SpeedPointSet& set) {
  measure_phase<limit_by>(state, set, [](Phases& p) { benchmark::DoNotOptimize(p.look()); });
}

/// Where leaving the interior out does not pay: how long it takes to find that out.
void guard(benchmark::State& state, const SpeedPointSet& set) {
  ThreadPool pool;
  const CoordinateRange range = measure_coordinates(set.points, pool);
  InteriorPart part;
  const auto gives_up = [&] {
    return part.choose(set.points, range, set.alpha, true, InteriorGuard(), pool).has_value();
  };
  if (!gives_up()) {
    state.SkipWithError("the interior of these points is left out");
    return;
  }
  measure(state, set, 0, Memory::kNotCounted, [&] {
    benchmark::DoNotOptimize(gives_up());
    return set.points.size();
  });
}

void cells(benchmark::State& state, const SpeedPointSet& set) {
  measure_phase(state, set, [](Phases& p) { p.part.fill_cells(p.set.points, p.pool); });
}

void certified_cells(benchmark::State& state, const SpeedPointSet& set) {
  measure_phase(state, set, [](Phases& p) { p.part.find_uncertain_cells(p.pool); });
}

/// The search itself; which cells points share is known.
void close_pairs(benchmark::State& state, const SpeedPointSet& set) {
  ThreadPool pool;
  const double radius = (1 - kSafety) * (1 - kUneven) * set.alpha;
  const Grid grid(measure_coordinates(set.points, pool).box, kRadius / radius);
  std::vector<std::uint32_t> cells(set.points.size());
  number_cells(set.points, grid.numbering(), cells.data());
  Bitmap occupied;
  Bitmap shared;
  occupied.clear(grid.word_count());
  shared.clear(grid.word_count());
  for (const std::uint32_t cell : cells) {
    if (occupied.test(cell)) shared.set(cell);
    occupied.set(cell);
  }
  ClosePairs pairs;
  measure(state, set, 0, Memory::kNotCounted, [&] {
    benchmark::DoNotOptimize(
        pairs.may_exist(set.points, grid, cells.data(), shared, kTooClose * radius, pool));
    return set.points.size();
  });
}

void certified_points(benchmark::State& state, const SpeedPointSet& set) {
  measure_phase<LimitBy::kPerimeter>(
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

void chosen_limit(benchmark::State& state, const SpeedPointSet& set) {
  measure_phase<LimitBy::kChoice>(state, set, [](Phases& p) { p.choose_limit(); });
}

void filter(benchmark::State& state, const SpeedPointSet& set) {
  measure_phase(state, set, [](Phases& p) { p.filter_triangles(); });
}

void chosen_filter(benchmark::State& state, const SpeedPointSet& set) {
  measure_phase<LimitBy::kChoice>(state, set, [](Phases& p) { p.filter_by_size(); });
}

/// Round a few triangles from all over the mesh, whether or not that is necessary.
void enlargement(benchmark::State& state, const SpeedPointSet& set) {
  std::vector<Mesh::Index> triangles;
  const auto take_some = [&](Phases& p) {
    constexpr Mesh::Index kAbout = 16;
    const Mesh& mesh = p.builder.mesh();
    for (Mesh::Index t = 0; t < mesh.triangle_count(); t += mesh.triangle_count() / kAbout + 1) {
      if (!mesh.is_ghost(t)) triangles.push_back(t);
    }
  };
  measure_phase<LimitBy::kChoice>(
      state, set, [&](Phases& p) { p.part.reach_round(triangles, p.builder, p.set.points, p.pool); },
      take_some);
}

void rings(benchmark::State& state, const SpeedPointSet& set) {
  measure_phase(state, set, [](Phases& p) { p.trace(); });
}

constexpr std::size_t kMostPoints = 1'000'000;
constexpr std::size_t kLeastPoints = 8'000;
constexpr std::string_view kWithInterior[] = {"airborne", "ca", "lattice", "rgbd", "uniform"};
constexpr std::string_view kAtRandom[] = {"ca", "uniform"};
constexpr std::string_view kVaried[] = {"gradient"};
constexpr std::string_view kChosen[] = {"ca", "gradient", "uniform"};
constexpr std::string_view kMuchOutline[] = {"circle", "parabola", "repeats", "repeats8", "tight"};
constexpr MeasuredFunction kFunctions[] = {
    {"phase_1_coordinates", &coordinates, kMostPoints, kLeastPoints, kWithInterior},
    {"phase_2_windows", &windows<LimitBy::kPerimeter>, kMostPoints, kLeastPoints, kWithInterior},
    {"phase_2_places", &windows<LimitBy::kChoice>, kMostPoints, kMostPoints, kVaried},
    {"phase_3_guard", &guard, kMostPoints, kLeastPoints, kMuchOutline},
    {"phase_3_cells", &cells, kMostPoints, kLeastPoints, kWithInterior},
    {"phase_4_certified_cells", &certified_cells, kMostPoints, kLeastPoints, kWithInterior},
    {"phase_4_close_pairs", &close_pairs, kMostPoints, kLeastPoints, kAtRandom},
    {"phase_5_certified_points", &certified_points, kMostPoints, kLeastPoints, kWithInterior},
    {"phase_6_gather", &gather, kMostPoints, kLeastPoints, kWithInterior},
    {"phase_7_triangulation", &triangulation, kMostPoints, kLeastPoints, kWithInterior},
    {"phase_8_chosen_limit", &chosen_limit, kMostPoints, kMostPoints, kChosen},
    {"phase_8_filter", &filter, kMostPoints, kLeastPoints, kWithInterior},
    {"phase_8_chosen_filter", &chosen_filter, kMostPoints, kMostPoints, kChosen},
    {"phase_8_enlargement", &enlargement, kMostPoints, kMostPoints, kChosen},
    {"phase_9_rings", &rings, kMostPoints, kLeastPoints, kWithInterior}};

}  // namespace

std::span<const MeasuredFunction> own_phases() {
  return kFunctions;
}

}  // namespace hullbench::micro
