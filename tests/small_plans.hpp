// Plans that take no time, for tests of the whole program.
#pragma once

#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "tests/program.hpp"

namespace hullbench::testing {

/// A plan of polylidar with these cases; "filter" and the like may be added.
inline json small_plan(const std::string& name, const json& cases, int repetitions = 2) {
  const json rule = {{"rule", "paper_alpha"}};
  const json method = {{"method", "polylidar"}, {"protocol", "paper"}, {"parameters", {{"alpha", rule}}}};
  return {{"name", name},    {"title", "Plan " + name}, {"repetitions", repetitions},
          {"timeout_s", 30}, {"cases", cases},          {"methods", json::array({method})}};
}

/// A case of `cases`: California, with and without holes, at these numbers of points.
inline json california(const std::vector<int>& sizes) {
  return json::array({{{"dataset", "ca"}, {"holes", {false, true}}, {"n", sizes}}});
}

/// Writes the plan into a file of its name in `folder`; its path.
inline std::string write_plan(const fs::path& folder, const json& plan) {
  const fs::path file = folder / (plan.at("name").get<std::string>() + ".json");
  write_text(file, plan.dump());
  return file.string();
}

}  // namespace hullbench::testing
