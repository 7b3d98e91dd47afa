#include "benchmarks/tune/tuner.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <utility>

#include "benchmarks/base/interrupt.hpp"
#include "benchmarks/base/parallel.hpp"
#include "benchmarks/plan/parameter_rules.hpp"
#include "benchmarks/run/drawn_case.hpp"
#include "benchmarks/run/runner.hpp"
#include "benchmarks/tune/search.hpp"
#include "benchmarks/worker/method_session.hpp"

namespace hullbench::tune {
namespace {

namespace fs = std::filesystem;

/// The cases that are being worked on: drawn by the first thread that wants them, and forgotten when the last
/// one has moved on.
class DrawnCases {
 public:
  DrawnCases(const std::vector<TuningCase>& cases, const DataFolders& folders)
      : cases_(cases), folders_(folders), places_(cases.size()) {}

  std::shared_ptr<const run::DrawnCase> get(std::size_t which) {
    Place& place = places_[which];
    const std::scoped_lock guard(place.mutex);
    std::shared_ptr<const run::DrawnCase> drawn = place.drawn.lock();
    if (!drawn) {
      drawn = std::make_shared<const run::DrawnCase>(cases_[which].plan_case, cases_[which].seed, folders_);
      place.drawn = drawn;
    }
    return drawn;
  }

 private:
  struct Place {
    std::mutex mutex;
    std::weak_ptr<const run::DrawnCase> drawn;
  };
  const std::vector<TuningCase>& cases_;
  const DataFolders& folders_;
  std::vector<Place> places_;
};

std::vector<std::unique_ptr<worker::MethodSession>> make_sessions(const TunerOptions& options) {
  std::vector<std::unique_ptr<worker::MethodSession>> sessions;
  for (const std::string& name : options.methods) {
    sessions.push_back(std::make_unique<worker::MethodSession>(
        options.find_method(name), worker::WorkerLimits{options.mem_limit_mib, std::nullopt}));
  }
  return sessions;
}

/// What the threads share.
struct Shared {
  Tuning& tuning;
  const TunerOptions& options;
  EvaluationStore& store;
  run::Progress& progress;
  DrawnCases drawn{tuning.cases, options.folders};
  std::mutex mutex{};                ///< of tuning.cases and progress
  std::atomic<std::size_t> next{0};  ///< case by case, the method to evaluate next
};

/// Everything of one thread: its workers, which must be started by it as they end with it, and the case that
/// they have.
class Bench {
 public:
  Bench(Shared& shared, const fs::path& scratch)
      : shared_(shared), scratch_(scratch), sessions_(make_sessions(shared.options)) {
    fs::create_directories(scratch_);
  }

  /// Takes the next method on a case, case by case, until there is none.
  void take_turns() {
    std::vector<MethodTuning>& methods = shared_.tuning.methods;
    const std::size_t count = shared_.tuning.cases.size() * methods.size();
    for (std::size_t item = shared_.next++; item < count; item = shared_.next++) {
      enter(item / methods.size());
      which_method_ = item % methods.size();
      const auto start = std::chrono::steady_clock::now();
      MethodTuning& method = methods[which_method_];
      if (method.info) method.cases[which_case_] = evaluate(method);
      say(item, method, std::chrono::steady_clock::now() - start);
    }
  }

 private:
  /// The case all further evaluations are on.
  void enter(std::size_t which) {
    if (drawn_ && which == which_case_) return;
    which_case_ = which;
    drawn_ = shared_.drawn.get(which);
    spacing_ = plan::mean_spacing(drawn_->set().points);
    points_.reset();
    const std::scoped_lock guard(shared_.mutex);
    TuningCase& one = shared_.tuning.cases[which];
    one.dataset_sha256 = drawn_->set().sha256;
    one.n = static_cast<std::int64_t>(drawn_->set().points.size());
    one.spacing = spacing_;
  }

  const TuningCase& tuning_case() const { return shared_.tuning.cases[which_case_]; }

  MethodOnCase evaluate(const MethodTuning& method) {
    MethodOnCase found;
    if (drawn_->set().ground_truth.empty()) return found;  // nothing is better than anything else
    bool named = false;  // by the plan, which then says too what its default is, if there is one
    for (const plan::PlanMethod& entry : tuning_case().entries) {
      if (entry.method != method.name) continue;
      named = true;
      found.protocols.emplace(entry.protocol, evaluate(method, drawn_->choose_parameters(entry)));
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
      return Trial{error_of(evaluation), evaluation.status == record::Status::kTimeout};
    });
    for (std::size_t i = 0; i < points.size(); ++i) found.sweep[i].on_grid = points[i].on_grid;
    return found;
  }

  Evaluation evaluate(const MethodTuning& method, const Parameters& parameters) {
    throw_if_interrupted();
    Evaluation evaluation = drawn_->record_of(method.name);
    evaluation.name = tuning_case().plan_case.name();
    evaluation.program = shared_.options.programs.at(method.name);
    evaluation.parameters = parameters;
    run::complete_record(evaluation, *method.info);
    evaluation.id = evaluation_identity(evaluation);
    if (const Evaluation* known = shared_.store.find(evaluation.id)) return *known;
    if (evaluation.status == record::Status::kOk) run(evaluation);
    shared_.store.append(evaluation);
    return evaluation;
  }

  void run(Evaluation& evaluation) {
    const PointSet& set = drawn_->set();
    if (!points_) points_ = worker::write_points(set.sha256, set.points, scratch_);
    const worker::Attempt attempt = sessions_[which_method_]->run(*points_, evaluation.parameters, scratch_,
                                                                  run::to_timeout(tuning_case().timeout_s));
    evaluation.status = attempt.status;
    evaluation.detail = attempt.detail;
    if (attempt.status != record::Status::kOk) return;
    if (const auto result = run::read_result(evaluation, attempt.wkb)) drawn_->score_l2(evaluation, *result);
  }

  /// The estimate takes units as done one after the other.
  void say(std::size_t item, const MethodTuning& method, std::chrono::nanoseconds elapsed) {
    const std::scoped_lock guard(shared_.mutex);
    shared_.progress.begin(item);
    if (method.info) shared_.progress.advance(item, elapsed / shared_.options.jobs);
    shared_.progress.finish(item);
  }

  Shared& shared_;
  fs::path scratch_;
  std::vector<std::unique_ptr<worker::MethodSession>> sessions_;  ///< by method; each starts at its first run
  std::size_t which_method_ = 0;
  std::size_t which_case_ = 0;
  std::shared_ptr<const run::DrawnCase> drawn_;  ///< of which_case_; null before the first one
  double spacing_ = 0;
  std::optional<worker::LoadedPoints> points_;  ///< none: nothing was run on the case
};

/// Asks every method who it is.
std::vector<MethodTuning> describe_methods(const TunerOptions& options, std::size_t cases,
                                           run::Progress& progress) {
  const auto sessions = make_sessions(options);
  run::start_workers(sessions, progress);
  std::vector<MethodTuning> methods;
  for (const auto& session : sessions) {
    MethodTuning& method = methods.emplace_back();
    method.name = session->method().name;
    method.title = session->method().title;
    method.info = session->info();
    if (method.info) {
      method.title = method.info->title;
      method.axis = search_axis(*method.info);
      method.cases.resize(cases);
    } else {
      method.detail = session->start_reply().detail;
      method.remedy = session->start_reply().remedy;
    }
  }
  return methods;
}

TuningCase make_case(const plan::Plan& plan, const plan::PlanCase& plan_case) {
  TuningCase one;
  one.plan_case = plan_case;
  one.seed = plan.seed;
  one.timeout_s = plan.timeout_s;
  one.shape = base_shape(plan_case.dataset);
  one.side = side_of(plan_case.dataset);
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

}  // namespace

const Evaluation* best_evaluation(const MethodOnCase& found) {
  const Evaluation* best = nullptr;
  const auto consider = [&](const Evaluation& one) {
    if (best == nullptr || error_of(one) < error_of(*best)) best = &one;
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

std::vector<TuningCase> tuning_cases(const std::vector<plan::Plan>& plans) {
  std::vector<TuningCase> cases;
  for (const plan::Plan& plan : plans) {
    for (const plan::PlanCase& plan_case : plan.expanded_cases) {
      if (side_of(plan_case.dataset) == Side::kNeither) continue;
      const auto same = [&](const TuningCase& other) {
        return other.plan_case.key() == plan_case.key() && other.seed == plan.seed;
      };
      auto place = std::find_if(cases.begin(), cases.end(), same);
      if (place == cases.end()) place = cases.insert(place, make_case(plan, plan_case));
      add_entries(*place, plan);
    }
  }
  return cases;
}

Tuning run_tuning(std::vector<TuningCase> cases, const TunerOptions& options, EvaluationStore& store,
                  run::Progress& progress) {
  Tuning tuning;
  tuning.cases = std::move(cases);
  try {
    tuning.methods = describe_methods(options, tuning.cases.size(), progress);
    Shared shared{tuning, options, store, progress};
    const std::vector<int> threads(static_cast<std::size_t>(options.jobs), kAnyCore);
    for_each_in_parallel(threads.size(), threads, [&](std::size_t thread) {
      try {
        Bench(shared, store.scratch() / ("thread-" + std::to_string(thread))).take_turns();
      } catch (...) {
        shared.next = tuning.cases.size() * tuning.methods.size();  // the others end after what they are at
        throw;
      }
    });
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
      result.push_back(
          {method + "/" + one.plan_case.name(), method, run::estimated_points(one.plan_case), 1});
  }
  return result;
}

}  // namespace hullbench::tune
