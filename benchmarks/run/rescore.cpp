#include "benchmarks/run/rescore.hpp"

#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/base/interrupt.hpp"
#include "benchmarks/base/parallel.hpp"
#include "benchmarks/plan/plan.hpp"
#include "benchmarks/record/kept_polygons.hpp"
#include "benchmarks/record/stored_run.hpp"
#include "benchmarks/run/drawn_case.hpp"

namespace hullbench::run {
namespace {

json load(const fs::path& folder) {
  try {
    return record::load_run(folder);
  } catch (const ConfigurationError& error) {
    throw ConfigurationError(std::string("cannot rescore: ") + error.what());
  }
}

/// The rows of `run` by case, each case as the plan has it.
std::map<std::size_t, std::vector<std::size_t>> rows_by_case(const plan::Plan& plan,
                                                             const std::vector<record::RunRecord>& rows) {
  std::map<std::string, std::size_t> cases;
  for (const plan::PlannedRun& run : plan::planned_runs(plan, "")) cases.emplace(run.name, run.case_index);
  std::map<std::size_t, std::vector<std::size_t>> result;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto found = cases.find(rows[i].name);
    if (found == cases.end())
      throw ConfigurationError("the row " + rows[i].name + " is not of the run's plan");
    result[found->second].push_back(i);
  }
  return result;
}

/// Whether it was the scores that made the row a failure.
bool failed_by_score(const record::RunRecord& row) {
  return row.detail.starts_with(kInvalidPolygon) || row.detail.starts_with(kNoScore);
}

void score(record::RunRecord& row, const DrawnCase& drawn, const std::vector<std::uint8_t>& wkb) {
  if (failed_by_score(row)) {
    row.status = record::Status::kOk;
    row.detail.clear();
  }
  const json before = std::exchange(row.metrics, json::object());
  if (const auto result = read_result(row, wkb)) drawn.score(row, *result, std::nullopt);
  for (const char* name : kOfTheRun) {
    if (row.metrics.contains(name) && before.contains(name)) row.metrics[name] = before[name];
  }
  std::erase(row.flags, record::kWorseThanConvexHull);
  if (record::is_worse_than_convex_hull(row.metrics)) row.flags.emplace_back(record::kWorseThanConvexHull);
}

void check_points(const record::RunRecord& row, const DrawnCase& drawn) {
  if (!drawn.missing().empty()) throw ConfigurationError(drawn.missing());
  if (drawn.set().sha256 == row.dataset_sha256) return;
  throw ConfigurationError(
      "the points of " + row.name +
      " are not those that were measured: this program has another version of the data set, or "
      "the row was changed");
}

}  // namespace

Rescored rescore(const fs::path& folder, const std::vector<int>& cores, const DataFolders& folders) {
  Rescored result;
  result.header = load(folder);
  for (const json& line : result.header.at("runs")) result.rows.push_back(line.get<record::RunRecord>());
  result.header.erase("runs");
  const plan::Plan plan =
      plan::parse_plan(result.header.at("plan").dump(), (folder / record::kHeaderFile).string());
  const auto by_case = rows_by_case(plan, result.rows);
  const std::vector<std::pair<std::size_t, std::vector<std::size_t>>> cases(by_case.begin(), by_case.end());
  std::mutex counting;
  for_each_in_parallel(cases.size(), cores, [&](std::size_t i) {
    throw_if_interrupted();
    std::optional<DrawnCase> drawn;
    for (const std::size_t place : cases[i].second) {
      record::RunRecord& row = result.rows[place];
      if (row.output_sha256.empty()) continue;
      const auto wkb = record::kept_polygons(folder, row.output_sha256);
      if (wkb) {
        if (!drawn) drawn.emplace(plan.expanded_cases[cases[i].first], row.seed, folders);
        check_points(row, *drawn);
        score(row, *drawn, *wkb);
      }
      const std::scoped_lock guard(counting);
      ++(wkb ? result.scored : result.without_polygons);
    }
  });
  return result;
}

}  // namespace hullbench::run
