// A stored run with scores worked out anew from its kept polygons, as when a metric is added; no method runs.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "benchmarks/record/record.hpp"
#include "datasets/datasets.hpp"

namespace hullbench::run {

/// The metrics that only running a method tells, and its polygons do not.
inline constexpr std::array kOfTheRun = {"peak_memory_bytes", "agreement_halves", "agreement_subsamples"};

struct Rescored {
  json header;                          ///< run.json, as it was
  std::vector<record::RunRecord> rows;  ///< all of the run, in its order
  std::size_t scored = 0;               ///< rows with new scores
  std::size_t without_polygons = 0;  ///< rows with a result that was not kept: their scores are the old ones
};

/// The run in `folder`. Every row whose polygons were kept (record/kept_polygons.hpp) gets all metrics of
/// this program and the status and flags that follow from them; times stay, and so does what only running
/// tells: memory, and the stability on parts of the points. Works on `cores` as for_each_in_parallel does.
///
/// Throws ConfigurationError when there is no run, or points cannot be drawn as they were (another version of
/// a data set, a package that is missing), and std::runtime_error when polygons are not those of their row.
Rescored rescore(const fs::path& folder, const std::vector<int>& cores, const DataFolders& folders);

}  // namespace hullbench::run
