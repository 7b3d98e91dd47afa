// What `hullbench compare` says.
#pragma once

#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "benchmarks/report/compare.hpp"
#include "benchmarks/table/writers.hpp"

namespace hullbench::report {

/// One side of a comparison: what it is called, and its reports (see compare_runs), which may also have
/// `environment`, `tool`, `created` and `methods`.
struct ComparedSide {
  std::string name;
  std::vector<json> reports;
};

/// Above so many pairs the document's table of pairs shows only those that changed.
inline constexpr std::size_t kMostPairsShown = 200;

/// A line a method, then a line a pair (up to kMostPairsShown, or only those that changed unless
/// `every_pair`), and what must be known to read them: other machines, builds, versions, points or
/// parameters; which runs only one side has.
table::Document comparison_document(const RunsCompared& compared, const ComparedSide& a,
                                    const ComparedSide& b, bool every_pair);

/// The same as JSON: `a`, `b` (names), `methods`, `pairs` (all of them, with times in nanoseconds, ratios,
/// the p-value of the pair and the one by Holm), `only_a`, `only_b` and `notes`. null for what is not
/// defined.
nlohmann::ordered_json comparison_json(const RunsCompared& compared, const ComparedSide& a,
                                       const ComparedSide& b);

}  // namespace hullbench::report
