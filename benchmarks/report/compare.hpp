// Two measurements side by side: which runs they share, and which of those became faster or slower.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "benchmarks/record/record.hpp"
#include "benchmarks/statistics/bootstrap.hpp"
#include "benchmarks/statistics/rank_test.hpp"

namespace hullbench::report {

/// What became of a run from A to B.
enum class Change {
  kFaster,     ///< its times differ, by Holm's correction over all pairs at 5 %
  kSlower,     ///< likewise
  kNotApart,   ///< no difference was shown, which does not say that there is none
  kNotJudged,  ///< too few repetitions for any difference to be shown
  kNowFails,   ///< no result that is believed in B
  kNowWorks,   ///< none in A
  kFailsInBoth
};

/// "faster", "slower", "not told apart", "not judged", "now fails", "now works", "fails in both".
std::string to_string(Change change);

/// A run that both have.
struct RunPair {
  record::RunRecord a;
  record::RunRecord b;
  std::optional<statistics::RatioOfTimes> time;  ///< of equal work, B over A; none when one of them failed
  double adjusted_p_value = 1;                   ///< of `time`, by Holm over all pairs that can be judged
  Change change = Change::kNotJudged;

  /// By their hashes, of which kept records have the first digits (results/thin_records.py).
  bool same_points() const {
    return a.dataset_sha256.starts_with(b.dataset_sha256) || b.dataset_sha256.starts_with(a.dataset_sha256);
  }
  bool same_parameters() const { return a.parameters == b.parameters; }
  bool same_version() const { return a.method_version == b.method_version; }
};

/// A method's pairs together.
struct MethodChange {
  std::string method;
  std::string protocol;
  std::size_t pairs = 0;  ///< with a ratio of times
  /// The median of their ratios, B over A; none without a pair.
  std::optional<double> ratio;
  /// Of that median, clustered by shape: a data set (each member of a family) with or without holes. None of
  /// a single shape.
  std::optional<statistics::Interval> interval;
  std::size_t faster = 0;
  std::size_t slower = 0;
};

/// A and B, each one report or those of a suite.
struct RunsCompared {
  std::vector<RunPair> pairs;         ///< in the order of A
  std::vector<MethodChange> methods;  ///< in the order in which they first occur
  std::size_t judged = 0;             ///< pairs whose times were tested
  std::vector<std::string> only_a;    ///< names
  std::vector<std::string> only_b;
};

/// Pairs runs by name (method, data set, points, holes, protocol): those of plans of the same name first, the
/// rest among each other, and of several runs of one name the first with the first. Of each report only
/// `runs` is needed, and `plan` for its name. Throws what from_json of a record throws.
RunsCompared compare_runs(const std::vector<json>& a, const std::vector<json>& b);

}  // namespace hullbench::report
