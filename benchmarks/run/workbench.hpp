// The one place where a method is run on a case and its answer becomes a row. Who times runs adds the clock
// (runner.hpp), who searches chooses the next parameters (tune/tuner.hpp).
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "adapters/adapter.hpp"
#include "benchmarks/metrics/metrics.hpp"
#include "benchmarks/record/record.hpp"
#include "benchmarks/run/drawn_case.hpp"
#include "benchmarks/run/progress.hpp"
#include "benchmarks/worker/method.hpp"
#include "benchmarks/worker/method_session.hpp"

namespace hullbench::run {

/// A method with one parameter set on one case, on its way to its row: begin(), then Workbench::attempt()
/// once or more often, then a score.
struct MethodRun {
  MethodRun(std::shared_ptr<const DrawnCase> drawn_case, const std::string& method, Parameters parameters);

  /// Fills in the version, the defaults of `info`'s parameters that are not given, and the id. Without info
  /// (the method does not start), without points, and with a parameter that the method does not take, the run
  /// is over, and its status says why; one that is over already stays so.
  void begin(worker::MethodSession& its_session, const std::optional<MethodInfo>& info, double timeout_s);

  /// Nothing more is run, for this reason.
  void fail(record::Status status, const std::string& detail);

  /// Fills in all metrics where there is a result. Safe beside others of the same case.
  void score();
  /// The same with `l2` alone; needs a ground truth.
  void score_l2();

  std::shared_ptr<const DrawnCase> drawn;
  record::RunRecord record;
  worker::MethodSession* session = nullptr;
  std::chrono::milliseconds timeout{0};
  std::optional<MultiPolygon> result;             ///< of the first attempt; none while there is none to score
  std::optional<std::int64_t> peak_memory_bytes;  ///< the largest of the attempts that were watched for it
  std::vector<metrics::PartResults> draws = {};   ///< what parts of the points gave, where the plan asks
  bool over = false;                              ///< nothing is left to run
};

/// What a method that compiles while it runs is warmed up for: its process alone, where times hardly matter,
/// or each row.
enum class WarmUpFor { kProcess, kEachRow };

/// The workers of some methods, and the points that they have. Of one thread, as workers end with the thread
/// that started them.
class Workbench {
 public:
  /// Files are put into the folder `scratch`, which is made where it is not there.
  explicit Workbench(fs::path scratch);
  /// Ends all workers at the same time.
  ~Workbench();
  Workbench(const Workbench&) = delete;
  Workbench& operator=(const Workbench&) = delete;

  /// Its worker is not started yet.
  void add(worker::Method method, const worker::WorkerLimits& limits);
  /// Null when it was not added.
  worker::MethodSession* find(const std::string& method) const;
  /// As they were added.
  const std::vector<std::unique_ptr<worker::MethodSession>>& sessions() const { return sessions_; }

  /// Starts all workers at the same time, and says of those that do not start why. Without it each starts
  /// with its first attempt.
  void start(Progress& progress);

  /// Runs a method that compiles while it runs until it is steady, unless it is; the row says how long the
  /// first call of the process took, if that was its own. For who times.
  void warm_up(MethodRun& run, WarmUpFor wanted);

  /// Runs it once. The first result is kept to be scored, and every other one must be the same, byte for
  /// byte. When that is not so, and when the method fails, the run is over. Throws Interrupted.
  worker::Attempt attempt(MethodRun& run, worker::Watch watch = worker::Watch::kNothing);

 private:
  const worker::LoadedPoints& points_of(const MethodRun& run);

  fs::path scratch_;
  std::vector<std::unique_ptr<worker::MethodSession>> sessions_;
  std::optional<worker::LoadedPoints> points_;  ///< of the last attempt's case; none before the first
};

}  // namespace hullbench::run
