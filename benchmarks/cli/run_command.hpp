// `hullbench run`, for other subcommands that measure.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/base/exit_code.hpp"
#include "benchmarks/run/shard.hpp"

namespace hullbench::cli {

/// What is not given is as the plan says.
struct RunCommand {
  std::vector<std::string> plans;  ///< one or more; several make a suite (suite.hpp)
  std::string filter;
  std::optional<int> repetitions;
  std::optional<int> passes;
  std::optional<std::uint64_t> seed;
  std::optional<double> timeout_s;
  std::optional<std::int64_t> mem_limit_mib;
  std::optional<fs::path> out;
  fs::path recordings;  ///< folder of real floors to take the place of the simulated ones; empty: none
  std::optional<run::Shard> shard;  ///< none: all runs
  fs::path export_gbench;           ///< file for the times as Google Benchmark's JSON; empty: none
  std::vector<fs::path> adapters;   ///< more folders with manifests
  std::vector<std::string> with;    ///< methods to measure that the plans do not name
  bool keep_polygons = false;       ///< whether the results stay in the run's folder
  bool force = false;               ///< start anew instead of going on
  bool dry_run = false;
};

/// Measures the plans and prints their tables. Throws ConfigurationError for what is wrong with the command
/// or its plans.
ExitCode run_plans(const RunCommand& command);

}  // namespace hullbench::cli
