// What is written of a league: league.json (results/league.schema.json) and its tables.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "benchmarks/league/league.hpp"
#include "benchmarks/table/writers.hpp"

namespace hullbench::league {

/// What a kept league's file is called.
inline constexpr const char* kLeagueFile = "league.json";
inline constexpr const char* kLeagueTablesFile = "league.md";

/// The league as JSON, with what `reports` say of tool, machine and plans. A median or an end of an interval
/// that is infinite is null.
json league_to_json(const League& league, const std::vector<json>& reports);

/// The tables of what league_to_json made: of each protocol the league and its parts (kinds of shapes, ways
/// to sample), and the performance profiles, a table a group.
table::Document league_document(const json& league);

/// Every result that counts, a line each, in the long form that programs for ranking read: method (under a
/// protocol: "polylidar/auto"), task, fold (the seed), error (l2; "inf": a failure) and time (seconds; empty:
/// none), then points, status, shape, kind, sampler and weight.
std::string league_csv(const League& league);

/// The league that is kept in `folder`; null when there is none.
json load_league(const fs::path& folder);

/// Writes league.md, the tables of the league that is kept in `folder`; nothing without one.
void write_league_tables(const fs::path& folder);

/// What the README shows of it: the first three of every protocol, whoever they are. `folder`: how the README
/// calls the folder with league.md.
std::string league_results(const json& league, const std::string& folder);

}  // namespace hullbench::league
