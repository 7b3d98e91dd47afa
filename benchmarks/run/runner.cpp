#include "benchmarks/run/runner.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/base/interrupt.hpp"
#include "benchmarks/base/parallel.hpp"
#include "benchmarks/record/kept_polygons.hpp"
#include "benchmarks/record/pictures.hpp"
#include "benchmarks/run/drawn_case.hpp"
#include "benchmarks/run/point_parts.hpp"
#include "datasets/degenerate.hpp"
#include "datasets/random.hpp"

namespace hullbench::run {
namespace {

using nlohmann::json;

/// One run on its way to its row.
struct Entry {
  std::size_t index = 0;  ///< into the planned runs
  worker::MethodSession* session = nullptr;
  record::RunRecord record;
  std::vector<Repetition> repetitions;            ///< of all passes
  std::optional<Repetition> latest;               ///< of the round that is not over
  std::optional<MultiPolygon> result;             ///< of the first run; none while there is none to score
  std::vector<metrics::PartResults> draws;        ///< what parts of the points gave, where the plan asks
  std::optional<std::int64_t> peak_memory_bytes;  ///< the largest of the untimed runs
  bool measured = false;                          ///< nothing is left to run
  bool settled = false;                           ///< its row is written
};

/// The runs of one case, and what they are run on.
struct CaseWork {
  const plan::PlanCase* plan_case = nullptr;
  std::unique_ptr<const DrawnCase> drawn;
  std::vector<Entry> entries;
};

/// A batch holds cases for about so many points times runs: 62 of the random polygons, which are worth
/// drawing and scoring in parallel, but one of the largest state shapes, as little is to be lost when the
/// machine stops.
constexpr std::int64_t kBatchWork = 1'000'000;

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
  const auto any = [&](auto is_so) { return std::any_of(repetitions.begin(), repetitions.end(), is_so); };
  const double floor = record::kFloorNsPerPoint * static_cast<double>(record.n);
  std::vector<std::string> flags;
  if (any([&](const Repetition& one) { return static_cast<double>(one.time_ns) < floor; }))
    flags.emplace_back(record::kFasterThanFloor);
  if (any([](const Repetition& one) { return one.remeasured; })) flags.emplace_back(record::kRemeasuredRound);
  if (any([](const Repetition& one) { return one.unsteady; })) flags.emplace_back(record::kUnsteadyMachine);
  if (record::is_worse_than_convex_hull(record.metrics)) flags.emplace_back(record::kWorseThanConvexHull);
  return flags;
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
        pictures_(directory.path(), runs.size()) {}

  RunResult run(json header) {
    RunResult result;
    if (!header.contains("methods")) header["methods"] = json::array();
    machine_ = header.at("environment").at("machine_id").get<std::string>();
    try {
      // Before anything can be interrupted, so that the folder is known for what it is.
      if (pass_ == 1) directory_.write_header(header);
      find_cases();
      make_sessions();
      start_workers(sessions_, progress_);
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
  /// The runs of one case: indices into runs_, the last one not included.
  struct CaseRuns {
    std::size_t begin = 0;
    std::size_t end = 0;
  };

  /// Pass 1 asks the worker of every method which version it is before it believes a row. Later passes know.
  bool is_done_before(std::size_t index) const {
    return pass_ > 1 && is_done(plan_, runs_[index], directory_, pass_);
  }

  /// The cases with something to do; of the others no points are drawn.
  void find_cases() {
    for (CaseRuns one; one.begin < runs_.size(); one.begin = one.end) {
      one.end = one.begin;
      bool done = true;
      while (one.end < runs_.size() && runs_[one.end].case_index == runs_[one.begin].case_index)
        done = is_done_before(one.end++) && done;
      if (!done) cases_.push_back(one);
      for (std::size_t i = one.begin; done && i < one.end; ++i) progress_.finish(i);
    }
  }

  worker::MethodSession* find_session(const std::string& method) const {
    const auto found = std::find_if(sessions_.begin(), sessions_.end(),
                                    [&](const auto& session) { return session->method().name == method; });
    return found == sessions_.end() ? nullptr : found->get();
  }

  void make_sessions() {
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      const plan::PlanMethod& entry = plan_.methods[runs_[i].method_index];
      if (is_done_before(i) || find_session(entry.method)) continue;
      const worker::WorkerLimits limits = {entry.mem_limit_mib.value_or(plan_.mem_limit_mib),
                                           options_.worker_core};
      sessions_.push_back(
          std::make_unique<worker::MethodSession>(options_.find_method(entry.method), limits));
    }
  }

  json describe_methods() const {
    json methods = json::array();
    for (const auto& session : sessions_) methods.push_back(worker::describe_method(*session));
    return methods;
  }

  void check_parameter_names() const {
    for (const plan::PlannedRun& run : runs_) {
      const plan::PlanMethod& method = plan_.methods[run.method_index];
      const worker::MethodSession* session = find_session(method.method);
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

  /// The cases from the one at `next` in cases_ on that make a batch.
  std::vector<CaseWork> gather_batch(std::size_t next) const {
    const int runs_each = plan_.warmup + plan::share_of_pass(plan_.repetitions, plan_.passes, pass_);
    std::vector<CaseWork> batch;
    std::int64_t work = 0;
    for (; next < cases_.size(); ++next) {
      const CaseRuns& runs = cases_[next];
      const plan::PlanCase& plan_case = plan_.expanded_cases[runs_[runs.begin].case_index];
      work += estimated_points(plan_case) * static_cast<std::int64_t>(runs.end - runs.begin) * runs_each;
      if (!batch.empty() && work > kBatchWork) break;
      CaseWork& one = batch.emplace_back();
      one.plan_case = &plan_case;
      for (std::size_t i = runs.begin; i < runs.end; ++i) one.entries.emplace_back().index = i;
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
  /// at the same time.
  void prepare(CaseWork& one) const {
    one.drawn = std::make_unique<DrawnCase>(*one.plan_case, plan_.seed, options_.folders);
    for (Entry& entry : one.entries) {
      const plan::PlanMethod& method = method_of(entry);
      record::RunRecord& record = entry.record;
      record = one.drawn->record_of(method.method);
      record.name = runs_[entry.index].name;
      record.protocol = method.protocol;
      record.machine = machine_;
      if (one.drawn->missing().empty()) record.parameters = one.drawn->choose_parameters(method);
    }
  }

  /// Everything that is timed of a case, one worker at a time.
  void measure(CaseWork& one) {
    for (Entry& entry : one.entries) {
      if (is_done_before(entry.index)) {
        leave_as_it_is(entry);
        continue;
      }
      entry.session = find_session(entry.record.method);
      complete(entry, one.drawn->missing());
    }
    if (std::all_of(one.entries.begin(), one.entries.end(),
                    [](const Entry& entry) { return entry.measured; }))
      return;
    const worker::LoadedPoints points =
        worker::write_points(one.drawn->set().sha256, one.drawn->set().points, directory_.scratch());
    for (Entry& entry : one.entries) {
      if (!entry.measured) warm_up(entry, points);
    }
    int first_round = 0;
    for (int earlier = 1; earlier < pass_; ++earlier) first_round += rounds_of(one.entries, earlier);
    for (int turn = 0; turn < rounds_of(one.entries, pass_); ++turn)
      run_round(one.entries, turn, first_round + turn, points);
    const bool has_parts = plan_.draws > 0 && one.drawn->set().ground_truth.empty();
    for (Entry& entry : one.entries) {
      // Without a warm-up, one untimed run after the timed ones, which must give the same result.
      if (plan_.warmup == 0 && pass_ == 1 && !entry.measured)
        attempt_run(entry, points, worker::Watch::kMemory);
      entry.measured = entry.measured || !has_parts;
    }
    if (!has_parts) return;
    run_on_parts(one);
    for (Entry& entry : one.entries) entry.measured = true;
  }

  /// Runs the methods that gave a result on parts of the points, untimed: who fails there keeps the row, and
  /// the part has no result.
  void run_on_parts(CaseWork& one) {
    const auto is_to_run = [](const Entry& entry) { return !entry.measured && entry.result; };
    if (std::none_of(one.entries.begin(), one.entries.end(), is_to_run)) return;
    for (int draw = 0; draw < plan_.draws; ++draw) {
      PointParts parts = draw_parts(one.drawn->set().points, one.plan_case->dataset, plan_.seed, draw);
      for (Entry& entry : one.entries) entry.draws.emplace_back();
      for (const auto& [points, place] : {std::pair{&parts.half, &metrics::PartResults::half},
                                          std::pair{&parts.other_half, &metrics::PartResults::other_half},
                                          std::pair{&parts.most, &metrics::PartResults::most}}) {
        const DrawnCase part(*one.drawn, std::move(*points));
        const worker::LoadedPoints loaded =
            worker::write_points(part.set().sha256, part.set().points, directory_.scratch());
        for (Entry& entry : one.entries) {
          if (is_to_run(entry)) entry.draws.back().*place = run_on_part(entry, part, loaded);
        }
      }
    }
  }

  std::optional<MultiPolygon> run_on_part(const Entry& entry, const DrawnCase& part,
                                          const worker::LoadedPoints& points) {
    progress_.begin(entry.index);
    const plan::PlanMethod& method = method_of(entry);
    record::RunRecord record = part.record_of(method.method);
    record.parameters = part.choose_parameters(method);
    complete_record(record, *entry.session->info());
    const worker::Attempt attempt =
        entry.session->run(points, record.parameters, directory_.scratch(),
                           to_timeout(method.timeout_s.value_or(plan_.timeout_s)));
    return attempt.status == record::Status::kOk ? read_result(record, attempt.wkb) : std::nullopt;
  }

  /// Fills in what the worker's first answer tells, and looks for an earlier start's row and repetitions.
  /// `missing`: why there are no points; empty when there are.
  void complete(Entry& entry, const std::string& missing) {
    record::RunRecord& record = entry.record;
    const auto& info = entry.session->info();
    if (info && missing.empty()) complete_record(record, *info);
    if (info) record.method_version = info->version;
    record.id = record::run_identity(record);
    const record::RunRecord* earlier = directory_.find_row(record.name);
    // A row of a method, or of points, that are not there any more is kept: nothing newer can take its place.
    const bool lost =
        earlier && (!info || !missing.empty()) && earlier->status != record::Status::kNotInstalled;
    const bool same = earlier && earlier->id == record.id;
    if (lost || (same && is_done(plan_, runs_[entry.index], directory_, pass_))) {
      leave_as_it_is(entry);
    } else if (!info) {
      fail(entry, entry.session->start_reply().status, entry.session->start_failure());
    } else if (!missing.empty()) {
      fail(entry, record::Status::kNotInstalled, missing);
    } else if (record.status != record::Status::kOk) {
      entry.measured = true;
    } else {
      entry.repetitions = directory_.repetitions(record.id);
      // What an earlier pass scored is not scored again, as long as all that it timed is there.
      if (same && entry.repetitions.size() >= earlier->time_ns.size()) record = *earlier;
    }
  }

  /// Nothing is to be done, and the row is there.
  void leave_as_it_is(Entry& entry) {
    entry.measured = true;
    entry.settled = true;
    progress_.finish(entry.index);
  }

  const plan::PlanMethod& method_of(const Entry& entry) const {
    return plan_.methods[runs_[entry.index].method_index];
  }

  int rounds_of(const std::vector<Entry>& entries, int pass) const {
    int most = 0;
    for (const Entry& entry : entries) most = std::max(most, share_of(plan_, method_of(entry), pass));
    return most;
  }

  /// The untimed runs. Repetitions of an earlier start call for one at least: their result was scored, but
  /// the scores are gone. A later pass, which has the scores, does without them where a run takes long.
  void warm_up(Entry& entry, const worker::LoadedPoints& points) {
    const bool is_scored = !entry.record.output_sha256.empty() && !entry.repetitions.empty();
    const bool is_long = is_scored && entry.repetitions.back().time_ns >= kLongRun.count();
    const int untimed = is_long ? 0 : std::max(plan_.warmup, entry.repetitions.empty() ? 0 : 1);
    for (int count = 0; count < untimed && !entry.measured; ++count) {
      attempt_run(entry, points, worker::Watch::kMemory);
    }
    const auto differs = [&](const Repetition& earlier) {
      return earlier.output_sha256 != entry.record.output_sha256;
    };
    if (!entry.measured && std::any_of(entry.repetitions.begin(), entry.repetitions.end(), differs)) {
      entry.repetitions.clear();
      fail(entry, record::Status::kInvalidOutput,
           "the result is not the one that it gave before the interruption");
    }
  }

  /// The entries that take part in the round of the pass's number `turn`, in random order.
  std::vector<Entry*> draw_turns(std::vector<Entry>& entries, int turn, int round,
                                 const worker::LoadedPoints& points) const {
    std::vector<Entry*> turns;
    for (Entry& entry : entries) turns.push_back(&entry);
    // Drawn from the case and the round, so that a run that goes on after an interruption keeps its order.
    Random random(derive_seed(plan_.seed, "order/" + points.key + "/" + std::to_string(round)));
    for (std::size_t i = turns.size(); i > 1; --i) std::swap(turns[i - 1], turns[random.below(i)]);
    std::erase_if(turns, [&](const Entry* entry) {
      const int before = pass_ == 1 ? 0 : repetitions_until(plan_, method_of(*entry), pass_ - 1);
      return entry->measured || turn >= share_of(plan_, method_of(*entry), pass_) ||
             std::cmp_greater(entry->repetitions.size(), before + turn);
    });
    return turns;
  }

  /// `turn`: the round's number within the pass; `round`: over all passes.
  void run_round(std::vector<Entry>& entries, int turn, int round, const worker::LoadedPoints& points) {
    const std::vector<Entry*> turns = draw_turns(entries, turn, round, points);
    if (turns.empty()) return;
    MachineWatch* const machine = options_.machine;
    std::optional<record::CanaryTimes> canary;
    int tries = 0;
    for (bool again = true; again;) {
      ++tries;
      const auto start = std::chrono::steady_clock::now();
      for (Entry* entry : turns) take_turn(*entry, tries, points);
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
      directory_.append_repetition(entry->record.id, entry->repetitions.size(), repetition);
      entry->repetitions.push_back(std::move(repetition));
      entry->latest.reset();
    }
  }

  void take_turn(Entry& entry, int tries, const worker::LoadedPoints& points) {
    entry.latest.reset();
    if (entry.measured) return;
    if (tries > 1) progress_.repeat(entry.index);
    const std::optional<worker::Attempt> attempt = attempt_run(entry, points, worker::Watch::kNothing);
    if (!attempt) return;
    Repetition& repetition = entry.latest.emplace();
    repetition.time_ns = attempt->time_ns();
    repetition.phases_ns = attempt->phases_ns;
    repetition.output_sha256 = entry.record.output_sha256;
  }

  /// One run. The first one's result is kept to be scored, and every other one must give it again; without a
  /// value when the run failed, and nothing more is measured of the entry then.
  std::optional<worker::Attempt> attempt_run(Entry& entry, const worker::LoadedPoints& points,
                                             worker::Watch watch) {
    progress_.begin(entry.index);
    const auto timeout = to_timeout(method_of(entry).timeout_s.value_or(plan_.timeout_s));
    if (entry.session->is_cold()) {
      const worker::Attempt cold =
          entry.session->warm_up(points, entry.record.parameters, directory_.scratch(), timeout);
      if (cold.status != record::Status::kOk) {
        fail(entry, cold.status, cold.detail);
        return std::nullopt;
      }
      if (!entry.record.cold_time_ns) entry.record.cold_time_ns = cold.time_ns();
    }
    worker::Attempt attempt =
        entry.session->run(points, entry.record.parameters, directory_.scratch(), timeout, watch);
    entry.peak_memory_bytes = std::max(entry.peak_memory_bytes, attempt.peak_memory_bytes);
    if (attempt.status != record::Status::kOk) {
      fail(entry, attempt.status, attempt.detail);
      return std::nullopt;
    }
    const std::string hash = record::hash_of(attempt.wkb);
    if (entry.record.output_sha256.empty()) {
      entry.record.output_sha256 = hash;
      entry.result = read_result(entry.record, attempt.wkb);
      entry.measured = !entry.result;
      if (options_.keep_polygons) record::keep_polygons(directory_.path(), attempt.wkb);
    }
    if (!entry.measured && entry.record.output_sha256 != hash) {
      fail(entry, record::Status::kInvalidOutput, "two runs on the same points gave different results");
    }
    if (entry.measured) return std::nullopt;
    progress_.advance(entry.index, attempt.elapsed);
    return attempt;
  }

  static void fail(Entry& entry, record::Status status, const std::string& detail) {
    entry.record.status = status;
    entry.record.detail = detail;
    entry.measured = true;
  }

  /// Scores what is measured of a batch and writes its rows.
  void settle(std::vector<CaseWork>& batch) {
    std::vector<std::pair<Entry*, const DrawnCase*>> finished;
    for (CaseWork& one : batch) {
      for (Entry& entry : one.entries) {
        if (entry.measured && !entry.settled) finished.emplace_back(&entry, one.drawn.get());
      }
    }
    // Case by case first: the results of one case would wait for each other.
    for_each_in_parallel(batch.size(), options_.cores, [&](std::size_t i) {
      const std::vector<Entry>& entries = batch[i].entries;
      if (std::any_of(entries.begin(), entries.end(),
                      [](const Entry& entry) { return entry.result.has_value(); }))
        batch[i].drawn->prepare_scoring();
    });
    for_each_in_parallel(finished.size(), options_.cores, [&](std::size_t i) {
      const auto& [entry, drawn] = finished[i];
      if (entry->result) drawn->score(entry->record, *entry->result, entry->peak_memory_bytes, entry->draws);
    });
    std::vector<record::RunRecord> rows;
    rows.reserve(finished.size());
    for (const auto& [entry, drawn] : finished) rows.push_back(finished_record(*entry));
    // Before the rows: a run that has its row is not measured again, and its picture would be missing.
    for (const auto& [entry, drawn] : finished) {
      if (entry->result) pictures_.add(entry->record, drawn->set(), *entry->result);
    }
    directory_.append_rows(rows);
    for (std::size_t i = 0; i < rows.size() && options_.on_row; ++i)
      options_.on_row(rows[i], finished[i].first->result);
    for (const auto& [entry, drawn] : finished) {
      entry->settled = true;
      const record::RunRecord& record = entry->record;
      // Of a method that does not start this was said once already.
      if (record.status != record::Status::kOk && entry->session->info()) {
        progress_.note("hullbench: " + record.name + ": " + to_string(record.status) + ": " + record.detail);
      }
      progress_.finish(entry->index);
    }
  }

  static record::RunRecord finished_record(const Entry& entry) {
    record::RunRecord record = entry.record;
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
  std::vector<CaseRuns> cases_;  ///< those with something to do
  std::string machine_;          ///< this one's id, for the rows
  std::vector<std::unique_ptr<worker::MethodSession>>
      sessions_;  ///< of the methods that are needed, as in the plan
};

}  // namespace

RunResult run_plan(const plan::Plan& plan, const std::vector<plan::PlannedRun>& runs, const json& header,
                   const RunnerOptions& options, RunDirectory& directory, Progress& progress, int pass) {
  return Runner(plan, runs, options, directory, progress, pass).run(header);
}

void start_workers(const std::vector<std::unique_ptr<worker::MethodSession>>& sessions, Progress& progress) {
  for (const auto& session : sessions) session->begin_start();
  for (const auto& session : sessions) {
    session->finish_start();
    if (session->info()) continue;
    progress.note("hullbench: " + session->method().name + " does not start (" +
                  to_string(session->start_reply().status) + "): " + session->start_failure());
  }
}

bool has_repetitions(const plan::Plan& plan, const std::vector<plan::PlannedRun>& runs, int pass) {
  return std::any_of(runs.begin(), runs.end(), [&](const plan::PlannedRun& run) {
    return share_of(plan, plan.methods[run.method_index], pass) > 0;
  });
}

std::size_t count_finished(const plan::Plan& plan, const std::vector<plan::PlannedRun>& runs,
                           const RunDirectory& directory) {
  return static_cast<std::size_t>(std::count_if(runs.begin(), runs.end(), [&](const plan::PlannedRun& run) {
    return is_done(plan, run, directory, plan.passes);
  }));
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
                      share == 0 ? 0 : plan.warmup + share});
  }
  return result;
}

void count_row(RunResult& result, record::Status status, const std::vector<std::string>& accepted) {
  const bool good = status != record::Status::kOk &&
                    std::find(accepted.begin(), accepted.end(), to_string(status)) != accepted.end();
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
