#include "benchmarks/report_notes.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "benchmarks/claims.hpp"
#include "benchmarks/labels.hpp"
#include "benchmarks/text_table.hpp"

namespace hullbench {
namespace {

using nlohmann::json;

void print_how_to_read(const json& report, std::ostream& out) {
  print_item("Times are medians ± the median absolute deviation over " + report.at("repetitions").dump() +
                 " repetitions. Cells that hold several runs (seeds, parameter sets) put them together.",
             out);
  print_item(
      "Equal work: points in memory to a valid multipolygon in memory, for every method alike. As the paper "
      "took it: "
      "the method's own run only. Loading the points (the upload to a database) is in neither.",
      out);
  print_item(
      "The protocol in brackets says who chose the parameters: paper, by the paper's rules, which look at "
      "the ground "
      "truth (oracle-informed); default, the method's own; auto, by a rule from the points alone; tuned, on "
      "other "
      "shapes; oracle, the best for this very case.",
      out);
  print_item(
      "A cell with a word is a run without a result: its status, or \"invalid\" for a result that is not a "
      "valid "
      "multipolygon. A dash: not run or not defined.",
      out);
}

void print_paper_notes(const std::vector<RunRecord>& runs, std::ostream& out) {
  if (std::none_of(runs.begin(), runs.end(),
                   [](const RunRecord& run) { return run.protocol == paper().at("protocol"); })) {
    return;
  }
  for (const json& note : paper().at("notes")) print_item(note.get<std::string>(), out);
}

void print_plan_notes(const json& report, std::ostream& out) {
  const json& plan = report.at("plan");
  for (const json& note : plan.value("notes", json::array())) print_item(note.get<std::string>(), out);
  for (const json& method : plan.value("methods", json::array())) {
    const std::string note = method.value("note", "");
    if (note.empty()) continue;
    print_item(method_label(report, method.value("method", ""), method.value("protocol", "")) + ": " +
                   sentence(note),
               out);
  }
}

/// Methods that are missing and have no row that could say so.
void print_missing_methods(const json& report, const std::vector<RunRecord>& runs, std::ostream& out) {
  for (const json& method : report.at("methods")) {
    if (method.value("installed", true)) continue;
    const std::string name = method.at("name").get<std::string>();
    if (std::any_of(runs.begin(), runs.end(), [&](const RunRecord& run) { return run.method == name; }))
      continue;
    print_item(not_installed_text(report, method_title(report, name), name, method.value("detail", "")), out);
  }
}

void print_environment(const json& report, std::ostream& out) {
  const json& environment = report.at("environment");
  const json& cpu = environment.at("cpu");
  const json& compiler = environment.at("compiler");
  const json& os = environment.at("os");
  print_item(cpu.at("model").get<std::string>() + ", " + cpu.at("logical_cores").dump() + " logical cores" +
                 (cpu.at("virtualised") == true ? " (virtual machine)" : "") +
                 (os.is_string() ? ", " + os.get<std::string>() : std::string()) + "; " +
                 compiler.at("id").get<std::string>() + " " + compiler.at("version").get<std::string>() +
                 ", " + compiler.at("build_type").get<std::string>() + ", " +
                 compiler.at("flags").get<std::string>() +
                 (compiler.at("native") == true ? ", for this machine's processor."
                                                : ", no processor-specific code."),
             out);
  print_item(compiler.at("statement").get<std::string>(), out);
}

void print_versions(const json& report, const std::vector<RunRecord>& runs, std::ostream& out) {
  std::map<std::string, std::set<std::string>> by_method;
  for (const RunRecord& run : runs) {
    if (!run.method_version.empty()) by_method[run.method].insert(run.method_version);
  }
  std::string list;
  for (const auto& [method, versions] : by_method) {
    for (const std::string& version : versions) {
      list += (list.empty() ? "" : "; ") + method_title(report, method) + " " + version;
    }
  }
  if (!list.empty()) print_item("Versions: " + list + ".", out);
}

void print_totals(const json& report, std::ostream& out) {
  std::string counts;
  for (const Status status : kAllStatuses) {
    const json& count = report.at("summary").at("totals").at(to_string(status));
    if (count != 0) counts += (counts.empty() ? "" : ", ") + count.dump() + " " + to_string(status);
  }
  print_item("Rows by status: " + (counts.empty() ? std::string("none") : counts) + ".", out);
  const std::size_t resumed = report.value("resumed", json::array()).size();
  if (resumed > 0)
    print_item("The run was interrupted and gone on with, times: " + std::to_string(resumed) + ".", out);
}

}  // namespace

void print_report_notes(const json& report, const std::vector<RunRecord>& runs, std::ostream& out) {
  print_how_to_read(report, out);
  print_paper_notes(runs, out);
  print_plan_notes(report, out);
  for (const json& note : report.at("notes")) print_item(note.get<std::string>(), out);
  print_missing_methods(report, runs, out);
  print_environment(report, out);
  print_versions(report, runs, out);
  print_totals(report, out);
}

}  // namespace hullbench
