// `hullbench compare A B`: from two paths to what differs between them.
#include <filesystem>
#include <fstream>
#include <iostream>
#include <vector>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/base/names.hpp"
#include "benchmarks/cli/options.hpp"
#include "benchmarks/cli/run_folder.hpp"
#include "benchmarks/record/json_lines.hpp"
#include "benchmarks/record/stored_run.hpp"
#include "benchmarks/report/compare.hpp"
#include "benchmarks/report/compare_document.hpp"
#include "benchmarks/report/report.hpp"

namespace hullbench::cli {
namespace {

/// A side is the folder of a run or of a suite, a report.json, or the lines of a run (runs.jsonl,
/// runs.jsonl.xz).
struct CompareCommand {
  std::string a;
  std::string b;
  std::string format = "markdown";  ///< "csv": the pairs
};

json read_report(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  json report = json::parse(in, nullptr, false);
  if (!report.is_object() || !report.contains("runs") || !report["runs"].is_array()) {
    throw ConfigurationError(file.string() +
                             " is not a report; give a run's folder, its report.json or its runs.jsonl");
  }
  if (report.value("schema_version", json()) != record::kSchemaVersion) {
    throw ConfigurationError(file.string() +
                             " is of another schema version than this program's; make it anew with "
                             "this version's 'hullbench run'");
  }
  return report;
}

json read_lines(const fs::path& file) {
  return {{"runs", record::last_of_each_id(record::load_json_lines(file), file)}};
}

report::ComparedSide read_side(const std::string& path) {
  if (fs::is_directory(path)) {
    check_run_folder(path);
    return {path,
            record::is_suite(path) ? report::suite_reports(path) : std::vector{report::make_report(path)}};
  }
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
    throw ConfigurationError("a run in " + a.name + " or " + b.name +
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

ExitCode compare(const CompareCommand& command) {
  const report::ComparedSide a = read_side(command.a);
  const report::ComparedSide b = read_side(command.b);
  const report::RunsCompared compared = compare_sides(a, b);
  if (compared.pairs.empty()) {
    std::cerr << "hullbench: " << a.name << " and " << b.name << " have no run in common ("
              << compared.only_a.size() << " and " << compared.only_b.size()
              << " runs); compare runs of the same plan\n";
    return kExitNothing;
  }
  if (command.format == "json") {
    std::cout << report::comparison_json(compared, a, b).dump(2) << "\n";
  } else {
    print(report::comparison_document(compared, a, b, command.format == "csv"), command.format);
  }
  return kExitOk;
}

}  // namespace

void add_compare(CLI::App& app, Action& action) {
  const auto command = std::make_shared<CompareCommand>();
  CLI::App& options = add_command(app, "compare", "Show what differs between two runs",
                                  "hullbench compare before/report.json results/latest --format csv");
  options
      .add_option("A", command->a,
                  "A run's or suite's folder, a report.json or a runs.jsonl: the earlier one")
      ->required();
  options.add_option("B", command->b, "The later one, given in the same way")->required();
  options.add_option("--format", command->format, "The output's format")
      ->check(CLI::IsMember({"markdown", "csv", "latex", "json"}))
      ->capture_default_str();
  set_action(options, action, command, &compare);
}

}  // namespace hullbench::cli
