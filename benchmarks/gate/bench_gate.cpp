// bench_gate: whether head is slower than base, or gives other results. benchmarks/gate/gate.sh builds the
// two probes and calls it.
#include <unistd.h>

#include <chrono>
#include <iostream>
#include <string>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/base/cores.hpp"
#include "benchmarks/base/exit_code.hpp"
#include "benchmarks/base/files.hpp"
#include "benchmarks/base/interrupt.hpp"
#include "benchmarks/base/status_line.hpp"
#include "benchmarks/gate/gate_accuracy.hpp"
#include "benchmarks/gate/gate_cases.hpp"
#include "benchmarks/gate/gate_probes.hpp"
#include "benchmarks/gate/gate_report.hpp"
#include "benchmarks/gate/gate_verdict.hpp"
#include "benchmarks/gate/time_gate.hpp"
#include "benchmarks/worker/worker_process.hpp"
#include "tool/program/command_line.hpp"

namespace {

using namespace hullbench;
using namespace hullbench::gate;
using Clock = std::chrono::steady_clock;

constexpr double kTimeThreshold = 0.05;
constexpr double kInstructionThreshold = 0.02;

struct Arguments {
  std::string base_probe;
  std::string head_probe;
  std::string base_name = "base";
  std::string head_name = "head";
  std::string out = "build-gate";
  std::size_t blocks = 32;
  int time_limit = 110;  ///< seconds; a gate is to end within two minutes
  int repeats = 5;
  bool instructions = false;
};

void add_options(CLI::App& app, Arguments& arguments) {
  app.footer(kExitCodesHelp);
  app.add_option("--base-probe", arguments.base_probe, "gate_probe built with base's core")
      ->required()
      ->check(CLI::ExistingFile);
  app.add_option("--head-probe", arguments.head_probe, "gate_probe built with head's core")
      ->required()
      ->check(CLI::ExistingFile);
  app.add_option("--base-name", arguments.base_name, "What base is, for the report");
  app.add_option("--head-name", arguments.head_name, "What head is, for the report");
  app.add_option("--out", arguments.out, "Folder for gate.json and, in gate-work, what is needed meanwhile")
      ->capture_default_str();
  app.add_option("--blocks", arguments.blocks, "Blocks of six processes in a round")
      ->check(CLI::Range(kFewestBlocks, std::size_t{1000}))
      ->capture_default_str();
  app.add_option("--time-limit", arguments.time_limit, "Seconds after which no further block begins")
      ->check(CLI::Range(0, 86400))
      ->capture_default_str();
  app.add_option("--repeats", arguments.repeats, "Timed calls of every case in a process")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  app.add_flag("--instructions", arguments.instructions,
               "Count instructions with callgrind instead of timing");
}

ProbeSettings probe_settings(const Arguments& arguments, const fs::path& work) {
  ProbeSettings settings;
  settings.cases_folder = work / "cases";
  settings.cases = arguments.instructions ? instruction_cases() : time_cases();
  settings.repeats = arguments.repeats;
  const std::vector<int> cores = allowed_cores();
  if (!cores.empty()) settings.core = cores.back();
  return settings;
}

GateFindings gate_instructions(const Arguments& arguments, const ProbeSettings& probe, const fs::path& work,
                               const GateRules& rules, json& samples) {
  const auto count = [&](const std::string& title, const std::string& program) {
    std::cerr << "counting instructions: " << title << "\n";
    return count_instructions(program, probe, work / "callgrind");
  };
  const auto base = count("base", arguments.base_probe);
  const auto head = count("head", arguments.head_probe);
  const auto base_again = count("base again", arguments.base_probe);
  std::vector<InstructionCounts> counts;
  for (const auto& [name, instructions] : base) {
    counts.push_back({name, instructions, base_again.at(name), head.at(name)});
    samples[name] = {instructions, base_again.at(name), head.at(name)};
  }
  return judge_instructions(counts, rules);
}

GateFindings measure(const Arguments& arguments, Clock::time_point start, const GateRules& rules,
                     json& samples) {
  // A folder of its own, of which things are removed: whatever else is in `--out` is the user's.
  const fs::path work = fs::path(arguments.out) / "gate-work";
  fs::remove_all(work / "results");
  const ProbeSettings probe = probe_settings(arguments, work);
  write_cases(probe.cases, probe.cases_folder);
  write_results(arguments.base_probe, probe, work / "results" / "base");
  write_results(arguments.head_probe, probe, work / "results" / "head");
  if (probe.core) leave_core(*probe.core);
  const Clock::time_point deadline = start + std::chrono::seconds(arguments.time_limit);
  StatusLine status(std::cerr, ::isatty(STDERR_FILENO) == 1);
  const auto show = [&](const std::string& title, std::size_t begun, std::size_t total) {
    status.show(title + " [" + std::to_string(begun) + "/" + std::to_string(total) + "]");
  };
  GateFindings findings = arguments.instructions ? gate_instructions(arguments, probe, work, rules, samples)
                                                 : gate_times({.base_probe = arguments.base_probe,
                                                               .head_probe = arguments.head_probe,
                                                               .folder = work / "programs",
                                                               .probe = probe,
                                                               .blocks = arguments.blocks,
                                                               .deadline = deadline,
                                                               .on_process = show},
                                                              rules, samples);
  findings.accuracy = compare_results(probe.cases, work / "results" / "base", work / "results" / "head");
  return findings;
}

ExitCode run(const Arguments& arguments) {
  catch_interruptions();
  const fs::path out = arguments.out;
  fs::create_directories(out);
  GateRules rules;
  rules.threshold = arguments.instructions ? kInstructionThreshold : kTimeThreshold;
  GateContext context;
  context.tier = arguments.instructions ? "instructions" : "time";
  context.base = arguments.base_name;
  context.head = arguments.head_name;
  const auto start = Clock::now();
  const GateFindings findings = measure(arguments, start, rules, context.samples);
  context.seconds = std::chrono::duration<double>(Clock::now() - start).count();

  const GateVerdict verdict = decide(findings, rules);
  print_gate(findings, verdict, context, std::cout);
  write_json_file(out / "gate.json", gate_json(findings, verdict, rules, context));
  return verdict.exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  return exit_code_of("bench_gate", std::cerr, [&] {
    CLI::App app("Whether head is slower than base, or gives other results.", "bench_gate");
    Arguments arguments;
    add_options(app, arguments);
    return polylidar::tool::parsed_action(
        app, [&] { return run(arguments); }, argc, argv)();
  });
}
