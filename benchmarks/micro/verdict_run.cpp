#include "benchmarks/micro/verdict_run.hpp"

#include <optional>
#include <string>

#include "benchmarks/micro/measure.hpp"

namespace hullbench::micro {
namespace {

/// Why nothing was measured in a run of Google Benchmark, which names it in two ways: "error" until 1.7,
/// "skip" since 1.8. Nothing when all went well.
template <typename Run>
std::optional<std::string> failure(const Run& run) {
  if constexpr (requires { run.skip_message; }) {
    if (run.skipped != decltype(run.skipped){}) return run.skip_message;
  } else {
    if (run.error_occurred) return run.error_message;
  }
  return std::nullopt;
}

}  // namespace

RepetitionProgress::RepetitionProgress(std::ostream& out, bool terminal, std::size_t total)
    : status_(out, terminal), total_(total) {}

void RepetitionProgress::begin(const std::string& benchmark, benchmark::IterationCount iterations) {
  // Inside its first repetition Google Benchmark calls a benchmark with more and more iterations until they
  // take long enough; every later repetition is one call with as many as the last of these.
  benchmark::IterationCount& last = iterations_[benchmark];
  if (last == 0 || last == iterations) ++begun_;
  last = iterations;
  status_.show("[" + std::to_string(begun_) + "/" + std::to_string(total_) + "] " + benchmark);
}

bool CollectingReporter::ReportContext(const Context& context) {
  if (measurements_.empty()) PrintBasicContext(&GetErrorStream(), context);  // once, of several runs
  return true;
}

void CollectingReporter::ReportRuns(const std::vector<Run>& runs) {
  for (const Run& run : runs) {
    const std::string name = run.run_name.str();
    if (const auto why = failure(run)) {
      errors_[name] = *why;
      continue;
    }
    if (run.run_type != Run::RT_Iteration || run.iterations == 0) continue;
    Measured& measured = measurements_[name];
    measured.times.push_back(run.real_accumulated_time * 1e9 / static_cast<double>(run.iterations));
    if (const auto counter = run.counters.find(kPeakBytesPerPoint); counter != run.counters.end()) {
      measured.peak_bytes = counter->second;
    }
  }
}

}  // namespace hullbench::micro
