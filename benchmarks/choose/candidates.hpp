// What every method makes of somebody's own points, whose true shape nobody knows, and how far the results
// agree.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "adapters/adapter.hpp"
#include "benchmarks/base/cores.hpp"
#include "benchmarks/plan/plan.hpp"
#include "benchmarks/record/record.hpp"
#include "benchmarks/run/method_catalog.hpp"
#include "benchmarks/run/progress.hpp"
#include "benchmarks/run/runner.hpp"

namespace hullbench::choose {

/// Which methods are asked, and how.
struct Question {
  plan::Plan plan;
  std::vector<std::string> absent;  ///< sentences: methods that could not be asked, and why
};

/// A line for a shell, and what it does.
struct PasteCommand {
  std::string purpose;
  std::string line;
};

/// One row of the plan on the points.
struct Candidate {
  std::string label;                   ///< "CGAL alpha shape (auto)"
  std::string note;                    ///< of the plan; may be empty
  Parameters given;                    ///< those of its parameters that the plan gives
  std::size_t points = 0;              ///< how many it got
  record::RunRecord record;            ///< as of points without a truth
  std::optional<MultiPolygon> result;  ///< none: the method gave none; of a failure it may be an invalid one
  /// IoU with the result of each candidate, as intersection_over_union; none without a valid result of both.
  std::vector<std::optional<double>> iou = {};
  /// Mean IoU with the other results that differ from it: those with the same polygons count once, so that
  /// nobody is ahead by having copies. None where there is no other result.
  std::optional<double> agreement = {};
  std::vector<PasteCommand> commands = {};

  /// Whether there is a valid result, be it without polygons.
  bool succeeded() const { return record.status == record::Status::kOk && result; }
  /// Whether the candidate at `other` has the same polygons. Those from other first vertices differ in the
  /// last digits of their areas, of which there are 15.
  bool is_same_as(std::size_t other) const { return iou[other] && *iou[other] > 1 - 1e-9; }
};

struct Candidates {
  /// Those that agree most with the others first, failures last; among equals by label.
  std::vector<Candidate> all;
  std::vector<std::string> absent;  ///< as Question::absent, with the methods that are not installed
  run::RunResult outcome;           ///< never interrupted
};

/// The rows of the plan `real` in which nobody knows better than the points: the protocols `default` and
/// `auto`. Those of the manifests that it does not name are added. `only`: names of methods or
/// METHOD/PROTOCOL; empty: all. Throws ConfigurationError for a name that fits no row.
Question ask(const run::MethodCatalog& catalog, const std::vector<std::string>& only);

/// Runs them on `points` (at least 3, finite) by the engine of `hullbench run`, in a folder that goes again.
/// Where these are a sample of `all`, the methods that are fast enough then run on all: those whose time, if
/// it grows with n log n, stays below the plan's limit. They keep the stability that they have on the sample,
/// and its whole result if they fail on all. Throws Interrupted, std::invalid_argument for coordinates that
/// no rule takes, and as run_plan().
Candidates compare(const Question& question, std::span<const Point> points, std::span<const Point> all,
                   const run::MethodCatalog& catalog, const Cores& cores,
                   run::Progress (*make_progress)(std::vector<run::ProgressSection>));

}  // namespace hullbench::choose
