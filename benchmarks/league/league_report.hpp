// What is written of a league: league.json (results/league.schema.json) and its tables.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "benchmarks/document.hpp"
#include "benchmarks/league/league.hpp"

namespace hullbench {

/// What a kept league's file is called.
inline constexpr const char* kLeagueFile = "league.json";

/// The league as JSON, with what `reports` say of tool, machine and plans. A median or an end of an interval
/// that is infinite is null.
nlohmann::json league_to_json(const League& league, const std::vector<nlohmann::json>& reports);

/// The tables of what league_to_json made: the league, a table a protocol, and the performance profiles, a
/// table a group.
Document league_document(const nlohmann::json& league);

/// What the README shows of it: the league, and the profile of the methods that see the points only.
std::string league_results(const nlohmann::json& league);

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

}  // namespace hullbench
