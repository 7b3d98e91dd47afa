// Who is the most accurate over many shapes and ways to sample them: medians with intervals, and performance
// profiles.
#pragma once

#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "benchmarks/statistics/bootstrap.hpp"

namespace hullbench::league {

/// What a failure counts as: an error of so much, or a skill of so much below zero.
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A median over cases, weighted (tune/strata.hpp), and how well it is known.
struct MedianScore {
  std::size_t cases = 0;  ///< that it is of
  double median = 0;  ///< infinite where the middle is a failure: to +infinity or, of a skill, to -infinity
  std::optional<statistics::Interval> interval;  ///< by base shape (weighted.hpp); an end may be infinite
};

/// A mean over cases, weighted likewise, and how well it is known.
struct MeanScore {
  double mean = 0;
  std::optional<statistics::Interval> interval;  ///< by base shape (weighted.hpp)
};

/// An entry's l2 on the cases of one kind, or of one way to sample.
struct PartScore {
  std::size_t cases = 0;
  std::size_t failures = 0;
  double l2_median = 0;  ///< weighted; infinite where the middle is a failure
};

/// A method under one protocol.
struct LeagueEntry {
  std::string method;
  std::string protocol;
  std::size_t cases = 0;     ///< whose errors count
  std::size_t failures = 0;  ///< of these without a valid result; infinitely bad in every median below
  std::map<std::string, std::size_t> failures_by_status;
  /// Cases without a ground truth or of a plan that accepts failures (degenerate input), and those of them
  /// that did not end in a way that the plan accepts.
  std::size_t unscored_cases = 0;
  std::size_t unscored_failures = 0;
  std::optional<MedianScore> l2;  ///< of all cases
  /// Of those whose ground truth the method can have: no holes for one without holes, one part for one of
  /// single polygons.
  std::optional<MedianScore> l2_where_able;
  std::map<std::string, PartScore> kinds;     ///< by kind of shape (shape_kinds in tune/strata.hpp)
  std::map<std::string, PartScore> samplers;  ///< by way to sample (sampler_of in tune/strata.hpp)
  std::optional<MedianScore> skill;           ///< of the cases on which it is defined
  std::optional<MedianScore> hole_f1;         ///< of the cases whose ground truth has holes; a failure has 0
  /// The same cases' mean: most cases have 0 or 1, of which a median says little.
  std::optional<MeanScore> hole_f1_mean;
  /// l2 minus the same method's under the protocol `oracle`, of the cases on which that has a result; none
  /// where it was not measured.
  std::optional<MedianScore> regret;
};

/// A performance profile (Dolan and More, Benchmarking Optimization Software with Performance Profiles,
/// 2002): on which share of the cases, weighted, an entry's l2 is at most tau times the smallest one of its
/// group.
struct LeagueProfile {
  /// Who knows as much, of record::protocol_groups().
  std::string group;
  std::size_t cases = 0;  ///< that all of its curves have, and on which one has a result
  /// Method and protocol of those with less than half as many cases as another one of the group: only few
  /// cases would be left to compare the others on.
  std::vector<std::pair<std::string, std::string>> left_out;
  struct Curve {
    std::string method;
    std::string protocol;
    std::vector<double> shares;  ///< at each of league_taus(); a failure is in none
  };
  std::vector<Curve> curves;
};

/// The taus of a profile: from 1, where the best one is, to 10.
const std::vector<double>& league_taus();

/// One entry on one case whose errors count: what everything above is made of.
struct LeagueResult {
  std::string method;
  std::string protocol;
  std::string task;  ///< the case without its seed: "ca~noise:0.5/n:2000/holes:1"
  std::string seed;
  std::size_t points = 0;
  std::string status;
  double l2 = 0;                  ///< infinite: a failure
  std::optional<double> seconds;  ///< median of equal work; none of a failure and of rows without times
  std::string shape;              ///< base shape
  std::string kind;
  std::string sampler;
  double weight = 0;  ///< of the case, as in the medians
};

/// Some of the league's cases.
struct LeaguePart {
  std::string name;
  std::size_t cases = 0;
  bool seen = true;  ///< of a way to sample: training has it
};

struct League {
  bool test_only = true;   ///< on the cases of test shapes only (benchmarks/tune/split.hpp)
  std::size_t shapes = 0;  ///< base shapes that the cases are of
  std::size_t cases = 0;   ///< whose errors count
  /// That there are, in the order of shape_kinds(), and in that of sampler_split() with those that it does
  /// not know behind and "several" last.
  std::vector<LeaguePart> kinds;
  std::vector<LeaguePart> samplers;
  /// By protocol in the order of the tables; in each those with less than half of the cases of another one
  /// last, as their medians are of other cases; by l2.
  std::vector<LeagueEntry> entries;
  std::vector<LeagueProfile> profiles;
  std::vector<LeagueResult> results;       ///< by method, protocol, case
  std::vector<std::string> not_installed;  ///< methods of which there is no row but that
};

/// The league of the runs in `reports` (as make_report gives them), which may be of several plans. Of a run
/// that several reports have, the first counts. With `test_only` only cases on the test side of the split:
/// what was fitted or chosen on training shapes is judged on others. Cases of plans that accept failures
/// count in any case. Throws std::runtime_error when no row is left.
League make_league(const std::vector<json>& reports, bool test_only);

}  // namespace hullbench::league
