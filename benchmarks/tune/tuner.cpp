#include "benchmarks/tune/tuner.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <exception>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>

#include "adapters/wkb.hpp"
#include "benchmarks/base/interrupt.hpp"
#include "benchmarks/metrics/area.hpp"
#include "benchmarks/plan/parameter_rules.hpp"
#include "benchmarks/run/runner.hpp"
#include "benchmarks/tune/search.hpp"
#include "benchmarks/worker/method_session.hpp"
#include "benchmarks/worker/protocol.hpp"

namespace hullbench::tune {
namespace {

namespace fs = std::filesystem;

/// The one place where a result meets its ground truth: fills in l2, or the status and the reason for none.
void score_into(Evaluation& evaluation, const std::vector<std::uint8_t>& wkb,
                const MultiPolygon& ground_truth) {
  MultiPolygon result;
  try {
    result = from_wkb(wkb);
  } catch (const std::exception& error) {
    evaluation.status = record::Status::kInvalidOutput;
    evaluation.detail = "the result is no polygon: " + worker::printable(error.what(), 200);
    return;
  }
  try {
    const metrics::AreaScores scores = metrics::area_scores(result, ground_truth);
    evaluation.l2 = scores.valid ? scores.l2 : std::nullopt;
    if (scores.valid) return;
    evaluation.status = record::Status::kInvalidOutput;
    evaluation.detail = "the result is an invalid polygon: " + scores.invalid_reason;
  } catch (const std::runtime_error& error) {
    evaluation.status = record::Status::kError;
    evaluation.detail = std::string("the result cannot be scored: ") + error.what();
  }
}

/// Points of the cases that are being worked on: drawn by the first thread that wants them, and forgotten
/// when the last one has moved on.
class PointSets {
 public:
  PointSets(const std::vector<TuningCase>& cases, const DataFolders& folders)
      : cases_(cases), folders_(folders), places_(cases.size()) {}

  std::shared_ptr<const PointSet> get(std::size_t which) {
    Place& place = places_[which];
    const std::scoped_lock guard(place.mutex);
    std::shared_ptr<const PointSet> set = place.set.lock();
    if (!set) {
      const plan::PlanCase& wanted = cases_[which].plan_case;
      set = std::make_shared<const PointSet>(make_point_set(
          wanted.dataset, wanted.holes, static_cast<std::size_t>(wanted.n), cases_[which].seed, folders_));
      place.set = set;
    }
    return set;
  }

 private:
  struct Place {
    std::mutex mutex;
    std::weak_ptr<const PointSet> set;
  };
  const std::vector<TuningCase>& cases_;
  const DataFolders& folders_;
  std::vector<Place> places_;
};

/// Everything of one thread: its workers, which must be started by it as they end with it, and the case that
/// they have.
class Bench {
 public:
  Bench(const TunerOptions& options, EvaluationStore& store, fs::path scratch)
      : options_(options), store_(store), scratch_(std::move(scratch)) {
    fs::create_directories(scratch_);
  }

  /// The case all further evaluations are on.
  void enter(const TuningCase& which, std::shared_ptr<const PointSet> set) {
    case_ = &which;
    set_ = std::move(set);
    spacing_ = plan::mean_spacing(set_->points);
    written_ = false;
  }

  double spacing() const { return spacing_; }
  const PointSet& points() const { return *set_; }

  MethodOnCase evaluate(const MethodTuning& method) {
    MethodOnCase found;
    if (set_->ground_truth.empty()) return found;  // nothing is better than anything else
    bool named = false;  // by the plan, which then says too what its default is, if there is one
    for (const plan::PlanMethod& entry : case_->entries) {
      if (entry.method != method.name) continue;
      named = true;
      const plan::RuleInput input = {set_->points, set_->ground_truth_area, case_->plan_case.holes,
                                     set_->ground_truth};
      found.protocols.emplace(entry.protocol,
                              evaluate(method, plan::choose_parameters(entry, case_->plan_case, input)));
    }
    const Parameters fixed = fixed_parameters(*method.info);
    if (!named && has_defaults(*method.info)) found.protocols.emplace("default", evaluate(method, fixed));
    // Points without an area have one length only, zero.
    if (!method.axis || (method.axis->spacings && !(spacing_ > 0))) return found;
    const auto points = search(*method.axis, [&](double position) {
      Parameters parameters = fixed;
      parameters[method.axis->parameter] = value_at(*method.axis, position, spacing_);
      found.sweep.push_back({position, false, evaluate(method, parameters)});
      const Evaluation& evaluation = found.sweep.back().evaluation;
      return Trial{evaluation.error(), evaluation.status == record::Status::kTimeout};
    });
    for (std::size_t i = 0; i < points.size(); ++i) found.sweep[i].on_grid = points[i].on_grid;
    return found;
  }

 private:
  Evaluation evaluate(const MethodTuning& method, const Parameters& parameters) {
    throw_if_interrupted();
    Evaluation evaluation = described(method);
    try {
      evaluation.parameters = complete_parameters(*method.info, parameters);
    } catch (const std::invalid_argument& error) {
      evaluation.parameters = parameters;
      evaluation.status = record::Status::kError;
      evaluation.detail = error.what();
    }
    evaluation.id = evaluation_identity(evaluation);
    if (const auto known = store_.find(evaluation.id)) return *known;
    if (evaluation.status == record::Status::kOk) run(evaluation, method.name);
    store_.append(evaluation);
    return evaluation;
  }

  Evaluation described(const MethodTuning& method) const {
    Evaluation evaluation;
    evaluation.case_name = case_->name;
    evaluation.method = method.name;
    evaluation.method_version = method.info->version;
    evaluation.program = options_.programs.at(method.name);
    evaluation.dataset = case_->plan_case.dataset;
    evaluation.dataset_sha256 = set_->sha256;
    evaluation.n = static_cast<std::int64_t>(set_->points.size());
    evaluation.holes = case_->plan_case.holes;
    evaluation.seed = case_->seed;
    return evaluation;
  }

  void run(Evaluation& evaluation, const std::string& method) {
    const worker::LoadedPoints points = {set_->sha256, scratch_ / "points.f64", set_->points.size()};
    if (!std::exchange(written_, true)) worker::write_points_file(points.file, set_->points);
    const auto timeout =
        std::chrono::milliseconds(std::max<std::int64_t>(1, std::llround(case_->timeout_s * 1000)));
    const worker::Attempt attempt = session(method).run(points, evaluation.parameters, scratch_, timeout);
    evaluation.status = attempt.status;
    evaluation.detail = attempt.detail;
    if (attempt.status == record::Status::kOk) score_into(evaluation, attempt.wkb, set_->ground_truth);
  }

  worker::MethodSession& session(const std::string& method) {
    auto& session = sessions_[method];
    if (!session) {
      session = std::make_unique<worker::MethodSession>(
          options_.find_method(method), worker::WorkerLimits{options_.mem_limit_mib, std::nullopt});
    }
    return *session;
  }

  const TunerOptions& options_;
  EvaluationStore& store_;
  fs::path scratch_;
  std::map<std::string, std::unique_ptr<worker::MethodSession>> sessions_;
  const TuningCase* case_ = nullptr;
  std::shared_ptr<const PointSet> set_;
  double spacing_ = 0;
  bool written_ = false;  ///< whether the points' file has this case's
};

/// Asks every method who it is.
std::vector<MethodTuning> describe_methods(const TunerOptions& options) {
  std::vector<std::unique_ptr<worker::MethodSession>> sessions;
  for (const std::string& name : options.methods) {
    sessions.push_back(std::make_unique<worker::MethodSession>(
        options.find_method(name), worker::WorkerLimits{options.mem_limit_mib, std::nullopt}));
    sessions.back()->begin_start();
  }
  std::vector<MethodTuning> methods;
  for (const auto& session : sessions) {
    session->finish_start();
    MethodTuning& method = methods.emplace_back();
    method.name = session->method().name;
    method.title = session->method().title;
    method.info = session->info();
    if (method.info) {
      method.title = method.info->title;
      method.axis = search_axis(*method.info);
    } else {
      method.detail = session->start_reply().detail;
      method.remedy = session->start_reply().remedy;
    }
  }
  return methods;
}

TuningCase tuning_case(const plan::Plan& plan, const plan::PlanCase& plan_case, std::uint64_t split_seed) {
  TuningCase one;
  one.plan_case = plan_case;
  one.seed = plan.seed;
  one.timeout_s = plan.timeout_s;
  one.name = plan_case.dataset + "/n:" + (plan_case.n == 0 ? "all" : std::to_string(plan_case.n)) +
             "/holes:" + (plan_case.holes ? "1" : "0");
  one.shape = base_shape(plan_case.dataset);
  one.side = side_of(one.shape, split_seed);
  return one;
}

/// The plan's entries for the case, but those whose parameters are to be chosen here.
void add_entries(TuningCase& one, const plan::Plan& plan) {
  for (const plan::PlanMethod& entry : plan.methods) {
    if (entry.protocol == "tuned" || entry.protocol == "oracle" || !plan::applies(entry, one.plan_case))
      continue;
    const auto same = [&](const plan::PlanMethod& other) {
      return other.method == entry.method && other.protocol == entry.protocol;
    };
    if (std::none_of(one.entries.begin(), one.entries.end(), same)) one.entries.push_back(entry);
  }
}

class Tuner {
 public:
  Tuner(Tuning& tuning, const TunerOptions& options, EvaluationStore& store, run::Progress& progress)
      : tuning_(tuning),
        options_(options),
        store_(store),
        progress_(progress),
        sets_(tuning.cases, options.folders) {}

  /// Every thread takes the next method on a case, case by case, until there is none or one of them failed.
  void run() {
    std::vector<std::exception_ptr> errors(static_cast<std::size_t>(options_.jobs));
    {
      std::vector<std::jthread> threads;
      for (std::size_t t = 0; t < errors.size(); ++t) {
        threads.emplace_back([this, t, &error = errors[t]] {
          try {
            take_turns(options_.scratch / ("thread-" + std::to_string(t)));
          } catch (...) {
            error = std::current_exception();
            stop_ = true;
          }
        });
      }
    }
    // An interruption is only an interruption when nothing else went wrong.
    std::exception_ptr interruption;
    for (const std::exception_ptr& error : errors) {
      if (!error) continue;
      try {
        std::rethrow_exception(error);
      } catch (const Interrupted&) {
        interruption = error;
      }
    }
    if (interruption) std::rethrow_exception(interruption);
  }

 private:
  void take_turns(const fs::path& scratch) {
    Bench bench(options_, store_, scratch);
    std::size_t entered = tuning_.cases.size();
    const std::size_t count = tuning_.cases.size() * tuning_.methods.size();
    for (std::size_t item = next_++; item < count && !stop_; item = next_++) {
      const std::size_t which = item / tuning_.methods.size();
      MethodTuning& method = tuning_.methods[item % tuning_.methods.size()];
      if (which != entered) {
        bench.enter(tuning_.cases[which], sets_.get(which));
        remember(which, bench);
        entered = which;
      }
      const auto start = std::chrono::steady_clock::now();
      if (method.info) method.cases[which] = bench.evaluate(method);
      say(item, method, std::chrono::steady_clock::now() - start);
    }
  }

  void remember(std::size_t which, const Bench& bench) {
    const std::scoped_lock guard(mutex_);
    TuningCase& one = tuning_.cases[which];
    one.dataset_sha256 = bench.points().sha256;
    one.n = static_cast<std::int64_t>(bench.points().points.size());
    one.spacing = bench.spacing();
  }

  /// The estimate takes units as done one after the other.
  void say(std::size_t item, const MethodTuning& method, std::chrono::nanoseconds elapsed) {
    const std::scoped_lock guard(mutex_);
    progress_.begin(item);
    if (method.info) progress_.advance(item, elapsed / options_.jobs);
    progress_.finish(item);
  }

  Tuning& tuning_;
  const TunerOptions& options_;
  EvaluationStore& store_;
  run::Progress& progress_;
  PointSets sets_;
  std::mutex mutex_;
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> stop_{false};
};

}  // namespace

const Evaluation* best_evaluation(const MethodOnCase& found) {
  const Evaluation* best = nullptr;
  const auto consider = [&](const Evaluation& one) {
    if (best == nullptr || one.error() < best->error()) best = &one;
  };
  for (const SweepEvaluation& one : found.sweep) consider(one.evaluation);
  for (const auto& [protocol, one] : found.protocols) consider(one);
  return best;
}

const Evaluation* evaluation_at(const MethodOnCase& found, double position) {
  const auto same = [&](const SweepEvaluation& one) { return one.position == position; };
  const auto place = std::find_if(found.sweep.begin(), found.sweep.end(), same);
  return place == found.sweep.end() ? nullptr : &place->evaluation;
}

std::vector<TuningCase> tuning_cases(const std::vector<plan::Plan>& plans, std::uint64_t split_seed) {
  std::vector<TuningCase> cases;
  for (const plan::Plan& plan : plans) {
    for (const plan::PlanCase& plan_case : plan.expanded_cases) {
      const auto same = [&](const TuningCase& other) {
        return other.plan_case.key() == plan_case.key() && other.seed == plan.seed;
      };
      auto place = std::find_if(cases.begin(), cases.end(), same);
      if (place == cases.end()) place = cases.insert(place, tuning_case(plan, plan_case, split_seed));
      add_entries(*place, plan);
    }
  }
  return cases;
}

Tuning run_tuning(std::vector<TuningCase> cases, std::uint64_t split_seed, const TunerOptions& options,
                  EvaluationStore& store, run::Progress& progress) {
  Tuning tuning;
  tuning.split_seed = split_seed;
  tuning.cases = std::move(cases);
  try {
    tuning.methods = describe_methods(options);
    for (MethodTuning& method : tuning.methods) {
      if (method.info) {
        method.cases.resize(tuning.cases.size());
      } else {
        progress.note("hullbench: " + method.name + " does not start: " + method.detail +
                      (method.remedy.empty() ? "" : "; remedy: " + method.remedy));
      }
    }
    Tuner(tuning, options, store, progress).run();
  } catch (const Interrupted&) {
    tuning.interrupted = true;
  }
  return tuning;
}

std::vector<run::ProgressRun> tuning_progress(const std::vector<TuningCase>& cases,
                                              const std::vector<std::string>& methods) {
  std::vector<run::ProgressRun> result;
  result.reserve(cases.size() * methods.size());
  for (const TuningCase& one : cases) {
    for (const std::string& method : methods)
      result.push_back({method + "/" + one.name, method, run::estimated_points(one.plan_case), 1});
  }
  return result;
}

}  // namespace hullbench::tune
