// A method and the worker that runs it: started once, loaded once a case, started again after it died.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "adapters/adapter.hpp"
#include "benchmarks/base/names.hpp"
#include "benchmarks/record/record.hpp"
#include "benchmarks/worker/method.hpp"
#include "benchmarks/worker/worker_process.hpp"

namespace hullbench::worker {

/// How long a worker may take to say who it is; a method may have to start a server.
inline constexpr std::chrono::seconds kStartTimeout{60};

/// When a method that compiles while it runs is warm: after so many `runs` at least, when the best of the
/// last `steady` ones is less than kSteadyGain below the best of as many before them. It gets no more than
/// `time` for that. Compilers count calls and have several stages: Java's times stay the same for some runs,
/// and then halve.
struct WarmUp {
  std::size_t runs;
  std::size_t steady;
  std::chrono::seconds time;
};
inline constexpr double kSteadyGain = 0.03;
/// Of a new process.
inline constexpr WarmUp kWarmUpOfProcess{100, 25, std::chrono::seconds(8)};
/// Of a process for other points or parameters: other sizes and switches run code that is not compiled yet,
/// or was compiled for what came before.
inline constexpr WarmUp kWarmUpOfCase{20, 5, std::chrono::seconds(1)};

/// The largest result that is read, in bytes: far above any polygon of the points that fit the memory limit.
inline constexpr std::size_t kMaxResultBytes = std::size_t{1} << 30;

/// The points a worker is to have before it runs.
struct LoadedPoints {
  std::string key;  ///< differs for different points
  fs::path file;    ///< raw little-endian float64, x before y
  std::size_t n = 0;
};

/// One run of a method, or why there was none.
struct Attempt {
  record::Status status = record::Status::kOk;
  std::string detail;  ///< empty when ok
  /// As the worker tells them, with "load": of the load that the run used; and "outside": `elapsed`.
  record::PhaseTimes phases_ns;
  std::vector<std::uint8_t> wkb;        ///< the result
  std::chrono::nanoseconds elapsed{0};  ///< as seen from outside
  /// Of the worker's process during the run; none unless it was asked for, when the method works in a server
  /// and when the system does not tell.
  std::optional<std::int64_t> peak_memory_bytes;

  /// Headline time: run + extract.
  std::int64_t time_ns() const;
};

/// What a run is watched for besides its result. Looking at memory is for runs that nobody times.
enum class Watch { kNothing, kMemory };

class MethodSession {
 public:
  /// Nothing is started yet.
  MethodSession(Method method, const WorkerLimits& limits);
  /// Asks the worker to end, so that it can stop what it started, and kills it when it does not.
  ~MethodSession();

  /// Starts the worker and asks who it is, without waiting, so that several methods can start at the same
  /// time.
  void begin_start();
  /// Waits for the answer. Throws Interrupted.
  void finish_start();

  const Method& method() const { return method_; }
  /// Who the method is; empty when it could not be started.
  const std::optional<MethodInfo>& info() const { return info_; }
  /// Why it could not be started: status, detail and remedy; status ok when it could.
  const Reply& start_reply() const { return start_reply_; }
  /// Why, in words, with the remedy.
  std::string start_failure() const;
  /// The worker's process; not positive while there is none.
  pid_t pid() const { return worker_ ? worker_->pid() : -1; }

  /// Runs the method once on `points` with a result in a new file in `scratch`, which is removed again.
  /// Starts and loads a worker first where needed. Throws Interrupted.
  Attempt run(const LoadedPoints& points, const Parameters& parameters, const fs::path& scratch,
              std::chrono::milliseconds timeout, Watch watch = Watch::kNothing);

  /// Whether the method compiles while it runs (Method::jit) and its process, of now or to come, was not
  /// warmed up.
  bool is_cold() const { return method_.jit && (warmed_up_for_.empty() || !worker_ || !worker_->alive()); }
  /// The same for these points and parameters.
  bool is_cold(const LoadedPoints& points, const Parameters& parameters) const;
  /// Whether its process, of now or to come, has run already, in vain or not.
  bool has_run() const { return runs_of_process_ > 0 && worker_ && worker_->alive(); }
  /// Runs the method until it gets no faster: by kWarmUpOfProcess if is_cold(), else by kWarmUpOfCase.
  /// Returns the first run, or the first one that failed, which ends it. Throws Interrupted.
  Attempt warm_up(const LoadedPoints& points, const Parameters& parameters, const fs::path& scratch,
                  std::chrono::milliseconds timeout);

  /// Asks the worker to end, without waiting.
  void begin_quit();
  /// Asks the worker to end, waits at most `patience` and kills it then. Whether it ended by itself; the next
  /// run starts another one.
  bool quit(std::chrono::milliseconds patience);

 private:
  Reply load(const LoadedPoints& points, std::chrono::milliseconds timeout);
  Attempt read_result(const Reply& reply, const std::string& nonce, const fs::path& result);

  Method method_;
  WorkerLimits limits_;
  std::unique_ptr<WorkerProcess> worker_;
  std::optional<MethodInfo> info_;
  Reply start_reply_;
  std::string loaded_key_;  ///< of the points the worker has; empty: none
  record::PhaseTimes load_phases_;
  std::uint64_t run_count_ = 0;
  std::uint64_t runs_of_process_ = 0;    ///< of the one that runs
  std::set<std::string> warmed_up_for_;  ///< points and parameters, as the process that runs had them
};

/// Writes `points` into a file in `folder`, which has the points of one case at a time. Throws
/// std::runtime_error naming the file when it cannot be written.
LoadedPoints write_points(std::string key, std::span<const Point> points, const fs::path& folder);

/// A method as `list` and run.json show it: method_to_json with `installed`, `detail` (why not) and `remedy`.
/// What is not known of a method that does not start is empty.
json describe_method(const MethodSession& session);

}  // namespace hullbench::worker
