// `hullbench run`: from the command line's words to rows, report and tables.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/run/runner.hpp"
#include "benchmarks/run/shard.hpp"

namespace hullbench::cli {

/// The command line of `run`; what is not given is as the plan says.
struct RunCommand {
  std::vector<std::string> plans;  ///< one or more; several make a suite (suite.hpp)
  std::string filter;
  std::optional<int> repetitions;
  std::optional<int> passes;
  std::optional<std::uint64_t> seed;
  std::optional<double> timeout_s;
  std::optional<std::int64_t> mem_limit_mib;
  std::optional<std::filesystem::path> out;
  std::filesystem::path
      recordings;  ///< folder of real floors to take the place of the simulated ones; empty: none
  std::optional<run::Shard> shard;      ///< none: all runs
  std::filesystem::path export_gbench;  ///< file for the times as Google Benchmark's JSON; empty: none
  std::vector<std::filesystem::path> adapters;  ///< more folders with manifests
  std::vector<std::string> with;                ///< methods to measure that the plans do not name
  bool force = false;
  bool dry_run = false;
};

/// For before the work, because the file is written last: throws ConfigurationError when the file of
/// --export-gbench cannot be written. Empty: none is asked for.
void check_export_place(const std::filesystem::path& file);

/// Does it and returns the exit code (see exit_code). Tables go to standard output, everything else to
/// standard error. Throws ConfigurationError before anything is measured, std::runtime_error when something
/// cannot be written.
int run_command(const RunCommand& command);

}  // namespace hullbench::cli
