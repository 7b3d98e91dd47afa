// The table of metrics, and that the page, the schema and the rows of records have the same ones.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "benchmarks/metrics/metric_table.hpp"
#include "tests/boxes.hpp"
#include "tests/complaint.hpp"

namespace hullbench::testing {
namespace {

std::string read_file(const std::string& path) {
  std::ifstream in(std::string(HULLBENCH_SOURCE_DIRECTORY) + "/" + path, std::ios::binary);
  EXPECT_TRUE(in.is_open()) << path;
  return {std::istreambuf_iterator<char>(in), {}};
}

std::set<std::string> table_names() {
  std::set<std::string> names;
  for (const metrics::MetricInfo& metric : metrics::metric_table()) names.insert(metric.name);
  return names;
}

std::set<std::string> keys_of(const json& object) {
  std::set<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.insert(key);
  return keys;
}

const MultiPolygon kUnitBowTie = {{{{0, 0}, {1, 1}, {1, 0}, {0, 1}}, {}}};

TEST(MetricTable, NamesAreUniqueAndEveryEntryIsComplete) {
  EXPECT_EQ(table_names().size(), metrics::metric_table().size());
  for (const metrics::MetricInfo& metric : metrics::metric_table()) {
    SCOPED_TRACE(metric.name);
    EXPECT_EQ(metric.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_"), std::string::npos);
    for (const std::string& text : {metric.group, metric.unit, metric.definition, metric.function}) {
      EXPECT_NE(text, "");
      EXPECT_EQ(text.find('\n'), std::string::npos);
    }
    EXPECT_NE(metric.value, nullptr);
  }
}

TEST(MetricTable, NamesFilesThatHaveWhatComputes) {
  for (const metrics::MetricInfo& metric : metrics::metric_table()) {
    SCOPED_TRACE(metric.function);
    const std::size_t comma = metric.function.find(", ");
    ASSERT_NE(comma, std::string::npos);
    const std::string file = metric.function.substr(comma + 2);
    const std::string folder = file == "worker_process.cpp" ? "benchmarks/worker/" : "benchmarks/metrics/";
    expect_says(read_file(folder + file), metric.function.substr(0, comma));
  }
}

TEST(MetricTable, IsThatOfTheSchema) {
  const json schema = json::parse(read_file("results/run.schema.json"));
  EXPECT_EQ(keys_of(schema["properties"]["metrics"]["properties"]), table_names());
}

TEST(MetricTable, IsThatOfThePage) {
  const std::string page = read_file("benchmarks/metrics/METRICS.md");
  const std::string begin = "<!-- metrics: begin -->\n";
  const std::size_t from = page.find(begin);
  const std::size_t to = page.find("<!-- metrics: end -->");
  ASSERT_NE(from, std::string::npos);
  ASSERT_NE(to, std::string::npos);
  EXPECT_EQ(page.substr(from + begin.size(), to - from - begin.size()), metrics::metric_table_to_markdown())
      << "'hullbench metrics --markdown' prints what belongs there";
}

TEST(MetricTable, MakesTheRow) {
  const metrics::CaseScorer scorer(std::vector<Point>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, kUnitSquare);
  for (const MultiPolygon& result : {kUnitSquare, kUnitBowTie, MultiPolygon{}}) {
    const json row = metrics::metrics_to_json(scorer.score(result));
    EXPECT_EQ(keys_of(row), table_names());
  }
  const json row = metrics::metrics_to_json(scorer.score(kUnitSquare));
  EXPECT_EQ(row["valid"], true);
  EXPECT_EQ(row["invalid_reason"], "");
  EXPECT_EQ(row["l2"], 0.0);
  EXPECT_EQ(row["vertices"], 4);
  EXPECT_TRUE(row["vertices"].is_number_integer());
  EXPECT_TRUE(row["peak_memory_bytes"].is_null());
  EXPECT_TRUE(row["hole_f1"].is_null());
}

/// What is null is what the table says can be.
TEST(MetricTable, SaysWhatCanBeNull) {
  const metrics::CaseScorer scorer(std::vector<Point>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, kUnitSquare);
  const json empty = metrics::metrics_to_json(scorer.score({}));
  const json invalid = metrics::metrics_to_json(scorer.score(kUnitBowTie));
  const json perfect = metrics::metrics_to_json(scorer.score(kUnitSquare));
  for (const metrics::MetricInfo& metric : metrics::metric_table()) {
    SCOPED_TRACE(metric.name);
    if (metric.undefined.empty()) {
      EXPECT_FALSE(empty[metric.name].is_null() || invalid[metric.name].is_null());
    }
    if (metric.undefined.find("invalid") != std::string::npos) {
      EXPECT_TRUE(invalid[metric.name].is_null());
      if (metric.undefined == "of an invalid result") {
        EXPECT_FALSE(empty[metric.name].is_null());
        EXPECT_FALSE(perfect[metric.name].is_null());
      }
    }
    if (metric.undefined.find("empty result") != std::string::npos) {
      EXPECT_TRUE(empty[metric.name].is_null());
      EXPECT_FALSE(perfect[metric.name].is_null());
    }
  }
}

TEST(MetricTable, IsPrintedWithEveryMember) {
  const json table = metrics::metric_table_to_json();
  ASSERT_EQ(table.size(), metrics::metric_table().size());
  std::ostringstream out;
  metrics::print_metric_table(out);
  for (const json& metric : table) {
    EXPECT_EQ(keys_of(metric), (std::set<std::string>{"name", "group", "unit", "better", "definition",
                                                      "undefined", "citation", "function"}));
    EXPECT_TRUE((std::set<std::string>{"lower", "higher", "zero", "one", "none"}).contains(metric["better"]));
    expect_says(out.str(), "  " + metric["name"].get<std::string>() + "  ");
    expect_says(out.str(), metric["definition"].get<std::string>());
  }
}

}  // namespace
}  // namespace hullbench::testing
