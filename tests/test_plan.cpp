// Plans: what is accepted, what is refused with which words, which runs come of it, and the parameter rules.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/base/json_schema.hpp"
#include "benchmarks/plan/parameter_rules.hpp"
#include "benchmarks/plan/plan.hpp"
#include "benchmarks/plan/release_seed.hpp"
#include "benchmarks/record/record.hpp"
#include "datasets/datasets.hpp"
#include "datasets/sha256.hpp"
#include "datasets/stress.hpp"
#include "polylidar/concave_hull.hpp"
#include "polylidar/delaunay.hpp"
#include "tests/complaint.hpp"
#include "tests/point_sets.hpp"
#include "tests/temporary_folder.hpp"

namespace hullbench::testing {
namespace {

using polylidar::testing::lattice;

const std::vector<std::string> kMethods = {"polylidar", "spatialite"};

std::vector<DatasetInfo> known_datasets() {
  DatasetInfo ca;
  ca.name = "ca";
  ca.has_holes_variant = true;
  DatasetInfo solid;
  solid.name = "solid";
  return {ca, solid};
}

json small_plan() {
  return json::parse(R"({
    "name": "small",
    "cases": [{"dataset": "ca", "holes": [false, true], "n": [500, 1000]}],
    "methods": [
      {"method": "polylidar", "protocol": "paper", "parameters": {"alpha": {"rule": "paper_alpha"}}},
      {"method": "spatialite", "protocol": "paper",
       "parameters": {"c": {"cases": {"ca": 2.0, "ca/holes": 1.25}}, "allow_holes": 1}}]})");
}

/// Those, a family of three shapes, and one of two with points of their own.
std::vector<DatasetInfo> datasets_and_families() {
  std::vector<DatasetInfo> infos = known_datasets();
  DatasetInfo star;
  star.name = "star";
  star.members = 3;
  DatasetInfo floor;
  floor.name = kSimulatedFloor;
  floor.members = 2;
  floor.own_points = true;
  infos.insert(infos.end(), {star, floor});
  return infos;
}

/// A plan of polylidar with these cases.
json plan_with_cases(const std::string& cases) {
  json plan = small_plan();
  plan["cases"] = json::parse(cases);
  plan["methods"].erase(1);
  return plan;
}

/// Whether a message has all that its reader needs; how it says it is its own affair.
::testing::AssertionResult names_all(const std::string& message, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) {
    if (message.find(part) == std::string::npos)
      return ::testing::AssertionFailure() << "'" << part << "' is not in: " << message;
  }
  return ::testing::AssertionSuccess();
}

template <class Work>
std::string refusal_of(const Work& work) {
  return complaint_of<ConfigurationError>(work);
}

plan::Plan parsed(const json& source, const std::string& place = "here") {
  return plan::parse_plan(source.dump(), place);
}

/// Expects that the plan is the same when it is written and read again; what is written.
json expect_to_survive_json(const plan::Plan& plan) {
  json once = plan::plan_to_json(plan);
  EXPECT_EQ(plan::plan_to_json(parsed(once)), once);
  return once;
}

/// What is said about a plan that is read and checked beside these data sets.
std::string complaint_about(const json& source, const std::vector<DatasetInfo>& known) {
  return refusal_of([&] { plan::check_plan(parsed(source, "plan 'small'"), kMethods, known); });
}

/// About a plan of polylidar with these cases.
std::string complaint_about_cases(const std::string& cases) {
  return complaint_about(plan_with_cases(cases), datasets_and_families());
}

std::vector<std::string> names_of(const std::vector<plan::PlannedRun>& runs) {
  std::vector<std::string> names;
  names.reserve(runs.size());
  for (const plan::PlannedRun& run : runs) names.push_back(run.name);
  return names;
}

/// About one in which the value at `pointer` is `value`.
std::string complaint(const std::string& pointer, const json& value) {
  json plan = small_plan();
  plan[json::json_pointer(pointer)] = value;
  return complaint_about(plan, known_datasets());
}

TEST(Plan, DefaultsAndValues) {
  const plan::Plan plan = parsed(small_plan());
  EXPECT_EQ(plan.name, "small");
  EXPECT_EQ(plan.title, "small");
  EXPECT_EQ(plan.repetitions, 10);
  EXPECT_EQ(plan.warmup, 1);
  EXPECT_EQ(plan.timeout_s, 120);
  EXPECT_EQ(plan.mem_limit_mib, 4096);
  EXPECT_EQ(plan.expanded_cases.size(), 4U);
  EXPECT_EQ(plan.methods.size(), 2U);
}

TEST(Plan, SurvivesJson) {
  json source = small_plan();
  source["repetitions"] = 3;
  source["passes"] = 2;
  source["timeout_s"] = 0.5;
  source["seed"] = 18446744073709551615U;
  source["notes"] = {"a note"};
  source["paper"] = "Table 6";
  source["methods"][0]["note"] = "fast";
  source["methods"][0]["datasets"] = {"ca"};
  const json once = expect_to_survive_json(parsed(source));
  for (const auto& [key, value] : source.items()) EXPECT_EQ(once.at(key), value) << key;
}

TEST(Plan, PassesShareTheRepetitions) {
  const auto shares = [](int repetitions) {
    return std::vector{plan::share_of_pass(repetitions, 3, 1), plan::share_of_pass(repetitions, 3, 2),
                       plan::share_of_pass(repetitions, 3, 3)};
  };
  EXPECT_EQ(shares(10), (std::vector{4, 3, 3}));
  EXPECT_EQ(shares(11), (std::vector{4, 4, 3}));
  EXPECT_EQ(shares(3), (std::vector{1, 1, 1}));
  EXPECT_EQ(shares(2), (std::vector{1, 1, 0}));
  EXPECT_EQ(shares(1), (std::vector{1, 0, 0}));
  EXPECT_EQ(plan::share_of_pass(7, 1, 1), 7);
}

TEST(Plan, APlanHasOnePassUnlessItSaysSo) {
  json source = small_plan();
  EXPECT_EQ(parsed(source).passes, 1);
  source["passes"] = plan::kMaxPasses;
  EXPECT_EQ(parsed(source).passes, plan::kMaxPasses);
  for (const json& wrong : {json(0), json(plan::kMaxPasses + 1), json("three")}) {
    source["passes"] = wrong;
    EXPECT_THROW(parsed(source), ConfigurationError) << wrong;
  }
}

TEST(Plan, AParameterCanBeScaledByTheSpacingOfThePoints) {
  json source = small_plan();
  source["methods"][0]["protocol"] = "tuned";  // which may not read the ground truth
  source["methods"][0]["parameters"] = {
      {"alpha", {{"scaled", 1.5}}}, {"area", {{"scaled", 1.5}, {"power", 2}}}, {"max_edge_length", nullptr}};
  const plan::Plan plan = parsed(source);
  const std::vector<Point> points = {{0, 0}, {6, 0}, {6, 6}, {0, 6}};  // spacing 3
  const auto chosen =
      plan::choose_parameters(plan.methods[0], plan.expanded_cases[0], {points, 1, false, {}});
  EXPECT_DOUBLE_EQ(chosen.at("alpha"), 4.5);
  EXPECT_DOUBLE_EQ(chosen.at("area"), 20.25);
  EXPECT_EQ(chosen.at("max_edge_length"), std::numeric_limits<double>::infinity());
  expect_to_survive_json(plan);
}

TEST(Plan, AValueForOneNumberOfPointsGoesBeforeTheShapes) {
  json source = small_plan();
  source["methods"][1]["parameters"]["c"]["cases"] = {
      {"ca", 2.0}, {"ca/n:500", 3.0}, {"ca/holes/n:500", nullptr}, {"ca/holes/n:1000", 5.0}};
  const plan::Plan plan = parsed(source);
  plan::check_plan(plan, kMethods, known_datasets());
  std::vector<double> values;
  for (const plan::PlanCase& plan_case : plan.expanded_cases)
    values.push_back(plan::choose_parameters(plan.methods[1], plan_case, {}).at("c"));
  EXPECT_EQ(values, (std::vector<double>{3, 2, std::numeric_limits<double>::infinity(), 5}));
  expect_to_survive_json(plan);
  source["methods"][1]["parameters"]["c"]["cases"].erase("ca/holes/n:1000");
  EXPECT_THROW(plan::check_plan(parsed(source), kMethods, known_datasets()), ConfigurationError);
}

TEST(Plan, RunsComeCaseByCaseWithTheirNames) {
  const auto runs = plan::planned_runs(parsed(small_plan()), "");
  ASSERT_EQ(runs.size(), 8U);
  EXPECT_EQ(runs[0].name, "polylidar/ca/n:500/holes:0/protocol:paper");
  EXPECT_EQ(runs[1].name, "spatialite/ca/n:500/holes:0/protocol:paper");
  EXPECT_EQ(runs[7].name, "spatialite/ca/n:1000/holes:1/protocol:paper");
}

TEST(Plan, ACaseCanStandForSeveralDataSets) {
  json source = small_plan();
  source["cases"] = json::parse(R"([{"dataset": ["solid", "ca"], "n": [500, 1000]},
                                    {"dataset": "ca", "holes": [true], "n": [500]}])");
  source["methods"][1]["parameters"]["c"] = 2.0;
  const plan::Plan plan = parsed(source);
  plan::check_plan(plan, kMethods, known_datasets());
  std::vector<std::string> cases;
  for (const plan::PlanCase& one : plan.expanded_cases)
    cases.push_back(one.shape() + " " + std::to_string(one.n));
  EXPECT_EQ(cases,
            (std::vector<std::string>{"solid 500", "solid 1000", "ca 500", "ca 1000", "ca/holes 500"}));
  const json once = expect_to_survive_json(plan);
  EXPECT_EQ(once.at("cases"), source["cases"]);
}

TEST(Plan, MembersStandForTheShapesOfAFamily) {
  const json source =
      plan_with_cases(R"([{"dataset": ["star", "comb"], "members": 2, "holes": [false, true], "n": [500]}])");
  const plan::Plan plan = parsed(source);
  std::vector<std::string> cases;
  for (const plan::PlanCase& one : plan.expanded_cases) cases.push_back(one.shape());
  EXPECT_EQ(cases, (std::vector<std::string>{"star-1", "star-1/holes", "star-2", "star-2/holes", "comb-1",
                                             "comb-1/holes", "comb-2", "comb-2/holes"}));
  EXPECT_EQ(plan::planned_runs(plan, "").front().name, "polylidar/star-1/n:500/holes:0/protocol:paper");
  const json once = plan::plan_to_json(plan);
  EXPECT_EQ(once.at("cases"), source["cases"]);
  EXPECT_EQ(parsed(once).expanded_cases.size(), plan.expanded_cases.size());
}

TEST(Plan, MembersAreLimitedToTheFamily) {
  EXPECT_EQ(complaint_about_cases(R"([{"dataset": "star", "members": 3, "n": [500]}])"), "nothing");
  EXPECT_EQ(complaint_about_cases(R"([{"dataset": "star-3", "n": [500]}])"), "nothing");
  for (const auto& [cases, name] : {std::pair(R"([{"dataset": "star", "members": 4, "n": [500]}])", "star-4"),
                                    std::pair(R"([{"dataset": "star", "n": [500]}])", "star"),
                                    std::pair(R"([{"dataset": "ca", "members": 1, "n": [500]}])", "ca-1")}) {
    EXPECT_TRUE(names_all(complaint_about_cases(cases),
                          {"'" + std::string(name) + "'", "ca", "solid", "star-1 to -3", "floor-1 to -2"}));
  }
  for (const char* members : {"0", "1000001", "2.5", "\"all\""}) {
    EXPECT_TRUE(
        names_all(complaint_about_cases(std::string(R"([{"dataset": "star", "n": [500], "members": )") +
                                        members + "}]"),
                  {"cases[0].members", "from 1 to 1000000"}));
  }
}

TEST(Plan, TakesAsManyPointsAsTheCore) {
  const auto complaint_about = [](std::size_t n) {
    return complaint_about_cases(R"([{"dataset": "ca", "n": [)" + std::to_string(n) + "]}]");
  };
  EXPECT_EQ(complaint_about(polylidar::kMaxPoints), "nothing");
  EXPECT_NE(complaint_about(polylidar::kMaxPoints + 1), "nothing");
  const std::vector<Point> same(1);
  EXPECT_THROW(polylidar::delaunay({same.data(), polylidar::kMaxPoints + 1}), std::invalid_argument)
      << "by their number, before one is read";
}

TEST(Plan, NumbersOfPointsAreForDataSetsWithoutPointsOfTheirOwn) {
  EXPECT_EQ(complaint_about_cases(R"([{"dataset": "floor", "members": 2}])"), "nothing");
  EXPECT_TRUE(names_all(complaint_about_cases(R"([{"dataset": "floor", "members": 2, "n": [500]}])"),
                        {"'n'", "floor-1", "leave it out"}));
  EXPECT_TRUE(names_all(complaint_about_cases(R"([{"dataset": "ca"}])"), {"no 'n'", "ca", "add"}));
  EXPECT_TRUE(
      names_all(complaint_about_cases(R"([{"dataset": "star", "members": 1}])"), {"no 'n'", "star-1"}));
}

TEST(Plan, AMethodCanKeepToAFamily) {
  json source =
      plan_with_cases(R"([{"dataset": "star", "members": 2, "n": [500]}, {"dataset": "solid", "n": [500]}])");
  source["methods"][0]["datasets"] = {"star"};
  const plan::Plan plan = parsed(source);
  EXPECT_NO_THROW(plan::check_plan(plan, kMethods, datasets_and_families()));
  EXPECT_EQ(plan::planned_runs(plan, "").size(), 2U);
}

TEST(Plan, RecordingsTakeThePlaceOfSimulatedFloors) {
  const json source =
      plan_with_cases(R"([{"dataset": "floor", "members": 11}, {"dataset": "lowfloor", "members": 4},
                          {"dataset": "ca", "n": [500]}])");
  plan::Plan plan = parsed(source);
  plan::use_recordings(plan, 2);
  const std::vector<std::string> names = {"polylidar/recorded-1/n:all/holes:0/protocol:paper",
                                          "polylidar/recorded-2/n:all/holes:0/protocol:paper",
                                          "polylidar/ca/n:500/holes:0/protocol:paper"};
  EXPECT_EQ(names_of(plan::planned_runs(plan, "")), names);
  EXPECT_EQ(names_of(plan::planned_runs(parsed(plan::plan_to_json(plan)), "")), names);
}

TEST(Plan, RecordingsAreAddedToRealPoints) {
  plan::Plan plan = parsed(plan_with_cases(R"([{"dataset": "real-clmfires"}])"));
  plan::use_recordings(plan, 2);
  EXPECT_EQ(names_of(plan::planned_runs(plan, "")),
            (std::vector<std::string>{"polylidar/real-clmfires/n:all/holes:0/protocol:paper",
                                      "polylidar/real-recorded-1/n:all/holes:0/protocol:paper",
                                      "polylidar/real-recorded-2/n:all/holes:0/protocol:paper"}));
}

TEST(Plan, AKeyThatStandsTwiceInOneObjectIsRefused) {
  const std::string good = small_plan().dump();
  const auto refusal_with = [&](const std::string& before, const std::string& added) {
    std::string text = good;
    text.insert(text.find(before), added);
    return refusal_of([&] { plan::parse_plan(text, "here"); });
  };
  EXPECT_EQ(refusal_with("\"cases\":[", "\"name\":\"a\","),
            "here has the key 'name' twice in one object; leave one out");
  EXPECT_EQ(refusal_with("\"method\":\"spatialite\"", "\"method\":\"a\","),
            "here has the key 'method' twice in one object; leave one out");
  // Behind an object inside.
  EXPECT_EQ(refusal_with("\"protocol\":", "\"protocol\":\"a\","),
            "here has the key 'protocol' twice in one object; leave one out");
}

TEST(Plan, DrawsAreCountedAndWritten) {
  json source = small_plan();
  EXPECT_EQ(parsed(source).draws, 0);
  source["draws"] = 3;
  const plan::Plan plan = parsed(source);
  EXPECT_EQ(plan.draws, 3);
  EXPECT_EQ(plan::plan_to_json(plan).at("draws"), 3);
  source["draws"] = -1;
  EXPECT_THROW(parsed(source), ConfigurationError);
}

TEST(Plan, RecordingsNeedSimulatedFloors) {
  plan::Plan plan = parsed(small_plan());
  EXPECT_TRUE(names_all(refusal_of([&] { plan::use_recordings(plan, 2); }),
                        {"'small'", "--recordings", "'rgbd'", "'real'"}));
}

TEST(Plan, FilterIsSearchedInNames) {
  const plan::Plan plan = parsed(small_plan());
  EXPECT_EQ(plan::planned_runs(plan, "polylidar").size(), 4U);
  EXPECT_EQ(plan::planned_runs(plan, "^ca").size(), 0U);
  EXPECT_EQ(plan::planned_runs(plan, "n:500/.*holes:1").size(), 2U);
  EXPECT_THROW(plan::planned_runs(plan, "n:(500"), ConfigurationError);
}

TEST(Plan, AMethodCanKeepToSomeDataSets) {
  json source = small_plan();
  source["cases"].push_back({{"dataset", "solid"}, {"n", {500}}});
  source["methods"][1]["datasets"] = {"ca"};
  const plan::Plan plan = parsed(source);
  plan::check_plan(plan, kMethods, known_datasets());
  EXPECT_EQ(plan::planned_runs(plan, "solid").size(), 1U);
}

TEST(Plan, NothingIsWrongWithTheSmallPlan) {
  EXPECT_EQ(complaint("/repetitions", 2), "nothing");
}

TEST(Plan, WrongPlansAreRefusedWithTheirPlace) {
  struct Case {
    const char* pointer;
    json value;
    std::vector<std::string> parts;  // of what is said
  };
  const std::vector<Case> cases = {
      {"/repetition", 5, {"plan 'small'", "repetition ", "schema_version", "methods"}},
      {"/schema_version", 2, {"schema_version", "1"}},
      {"/name", "Small Plan", {"name", "small letters"}},
      {"/name", 5, {"name", "string"}},
      {"/repetitions", 0, {"repetitions", "whole number from 1 to 1000000"}},
      {"/repetitions", 2.5, {"repetitions", "whole number"}},
      {"/repetitions", 18446744073709551615U, {"repetitions", "whole number"}},
      {"/warmup", -1, {"warmup", "whole number from 0"}},
      {"/timeout_s", 0, {"timeout_s", "from 0.001"}},
      {"/mem_limit_mib", 1, {"mem_limit_mib", "whole number from 64"}},
      {"/seed", -1, {"seed", "whole number from 0", "2^64"}},
      {"/cases", json::array(), {"cases", "at least one"}},
      {"/cases/0", 5, {"cases[0]", "object"}},
      {"/cases/0/size", 5, {"cases[0].size", "dataset", "members", "stress", "holes"}},
      {"/cases/0/n", 500, {"cases[0].n", "list"}},
      {"/cases/0/n/1", 2, {"cases[0].n[1]", "whole number from 3"}},
      {"/cases/0/n/1", 500, {"cases[0].n[1]", "twice"}},
      {"/cases/0/holes/1", "yes", {"cases[0].holes[1]", "true or false"}},
      {"/cases/0/holes/1", false, {"cases[0].holes[1]", "twice"}},
      {"/cases/1", {{"dataset", "ca"}, {"n", {500}}}, {"cases[1]", "case ca", "n = 500", "second time"}},
      {"/cases/0/dataset", "mars", {"'small'", "data set 'mars'", "ca and solid"}},
      {"/cases/0/dataset", "solid", {"solid with holes"}},
      {"/cases/0/dataset", json::array(), {"cases[0].dataset", "at least one"}},
      {"/cases/0/dataset", {"ca", 5}, {"cases[0].dataset[1]", "string"}},
      {"/cases/0/dataset", {"ca", "ca"}, {"cases[0].dataset[1]", "twice"}},
      {"/cases/0/dataset", {"ca", "mars"}, {"data set 'mars'"}},
      {"/cases/1", {{"dataset", {"solid", "ca"}}, {"n", {500}}}, {"cases[1]", "case ca", "n = 500"}},
      {"/methods/0/method", "magic", {"method 'magic'", "polylidar and spatialite"}},
      {"/methods/0/colour", "red", {"methods[0].colour", "protocol"}},
      {"/methods/0/protocol", "best", {"methods[0].protocol", "default", "oracle", "best"}},
      {"/methods/0/protocol", "auto", {"methods[0].parameters.alpha.rule", "'paper_alpha'", "ground truth"}},
      {"/methods/0/timeout_s", 0, {"methods[0].timeout_s", "from 0.001"}},
      {"/methods/0/repetitions", 0, {"methods[0].repetitions", "from 1"}},
      {"/methods/0/mem_limit_mib", 1, {"methods[0].mem_limit_mib", "from 64"}},
      {"/methods/2",
       {{"method", "polylidar"}, {"protocol", "default"}, {"mem_limit_mib", 100}},
       {"methods[2]", "'polylidar'", "mem_limit_mib"}},
      {"/methods/0/datasets", {"mars"}, {"'mars'", "no case"}},
      {"/methods/0/parameters/alpha", "big", {"methods[0].parameters.alpha", "number", "null", "'rule'"}},
      {"/methods/0/parameters/alpha", {{"scaled", -1}}, {"methods[0].parameters.alpha.scaled", "number"}},
      {"/methods/0/parameters/alpha", {{"scaled", 1}, {"power", 3}}, {"alpha.power", "whole number"}},
      {"/methods/0/parameters/alpha", {{"power", 2}}, {"'rule'", "'scaled'", "'cases'"}},
      {"/methods/0/parameters/alpha/rule", "mine", {"rule 'mine'", "paper_alpha", "auto_edge_length"}},
      {"/methods/0/parameters/alpha/cases", json::object(), {"'rule'", "'scaled'", "'cases'"}},
      {"/methods/1/parameters/c/cases", {{"ca", 2}}, {"spatialite", "'c'", "ca/holes"}},
      {"/methods/1/parameters/c/cases/ca", "2", {"methods[1].parameters.c.cases.ca", "number"}},
      {"/field", json::array(), {"field", "at least one"}},
      {"/field", {"Paper"}, {"field[0]", "METHOD/PROTOCOL", "Paper"}},
      {"/field", {"auto", "papper"}, {"field[1]", "'papper'", "auto, default and paper", "convex_hull"}},
      {"/field", {"convex_hull/paper"}, {"field[0]", "'convex_hull/paper'", "METHOD/PROTOCOL"}},
      {"/field", {"auto", "auto"}, {"field[1]", "twice"}},
      {"/field", {"default", "convex_hull/default"}, {"field[1]", "'convex_hull/default'", "taken already"}},
      {"/without", {"concaveman"}, {"without[0]", "'concaveman'", "not taken"}},
      {"/without", {"concave"}, {"without[0]", "'concave'", "concaveman"}},
  };
  for (const Case& one : cases) {
    EXPECT_TRUE(names_all(complaint(one.pointer, one.value), one.parts)) << one.pointer;
  }
}

json plan_schema() {
  std::ifstream in(fs::path(HULLBENCH_PLAN_FOLDER) / "plan.schema.json");
  return json::parse(in);
}

/// The parts of a schema in and below `part`, by their places.
void collect_parts(const json& part, const std::string& place, std::map<std::string, json>& parts) {
  parts[place] = part;
  for (const char* group : {"properties", "$defs"}) {
    const json children = part.value(group, json::object());
    for (const auto& [name, child] : children.items())
      collect_parts(child, std::string(place).append("/").append(name), parts);
  }
  for (const char* key : {"items", "additionalProperties"}) {
    if (part.contains(key) && part[key].is_object()) collect_parts(part[key], place + "/" + key, parts);
  }
}

TEST(PlanSchema, SaysOfEveryFieldWhatItIsWithExamplesThatAreValid) {
  const json schema = plan_schema();
  std::map<std::string, json> parts;
  collect_parts(schema, "", parts);
  EXPECT_GE(parts.size(), 40U);
  for (const auto& [place, part] : parts) {
    // A bare reference is described where it leads.
    if (part.size() == 1 && part.contains("$ref")) continue;
    ASSERT_TRUE(part.contains("description") && part.contains("examples")) << place;
    EXPECT_FALSE(part["description"].get<std::string>().empty()) << place;
    EXPECT_FALSE(part["examples"].empty()) << place;
    const json alone = {{"$defs", schema["$defs"]}, {"allOf", json::array({part})}};
    const JsonSchema checked(alone);
    for (const json& example : part["examples"])
      EXPECT_TRUE(checked.faults(example).empty()) << place << example;
  }
}

TEST(JsonSchemaTest, TakesIntegersOf64Bits) {
  const JsonSchema seeds(json::parse(R"({"type": "array", "items": {"type": "integer", "minimum": 0}})"));
  EXPECT_TRUE(seeds.faults(json::array({0U, 18446744073709551615U})).empty());
  EXPECT_FALSE(seeds.faults(json::array({-1})).empty());
}

TEST(PlanSchema, ItsExampleIsAPlan) {
  const json schema = plan_schema();
  ASSERT_FALSE(schema.at("examples").empty());
  for (const json& example : schema.at("examples")) EXPECT_NO_THROW(parsed(example));
}

/// A plan of the entries that `choice` takes from the field.
plan::Plan plan_of_field(const json& choice) {
  json plan = small_plan();
  plan.erase("methods");
  plan.update(choice);
  return parsed(plan, "plan 'small'");
}

std::vector<std::string> ways_of(const plan::Plan& plan) {
  std::vector<std::string> ways;
  for (const plan::PlanMethod& method : plan.methods) ways.push_back(method.method + "/" + method.protocol);
  return ways;
}

using Ways = std::vector<std::string>;

TEST(Field, IsTakenByProtocolByMethodOrByBoth) {
  const Ways all = ways_of(plan::load_plan("field", HULLBENCH_PLAN_FOLDER));
  EXPECT_GE(all.size(), 30U);
  EXPECT_EQ(ways_of(plan_of_field({{"field", {"default", "auto", "paper"}}})), all) << "in the field's order";
  const Ways defaults = ways_of(plan_of_field({{"field", {"default"}}}));
  EXPECT_GE(defaults.size(), 10U);
  for (const std::string& way : defaults) EXPECT_TRUE(way.ends_with("/default")) << way;
  EXPECT_EQ(ways_of(plan_of_field({{"field", {"convex_hull/default", "chi_shape"}}})),
            (Ways{"chi_shape/paper", "chi_shape/auto", "convex_hull/default"}));
  EXPECT_EQ(ways_of(plan_of_field(
                {{"field", {"chi_shape", "polylidar"}}, {"without", {"polylidar/auto", "chi_shape"}}})),
            (Ways{"polylidar/paper", "polylidar/default"}));
  EXPECT_TRUE(names_all(refusal_of([] {
                          plan_of_field({{"field", {"chi_shape"}}, {"without", {"auto", "paper"}}});
                        }),
                        {"without", "no method"}));
}

TEST(Field, AnEntryOfThePlanChangesWhatItSaysOfOneThatIsTaken) {
  const json entries = {{{"method", "mine"}, {"protocol", "default"}},
                        {{"method", "spatialite"}, {"protocol", "default"}, {"repetitions", 3}},
                        {{"method", "spatialite"}, {"protocol", "paper"}, {"parameters", {{"c", 2}}}}};
  const plan::Plan plan =
      plan_of_field({{"field", {"spatialite/default", "knn_hull"}}, {"methods", entries}});
  EXPECT_EQ(ways_of(plan),
            (Ways{"spatialite/default", "knn_hull/default", "mine/default", "spatialite/paper"}));
  json expected = plan::plan_to_json(plan_of_field({{"field", {"spatialite/default"}}})).at("methods").at(0);
  EXPECT_TRUE(expected.contains("note") && expected.contains("parameters"));
  expected["repetitions"] = 3;
  EXPECT_EQ(plan::plan_to_json(plan).at("methods").at(0), expected);
  const json without_holes = {
      {"method", "spatialite"}, {"protocol", "auto"}, {"parameters", {{"allow_holes", 0}}}};
  const plan::Plan other = plan_of_field({{"field", {"spatialite/auto"}}, {"methods", {without_holes}}});
  json parameters = plan::plan_to_json(plan_of_field({{"field", {"spatialite/auto"}}}))
                        .at("methods")
                        .at(0)
                        .at("parameters");
  EXPECT_GE(parameters.size(), 2U);
  parameters["allow_holes"] = 0;
  EXPECT_EQ(plan::plan_to_json(other).at("methods").at(0).at("parameters"), parameters);
  EXPECT_EQ(plan.methods[3].parameters.size(), 1U) << "nothing comes from what is not taken";
  const json once = expect_to_survive_json(plan);
  EXPECT_FALSE(once.contains("field")) << "records are complete";

  json source = {{"field", {"spatialite"}}, {"methods", {entries[1], entries[1]}}};
  EXPECT_TRUE(
      names_all(refusal_of([&] { plan_of_field(source); }), {"methods[1]", "repeats", "'spatialite'"}));
  source["methods"] = json::array({entries[1]});
  source["methods"][0]["parameters"] = {{"c", 2}};
  EXPECT_TRUE(
      names_all(refusal_of([&] { plan_of_field(source); }), {"methods[0]", "'note'", "whose default"}));
}

TEST(Plan, TwoEntriesWithTheSameRunNamesAreRefused) {
  json source = small_plan();
  source["methods"].push_back(source["methods"][0]);
  EXPECT_TRUE(
      names_all(complaint("/methods", source["methods"]), {"methods[2]", "'polylidar'", "leave one out"}));
}

TEST(Plan, MissingKeysAreNamed) {
  for (const char* key : {"name", "cases", "methods"}) {
    json source = small_plan();
    source.erase(key);
    EXPECT_TRUE(names_all(refusal_of([&] { parsed(source, "plan 'small'"); }),
                          {"plan 'small'", "'" + std::string(key) + "'"}));
  }
}

TEST(Plan, BrokenJsonIsRefusedWithItsPlace) {
  EXPECT_TRUE(names_all(
      refusal_of([] { plan::parse_plan("{\n  \"name\": \"small\",\n  \"cases\" [\n}", "plan 'small'"); }),
      {"plan 'small'", "JSON", "line 3, column 11"}));
  EXPECT_THROW(plan::parse_plan("", "here"), ConfigurationError);
  EXPECT_THROW(plan::parse_plan("[]", "here"), ConfigurationError);
}

std::vector<std::string> datasets_of(const plan::Plan& plan) {
  std::vector<std::string> names;
  for (const plan::PlanCase& one : plan.expanded_cases) names.push_back(one.dataset);
  return names;
}

TEST(Plan, EveryDataSetStandsWithEveryStress) {
  const plan::Plan plan = parsed(plan_with_cases(R"([{"dataset": ["ca", "star-2~noise:1"], "n": [9]},
                          {"dataset": "star", "members": 2, "stress": ["noise:0", "outliers:2.5"], "n": [9]}])"));
  EXPECT_EQ(datasets_of(plan),
            (std::vector<std::string>{"ca", "star-2~noise:1", "star-1~noise:0", "star-1~outliers:2.5",
                                      "star-2~noise:0", "star-2~outliers:2.5"}));
  EXPECT_EQ(plan::planned_runs(plan, "")[1].name, "polylidar/star-2~noise:1/n:9/holes:0/protocol:paper");
  EXPECT_NO_THROW(plan::check_plan(plan, kMethods, datasets_and_families()));
  EXPECT_EQ(datasets_of(parsed(plan::plan_to_json(plan))), datasets_of(plan));
}

TEST(Plan, MethodsThatKeepToAShapeOrAFamilyKeepToItUnderStressToo) {
  json document =
      plan_with_cases(R"([{"dataset": ["ca", "star-2"], "stress": ["noise:0", "noise:1"], "n": [9]}])");
  const auto count = [&](const std::string& dataset) {
    document["methods"][0]["datasets"] = {dataset};
    return plan::planned_runs(parsed(document), "").size();
  };
  EXPECT_EQ(count("ca"), 2U);
  EXPECT_EQ(count("star"), 2U);
  EXPECT_EQ(count("star-2"), 2U);
  EXPECT_EQ(count("star-2~noise:1"), 1U);
  EXPECT_EQ(count("star-3"), 0U);
}

TEST(Plan, StressThatThereIsNotIsRefused) {
  const std::string of_kind = complaint_about_cases(R"([{"dataset": "ca", "stress": ["fog:1"], "n": [9]}])");
  EXPECT_TRUE(names_all(of_kind, {"cases[0].stress[0]", "'fog:1'", "'hullbench list'"}));
  for (const StressKind& kind : stress_kinds()) EXPECT_TRUE(names_all(of_kind, {kind.name}));
  EXPECT_TRUE(
      names_all(complaint_about_cases(R"([{"dataset": "ca", "stress": ["noise:1", "noise:1"], "n": [9]}])"),
                {"cases[0].stress[1]", "twice"}));
  EXPECT_TRUE(names_all(complaint_about_cases(R"([{"dataset": "ca~fog:1", "n": [9]}])"),
                        {"'ca~fog:1'", "not known", "solid"}));
  EXPECT_TRUE(names_all(complaint_about_cases(R"([{"dataset": "floor-1~noise:1"}])"),
                        {"'floor-1~noise:1'", "not known"}));
  for (const char* name : {"~noise:1", "Ca~noise:1", "ca:noise", "ca.5~noise:1", "ca~noise/1"}) {
    EXPECT_TRUE(names_all(complaint("/cases/0/dataset", name),
                          {"cases[0].dataset", "small letters", "ca~noise:0.5", name}));
  }
}

TEST(Plan, AxisIsReadAndWritten) {
  json document = plan_with_cases(R"([{"dataset": "ca", "stress": ["noise:0", "noise:1"], "n": [9]}])");
  EXPECT_FALSE(parsed(document).axis);
  document["axis"] = {{"of", "noise"}, {"title", "Noise"}, {"unit", "h"}};
  const plan::Plan plan = parsed(document);
  ASSERT_TRUE(plan.axis);
  EXPECT_EQ(plan.axis->of, "noise");
  EXPECT_EQ(plan::plan_to_json(plan).at("axis"), document["axis"]);
  EXPECT_NO_THROW(plan::check_plan(plan, kMethods, known_datasets()));
  document["axis"] = {{"of", "noise"}};
  EXPECT_EQ(parsed(document).axis->title, "noise");
}

TEST(Plan, EveryCaseHasAPlaceOnTheAxis) {
  json document =
      plan_with_cases(R"([{"dataset": "ca", "stress": ["noise:0"], "n": [9]}, {"dataset": "ca", "n": [9]}])");
  const auto check = [&](const char* of) {
    document["axis"] = {{"of", of}};
    plan::check_plan(parsed(document), kMethods, known_datasets());
  };
  EXPECT_NO_THROW(check("n"));
  EXPECT_NO_THROW(check("sampling"));
  EXPECT_TRUE(names_all(refusal_of([&] { check("noise"); }), {"'small'", "'noise'", "case ca", "sampling"}));
}

TEST(Plan, AcceptedStatusesAreReadAndWritten) {
  json document = small_plan();
  for (const record::Status status : record::kAllStatuses) {
    document["accepted"] = json::array({to_string(status)});
    EXPECT_EQ(parsed(document).accepted.size(), 1U) << to_string(status);
  }
  document["accepted"] = {"error", "unsupported"};
  const plan::Plan plan = parsed(document);
  EXPECT_EQ(plan.accepted, (std::vector<std::string>{"error", "unsupported"}));
  EXPECT_EQ(plan::plan_to_json(plan).at("accepted"), document["accepted"]);
  EXPECT_TRUE(
      names_all(complaint("/accepted", {"broken"}), {"accepted[0]", "timeout", "not_installed", "broken"}));
}

TEST(Plan, ADefaultWithParametersSaysWhoseItIs) {
  json entry = {{"method", "spatialite"}, {"protocol", "default"}, {"parameters", {{"c", 2}}}};
  EXPECT_TRUE(names_all(complaint("/methods/2", entry), {"methods[2]", "default", "'note'"}));
  entry["note"] = "That of a program that uses it.";
  EXPECT_EQ(complaint("/methods/2", entry), "nothing");
  entry.erase("parameters");
  entry.erase("note");
  EXPECT_EQ(complaint("/methods/2", entry), "nothing");
}

TEST(Plan, IsFoundByNameOrByPath) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "plan.schema.json") << "{}";
  std::ofstream(folder.path() / "small.json") << small_plan();
  EXPECT_EQ(plan::load_plan("small", folder.path()).name, "small");
  EXPECT_EQ(plan::load_plan((folder.path() / "small.json").string(), "/nowhere").name, "small");
  EXPECT_TRUE(
      names_all(refusal_of([&] { plan::load_plan("smal", folder.path()); }), {"'smal'", "known are small,"}));
}

std::vector<fs::path> ready_plans() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(HULLBENCH_PLAN_FOLDER)) {
    if (!entry.path().stem().string().ends_with(".schema")) files.push_back(entry.path());
  }
  return files;
}

TEST(Plan, EveryReadyPlanIsGood) {
  std::vector<std::string> methods;
  EXPECT_GE(ready_plans().size(), 3U);
  for (const auto& file : ready_plans()) {
    const plan::Plan plan = plan::load_plan(file.string(), "");
    EXPECT_EQ(plan.name, file.stem().string());
    for (const plan::PlanMethod& method : plan.methods) methods.push_back(method.method);
    EXPECT_NO_THROW(plan::check_plan(plan, methods, datasets()));
  }
}

TEST(Plan, TheSeedOfTheReleaseIsThatOfItsSentence) {
  const auto seed_of = [](const std::string& seed) {
    return plan::parse_plan(R"({"name": "p", "cases": [{"dataset": "ca", "n": [5]}], "seed": )" + seed +
                                R"(, "methods": [{"method": "polylidar", "protocol": "default"}]})",
                            "here")
        .seed;
  };
  // printf '%s' 'hullbench 1.0, released 2026-12-01' | sha256sum
  const std::string hash = sha256_hex(std::string(plan::kReleaseSentence));
  EXPECT_EQ(hash, "4b0aac3a5e4e9d070da0d47aac8679eb7f4c94cd2cf4bd45eb9753dc100056ae");
  EXPECT_EQ(seed_of("\"release\""), std::stoull(hash.substr(0, 8), nullptr, 16));
  EXPECT_EQ(seed_of("7"), 7U);
  EXPECT_THROW(seed_of("\"lucky\""), ConfigurationError);
  for (const char* name : {"world_shapes", "world_samplers", "world_crossed"})
    EXPECT_EQ(plan::load_plan(name, HULLBENCH_PLAN_FOLDER).seed, plan::release_seed()) << name;
}

// What is compared under one protocol got its parameters in one way.
TEST(Plan, EveryRuleFromThePointsIsUnderAuto) {
  for (const auto& file : ready_plans()) {
    const plan::Plan plan = plan::load_plan(file.string(), "");
    for (const plan::PlanMethod& method : plan.methods) {
      for (const auto& [name, choice] : method.parameters) {
        const auto* rule = std::get_if<plan::RuleChoice>(&choice);
        const bool automatic = rule != nullptr && rule->rule.starts_with("auto_");
        const bool a_number = name == "allow_holes" || name == "concavity";
        EXPECT_TRUE(a_number || automatic == (method.protocol == "auto"))
            << plan.name << ": " << method.method << " under " << method.protocol << ", " << name;
      }
    }
  }
}

TEST(Plan, StressSuitesAreQuickAndOnTheirAxes) {
  std::size_t cases = 0;
  int suites = 0;
  for (const auto& file : ready_plans()) {
    if (!file.stem().string().starts_with("stress_")) continue;
    const plan::Plan plan = plan::load_plan(file.string(), "");
    EXPECT_EQ(plan.axis.has_value(), plan.name != "stress_degenerate") << plan.name;
    EXPECT_EQ(plan.repetitions, 1) << plan.name;
    for (const plan::PlanMethod& method : plan.methods) EXPECT_TRUE(method.datasets.empty()) << plan.name;
    std::set<std::string> shapes;
    for (const plan::PlanCase& one : plan.expanded_cases) shapes.insert(base_shape(one.dataset));
    EXPECT_GE(shapes.size(), 3U) << plan.name;
    cases += plan.expanded_cases.size();
    ++suites;
  }
  EXPECT_EQ(suites, 10);
  EXPECT_LE(cases, 600U);
}

TEST(Plan, StatesIsThePapersExperiment) {
  const plan::Plan plan = plan::load_plan("states", HULLBENCH_PLAN_FOLDER);
  EXPECT_EQ(plan.repetitions, 10);
  EXPECT_EQ(plan.expanded_cases.size(), 24U);
  const auto count = [&](const std::string& filter) { return plan::planned_runs(plan, filter).size(); };
  for (const char* method : {"^polylidar/.*protocol:paper", "^cgal_alpha_shape/.*protocol:paper",
                             "^spatialite/.*protocol:paper", "^spatialite/.*protocol:auto"})
    EXPECT_EQ(count(method), 24U) << method;
  EXPECT_EQ(count("^polylidar/.*protocol:default"), 24U);
  EXPECT_EQ(count("^postgis_legacy/ca/"), 12U);
  EXPECT_EQ(count("^postgis_legacy/hi/"), 0U);
  EXPECT_EQ(count("^postgis/.*protocol:auto"), 24U);
  EXPECT_EQ(count("^postgis/.*protocol:paper"), 0U);
}

TEST(Plan, StepsIsThePapersExperiment) {
  const plan::Plan plan = plan::load_plan("steps", HULLBENCH_PLAN_FOLDER);
  EXPECT_EQ(plan.repetitions, 30);
  ASSERT_EQ(plan.expanded_cases.size(), 1U);
  EXPECT_EQ(plan.expanded_cases[0].n, 64000);
  for (const plan::PlannedRun& run : plan::planned_runs(plan, ""))
    expect_says(run.name, "/ca/n:64000/holes:1/");
  for (const char* method : {"polylidar", "cgal_alpha_shape", "spatialite", "postgis_steps", "chi_shape"})
    EXPECT_EQ(plan::planned_runs(plan, "^" + std::string(method) + "/.*protocol:paper").size(), 1U) << method;
  EXPECT_EQ(plan::planned_runs(plan, "^(polylidar|spatialite|postgis)_steps/.*protocol:paper").size(), 3U);
}

TEST(Plan, RandomIsThePapersExperimentAndAThousandOtherShapes) {
  const plan::Plan plan = plan::load_plan("random", HULLBENCH_PLAN_FOLDER);
  const auto count = [&](const std::string& family) {
    return std::ranges::count_if(plan.expanded_cases, [&](const plan::PlanCase& one) {
      return one.n == 8000 && split_member_name(one.dataset)->first == family;
    });
  };
  EXPECT_EQ(count("star"), 2 * 9800);
  EXPECT_EQ(plan.expanded_cases.size(), 2 * 9800 + 1000U);
  for (const plan::PlannedRun& run : plan::planned_runs(plan, plan.filter))
    ASSERT_EQ(plan.methods[run.method_index].method, "polylidar");
  EXPECT_EQ(plan::planned_runs(plan, plan.filter).size(), 2 * plan.expanded_cases.size());
  EXPECT_EQ(plan::plan_to_json(plan).at("filter"), plan.filter);
}

TEST(Plan, RgbdIsThePapersExperiment) {
  const plan::Plan plan = plan::load_plan("rgbd", HULLBENCH_PLAN_FOLDER);
  EXPECT_EQ(plan.expanded_cases.size(), 11U + 4U);
  EXPECT_EQ(plan::planned_runs(plan, "^polylidar/floor-11/n:all/holes:0/protocol:paper$").size(), 1U);
}

const plan::PlanMethod& entry_of(const plan::Plan& plan, const std::string& method,
                                 const std::string& protocol) {
  const auto found = std::ranges::find_if(plan.methods, [&](const plan::PlanMethod& one) {
    return one.method == method && one.protocol == protocol;
  });
  if (found == plan.methods.end())
    throw std::out_of_range(plan.name + " has no " + method + " under " + protocol);
  return *found;
}

TEST(Plan, AlphabetIsThePapersExperiment) {
  const plan::Plan plan = plan::load_plan("alphabet", HULLBENCH_PLAN_FOLDER);
  ASSERT_EQ(plan.expanded_cases.size(), 26U);
  for (std::size_t i = 0; i < 26; ++i) {
    EXPECT_EQ(plan.expanded_cases[i].shape(), std::string("letter_") + static_cast<char>('a' + i));
    EXPECT_EQ(plan.expanded_cases[i].n, 2000);
  }
  EXPECT_EQ(
      plan::planned_runs(plan, "^(polylidar|cgal_alpha_shape|spatialite|postgis_legacy)/.*protocol:paper")
          .size(),
      4 * 26U);
  EXPECT_EQ(plan::planned_runs(plan, "^postgis/.*protocol:auto").size(), 26U);
  const PointSet letter = make_point_set("letter_o", false, 2000, plan.seed);
  const auto parameters = [&](const std::string& method, const std::string& protocol) {
    return plan::choose_parameters(entry_of(plan, method, protocol), plan.expanded_cases[14],
                                   {letter.points, letter.ground_truth_area, false, letter.ground_truth});
  };
  const double alpha = 2 * std::sqrt(letter.ground_truth_area / 2000);
  EXPECT_EQ(parameters("polylidar", "paper"), (std::map<std::string, double>{{"alpha", alpha}}));
  EXPECT_EQ(parameters("polylidar", "default"), (std::map<std::string, double>())) << "the core's own choice";
  EXPECT_EQ(parameters("cgal_alpha_shape", "paper"),
            (std::map<std::string, double>{{"alpha", alpha * alpha}}));
  EXPECT_EQ(parameters("spatialite", "paper"), (std::map<std::string, double>{{"c", 3}, {"allow_holes", 1}}));
  EXPECT_EQ(parameters("postgis_legacy", "paper").at("allow_holes"), 1);
  EXPECT_NEAR(parameters("postgis_legacy", "paper").at("target_percent"), 0.3627,
              1e-4);  // the manifest's convexity has 4 decimals
}

// Two unit squares, one of them with a hole of a quarter's area, at the ends of a hull of 3 x 1.
const MultiPolygon kTwoSquares = {
    {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {}},
    {{{2, 0}, {3, 0}, {3, 1}, {2, 1}}, {{{2.25, 0.25}, {2.25, 0.75}, {2.75, 0.75}, {2.75, 0.25}}}}};

TEST(ParameterRule, ByName) {
  for (const std::string& name : plan::rule_names()) EXPECT_EQ(plan::find_rule(name)->name, name);
  EXPECT_EQ(plan::find_rule("none"), nullptr);
  EXPECT_TRUE(plan::find_rule("paper_alpha")->reads_ground_truth);
  EXPECT_TRUE(plan::find_rule("paper_alpha_squared")->reads_ground_truth);
  EXPECT_TRUE(plan::find_rule("paper_target_percent")->reads_ground_truth);
  EXPECT_TRUE(plan::find_rule("paper_edge_length")->reads_ground_truth);
  for (const char* name : {"auto_size", "auto_edge_length", "auto_circumradius", "auto_circumradius_squared"})
    EXPECT_FALSE(plan::find_rule(name)->reads_ground_truth) << name;
  EXPECT_EQ(plan::find_rule("hull_spacing"), nullptr) << "whose factor was never fitted";
}

TEST(ParameterRule, RulesThatDoNotReadTheGroundTruthDoNotReadIt) {
  const auto points = lattice(5, 5);
  for (const std::string& name : plan::rule_names()) {
    const plan::ParameterRule& rule = *plan::find_rule(name);
    if (rule.reads_ground_truth) continue;
    EXPECT_EQ(rule.value({points, 1.0, true}), rule.value({points, 1e6, true, kTwoSquares})) << name;
  }
}

TEST(ParameterRule, PaperAlpha) {
  const auto points = lattice(10, 10);
  EXPECT_DOUBLE_EQ(plan::paper_alpha({points, 400.0, false}), 4.0);
  EXPECT_DOUBLE_EQ(plan::paper_alpha_squared({points, 400.0, false}), 16.0);
  EXPECT_EQ(plan::paper_alpha({{}, 400.0, false}), 0.0);
  EXPECT_DOUBLE_EQ(plan::paper_edge_length({points, 400.0, false}), 8.0);
}

TEST(ParameterRule, PaperTargetPercent) {
  EXPECT_DOUBLE_EQ(plan::paper_target_percent({{}, polylidar::area(kTwoSquares), false, kTwoSquares}),
                   1.75 / 3);
  const MultiPolygon square = {{{{0, 0}, {0.1, 0}, {0.1, 0.1}, {0, 0.1}}, {}}};
  EXPECT_EQ(plan::paper_target_percent({{}, 0.02, false, square}), 1.0);  // never above the hull
  EXPECT_EQ(plan::paper_target_percent({{}, 0, false, {}}), 1.0);
}

TEST(ParameterRule, Holes) {
  EXPECT_EQ(plan::holes_switch({{}, 0, true}), 1.0);
  EXPECT_EQ(plan::holes_switch({{}, 0, false}), 0.0);
}

// What the sizes are, by the rule in plain words, is tested with the core.
TEST(ParameterRule, AutoSizeIsTheMedianOfTheSizesThatTheCoreKeepsTo) {
  const PointSet set = make_point_set("ca~gradient:16", false, 2000, 1);
  polylidar::Extractor core;
  core.extract(set.points);
  ASSERT_TRUE(core.chosen_sizes());
  EXPECT_EQ(plan::auto_size({set.points}), core.chosen_sizes()->median);
  EXPECT_LT(core.chosen_sizes()->least, plan::auto_size({set.points}));
  EXPECT_GT(core.chosen_sizes()->most, plan::auto_size({set.points}));
}

// The gaps between the points of an outline vary; the largest is bridged, the shape is not.
TEST(ParameterRule, AutoBorderLengthIsTheStepAlongOutlines) {
  const PointSet set = make_point_set("country-43~outline:0.1", false, 2000, 1);
  polylidar::Extractor core;
  core.extract(set.points);
  ASSERT_TRUE(core.statistics().by_outlines);
  EXPECT_EQ(plan::auto_border_length({set.points}), core.statistics().outline_step);
  EXPECT_GT(plan::auto_border_length({set.points}), plan::auto_edge_length({set.points}));
  const PointSet filled = make_point_set("country-43", false, 2000, 1);
  EXPECT_EQ(plan::auto_border_length({filled.points}), plan::auto_edge_length({filled.points}));
}

TEST(ParameterRule, AutoRulesAreSharesOfOneSize) {
  const PointSet set = make_point_set("hi", false, 600, 1);
  const double size = plan::auto_size({set.points});
  EXPECT_DOUBLE_EQ(plan::auto_edge_length({set.points}), plan::kEdgeShare * size);
  EXPECT_DOUBLE_EQ(plan::auto_circumradius({set.points}), plan::kCircumradiusShare * size);
  EXPECT_DOUBLE_EQ(plan::auto_circumradius_squared({set.points}),
                   std::pow(plan::kCircumradiusShare * size, 2));
  // Of an equilateral triangle the size is the edge, and the radius of its circle 1 / √3 of it: all others
  // have a longer longest edge and a larger circle.
  EXPECT_GT(plan::kEdgeShare, 1);
  EXPECT_GT(plan::kCircumradiusShare, 1 / std::sqrt(3));
}

TEST(ParameterRule, AutoRulesFollowTheScaleOfThePoints) {
  PointSet set = make_point_set("letter_b", false, 500, 1);
  const double before = plan::auto_size({set.points});
  for (Point& p : set.points) p = {4 * p.x, 4 * p.y};
  EXPECT_DOUBLE_EQ(plan::auto_size({set.points}), 4 * before);
}

TEST(ParameterRule, AutoRulesOfPointsWithoutATriangleAreZero) {
  const std::vector<Point> line = {{0, 0}, {1, 1}, {2, 2}};
  for (const char* name :
       {"auto_size", "auto_edge_length", "auto_circumradius", "auto_circumradius_squared"}) {
    EXPECT_EQ(plan::find_rule(name)->value({line}), 0) << name;
    EXPECT_EQ(plan::find_rule(name)->value({}), 0) << name;
  }
}

}  // namespace
}  // namespace hullbench::testing
