// `hullbench merge`.
#pragma once

#include <filesystem>
#include <vector>

namespace hullbench::cli {

/// The command line of `merge`.
struct MergeCommand {
  std::vector<std::filesystem::path>
      sources;                ///< folders of runs, or all of suites, which are merged by plan
  std::filesystem::path out;  ///< new or empty; never one of `sources`, in one of them or around one
  bool force = false;         ///< `out` may hold anything but a suite, or a run when `sources` are suites
};

/// Writes the merged run, or suite, with report and tables, which go to standard output too. Returns 0; 4
/// when a row is a failure or a planned one is missing; 6 when there is no row, and nothing is written then,
/// or none is ok. Throws like merge_runs, before anything is written, and ConfigurationError when `out`
/// cannot be used.
int merge_command(const MergeCommand& command);

}  // namespace hullbench::cli
