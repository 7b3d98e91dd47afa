#include "benchmarks/statistics/judge.hpp"

#include <cstddef>

#include "benchmarks/statistics/statistics.hpp"

namespace hullbench::statistics {

Side side_of(const Interval& interval, double limit) {
  if (interval.high <= limit) return Side::kBelow;
  return interval.low >= limit ? Side::kAbove : Side::kUndecided;
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
