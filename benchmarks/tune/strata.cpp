#include "benchmarks/tune/strata.hpp"

#include <map>

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

}  // namespace hullbench::tune
