#include "benchmarks/run/suite.hpp"

#include <algorithm>
#include <fstream>
#include <set>
#include <stdexcept>

#include "benchmarks/metrics/metric_table.hpp"
#include "benchmarks/report/overview_tables.hpp"
#include "benchmarks/report/paper_comparison.hpp"
#include "benchmarks/plan/plan.hpp"
#include "benchmarks/report/report.hpp"
#include "benchmarks/report/tables.hpp"

namespace hullbench {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kSuiteFile = "suite.json";

json describe_suite(const std::vector<json>& headers) {
  json suite = {{"schema_version", kSchemaVersion},
                {"created", headers.front().at("created")},
                {"plans", json::array()},
                {"continuity", json::array()}};
  for (const json& header : headers) {
    suite["plans"].push_back(header.at("plan").at("name"));
    suite["continuity"].push_back(run_continuity(header));
  }
  return suite;
}

/// suite.json of a folder; null when it has none that can be read.
json read_suite(const fs::path& folder) {
  std::ifstream in(folder / kSuiteFile, std::ios::binary);
  json suite = in ? json::parse(in, nullptr, false) : json();
  return suite.is_object() && suite.contains("plans") ? suite : json();
}

bool is_same(const json& earlier, const json& suite) {
  return earlier.is_object() && earlier.value("continuity", json()) == suite.at("continuity");
}

fs::path find_unfinished(const json& suite, const fs::path& runs) {
  for (const fs::path& folder : newest_first(runs)) {
    if (is_same(read_suite(folder), suite)) return fs::exists(folder / kTablesFile) ? fs::path() : folder;
  }
  return {};
}

fs::path open_chosen(const json& suite, const fs::path& folder, bool force) {
  make_writable_folder(folder);
  if (!force && !fs::is_empty(folder) && !is_same(read_suite(folder), suite)) {
    throw ConfigurationError(
        "the output folder " + folder.string() +
        " holds something else; choose another one with --out, or overwrite it with --force");
  }
  return folder;
}

/// Leaves out the steps of a report that has other cases too, when a report of the steps alone is there.
void drop_repeated_steps(std::vector<Document>& documents) {
  const std::string steps = std::string("_") + kStepsTable;
  const auto is_steps = [&](const TableSection& section) { return section.id.ends_with(steps); };
  const bool alone = std::any_of(documents.begin(), documents.end(), [&](const Document& document) {
    return !document.tables.empty() && is_steps(document.tables.front());
  });
  if (!alone) return;
  for (Document& document : documents) {
    if (!document.tables.empty() && !is_steps(document.tables.front()))
      std::erase_if(document.tables, is_steps);
  }
}

/// Takes the common notes out of `documents`: each text once, in the order in which they first occur.
std::vector<std::string> take_common_notes(std::vector<Document>& documents) {
  std::vector<std::string> result;
  std::set<std::string> seen;
  for (Document& document : documents) {
    for (std::string& note : document.common_notes) {
      if (seen.insert(note).second) result.push_back(std::move(note));
    }
    document.common_notes.clear();
  }
  return result;
}

}  // namespace

fs::path open_suite(const std::vector<json>& headers, const RunPlace& place) {
  const json suite = describe_suite(headers);
  fs::path folder;
  if (place.out) {
    folder = open_chosen(suite, *place.out, place.force);
  } else {
    if (!place.force) folder = find_unfinished(suite, place.results / "runs");
    if (folder.empty()) folder = make_run_folder(headers.front(), place.results);
  }
  if (place.force) fs::remove(folder / kTablesFile);
  write_json_file(folder / kSuiteFile, suite);
  return folder;
}

bool is_suite(const fs::path& folder) {
  return fs::exists(folder / kSuiteFile);
}

std::vector<fs::path> suite_runs(const fs::path& folder) {
  const json suite = read_suite(folder);
  if (!suite.is_object()) {
    throw std::runtime_error("cannot read " + (folder / kSuiteFile).string() +
                             ": is it a suite's description?");
  }
  std::vector<fs::path> runs;
  for (const json& plan : suite.at("plans")) {
    const fs::path run = folder / plan.get<std::string>();
    if (fs::exists(run / "run.json")) runs.push_back(run);
  }
  return runs;
}

std::vector<json> suite_reports(const fs::path& folder) {
  std::vector<json> reports;
  for (const fs::path& run : suite_runs(folder)) reports.push_back(make_report(run));
  return reports;
}

json report_to_share(const fs::path& folder) {
  json report = make_report(folder);
  report["metrics"] = metric_table_to_json();
  return report;
}

void finish_run(const fs::path& folder) {
  const json report = report_to_share(folder);
  write_tables(folder, make_documents({report}));
  write_report_file(folder / "report.json", report);
}

std::vector<Document> make_documents(const std::vector<json>& reports) {
  std::vector<Document> documents;
  documents.reserve(reports.size() + 2);
  for (const json& report : reports) documents.push_back(make_document(report));
  drop_repeated_steps(documents);
  Document end;
  end.title = "Beside the paper";
  end.tables.push_back(differences_table(reports));
  if (end.tables.front().table.empty()) end = Document{"All runs", {}, {}, {}};
  end.common_notes = take_common_notes(documents);
  documents.push_back(std::move(end));
  Document overview;
  overview.title = "Methods and parameters";
  overview.tables = {methods_table(reports), parameters_table(reports)};
  documents.insert(documents.begin(), std::move(overview));
  return documents;
}

}  // namespace hullbench
