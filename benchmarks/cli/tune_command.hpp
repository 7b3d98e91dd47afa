// `hullbench tune`: searches every method's parameter and says what each way of choosing it costs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/run/shard.hpp"

namespace hullbench::cli {

/// The command line of `tune`.
struct TuneCommand {
  std::vector<std::string> plans;  ///< one or more: their cases
  std::string methods;             ///< regular expression; empty: all built-in methods
  std::optional<std::filesystem::path> out;
  std::uint64_t seed = 1;                       ///< of the split; points are drawn with the plans' seeds
  std::optional<double> timeout_s;              ///< for one evaluation, instead of the plan's
  std::optional<int> jobs;                      ///< none: one a core
  std::optional<run::Shard> shard;              ///< none: all cases
  std::vector<std::filesystem::path> adapters;  ///< more folders with manifests
};

/// Does it and returns the exit code: 0; 4 when a method failed with everything that was tried on some case;
/// 6 when there is no evaluation that gave a result; 130 when it was interrupted. The same command goes on
/// with what is there. The folder (`out`, else results/tune/PLAN) gets
///
///   sweep.jsonl       every evaluation (results/sweep.schema.json), as they happen
///   tune.json         the summary (results/tune.schema.json)
///   tuning.md         its tables, which go to standard output too
///   PLAN-tuned.json   each plan with the chosen parameters (tuned_plan.hpp)
///
/// A shard only leaves its evaluations there, in sweep-K-of-N.jsonl. Throws ConfigurationError before
/// anything is evaluated, std::runtime_error when something cannot be written.
int tune_command(const TuneCommand& command);

}  // namespace hullbench::cli
