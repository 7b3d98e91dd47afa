#include "benchmarks/report/report.hpp"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "benchmarks/base/files.hpp"
#include "benchmarks/record/json_lines.hpp"
#include "benchmarks/record/protocols.hpp"
#include "benchmarks/record/record.hpp"
#include "benchmarks/record/stored_run.hpp"
#include "benchmarks/report/claims.hpp"
#include "benchmarks/report/contests.hpp"
#include "benchmarks/report/headline.hpp"
#include "benchmarks/report/measurements.hpp"
#include "benchmarks/report/noise.hpp"
#include "benchmarks/statistics/statistics.hpp"

namespace hullbench::report {
namespace {

json statistics_to_json(const std::vector<std::int64_t>& values) {
  if (values.empty()) return nullptr;
  const statistics::Statistics statistics = statistics::describe(values);
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

json summary_row(const record::RunRecord& run, const std::map<std::string, Contest>& contests) {
  const auto contest = contests.find(run.id);
  const bool judged = contest != contests.end();
  return {{"id", run.id},
          {"name", run.name},
          {"status", to_string(run.status)},
          {"time", statistics_to_json(times(run, Boundary::kEqualWork))},
          {"paper_time", statistics_to_json(times(run, Boundary::kPaper))},
          {"l2", run.metrics.value("l2", json())},
          {"l2_paper", run.metrics.value("l2_paper", json())},
          {"iou", run.metrics.value("iou", json())},
          {"valid", run.metrics.value("valid", json())},
          {"order", judged && contest->second.order ? json(*contest->second.order) : json(nullptr)},
          {"fastest", judged && contest->second.is_fastest}};
}

json totals(const std::vector<record::RunRecord>& runs) {
  json result = json::object();
  for (const record::Status status : record::kAllStatuses) result[to_string(status)] = 0;
  for (const record::RunRecord& run : runs) {
    json& count = result[to_string(run.status)];
    count = count.get<int>() + 1;
  }
  return result;
}

json noise_to_json(const std::vector<record::RunRecord>& runs) {
  const std::optional<Noise> noise = measure_noise(runs);
  if (!noise) return nullptr;
  return {{"rows", noise->rows},
          {"median_spread", noise->median_spread},
          {"ninth_decile", noise->ninth_decile},
          {"noisy", noise->is_noisy()}};
}

json protocol_words() {
  json words = json::object();
  for (const record::Protocol& protocol : record::protocols()) words[protocol.name] = protocol.chosen;
  return words;
}

}  // namespace

json make_summary(const json& report) {
  const auto runs = report.at("runs").get<std::vector<record::RunRecord>>();
  const std::map<std::string, Contest> contests = judge_contests(runs);
  json rows = json::array();
  for (const record::RunRecord& run : runs) rows.push_back(summary_row(run, contests));
  return {{"totals", totals(runs)},
          {"noise", noise_to_json(runs)},
          {"protocols", protocol_words()},
          {"rows", rows},
          {"headline", make_headline(Measurements(report))},
          {"claims", check_claims(report)}};
}

json make_report(const fs::path& run_directory) {
  json report = record::load_run(run_directory);
  report["summary"] = make_summary(report);
  return report;
}

std::vector<json> suite_reports(const fs::path& folder) {
  std::vector<json> reports;
  for (const fs::path& run : record::suite_runs(folder)) reports.push_back(make_report(run));
  return reports;
}

void write_report_file(const fs::path& path, const json& report) {
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
  write_text_file(path, text + "\n");
}

}  // namespace hullbench::report
