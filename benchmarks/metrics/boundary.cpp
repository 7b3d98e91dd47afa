#include "benchmarks/metrics/boundary.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "benchmarks/metrics/shape_measures.hpp"

namespace hullbench::metrics {
namespace {

constexpr double kSpacingInH = 0.25;
constexpr double kMostSamples = 262'144;
constexpr double kPercentile = 0.95;

/// The distance at one place, and the length of boundary that it stands for.
struct Sample {
  double distance;
  double length;
};

/// What one boundary is from another.
struct Profile {
  std::vector<Sample> samples;
  double length = 0;  ///< of all samples
  Witness farthest;
};

double step_length(const Point& from, const Point& to, double pieces) {
  return std::hypot(to.x - from.x, to.y - from.y) / pieces;
}

double pieces_of(const Point& from, const Point& to, double spacing) {
  return std::max(1.0, std::ceil(step_length(from, to, 1) / spacing));
}

/// Walks along rings and keeps the distance to `other` at every vertex and between vertices. A place stands
/// for half of the piece before it and half of the piece behind it.
class Walker {
 public:
  Walker(const SegmentTree& other, double spacing) : other_(other), spacing_(spacing) {}

  void walk(const Ring& ring) {
    if (ring.empty()) return;
    const Point& last = ring.back();
    double before = step_length(last, ring.front(), pieces_of(last, ring.front(), spacing_));
    bound_ = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point& from = ring[i];
      const Point& to = ring[(i + 1) % ring.size()];
      const double pieces = pieces_of(from, to, spacing_);
      const double step = step_length(from, to, pieces);
      for (std::size_t piece = 0; piece < static_cast<std::size_t>(pieces); ++piece) {
        const double t = static_cast<double>(piece) / pieces;
        add({from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)}, (before + step) / 2);
        // The distance changes by no more than the way that is walked.
        bound_ = profile.samples.back().distance + step;
        before = step;
      }
    }
  }

  Profile profile;

 private:
  void add(const Point& place, double length) {
    const double distance = other_.distance(place, bound_);
    if (profile.samples.empty() || distance > profile.farthest.distance) profile.farthest = {distance, place};
    profile.samples.push_back({distance, length});
    profile.length += length;
  }

  const SegmentTree& other_;
  double spacing_;
  double bound_ = 0;
};

Profile measure(const PreparedBoundary& boundary, const SegmentTree& other, double h) {
  Walker walker(other, sample_spacing(h, boundary.length()));
  for_each_ring(boundary.shape(), [&](const Ring& ring) { walker.walk(ring); });
  return std::move(walker.profile);
}

/// The sum of distance times length.
double weighted_sum(const Profile& profile) {
  double sum = 0;
  for (const Sample& sample : profile.samples) sum += sample.distance * sample.length;
  return sum;
}

/// The share of the boundary's length that is within `tolerance`.
double share_within(const Profile& profile, double tolerance) {
  double within = 0;
  for (const Sample& sample : profile.samples) {
    if (sample.distance <= tolerance) within += sample.length;
  }
  return within / profile.length;
}

/// The smallest distance that `share` of the boundary's length is within.
double percentile(Profile& profile, double share) {
  std::ranges::sort(profile.samples,
                    [](const Sample& a, const Sample& b) { return a.distance < b.distance; });
  double within = 0;
  for (const Sample& sample : profile.samples) {
    within += sample.length;
    if (within >= share * profile.length) return sample.distance;
  }
  return profile.samples.back().distance;
}

double f_score(const Profile& result, const Profile& truth, double tolerance) {
  const double precision = share_within(result, tolerance);
  const double recall = share_within(truth, tolerance);
  return precision + recall > 0 ? 2 * precision * recall / (precision + recall) : 0;
}

}  // namespace

PreparedBoundary::PreparedBoundary(const MultiPolygon& shape)
    : shape_(&shape), segments_(shape), length_(perimeter(shape)) {}

double sample_spacing(double h, double length) {
  return std::max(h * kSpacingInH, length / kMostSamples);
}

BoundaryScores boundary_scores(const PreparedBoundary& result, const PreparedBoundary& truth, double h) {
  BoundaryScores scores;
  if (!(result.length() > 0)) return scores;
  Profile of_result = measure(result, truth.segments(), h);
  Profile of_truth = measure(truth, result.segments(), h);
  scores.hausdorff_to_truth = of_result.farthest;
  scores.hausdorff_to_result = of_truth.farthest;
  scores.hausdorff = std::max(of_result.farthest.distance, of_truth.farthest.distance);
  scores.mean = (weighted_sum(of_result) + weighted_sum(of_truth)) / (of_result.length + of_truth.length);
  scores.f_score_1h = f_score(of_result, of_truth, h);
  scores.f_score_2h = f_score(of_result, of_truth, 2 * h);
  scores.f_score_4h = f_score(of_result, of_truth, 4 * h);
  // Last, because it sorts.
  scores.p95 = std::max(percentile(of_result, kPercentile), percentile(of_truth, kPercentile));
  return scores;
}

}  // namespace hullbench::metrics
