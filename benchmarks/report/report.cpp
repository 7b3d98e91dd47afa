#include "benchmarks/report/report.hpp"

#include <fstream>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "benchmarks/report/claims.hpp"
#include "benchmarks/report/headline.hpp"
#include "benchmarks/record/json_lines.hpp"
#include "benchmarks/report/measurements.hpp"
#include "benchmarks/report/noise.hpp"
#include "benchmarks/record/record.hpp"
#include "benchmarks/statistics/statistics.hpp"

namespace hullbench {
namespace {

using nlohmann::json;

json read_run_file(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw std::runtime_error("Cannot read " + path.string() + ": is this the folder of a run?");
  try {
    json run = json::parse(in);
    if (!run.is_object()) throw std::runtime_error(path.string() + " does not hold a JSON object.");
    if (run.value("schema_version", 0) != kSchemaVersion) {
      throw std::runtime_error(path.string() + " is of another schema version than this program's.");
    }
    return run;
  } catch (const json::exception& error) {
    throw std::runtime_error(path.string() + " is not a run's description: " + error.what() + ".");
  }
}

json statistics_to_json(const std::vector<std::int64_t>& values) {
  if (values.empty()) return nullptr;
  const Statistics statistics = describe(values);
  const auto& deviation = statistics.standard_deviation;
  const auto& interval = statistics.median_interval;
  return {{"repetitions", statistics.count},
          {"median_ns", statistics.median},
          {"median_low_ns", interval ? json(interval->low) : json(nullptr)},
          {"median_high_ns", interval ? json(interval->high) : json(nullptr)},
          {"mad_ns", statistics.mad},
          {"min_ns", statistics.minimum},
          {"max_ns", statistics.maximum},
          {"mean_ns", statistics.mean},
          {"std_ns", deviation ? json(*deviation) : json(nullptr)}};
}

json metric_or_null(const json& metrics, const char* name) {
  const auto found = metrics.find(name);
  return found == metrics.end() ? json(nullptr) : *found;
}

json summary_row(const RunRecord& run) {
  return {{"id", run.id},
          {"name", run.name},
          {"status", to_string(run.status)},
          {"time", statistics_to_json(times(run, Boundary::kEqualWork))},
          {"paper_time", statistics_to_json(times(run, Boundary::kPaper))},
          {"l2", metric_or_null(run.metrics, "l2")},
          {"l2_paper", metric_or_null(run.metrics, "l2_paper")},
          {"iou", metric_or_null(run.metrics, "iou")},
          {"valid", metric_or_null(run.metrics, "valid")}};
}

json totals(const std::vector<RunRecord>& runs) {
  json result = json::object();
  for (const Status status : kAllStatuses) result[to_string(status)] = 0;
  for (const RunRecord& run : runs) {
    json& count = result[to_string(run.status)];
    count = count.get<int>() + 1;
  }
  return result;
}

json noise_to_json(const std::vector<RunRecord>& runs) {
  const std::optional<Noise> noise = measure_noise(runs);
  if (!noise) return nullptr;
  return {{"rows", noise->rows},
          {"median_spread", noise->median_spread},
          {"ninth_decile", noise->ninth_decile},
          {"noisy", noise->is_noisy()}};
}

std::string dump_text(const json& content, int indent) {
  return content.dump(indent, ' ', false, json::error_handler_t::replace);
}

/// Writes a file whole or not at all.
void write_whole(const std::filesystem::path& path, const std::string& text) {
  std::filesystem::path temporary = path;
  temporary += ".new";
  {
    std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
    out << text << '\n' << std::flush;
    if (!out)
      throw std::runtime_error("Cannot write " + temporary.string() + ": is its folder there and writable?");
  }
  std::error_code error;
  std::filesystem::rename(temporary, path, error);
  if (error) throw std::runtime_error("Cannot write " + path.string() + ": " + error.message() + ".");
}

}  // namespace

json last_of_each_id(const std::vector<json>& lines, const std::filesystem::path& path) {
  json result = json::array();
  std::map<std::string, std::size_t> places;  // by id, in result
  for (const json& line : lines) {
    RunRecord record;
    try {
      record = line.get<RunRecord>();
    } catch (const std::exception& error) {
      throw std::runtime_error("A line of " + path.string() + " is not a run's record: " + error.what());
    }
    const auto [place, is_new] = places.emplace(record.id, result.size());
    if (is_new) {
      result.push_back(line);
    } else {
      result[place->second] = line;
    }
  }
  return result;
}

json make_summary(const json& report) {
  const auto runs = report.at("runs").get<std::vector<RunRecord>>();
  json rows = json::array();
  for (const RunRecord& run : runs) rows.push_back(summary_row(run));
  return {{"totals", totals(runs)},
          {"noise", noise_to_json(runs)},
          {"rows", rows},
          {"headline", make_headline(Measurements(report))},
          {"claims", check_claims(report)}};
}

json load_run(const std::filesystem::path& run_directory) {
  json report = read_run_file(run_directory / "run.json");
  std::filesystem::path lines_file = run_directory / "runs.jsonl";
  if (!std::filesystem::exists(lines_file)) lines_file += ".xz";
  const JsonLines lines = load_json_lines(lines_file);
  report["runs"] = last_of_each_id(lines.lines, lines_file);
  // Only a merged run has notes of its own.
  if (!report.contains("notes")) report["notes"] = json::array();
  if (!lines.torn.empty()) {
    report["notes"].push_back(
        "The last line of runs.jsonl was cut short when the run was interrupted; it is left out.");
  }
  return report;
}

json make_report(const std::filesystem::path& run_directory) {
  json report = load_run(run_directory);
  report["summary"] = make_summary(report);
  return report;
}

void write_report_file(const std::filesystem::path& path, const json& report) {
  // The lists are put in as text where the rest, written as usual, has an empty one for each.
  json frame = report;
  const auto take_out = [](json& list) {
    std::string text;
    for (const json& entry : list) text += (text.empty() ? "[\n" : ",\n") + dump_text(entry, -1);
    list = json::array();
    return text.empty() ? "[]" : text + "\n]";
  };
  const std::string runs = take_out(frame.at("runs"));
  const std::string rows = take_out(frame.at("summary").at("rows"));
  std::string text = dump_text(frame, 2);
  // Of the keys "rows" and "runs" the last ones are those of the report: nothing behind them has such a key.
  for (const auto& [key, list] : {std::pair{"\"rows\": ", &rows}, std::pair{"\"runs\": ", &runs}}) {
    text.replace(text.rfind(key) + std::string_view(key).size(), 2, *list);
  }
  write_whole(path, text);
}

void write_json_file(const std::filesystem::path& path, const json& content) {
  write_whole(path, dump_text(content, 2));
}

}  // namespace hullbench
