// The core, whole and step by step, beside CGAL and GEOS on the same points in the same process.
//
// Read ratios of medians of one run with interleaved repetitions, never a single time. With --verdicts it
// runs that way what has a goal and says which goals are met.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "benchmarks/base/huge_pages.hpp"
#include "benchmarks/micro/core_verdicts.hpp"
#include "benchmarks/micro/measured_functions.hpp"
#include "benchmarks/micro/point_sets.hpp"
#include "benchmarks/micro/verdict_run.hpp"

namespace hullbench::micro {
namespace {

constexpr std::string_view kRepetitions = "--benchmark_repetitions=";

/// How often a goal that is undecided is measured. A goal that is met up to its limit is called missed in one
/// round with a probability of 1 % (the interval's confidence is 98 %), so in some round with at most 5 %.
constexpr std::size_t kRounds = 5;

const SpeedPointSet& point_set(const std::string& name, std::size_t n) {
  static std::map<std::pair<std::string, std::size_t>, SpeedPointSet> made;
  const auto key = std::pair{name, n};
  if (const auto found = made.find(key); found != made.end()) return found->second;
  return made.emplace(key, make_speed_point_set(name, n)).first->second;
}

struct Benchmark {
  std::string name;
  MeasuredFunction function;
  std::string set;
  std::size_t n;
};

std::vector<Benchmark> all_benchmarks() {
  std::vector<std::pair<std::string, std::size_t>> inputs;
  for (const char* set : {"ca", "uniform", "lattice", "rgbd"}) {
    for (const std::size_t n : {2'000U, 8'000U, 64'000U, 1'000'000U}) inputs.emplace_back(set, n);
  }
  for (const std::size_t n : {1'000U, 10'000U, 100'000U, 10'000'000U}) inputs.emplace_back("uniform", n);
  inputs.emplace_back("ca", 10'000'000);
  inputs.emplace_back("airborne", 1'000'000);
  for (const std::size_t n : {8'000U, 64'000U, 1'000'000U}) inputs.emplace_back("gradient", n);
  inputs.emplace_back("rgbd", 424 * 240);  // a depth image as the sensor gives it
  inputs.emplace_back("islands", 1'000'000);
  inputs.emplace_back("sieve", 1'000'000);
  for (const char* set : {"gradient64", "clusters", "circle", "parabola", "repeats", "repeats8", "tight"}) {
    for (const std::size_t n : {8'000U, 64'000U}) inputs.emplace_back(set, n);
  }
  for (const char* set : {"gradient64", "clusters"}) inputs.emplace_back(set, 1'000'000);

  std::vector<Benchmark> benchmarks;
  for (const auto& [set, n] : inputs) {
    for (const auto& functions : {own_functions(), own_phases(), cgal_functions(), geos_functions()}) {
      for (const MeasuredFunction& function : functions) {
        if (n > function.most_points || n < function.least_points) continue;
        const auto& sets = function.sets;
        if (!sets.empty() && std::ranges::find(sets, set) == sets.end()) continue;
        const std::string name = std::string(function.name) + "/" + set + "/" + std::to_string(n);
        benchmarks.push_back({name, function, set, n});
      }
    }
  }
  return benchmarks;
}

void register_benchmark(const Benchmark& entry, RepetitionProgress* progress) {
  const auto run = [=](benchmark::State& state) {
    if (progress != nullptr) progress->begin(entry.name, state.max_iterations);
    try {
      entry.function.run(state, point_set(entry.set, entry.n));
    } catch (const std::exception& error) {
      state.SkipWithError(error.what());
    }
  };
  // No UseRealTime: it adds "/real_time" to the name. The real time is measured all the same, and is what
  // the verdicts take; the time that decides on the number of iterations is the calling thread's.
  benchmark::RegisterBenchmark(entry.name.c_str(), run)->Unit(benchmark::kMicrosecond);
}

/// Whether Google Benchmark's --benchmark_filter takes `name`.
bool filter_takes(const std::string& name) {
  std::string filter = benchmark::GetBenchmarkFilter();
  if (filter.empty() || filter == "all") return true;
  const bool negative = filter.front() == '-';
  if (negative) filter.erase(0, 1);
  return std::regex_search(name, std::regex(filter, std::regex::extended)) != negative;
}

void print_help() {
  std::cout
      << "core_benchmarks [--verdicts] [options of Google Benchmark]\n"
         "  --verdicts  measure what has a goal, in 7 interleaved repetitions, and say which goals are met;\n"
         "              what is undecided then is measured up to 4 times as often again\n"
      << kExitCodesHelp << "\n\n";
  benchmark::PrintDefaultHelp();
}

/// Measures these benchmarks once more, each so many times in turn.
void measure_round(const std::vector<Benchmark>& benchmarks, std::size_t repetitions,
                   CollectingReporter& reporter) {
  RepetitionProgress progress(std::cerr, isatty(STDERR_FILENO) != 0, benchmarks.size() * repetitions);
  for (const Benchmark& entry : benchmarks) register_benchmark(entry, &progress);
  benchmark::RunSpecifiedBenchmarks(&reporter);
  benchmark::ClearRegisteredBenchmarks();
  progress.end();
}

ExitCode run_for_verdicts(std::size_t repetitions) {
  const std::vector<Benchmark> all = all_benchmarks();
  std::set<std::string> needed = benchmarks_of_goals();
  CollectingReporter reporter;
  for (std::size_t round = 0; round < kRounds && !needed.empty(); ++round) {
    std::vector<Benchmark> benchmarks;
    std::copy_if(all.begin(), all.end(), std::back_inserter(benchmarks), [&](const Benchmark& entry) {
      return needed.count(entry.name) != 0 && filter_takes(entry.name);
    });
    measure_round(benchmarks, repetitions, reporter);
    needed = benchmarks_of_undecided_goals(reporter.measurements());
  }

  print_measurements(reporter.measurements(), std::cout);
  std::cout << "\n";
  const std::vector<VerdictLine> lines = core_verdicts(reporter.measurements());
  print_verdicts(lines, std::cout);
  for (const auto& [name, error] : reporter.errors()) std::cout << "error: " << name << ": " << error << "\n";
  return exit_code(lines);
}

/// Takes --verdicts out of the arguments, and puts what it implies before the user's own, which win.
bool take_verdicts(std::vector<std::string>& arguments) {
  if (std::erase(arguments, "--verdicts") == 0) return false;
  const std::vector<std::string> implied = {std::string(kRepetitions) + "7", "--benchmark_min_time=0.1",
                                            "--benchmark_enable_random_interleaving=true"};
  arguments.insert(arguments.begin() + 1, implied.begin(), implied.end());
  return true;
}

/// How many repetitions the arguments ask for.
std::size_t repetitions_of(const std::vector<std::string>& arguments) {
  std::size_t repetitions = 1;
  for (const std::string& argument : arguments) {
    if (!argument.starts_with(kRepetitions)) continue;
    repetitions = std::stoul(argument.substr(kRepetitions.size()));
  }
  return repetitions;
}

ExitCode run(std::vector<std::string> arguments) {
  const bool verdicts = take_verdicts(arguments);
  std::vector<char*> pointers;
  pointers.reserve(arguments.size() + 1);
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  int count = static_cast<int>(pointers.size());
  pointers.push_back(nullptr);
  benchmark::Initialize(&count, pointers.data(), &print_help);
  if (benchmark::ReportUnrecognizedArguments(count, pointers.data())) return kExitUsage;

  ExitCode status = kExitOk;
  if (verdicts) {
    status = run_for_verdicts(repetitions_of(arguments));
  } else {
    for (const Benchmark& entry : all_benchmarks()) register_benchmark(entry, nullptr);
    benchmark::RunSpecifiedBenchmarks();
  }
  benchmark::Shutdown();
  return status;
}

// The core asks for huge pages itself; CGAL and GEOS have them too. As malloc reads its settings when a
// program starts, one that lacks them starts itself again.
void ask_for_huge_pages(char** argv) {
  const std::string variable(kTunablesVariable);
  const char* const own = std::getenv(variable.c_str());
  const std::string wanted = worker_tunables(own == nullptr ? "" : own);
  if (own != nullptr && wanted == own) return;
  ::setenv(variable.c_str(), wanted.c_str(), 1);
  ::execv("/proc/self/exe", argv);
  std::cerr << "core_benchmarks: measured without huge pages for CGAL and GEOS\n";
}

}  // namespace
}  // namespace hullbench::micro

int main(int argc, char** argv) {
  hullbench::micro::ask_for_huge_pages(argv);
  return hullbench::exit_code_of("core_benchmarks", std::cerr, [&] {
    return hullbench::micro::run(std::vector<std::string>(argv, argv + argc));
  });
}
