// What the runs of a report measured, looked up by method, protocol and case: the common ground of tables and
// claims.
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "benchmarks/record/record.hpp"

namespace hullbench::report {

/// What a method was run on.
struct Case {
  std::string dataset;
  bool holes = false;
  std::int64_t n = 0;
  // clang-tidy 14 sees the 0 with which a defaulted comparison is made.
  auto operator<=>(const Case&) const = default;  // NOLINT(modernize-use-nullptr)
};

/// A method under one protocol: a line, or a column, of a table. Protocols never share one.
struct Line {
  std::string method;
  std::string protocol;
  auto operator<=>(const Line&) const = default;  // NOLINT(modernize-use-nullptr): as above
};

/// The runs of one line and case.
using Runs = std::vector<const record::RunRecord*>;

/// Which part of the work a time covers.
enum class Boundary {
  kEqualWork,  ///< points in memory to a valid multipolygon in memory: run + extract
  kPaper       ///< what the paper timed: run
};

/// Whether the run gave a result that is believed: status ok and a valid multipolygon. Whether it has times
/// is another question (see Measurements).
bool is_measured(const record::RunRecord& run);

/// Whether the run gave a result that is not a valid multipolygon.
bool is_invalid(const record::RunRecord& run);

/// Whether none of `runs` was tried: there is none, or the method is not installed.
bool is_missing(const Runs& runs);

/// The first of `runs` that gave no result to be believed; null when there is none.
const record::RunRecord* first_failure(const Runs& runs);

/// Whether the result's l2 is above that of the convex hull of its points, which every method should beat. Of
/// the hull itself it is the same but for rounding.
bool is_worse_than_convex_hull(const record::RunRecord& run);

/// Nanoseconds of every repetition.
std::vector<std::int64_t> times(const record::RunRecord& run, Boundary boundary);

/// Nanoseconds of a step in every repetition: the sum of its `parts`, whichever phase they belong to
/// ("run.polygon" and "extract.polygon" for the part "polygon"). Empty when a repetition has none of them.
std::vector<std::int64_t> step_times(const record::RunRecord& run, const std::vector<std::string>& parts);

/// A number among the metrics; empty when it is absent or null.
std::optional<double> metric(const record::RunRecord& run, const std::string& name);

/// That number of each of `runs` that has it.
std::vector<double> all_values(const Runs& runs, const std::string& name);

/// The machines on which the rows of `report`, or those of them that have times, were measured: as the row
/// says, or else the report's environment. A row of which neither says it has none.
std::set<std::string> machines_of(const json& report, bool with_times = true);

/// The builds of the program with which `report` was measured, by the SHA-256 of the binary: those of the
/// runs that were merged into it, or else its own, if it says one.
std::set<std::string> builds_of(const json& report);

/// One sentence: that times are not shown because they are of several machines, or of several builds. Empty
/// when they are of one machine and one build at most.
std::string no_times_sentence(const std::set<std::string>& machines, const std::set<std::string>& builds);

/// The runs of a report by method, protocol and case. Runs that share all three (other seeds or parameters)
/// are kept in their order. When they are of several machines or builds of the program they have no times
/// here (the report keeps them).
class Measurements {
 public:
  /// `report` needs only its member `runs`. Throws what from_json of a record throws.
  explicit Measurements(const json& report);

  const std::vector<record::RunRecord>& runs() const { return runs_; }

  /// Why there are no times: one sentence when the runs were measured on several machines or with several
  /// builds, whose times no table or claim may mix. Empty when there are times.
  const std::string& why_no_times() const { return why_no_times_; }
  bool has_times() const { return why_no_times_.empty(); }

  /// The runs of that line and case; none when there are none.
  Runs find(const Line& line, const Case& which) const;

  /// All cases that occur, ordered by data set (as they first occur), without holes before with holes, then
  /// n.
  const std::vector<Case>& cases() const { return cases_; }

 private:
  std::vector<record::RunRecord> runs_;
  std::string why_no_times_;
  std::map<std::pair<Line, Case>, std::vector<std::size_t>> index_;  ///< positions in runs_
  std::vector<Case> cases_;
};

}  // namespace hullbench::report
