// How well a median is known: percentile bootstrap intervals (Efron and Tibshirani, An Introduction to the
// Bootstrap, 1993, chapter 13), from the exact distribution over all resamples instead of some random ones.
//
// Of an even number of values the median lies between two middle ones. The lower end is taken from the
// distribution of the lower one, the upper end from that of the upper one: that interval contains the one of
// their mean, and like the one of an odd number it ends at values that were measured.
//
// Above 100 clusters the number of resampled values below another one is taken as normal.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hullbench::statistics {

/// What every interval here is meant to cover. An interval of few values covers less: of three values it is
/// their range, which has the true median in 3 of 4 cases, of five in 15 of 16; from nine on it is close.
inline constexpr double kConfidence = 0.95;

/// Both ends belong to it; in the unit of the values.
struct Interval {
  double low = 0;
  double high = 0;
};

/// Of the median of independent values. None of fewer than two values.
std::optional<Interval> median_interval(std::span<const std::int64_t> values);

/// Of one case: its values by pass, then round. What was measured in one pass belongs together.
using Passes = std::vector<std::vector<double>>;

/// Of the median over all cases of the median of each, when the cases of one cluster (a shape) belong
/// together: whole clusters are resampled, as many as there are, and in each case anew its passes and in each
/// of these its rounds, as many as there are. So it has what varies between shapes, between passes and
/// between rounds; of a single cluster it has the last two only. Values may be infinite. Passes, cases and
/// clusters without values do not count; none of fewer than two values.
std::optional<Interval> nested_median_interval(const std::vector<std::vector<Passes>>& all);

/// Of the median of all values together, when those of one cluster (a shape) belong together: whole clusters
/// are resampled, as many as there are (Field and Welsh, Bootstrapping Clustered Data, 2007). Clusters
/// without values do not count; none of fewer than two clusters. Clusters of a single value give what
/// median_interval gives.
std::optional<Interval> clustered_median_interval(const std::vector<std::vector<double>>& clusters);

}  // namespace hullbench::statistics
