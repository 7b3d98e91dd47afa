// How much a case counts where scores are taken over many: every stratum the same, in it every shape, and of
// a shape every case. So neither the source with the most shapes nor the shape with the most cases has the
// say.
//
// A stratum is a way to sample and a kind of shape: "uniform, holes", "gradient, simple".
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/statistics/weighted.hpp"

namespace hullbench::tune {

/// The kinds of shapes, in the order of the tables: "simple", "holes" (one part with holes) and "several
/// parts" (with holes or without).
const std::vector<std::string>& shape_kinds();

/// The kind of a truth with so many parts and, in all of them, so many holes.
std::string kind_of_shape(std::size_t parts, std::size_t holes);

/// The data set's way to sample, "several" where it has more than one (samplers_of in split.hpp).
std::string sampler_of(const std::string& dataset);

/// What decides a case's weight.
struct Membership {
  std::string stratum;
  std::string shape;  ///< base shape
};

/// A weight for each of the cases, which are one at least: they sum to 1.
std::vector<double> case_weights(const std::vector<Membership>& cases);

/// A value for each of some cases, which are weighed among themselves.
class WeighedValues {
 public:
  void add(Membership of_case, double value);
  std::size_t size() const { return values_.size(); }
  bool empty() const { return values_.empty(); }
  /// In the order in which they were added.
  std::vector<statistics::WeightedValue> all() const;
  /// The same by base shape.
  std::vector<std::vector<statistics::WeightedValue>> by_shape() const;
  /// Needs one value at least.
  double median() const { return statistics::weighted_median(all()); }
  std::optional<statistics::Interval> median_interval() const {
    return statistics::weighted_median_interval(by_shape());
  }

 private:
  std::vector<double> values_;
  std::vector<Membership> members_;
};

}  // namespace hullbench::tune
