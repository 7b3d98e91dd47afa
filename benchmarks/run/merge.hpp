// `hullbench merge`: runs of the same plan, mostly shards of it from several machines, become one.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "benchmarks/record/record.hpp"

namespace hullbench::run {

/// Several runs as one.
struct MergedRun {
  /// run.json: the first run's, with `merged`, a list of {shard, created, resumed, tool, environment} of
  /// every run in it, and `notes`, sentences about rows that are missing or were there more than once.
  json header;
  std::vector<record::RunRecord> rows;  ///< in the order of the plan; each says its machine
  std::size_t planned = 0;              ///< number of rows that the plan and its filter ask for
  std::vector<fs::path> folders;        ///< of the runs, in the order in which they were taken
};

/// The names of several lists, each once, so that each list's order is kept as far as the others' allow it.
std::vector<std::string> common_order(std::vector<std::vector<std::string>> lists);

/// Merges the runs in `folders` (one or more). The result does not depend on their order: the runs are taken
/// by the time at which they began. Of rows of the same name the first that is ok counts, or else the first
/// of an installed method, or else the first. A merged run may be merged again.
///
/// Throws ConfigurationError when there is no run in one of the folders or its run.json lacks something, or
/// they differ in plan, filter, seed or schema version, or a method is there in two versions, or a data set
/// or a rule of the same name is another one; std::runtime_error when two rows of the same name are ok and
/// have different results, which no machine may cause.
MergedRun merge_runs(const std::vector<fs::path>& folders);

}  // namespace hullbench::run
