// Measures a plan: every method on every case, interleaved, each in its own worker, each result scored; a row
// for every run, whatever happens.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/base/exit_code.hpp"
#include "benchmarks/base/names.hpp"
#include "benchmarks/plan/plan.hpp"
#include "benchmarks/record/record.hpp"
#include "benchmarks/run/canary.hpp"
#include "benchmarks/run/progress.hpp"
#include "benchmarks/run/run_directory.hpp"
#include "benchmarks/worker/method.hpp"
#include "datasets/datasets.hpp"

namespace hullbench::run {

struct RunnerOptions {
  worker::MethodFinder find_method;
  std::optional<int> worker_core;  ///< the one core that the workers run on; none: any
  /// Where samples are drawn and results scored, which nobody times: cores as in for_each_in_parallel.
  std::vector<int> cores = {};
  DataFolders folders = {};
  MachineWatch* machine = nullptr;  ///< asked after every round; none: rows have no canaries
  bool keep_polygons = false;       ///< whether results stay in the run's folder (record/kept_polygons.hpp)
  /// Told of every row that is written, with the result where the method gave one, be it invalid.
  std::function<void(const record::RunRecord&, const std::optional<MultiPolygon>&)> on_row = {};
};

struct RunResult {
  bool interrupted = false;
  /// Of the rows of this plan that are there now, those of earlier starts too, without the accepted ones.
  std::map<record::Status, int> counts;
  int accepted = 0;  ///< rows that are not ok but have a status that the plan accepts
};

/// Measures what `pass` (1 to Plan::passes) has of `runs` of `plan` into `directory`. `header` is run.json
/// without its methods, which are added. Pass 1 also looks at what an earlier start left, so that a later
/// pass can trust the rows: to be called for every pass from 1 on in its order.
///
/// Cases are taken in batches of bounded work: their points are drawn on all cores, then they are measured
/// one after the other with nothing else running, then the results are scored on all cores and the rows
/// written. Case by case, each method's worker loads the points, does its untimed runs and then takes its
/// turn in every round of repetitions, in an order drawn from the plan's seed. Only one worker works at a
/// time. The first result is scored, and every other run must give the same bytes, in later passes too. Rows
/// and repetitions that are there already are not measured again, unless they belong to another version of
/// the method. Every pass has new workers, and writes the rows again with all repetitions so far. A method
/// whose run takes 2 s or more has no untimed runs in later passes. A row that is not ok stays as it is, and
/// a case without anything left to do in the pass is left out.
///
/// After every round the machine's canaries are looked at. A round that they do not speak well of is measured
/// again (MachineWatch::wants_again); the last time counts, and the row is flagged. The repetitions of a
/// round are kept together, when it is over. A method that compiles while it runs (Method::jit) is warmed up
/// when its worker is new and, more briefly, for every other row, unless the plan's warmup is 0. The row of
/// the case that it was new for says how long the first call took.
///
/// Points that cannot be made, and parameters that cannot be chosen from them, are rows with the status
/// error.
///
/// Throws ConfigurationError when a method that is installed does not have a parameter that the plan gives
/// it, and std::runtime_error when something cannot be written. An interruption is a result, not an
/// exception.
RunResult run_plan(const plan::Plan& plan, const std::vector<plan::PlannedRun>& runs, const json& header,
                   const RunnerOptions& options, RunDirectory& directory, Progress& progress, int pass = 1);

/// Whether `pass` has repetitions of one of `runs`.
bool has_repetitions(const plan::Plan& plan, const std::vector<plan::PlannedRun>& runs, int pass);

/// How many of `runs` have a row with nothing left to measure in any pass, as far as the rows themselves
/// tell.
std::size_t count_finished(const plan::Plan& plan, const std::vector<plan::PlannedRun>& runs,
                           const RunDirectory& directory);

/// The case's number of points, for estimates of work only: a data set's own points are not counted before
/// they are read.
std::int64_t estimated_points(const plan::PlanCase& plan_case);

/// What `progress` needs to know of `runs` in `pass`.
std::vector<ProgressRun> progress_runs(const plan::Plan& plan, const std::vector<plan::PlannedRun>& runs,
                                       int pass = 1);

/// Counts a row with that status of a plan that accepts `accepted` (Plan::accepted).
void count_row(RunResult& result, record::Status status, const std::vector<std::string>& accepted);

/// kExitOk: all rows are ok, accepted, not installed or unsupported; kExitFailures: a row is a failure;
/// kExitNothing: no row is ok or accepted and none is a failure; kExitInterrupted.
ExitCode exit_code(const RunResult& result);

}  // namespace hullbench::run
