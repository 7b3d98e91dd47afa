// A case with its points drawn and its ground truth prepared, once for all results that are scored against
// it.
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "adapters/adapter.hpp"
#include "benchmarks/metrics/metrics.hpp"
#include "benchmarks/plan/plan.hpp"
#include "benchmarks/record/record.hpp"
#include "datasets/datasets.hpp"

namespace hullbench::run {

/// How the reason begins of a row whose result is no valid polygon, or cannot be scored.
inline constexpr const char* kInvalidPolygon = "the result is an invalid polygon: ";
inline constexpr const char* kNoScore = "the result cannot be scored: ";

class DrawnCase {
 public:
  /// Throws as make_point_set, but for real points whose package is not installed: these are no points, and
  /// missing() says why.
  DrawnCase(const plan::PlanCase& plan_case, std::uint64_t seed, const DataFolders& folders);

  /// Without points, which could not be made for the reason `fault`.
  DrawnCase(const plan::PlanCase& plan_case, std::uint64_t seed, const std::string& fault);

  /// Some of the points of `whole`, without its truth: what parameters are chosen from for a run on them.
  DrawnCase(const DrawnCase& whole, std::vector<Point> part);

  const PointSet& set() const { return set_; }

  /// Why there are no points; empty when there are.
  const std::string& missing() const { return missing_; }
  /// The status of a run where there are no points.
  record::Status missing_status() const { return missing_status_; }

  /// The parameters that the plan's entry asks for here; none where there are no points.
  Parameters choose_parameters(const plan::PlanMethod& method) const;

  /// The record of a run of `method` here, with what is known before it: the points, and no parameters.
  record::RunRecord record_of(const std::string& method) const;

  /// Works out what results are scored against, once for all of them; scoring the first one does it
  /// otherwise.
  void prepare_scoring() const;

  /// Fills in all metrics of the record whose run gave `result`, and `draws` from parts of the points. When
  /// the result is invalid or cannot be scored, a record that was ok gets that status and the reason. Safe
  /// from several threads at once.
  void score(record::RunRecord& record, const MultiPolygon& result,
             std::optional<std::int64_t> peak_memory_bytes,
             std::span<const metrics::PartResults> draws = {}) const;

  /// The same with the metric `l2` alone, which is absent where it is not defined. Needs a ground truth.
  void score_l2(record::RunRecord& record, const MultiPolygon& result) const;

 private:
  template <typename Scores>
  void score_with(record::RunRecord& record, Scores scores_of) const;
  const metrics::CaseScorer& scorer() const;

  plan::PlanCase plan_case_;
  std::uint64_t seed_;
  PointSet set_;
  std::string missing_;
  record::Status missing_status_ = record::Status::kNotInstalled;
  mutable std::once_flag scoring_is_prepared_;
  mutable std::optional<metrics::CaseScorer> scorer_;  ///< none: there is no ground truth, or it has a fault
  mutable std::string scorer_fault_;
};

/// The result in `wkb`. None when it is no polygon: the record is an invalid output then.
std::optional<MultiPolygon> read_result(record::RunRecord& record, const std::vector<std::uint8_t>& wkb);

}  // namespace hullbench::run
