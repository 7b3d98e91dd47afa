// Reports of invented runs, as if they had been on other shapes.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "benchmarks/report/report.hpp"
#include "benchmarks/report/tables.hpp"
#include "benchmarks/table/writers.hpp"
#include "invented_run.hpp"
#include "temporary_folder.hpp"

namespace hullbench::testing {

/// The report of the invented run at these sizes. It is made in a TemporaryFolder of the running test, which
/// must not have another one at the same time.
inline json invented_report(const std::vector<std::int64_t>& sizes = {2000, 64000}) {
  const TemporaryFolder folder;
  write_invented_run(folder.path(), sizes);
  return report::make_report(folder.path());
}

/// The report's tables as Markdown.
inline std::string markdown_of(const json& report) {
  std::ostringstream out;
  table::print_markdown(report::make_document(report), out);
  return out.str();
}

/// The table `id` of `document`; null when there is none.
inline const table::Table* table_in(const table::Document& document, const std::string& id) {
  for (const table::Table& table : document.tables) {
    if (table.id == id) return &table;
  }
  return nullptr;
}

/// The rows of the table `id` as they are shown, the header first; a failure when there is none.
inline std::vector<std::vector<std::string>> rows_of(const table::Document& document, const std::string& id) {
  const table::Table* table = table_in(document, id);
  EXPECT_TRUE(table) << "there is no table " << id;
  return table ? table::shown(*table) : std::vector<std::vector<std::string>>(1);
}

/// A shape on which every method takes `milliseconds` as the paper took it and half as long again in all, and
/// errs by `error`, a part of the result's area.
struct InventedShape {
  std::string dataset;
  std::int64_t n = 0;
  double convexity = 0;
  std::int64_t milliseconds = 1;
  double error = 0;
};

/// The invented report with its runs on California on each of `shapes` instead.
inline json report_on_shapes(const std::vector<InventedShape>& shapes) {
  json report = invented_report({2000});
  const json on_states = report.at("runs");
  report.at("runs") = json::array();
  report.at("plan")["paper"] = "Table 4";
  for (const InventedShape& shape : shapes) {
    for (json run : on_states) {
      if (run.at("dataset") != "ca" || run.at("holes") == true) continue;
      run["dataset"] = shape.dataset;
      run["n"] = shape.n;
      if (run.at("status") == "ok") {
        run["metrics"]["l2_paper"] = shape.error;
        run["metrics"]["l2"] = shape.error / 2;
        run["metrics"]["ground_truth_convexity"] = shape.convexity;
        for (auto& phases : run["phases_ns"]) phases["run"] = shape.milliseconds * 1'000'000;
        for (auto& time : run["time_ns"]) time = shape.milliseconds * 1'500'000;
      }
      report["runs"].push_back(run);
    }
  }
  return report;
}

/// The run of a method with its first protocol on a data set; there must be one.
inline json& run_on(json& report, const std::string& method, const std::string& dataset) {
  for (json& run : report.at("runs")) {
    if (run.at("method") == method && run.at("dataset") == dataset) return run;
  }
  throw std::invalid_argument("no run of " + method + " on " + dataset);
}

}  // namespace hullbench::testing
