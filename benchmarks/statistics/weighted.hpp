// Medians and means of cases that do not count the same, with intervals. Of equal weights the median and the
// mean are the usual ones.
#pragma once

#include <optional>
#include <vector>

#include "benchmarks/statistics/bootstrap.hpp"

namespace hullbench::statistics {

struct WeightedValue {
  double value = 0;
  double weight = 1;  ///< > 0
};

/// The smallest value up to which more than half of the weight lies; where exactly half does, the mean of it
/// and the next one. Needs one value at least.
double weighted_median(std::vector<WeightedValue> values);

/// Needs one value at least.
double weighted_mean(const std::vector<WeightedValue>& values);

/// Of the median of all values together, when those of one cluster (a shape) belong together: the percentiles
/// of the medians of 2000 samples, each of as many clusters as there are, drawn whole and with their weights
/// (Field and Welsh, Bootstrapping Clustered Data, 2007). The draws are the same each time. Clusters without
/// values do not count; none of fewer than two clusters. Values may be infinite.
std::optional<Interval> weighted_median_interval(const std::vector<std::vector<WeightedValue>>& all);

/// Of the mean likewise: mean +- t sqrt(n / (n - 1) sum of e_c^2) / (sum of w), where e_c is the sum of
/// w (x - mean) over cluster c of n, and t Student's quantile with n - 1 degrees of freedom (Cochran,
/// Sampling Techniques, 1977, chapter 9A).
std::optional<Interval> weighted_mean_interval(const std::vector<std::vector<WeightedValue>>& all);

}  // namespace hullbench::statistics
