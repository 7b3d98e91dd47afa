#include "benchmarks/tune/strata.hpp"

#include <map>
#include <utility>

#include "benchmarks/tune/split.hpp"

namespace hullbench::tune {

const std::vector<std::string>& shape_kinds() {
  static const std::vector<std::string> kinds = {"simple", "holes", "several parts"};
  return kinds;
}

std::string kind_of_shape(std::size_t parts, std::size_t holes) {
  return shape_kinds()[parts > 1 ? 2 : holes > 0 ? 1 : 0];
}

std::string sampler_of(const std::string& dataset) {
  const std::vector<std::string> samplers = samplers_of(dataset);
  return samplers.size() == 1 ? samplers.front() : "several";
}

std::vector<double> case_weights(const std::vector<Membership>& cases) {
  std::map<std::string, std::map<std::string, std::size_t>> counts;  // by stratum, then shape
  for (const Membership& one : cases) ++counts[one.stratum][one.shape];
  std::vector<double> weights;
  weights.reserve(cases.size());
  for (const Membership& one : cases) {
    const auto& shapes = counts.at(one.stratum);
    weights.push_back(1 / (static_cast<double>(counts.size()) * static_cast<double>(shapes.size()) *
                           static_cast<double>(shapes.at(one.shape))));
  }
  return weights;
}

void WeighedValues::add(Membership of_case, double value) {
  members_.push_back(std::move(of_case));
  values_.push_back(value);
}

std::vector<statistics::WeightedValue> WeighedValues::all() const {
  const std::vector<double> weights = case_weights(members_);
  std::vector<statistics::WeightedValue> result;
  result.reserve(values_.size());
  for (std::size_t i = 0; i < values_.size(); ++i) result.push_back({values_[i], weights[i]});
  return result;
}

std::vector<std::vector<statistics::WeightedValue>> WeighedValues::by_shape() const {
  const std::vector<statistics::WeightedValue> values = all();
  std::map<std::string, std::vector<statistics::WeightedValue>> of_shape;
  for (std::size_t i = 0; i < values.size(); ++i) of_shape[members_[i].shape].push_back(values[i]);
  std::vector<std::vector<statistics::WeightedValue>> result;
  result.reserve(of_shape.size());
  for (auto& [shape, own] : of_shape) result.push_back(std::move(own));
  return result;
}

}  // namespace hullbench::tune
