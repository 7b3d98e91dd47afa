// The two programs that a gate compares, and one process of either.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/gate/gate_cases.hpp"

namespace hullbench::gate {

/// What one process measured: the estimate of every quantity in nanoseconds, and the hash of every case's
/// result.
struct ProbeTimes {
  std::map<std::string, double> ns;            ///< "concave_hull ca-64000"
  std::map<std::string, std::string> results;  ///< by case
};

/// How probes are run.
struct ProbeSettings {
  std::filesystem::path cases_folder;
  std::vector<GateCase> cases;
  int repeats = 5;          ///< >= 1, inside a process
  std::optional<int> core;  ///< the processor core that every probe runs on; none: any
};

/// Runs one process of `program` to its end. Quantities are "concave_hull CASE" (triangulation and outline of
/// one repeat together), "outline CASE", and "concave_hull_once CASE" where it was asked for. Throws
/// std::runtime_error when the process fails, says something else, or takes more than a minute, and
/// Interrupted.
ProbeTimes run_probe(const std::filesystem::path& program, const ProbeSettings& settings);

/// Runs it once for its results alone, written to `folder` as CASE.wkb. Throws as run_probe.
void write_results(const std::filesystem::path& program, const ProbeSettings& settings,
                   const std::filesystem::path& folder);

/// Instructions of "triangulation CASE" and "outline CASE" as callgrind counts them, in one call after one
/// that is not counted. `folder` holds callgrind's files meanwhile. Throws ConfigurationError when valgrind
/// is not installed, else as run_probe.
std::map<std::string, double> count_instructions(const std::filesystem::path& program,
                                                 const ProbeSettings& settings,
                                                 const std::filesystem::path& folder);

}  // namespace hullbench::gate
