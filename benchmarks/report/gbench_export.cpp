#include "benchmarks/report/gbench_export.hpp"

#include <algorithm>
#include <map>
#include <string>

#include "benchmarks/base/files.hpp"
#include "benchmarks/report/measurements.hpp"
#include "benchmarks/statistics/statistics.hpp"

namespace hullbench::report {
namespace {

using nlohmann::ordered_json;

ordered_json context_of(const json& report) {
  const json& environment = report.at("environment");
  const json& cpu = environment.at("cpu");
  const json& tool = report.at("tool");
  ordered_json context = {
      {"date", report.at("created")},
      {"host_name", environment.at("machine_id")},
      {"executable", tool.at("name").get<std::string>() + " " + tool.at("version").get<std::string>()},
      {"num_cpus", cpu.at("logical_cores")},
      {"mhz_per_cpu", 0}};
  if (const json& governors = cpu.at("governors"); governors.is_array() && !governors.empty()) {
    context["cpu_scaling_enabled"] =
        std::ranges::any_of(governors, [](const json& governor) { return governor != "performance"; });
  }
  const json& load = environment.at("load_average");
  context["caches"] = ordered_json::array();
  context["load_avg"] = load.is_array() ? ordered_json(load) : ordered_json::array();
  context["library_build_type"] =
      environment.at("compiler").at("build_type") == "Debug" ? "debug" : "release";
  context["json_schema_version"] = 1;
  context["cpu_time"] = "not measured; real_time is repeated";
  return context;
}

/// What the entries of one run share.
struct Series {
  std::string name;
  std::size_t index = 0;  ///< among the series
  std::vector<std::int64_t> times;
};

ordered_json entry_of(const Series& series, const std::string& name, const char* run_type) {
  return {{"name", name},
          {"family_index", series.index},
          {"per_family_instance_index", 0},
          {"run_name", series.name},
          {"run_type", run_type},
          {"repetitions", series.times.size()}};
}

void finish(ordered_json& entry, std::size_t iterations, double time) {
  entry["threads"] = 1;
  entry["iterations"] = iterations;
  entry["real_time"] = time;
  entry["cpu_time"] = time;
  entry["time_unit"] = "ns";
}

ordered_json aggregate_of(const Series& series, const std::string& aggregate, double value) {
  ordered_json entry = entry_of(series, series.name + "_" + aggregate, "aggregate");
  entry["aggregate_name"] = aggregate;
  entry["aggregate_unit"] = aggregate == "cv" ? "percentage" : "time";
  finish(entry, series.times.size(), value);
  return entry;
}

void add_series(ordered_json& benchmarks, const Series& series) {
  for (std::size_t repetition = 0; repetition < series.times.size(); ++repetition) {
    ordered_json entry = entry_of(series, series.name, "iteration");
    entry["repetition_index"] = repetition;
    finish(entry, 1, static_cast<double>(series.times[repetition]));
    benchmarks.push_back(std::move(entry));
  }
  const statistics::Statistics statistics = statistics::describe(series.times);
  if (!statistics.standard_deviation) return;
  benchmarks.push_back(aggregate_of(series, "mean", statistics.mean));
  benchmarks.push_back(aggregate_of(series, "median", statistics.median));
  benchmarks.push_back(aggregate_of(series, "stddev", *statistics.standard_deviation));
  if (statistics.mean > 0)
    benchmarks.push_back(aggregate_of(series, "cv", *statistics.standard_deviation / statistics.mean));
}

}  // namespace

ordered_json gbench_report(const std::vector<json>& reports) {
  ordered_json result = {{"context", context_of(reports.front())}, {"benchmarks", ordered_json::array()}};
  std::map<std::string, std::size_t> occurrences;
  std::size_t index = 0;
  for (const json& report : reports) {
    const std::string plan = report.at("plan").value("name", std::string());
    const Measurements measurements(report);
    if (!measurements.has_times()) throw std::runtime_error(measurements.why_no_times());
    for (const record::RunRecord& run : measurements.runs()) {
      std::string name = (reports.size() > 1 && !plan.empty() ? plan + "/" : "") + run.name;
      // Failures count too, so that a run has the same name in two exports.
      const std::size_t occurrence = ++occurrences[name];
      if (!is_measured(run) || run.time_ns.empty()) continue;
      if (occurrence > 1) name += "/run:" + std::to_string(occurrence);
      add_series(result["benchmarks"], {std::move(name), index++, run.time_ns});
    }
  }
  return result;
}

void export_gbench(const fs::path& file, const std::vector<json>& reports) {
  write_text_file(file, gbench_report(reports).dump(2) + "\n");
}

}  // namespace hullbench::report
