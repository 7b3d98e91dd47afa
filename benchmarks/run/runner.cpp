#include "benchmarks/run/runner.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <utility>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/base/interrupt.hpp"
#include "benchmarks/base/parallel.hpp"
#include "benchmarks/record/kept_polygons.hpp"
#include "benchmarks/record/pictures.hpp"
#include "benchmarks/run/drawn_case.hpp"
#include "benchmarks/run/point_parts.hpp"
#include "benchmarks/run/workbench.hpp"
#include "datasets/degenerate.hpp"
#include "datasets/random.hpp"

namespace hullbench::run {
namespace {

/// One of the planned runs, with its times.
struct Entry {
  std::size_t index = 0;  ///< into the planned runs
  MethodRun run;
  std::vector<Repetition> repetitions = {};  ///< of all passes
  std::optional<Repetition> latest = {};     ///< of the round that is not over
  bool is_left = false;                      ///< its row is there, and nothing is to be done
};

/// The runs of one case: indices into the planned runs, the last one not included.
struct RunsOfCase {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// The same with what they are run on.
struct CaseWork {
  RunsOfCase runs;
  std::shared_ptr<const DrawnCase> drawn = nullptr;
  std::vector<Entry> entries = {};
};

/// A batch holds cases for about so many points times runs: 31 of the random polygons, which are worth
/// drawing and scoring in parallel, but one of the largest state shapes, as little is to be lost when the
/// machine stops.
constexpr std::int64_t kBatchWork = 1'000'000;

/// Before the timed ones of a pass; the first has one at least, so that no method is timed cold and every
/// result is given twice.
int untimed_runs(const plan::Plan& plan, int pass) {
  return std::max(plan.warmup, pass == 1 ? 1 : 0);
}

/// How many of a method's repetitions fall in `pass`.
int share_of(const plan::Plan& plan, const plan::PlanMethod& method, int pass) {
  return plan::share_of_pass(plan::repetitions_of(plan, method), plan.passes, pass);
}

/// And in the passes up to `pass`.
int repetitions_until(const plan::Plan& plan, const plan::PlanMethod& method, int pass) {
  int count = 0;
  for (int each = 1; each <= pass; ++each) count += share_of(plan, method, each);
  return count;
}

/// Whether nothing is left to measure of `run` in the passes up to `pass`.
bool is_done(const plan::Plan& plan, const plan::PlannedRun& run, const RunDirectory& directory, int pass) {
  const record::RunRecord* row = directory.find_row(run.name);
  if (!row) return false;
  if (row->status != record::Status::kOk) return true;
  const plan::PlanMethod& method = plan.methods[run.method_index];
  const std::size_t there = row->time_ns.size();
  if (std::cmp_less(there, repetitions_until(plan, method, pass))) return false;
  // A later pass adds to the repetitions, so they must be there too.
  return std::cmp_greater_equal(there, plan::repetitions_of(plan, method)) ||
         directory.repetitions(row->id).size() >= there;
}

/// The reasons to doubt a row.
std::vector<std::string> flags_of(const record::RunRecord& record,
                                  const std::vector<Repetition>& repetitions) {
  const auto any = [&](auto is_so) { return std::ranges::any_of(repetitions, is_so); };
  const double floor = record::kFloorNsPerPoint * static_cast<double>(record.n);
  std::vector<std::string> flags;
  if (any([&](const Repetition& one) { return static_cast<double>(one.time_ns) < floor; }))
    flags.emplace_back(record::kFasterThanFloor);
  if (any([](const Repetition& one) { return one.remeasured; })) flags.emplace_back(record::kRemeasuredRound);
  if (any([](const Repetition& one) { return one.unsteady; })) flags.emplace_back(record::kUnsteadyMachine);
  if (record::is_worse_than_convex_hull(record.metrics)) flags.emplace_back(record::kWorseThanConvexHull);
  return flags;
}

/// Why `work` failed; empty when it did not. An interruption, and what the user can mend, end the run.
template <typename Work>
std::string fault_of(const Work& work) {
  try {
    work();
  } catch (const Interrupted&) {
    throw;
  } catch (const ConfigurationError&) {
    throw;
  } catch (const std::exception& error) {
    return error.what();
  }
  return {};
}

/// A run of `method` on the points; it is over where they give no parameters.
MethodRun make_run(const std::shared_ptr<const DrawnCase>& drawn, const plan::PlanMethod& method) {
  Parameters parameters;
  const std::string fault = fault_of([&] { parameters = drawn->choose_parameters(method); });
  MethodRun run(drawn, method.method, std::move(parameters));
  if (!fault.empty()) run.fail(record::Status::kError, "the parameters cannot be chosen: " + fault);
  return run;
}

/// What a first run loads and allocates takes milliseconds, which nobody sees in a run of this length.
constexpr std::chrono::nanoseconds kLongRun = std::chrono::seconds(2);

class Runner {
 public:
  Runner(const plan::Plan& plan, const std::vector<plan::PlannedRun>& runs, const RunnerOptions& options,
         RunDirectory& directory, Progress& progress, int pass)
      : plan_(plan),
        runs_(runs),
        options_(options),
        directory_(directory),
        progress_(progress),
        pass_(pass),
        pictures_(directory.path(), runs.size()),
        bench_(directory.scratch()) {}

  RunResult run(json header) {
    RunResult result;
    if (!header.contains("methods")) header["methods"] = json::array();
    machine_ = header.at("environment").at("machine_id").get<std::string>();
    try {
      // Before anything can be interrupted, so that the folder is known for what it is.
      if (pass_ == 1) directory_.write_header(header);
      find_cases();
      add_methods();
      bench_.start(progress_);
      if (pass_ == 1) {
        header["methods"] = describe_methods();
        directory_.write_header(header);
      }
      check_parameter_names();
      for (std::size_t next = 0; next < cases_.size();) next = run_batch(next);
    } catch (const Interrupted&) {
      result.interrupted = true;
    }
    directory_.compact_rows();
    for (const plan::PlannedRun& run : runs_) {
      if (const record::RunRecord* row = directory_.find_row(run.name))
        count_row(result, row->status, plan_.accepted);
    }
    return result;
  }

 private:
  /// Pass 1 asks the worker of every method which version it is before it believes a row. Later passes know.
  bool is_done_before(std::size_t index) const {
    return pass_ > 1 && is_done(plan_, runs_[index], directory_, pass_);
  }

  /// The cases with something to do; of the others no points are drawn.
  void find_cases() {
    for (RunsOfCase one; one.begin < runs_.size(); one.begin = one.end) {
      one.end = one.begin;
      bool done = true;
      while (one.end < runs_.size() && runs_[one.end].case_index == runs_[one.begin].case_index)
        done = is_done_before(one.end++) && done;
      if (!done) cases_.push_back(one);
      for (std::size_t i = one.begin; done && i < one.end; ++i) progress_.finish(i);
    }
  }

  void add_methods() {
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      const plan::PlanMethod& entry = plan_.methods[runs_[i].method_index];
      if (is_done_before(i) || bench_.find(entry.method)) continue;
      bench_.add(options_.find_method(entry.method),
                 {entry.mem_limit_mib.value_or(plan_.mem_limit_mib), options_.worker_core});
    }
  }

  json describe_methods() const {
    json methods = json::array();
    for (const auto& session : bench_.sessions()) methods.push_back(worker::describe_method(*session));
    return methods;
  }

  void check_parameter_names() const {
    for (const plan::PlannedRun& run : runs_) {
      const plan::PlanMethod& method = plan_.methods[run.method_index];
      const worker::MethodSession* session = bench_.find(method.method);
      if (!session || !session->info()) continue;
      for (const auto& given : method.parameters) {
        const std::string& name = given.first;
        const bool known =
            std::any_of(session->info()->parameters.begin(), session->info()->parameters.end(),
                        [&name = name](const ParameterInfo& parameter) { return parameter.name == name; });
        if (!known) {
          throw ConfigurationError("the plan '" + plan_.name + "' gives " + method.method +
                                   " the parameter '" + name +
                                   "', which it does not have; 'hullbench list' shows what it has");
        }
      }
    }
  }

  const plan::PlanCase& case_of(const RunsOfCase& runs) const {
    return plan_.expanded_cases[runs_[runs.begin].case_index];
  }

  /// The cases from the one at `next` in cases_ on that make a batch.
  std::vector<CaseWork> gather_batch(std::size_t next) const {
    const int runs_each =
        untimed_runs(plan_, pass_) + plan::share_of_pass(plan_.repetitions, plan_.passes, pass_);
    std::vector<CaseWork> batch;
    std::int64_t work = 0;
    for (; next < cases_.size(); ++next) {
      const RunsOfCase& runs = cases_[next];
      work += estimated_points(case_of(runs)) * static_cast<std::int64_t>(runs.end - runs.begin) * runs_each;
      if (!batch.empty() && work > kBatchWork) break;
      batch.push_back({runs});
    }
    return batch;
  }

  /// Measures the cases of one batch and returns the place in cases_ of the one behind it.
  std::size_t run_batch(std::size_t next) {
    throw_if_interrupted();
    progress_.begin(cases_[next].begin);
    std::vector<CaseWork> batch = gather_batch(next);
    for_each_in_parallel(batch.size(), options_.cores, [&](std::size_t i) { prepare(batch[i]); });
    try {
      for (CaseWork& one : batch) measure(one);
    } catch (const Interrupted&) {
      settle(batch);
      throw;
    }
    settle(batch);
    return next + batch.size();
  }

  /// Draws a case's points and chooses its parameters; nothing is asked of a worker, as several cases do this
  /// at the same time. Points that cannot be made are its rows' failure, and the other cases are measured.
  void prepare(CaseWork& one) const {
    const plan::PlanCase& plan_case = case_of(one.runs);
    const std::string fault = fault_of(
        [&] { one.drawn = std::make_shared<const DrawnCase>(plan_case, plan_.seed, options_.folders); });
    if (!one.drawn) one.drawn = std::make_shared<const DrawnCase>(plan_case, plan_.seed, fault);
    for (std::size_t i = one.runs.begin; i < one.runs.end; ++i) {
      const plan::PlanMethod& method = plan_.methods[runs_[i].method_index];
      Entry& entry = one.entries.emplace_back(Entry{i, make_run(one.drawn, method)});
      entry.run.record.name = runs_[i].name;
      entry.run.record.protocol = method.protocol;
      entry.run.record.machine = machine_;
    }
  }

  /// Everything that is timed of a case, one worker at a time.
  void measure(CaseWork& one) {
    for (Entry& entry : one.entries) {
      if (is_done_before(entry.index)) {
        leave_as_it_is(entry);
      } else {
        begin(entry);
      }
    }
    for (Entry& entry : one.entries) {
      if (!entry.run.over) run_untimed(entry);
    }
    int first_round = 0;
    for (int earlier = 1; earlier < pass_; ++earlier) first_round += rounds_of(one.entries, earlier);
    for (int turn = 0; turn < rounds_of(one.entries, pass_); ++turn)
      run_round(one.entries, turn, first_round + turn);
    const bool has_parts = plan_.draws > 0 && one.drawn->set().ground_truth.empty();
    for (Entry& entry : one.entries) entry.run.over = entry.run.over || !has_parts;
    if (!has_parts) return;
    run_on_parts(one);
    for (Entry& entry : one.entries) entry.run.over = true;
  }

  /// Runs the methods that gave a result on parts of the points, untimed: who fails there keeps the row, and
  /// the part has no result.
  void run_on_parts(CaseWork& one) {
    const auto is_to_run = [](const Entry& entry) { return !entry.run.over && entry.run.result; };
    if (std::ranges::none_of(one.entries, is_to_run)) return;
    for (int draw = 0; draw < plan_.draws; ++draw) {
      PointParts parts = draw_parts(one.drawn->set().points, case_of(one.runs).dataset, plan_.seed, draw);
      for (Entry& entry : one.entries) entry.run.draws.emplace_back();
      for (const auto& [points, place] : {std::pair{&parts.half, &metrics::PartResults::half},
                                          std::pair{&parts.other_half, &metrics::PartResults::other_half},
                                          std::pair{&parts.most, &metrics::PartResults::most}}) {
        const auto part = std::make_shared<const DrawnCase>(*one.drawn, std::move(*points));
        for (Entry& entry : one.entries) {
          if (is_to_run(entry)) entry.run.draws.back().*place = run_on_part(entry, part);
        }
      }
    }
  }

  std::optional<MultiPolygon> run_on_part(const Entry& entry, const std::shared_ptr<const DrawnCase>& part) {
    progress_.begin(entry.index);
    const plan::PlanMethod& method = method_of(entry);
    MethodRun run = make_run(part, method);
    run.begin(*entry.run.session, entry.run.session->info(), timeout_of(method));
    if (!run.over) bench_.attempt(run);
    return run.result;
  }

  /// Fills in what the worker's first answer tells, and looks for an earlier start's row and repetitions.
  void begin(Entry& entry) {
    MethodRun& run = entry.run;
    worker::MethodSession& session = *bench_.find(run.record.method);
    run.begin(session, session.info(), timeout_of(method_of(entry)));
    const record::RunRecord* earlier = directory_.find_row(run.record.name);
    // A row of a method, or of points, that are not there any more is kept: nothing newer can take its place.
    const bool lost = earlier && (!session.info() || !run.drawn->missing().empty()) &&
                      earlier->status != record::Status::kNotInstalled;
    const bool same = earlier && earlier->id == run.record.id;
    if (lost || (same && is_done(plan_, runs_[entry.index], directory_, pass_))) {
      leave_as_it_is(entry);
    } else if (!run.over) {
      entry.repetitions = directory_.repetitions(run.record.id);
      // What an earlier pass scored is not scored again, as long as all that it timed is there.
      if (same && entry.repetitions.size() >= earlier->time_ns.size()) run.record = *earlier;
    }
  }

  /// Nothing is to be done, and the row is there.
  void leave_as_it_is(Entry& entry) {
    entry.run.over = true;
    entry.is_left = true;
    progress_.finish(entry.index);
  }

  const plan::PlanMethod& method_of(const Entry& entry) const {
    return plan_.methods[runs_[entry.index].method_index];
  }

  double timeout_of(const plan::PlanMethod& method) const {
    return method.timeout_s.value_or(plan_.timeout_s);
  }

  int rounds_of(const std::vector<Entry>& entries, int pass) const {
    int most = 0;
    for (const Entry& entry : entries) most = std::max(most, share_of(plan_, method_of(entry), pass));
    return most;
  }

  /// The untimed runs. Repetitions of an earlier start call for one at least: their result was scored, but
  /// the scores are gone. A later pass, which has the scores, does without them where a run takes long.
  void run_untimed(Entry& entry) {
    MethodRun& run = entry.run;
    const bool is_scored = !run.record.output_sha256.empty() && !entry.repetitions.empty();
    const bool is_long = is_scored && entry.repetitions.back().time_ns >= kLongRun.count();
    const int least = entry.repetitions.empty() ? 0 : 1;
    const int untimed = is_long ? 0 : std::max(untimed_runs(plan_, pass_), least);
    for (int count = 0; count < untimed && !run.over; ++count) attempt_run(entry, worker::Watch::kMemory);
    const auto differs = [&](const Repetition& earlier) {
      return earlier.output_sha256 != run.record.output_sha256;
    };
    if (!run.over && std::ranges::any_of(entry.repetitions, differs)) {
      entry.repetitions.clear();
      run.fail(record::Status::kInvalidOutput,
               "the result is not the one that it gave before the interruption");
    }
  }

  /// The entries that take part in the round of the pass's number `turn`, in random order.
  std::vector<Entry*> draw_turns(std::vector<Entry>& entries, int turn, int round) const {
    std::vector<Entry*> turns(entries.size());
    std::ranges::transform(entries, turns.begin(), [](Entry& entry) { return &entry; });
    // Drawn from the case and the round, so that a run that goes on after an interruption keeps its order.
    const std::string& points = entries.front().run.drawn->set().sha256;
    Random random(derive_seed(plan_.seed, "order/" + points + "/" + std::to_string(round)));
    for (std::size_t i = turns.size(); i > 1; --i) std::swap(turns[i - 1], turns[random.below(i)]);
    std::erase_if(turns, [&](const Entry* entry) {
      const int before = pass_ == 1 ? 0 : repetitions_until(plan_, method_of(*entry), pass_ - 1);
      return entry->run.over || turn >= share_of(plan_, method_of(*entry), pass_) ||
             std::cmp_greater(entry->repetitions.size(), before + turn);
    });
    return turns;
  }

  /// `turn`: the round's number within the pass; `round`: over all passes.
  void run_round(std::vector<Entry>& entries, int turn, int round) {
    const std::vector<Entry*> turns = draw_turns(entries, turn, round);
    if (turns.empty()) return;
    MachineWatch* const machine = options_.machine;
    std::optional<record::CanaryTimes> canary;
    int tries = 0;
    for (bool again = true; again;) {
      ++tries;
      const auto start = std::chrono::steady_clock::now();
      for (Entry* entry : turns) take_turn(*entry, tries);
      if (!machine) break;
      const auto took = std::chrono::steady_clock::now() - start;
      canary = tries == 1 ? machine->recent() : machine->fresh();
      again = machine->wants_again(*canary, tries, took);
    }
    const bool unsteady = machine && machine->is_off(*canary);
    for (Entry* entry : turns) {
      if (!entry->latest) continue;
      Repetition& repetition = *entry->latest;
      repetition.round = round;
      repetition.pass = pass_;
      repetition.canary_ns = canary;
      repetition.remeasured = tries > 1;
      repetition.unsteady = unsteady;
      directory_.append_repetition(entry->run.record.id, entry->repetitions.size(), repetition);
      entry->repetitions.push_back(std::move(repetition));
      entry->latest.reset();
    }
  }

  void take_turn(Entry& entry, int tries) {
    entry.latest.reset();
    if (entry.run.over) return;
    if (tries > 1) progress_.repeat(entry.index);
    const std::optional<worker::Attempt> attempt = attempt_run(entry, worker::Watch::kNothing);
    if (!attempt) return;
    Repetition& repetition = entry.latest.emplace();
    repetition.time_ns = attempt->time_ns();
    repetition.phases_ns = attempt->phases_ns;
    repetition.output_sha256 = entry.run.record.output_sha256;
  }

  /// One attempt in a warm process; none when the run is over with it.
  std::optional<worker::Attempt> attempt_run(Entry& entry, worker::Watch watch) {
    progress_.begin(entry.index);
    MethodRun& run = entry.run;
    bench_.warm_up(run, plan_.warmup > 0 ? run::WarmUpFor::kEachRow : run::WarmUpFor::kProcess);
    if (run.over) return std::nullopt;
    const bool is_first = run.record.output_sha256.empty();
    worker::Attempt attempt = bench_.attempt(run, watch);
    if (options_.keep_polygons && is_first && attempt.status == record::Status::kOk)
      record::keep_polygons(directory_.path(), attempt.wkb);
    if (run.over) return std::nullopt;
    progress_.advance(entry.index, attempt.elapsed);
    return attempt;
  }

  /// Scores what is measured of a batch and writes its rows.
  void settle(std::vector<CaseWork>& batch) {
    std::vector<Entry*> finished;
    for (CaseWork& one : batch) {
      for (Entry& entry : one.entries) {
        if (entry.run.over && !entry.is_left) finished.push_back(&entry);
      }
    }
    // Case by case first: the results of one case would wait for each other.
    for_each_in_parallel(batch.size(), options_.cores, [&](std::size_t i) {
      const std::vector<Entry>& entries = batch[i].entries;
      if (std::ranges::any_of(entries, [](const Entry& entry) { return entry.run.result.has_value(); }))
        batch[i].drawn->prepare_scoring();
    });
    for_each_in_parallel(finished.size(), options_.cores, [&](std::size_t i) { finished[i]->run.score(); });
    std::vector<record::RunRecord> rows;
    rows.reserve(finished.size());
    for (const Entry* entry : finished) rows.push_back(finished_record(*entry));
    // Before the rows: a run that has its row is not measured again, and its picture would be missing.
    for (const Entry* entry : finished) {
      const MethodRun& run = entry->run;
      if (run.result) pictures_.add(run.record, run.drawn->set(), *run.result);
    }
    directory_.append_rows(rows);
    for (std::size_t i = 0; i < rows.size() && options_.on_row; ++i)
      options_.on_row(rows[i], finished[i]->run.result);
    for (const Entry* entry : finished) {
      const record::RunRecord& record = entry->run.record;
      // Of a method that does not start this was said once already.
      if (record.status != record::Status::kOk && entry->run.session->info()) {
        progress_.note("hullbench: " + record.name + ": " + to_string(record.status) + ": " + record.detail);
      }
      progress_.finish(entry->index);
    }
  }

  static record::RunRecord finished_record(const Entry& entry) {
    record::RunRecord record = entry.run.record;
    record.time_ns.clear();
    record.phases_ns.clear();
    record.rounds.clear();
    record.passes.clear();
    record.canary_ns.clear();
    for (const Repetition& repetition : entry.repetitions) {
      record.time_ns.push_back(repetition.time_ns);
      record.phases_ns.push_back(repetition.phases_ns);
      record.rounds.push_back(repetition.round);
      record.passes.push_back(repetition.pass);
      if (repetition.canary_ns) record.canary_ns.push_back(*repetition.canary_ns);
    }
    record.flags = flags_of(record, entry.repetitions);
    return record;
  }

  const plan::Plan& plan_;
  const std::vector<plan::PlannedRun>& runs_;
  const RunnerOptions& options_;
  RunDirectory& directory_;
  Progress& progress_;
  int pass_;
  record::PictureBook pictures_;
  std::vector<RunsOfCase> cases_;  ///< those with something to do
  std::string machine_;            ///< this one's id, for the rows
  Workbench bench_;                ///< of the methods that are needed, as in the plan
};

}  // namespace

RunResult run_plan(const plan::Plan& plan, const std::vector<plan::PlannedRun>& runs, const json& header,
                   const RunnerOptions& options, RunDirectory& directory, Progress& progress, int pass) {
  return Runner(plan, runs, options, directory, progress, pass).run(header);
}

bool has_repetitions(const plan::Plan& plan, const std::vector<plan::PlannedRun>& runs, int pass) {
  return std::ranges::any_of(runs, [&](const plan::PlannedRun& run) {
    return share_of(plan, plan.methods[run.method_index], pass) > 0;
  });
}

std::size_t count_finished(const plan::Plan& plan, const std::vector<plan::PlannedRun>& runs,
                           const RunDirectory& directory) {
  return static_cast<std::size_t>(std::ranges::count_if(
      runs, [&](const plan::PlannedRun& run) { return is_done(plan, run, directory, plan.passes); }));
}

std::int64_t estimated_points(const plan::PlanCase& plan_case) {
  constexpr std::int64_t kPointsOfAFloor = 80'000;
  if (plan_case.n > 0) return plan_case.n;
  for (const DegenerateInput& input : degenerate_inputs()) {
    // Of no point at all there is still the way to the worker and back.
    if (input.name == plan_case.dataset)
      return std::max<std::int64_t>(100, static_cast<std::int64_t>(input.points.size()));
  }
  return kPointsOfAFloor;
}

std::vector<ProgressRun> progress_runs(const plan::Plan& plan, const std::vector<plan::PlannedRun>& runs,
                                       int pass) {
  std::vector<ProgressRun> result;
  result.reserve(runs.size());
  for (const plan::PlannedRun& run : runs) {
    const plan::PlanMethod& method = plan.methods[run.method_index];
    const int share = share_of(plan, method, pass);
    result.push_back({run.name, method.method, estimated_points(plan.expanded_cases[run.case_index]),
                      share == 0 ? 0 : untimed_runs(plan, pass) + share});
  }
  return result;
}

void count_row(RunResult& result, record::Status status, const std::vector<std::string>& accepted) {
  const bool good =
      status != record::Status::kOk && std::ranges::find(accepted, to_string(status)) != accepted.end();
  ++(good ? result.accepted : result.counts[status]);
}

ExitCode exit_code(const RunResult& result) {
  if (result.interrupted) return kExitInterrupted;
  int measured = result.accepted;
  for (const auto& [status, count] : result.counts) {
    if (status == record::Status::kNotInstalled || status == record::Status::kUnsupported || count == 0)
      continue;
    if (status != record::Status::kOk) return kExitFailures;
    measured += count;
  }
  return measured > 0 ? kExitOk : kExitNothing;
}

}  // namespace hullbench::run
