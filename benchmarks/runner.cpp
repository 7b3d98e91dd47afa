#include "benchmarks/runner.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "adapters/wkb.hpp"
#include "benchmarks/interrupt.hpp"
#include "benchmarks/method_session.hpp"
#include "benchmarks/metrics/metric_table.hpp"
#include "benchmarks/metrics/metrics.hpp"
#include "benchmarks/parallel.hpp"
#include "benchmarks/pictures.hpp"
#include "benchmarks/protocol.hpp"
#include "datasets/datasets.hpp"
#include "datasets/degenerate.hpp"
#include "datasets/random.hpp"
#include "datasets/sha256.hpp"

namespace hullbench {
namespace {

using nlohmann::json;

std::string hash_of(const std::vector<std::uint8_t>& bytes) {
  return sha256_hex({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

/// One run on its way to its row.
struct Entry {
  std::size_t index = 0;  ///< into the planned runs
  MethodSession* session = nullptr;
  RunRecord record;
  std::vector<Repetition> repetitions;
  std::optional<MultiPolygon> result;             ///< of the first run; none while there is none to score
  std::optional<std::int64_t> peak_memory_bytes;  ///< the largest of the untimed runs
  bool measured = false;                          ///< nothing is left to run
  bool settled = false;                           ///< its row is written
};

/// The runs of one case, and what they are run on.
struct CaseWork {
  const PlanCase* plan_case = nullptr;
  PointSet set;
  std::vector<Entry> entries;
  std::optional<CaseScorer> scorer;  ///< once there is something to score
  std::string scorer_fault;          ///< why there is none then
};

/// A batch holds cases for about so many points times runs: 62 of the random polygons, which are worth
/// drawing and scoring in parallel, but one of the largest state shapes, as little is to be lost when the
/// machine stops.
constexpr std::int64_t kBatchWork = 1'000'000;

class Runner {
 public:
  Runner(const Plan& plan, const std::vector<PlannedRun>& runs, const RunnerOptions& options,
         RunDirectory& directory, Progress& progress)
      : plan_(plan),
        runs_(runs),
        options_(options),
        directory_(directory),
        progress_(progress),
        pictures_(directory.path(), runs.size()) {}

  RunResult run(json header) {
    RunResult result;
    if (!header.contains("methods")) header["methods"] = json::array();
    machine_ = header.at("environment").at("machine_id").get<std::string>();
    result.resumed_rows = static_cast<int>(directory_.rows().size());
    try {
      // Before anything can be interrupted, so that the folder is known for what it is.
      directory_.write_header(header);
      start_methods();
      header["methods"] = describe_methods();
      directory_.write_header(header);
      check_parameter_names();
      for (std::size_t begin = 0; begin < runs_.size();) begin = run_batch(begin);
    } catch (const Interrupted&) {
      result.interrupted = true;
    }
    for (const PlannedRun& run : runs_) {
      if (const RunRecord* row = directory_.find_row(run.name))
        count_row(result, row->status, plan_.accepted);
    }
    return result;
  }

 private:
  void start_methods() {
    for (const PlannedRun& run : runs_) {
      const PlanMethod& entry = plan_.methods[run.method_index];
      const std::string& method = entry.method;
      if (sessions_.contains(method)) continue;
      method_order_.push_back(method);
      const WorkerLimits limits = {entry.mem_limit_mib.value_or(plan_.mem_limit_mib), options_.worker_core};
      sessions_[method] = std::make_unique<MethodSession>(options_.find_method(method), limits);
      sessions_[method]->begin_start();
    }
    for (const std::string& method : method_order_) {
      const MethodSession& session = *sessions_[method];
      sessions_[method]->finish_start();
      if (!session.info()) {
        progress_.note("hullbench: " + method + " does not start (" +
                       to_string(session.start_reply().status) + "): " + start_failure(session));
      }
    }
  }

  json describe_methods() const {
    json methods = json::array();
    for (const std::string& method : method_order_) methods.push_back(describe_method(*sessions_.at(method)));
    return methods;
  }

  void check_parameter_names() const {
    for (const PlannedRun& run : runs_) {
      const PlanMethod& method = plan_.methods[run.method_index];
      const auto& info = sessions_.at(method.method)->info();
      if (!info) continue;
      for (const auto& given : method.parameters) {
        const std::string& name = given.first;
        const bool known =
            std::any_of(info->parameters.begin(), info->parameters.end(),
                        [&name = name](const ParameterInfo& parameter) { return parameter.name == name; });
        if (!known) {
          throw ConfigurationError("the plan '" + plan_.name + "' gives " + method.method +
                                   " the parameter '" + name +
                                   "', which it does not have; 'hullbench list' shows what it has");
        }
      }
    }
  }

  /// The end of the runs of the case that begins at `begin`.
  std::size_t end_of_case(std::size_t begin) const {
    std::size_t end = begin;
    while (end < runs_.size() && runs_[end].case_index == runs_[begin].case_index) ++end;
    return end;
  }

  /// The cases from run `begin` on that make a batch.
  std::vector<CaseWork> gather_batch(std::size_t begin) const {
    std::vector<CaseWork> batch;
    std::int64_t work = 0;
    while (begin < runs_.size()) {
      const std::size_t end = end_of_case(begin);
      const PlanCase& plan_case = plan_.expanded_cases[runs_[begin].case_index];
      work += estimated_points(plan_case) * static_cast<std::int64_t>(end - begin) *
              (plan_.warmup + plan_.repetitions);
      if (!batch.empty() && work > kBatchWork) break;
      CaseWork& one = batch.emplace_back();
      one.plan_case = &plan_case;
      one.entries.resize(end - begin);
      for (Entry& entry : one.entries) entry.index = begin++;
    }
    return batch;
  }

  /// Measures the cases of one batch and returns the index of the run behind it.
  std::size_t run_batch(std::size_t begin) {
    throw_if_interrupted();
    progress_.begin(begin);
    std::vector<CaseWork> batch = gather_batch(begin);
    for_each_in_parallel(batch.size(), options_.cores, [&](std::size_t i) { prepare(batch[i]); });
    try {
      for (CaseWork& one : batch) measure(one);
    } catch (const Interrupted&) {
      settle(batch);
      throw;
    }
    settle(batch);
    return batch.back().entries.back().index + 1;
  }

  /// Draws a case's points and chooses its parameters; nothing is asked of a worker, as several cases do this
  /// at the same time.
  void prepare(CaseWork& one) const {
    const PlanCase& plan_case = *one.plan_case;
    one.set = make_point_set(plan_case.dataset, plan_case.holes, static_cast<std::size_t>(plan_case.n),
                             plan_.seed, options_.folders);
    for (Entry& entry : one.entries) {
      const PlanMethod& method = method_of(entry);
      RunRecord& record = entry.record;
      record.name = runs_[entry.index].name;
      record.method = method.method;
      record.dataset = plan_case.dataset;
      record.levels = levels_of(plan_case.dataset);
      if (const std::string base = base_shape(plan_case.dataset); base != plan_case.dataset) {
        record.base_shape = base;
      }
      record.dataset_sha256 = one.set.sha256;
      record.n = static_cast<std::int64_t>(one.set.points.size());
      record.holes = plan_case.holes;
      record.seed = plan_.seed;
      record.protocol = method.protocol;
      record.machine = machine_;
      record.parameters = choose_parameters(
          method, plan_case,
          {one.set.points, one.set.ground_truth_area, plan_case.holes, one.set.ground_truth});
    }
  }

  /// Everything that is timed of a case, one worker at a time.
  void measure(CaseWork& one) {
    for (Entry& entry : one.entries) {
      entry.session = sessions_.at(entry.record.method).get();
      complete(entry);
    }
    if (std::all_of(one.entries.begin(), one.entries.end(),
                    [](const Entry& entry) { return entry.measured; }))
      return;
    const LoadedPoints points = {one.set.sha256, directory_.scratch() / "points.f64", one.set.points.size()};
    write_points_file(points.file, one.set.points);
    for (Entry& entry : one.entries) {
      if (!entry.measured) warm_up(entry, points);
    }
    for (int round = 0; round < most_repetitions(one.entries); ++round) run_round(one.entries, round, points);
    for (Entry& entry : one.entries) {
      // Without a warm-up, one untimed run after the timed ones, which must give the same result.
      if (plan_.warmup == 0 && !entry.measured) attempt_run(entry, points, Watch::kMemory);
      entry.measured = true;
    }
  }

  /// Fills in what the worker's first answer tells, and looks for an earlier start's row and repetitions.
  void complete(Entry& entry) {
    RunRecord& record = entry.record;
    const auto& info = entry.session->info();
    std::optional<std::string> refusal;
    if (info) {
      record.method_version = info->version;
      try {
        record.parameters = complete_parameters(*info, record.parameters);
      } catch (const std::invalid_argument& error) {
        refusal = error.what();
      }
    }
    record.id = run_identity(record);
    const RunRecord* earlier = directory_.find_row(record.name);
    // A row of a method that is not there any more is kept: nothing newer can take its place.
    const bool lost = earlier && !info && earlier->status != Status::kNotInstalled;
    if (earlier && (earlier->id == record.id || lost)) {
      entry.measured = true;
      entry.settled = true;
      progress_.finish(entry.index);
    } else if (refusal) {
      fail(entry, Status::kError, *refusal);
    } else if (!info) {
      fail(entry, entry.session->start_reply().status, start_failure(*entry.session));
    } else {
      entry.repetitions = directory_.repetitions(record.id);
    }
  }

  const PlanMethod& method_of(const Entry& entry) const {
    return plan_.methods[runs_[entry.index].method_index];
  }

  int most_repetitions(const std::vector<Entry>& entries) const {
    int most = 0;
    for (const Entry& entry : entries) most = std::max(most, repetitions_of(plan_, method_of(entry)));
    return most;
  }

  std::chrono::milliseconds timeout_of(const PlanMethod& method) const {
    const double seconds = method.timeout_s.value_or(plan_.timeout_s);
    return std::chrono::milliseconds(std::max<std::int64_t>(1, std::llround(seconds * 1000)));
  }

  static std::string start_failure(const MethodSession& session) {
    const Reply& reply = session.start_reply();
    return reply.remedy.empty() ? reply.detail : reply.detail + "; remedy: " + reply.remedy;
  }

  /// The untimed runs. Repetitions of an earlier start call for one at least: their result was scored, but
  /// the scores are gone.
  void warm_up(Entry& entry, const LoadedPoints& points) {
    const int untimed = std::max(plan_.warmup, entry.repetitions.empty() ? 0 : 1);
    for (int count = 0; count < untimed && !entry.measured; ++count) {
      attempt_run(entry, points, Watch::kMemory);
    }
    const auto differs = [&](const Repetition& earlier) {
      return earlier.output_sha256 != entry.record.output_sha256;
    };
    if (!entry.measured && std::any_of(entry.repetitions.begin(), entry.repetitions.end(), differs)) {
      entry.repetitions.clear();
      fail(entry, Status::kInvalidOutput, "the result is not the one that it gave before the interruption");
    }
  }

  void run_round(std::vector<Entry>& entries, int round, const LoadedPoints& points) {
    std::vector<std::size_t> order(entries.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    // Drawn from the case and the round, so that a run that goes on after an interruption keeps its order.
    Random random(derive_seed(plan_.seed, "order/" + points.key + "/" + std::to_string(round)));
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
    for (const std::size_t which : order) {
      Entry& entry = entries[which];
      if (entry.measured || round >= repetitions_of(plan_, method_of(entry)) ||
          std::cmp_greater(entry.repetitions.size(), round))
        continue;
      const std::optional<Attempt> attempt = attempt_run(entry, points, Watch::kNothing);
      if (!attempt) continue;
      const Repetition repetition = {attempt->time_ns(), attempt->phases_ns, entry.record.output_sha256};
      directory_.append_repetition(entry.record.id, entry.repetitions.size(), repetition);
      entry.repetitions.push_back(repetition);
    }
  }

  /// One run. The first one's result is kept to be scored, and every other one must give it again; without a
  /// value when the run failed, and nothing more is measured of the entry then.
  std::optional<Attempt> attempt_run(Entry& entry, const LoadedPoints& points, Watch watch) {
    progress_.begin(entry.index);
    Attempt attempt = entry.session->run(points, entry.record.parameters, directory_.scratch(),
                                         timeout_of(method_of(entry)), watch);
    entry.peak_memory_bytes = std::max(entry.peak_memory_bytes, attempt.peak_memory_bytes);
    if (attempt.status != Status::kOk) {
      fail(entry, attempt.status, attempt.detail);
      return std::nullopt;
    }
    const std::string hash = hash_of(attempt.wkb);
    if (entry.record.output_sha256.empty()) {
      entry.record.output_sha256 = hash;
      keep_result(entry, attempt);
    }
    if (!entry.measured && entry.record.output_sha256 != hash) {
      fail(entry, Status::kInvalidOutput, "two runs on the same points gave different results");
    }
    if (entry.measured) return std::nullopt;
    progress_.advance(entry.index, attempt.elapsed);
    return attempt;
  }

  static void keep_result(Entry& entry, const Attempt& attempt) {
    try {
      entry.result = from_wkb(attempt.wkb);
    } catch (const std::exception& error) {
      fail(entry, Status::kInvalidOutput, "the result is no polygon: " + printable(error.what(), 200));
    }
  }

  static void fail(Entry& entry, Status status, const std::string& detail) {
    entry.record.status = status;
    entry.record.detail = detail;
    entry.measured = true;
  }

  /// Scores what is measured of a batch and writes its rows.
  void settle(std::vector<CaseWork>& batch) {
    std::vector<CaseWork*> to_score;
    std::vector<std::pair<Entry*, const CaseWork*>> finished;
    for (CaseWork& one : batch) {
      for (Entry& entry : one.entries) {
        if (!entry.measured || entry.settled) continue;
        finished.emplace_back(&entry, &one);
        if (entry.result && (to_score.empty() || to_score.back() != &one)) to_score.push_back(&one);
      }
    }
    for_each_in_parallel(to_score.size(), options_.cores, [&](std::size_t i) { make_scorer(*to_score[i]); });
    for_each_in_parallel(finished.size(), options_.cores,
                         [&](std::size_t i) { score_result(*finished[i].first, *finished[i].second); });
    std::vector<RunRecord> rows;
    rows.reserve(finished.size());
    for (const auto& [entry, one] : finished) rows.push_back(finished_record(*entry));
    // Before the rows: a run that has its row is not measured again, and its picture would be missing.
    for (const auto& [entry, one] : finished) {
      if (entry->result) pictures_.add(entry->record, one->set, *entry->result);
    }
    directory_.append_rows(rows);
    for (const auto& [entry, one] : finished) {
      entry->settled = true;
      const RunRecord& record = entry->record;
      // Of a method that does not start this was said once already.
      if (record.status != Status::kOk && entry->session->info()) {
        progress_.note("hullbench: " + record.name + ": " + to_string(record.status) + ": " + record.detail);
      }
      progress_.finish(entry->index);
    }
  }

  static void make_scorer(CaseWork& one) {
    if (one.set.ground_truth.empty()) return;  // there is nothing to score against
    try {
      one.scorer.emplace(one.set.points, one.set.ground_truth);
    } catch (const std::exception& error) {
      one.scorer_fault = error.what();
    }
  }

  static void score_result(Entry& entry, const CaseWork& one) {
    if (!entry.result) return;
    RunRecord& record = entry.record;
    std::string fault;
    Status status = Status::kOk;
    try {
      if (!one.scorer_fault.empty()) throw std::runtime_error(one.scorer_fault);
      Metrics metrics =
          one.scorer ? one.scorer->score(*entry.result) : describe(one.set.points, *entry.result);
      metrics.peak_memory_bytes = entry.peak_memory_bytes;
      record.metrics = metrics_to_json(metrics);
      // The run's times stay all the same: how fast a method gives a wrong answer is part of the record.
      if (!metrics.area.valid) {
        status = Status::kInvalidOutput;
        fault = "the result is an invalid polygon: " + metrics.area.invalid_reason;
      }
    } catch (const std::runtime_error& error) {
      status = Status::kError;
      fault = std::string("the result cannot be scored: ") + error.what();
    }
    if (record.status == Status::kOk) {
      record.status = status;
      record.detail = fault;
    }
  }

  static RunRecord finished_record(Entry& entry) {
    RunRecord& record = entry.record;
    const double floor = kFloorNsPerPoint * static_cast<double>(record.n);
    for (const Repetition& repetition : entry.repetitions) {
      record.time_ns.push_back(repetition.time_ns);
      record.phases_ns.push_back(repetition.phases_ns);
      if (static_cast<double>(repetition.time_ns) < floor) record.flags = {kFasterThanFloor};
    }
    return record;
  }

  const Plan& plan_;
  const std::vector<PlannedRun>& runs_;
  const RunnerOptions& options_;
  RunDirectory& directory_;
  Progress& progress_;
  PictureBook pictures_;
  std::string machine_;                    ///< this one's id, for the rows
  std::vector<std::string> method_order_;  ///< as in the plan
  std::map<std::string, std::unique_ptr<MethodSession>> sessions_;
};

}  // namespace

RunResult run_plan(const Plan& plan, const std::vector<PlannedRun>& runs, const json& header,
                   const RunnerOptions& options, RunDirectory& directory, Progress& progress) {
  return Runner(plan, runs, options, directory, progress).run(header);
}

std::int64_t estimated_points(const PlanCase& plan_case) {
  constexpr std::int64_t kPointsOfAFloor = 80'000;
  if (plan_case.n > 0) return plan_case.n;
  for (const DegenerateInput& input : degenerate_inputs()) {
    // Of no point at all there is still the way to the worker and back.
    if (input.name == plan_case.dataset)
      return std::max<std::int64_t>(100, static_cast<std::int64_t>(input.points.size()));
  }
  return kPointsOfAFloor;
}

std::vector<ProgressRun> progress_runs(const Plan& plan, const std::vector<PlannedRun>& runs) {
  std::vector<ProgressRun> result;
  result.reserve(runs.size());
  for (const PlannedRun& run : runs) {
    const PlanMethod& method = plan.methods[run.method_index];
    result.push_back({run.name, method.method, estimated_points(plan.expanded_cases[run.case_index]),
                      plan.warmup + repetitions_of(plan, method)});
  }
  return result;
}

void count_row(RunResult& result, Status status, const std::vector<std::string>& accepted) {
  const bool good = status != Status::kOk &&
                    std::find(accepted.begin(), accepted.end(), to_string(status)) != accepted.end();
  ++(good ? result.accepted : result.counts[status]);
}

int exit_code(const RunResult& result) {
  if (result.interrupted) return 130;
  int measured = result.accepted;
  for (const auto& [status, count] : result.counts) {
    if (status == Status::kNotInstalled || status == Status::kUnsupported || count == 0) continue;
    if (status != Status::kOk) return 4;
    measured += count;
  }
  return measured > 0 ? 0 : 6;
}

}  // namespace hullbench
