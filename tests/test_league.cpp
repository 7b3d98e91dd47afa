// The league: medians by method and protocol with failures, regret against the method's own oracle, holes,
// the split, and performance profiles.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "benchmarks/league/league.hpp"
#include "benchmarks/league/league_report.hpp"
#include "benchmarks/record/validate.hpp"
#include "tests/complaint.hpp"

namespace hullbench::testing {
namespace {

json row(const std::string& method, const std::string& protocol, const std::string& dataset, json l2) {
  const bool ok = !l2.is_null();
  json metrics = json::object();
  if (ok) metrics = {{"l2", l2}, {"ground_truth_area", 10.0}, {"holes", 0}, {"holes_error", 0}};
  return {{"name", method + "/" + dataset + "/n:100/holes:0/protocol:" + protocol},
          {"method", method},
          {"protocol", protocol},
          {"dataset", dataset},
          {"seed", 1},
          {"status", ok ? "ok" : "crash"},
          {"metrics", metrics}};
}

json report(const std::vector<json>& rows) {
  return {
      {"created", "2026-01-01T00:00:00Z"},
      {"tool", json::object()},
      {"environment", json::object()},
      {"plan", {{"name", "made-up"}}},
      {"methods", json::array({{{"name", "good"}, {"title", "Good"}}, {{"name", "bad"}, {"title", "Bad"}}})},
      {"runs", rows}};
}

league::League league_of(const std::vector<json>& rows) {
  return league::make_league({report(rows)}, false);
}

const league::LeagueEntry& entry(const league::League& league, std::string_view method,
                                 std::string_view protocol) {
  for (const league::LeagueEntry& one : league.entries) {
    if (one.method == method && one.protocol == protocol) return one;
  }
  throw std::runtime_error("there is no entry " + std::string(method) + " " + std::string(protocol));
}

TEST(League, TakesTheMedianOverCases) {
  const league::League league = league_of({row("good", "auto", "a", 0.1), row("good", "auto", "b", 0.3),
                                           row("good", "auto", "c", 0.2), row("bad", "auto", "a", 0.5)});
  const league::LeagueEntry& good = entry(league, "good", "auto");
  EXPECT_EQ(good.cases, 3U);
  EXPECT_EQ(good.l2->median, 0.2);
  ASSERT_TRUE(good.l2->interval);
  EXPECT_EQ(good.l2->interval->low, 0.1);
  EXPECT_EQ(good.l2->interval->high, 0.3);
  EXPECT_FALSE(entry(league, "bad", "auto").l2->interval) << "of a single shape";
  EXPECT_EQ(league.cases, 3U);
  EXPECT_EQ(league.shapes, 3U);
  EXPECT_FALSE(good.regret) << "no oracle was measured";
}

TEST(League, AFailureIsInfinitelyBadAndNeverDropped) {
  const league::League league = league_of({row("bad", "auto", "a", 0.1), row("bad", "auto", "b", nullptr),
                                           row("bad", "auto", "c", nullptr), row("good", "auto", "b", 0.4),
                                           row("good", "auto", "c", 0.4), row("good", "auto", "a", 0.4)});
  const league::LeagueEntry& bad = entry(league, "bad", "auto");
  EXPECT_EQ(bad.failures, 2U);
  EXPECT_EQ(bad.failures_by_status, (std::map<std::string, std::size_t>{{"crash", 2}}));
  EXPECT_TRUE(std::isinf(bad.l2->median));
  EXPECT_EQ(league.entries.front().method, "good") << "the better median is first";
}

TEST(League, AMedianOfFewCasesStandsBehindThoseOfAll) {
  const league::League league = league_of({row("bad", "auto", "a", 0.01), row("good", "auto", "a", 0.2),
                                           row("good", "auto", "b", 0.3), row("good", "auto", "c", 0.2)});
  EXPECT_EQ(league.entries.front().method, "good");
  EXPECT_EQ(league.entries.back().l2->cases, 1U);
}

TEST(League, RegretIsAgainstTheSameMethodsOracleOnTheSameCase) {
  json with_holes = row("good", "oracle", "a", 0.05);
  const league::League league =
      league_of({row("good", "auto", "a", 0.15), row("good", "auto", "b", 0.4), with_holes,
                 row("good", "oracle", "b", nullptr), row("bad", "oracle", "b", 0.01)});
  const league::LeagueEntry& good = entry(league, "good", "auto");
  ASSERT_TRUE(good.regret);
  EXPECT_EQ(good.regret->cases, 1U) << "where the oracle failed nothing can be said";
  EXPECT_NEAR(good.regret->median, 0.1, 1e-12);
}

TEST(League, HolesCountWhereTheGroundTruthHasSome) {
  json found = row("good", "auto", "ring", 0.1);
  found["metrics"].update({{"holes", 2}, {"holes_error", 1}, {"hole_f1", 0.7}});
  json spurious = row("good", "auto", "disc", 0.1);
  spurious["metrics"].update({{"holes", 1}, {"holes_error", 1}, {"hole_f1", 0.0}});
  const league::League league = league_of({found, spurious, row("bad", "auto", "ring", nullptr)});
  EXPECT_EQ(entry(league, "good", "auto").hole_f1->cases, 1U);
  EXPECT_EQ(entry(league, "good", "auto").hole_f1->median, 0.7);
  EXPECT_EQ(entry(league, "bad", "auto").hole_f1->median, 0) << "a failure finds no hole";
  EXPECT_EQ(entry(league, "bad", "auto").hole_f1_mean->mean, 0);
  EXPECT_FALSE(entry(league, "bad", "auto").hole_f1_mean->interval) << "of one shape";
}

TEST(League, TheMeanOfHolesIsOverCasesWithAnIntervalByShape) {
  const auto with_f1 = [](const std::string& shape, double f1) {
    json one = row("good", "auto", shape, 0.1);
    one["metrics"].update({{"holes", 2}, {"holes_error", 0}, {"hole_f1", f1}});
    return one;
  };
  const league::League league = league_of({with_f1("a", 0.4), with_f1("b", 0.6), with_f1("c", 0.5)});
  const league::LeagueEntry& good = entry(league, "good", "auto");
  ASSERT_TRUE(good.hole_f1_mean && good.hole_f1_mean->interval);
  EXPECT_NEAR(good.hole_f1_mean->mean, 0.5, 1e-12);
  // The standard error of 0.4, 0.6, 0.5 is 0.1 / sqrt(3), Student's t of two degrees of freedom 4.30.
  EXPECT_NEAR(good.hole_f1_mean->interval->high, 0.5 + 4.302653 * 0.1 / std::sqrt(3.0), 1e-4);
  EXPECT_NEAR(good.hole_f1_mean->interval->low, 0.5 - 4.302653 * 0.1 / std::sqrt(3.0), 1e-4);
  const league::League wide = league_of({with_f1("a", 0), with_f1("b", 1)});
  EXPECT_EQ(entry(wide, "good", "auto").hole_f1_mean->interval->low, 0) << "no F1 is below";
  EXPECT_EQ(entry(wide, "good", "auto").hole_f1_mean->interval->high, 1);
}

/// A row whose ground truth has so many parts and holes.
json row_of_truth(const std::string& method, const std::string& dataset, double l2, int parts, int holes) {
  json one = row(method, "auto", dataset, l2);
  one["metrics"].update(
      {{"polygons", 1}, {"polygons_error", 1 - parts}, {"holes", 0}, {"holes_error", -holes}});
  return one;
}

TEST(League, EveryStratumCountsTheSameAndInItEveryShape) {
  // Three strata: uniform simple (two shapes), noise simple (one shape with two cases), uniform holes.
  const league::League league =
      league_of({row_of_truth("good", "a", 0.1, 1, 0), row_of_truth("good", "b", 0.2, 1, 0),
                 row_of_truth("good", "c~noise:1", 0.5, 1, 0), row_of_truth("good", "c~noise:2", 0.5, 1, 0),
                 row_of_truth("good", "d", 0.9, 1, 2)});
  const league::LeagueEntry& good = entry(league, "good", "auto");
  EXPECT_EQ(good.l2->median, 0.5) << "a third lies below, a third above";
  EXPECT_EQ(good.kinds.at("simple").cases, 4U);
  EXPECT_NEAR(good.kinds.at("simple").l2_median, 0.35, 1e-12) << "half of it is 0.2 or less";
  EXPECT_EQ(good.kinds.at("holes").l2_median, 0.9);
  EXPECT_FALSE(good.kinds.contains("several parts"));
  EXPECT_EQ(good.samplers.at("noise").cases, 2U);
  ASSERT_EQ(league.samplers.size(), 2U);
  EXPECT_EQ(league.samplers[0].name, "uniform");
  EXPECT_EQ(league.kinds.size(), 2U);
}

TEST(League, WhoCannotHaveHolesOrPartsIsJudgedWhereItCanAndEverywhere) {
  json made = report({row_of_truth("good", "a", 0.1, 1, 0), row_of_truth("good", "b", 0.2, 1, 1),
                      row_of_truth("good", "c", 0.3, 2, 0), row_of_truth("bad", "a", 0.1, 1, 0),
                      row_of_truth("bad", "b", 0.5, 1, 1), row_of_truth("bad", "c", 0.6, 2, 0)});
  made["methods"][1]["capabilities"] = {{"holes", false}, {"several_polygons", false}};
  const league::League league = league::make_league({made}, false);
  EXPECT_EQ(entry(league, "bad", "auto").l2->median, 0.5);
  EXPECT_EQ(entry(league, "bad", "auto").l2_where_able->median, 0.1);
  EXPECT_EQ(entry(league, "bad", "auto").l2_where_able->cases, 1U);
  EXPECT_EQ(entry(league, "good", "auto").l2_where_able->cases, 3U);
  made["methods"][1]["capabilities"] = {{"holes", true}, {"several_polygons", false}};
  EXPECT_EQ(entry(league::make_league({made}, false), "bad", "auto").l2_where_able->cases, 2U);
}

TEST(League, AWayToSampleThatTrainingDoesNotKnowIsMarked) {
  const std::vector<json> reports = {
      report({row("good", "auto", "ca", 0.1), row("good", "auto", "ca~noise:1", 0.123),
              row("good", "auto", "ca~lattice:0", 0.2), row("good", "auto", "ca~gradient:4~noise:1", 0.3)})};
  const json league = league::league_to_json(league::make_league(reports, true), reports);
  EXPECT_EQ(record::validate_by_kind(league), std::vector<std::string>());
  std::ostringstream text;
  table::print_markdown(league::league_document(league), text);
  for (const char* words :
       {"| noise |", "lattice † |", "several |", "12.3", "†: a way to sample that was not seen"})
    expect_says(text.str(), words);
}

TEST(League, DegenerateInputIsCountedApart) {
  const json tiny = row("good", "auto", "degenerate_tiny", 12345.0);
  json unscored = row("good", "auto", "degenerate_one", 0.1);
  unscored["metrics"] = {{"l2", nullptr}, {"ground_truth_area", 0.0}};
  json refused = row("bad", "auto", "degenerate_one", nullptr);
  refused["status"] = "unsupported";
  const json crashed = row("bad", "auto", "degenerate_two", nullptr);
  json degenerate = report({tiny, unscored, refused, crashed});
  degenerate["plan"]["accepted"] = {"unsupported"};
  const league::League league =
      league::make_league({degenerate, report({row("good", "auto", "a", 0.1)})}, false);
  EXPECT_EQ(entry(league, "good", "auto").cases, 1U);
  EXPECT_EQ(entry(league, "good", "auto").l2->median, 0.1);
  EXPECT_EQ(entry(league, "good", "auto").unscored_cases, 2U);
  EXPECT_EQ(entry(league, "bad", "auto").unscored_cases, 2U);
  EXPECT_EQ(entry(league, "bad", "auto").unscored_failures, 1U);
  EXPECT_EQ(entry(league, "bad", "auto").failures, 0U);
  EXPECT_EQ(league.cases, 1U);
}

TEST(League, OnePlanAcceptsNothingForAnother) {
  json failed = row("good", "auto", "degenerate_one", nullptr);
  failed["status"] = "error";
  json flat = row("good", "auto", "degenerate_flat", nullptr);
  flat["status"] = "error";
  json accepting = report({failed});
  accepting["plan"]["accepted"] = {"error"};
  EXPECT_EQ(entry(league::make_league({accepting, report({flat})}, false), "good", "auto").unscored_failures,
            1U);
}

TEST(League, OfTestShapesHasNoOther) {
  const std::vector<json> rows = {
      row("good", "auto", "star-1", 0.5), row("good", "auto", "star-1~noise:1", 0.9),
      row("good", "auto", "star-1~lattice:0", 0.9), row("good", "auto", "ca", 0.1)};
  const league::League league = league::make_league({report(rows)}, true);
  EXPECT_EQ(entry(league, "good", "auto").cases, 1U);
  EXPECT_EQ(entry(league, "good", "auto").l2->median, 0.1);
  EXPECT_THROW(league::make_league({report({rows[0], rows[1], rows[2]})}, true), std::runtime_error);
}

TEST(League, ARunThatSeveralReportsHaveCountsOnce) {
  const league::League league =
      league::make_league({report({row("good", "auto", "a", 0.1)}),
                           report({row("good", "auto", "a", 0.2), row("good", "auto", "b", 0.2)})},
                          false);
  EXPECT_EQ(entry(league, "good", "auto").cases, 2U);
  EXPECT_NEAR(entry(league, "good", "auto").l2->median, 0.15, 1e-12);
}

TEST(League, ProfilesAreAmongThoseThatKnowAsMuch) {
  const league::League league = league_of(
      {row("good", "auto", "a", 0.1), row("good", "auto", "b", 0.2), row("good", "auto", "c", 0.3),
       row("bad", "default", "a", 0.2), row("bad", "default", "b", 0.1), row("bad", "default", "c", nullptr),
       row("good", "oracle", "a", 0.01), row("good", "auto", "only-here", 0.1)});
  std::map<std::string, league::LeagueProfile> profiles;
  for (const league::LeagueProfile& profile : league.profiles) profiles[profile.group] = profile;
  ASSERT_TRUE(profiles.contains("blind"));
  const league::LeagueProfile& blind = profiles.at("blind");
  EXPECT_EQ(blind.cases, 3U) << "what only one of them has is no comparison";
  std::map<std::string, std::vector<double>> shares;
  for (const auto& curve : blind.curves) shares[curve.method] = curve.shares;
  const auto at = [&](double tau) {
    for (std::size_t k = 0; k < league::league_taus().size(); ++k) {
      if (league::league_taus()[k] == tau) return k;
    }
    throw std::runtime_error("no such tau");
  };
  EXPECT_NEAR(shares.at("good")[at(1)], 2.0 / 3, 1e-12);
  EXPECT_NEAR(shares.at("good")[at(2)], 1, 1e-12);
  EXPECT_NEAR(shares.at("bad")[at(1)], 1.0 / 3, 1e-12);
  EXPECT_NEAR(shares.at("bad")[at(10)], 2.0 / 3, 1e-12) << "a failure is within no factor";
  EXPECT_EQ(profiles.at("oracle").curves.size(), 1U);
}

TEST(League, WaysToSampleThatTheSplitDoesNotKnowAreParts) {
  const league::League league =
      league_of({row("good", "auto", "towns-be", 0.1), row("good", "auto", "ca~gradient:4~noise:1", 0.2),
                 row("good", "auto", "ca", 0.3)});
  std::vector<std::string> names;
  for (const league::LeaguePart& part : league.samplers) {
    names.push_back(part.name);
    EXPECT_EQ(part.cases, 1U) << part.name;
    EXPECT_TRUE(part.name != "towns" || !part.seen);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"uniform", "towns", "several"}));
}

TEST(League, WhoDiffersByRoundingIsBestToo) {
  const league::League league =
      league_of({row("good", "auto", "a", 0.1), row("bad", "auto", "a", 0.1 + 1e-10)});
  EXPECT_EQ(league.entries.front().method, "bad") << "by name";
  for (const auto& curve : league.profiles.front().curves) EXPECT_EQ(curve.shares.front(), 1) << curve.method;
}

TEST(League, AnEntryWithFewCasesDoesNotTakeAwayTheOthers) {
  const league::League league =
      league_of({row("good", "auto", "a", 0.1), row("good", "auto", "b", 0.2), row("good", "auto", "c", 0.3),
                 row("good", "default", "a", 0.2), row("good", "default", "b", 0.2),
                 row("good", "default", "c", 0.2), row("bad", "auto", "a", 0.01)});
  const league::LeagueProfile& blind = league.profiles.front();
  EXPECT_EQ(blind.cases, 3U);
  EXPECT_EQ(blind.curves.size(), 2U);
  ASSERT_EQ(blind.left_out.size(), 1U);
  EXPECT_EQ(blind.left_out[0].first, "bad");
}

TEST(League, IsWrittenAsItsSchemaSaysAndPrinted) {
  const std::vector<json> reports = {
      report({row("good", "auto", "a", 0.1), row("good", "auto", "b", 0.3), row("bad", "auto", "a", nullptr),
              row("bad", "auto", "b", nullptr)})};
  const json league = league::league_to_json(league::make_league(reports, false), reports);
  EXPECT_EQ(record::validate_by_kind(league), std::vector<std::string>());
  json wrong = league;
  wrong["methods"][0]["l2_median"] = "good";
  EXPECT_NE(record::validate_by_kind(wrong), std::vector<std::string>());
  std::ostringstream text;
  table::print_markdown(league::league_document(league), text);
  expect_says(text.str(), "20.00 (10.00 to 30.00)");
  expect_says(text.str(), "∞");
}

TEST(League, WritesEveryResultThatCountsAsALine) {
  json timed = row("good", "auto", "a~noise:1", 0.125);
  timed.update({{"time_ns", {3'000'000, 1'000'000, 2'000'000}}, {"n", 100}, {"base_shape", "a"}});
  json failed = row("bad", "auto", "a~noise:1", nullptr);
  failed.update({{"time_ns", {5}}, {"n", 100}, {"base_shape", "a"}});
  json open = row("good", "auto", "points", 0.5);
  open["metrics"].erase("ground_truth_area");
  EXPECT_EQ(league::league_csv(league_of({timed, failed, open})),
            "method,task,fold,error,time,points,status,shape,kind,sampler,weight\n"
            "bad/auto,a~noise:1/n:100/holes:0,1,inf,,100,crash,a,simple,noise,1\n"
            "good/auto,a~noise:1/n:100/holes:0,1,0.125,0.002,100,ok,a,simple,noise,1\n");
}

TEST(League, EveryProfileIsShownWhoeverIsAhead) {
  const std::vector<json> reports = {
      report({row("good", "auto", "a", 0.1), row("bad", "auto", "a", 0.2), row("good", "tuned", "a", 0.3),
              row("bad", "tuned", "a", 0.2), row("good", "paper", "a", 0.3), row("bad", "paper", "a", 0.1),
              row("good", "oracle", "a", 0.1), row("bad", "oracle", "a", 0.1)})};
  std::ostringstream out;
  table::print_markdown(
      league::league_document(league::league_to_json(league::make_league(reports, false), reports)), out);
  const std::string text = out.str();
  for (const char* who : {"that see the points only", "with one value fitted on other shapes",
                          "that know the ground truth's area", "with the best value for each instance"}) {
    expect_says(text, std::string("Performance profile of the methods ") + who);
  }
}

TEST(League, TheReadmeHasTheFirstThreeOfEveryProtocol) {
  std::vector<json> rows = {row("ours", "tuned", "a", 0.1)};
  for (int k = 1; k <= 4; ++k) rows.push_back(row("rival" + std::to_string(k), "auto", "a", 0.1 * k));
  json degenerate = report({row("ours", "paper", "degenerate_tiny", 0.1)});
  degenerate["plan"]["accepted"] = {"error"};
  const std::vector<json> reports = {report(rows), degenerate};
  const std::string text =
      league::league_results(league::league_to_json(league::make_league(reports, false), reports), "kept");
  expect_says(text, "[kept/league.md](kept/league.md)");
  expect_says(text, "\n### League: 1 cases of 1 shapes, the first three of every protocol\n");
  expect_says(text, "| auto     | rival3 |     1 |        0 |        30.00 |");
  EXPECT_EQ(text.find("rival4"), std::string::npos) << text;
  EXPECT_EQ(text.find("paper"), std::string::npos) << text;
  expect_says(text, "| tuned    | ours   |");
}

}  // namespace
}  // namespace hullbench::testing
