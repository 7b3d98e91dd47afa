#include "benchmarks/statistics/judge.hpp"

#include <algorithm>
#include <cstddef>

#include "benchmarks/statistics/rank_test.hpp"
#include "benchmarks/statistics/statistics.hpp"

namespace hullbench::statistics {

Side side_of(const Interval& interval, double limit) {
  if (interval.high <= limit) return Side::kBelow;
  return interval.low >= limit ? Side::kAbove : Side::kUndecided;
}

Side side_of_times(std::span<const std::int64_t> times, std::span<const std::int64_t> others) {
  const auto ratio = ratio_of_times(others, times);
  if (!ratio) return Side::kUndecided;
  if (ratio->interval) {
    // An interval that ends at 1 holds it: equal times are no difference.
    return ratio->p_value >= 1 - kConfidence ? Side::kUndecided : side_of(*ratio->interval, 1);
  }
  const auto [least, most] = std::ranges::minmax_element(times);
  const auto [others_least, others_most] = std::ranges::minmax_element(others);
  const auto factor = [](std::int64_t longer, std::int64_t shorter) {
    return static_cast<double>(longer) / static_cast<double>(shorter);
  };
  if (factor(*others_least, *most) >= kBeyondNoise) return Side::kBelow;
  return factor(*least, *others_most) >= kBeyondNoise ? Side::kAbove : Side::kUndecided;
}

std::vector<Judgement> judge(std::span<const Evidence> evidence, double limit, double level) {
  std::vector<double> p_values;
  p_values.reserve(evidence.size());
  for (const Evidence& one : evidence) p_values.push_back(one.p_value);
  p_values = holm_adjusted(p_values);
  std::vector<Judgement> judgements;
  judgements.reserve(evidence.size());
  for (std::size_t i = 0; i < evidence.size(); ++i) {
    const Side side = p_values[i] <= level ? side_of(evidence[i].interval, limit) : Side::kUndecided;
    judgements.push_back({side, p_values[i]});
  }
  return judgements;
}

}  // namespace hullbench::statistics
