// How steady the times of a run are: what its repetitions tell of the machine.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "benchmarks/record/record.hpp"

namespace hullbench::report {

/// The spread of a row is the median absolute deviation of its times (run + extract) over their median.
struct Noise {
  std::size_t rows = 0;      ///< that have a spread: 3 repetitions or more
  double median_spread = 0;  ///< over these rows
  double ninth_decile = 0;   ///< nine of ten rows have at most this spread
  bool is_noisy() const;     ///< whether the median spread is above kNoisySpread
};

/// An idle machine of our own shows 1 to 2 % on work of milliseconds; above, differences of some per cent are
/// nothing to go by.
inline constexpr double kNoisySpread = 0.03;

/// Empty when no row has 3 repetitions.
std::optional<Noise> measure_noise(const std::vector<record::RunRecord>& runs);

}  // namespace hullbench::report
