#include "benchmarks/report/noise.hpp"

#include "benchmarks/statistics/statistics.hpp"

namespace hullbench::report {

bool Noise::is_noisy() const {
  return median_spread > kNoisySpread;
}

std::optional<Noise> measure_noise(const std::vector<record::RunRecord>& runs) {
  constexpr std::size_t kFewest = 3;
  std::vector<double> spreads;
  for (const record::RunRecord& run : runs) {
    if (run.time_ns.size() < kFewest) continue;
    const double middle = statistics::median(run.time_ns);
    if (middle > 0) spreads.push_back(statistics::median_absolute_deviation(run.time_ns) / middle);
  }
  if (spreads.empty()) return std::nullopt;
  return Noise{spreads.size(), statistics::median(spreads), statistics::quantile(spreads, 0.9)};
}

}  // namespace hullbench::report
