#include "benchmarks/run/drawn_case.hpp"

#include <exception>
#include <stdexcept>
#include <utility>

#include "adapters/wkb.hpp"
#include "benchmarks/base/interrupt.hpp"
#include "benchmarks/metrics/metric_table.hpp"
#include "benchmarks/worker/protocol.hpp"
#include "datasets/point_bytes.hpp"
#include "datasets/real/real_points.hpp"
#include "datasets/sha256.hpp"

namespace hullbench::run {
namespace {

PointSet set_of(std::vector<Point> points) {
  PointSet set;
  set.sha256 = sha256_hex(point_bytes(points));
  set.points = std::move(points);
  return set;
}

}  // namespace

DrawnCase::DrawnCase(const plan::PlanCase& plan_case, std::uint64_t seed, const DataFolders& folders)
    : plan_case_(plan_case), seed_(seed) {
  try {
    set_ = make_point_set(plan_case.dataset, plan_case.holes, static_cast<std::size_t>(plan_case.n), seed,
                          folders);
  } catch (const real::NotInstalled& error) {
    set_ = set_of({});
    missing_ = error.what();
  }
}

DrawnCase::DrawnCase(const plan::PlanCase& plan_case, std::uint64_t seed, const std::string& fault)
    : plan_case_(plan_case),
      seed_(seed),
      set_(set_of({})),
      missing_("there are no points: " + fault),
      missing_status_(record::Status::kError) {}

DrawnCase::DrawnCase(const DrawnCase& whole, std::vector<Point> part)
    : plan_case_(whole.plan_case_), seed_(whole.seed_), set_(set_of(std::move(part))) {}

Parameters DrawnCase::choose_parameters(const plan::PlanMethod& method) const {
  if (!missing_.empty()) return {};
  return plan::choose_parameters(method, plan_case_,
                                 {set_.points, set_.ground_truth_area, plan_case_.holes, set_.ground_truth});
}

record::RunRecord DrawnCase::record_of(const std::string& method) const {
  record::RunRecord record;
  record.method = method;
  record.dataset = plan_case_.dataset;
  record.levels = levels_of(record.dataset);
  if (const std::string base = base_shape(record.dataset); base != record.dataset) record.base_shape = base;
  record.dataset_sha256 = set_.sha256;
  record.n = static_cast<std::int64_t>(set_.points.size());
  record.holes = plan_case_.holes;
  record.seed = seed_;
  return record;
}

void DrawnCase::prepare_scoring() const {
  std::call_once(scoring_is_prepared_, [this] {
    if (set_.ground_truth.empty()) return;
    try {
      scorer_.emplace(set_.points, set_.ground_truth);
    } catch (const std::exception& error) {
      scorer_fault_ = error.what();
    }
  });
}

const metrics::CaseScorer& DrawnCase::scorer() const {
  prepare_scoring();
  if (!scorer_) throw std::runtime_error(scorer_fault_);
  return *scorer_;
}

template <typename Scores>
void DrawnCase::score_with(record::RunRecord& record, Scores scores_of) const {
  std::string fault;
  record::Status status = record::Status::kInvalidOutput;
  try {
    const metrics::AreaScores scores = scores_of();
    if (scores.valid) return;
    fault = kInvalidPolygon + scores.invalid_reason;
  } catch (const Interrupted&) {
    throw;
  } catch (const std::exception& error) {
    status = record::Status::kError;
    fault = kNoScore + std::string(error.what());
  }
  // A run that failed later keeps its own reason.
  if (record.status != record::Status::kOk) return;
  record.status = status;
  record.detail = fault;
}

void DrawnCase::score(record::RunRecord& record, const MultiPolygon& result,
                      std::optional<std::int64_t> peak_memory_bytes,
                      std::span<const metrics::PartResults> draws) const {
  score_with(record, [&] {
    metrics::Metrics metrics = set_.ground_truth.empty()
                                   ? metrics::describe(set_.points, result, set_.window, draws)
                                   : scorer().score(result);
    metrics.peak_memory_bytes = peak_memory_bytes;
    record.metrics = metrics::metrics_to_json(metrics);
    return metrics.area;
  });
}

void DrawnCase::score_l2(record::RunRecord& record, const MultiPolygon& result) const {
  score_with(record, [&] {
    metrics::AreaScores scores = scorer().area_scores(result);
    if (scores.l2) record.metrics["l2"] = *scores.l2;
    return scores;
  });
}

std::optional<MultiPolygon> read_result(record::RunRecord& record, const std::vector<std::uint8_t>& wkb) {
  try {
    return from_wkb(wkb);
  } catch (const std::exception& error) {
    record.status = record::Status::kInvalidOutput;
    record.detail = "the result is no polygon: " + worker::printable(error.what(), 200);
    return std::nullopt;
  }
}

}  // namespace hullbench::run
