#include "benchmarks/choose/candidates.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <utility>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/base/files.hpp"
#include "benchmarks/base/interrupt.hpp"
#include "benchmarks/base/parallel.hpp"
#include "benchmarks/base/scratch_folder.hpp"
#include "benchmarks/base/words.hpp"
#include "benchmarks/metrics/agreement.hpp"
#include "benchmarks/run/run_directory.hpp"
#include "datasets/data_folder.hpp"
#include "datasets/datasets.hpp"
#include "tool/shapes/polygon_writers.hpp"

namespace hullbench::choose {
namespace {

/// The metric that draws of halves give.
constexpr const char* kStability = "agreement_halves";

bool knows_more_than_the_points(const plan::PlanMethod& entry) {
  return entry.protocol != "default" && entry.protocol != "auto";
}

bool fits(const plan::PlanMethod& entry, const std::string& name) {
  return name == entry.method || name == entry.method + "/" + entry.protocol;
}

/// The methods of manifests that the plan does not name, as the user's own may be.
void add_methods_of_manifests(Question& question, const run::MethodCatalog& catalog) {
  std::vector<plan::PlanMethod>& entries = question.plan.methods;
  for (const worker::Method& method : catalog.methods()) {
    const auto is_it = [&](const plan::PlanMethod& entry) { return entry.method == method.name; };
    if (!method.info || std::ranges::any_of(entries, is_it)) continue;
    try {
      for (const plan::PlanMethod& entry : catalog.runs_of(method.name)) entries.push_back(entry);
    } catch (const ConfigurationError& error) {
      question.absent.push_back(sentence(error.what()));
    }
  }
}

/// The points as the recording of a user, which the plan `real` takes beside its own sets.
void write_recording(std::span<const Point> points, const fs::path& scene) {
  fs::create_directories(scene);
  std::string text;
  for (const Point& point : points) {
    throw_if_interrupted();
    text += polylidar::tool::shortest(point.x) + " " + polylidar::tool::shortest(point.y) + "\n";
  }
  write_text_file(scene / "points.txt", text);
}

bool is_of(const record::RunRecord& record, const plan::PlanMethod& entry) {
  return record.method == entry.method && record.protocol == entry.protocol;
}

Candidate make_candidate(const record::RunRecord& record, const std::optional<MultiPolygon>& result,
                         const plan::Plan& plan, const run::MethodCatalog& catalog, std::size_t points) {
  const auto entry =
      std::ranges::find_if(plan.methods, [&](const plan::PlanMethod& one) { return is_of(record, one); });
  Parameters given;
  for (const auto& [name, choice] : entry->parameters) {
    const auto value = record.parameters.find(name);
    if (value != record.parameters.end()) given.insert(*value);
  }
  return {catalog.find(record.method).title + " (" + record.protocol + ")",
          entry->note,
          given,
          points,
          record,
          result};
}

void find_ious(std::vector<Candidate>& all, const std::vector<int>& cores) {
  const std::size_t count = all.size();
  for (Candidate& candidate : all) candidate.iou.resize(count);
  for_each_in_parallel(count * count, cores, [&](std::size_t pair) {
    Candidate& a = all[pair / count];
    Candidate& b = all[pair % count];
    if (&a > &b || !a.succeeded() || !b.succeeded()) return;
    throw_if_interrupted();
    a.iou[pair % count] = metrics::intersection_over_union(*a.result, *b.result);
    if (&a != &b) b.iou[pair / count] = a.iou[pair % count];
  });
}

std::optional<double> agreement_of(const Candidate& candidate, const std::vector<Candidate>& all) {
  double sum = 0;
  double count = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!candidate.iou[i] || candidate.is_same_as(i)) continue;
    // Of those with the same polygons the first one speaks.
    bool is_first = true;
    for (std::size_t other = 0; other < i; ++other) is_first = is_first && !all[i].is_same_as(other);
    if (!is_first) continue;
    sum += *candidate.iou[i];
    ++count;
  }
  return count > 0 ? std::optional(sum / count) : std::nullopt;
}

/// What is shown decides, so that rounding does not.
double shown_agreement(const Candidate& candidate) {
  if (!candidate.succeeded()) return -2;
  return candidate.agreement ? std::round(1000 * *candidate.agreement) : -1;
}

void sort_by_agreement(std::vector<Candidate>& all) {
  std::vector<std::size_t> order(all.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) {
    const double first = shown_agreement(all[a]);
    const double second = shown_agreement(all[b]);
    return first != second ? first > second : all[a].label < all[b].label;
  });
  std::vector<Candidate> sorted;
  for (const std::size_t place : order) {
    Candidate& candidate = sorted.emplace_back(std::move(all[place]));
    const std::vector<std::optional<double>> iou = candidate.iou;
    for (std::size_t i = 0; i < order.size(); ++i) candidate.iou[i] = iou[order[i]];
  }
  all = std::move(sorted);
}

using MakeProgress = run::Progress (*)(std::vector<run::ProgressSection>);

Candidates run_on(const Question& question, std::span<const Point> points, const run::MethodCatalog& catalog,
                  const Cores& cores, MakeProgress make_progress) {
  const ScratchFolder scratch("hullbench-choose");
  const DataFolders folders(default_data_directory(), scratch.path() / "recordings");
  write_recording(points, folders.recordings / "points");
  plan::Plan plan = question.plan;
  plan::use_recordings(plan, 1);
  plan::check_plan(plan, catalog.names(), datasets(folders));
  const std::vector<plan::PlannedRun> runs =
      plan::planned_runs(plan, std::string("/") + kRealRecording + "-1/");

  const fs::path run_folder = scratch.path() / "run";
  fs::create_directory(run_folder);
  run::RunDirectory directory(run_folder, run::lock_or_throw(run_folder));
  run::Progress progress = make_progress({{"", run::progress_runs(plan, runs)}});
  Candidates candidates;
  candidates.absent = question.absent;
  run::RunnerOptions options = {[&](const std::string& name) { return catalog.find(name); }, cores.worker,
                                cores.all, folders};
  options.on_row = [&](const record::RunRecord& record, const std::optional<MultiPolygon>& result) {
    if (record.status != record::Status::kNotInstalled) {
      candidates.all.push_back(make_candidate(record, result, plan, catalog, points.size()));
      return;
    }
    const std::string why = catalog.find(record.method).title + ": " + sentence(record.detail);
    if (std::ranges::find(candidates.absent, why) == candidates.absent.end())
      candidates.absent.push_back(why);
  };
  const json header = {{"environment", {{"machine_id", ""}}}};
  candidates.outcome = run::run_plan(plan, runs, header, options, directory, progress);
  progress.end();
  if (candidates.outcome.interrupted) throw Interrupted();
  return candidates;
}

/// Whether the method can be expected to end in time on `all` points.
bool is_fast_enough(const Candidate& candidate, std::size_t all, double timeout_s) {
  if (!candidate.succeeded() || candidate.record.time_ns.empty()) return false;
  const auto work = [](std::size_t n) { return static_cast<double>(n) * std::log(static_cast<double>(n)); };
  const double time_s = static_cast<double>(candidate.record.time_ns.front()) / 1e9;
  return time_s * work(all) / work(candidate.points) < timeout_s;
}

/// Puts results of all points in the place of those of a sample, as compare() says.
void take_all(Candidates& candidates, const Question& question, std::span<const Point> all,
              const run::MethodCatalog& catalog, const Cores& cores, MakeProgress make_progress) {
  Question fast = question;
  fast.plan.draws = 0;
  std::erase_if(fast.plan.methods, [&](const plan::PlanMethod& entry) {
    return std::ranges::none_of(candidates.all, [&](const Candidate& candidate) {
      return is_of(candidate.record, entry) && is_fast_enough(candidate, all.size(), question.plan.timeout_s);
    });
  });
  if (fast.plan.methods.empty()) return;
  Candidates of_all = run_on(fast, all, catalog, cores, make_progress);
  for (Candidate& candidate : of_all.all) {
    if (!candidate.succeeded()) continue;
    const auto of_sample = std::ranges::find_if(candidates.all, [&](const Candidate& other) {
      return other.record.method == candidate.record.method &&
             other.record.protocol == candidate.record.protocol;
    });
    const auto stability = of_sample->record.metrics.find(kStability);
    if (stability != of_sample->record.metrics.end()) candidate.record.metrics[kStability] = *stability;
    *of_sample = std::move(candidate);
  }
}

}  // namespace

Question ask(const run::MethodCatalog& catalog, const std::vector<std::string>& only) {
  Question question;
  question.plan = plan::load_plan("real", data_folder() / "benchmarks" / "plans");
  add_methods_of_manifests(question, catalog);
  std::vector<plan::PlanMethod>& entries = question.plan.methods;
  std::erase_if(entries, &knows_more_than_the_points);
  if (only.empty()) return question;
  question.absent.clear();
  std::vector<std::string> known;
  known.reserve(entries.size());
  for (const plan::PlanMethod& entry : entries) known.push_back(entry.method + "/" + entry.protocol);
  for (const std::string& name : only) {
    const auto is_it = [&](const plan::PlanMethod& entry) { return fits(entry, name); };
    if (std::ranges::any_of(entries, is_it)) continue;
    throw ConfigurationError("--only: there is no method '" + name +
                             "' that chooses its parameters without the user; known are " +
                             join_words(known));
  }
  std::erase_if(entries, [&](const plan::PlanMethod& entry) {
    return std::ranges::none_of(only, [&](const std::string& name) { return fits(entry, name); });
  });
  return question;
}

Candidates compare(const Question& question, std::span<const Point> points, std::span<const Point> all,
                   const run::MethodCatalog& catalog, const Cores& cores, MakeProgress make_progress) {
  Candidates candidates = run_on(question, points, catalog, cores, make_progress);
  if (all.size() > points.size()) take_all(candidates, question, all, catalog, cores, make_progress);

  find_ious(candidates.all, cores.all);
  for (Candidate& candidate : candidates.all) {
    if (candidate.succeeded()) candidate.agreement = agreement_of(candidate, candidates.all);
  }
  sort_by_agreement(candidates.all);
  return candidates;
}

}  // namespace hullbench::choose
