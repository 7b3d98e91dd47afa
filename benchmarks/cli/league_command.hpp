// `hullbench league`: the league of some runs, printed and written.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace hullbench::cli {

/// The command line of `league`.
struct LeagueCommand {
  std::vector<std::filesystem::path> runs;  ///< folders of runs, or of suites
  std::filesystem::path out;                ///< for league.json; empty: only print
  std::uint64_t split_seed = 1;
  bool all_cases = false;
};

/// Prints the tables and writes the file. Returns 0, or 6 when there is nothing to be judged. Throws
/// ConfigurationError when a folder has no run or the file cannot be written.
int league_command(const LeagueCommand& command);

}  // namespace hullbench::cli
