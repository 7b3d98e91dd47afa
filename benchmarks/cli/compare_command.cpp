#include "benchmarks/cli/compare_command.hpp"

#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/record/json_lines.hpp"
#include "benchmarks/record/stored_run.hpp"
#include "benchmarks/report/compare.hpp"
#include "benchmarks/report/compare_document.hpp"
#include "benchmarks/report/report.hpp"

namespace hullbench::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json read_report(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  json report = json::parse(in, nullptr, false);
  if (!report.is_object() || !report.contains("runs") || !report["runs"].is_array()) {
    throw std::runtime_error(file.string() +
                             " is not a report; give a run's folder, its report.json or its runs.jsonl");
  }
  if (report.value("schema_version", json()) != record::kSchemaVersion) {
    throw std::runtime_error(file.string() +
                             " is of another schema version than this program's; make it anew with "
                             "this version's 'hullbench run'");
  }
  return report;
}

json read_lines(const fs::path& file) {
  return {{"runs", record::last_of_each_id(record::load_json_lines(file).lines, file)}};
}

report::ComparedSide read_side(const std::string& path) {
  if (fs::is_directory(path))
    return {path,
            record::is_suite(path) ? report::suite_reports(path) : std::vector{report::make_report(path)}};
  if (!fs::is_regular_file(path)) {
    throw ConfigurationError("there is no run " + path +
                             "; give a run's folder, its report.json or its runs.jsonl");
  }
  const bool has_lines = path.ends_with(".jsonl") || path.ends_with(".jsonl.xz");
  return {path, {has_lines ? read_lines(path) : read_report(path)}};
}

report::RunsCompared compare_sides(const report::ComparedSide& a, const report::ComparedSide& b) {
  try {
    return report::compare_runs(a.reports, b.reports);
  } catch (const std::exception& error) {
    throw std::runtime_error("a run in " + a.name + " or " + b.name +
                             " cannot be read; 'hullbench validate' says what is wrong: " + error.what());
  }
}

void print(const table::Document& document, const std::string& format) {
  if (format == "csv") {
    std::cout << table::to_csv(document.tables.back());
  } else if (format == "latex") {
    for (const table::Table& table : document.tables) std::cout << table::to_latex(table);
  } else {
    table::print_markdown(document, std::cout);
  }
}

}  // namespace

int compare_command(const CompareCommand& command) {
  const report::ComparedSide a = read_side(command.a);
  const report::ComparedSide b = read_side(command.b);
  const report::RunsCompared compared = compare_sides(a, b);
  if (compared.pairs.empty()) {
    std::cerr << "hullbench: " << a.name << " and " << b.name << " have no run in common ("
              << compared.only_a.size() << " and " << compared.only_b.size()
              << " runs); compare runs of the same plan\n";
    return 6;
  }
  if (command.format == "json") {
    std::cout << report::comparison_json(compared, a, b).dump(2) << "\n";
  } else {
    print(report::comparison_document(compared, a, b, command.format == "csv"), command.format);
  }
  return 0;
}

}  // namespace hullbench::cli
