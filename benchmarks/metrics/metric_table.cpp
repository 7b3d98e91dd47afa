#include "benchmarks/metrics/metric_table.hpp"

#include <vector>

namespace hullbench::metrics {
namespace {

template <typename Value>
MetricValue optional_value(const std::optional<Value>& value) {
  return value ? MetricValue(*value) : MetricValue();
}

MetricValue count_value(std::size_t count) {
  return static_cast<std::int64_t>(count);
}

/// A member of the boundary scores, which an invalid result has not.
template <typename Value>
MetricValue boundary_value(const Metrics& metrics, Value BoundaryScores::*which) {
  return metrics.boundary ? optional_value<double>((*metrics.boundary).*which) : MetricValue();
}

constexpr const char* kInvalid = "of an invalid result";
constexpr const char* kInvalidOrEmpty = "of an invalid or empty result";
constexpr const char* kPaper =
    "J. Castagno, E. Atkins, Polylidar - Polygons from Triangular Meshes, 2020, section V";
constexpr const char* kOgc = "OGC 06-103r4, Simple feature access, 2011, section 6.1";
constexpr const char* kJaccard = "P. Jaccard, New Phytologist 11, 1912";
constexpr const char* kHuttenlocher =
    "D. Huttenlocher et al., Comparing images using the Hausdorff distance, IEEE TPAMI 15, 1993";
constexpr const char* kTaha =
    "A. A. Taha, A. Hanbury, Metrics for evaluating 3D medical image segmentation, BMC Medical Imaging 15, "
    "2015";
constexpr const char* kKnapitsch = "A. Knapitsch et al., Tanks and Temples, ACM TOG 36, 2017";
constexpr const char* kCheng = "B. Cheng et al., Boundary IoU, CVPR 2021";
constexpr const char* kKirillov = "A. Kirillov et al., Panoptic segmentation, CVPR 2019";
constexpr const char* kMurphy = "A. H. Murphy, Skill scores based on the mean square error, MWR 116, 1988";

using Table = std::vector<MetricInfo>;

void add_validity(Table& table) {
  table.push_back({"valid", "validity", "yes/no", Better::kHigher,
                   "R is a valid multipolygon in the sense of the OGC, by GEOS; an empty one is", "", kOgc,
                   "check_shape, validity.cpp",
                   [](const Metrics& m) -> MetricValue { return m.area.valid; }});
  table.push_back({"invalid_reason", "validity", "text", Better::kNone,
                   "why it is not, with the place; empty when it is", "", "", "check_shape, validity.cpp",
                   [](const Metrics& m) -> MetricValue { return m.area.invalid_reason; }});
}

void add_area(Table& table) {
  const auto add = [&table](const char* name, const char* unit, Better better, const char* definition,
                            const char* undefined, const char* citation,
                            MetricValue (*value)(const Metrics&)) {
    table.push_back(
        {name, "area", unit, better, definition, undefined, citation, "area_scores, area.cpp", value});
  };
  add("area", "length^2", Better::kNone,
      "area of R, shells less holes, not below 0; 0 when a coordinate is not finite", "", "",
      [](const Metrics& m) -> MetricValue { return m.area.area; });
  add("symmetric_difference_area", "length^2", Better::kLower, "area((T - R) + (R - T))", kInvalid, "",
      [](const Metrics& m) { return optional_value(m.area.symmetric_difference_area); });
  add("l2", "ratio", Better::kLower, "symmetric difference / area of T; 1 for an empty R", kInvalid, "",
      [](const Metrics& m) { return optional_value(m.area.l2); });
  add("l2_paper", "ratio", Better::kLower, "symmetric difference / area of R", kInvalidOrEmpty, kPaper,
      [](const Metrics& m) { return optional_value(m.area.l2_paper); });
  add("iou", "ratio", Better::kHigher, "area of the intersection / area of the union", kInvalid, kJaccard,
      [](const Metrics& m) { return optional_value(m.area.iou); });
  add("omission", "ratio", Better::kLower, "area(T - R) / area of T", kInvalid, "",
      [](const Metrics& m) { return optional_value(m.area.omission); });
  add("commission", "ratio", Better::kLower, "area(R - T) / area of T", kInvalid, "",
      [](const Metrics& m) { return optional_value(m.area.commission); });
  add("area_bias", "ratio", Better::kZero, "(area of R - area of T) / area of T: commission less omission",
      kInvalid, "", [](const Metrics& m) { return optional_value(m.area.area_bias); });
  add("perimeter_ratio", "ratio", Better::kOne, "length of all rings of R / length of all rings of T",
      kInvalid, "", [](const Metrics& m) { return optional_value(m.area.perimeter_ratio); });
}

template <std::optional<Witness> BoundaryScores::*kWhich>
void add_hausdorff(Table& table, const char* name, const std::string& definition) {
  const std::string function = "boundary_scores, boundary.cpp";
  const auto distance = [](const Metrics& m) -> MetricValue {
    if (!m.boundary || !((*m.boundary).*kWhich)) return {};
    return ((*m.boundary).*kWhich)->distance;
  };
  const auto x = [](const Metrics& m) -> MetricValue {
    if (!m.boundary || !((*m.boundary).*kWhich)) return {};
    return ((*m.boundary).*kWhich)->place.x;
  };
  const auto y = [](const Metrics& m) -> MetricValue {
    if (!m.boundary || !((*m.boundary).*kWhich)) return {};
    return ((*m.boundary).*kWhich)->place.y;
  };
  table.push_back({name, "boundary", "length", Better::kLower, definition, kInvalidOrEmpty, kHuttenlocher,
                   function, distance});
  table.push_back({std::string(name) + "_x", "boundary", "length", Better::kNone,
                   "x of the point where " + std::string(name) + " is taken", kInvalidOrEmpty, "", function,
                   x});
  table.push_back({std::string(name) + "_y", "boundary", "length", Better::kNone,
                   "y of the point where " + std::string(name) + " is taken", kInvalidOrEmpty, "", function,
                   y});
}

void add_hausdorffs(Table& table) {
  table.push_back({"hausdorff", "boundary", "length", Better::kLower,
                   "the larger one of hausdorff_to_truth and hausdorff_to_result", kInvalidOrEmpty,
                   kHuttenlocher, "boundary_scores, boundary.cpp",
                   [](const Metrics& m) { return boundary_value(m, &BoundaryScores::hausdorff); }});
  add_hausdorff<&BoundaryScores::hausdorff_to_truth>(
      table, "hausdorff_to_truth", "largest distance of a point of R's boundary to T's boundary");
  add_hausdorff<&BoundaryScores::hausdorff_to_result>(
      table, "hausdorff_to_result", "largest distance of a point of T's boundary to R's boundary");
}

void add_boundary(Table& table) {
  add_hausdorffs(table);
  const auto add = [&table](const char* name, const char* unit, Better better, const char* definition,
                            const char* undefined, const char* citation,
                            MetricValue (*value)(const Metrics&)) {
    table.push_back({name, "boundary", unit, better, definition, undefined, citation,
                     "boundary_scores, boundary.cpp", value});
  };
  add("boundary_p95", "length", Better::kLower,
      "the larger one of the 95th percentiles, by length, of the distances of R's boundary to T's and of T's "
      "to R's",
      kInvalidOrEmpty, kTaha, [](const Metrics& m) { return boundary_value(m, &BoundaryScores::p95); });
  add("boundary_mean", "length", Better::kLower,
      "mean distance of R's boundary to T's and of T's to R's, by length of both together", kInvalidOrEmpty,
      kTaha, [](const Metrics& m) { return boundary_value(m, &BoundaryScores::mean); });
  constexpr const char* kFScore =
      "harmonic mean of the share of R's boundary within the tolerance of T's and the share of T's within it "
      "of R's; tolerance h, 2 h or 4 h; 0 for an empty R";
  add("f_score_1h", "ratio", Better::kHigher, kFScore, kInvalid, kKnapitsch,
      [](const Metrics& m) { return boundary_value(m, &BoundaryScores::f_score_1h); });
  add("f_score_2h", "ratio", Better::kHigher, kFScore, kInvalid, kKnapitsch,
      [](const Metrics& m) { return boundary_value(m, &BoundaryScores::f_score_2h); });
  add("f_score_4h", "ratio", Better::kHigher, kFScore, kInvalid, kKnapitsch,
      [](const Metrics& m) { return boundary_value(m, &BoundaryScores::f_score_4h); });
  table.push_back(
      {"boundary_iou", "boundary", "ratio", Better::kHigher,
       "IoU of what in R is within 2 h of R's boundary and what in T is within 2 h of T's; 0 for an "
       "empty R",
       kInvalid, kCheng, "band_iou, boundary_band.cpp",
       [](const Metrics& m) { return optional_value(m.boundary_iou); }});
}

void add_topology(Table& table) {
  const auto add = [&table](const char* name, const char* unit, Better better, const char* definition,
                            const char* undefined, const char* citation, const char* function,
                            MetricValue (*value)(const Metrics&)) {
    table.push_back({name, "topology", unit, better, definition, undefined, citation, function, value});
  };
  constexpr const char* kCounts = "count_shape, topology.cpp";
  constexpr const char* kMatches = "match_holes, topology.cpp";
  constexpr const char* kNoHoles = "of an invalid result, and when neither R nor T has holes";
  add("polygons_error", "count", Better::kZero, "polygons of R less polygons of T", "", "", kCounts,
      [](const Metrics& m) -> MetricValue { return m.counts.polygons_error; });
  add("holes_error", "count", Better::kZero, "holes of R less holes of T", "", "", kCounts,
      [](const Metrics& m) -> MetricValue { return m.counts.holes_error; });
  add("hole_precision", "ratio", Better::kHigher,
      "share of R's holes that are holes of T: matched one to one, the best pair first, with an IoU of more "
      "than 0.5; 0 when only one of R and T has holes",
      kNoHoles, kKirillov, kMatches, [](const Metrics& m) { return optional_value(m.holes.precision); });
  add("hole_recall", "ratio", Better::kHigher,
      "share of T's holes that are holes of R, matched likewise; 0 when only one of R and T has holes",
      kNoHoles, kKirillov, kMatches, [](const Metrics& m) { return optional_value(m.holes.recall); });
  add("hole_f1", "ratio", Better::kHigher,
      "2 matched holes / (holes of R + holes of T); 0 when only one of R and T has holes", kNoHoles,
      kKirillov, kMatches, [](const Metrics& m) { return optional_value(m.holes.f1); });
  add("slivers", "count", Better::kLower,
      "polygons (their whole shells) and holes of R of less than 4 h^2: an area that n points spread at "
      "random leave empty by chance with probability e^-4 = 1.8 %",
      "", "", kCounts, [](const Metrics& m) -> MetricValue { return m.counts.slivers; });
}

void add_contract(Table& table) {
  const auto add = [&table](const char* name, const char* unit, const char* definition, const char* undefined,
                            MetricValue (*value)(const Metrics&)) {
    table.push_back({name, "contract", unit, Better::kHigher, definition, undefined, "",
                     "InputPoints::score, output_contract.cpp", value});
  };
  add("points_covered", "ratio",
      "share of the input points that lie in R by the even-odd rule, or no farther from its boundary than "
      "2^-47 of R's largest coordinate, as far as text with 15 digits moves it",
      "without points and when a coordinate of R is not finite",
      [](const Metrics& m) { return optional_value(m.contract.points_covered); });
  add("vertices_from_input", "ratio", "share of R's vertices that are input points, to the last bit",
      "of an empty result", [](const Metrics& m) { return optional_value(m.contract.vertices_from_input); });
  add("oriented", "yes/no", "all shells run counter-clockwise and all holes clockwise", "of an empty result",
      [](const Metrics& m) { return optional_value(m.contract.oriented); });
}

void add_size(Table& table) {
  const auto add = [&table](const char* name, const char* unit, Better better, const char* definition,
                            const char* undefined, const char* function,
                            MetricValue (*value)(const Metrics&)) {
    table.push_back({name, "size", unit, better, definition, undefined, "", function, value});
  };
  constexpr const char* kScore = "CaseScorer::score, metrics.cpp";
  add("polygons", "count", Better::kNone, "polygons of R", "", kScore,
      [](const Metrics& m) { return count_value(m.polygon_count); });
  add("holes", "count", Better::kNone, "holes of all polygons of R", "", kScore,
      [](const Metrics& m) { return count_value(m.hole_count); });
  add("vertices", "count", Better::kLower, "vertices of all rings of R, the first one of a ring once", "",
      kScore, [](const Metrics& m) { return count_value(m.vertex_count); });
  add("peak_memory_bytes", "bytes", Better::kLower,
      "largest resident size of the method's worker process during an untimed run, what the process needs "
      "anyway (its program, its interpreter, the points) included",
      "for methods that work in a server, and where the system does not tell it",
      "WorkerProcess, worker_process.cpp",
      [](const Metrics& m) { return optional_value(m.peak_memory_bytes); });
}

void add_skill(Table& table) {
  table.push_back(
      {"skill", "skill", "ratio", Better::kHigher,
       "(l2_convex_hull - l2) / (l2_convex_hull - l2_best_triangles): 0 as good as the convex hull, "
       "1 as good as the triangles; can be negative or above 1",
       "of an invalid result, and when l2_convex_hull exceeds l2_best_triangles by no more than "
       "1 / n, what one point stands for",
       kMurphy, "skill, anchors.cpp", [](const Metrics& m) { return optional_value(m.skill); }});
  table.push_back({"l2_convex_hull", "skill", "ratio", Better::kNone, "l2 of the convex hull of the points",
                   "", "", "find_anchors, anchors.cpp",
                   [](const Metrics& m) -> MetricValue { return m.l2_convex_hull; }});
  table.push_back({"l2_best_triangles", "skill", "ratio", Better::kNone,
                   "l2 of the union of the points' Delaunay triangles whose centroid lies in T", "", "",
                   "find_anchors, anchors.cpp",
                   [](const Metrics& m) -> MetricValue { return m.l2_best_triangles; }});
}

void add_no_truth(Table& table) {
  const auto add = [&table](const char* name, Better better, const char* definition, const char* undefined,
                            const char* citation, const char* function,
                            MetricValue (*value)(const Metrics&)) {
    table.push_back({name, "no truth", "ratio", better, definition, undefined, citation, function, value});
  };
  constexpr const char* kStability = "stability, agreement.cpp";
  add("convex_hull_share", Better::kNone, "area of R / area of the convex hull of the points",
      "where there is a T, of an invalid result, and of points without an area", "", "describe, metrics.cpp",
      [](const Metrics& m) { return optional_value(m.convex_hull_share); });
  add("agreement_halves", Better::kHigher,
      "IoU of what the method makes of a random half of the points and of the other half, the mean of the "
      "plan's draws; 0 for a draw in which one of them is no valid shape with an area",
      "of an invalid result, and where the plan asks for no draws", kJaccard, kStability,
      [](const Metrics& m) { return m.stability ? MetricValue(m.stability->halves) : MetricValue(); });
  add("agreement_subsamples", Better::kHigher,
      "IoU of R and what the method makes of a random 90 % of the points, the mean of the plan's draws; 0 "
      "for a draw in which that is no valid shape with an area",
      "of an invalid result, and where the plan asks for no draws", kJaccard, kStability,
      [](const Metrics& m) { return m.stability ? MetricValue(m.stability->subsamples) : MetricValue(); });
  add("window_iou", Better::kNone,
      "IoU of R and the window in which the points were looked for, which is not their shape",
      "where no window is known, and of an invalid result", kJaccard,
      "intersection_over_union, agreement.cpp",
      [](const Metrics& m) { return optional_value(m.window_iou); });
}

void add_case(Table& table) {
  table.push_back({"spacing", "case", "length", Better::kNone,
                   "h = sqrt(area of T / n), the nominal spacing of the n points", "", "",
                   "CaseScorer::score, metrics.cpp",
                   [](const Metrics& m) -> MetricValue { return m.spacing; }});
  table.push_back({"ground_truth_area", "case", "length^2", Better::kNone, "area of T", "", "",
                   "PreparedTruth, prepared_truth.cpp",
                   [](const Metrics& m) -> MetricValue { return m.area.ground_truth_area; }});
  table.push_back({"ground_truth_convexity", "case", "ratio", Better::kNone,
                   "area of T / area of its convex hull", "", kPaper, "PreparedTruth, prepared_truth.cpp",
                   [](const Metrics& m) -> MetricValue { return m.area.ground_truth_convexity; }});
}

Table make_table() {
  Table table;
  add_validity(table);
  add_area(table);
  add_boundary(table);
  add_topology(table);
  add_contract(table);
  add_size(table);
  add_skill(table);
  add_no_truth(table);
  add_case(table);
  return table;
}

}  // namespace

std::span<const MetricInfo> metric_table() {
  static const Table table = make_table();
  return table;
}

}  // namespace hullbench::metrics
