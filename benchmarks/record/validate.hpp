// Checks files against the schemas in results/, which are part of the program.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"

namespace hullbench::record {

/// The faults of a report (`*.json`), of a manifest (`manifest_version`), of a run's description
/// (`run.json`), of a search's summary or a league (by their `kind`), or of the lines of a runs, a pictures
/// or a sweep file (`*.jsonl`), one sentence each with the place as a JSON pointer; empty when the file is
/// valid. A torn last line of a runs file is a fault. Throws std::runtime_error naming the file when it
/// cannot be read or is not JSON.
std::vector<std::string> validate_file(const fs::path& path);

/// The same of a report in memory.
std::vector<std::string> validate_report(const json& report);

/// The same of a run's description, an object.
std::vector<std::string> validate_run(json description);

/// The same of a manifest (manifest.hpp) in memory, and what contradicts itself in its parameters.
std::vector<std::string> validate_manifest(const json& manifest);

/// The same of what says its `kind`: a line of pictures.jsonl, tune.json, league.json, tables.json,
/// submission.json. Throws std::invalid_argument for any other document.
std::vector<std::string> validate_by_kind(const json& document);

}  // namespace hullbench::record
