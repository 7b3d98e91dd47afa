#include "benchmarks/tune/tuner.hpp"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <utility>

#include "benchmarks/base/interrupt.hpp"
#include "benchmarks/base/parallel.hpp"
#include "benchmarks/metrics/shape_measures.hpp"
#include "benchmarks/plan/parameter_rules.hpp"
#include "benchmarks/run/drawn_case.hpp"
#include "benchmarks/run/runner.hpp"
#include "benchmarks/run/workbench.hpp"
#include "benchmarks/tune/analysis.hpp"
#include "benchmarks/tune/halving.hpp"
#include "benchmarks/tune/search.hpp"

namespace hullbench::tune {
namespace {

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

void add_methods(run::Workbench& bench, const TunerOptions& options) {
  for (const std::string& name : options.methods)
    bench.add(options.find_method(name), {options.mem_limit_mib, std::nullopt});
}

/// A method on a case.
struct WorkItem {
  std::size_t place = 0;  ///< in the order of tuning_progress
  bool is_test = false;   ///< then everything that is done on a test case, else the positions of a round
  TrainingItem what;
};

/// Hands out the work to all threads: the rounds of successive halving, none before the one before is over,
/// then the test cases.
class WorkQueue {
 public:
  explicit WorkQueue(Tuning& tuning)
      : tuning_(tuning), rounds_(round_ends(training_order(tuning.cases).size()).size()) {
    fill();
  }

  /// Waits until there is something to do; none when all is done or stop() was called.
  std::optional<WorkItem> take() {
    std::unique_lock lock(mutex_);
    while (!stopped_) {
      if (next_ < items_.size()) {
        ++working_;
        const std::size_t place = taken_++;
        return WorkItem{place, round_ == rounds_, items_[next_++]};
      }
      if (working_ > 0) {
        changed_.wait(lock);
      } else if (round_ == rounds_) {
        stopped_ = true;
      } else {
        end_round(tuning_, round_++);
        fill();
        changed_.notify_all();
      }
    }
    changed_.notify_all();
    return std::nullopt;
  }

  /// What take() gave is done.
  void finish() {
    const std::scoped_lock lock(mutex_);
    --working_;
    changed_.notify_all();
  }

  /// The others end after what they are at.
  void stop() {
    const std::scoped_lock lock(mutex_);
    stopped_ = true;
    changed_.notify_all();
  }

 private:
  void fill() {
    next_ = 0;
    items_.clear();
    if (round_ < rounds_) {
      items_ = items_of_round(tuning_, round_);
      return;
    }
    for (std::size_t i = 0; i < tuning_.cases.size(); ++i) {
      if (tuning_.cases[i].side() != Side::kTest) continue;
      for (std::size_t m = 0; m < tuning_.methods.size(); ++m) items_.push_back({i, m, {}});
    }
  }

  Tuning& tuning_;
  const std::size_t rounds_;
  std::mutex mutex_{};
  std::condition_variable changed_{};
  std::vector<TrainingItem> items_{};  ///< of the round, or the test cases
  std::size_t round_ = 0;              ///< rounds_: the test cases
  std::size_t next_ = 0;               ///< of items_
  std::size_t taken_ = 0;              ///< items of all rounds
  std::size_t working_ = 0;            ///< items that were taken and are not done
  bool stopped_ = false;
};

/// What the threads share.
struct Shared {
  Tuning& tuning;
  const TunerOptions& options;
  run::RowStore& store;
  run::Progress& progress;
  DrawnCases drawn{tuning.cases, options.folders};
  std::mutex mutex{};  ///< of tuning.cases and progress
  WorkQueue queue{tuning};
};

/// One thread: its workers and the case that it is at.
class TuningThread {
 public:
  TuningThread(Shared& shared, const fs::path& scratch) : shared_(shared), bench_(scratch) {
    add_methods(bench_, shared.options);
  }

  /// Takes the next method on a case until there is none.
  void take_turns() {
    while (const std::optional<WorkItem> item = shared_.queue.take()) {
      place_ = item->place;
      MethodTuning& method = shared_.tuning.methods[item->what.which_method];
      tell([&](run::Progress& progress) { progress.begin(place_); });
      enter(item->what.which_case);
      if (method.info) {
        MethodOnCase& found = method.cases[which_case_];
        if (item->is_test) {
          evaluate_test_case(method, found);
        } else {
          sweep(method, found, item->what.positions);
        }
      }
      tell([&](run::Progress& progress) { progress.finish(place_); });
      shared_.queue.finish();
    }
  }

 private:
  /// The case all further evaluations are on.
  void enter(std::size_t which) {
    if (drawn_ && which == which_case_) return;
    which_case_ = which;
    drawn_ = shared_.drawn.get(which);
    spacing_ = plan::mean_spacing(drawn_->set().points);
    const std::scoped_lock guard(shared_.mutex);
    TuningCase& one = shared_.tuning.cases[which];
    one.dataset_sha256 = drawn_->set().sha256;
    one.n = static_cast<std::int64_t>(drawn_->set().points.size());
    one.spacing = spacing_;
    const MultiPolygon& truth = drawn_->set().ground_truth;
    one.kind = kind_of_shape(truth.size(), metrics::count_holes(truth));
  }

  const TuningCase& tuning_case() const { return shared_.tuning.cases[which_case_]; }

  bool can_be_searched(const MethodTuning& method) const {
    // Nothing is better than anything else without a ground truth, and points without an area have one length
    // only, zero.
    return method.axis && !drawn_->set().ground_truth.empty() && (!method.axis->spacings || spacing_ > 0);
  }

  /// Whether the method's result can be like the truth: a value is not chosen by cases on which all are bad.
  bool can_match(const MethodTuning& method) const {
    const MultiPolygon& truth = drawn_->set().ground_truth;
    const Capabilities& able = method.info->capabilities;
    return (able.holes || metrics::count_holes(truth) == 0) && (able.several_polygons || truth.size() == 1);
  }

  const record::RunRecord& evaluate_at(const MethodTuning& method, MethodOnCase& found, double position,
                                       bool on_grid, bool holes) {
    Parameters parameters = fixed_parameters(method, holes);
    parameters[method.axis->parameter] = value_at(*method.axis, position, spacing_);
    found.sweep.push_back({position, on_grid, holes, evaluate(method, parameters)});
    return found.sweep.back().evaluation;
  }

  /// The positions of a round, but those after too many time-outs in a row; of a training case.
  void sweep(const MethodTuning& method, MethodOnCase& found, const std::vector<double>& positions) {
    if (!can_be_searched(method) || !can_match(method)) return;
    for (const bool holes : choices_of_holes(*method.info)) {
      int timeouts = 0;
      for (const double position : positions) {
        const record::RunRecord& evaluation = evaluate_at(method, found, position, true, holes);
        timeouts = evaluation.status == record::Status::kTimeout ? timeouts + 1 : 0;
        if (timeouts == kMostTimeouts) break;
      }
    }
  }

  /// The protocols, the value for many shapes, and the search for the best one.
  void evaluate_test_case(const MethodTuning& method, MethodOnCase& found) {
    if (drawn_->set().ground_truth.empty()) return;
    bool named = false;  // by the plan, which then says too what its default is, if there is one
    for (const plan::PlanMethod& entry : tuning_case().entries) {
      if (entry.method != method.name) continue;
      named = true;
      found.protocols.emplace(entry.protocol, evaluate(method, drawn_->choose_parameters(entry)));
    }
    if (!named && has_defaults(*method.info))
      found.protocols.emplace("default", evaluate(method, fixed_parameters(*method.info)));
    if (!can_be_searched(method)) return;
    for (const bool holes : choices_of_holes(*method.info)) {
      const std::size_t first = found.sweep.size();
      const auto points = search(*method.axis, [&](double position) {
        const record::RunRecord& evaluation = evaluate_at(method, found, position, false, holes);
        return Trial{error_of(evaluation), evaluation.status == record::Status::kTimeout};
      });
      for (std::size_t i = 0; i < points.size(); ++i) found.sweep[first + i].on_grid = points[i].on_grid;
    }
    const auto tuned = choose_tuned(method);
    if (tuned && evaluation_at(found, tuned->position, tuned->holes) == nullptr)
      evaluate_at(method, found, tuned->position, false, tuned->holes);
  }

  /// The case's, or more where the plan gives the method more.
  double timeout_of(const std::string& method) const {
    double timeout_s = tuning_case().timeout_s;
    for (const plan::PlanMethod& entry : tuning_case().entries) {
      if (entry.method == method) timeout_s = std::max(timeout_s, entry.timeout_s.value_or(0));
    }
    return timeout_s;
  }

  record::RunRecord evaluate(const MethodTuning& method, const Parameters& parameters) {
    throw_if_interrupted();
    run::MethodRun run(drawn_, method.name, parameters);
    run.record.name = tuning_case().plan_case.name();
    run.record.program = shared_.options.programs.at(method.name);
    run.begin(*bench_.find(method.name), method.info, timeout_of(method.name));
    if (const record::RunRecord* known = shared_.store.find_row(run.record.id)) return *known;
    const auto start = std::chrono::steady_clock::now();
    if (!run.over) bench_.attempt(run);
    run.score_l2();
    shared_.store.append_row(run.record);
    // The estimate takes evaluations as done one after the other.
    const auto elapsed = (std::chrono::steady_clock::now() - start) / shared_.options.jobs;
    tell([&](run::Progress& progress) { progress.advance(place_, elapsed); });
    return run.record;
  }

  /// The progress is one for all threads.
  template <typename Tell>
  void tell(const Tell& tell_it) {
    const std::scoped_lock guard(shared_.mutex);
    tell_it(shared_.progress);
  }

  Shared& shared_;
  run::Workbench bench_;
  std::size_t place_ = 0;  ///< of the item in the progress
  std::size_t which_case_ = 0;
  std::shared_ptr<const run::DrawnCase> drawn_;  ///< of which_case_; null before the first one
  double spacing_ = 0;
};

/// Asks every method who it is.
std::vector<MethodTuning> describe_methods(const TunerOptions& options, std::size_t cases,
                                           const fs::path& scratch, run::Progress& progress) {
  run::Workbench bench(scratch);
  add_methods(bench, options);
  bench.start(progress);
  std::vector<MethodTuning> methods;
  for (const auto& session : bench.sessions()) {
    MethodTuning& method = methods.emplace_back();
    method.name = session->method().name;
    method.title = session->method().title;
    method.info = session->info();
    if (method.info) {
      method.title = method.info->title;
      const auto searched = options.searched.find(method.name);
      const bool is_said = searched != options.searched.end();
      if (!options.not_searched.contains(method.name))
        method.axis = search_axis(*method.info, is_said ? searched->second.parameter : "");
      if (method.axis && is_said) method.others = searched->second.others;
      method.cases.resize(cases);
    } else {
      method.detail = session->start_reply().detail;
      method.remedy = session->start_reply().remedy;
    }
  }
  return methods;
}

/// The plan's entries for the case, but those whose parameters are to be chosen here.
void add_entries(TuningCase& one, const plan::Plan& plan) {
  for (const plan::PlanMethod& entry : plan.methods) {
    if (entry.protocol == "tuned" || entry.protocol == "oracle" || !plan::applies(entry, one.plan_case))
      continue;
    const auto same = [&](const plan::PlanMethod& other) {
      return other.method == entry.method && other.protocol == entry.protocol;
    };
    if (std::ranges::none_of(one.entries, same)) one.entries.push_back(entry);
  }
}

}  // namespace

Parameters fixed_parameters(const MethodTuning& method, bool holes) {
  Parameters fixed = fixed_parameters(*method.info, holes);
  fixed.insert(method.others.begin(), method.others.end());
  return fixed;
}

double error_of(const record::RunRecord& evaluation) {
  return evaluation.metrics.value("l2", kInfinitelyBad);
}

const record::RunRecord* best_evaluation(const MethodOnCase& found) {
  const record::RunRecord* best = nullptr;
  const auto consider = [&](const record::RunRecord& one) {
    if (best == nullptr || error_of(one) < error_of(*best)) best = &one;
  };
  for (const SweepEvaluation& one : found.sweep) consider(one.evaluation);
  for (const auto& [protocol, one] : found.protocols) consider(one);
  return best;
}

const record::RunRecord* evaluation_at(const MethodOnCase& found, double position, bool holes) {
  const auto same = [&](const SweepEvaluation& one) {
    return one.position == position && one.holes == holes;
  };
  const auto place = std::ranges::find_if(found.sweep, same);
  return place == found.sweep.end() ? nullptr : &place->evaluation;
}

double error_at(const MethodOnCase& found, double position, bool holes) {
  const record::RunRecord* evaluation = evaluation_at(found, position, holes);
  return evaluation == nullptr ? kInfinitelyBad : error_of(*evaluation);
}

std::vector<TuningCase> tuning_cases(const std::vector<plan::Plan>& plans) {
  std::vector<TuningCase> cases;
  for (const plan::Plan& plan : plans) {
    for (const plan::PlanCase& plan_case : plan.expanded_cases) {
      if (side_of(plan_case.dataset) == Side::kNeither) continue;
      const auto same = [&](const TuningCase& other) {
        return other.plan_case.key() == plan_case.key() && other.seed == plan.seed;
      };
      auto place = std::ranges::find_if(cases, same);
      if (place == cases.end()) place = cases.insert(place, {plan_case, plan.seed, plan.timeout_s});
      add_entries(*place, plan);
    }
  }
  return cases;
}

Tuning run_tuning(std::vector<TuningCase> cases, const TunerOptions& options, run::RowStore& store,
                  run::Progress& progress) {
  Tuning tuning;
  tuning.cases = std::move(cases);
  try {
    tuning.methods = describe_methods(options, tuning.cases.size(), store.scratch(), progress);
    Shared shared{tuning, options, store, progress};
    const std::vector<int> threads(static_cast<std::size_t>(options.jobs), kAnyCore);
    for_each_in_parallel(threads.size(), threads, [&](std::size_t thread) {
      try {
        TuningThread(shared, store.scratch() / ("thread-" + std::to_string(thread))).take_turns();
      } catch (...) {
        shared.queue.stop();
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
  const auto add = [&](const TuningCase& one, int evaluations) {
    for (const std::string& method : methods) {
      result.push_back(
          {method + "/" + one.plan_case.name(), method, run::estimated_points(one.plan_case), evaluations});
    }
  };
  const std::vector<std::size_t> order = training_order(cases);
  std::size_t taken = 0;
  int positions = kGridPoints;
  for (const std::size_t end : round_ends(order.size())) {
    for (; taken < end; ++taken) add(cases[order[taken]], positions);
    positions = (positions + 1) / 2;
  }
  constexpr int kProtocols = 3;  // default, auto and the tuned value
  for (const TuningCase& one : cases) {
    if (one.side() == Side::kTest) add(one, kProtocols + kSweepPoints + kRefinements);
  }
  return result;
}

}  // namespace hullbench::tune
