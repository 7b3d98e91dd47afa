// The core by itself, whole and step by step, beside CGAL's triangulation of the same points in the same
// process.
//
// Read ratios of medians of one run with interleaved repetitions, never a single time:
//   build/core_benchmarks --benchmark_repetitions=15 --benchmark_enable_random_interleaving=true
//       --benchmark_report_aggregates_only=true
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <benchmark/benchmark.h>

#include <cstddef>
#include <map>
#include <string>
#include <utility>

#include "benchmarks/micro/point_sets.hpp"
#include "polylidar/concave_hull.hpp"

namespace hullbench {
namespace {

const SpeedPointSet& point_set(const std::string& name, std::size_t n) {
  static std::map<std::pair<std::string, std::size_t>, SpeedPointSet> made;
  const auto key = std::pair{name, n};
  if (const auto found = made.find(key); found != made.end()) return found->second;
  return made.emplace(key, make_speed_point_set(name, n)).first->second;
}

void count_points(benchmark::State& state, std::size_t n) {
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(n));
}

/// Points to polygons with memory that is kept between calls.
void concave_hull(benchmark::State& state, const SpeedPointSet& set) {
  polylidar::Extractor extractor;
  for (auto _ : state) {
    benchmark::DoNotOptimize(extractor.extract(set.points, {.alpha = set.alpha}).vertices.data());
  }
  count_points(state, set.points.size());
}

/// Points to polygons with memory that is fresh at every call.
void concave_hull_once(benchmark::State& state, const SpeedPointSet& set) {
  for (auto _ : state) {
    benchmark::DoNotOptimize(polylidar::concave_hull(set.points, {.alpha = set.alpha}).vertices.data());
  }
  count_points(state, set.points.size());
}

void triangulation(benchmark::State& state, const SpeedPointSet& set) {
  polylidar::Extractor extractor;
  for (auto _ : state) extractor.triangulate(set.points);
  count_points(state, set.points.size());
}

void cgal_delaunay(benchmark::State& state, const SpeedPointSet& set) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::vector<Kernel::Point_2> points;
  points.reserve(set.points.size());
  for (const polylidar::Point& p : set.points) points.emplace_back(p.x, p.y);
  for (auto _ : state) {
    CGAL::Delaunay_triangulation_2<Kernel> delaunay;
    delaunay.insert(points.begin(), points.end());
    benchmark::DoNotOptimize(delaunay.number_of_faces());
  }
  count_points(state, set.points.size());
}

void register_benchmarks() {
  using Function = void (*)(benchmark::State&, const SpeedPointSet&);
  const std::pair<const char*, Function> functions[] = {{"concave_hull", &concave_hull},
                                                        {"concave_hull_once", &concave_hull_once},
                                                        {"triangulation", &triangulation},
                                                        {"cgal_delaunay", &cgal_delaunay}};
  for (const char* set : {"ca", "uniform", "lattice", "rgbd"}) {
    for (const std::size_t n : {2000U, 8000U, 64000U, 1000000U}) {
      for (const auto& [name, function] : functions) {
        const std::string full_name = std::string(name) + "/" + set + "/" + std::to_string(n);
        benchmark::RegisterBenchmark(full_name.c_str(), [=, function = function](benchmark::State& state) {
          function(state, point_set(set, n));
        })->Unit(benchmark::kMicrosecond);
      }
    }
  }
}

}  // namespace
}  // namespace hullbench

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  hullbench::register_benchmarks();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
