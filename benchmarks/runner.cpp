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
#include "benchmarks/metrics.hpp"
#include "benchmarks/protocol.hpp"
#include "datasets/datasets.hpp"
#include "datasets/random.hpp"
#include "datasets/sha256.hpp"

namespace hullbench {
namespace {

using nlohmann::json;

json optional_to_json(const std::optional<double>& value) {
  return value ? json(*value) : json(nullptr);
}

json metrics_to_json(const Metrics& metrics) {
  return {{"valid", metrics.valid},
          {"invalid_reason", metrics.invalid_reason},
          {"area", metrics.area},
          {"ground_truth_area", metrics.ground_truth_area},
          {"symmetric_difference_area", optional_to_json(metrics.symmetric_difference_area)},
          {"l2", optional_to_json(metrics.l2)},
          {"l2_paper", optional_to_json(metrics.l2_paper)},
          {"iou", optional_to_json(metrics.iou)},
          {"polygons", metrics.polygons},
          {"holes", metrics.holes},
          {"vertices", metrics.vertices}};
}

std::string hash_of(const std::vector<std::uint8_t>& bytes) {
  return sha256_hex({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

/// One run on its way to its row.
struct Entry {
  std::size_t index = 0;  ///< into the planned runs
  MethodSession* session = nullptr;
  RunRecord record;
  std::vector<Repetition> repetitions;
  bool done = false;
};

class Runner {
 public:
  Runner(const Plan& plan, const std::vector<PlannedRun>& runs, const RunnerOptions& options,
         RunDirectory& directory, Progress& progress)
      : plan_(plan),
        runs_(runs),
        options_(options),
        directory_(directory),
        progress_(progress),
        timeout_(std::max<std::int64_t>(1, std::llround(plan.timeout_s * 1000))) {}

  RunResult run(json header) {
    RunResult result;
    if (!header.contains("methods")) header["methods"] = json::array();
    result.resumed_rows = static_cast<int>(directory_.rows().size());
    try {
      // Before anything can be interrupted, so that the folder is known for what it is.
      directory_.write_header(header);
      start_methods();
      header["methods"] = describe_methods();
      directory_.write_header(header);
      check_parameter_names();
      for (std::size_t begin = 0; begin < runs_.size();) {
        std::size_t end = begin;
        while (end < runs_.size() && runs_[end].case_index == runs_[begin].case_index) ++end;
        run_case(begin, end);
        begin = end;
      }
    } catch (const Interrupted&) {
      result.interrupted = true;
    }
    for (const PlannedRun& run : runs_) {
      if (const RunRecord* row = directory_.find_row(run.name)) ++result.counts[row->status];
    }
    return result;
  }

 private:
  void start_methods() {
    for (const PlannedRun& run : runs_) {
      const std::string& method = plan_.methods[run.method_index].method;
      if (sessions_.contains(method)) continue;
      method_order_.push_back(method);
      sessions_[method] =
          std::make_unique<MethodSession>(method, options_.worker_command(method), options_.limits);
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
    for (const std::string& method : method_order_) {
      const auto title = options_.titles.find(method);
      methods.push_back(describe_method(method, title == options_.titles.end() ? method : title->second,
                                        *sessions_.at(method)));
    }
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

  void run_case(std::size_t begin, std::size_t end) {
    throw_if_interrupted();
    const PlanCase& plan_case = plan_.expanded_cases[runs_[begin].case_index];
    progress_.begin(begin);
    const PointSet set =
        make_point_set(plan_case.dataset, plan_case.holes, static_cast<std::size_t>(plan_case.n), plan_.seed);
    const LoadedPoints points = {set.sha256, directory_.scratch() / "points.f64", set.points.size()};
    write_points_file(points.file, set.points);

    std::vector<Entry> entries;
    for (std::size_t index = begin; index < end; ++index) {
      entries.push_back(prepare(index, plan_case, set));
    }
    for (Entry& entry : entries) {
      if (!entry.done) warm_up(entry, points, set);
    }
    for (int round = 0; round < plan_.repetitions; ++round) run_round(entries, round, points, set);
    for (Entry& entry : entries) {
      if (!entry.done) finish(entry);
    }
  }

  /// The run's record as far as it is known before measuring; done when there is nothing to measure.
  Entry prepare(std::size_t index, const PlanCase& plan_case, const PointSet& set) {
    const PlanMethod& method = plan_.methods[runs_[index].method_index];
    Entry entry;
    entry.index = index;
    entry.session = sessions_.at(method.method).get();
    RunRecord& record = entry.record;
    record.name = runs_[index].name;
    record.method = method.method;
    record.dataset = plan_case.dataset;
    record.dataset_sha256 = set.sha256;
    record.n = plan_case.n;
    record.holes = plan_case.holes;
    record.seed = plan_.seed;
    record.protocol = method.protocol;
    record.parameters = choose_parameters(
        method, plan_case, {set.points, set.ground_truth_area, plan_case.holes, set.ground_truth});
    complete(entry);
    return entry;
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
      entry.done = true;
      progress_.finish(entry.index);
    } else if (refusal) {
      fail(entry, Status::kError, *refusal);
    } else if (!info) {
      fail(entry, entry.session->start_reply().status, start_failure(*entry.session));
    } else {
      entry.repetitions = directory_.repetitions(record.id);
    }
  }

  static std::string start_failure(const MethodSession& session) {
    const Reply& reply = session.start_reply();
    return reply.remedy.empty() ? reply.detail : reply.detail + "; remedy: " + reply.remedy;
  }

  /// The untimed runs. Repetitions of an earlier start call for one at least: their result was scored, but
  /// the scores are gone.
  void warm_up(Entry& entry, const LoadedPoints& points, const PointSet& set) {
    const int untimed = std::max(plan_.warmup, entry.repetitions.empty() ? 0 : 1);
    for (int count = 0; count < untimed && !entry.done; ++count) attempt_run(entry, points, set);
    const auto differs = [&](const Repetition& earlier) {
      return earlier.output_sha256 != entry.record.output_sha256;
    };
    if (!entry.done && std::any_of(entry.repetitions.begin(), entry.repetitions.end(), differs)) {
      entry.repetitions.clear();
      fail(entry, Status::kInvalidOutput, "the result is not the one that it gave before the interruption");
    }
  }

  void run_round(std::vector<Entry>& entries, int round, const LoadedPoints& points, const PointSet& set) {
    std::vector<std::size_t> order(entries.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    // Drawn from the case and the round, so that a run that goes on after an interruption keeps its order.
    Random random(derive_seed(plan_.seed, "order/" + points.key + "/" + std::to_string(round)));
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
    for (const std::size_t which : order) {
      Entry& entry = entries[which];
      if (entry.done || std::cmp_greater(entry.repetitions.size(), round)) continue;
      const std::optional<Attempt> attempt = attempt_run(entry, points, set);
      if (!attempt) continue;
      const Repetition repetition = {attempt->time_ns(), attempt->phases_ns, entry.record.output_sha256};
      directory_.append_repetition(entry.record.id, entry.repetitions.size(), repetition);
      entry.repetitions.push_back(repetition);
    }
  }

  /// One run. The first one's result is scored, and every other one must give it again; without a value when
  /// the run failed, and the entry is done then.
  std::optional<Attempt> attempt_run(Entry& entry, const LoadedPoints& points, const PointSet& set) {
    progress_.begin(entry.index);
    Attempt attempt = entry.session->run(points, entry.record.parameters, directory_.scratch(), timeout_);
    if (attempt.status != Status::kOk) {
      fail(entry, attempt.status, attempt.detail);
      return std::nullopt;
    }
    const std::string hash = hash_of(attempt.wkb);
    if (entry.record.output_sha256.empty()) {
      entry.record.output_sha256 = hash;
      score_result(entry, attempt, set);
    }
    if (!entry.done && entry.record.output_sha256 != hash) {
      fail(entry, Status::kInvalidOutput, "two runs on the same points gave different results");
    }
    if (entry.done) return std::nullopt;
    progress_.advance(entry.index, attempt.elapsed);
    return attempt;
  }

  void score_result(Entry& entry, const Attempt& attempt, const PointSet& set) {
    MultiPolygon shape;
    try {
      shape = from_wkb(attempt.wkb);
    } catch (const std::exception& error) {
      return fail(entry, Status::kInvalidOutput, "the result is no polygon: " + printable(error.what(), 200));
    }
    try {
      const Metrics metrics = score(shape, set.ground_truth);
      entry.record.metrics = metrics_to_json(metrics);
      if (metrics.valid) return;
      // The run is measured all the same: how fast a method gives a wrong answer is part of the record.
      entry.record.status = Status::kInvalidOutput;
      entry.record.detail = "the result is an invalid polygon: " + metrics.invalid_reason;
    } catch (const std::runtime_error& error) {
      fail(entry, Status::kError, std::string("the result cannot be scored: ") + error.what());
    }
  }

  void fail(Entry& entry, Status status, const std::string& detail) {
    entry.record.status = status;
    entry.record.detail = detail;
    finish(entry);
  }

  void finish(Entry& entry) {
    RunRecord& record = entry.record;
    for (const Repetition& repetition : entry.repetitions) {
      record.time_ns.push_back(repetition.time_ns);
      record.phases_ns.push_back(repetition.phases_ns);
    }
    directory_.append_row(record);
    entry.done = true;
    // Of a method that does not start this was said once already.
    if (record.status != Status::kOk && entry.session->info()) {
      progress_.note("hullbench: " + record.name + ": " + to_string(record.status) + ": " + record.detail);
    }
    progress_.finish(entry.index);
  }

  const Plan& plan_;
  const std::vector<PlannedRun>& runs_;
  const RunnerOptions& options_;
  RunDirectory& directory_;
  Progress& progress_;
  std::chrono::milliseconds timeout_;
  std::vector<std::string> method_order_;  ///< as in the plan
  std::map<std::string, std::unique_ptr<MethodSession>> sessions_;
};

}  // namespace

RunResult run_plan(const Plan& plan, const std::vector<PlannedRun>& runs, const json& header,
                   const RunnerOptions& options, RunDirectory& directory, Progress& progress) {
  return Runner(plan, runs, options, directory, progress).run(header);
}

std::vector<ProgressRun> progress_runs(const Plan& plan, const std::vector<PlannedRun>& runs) {
  std::vector<ProgressRun> result;
  result.reserve(runs.size());
  for (const PlannedRun& run : runs) {
    result.push_back({run.name, plan.methods[run.method_index].method, plan.expanded_cases[run.case_index].n,
                      plan.warmup + plan.repetitions});
  }
  return result;
}

int exit_code(const RunResult& result) {
  if (result.interrupted) return 130;
  int measured = 0;
  for (const auto& [status, count] : result.counts) {
    if (status == Status::kNotInstalled || status == Status::kUnsupported || count == 0) continue;
    if (status != Status::kOk) return 4;
    measured += count;
  }
  return measured > 0 ? 0 : 6;
}

}  // namespace hullbench
