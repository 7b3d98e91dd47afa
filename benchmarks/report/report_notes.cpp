#include "benchmarks/report/report_notes.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "benchmarks/base/number_format.hpp"
#include "benchmarks/base/words.hpp"
#include "benchmarks/record/protocols.hpp"
#include "benchmarks/report/claims.hpp"
#include "benchmarks/report/labels.hpp"
#include "benchmarks/report/noise.hpp"
#include "benchmarks/report/table_context.hpp"

namespace hullbench::report {
namespace {

using Sentences = std::vector<std::string>;

/// " in 3 passes" where the records tell more than one.
std::string passes_text(const std::vector<record::RunRecord>& runs) {
  std::int64_t passes = 1;
  for (const record::RunRecord& run : runs) {
    for (const std::int64_t pass : run.passes) passes = std::max(passes, pass);
  }
  return passes == 1 ? "" : " in " + std::to_string(passes) + " passes";
}

void add_repetitions(const Measurements& measurements, Sentences& notes) {
  const std::size_t repetitions = usual_repetitions(measurements);
  if (repetitions == 0) return;
  if (repetitions == 1) {
    notes.emplace_back("Every time is of one repetition, unless its row says another number.");
    return;
  }
  notes.push_back("Times are medians over " + std::to_string(repetitions) + " repetitions" +
                  passes_text(measurements.runs()) +
                  ", unless the row says another number; ± is their median absolute deviation on that case "
                  "alone, and only the intervals of the ratios have what varies between shapes. Cells that "
                  "hold several runs (seeds, parameter sets) put them together.");
}

void add_how_to_read(bool times, Sentences& notes) {
  if (times)
    notes.push_back(
        "Equal work: points in memory to a valid multipolygon in memory, for every method alike. As the "
        "paper took it: the method's own run only. Loading the points (the upload to a database) is in "
        "neither.");
  notes.push_back(std::string(times ? "A ratio of times is the median over the rounds of a case, in each of "
                                      "which both methods were measured right after one another. "
                                    : "") +
                  "Of ratios the median, the least and the largest of the cases are shown. A case that only "
                  "the method failed has the ratio ∞, and one that only the method beside it failed has 0." +
                  (times ? " 95 %: a bootstrap interval of the median that resamples whole shapes and in "
                           "each case passes and rounds; of few shapes it is a rough one, and of a single "
                           "shape it has nothing of what varies between shapes. \"> 3\": it has no upper end."
                         : ""));
  const auto text_of = [](const record::Protocol& one) { return one.name + ", " + one.chosen; };
  notes.push_back("The protocol in brackets says who chose the parameters: " +
                  joined(record::protocols(), "; ", text_of) + ".");
  notes.push_back(
      "A cell with a word is a run without a result: its status, or \"invalid\" for a result that is not a "
      "valid multipolygon. A dash: not run or not defined.");
}

void add_paper_notes(const std::vector<record::RunRecord>& runs, Sentences& notes) {
  if (std::ranges::none_of(
          runs, [](const record::RunRecord& run) { return paper().at("protocol") == run.protocol; })) {
    return;
  }
  for (const json& note : paper().at("notes")) notes.push_back(note.get<std::string>());
}

void add_plan_notes(const json& report, const std::vector<record::RunRecord>& runs, Sentences& notes) {
  const json& plan = report.at("plan");
  for (const json& note : plan.value("notes", json::array())) notes.push_back(note.get<std::string>());
  for (const json& method : plan.value("methods", json::array())) {
    const std::string note = method.value("note", "");
    const bool has_row = std::ranges::any_of(runs, [&](const record::RunRecord& run) {
      return run.method == method.value("method", "") && run.protocol == method.value("protocol", "");
    });
    if (note.empty() || !has_row) continue;
    notes.push_back(method_label(report, method.value("method", ""), method.value("protocol", "")) + ": " +
                    sentence(note));
  }
}

/// Methods that are missing and have no row that could say so.
void add_missing_methods(const json& report, const std::vector<record::RunRecord>& runs, Sentences& notes) {
  for (const json& method : report.at("methods")) {
    if (method.value("installed", true)) continue;
    const std::string name = method.at("name").get<std::string>();
    if (std::ranges::any_of(runs, [&](const record::RunRecord& run) { return run.method == name; })) continue;
    notes.push_back(not_installed_text(report, method_title(report, name), name, method.value("detail", "")));
  }
}

std::string huge_pages_text(const json& huge_pages) {
  const json& kernel = huge_pages.at("kernel");
  return "Huge pages: the malloc of every method's process had " +
         huge_pages.at("malloc").get<std::string>() +
         (kernel.is_string() ? "; the kernel's setting was " + kernel.get<std::string>() : std::string()) +
         ".";
}

/// One machine and its build; `machine` is empty or its name in the sentence.
void add_environment(const json& environment, const std::string& machine, Sentences& notes) {
  const json& cpu = environment.at("cpu");
  const json& compiler = environment.at("compiler");
  const json& os = environment.at("os");
  notes.push_back(
      machine + cpu.at("model").get<std::string>() + ", " + cpu.at("logical_cores").dump() +
      " logical cores" + (cpu.at("virtualised") == true ? " (virtual machine)" : "") +
      (os.is_string() ? ", " + os.get<std::string>() : std::string()) + "; " +
      compiler.at("id").get<std::string>() + " " + compiler.at("version").get<std::string>() + ", " +
      compiler.at("build_type").get<std::string>() + ", " + compiler.at("flags").get<std::string>() +
      (compiler.at("native") == true ? ", for this machine's processor." : ", no processor-specific code."));
  notes.push_back(compiler.at("statement").get<std::string>());
  if (environment.contains("huge_pages")) notes.push_back(huge_pages_text(environment.at("huge_pages")));
}

std::string percent_words(double part) {
  return three_digits(100 * part) + " %";
}

void add_noise(const json& report, const std::vector<record::RunRecord>& runs, Sentences& notes) {
  const std::optional<Noise> noise = measure_noise(runs);
  if (!noise) return;
  const json& load = report.at("environment").at("load_average");
  notes.push_back((noise->is_noisy() ? "This machine was noisy: differences of some per cent say nothing. "
                                     : std::string()) +
                  "The median absolute deviation is " + percent_words(noise->median_spread) +
                  " of the median in the middle row and at most " + percent_words(noise->ninth_decile) +
                  " in nine of ten" +
                  (load.is_array() && !report.contains("merged")
                       ? "; before the run the load average was " + fixed(load.at(0), 2)
                       : std::string()) +
                  ".");
}

void add_too_fast(const std::vector<record::RunRecord>& runs, Sentences& notes) {
  std::string names;
  for (const record::RunRecord& run : runs) {
    if (std::ranges::count(run.flags, record::kFasterThanFloor) > 0)
      names += (names.empty() ? "" : ", ") + run.name;
  }
  if (names.empty()) return;
  notes.push_back("Faster than " + three_digits(record::kFloorNsPerPoint) +
                  " ns a point, which no method can be, so do not believe these times: " + names + ".");
}

std::string of_rows(std::size_t count, std::size_t rows) {
  return std::to_string(count) + " of " + std::to_string(rows) + " rows";
}

/// How many rows were taken while the machine was in another state than usual.
void add_unsteady(const std::vector<record::RunRecord>& runs, Sentences& notes) {
  std::size_t timed = 0;
  std::size_t again = 0;
  std::size_t unsteady = 0;
  const auto has = [](const record::RunRecord& run, const char* flag) {
    return std::ranges::find(run.flags, flag) != run.flags.end();
  };
  for (const record::RunRecord& run : runs) {
    if (run.time_ns.empty()) continue;
    ++timed;
    again += has(run, record::kRemeasuredRound) ? 1U : 0U;
    unsteady += has(run, record::kUnsteadyMachine) ? 1U : 0U;
  }
  if (again > 0)
    notes.push_back("The machine's state was off in a round of " + of_rows(again, timed) +
                    ", which was measured again.");
  if (unsteady > 0)
    notes.push_back("It was still off after the last try in " + of_rows(unsteady, timed) +
                    ": their times are of a machine in another state.");
}

/// Whose results are worse than the convex hull of the points.
void add_worse_than_hull(const json& report, const std::vector<record::RunRecord>& runs, Sentences& notes) {
  std::map<std::string, std::pair<std::size_t, std::size_t>> counts;  // by method: worse ones, results
  for (const record::RunRecord& run : runs) {
    if (!is_measured(run)) continue;
    auto& [worse, results] = counts[method_label(report, run.method, run.protocol)];
    worse += is_worse_than_convex_hull(run) ? 1U : 0U;
    ++results;
  }
  std::string names;
  for (const auto& [name, count] : counts) {
    if (count.first == 0) continue;
    names += (names.empty() ? "" : ", ") + name + " " + std::to_string(count.first) + " of " +
             std::to_string(count.second);
  }
  if (!names.empty())
    notes.push_back("Results whose error is above that of the points' convex hull: " + names + ".");
}

/// Of a merged run every machine, each once.
void add_environments(const json& report, Sentences& notes) {
  if (!report.contains("merged")) return add_environment(report.at("environment"), "", notes);
  Sentences all;
  for (const json& part : report["merged"]) {
    const json& environment = part.at("environment");
    add_environment(environment, "Machine " + environment.at("machine_id").get<std::string>() + ": ", all);
  }
  for (std::string& note : all) {
    if (std::ranges::find(notes, note) == notes.end()) notes.push_back(std::move(note));
  }
}

/// Which runs a merged one consists of.
void add_parts(const json& report, Sentences& notes) {
  if (!report.contains("merged")) return;
  const std::set<std::string> machines = machines_of(report);
  notes.push_back("Merged of " + std::to_string(report["merged"].size()) + " runs" +
                  (machines.size() == 1 ? ", all timed on machine " + *machines.begin() : "") + ".");
}

void add_totals(const json& report, Sentences& notes) {
  std::vector<std::string> counts;
  for (const record::Status status : record::kAllStatuses) {
    const json& count = report.at("summary").at("totals").at(to_string(status));
    if (count != 0) counts.push_back(count.dump() + " " + to_string(status));
  }
  notes.push_back("Rows by status: " + (counts.empty() ? "none" : joined(counts, ", ")) + ".");
  const std::size_t resumed = report.value("resumed", json::array()).size();
  if (resumed > 0)
    notes.push_back("The run was interrupted and gone on with, times: " + std::to_string(resumed) + ".");
}

}  // namespace

std::vector<std::string> run_notes(const json& report, const Measurements& measurements) {
  const std::vector<record::RunRecord>& runs = measurements.runs();
  Sentences notes;
  if (measurements.has_times()) {
    add_repetitions(measurements, notes);
  } else {
    notes.push_back(measurements.why_no_times());
  }
  add_parts(report, notes);
  add_plan_notes(report, runs, notes);
  for (const json& note : report.at("notes")) notes.push_back(note.get<std::string>());
  add_missing_methods(report, runs, notes);
  add_too_fast(runs, notes);
  add_unsteady(runs, notes);
  add_worse_than_hull(report, runs, notes);
  add_noise(report, runs, notes);
  add_totals(report, notes);
  return notes;
}

std::vector<std::string> common_notes(const json& report, const Measurements& measurements) {
  Sentences notes;
  add_how_to_read(measurements.has_times(), notes);
  add_paper_notes(measurements.runs(), notes);
  add_environments(report, notes);
  return notes;
}

}  // namespace hullbench::report
