// A run of core_benchmarks for its verdicts: what is seen while it goes on, and what is kept of it.
#pragma once

#include <benchmark/benchmark.h>

#include <cstddef>
#include <map>
#include <ostream>
#include <string>
#include <vector>

#include "benchmarks/base/status_line.hpp"
#include "benchmarks/micro/core_verdicts.hpp"

namespace hullbench::micro {

/// Which repetition is being measured: with repetitions interleaved Google Benchmark is silent until the end.
class RepetitionProgress {
 public:
  /// `total`: of all benchmarks together.
  RepetitionProgress(std::ostream& out, bool terminal, std::size_t total);

  /// `benchmark` is about to be called with this number of iterations.
  void begin(const std::string& benchmark, benchmark::IterationCount iterations);
  /// Takes the line away.
  void end() { status_.clear(); }

 private:
  StatusLine status_;
  std::size_t total_;
  std::size_t begun_ = 0;
  std::map<std::string, benchmark::IterationCount> iterations_;  ///< by benchmark: of its last call
};

/// Keeps every repetition's time, of one run or several, instead of printing it.
class CollectingReporter final : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context& context) override;
  void ReportRuns(const std::vector<Run>& runs) override;

  const Measurements& measurements() const { return measurements_; }
  /// By benchmark: why it has no time.
  const std::map<std::string, std::string>& errors() const { return errors_; }

 private:
  Measurements measurements_;
  std::map<std::string, std::string> errors_;
};

}  // namespace hullbench::micro
