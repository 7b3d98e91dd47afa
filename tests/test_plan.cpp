// Plans: what is accepted, what is refused with which words, which runs come of it, and the parameter rules.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/parameter_rules.hpp"
#include "benchmarks/plan.hpp"
#include "datasets/datasets.hpp"
#include "polylidar/concave_hull.hpp"
#include "polylidar/delaunay.hpp"
#include "tests/temporary_folder.hpp"

namespace hullbench {
namespace {

using nlohmann::json;

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

/// What is said about such a plan.
std::string complaint_about_cases(const std::string& cases) {
  try {
    check_plan(parse_plan(plan_with_cases(cases).dump(), "plan 'small'"), kMethods, datasets_and_families());
  } catch (const ConfigurationError& error) {
    return error.what();
  }
  return "nothing";
}

std::vector<std::string> names_of(const std::vector<PlannedRun>& runs) {
  std::vector<std::string> names;
  for (const PlannedRun& run : runs) names.push_back(run.name);
  return names;
}

/// What is said about a plan in which the value at `pointer` is `value`.
std::string complaint(const std::string& pointer, const json& value) {
  json plan = small_plan();
  plan[json::json_pointer(pointer)] = value;
  try {
    check_plan(parse_plan(plan.dump(), "plan 'small'"), kMethods, known_datasets());
  } catch (const ConfigurationError& error) {
    return error.what();
  }
  return "nothing";
}

TEST(Plan, DefaultsAndValues) {
  const Plan plan = parse_plan(small_plan().dump(), "here");
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
  const json once = plan_to_json(parse_plan(source.dump(), "here"));
  EXPECT_EQ(plan_to_json(parse_plan(once.dump(), "there")), once);
  for (const auto& [key, value] : source.items()) EXPECT_EQ(once.at(key), value) << key;
}

TEST(Plan, PassesShareTheRepetitions) {
  const auto shares = [](int repetitions) {
    return std::vector{share_of_pass(repetitions, 3, 1), share_of_pass(repetitions, 3, 2),
                       share_of_pass(repetitions, 3, 3)};
  };
  EXPECT_EQ(shares(10), (std::vector{4, 3, 3}));
  EXPECT_EQ(shares(11), (std::vector{4, 4, 3}));
  EXPECT_EQ(shares(3), (std::vector{1, 1, 1}));
  EXPECT_EQ(shares(2), (std::vector{1, 1, 0}));
  EXPECT_EQ(shares(1), (std::vector{1, 0, 0}));
  EXPECT_EQ(share_of_pass(7, 1, 1), 7);
}

TEST(Plan, APlanHasOnePassUnlessItSaysSo) {
  json source = small_plan();
  EXPECT_EQ(parse_plan(source.dump(), "here").passes, 1);
  for (const json& wrong : {json(0), json(kMaxPasses + 1), json("three")}) {
    source["passes"] = wrong;
    EXPECT_THROW(parse_plan(source.dump(), "here"), ConfigurationError) << wrong;
  }
}

TEST(Plan, AParameterCanBeScaledByTheSpacingOfThePoints) {
  json source = small_plan();
  source["methods"][0]["protocol"] = "tuned";  // which may not read the ground truth
  source["methods"][0]["parameters"] = {
      {"alpha", {{"scaled", 1.5}}}, {"area", {{"scaled", 1.5}, {"power", 2}}}, {"max_edge_length", nullptr}};
  const Plan plan = parse_plan(source.dump(), "here");
  const std::vector<polylidar::Point> points = {{0, 0}, {6, 0}, {6, 6}, {0, 6}};  // spacing 3
  const auto chosen = choose_parameters(plan.methods[0], plan.expanded_cases[0], {points, 1, false, {}});
  EXPECT_DOUBLE_EQ(chosen.at("alpha"), 4.5);
  EXPECT_DOUBLE_EQ(chosen.at("area"), 20.25);
  EXPECT_EQ(chosen.at("max_edge_length"), std::numeric_limits<double>::infinity());
  const json once = plan_to_json(plan);
  EXPECT_EQ(plan_to_json(parse_plan(once.dump(), "there")), once);
}

TEST(Plan, AValueForOneNumberOfPointsGoesBeforeTheShapes) {
  json source = small_plan();
  source["methods"][1]["parameters"]["c"]["cases"] = {
      {"ca", 2.0}, {"ca/n:500", 3.0}, {"ca/holes/n:500", nullptr}, {"ca/holes/n:1000", 5.0}};
  const Plan plan = parse_plan(source.dump(), "here");
  check_plan(plan, kMethods, known_datasets());
  std::vector<double> values;
  for (const PlanCase& plan_case : plan.expanded_cases)
    values.push_back(choose_parameters(plan.methods[1], plan_case, {}).at("c"));
  EXPECT_EQ(values, (std::vector<double>{3, 2, std::numeric_limits<double>::infinity(), 5}));
  const json once = plan_to_json(plan);
  EXPECT_EQ(plan_to_json(parse_plan(once.dump(), "there")), once);
  source["methods"][1]["parameters"]["c"]["cases"].erase("ca/holes/n:1000");
  EXPECT_THROW(check_plan(parse_plan(source.dump(), "here"), kMethods, known_datasets()), ConfigurationError);
}

TEST(Plan, RunsComeCaseByCaseWithTheirNames) {
  const auto runs = planned_runs(parse_plan(small_plan().dump(), "here"), "");
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
  const Plan plan = parse_plan(source.dump(), "here");
  check_plan(plan, kMethods, known_datasets());
  std::vector<std::string> cases;
  for (const PlanCase& one : plan.expanded_cases) cases.push_back(one.shape() + " " + std::to_string(one.n));
  EXPECT_EQ(cases,
            (std::vector<std::string>{"solid 500", "solid 1000", "ca 500", "ca 1000", "ca/holes 500"}));
  const json once = plan_to_json(plan);
  EXPECT_EQ(once.at("cases"), source["cases"]);
  EXPECT_EQ(plan_to_json(parse_plan(once.dump(), "there")), once);
}

TEST(Plan, MembersStandForTheShapesOfAFamily) {
  const json source =
      plan_with_cases(R"([{"dataset": ["star", "comb"], "members": 2, "holes": [false, true], "n": [500]}])");
  const Plan plan = parse_plan(source.dump(), "here");
  std::vector<std::string> cases;
  for (const PlanCase& one : plan.expanded_cases) cases.push_back(one.shape());
  EXPECT_EQ(cases, (std::vector<std::string>{"star-1", "star-1/holes", "star-2", "star-2/holes", "comb-1",
                                             "comb-1/holes", "comb-2", "comb-2/holes"}));
  EXPECT_EQ(planned_runs(plan, "").front().name, "polylidar/star-1/n:500/holes:0/protocol:paper");
  const json once = plan_to_json(plan);
  EXPECT_EQ(once.at("cases"), source["cases"]);
  EXPECT_EQ(parse_plan(once.dump(), "there").expanded_cases.size(), plan.expanded_cases.size());
}

TEST(Plan, MembersAreLimitedToTheFamily) {
  EXPECT_EQ(complaint_about_cases(R"([{"dataset": "star", "members": 3, "n": [500]}])"), "nothing");
  EXPECT_EQ(complaint_about_cases(R"([{"dataset": "star-3", "n": [500]}])"), "nothing");
  const std::string known = "which is not known; known are ca, solid, star-1 to -3 and floor-1 to -2";
  for (const auto& [cases, name] : {std::pair(R"([{"dataset": "star", "members": 4, "n": [500]}])", "star-4"),
                                    std::pair(R"([{"dataset": "star", "n": [500]}])", "star"),
                                    std::pair(R"([{"dataset": "ca", "members": 1, "n": [500]}])", "ca-1")}) {
    EXPECT_NE(complaint_about_cases(cases).find("names the data set '" + std::string(name) + "', " + known),
              std::string::npos)
        << complaint_about_cases(cases);
  }
  for (const char* members : {"0", "1000001", "2.5", "\"all\""}) {
    const std::string said = complaint_about_cases(
        std::string(R"([{"dataset": "star", "n": [500], "members": )") + members + "}]");
    EXPECT_NE(said.find("cases[0].members must be a whole number from 1 to 1000000"), std::string::npos)
        << said;
  }
}

TEST(Plan, NumbersOfPointsAreForDataSetsWithoutPointsOfTheirOwn) {
  EXPECT_EQ(complaint_about_cases(R"([{"dataset": "floor", "members": 2}])"), "nothing");
  EXPECT_NE(complaint_about_cases(R"([{"dataset": "floor", "members": 2, "n": [500]}])")
                .find("gives 'n' for floor-1, which comes with its points; leave it out"),
            std::string::npos);
  EXPECT_NE(complaint_about_cases(R"([{"dataset": "ca"}])")
                .find("gives no 'n' for ca, which has no points of its own; add the numbers of points"),
            std::string::npos);
  EXPECT_NE(complaint_about_cases(R"([{"dataset": "star", "members": 1}])").find("gives no 'n' for star-1"),
            std::string::npos);
}

TEST(Plan, AMethodCanKeepToAFamily) {
  json source =
      plan_with_cases(R"([{"dataset": "star", "members": 2, "n": [500]}, {"dataset": "solid", "n": [500]}])");
  source["methods"][0]["datasets"] = {"star"};
  const Plan plan = parse_plan(source.dump(), "here");
  EXPECT_NO_THROW(check_plan(plan, kMethods, datasets_and_families()));
  EXPECT_EQ(planned_runs(plan, "").size(), 2U);
}

TEST(Plan, RecordingsTakeThePlaceOfSimulatedFloors) {
  const json source =
      plan_with_cases(R"([{"dataset": "floor", "members": 11}, {"dataset": "ca", "n": [500]}])");
  Plan plan = parse_plan(source.dump(), "here");
  use_recordings(plan, 2);
  const std::vector<std::string> names = {"polylidar/recorded-1/n:all/holes:0/protocol:paper",
                                          "polylidar/recorded-2/n:all/holes:0/protocol:paper",
                                          "polylidar/ca/n:500/holes:0/protocol:paper"};
  EXPECT_EQ(names_of(planned_runs(plan, "")), names);
  EXPECT_EQ(names_of(planned_runs(parse_plan(plan_to_json(plan).dump(), "there"), "")), names);
}

TEST(Plan, RecordingsNeedSimulatedFloors) {
  Plan plan = parse_plan(small_plan().dump(), "here");
  try {
    use_recordings(plan, 2);
    FAIL();
  } catch (const ConfigurationError& error) {
    EXPECT_STREQ(
        error.what(),
        "the plan 'small' has no simulated floors that recordings could take the place of; leave out "
        "--recordings, or run the plan 'rgbd'");
  }
}

TEST(Plan, FilterIsSearchedInNames) {
  const Plan plan = parse_plan(small_plan().dump(), "here");
  EXPECT_EQ(planned_runs(plan, "polylidar").size(), 4U);
  EXPECT_EQ(planned_runs(plan, "^ca").size(), 0U);
  EXPECT_EQ(planned_runs(plan, "n:500/.*holes:1").size(), 2U);
  EXPECT_THROW(planned_runs(plan, "n:(500"), ConfigurationError);
}

TEST(Plan, AMethodCanKeepToSomeDataSets) {
  json source = small_plan();
  source["cases"].push_back({{"dataset", "solid"}, {"n", {500}}});
  source["methods"][1]["datasets"] = {"ca"};
  const Plan plan = parse_plan(source.dump(), "here");
  check_plan(plan, kMethods, known_datasets());
  EXPECT_EQ(planned_runs(plan, "solid").size(), 1U);
}

TEST(Plan, NothingIsWrongWithTheSmallPlan) {
  EXPECT_EQ(complaint("/repetitions", 2), "nothing");
}

TEST(Plan, WrongPlansAreRefusedWithTheirPlace) {
  struct Case {
    const char* pointer;
    json value;
    const char* words;
  };
  const std::vector<Case> cases = {
      {"/repetition", 5,
       "plan 'small': repetition is not a key that is known here; known are schema_version, name"},
      {"/schema_version", 2, "schema_version must be 1"},
      {"/name", "Small Plan", "name must be a name of small letters"},
      {"/name", 5, "name must be a string"},
      {"/repetitions", 0, "repetitions must be a whole number from 1 to 1000000"},
      {"/repetitions", 2.5, "repetitions must be a whole number"},
      {"/repetitions", 18446744073709551615U, "repetitions must be a whole number"},
      {"/warmup", -1, "warmup must be a whole number from 0"},
      {"/timeout_s", 0, "timeout_s must be a number from 0.001"},
      {"/mem_limit_mib", 1, "mem_limit_mib must be a whole number from 64"},
      {"/seed", -1, "seed must be a whole number from 0 to 2^64 - 1"},
      {"/cases", json::array(), "cases must be a list with at least one element"},
      {"/cases/0", 5, "cases[0] must be an object"},
      {"/cases/0/size", 5,
       "cases[0].size is not a key that is known here; known are dataset, members, stress, holes and n"},
      {"/cases/0/n", 500, "cases[0].n must be a list"},
      {"/cases/0/n/1", 2, "cases[0].n[1] must be a whole number from 3"},
      {"/cases/0/n/1", 500, "cases[0].n[1] is there twice"},
      {"/cases/0/holes/1", "yes", "cases[0].holes[1] must be true or false"},
      {"/cases/0/holes/1", false, "cases[0] has the case ca with n = 500 for the second time"},
      {"/cases/0/dataset", "mars",
       "the plan 'small' names the data set 'mars', which is not known; known are ca and solid"},
      {"/cases/0/dataset", "solid", "asks for solid with holes"},
      {"/cases/0/dataset", json::array(), "cases[0].dataset must be a list with at least one element"},
      {"/cases/0/dataset", {"ca", 5}, "cases[0].dataset[1] must be a string"},
      {"/cases/0/dataset", {"ca", "ca"}, "cases[0].dataset[1] is there twice"},
      {"/cases/0/dataset", {"ca", "mars"}, "names the data set 'mars'"},
      {"/cases/1",
       {{"dataset", {"solid", "ca"}}, {"n", {500}}},
       "cases[1] has the case ca with n = 500 for the second time"},
      {"/methods/0/method", "magic",
       "names the method 'magic', which is not known; known are polylidar and spatialite"},
      {"/methods/0/colour", "red", "methods[0].colour is not a key that is known here"},
      {"/methods/0/protocol", "best",
       "methods[0].protocol must be one of paper, default, auto, tuned and oracle, not 'best'"},
      {"/methods/0/protocol", "auto",
       "methods[0].parameters.alpha.rule names the rule 'paper_alpha', which reads the ground truth"},
      {"/methods/0/timeout_s", 0, "methods[0].timeout_s must be a number from 0.001"},
      {"/methods/0/repetitions", 0, "methods[0].repetitions must be a whole number from 1"},
      {"/methods/0/mem_limit_mib", 1, "methods[0].mem_limit_mib must be a whole number from 64"},
      {"/methods/2",
       {{"method", "polylidar"}, {"protocol", "default"}, {"mem_limit_mib", 100}},
       "methods[2] gives 'polylidar' another mem_limit_mib than its other entry"},
      {"/methods/0/datasets", {"mars"}, "keep to the data set 'mars', of which it has no case"},
      {"/methods/0/parameters/alpha", "big",
       "methods[0].parameters.alpha must be a number, null or an object with the key"},
      {"/methods/0/parameters/alpha",
       {{"scaled", -1}},
       "methods[0].parameters.alpha.scaled must be a number"},
      {"/methods/0/parameters/alpha", {{"scaled", 1}, {"power", 3}}, "alpha.power must be a whole number"},
      {"/methods/0/parameters/alpha", {{"power", 2}}, "must have one of the keys 'rule', 'scaled'"},
      {"/methods/0/parameters/alpha/rule", "mine", "names the unknown rule 'mine'; known are paper_alpha"},
      {"/methods/0/parameters/alpha/cases", json::object(),
       "must have one of the keys 'rule', 'scaled' (with or without 'power') and 'cases'"},
      {"/methods/1/parameters/c/cases", {{"ca", 2}}, "gives spatialite no 'c' for ca/holes"},
      {"/methods/1/parameters/c/cases/ca", "2", "methods[1].parameters.c.cases.ca must be a number"},
  };
  for (const Case& one : cases) {
    EXPECT_NE(complaint(one.pointer, one.value).find(one.words), std::string::npos)
        << one.pointer << ": " << complaint(one.pointer, one.value);
  }
}

TEST(Plan, TwoEntriesWithTheSameRunNamesAreRefused) {
  json source = small_plan();
  source["methods"].push_back(source["methods"][0]);
  EXPECT_NE(complaint("/methods", source["methods"]).find("methods[2] repeats the method 'polylidar'"),
            std::string::npos);
}

TEST(Plan, MissingKeysAreNamed) {
  for (const char* key : {"name", "cases", "methods"}) {
    json source = small_plan();
    source.erase(key);
    try {
      parse_plan(source.dump(), "plan 'small'");
      FAIL() << key;
    } catch (const ConfigurationError& error) {
      EXPECT_EQ(error.what(), "plan 'small': the plan lacks the key '" + std::string(key) + "'");
    }
  }
}

TEST(Plan, BrokenJsonIsRefusedWithItsPlace) {
  try {
    parse_plan("{\n  \"name\": \"small\",\n  \"cases\" [\n}", "plan 'small'");
    FAIL();
  } catch (const ConfigurationError& error) {
    EXPECT_STREQ(error.what(), "plan 'small' is not JSON: mend it at line 3, column 11");
  }
  EXPECT_THROW(parse_plan("", "here"), ConfigurationError);
  EXPECT_THROW(parse_plan("[]", "here"), ConfigurationError);
}

std::vector<std::string> datasets_of(const Plan& plan) {
  std::vector<std::string> names;
  for (const PlanCase& one : plan.expanded_cases) names.push_back(one.dataset);
  return names;
}

TEST(Plan, EveryDataSetStandsWithEveryStress) {
  const Plan plan = parse_plan(plan_with_cases(R"([{"dataset": ["ca", "star-2~noise:1"], "n": [9]},
                          {"dataset": "star", "members": 2, "stress": ["noise:0", "outliers:2.5"], "n": [9]}])")
                                   .dump(),
                               "here");
  EXPECT_EQ(datasets_of(plan),
            (std::vector<std::string>{"ca", "star-2~noise:1", "star-1~noise:0", "star-1~outliers:2.5",
                                      "star-2~noise:0", "star-2~outliers:2.5"}));
  EXPECT_EQ(planned_runs(plan, "")[1].name, "polylidar/star-2~noise:1/n:9/holes:0/protocol:paper");
  EXPECT_NO_THROW(check_plan(plan, kMethods, datasets_and_families()));
  EXPECT_EQ(datasets_of(parse_plan(plan_to_json(plan).dump(), "there")), datasets_of(plan));
}

TEST(Plan, MethodsThatKeepToAShapeOrAFamilyKeepToItUnderStressToo) {
  json document =
      plan_with_cases(R"([{"dataset": ["ca", "star-2"], "stress": ["noise:0", "noise:1"], "n": [9]}])");
  const auto count = [&](const std::string& dataset) {
    document["methods"][0]["datasets"] = {dataset};
    return planned_runs(parse_plan(document.dump(), "here"), "").size();
  };
  EXPECT_EQ(count("ca"), 2U);
  EXPECT_EQ(count("star"), 2U);
  EXPECT_EQ(count("star-2"), 2U);
  EXPECT_EQ(count("star-2~noise:1"), 1U);
  EXPECT_EQ(count("star-3"), 0U);
}

TEST(Plan, StressThatThereIsNotIsRefused) {
  EXPECT_EQ(complaint_about_cases(R"([{"dataset": "ca", "stress": ["fog:1"], "n": [9]}])"),
            "plan 'small': cases[0].stress[0] must be one of noise, outliers, gradient, clusters, poisson, "
            "lattice and "
            "boundary, with a ':' and a level in its range behind it ('hullbench list'), not 'fog:1'");
  EXPECT_EQ(complaint_about_cases(R"([{"dataset": "ca", "stress": ["noise:1", "noise:1"], "n": [9]}])"),
            "plan 'small': cases[0].stress[1] is there twice; leave one out");
  EXPECT_EQ(
      complaint_about_cases(R"([{"dataset": "ca~fog:1", "n": [9]}])"),
      "the plan 'small' names the data set 'ca~fog:1', which is not known; known are ca, solid, star-1 to -3 "
      "and floor-1 to -2 ('hullbench list')");
  EXPECT_NE(complaint_about_cases(R"([{"dataset": "floor-1~noise:1"}])")
                .find("'floor-1~noise:1', which is not known"),
            std::string::npos);
  for (const char* name : {"~noise:1", "Ca~noise:1", "ca:noise", "ca.5~noise:1", "ca~noise/1"}) {
    EXPECT_EQ(
        complaint("/cases/0/dataset", name),
        std::string(
            "plan 'small': cases[0].dataset must be a data set's name of small letters, digits, '_' and "
            "'-', with a stress behind it or without (ca, ca~noise:0.5), not '") +
            name + "'");
  }
}

TEST(Plan, AxisIsReadAndWritten) {
  json document = plan_with_cases(R"([{"dataset": "ca", "stress": ["noise:0", "noise:1"], "n": [9]}])");
  EXPECT_FALSE(parse_plan(document.dump(), "here").axis);
  document["axis"] = {{"of", "noise"}, {"title", "Noise"}, {"unit", "h"}};
  const Plan plan = parse_plan(document.dump(), "here");
  ASSERT_TRUE(plan.axis);
  EXPECT_EQ(plan.axis->of, "noise");
  EXPECT_EQ(plan_to_json(plan).at("axis"), document["axis"]);
  EXPECT_NO_THROW(check_plan(plan, kMethods, known_datasets()));
  document["axis"] = {{"of", "noise"}};
  EXPECT_EQ(parse_plan(document.dump(), "here").axis->title, "noise");
}

TEST(Plan, EveryCaseHasAPlaceOnTheAxis) {
  json document =
      plan_with_cases(R"([{"dataset": "ca", "stress": ["noise:0"], "n": [9]}, {"dataset": "ca", "n": [9]}])");
  const auto check = [&](const char* of) {
    document["axis"] = {{"of", of}};
    check_plan(parse_plan(document.dump(), "here"), kMethods, known_datasets());
  };
  EXPECT_NO_THROW(check("n"));
  EXPECT_NO_THROW(check("sampling"));
  try {
    check("noise");
    FAIL();
  } catch (const ConfigurationError& error) {
    EXPECT_STREQ(
        error.what(),
        "the plan 'small' has the axis 'noise', of which its case ca has no level; choose n, sampling or a "
        "level of every case");
  }
}

TEST(Plan, AcceptedStatusesAreReadAndWritten) {
  json document = small_plan();
  document["accepted"] = {"error", "unsupported"};
  const Plan plan = parse_plan(document.dump(), "here");
  EXPECT_EQ(plan.accepted, (std::vector<std::string>{"error", "unsupported"}));
  EXPECT_EQ(plan_to_json(plan).at("accepted"), document["accepted"]);
  EXPECT_EQ(complaint("/accepted", {"broken"}),
            "plan 'small': accepted[0] must be one of ok, timeout, memory, crash, error, invalid_output, "
            "unsupported "
            "and not_installed, not 'broken'");
}

TEST(Plan, IsFoundByNameOrByPath) {
  const testing::TemporaryFolder folder;
  std::ofstream(folder.path() / "small.json") << small_plan();
  EXPECT_EQ(load_plan("small", folder.path()).name, "small");
  EXPECT_EQ(load_plan((folder.path() / "small.json").string(), "/nowhere").name, "small");
  try {
    load_plan("smal", folder.path());
    FAIL();
  } catch (const ConfigurationError& error) {
    EXPECT_STREQ(error.what(), "there is no plan 'smal'; known are small, or give a file's path");
  }
}

TEST(Plan, EveryReadyPlanIsGood) {
  std::vector<std::string> methods;
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(HULLBENCH_PLAN_FOLDER)) {
    const Plan plan = load_plan(entry.path().string(), "");
    EXPECT_EQ(plan.name, entry.path().stem().string());
    for (const PlanMethod& method : plan.methods) methods.push_back(method.method);
    EXPECT_NO_THROW(check_plan(plan, methods, datasets()));
    ++count;
  }
  EXPECT_GE(count, 3);
}

TEST(Plan, StressSuitesAreQuickAndOnTheirAxes) {
  std::size_t cases = 0;
  int suites = 0;
  for (const auto& entry : std::filesystem::directory_iterator(HULLBENCH_PLAN_FOLDER)) {
    if (!entry.path().stem().string().starts_with("stress_")) continue;
    const Plan plan = load_plan(entry.path().string(), "");
    EXPECT_EQ(plan.axis.has_value(), plan.name != "stress_degenerate") << plan.name;
    EXPECT_EQ(plan.repetitions, 1) << plan.name;
    for (const PlanMethod& method : plan.methods) EXPECT_TRUE(method.datasets.empty()) << plan.name;
    std::set<std::string> shapes;
    for (const PlanCase& one : plan.expanded_cases) shapes.insert(base_shape(one.dataset));
    EXPECT_GE(shapes.size(), 3U) << plan.name;
    cases += plan.expanded_cases.size();
    ++suites;
  }
  EXPECT_EQ(suites, 10);
  EXPECT_LE(cases, 600U);
}

TEST(Plan, StatesIsThePapersExperiment) {
  const Plan plan = load_plan("states", HULLBENCH_PLAN_FOLDER);
  EXPECT_EQ(plan.repetitions, 10);
  EXPECT_EQ(plan.expanded_cases.size(), 24U);
  const auto count = [&](const std::string& filter) { return planned_runs(plan, filter).size(); };
  for (const char* method : {"^polylidar/.*protocol:paper", "^cgal_alpha_shape/", "^spatialite/"})
    EXPECT_EQ(count(method), 24U) << method;
  EXPECT_EQ(count("^polylidar/.*protocol:default"), 24U);
  EXPECT_EQ(count("^postgis_legacy/ca/"), 12U);
  EXPECT_EQ(count("^postgis_legacy/hi/"), 0U);
  EXPECT_EQ(count("^postgis/.*protocol:auto"), 24U);
  EXPECT_EQ(count("^postgis/.*protocol:paper"), 0U);
}

TEST(Plan, StepsIsThePapersExperiment) {
  const Plan plan = load_plan("steps", HULLBENCH_PLAN_FOLDER);
  EXPECT_EQ(plan.repetitions, 30);
  ASSERT_EQ(plan.expanded_cases.size(), 1U);
  EXPECT_EQ(plan.expanded_cases[0].n, 64000);
  EXPECT_EQ(planned_runs(plan, "/ca/n:64000/holes:1/").size(), 7U);
  EXPECT_EQ(planned_runs(plan, "^(spatialite|postgis)_steps/.*protocol:paper").size(), 2U);
}

TEST(Plan, RandomIsThePapersExperimentAndAThousandOtherShapes) {
  const Plan plan = load_plan("random", HULLBENCH_PLAN_FOLDER);
  const auto count = [&](const std::string& family) {
    return std::count_if(plan.expanded_cases.begin(), plan.expanded_cases.end(), [&](const PlanCase& one) {
      return one.n == 8000 && split_member_name(one.dataset)->first == family;
    });
  };
  EXPECT_EQ(count("star"), 2 * 9800);
  EXPECT_EQ(plan.expanded_cases.size(), 2 * 9800 + 1000U);
  EXPECT_EQ(plan.filter, "^polylidar/");
  EXPECT_EQ(plan_to_json(plan).at("filter"), "^polylidar/");
}

TEST(Plan, RgbdIsThePapersExperiment) {
  const Plan plan = load_plan("rgbd", HULLBENCH_PLAN_FOLDER);
  EXPECT_EQ(plan.expanded_cases.size(), 11U);
  EXPECT_EQ(planned_runs(plan, "^polylidar/floor-11/n:all/holes:0/protocol:paper$").size(), 1U);
}

TEST(Plan, AlphabetIsThePapersExperiment) {
  const Plan plan = load_plan("alphabet", HULLBENCH_PLAN_FOLDER);
  ASSERT_EQ(plan.expanded_cases.size(), 26U);
  for (std::size_t i = 0; i < 26; ++i) {
    EXPECT_EQ(plan.expanded_cases[i].shape(), std::string("letter_") + static_cast<char>('a' + i));
    EXPECT_EQ(plan.expanded_cases[i].n, 2000);
  }
  EXPECT_EQ(planned_runs(plan, "^(polylidar|cgal|spatialite|postgis).*protocol:paper").size(), 4 * 26U);
  EXPECT_EQ(planned_runs(plan, "^postgis/.*protocol:auto").size(), 26U);
  const PointSet letter = make_point_set("letter_o", false, 2000, plan.seed);
  const auto parameters = [&](std::size_t method) {
    return choose_parameters(plan.methods[method], plan.expanded_cases[14],
                             {letter.points, letter.ground_truth_area, false, letter.ground_truth});
  };
  const double alpha = 2 * std::sqrt(letter.ground_truth_area / 2000);
  EXPECT_EQ(parameters(0), (std::map<std::string, double>{{"alpha", alpha}}));
  EXPECT_EQ(parameters(1), (std::map<std::string, double>())) << "the core's own choice";
  EXPECT_EQ(parameters(2), (std::map<std::string, double>{{"alpha", alpha * alpha}}));
  EXPECT_EQ(parameters(3), (std::map<std::string, double>{{"c", 3}, {"allow_holes", 1}}));
  EXPECT_EQ(parameters(4).at("allow_holes"), 1);
  EXPECT_NEAR(parameters(4).at("target_percent"), 0.3627, 1e-4);  // the manifest's convexity has 4 decimals
}

std::vector<polylidar::Point> unit_grid(int side) {
  std::vector<polylidar::Point> points;
  for (int x = 0; x < side; ++x) {
    for (int y = 0; y < side; ++y) points.push_back({static_cast<double>(x), static_cast<double>(y)});
  }
  return points;
}

// Two unit squares, one of them with a hole of a quarter's area, at the ends of a hull of 3 x 1.
const polylidar::MultiPolygon kTwoSquares = {
    {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {}},
    {{{2, 0}, {3, 0}, {3, 1}, {2, 1}}, {{{2.25, 0.25}, {2.25, 0.75}, {2.75, 0.75}, {2.75, 0.25}}}}};

TEST(ParameterRule, ByName) {
  for (const std::string& name : rule_names()) EXPECT_EQ(find_rule(name)->name, name);
  EXPECT_EQ(find_rule("none"), nullptr);
  EXPECT_TRUE(find_rule("paper_alpha")->reads_ground_truth);
  EXPECT_TRUE(find_rule("paper_alpha_squared")->reads_ground_truth);
  EXPECT_TRUE(find_rule("paper_target_percent")->reads_ground_truth);
  EXPECT_TRUE(find_rule("paper_edge_length")->reads_ground_truth);
  EXPECT_FALSE(find_rule("hull_spacing")->reads_ground_truth);
  EXPECT_FALSE(find_rule("hull_spacing_ratio")->reads_ground_truth);
}

TEST(ParameterRule, RulesThatDoNotReadTheGroundTruthDoNotReadIt) {
  const auto points = unit_grid(5);
  for (const std::string& name : rule_names()) {
    const ParameterRule& rule = *find_rule(name);
    if (rule.reads_ground_truth) continue;
    EXPECT_EQ(rule.value({points, 1.0, true}), rule.value({points, 1e6, true, kTwoSquares})) << name;
  }
}

TEST(ParameterRule, PaperAlpha) {
  const auto points = unit_grid(10);
  EXPECT_DOUBLE_EQ(paper_alpha({points, 400.0, false}), 4.0);
  EXPECT_DOUBLE_EQ(paper_alpha_squared({points, 400.0, false}), 16.0);
  EXPECT_EQ(paper_alpha({{}, 400.0, false}), 0.0);
}

TEST(ParameterRule, EdgeLengths) {
  const auto points = unit_grid(10);
  EXPECT_DOUBLE_EQ(paper_edge_length({points, 400.0, false}), 8.0);
  EXPECT_DOUBLE_EQ(hull_spacing({points, 0, false}), 2.7);  // 3 * sqrt(81 / 100)
  EXPECT_EQ(hull_spacing({{}, 0, false}), 0.0);
}

TEST(ParameterRule, PaperTargetPercent) {
  EXPECT_DOUBLE_EQ(paper_target_percent({{}, polylidar::area(kTwoSquares), false, kTwoSquares}), 1.75 / 3);
  const polylidar::MultiPolygon square = {{{{0, 0}, {0.1, 0}, {0.1, 0.1}, {0, 0.1}}, {}}};
  EXPECT_EQ(paper_target_percent({{}, 0.02, false, square}), 1.0);  // never above the hull
  EXPECT_EQ(paper_target_percent({{}, 0, false, {}}), 1.0);
}

TEST(ParameterRule, Holes) {
  EXPECT_EQ(holes_switch({{}, 0, true}), 1.0);
  EXPECT_EQ(holes_switch({{}, 0, false}), 0.0);
}

TEST(ParameterRule, HullSpacingRatioLiesBetweenShortestAndLongestEdge) {
  // A 10 x 10 block of unit squares' corners and one point far away. Convex hull: the square of side 9 and
  // the triangle to (40, 0), 81 + 9 * 31 / 2. The edges reach from 1 to the length of the hull's long side
  // from (9, 9) to (40, 0).
  auto points = unit_grid(10);
  points.push_back({40, 0});
  const double wanted = 3 * std::sqrt((81 + 9 * 31 / 2.0) / 101);
  const double longest = std::hypot(31, 9);
  EXPECT_NEAR(hull_spacing_ratio({points, 0, false}), (wanted - 1) / (longest - 1), 1e-12);  // rounding only
}

TEST(ParameterRule, HullSpacingRatioIsClamped) {
  const auto grid = unit_grid(4);  // wanted 2.25, edges from 1 to 1.41
  EXPECT_EQ(hull_spacing_ratio({grid, 0, false}), 1.0);
  const std::vector<polylidar::Point> line = {{0, 0}, {1, 1}, {2, 2}};
  EXPECT_EQ(hull_spacing_ratio({line, 0, false}), 1.0);
  EXPECT_EQ(hull_spacing_ratio({{}, 0, false}), 1.0);
}

}  // namespace
}  // namespace hullbench
