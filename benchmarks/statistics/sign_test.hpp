// What the gate on speed and core_benchmarks --verdicts conclude from the log-ratios of its blocks: no
// assumption but that blocks are independent and each is as likely above the true median as below.
#pragma once

#include <span>

#include "benchmarks/statistics/bootstrap.hpp"

namespace hullbench::statistics {

/// The narrowest symmetric pair of order statistics that holds the median of what `values` were drawn from
/// with at least `confidence` in (0, 1): the interval of the sign test (Thompson 1936). Infinite in both
/// directions when there are too few values for that confidence (fewer than 6 for 0.95). Values are finite.
/// Throws std::invalid_argument for another confidence.
Interval sign_interval(std::span<const double> values, double confidence);

/// The one-sided p-value of the sign test that the median is above `threshold`: how likely at least as many
/// values lie above it when above and below are equally likely. Values equal to it are left out; 1 when none
/// is left.
double sign_test_above(std::span<const double> values, double threshold);

}  // namespace hullbench::statistics
