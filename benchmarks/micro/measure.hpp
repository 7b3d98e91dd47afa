// How every function of core_benchmarks is measured.
#pragma once

#include <benchmark/benchmark.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>

#include "benchmarks/micro/counted_memory.hpp"
#include "benchmarks/micro/point_sets.hpp"

namespace hullbench::micro {

/// The counter of the memory that a first call holds at its peak, in bytes a point beyond the caller's
/// points; as CountedMemory counts.
inline constexpr char kPeakBytesPerPoint[] = "peak_bytes_per_point";

/// Whether a first call's memory says what the function needs: not where it continues another one's work.
enum class Memory { kCounted, kNotCounted };

/// Times `call`, which returns how many things (polygons, faces, edges) it made of `set`. A first call is not
/// timed: it warms up what is kept between calls, its memory is counted, and when it made nothing, or not
/// `expected` things (0: any number above 0), the benchmark fails instead of having a time. `release`, if
/// given, gives back before each call what the one before has made, and is not timed: nobody pays for that.
template <typename Call, typename Release = std::nullptr_t>
void measure(benchmark::State& state, const SpeedPointSet& set, std::size_t expected, Memory memory,
             const Call& call, const Release& release = nullptr) {
  std::size_t made = 0;
  {
    const CountedMemory counted;
    made = call();
    if (memory == Memory::kCounted) {
      state.counters[kPeakBytesPerPoint] =
          static_cast<double>(counted.peak()) / static_cast<double>(set.points.size());
    }
  }
  if (made == 0 || (expected != 0 && made != expected)) {
    const std::string error = "made " + std::to_string(made) + " where " +
                              (expected == 0 ? "some" : std::to_string(expected)) + " were expected";
    state.SkipWithError(error.c_str());
    return;
  }
  for (auto _ : state) {
    if constexpr (!std::is_null_pointer_v<Release>) {
      state.PauseTiming();
      release();
      state.ResumeTiming();
    }
    benchmark::DoNotOptimize(made = call());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(set.points.size()));
}

}  // namespace hullbench::micro
