// The core by itself, whole and step by step.
#include <atomic>
#include <barrier>
#include <thread>

#include "benchmarks/micro/measure.hpp"
#include "benchmarks/micro/measured_functions.hpp"
#include "polylidar/concave_hull.hpp"

namespace hullbench::micro {
namespace {

template <unsigned threads>
void concave_hull(benchmark::State& state, const SpeedPointSet& set) {
  polylidar::Extractor extractor;
  measure(state, set, set.polygons, Memory::kCounted, [&] {
    return extractor.extract(set.points, {.alpha = set.alpha, .threads = threads}).polygon_count();
  });
}

/// Two hulls of one thread each at the same time: how much longer than one of them it takes is what two cores
/// of this machine share, whatever the code does.
void two_hulls_at_once(benchmark::State& state, const SpeedPointSet& set) {
  std::barrier<> begin(2);
  std::barrier<> end(2);
  std::atomic<bool> is_over = false;
  std::thread other([&] {
    polylidar::Extractor extractor;
    for (begin.arrive_and_wait(); !is_over; begin.arrive_and_wait()) {
      extractor.extract(set.points, {.alpha = set.alpha});
      end.arrive_and_wait();
    }
  });
  polylidar::Extractor extractor;
  measure(state, set, set.polygons, Memory::kNotCounted, [&] {
    begin.arrive_and_wait();
    const std::size_t polygons = extractor.extract(set.points, {.alpha = set.alpha}).polygon_count();
    end.arrive_and_wait();
    return polygons;
  });
  is_over = true;
  begin.arrive_and_wait();
  other.join();
}

/// With a perimeter about where the automatic limit lies: 12.4 times the spacing of the points.
void concave_hull_perimeter(benchmark::State& state, const SpeedPointSet& set) {
  polylidar::Extractor extractor;
  measure(state, set, 0, Memory::kCounted,
          [&] { return extractor.extract(set.points, {.max_perimeter = 6.2 * set.alpha}).polygon_count(); });
}

/// As concave_hull, but by way of all triangles.
void concave_hull_whole(benchmark::State& state, const SpeedPointSet& set) {
  polylidar::Extractor extractor;
  measure(state, set, set.polygons, Memory::kCounted, [&] {
    extractor.triangulate(set.points);
    extractor.extract_regions({.alpha = set.alpha});
    return extractor.extract_polygons().polygon_count();
  });
}

/// With the limit that is chosen from the points; how many polygons that gives is not known beforehand.
template <unsigned threads>
void concave_hull_automatic(benchmark::State& state, const SpeedPointSet& set) {
  polylidar::Extractor extractor;
  measure(state, set, 0, Memory::kCounted,
          [&] { return extractor.extract(set.points, {.threads = threads}).polygon_count(); });
}

void concave_hull_once(benchmark::State& state, const SpeedPointSet& set) {
  measure(state, set, set.polygons, Memory::kCounted,
          [&] { return polylidar::concave_hull(set.points, {.alpha = set.alpha}).polygon_count(); });
}

void triangulation(benchmark::State& state, const SpeedPointSet& set) {
  polylidar::Extractor extractor;
  // What a triangulation made shows only in what comes of it.
  const std::size_t polygons = extractor.extract(set.points, {.alpha = set.alpha}).polygon_count();
  measure(state, set, set.polygons, Memory::kNotCounted, [&] {
    extractor.triangulate(set.points);
    return polygons;
  });
}

// The later steps can be repeated after one triangulation.
void regions(benchmark::State& state, const SpeedPointSet& set) {
  polylidar::Extractor extractor;
  const std::size_t polygons = extractor.extract(set.points, {.alpha = set.alpha}).polygon_count();
  measure(state, set, set.polygons, Memory::kNotCounted, [&] {
    extractor.extract_regions({.alpha = set.alpha});
    return polygons;
  });
}

void polygons(benchmark::State& state, const SpeedPointSet& set) {
  polylidar::Extractor extractor;
  extractor.triangulate(set.points);
  extractor.extract_regions({.alpha = set.alpha});
  measure(state, set, set.polygons, Memory::kNotCounted,
          [&] { return extractor.extract_polygons().polygon_count(); });
}

constexpr std::size_t kMostPoints = 10'000'000;
constexpr MeasuredFunction kFunctions[] = {
    {"concave_hull", &concave_hull<1>, kMostPoints},
    {"concave_hull_2_threads", &concave_hull<2>, kMostPoints},
    {"two_hulls_at_once", &two_hulls_at_once, 1'000'000},
    {"concave_hull_automatic", &concave_hull_automatic<1>, kMostPoints},
    {"concave_hull_auto_2_threads", &concave_hull_automatic<2>, kMostPoints},
    {"concave_hull_perimeter", &concave_hull_perimeter, kMostPoints},
    {"concave_hull_whole", &concave_hull_whole, kMostPoints},
    {"concave_hull_once", &concave_hull_once, 1'000'000},
    {"triangulation", &triangulation, 1'000'000},
    {"regions", &regions, 1'000'000},
    {"polygons", &polygons, 1'000'000}};

}  // namespace

std::span<const MeasuredFunction> own_functions() {
  return kFunctions;
}

}  // namespace hullbench::micro
