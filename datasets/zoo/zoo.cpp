#include "datasets/zoo/zoo.hpp"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>

#include "datasets/zoo/generators.hpp"

namespace hullbench {

extern const std::string_view kZooJson;  // zoo.json

namespace zoo {
namespace {

using nlohmann::json;

Generators generators() {
  Generators all;
  for (Generators kind : {few_points(), flat_points(), close_points(), lattices(), clouds()}) all.merge(kind);
  return all;
}

std::vector<Case> read_cases() {
  const std::map<std::string, Answer> answers = {
      {"empty", Answer::kEmpty}, {"covers", Answer::kCovers}, {"shape", Answer::kShape}};
  const Generators makers = generators();
  std::vector<Case> all;
  const json manifest = json::parse(kZooJson);
  for (const json& entry : manifest.at("cases")) {
    const auto text = [&](const char* key) { return entry.at(key).get<std::string>(); };
    all.push_back({text("name"), text("title"), text("fault"), text("issue"), answers.at(text("answer")),
                   makers.at(text("name"))});
  }
  return all;
}

}  // namespace

const std::vector<Case>& cases() {
  static const std::vector<Case> all = read_cases();
  return all;
}

const Case* find_case(const std::string& name) {
  const auto found =
      std::find_if(cases().begin(), cases().end(), [&](const Case& one) { return one.name == name; });
  return found == cases().end() ? nullptr : &*found;
}

}  // namespace zoo
}  // namespace hullbench
