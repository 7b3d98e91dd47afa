#include "benchmarks/parameter_rules.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "polylidar/concave_hull.hpp"
#include "polylidar/delaunay.hpp"

namespace hullbench {
namespace {

/// Wanted edge length in mean spacings of the points over their convex hull.
constexpr double kHullSpacings = 3.0;

const std::array<ParameterRule, 7> kRules = {
    {{"paper_alpha", "2 √(A/n)", true, &paper_alpha},
     {"paper_alpha_squared", "4 A/n", true, &paper_alpha_squared},
     {"paper_edge_length", "4 √(A/n)", true, &paper_edge_length},
     {"paper_target_percent", "A/A_hull", true, &paper_target_percent},
     {"holes", "1 with holes, else 0", false, &holes_switch},
     {"hull_spacing", "3 √(A_hull/n)", false, &hull_spacing},
     {"hull_spacing_ratio", "that of 3 √(A_hull/n)", false, &hull_spacing_ratio}}};

double convex_hull_area(std::span<const polylidar::Point> points) {
  return polylidar::area(
      polylidar::to_coordinates(polylidar::concave_hull(points, {.alpha = polylidar::kNoLimit}), points));
}

struct LengthRange {
  double shortest = std::numeric_limits<double>::infinity();
  double longest = 0;
};

LengthRange edge_lengths(std::span<const polylidar::Point> points) {
  const polylidar::Triangulation triangulation = polylidar::delaunay(points);
  LengthRange range;
  for (std::size_t edge = 0; edge < triangulation.triangles.size(); ++edge) {
    const std::size_t next = 3 * (edge / 3) + (edge + 1) % 3;
    const polylidar::Point& a = points[triangulation.triangles[edge]];
    const polylidar::Point& b = points[triangulation.triangles[next]];
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    range.shortest = std::min(range.shortest, length);
    range.longest = std::max(range.longest, length);
  }
  return range;
}

}  // namespace

const ParameterRule* find_rule(const std::string& name) {
  const auto found = std::find_if(kRules.begin(), kRules.end(),
                                  [&](const ParameterRule& rule) { return rule.name == name; });
  return found == kRules.end() ? nullptr : &*found;
}

std::vector<std::string> rule_names() {
  std::vector<std::string> names;
  names.reserve(kRules.size());
  for (const ParameterRule& rule : kRules) names.push_back(rule.name);
  return names;
}

double paper_alpha(const RuleInput& input) {
  if (input.points.empty()) return 0;
  return 2.0 * std::sqrt(input.ground_truth_area / static_cast<double>(input.points.size()));
}

double paper_alpha_squared(const RuleInput& input) {
  const double alpha = paper_alpha(input);
  return alpha * alpha;
}

double paper_edge_length(const RuleInput& input) {
  return 2 * paper_alpha(input);
}

double paper_target_percent(const RuleInput& input) {
  std::vector<polylidar::Point> corners;
  for (const polylidar::Polygon& polygon : input.ground_truth) {
    corners.insert(corners.end(), polygon.shell.begin(), polygon.shell.end());
  }
  const double hull_area = convex_hull_area(corners);
  if (!(hull_area > 0) || !(input.ground_truth_area > 0)) return 1.0;
  // A convex shape's two areas are summed in different orders, so the ratio may come out a rounding above 1.
  return std::min(input.ground_truth_area / hull_area, 1.0);
}

double holes_switch(const RuleInput& input) {
  return input.holes ? 1.0 : 0.0;
}

double mean_spacing(std::span<const polylidar::Point> points) {
  if (points.empty()) return 0;
  return std::sqrt(convex_hull_area(points) / static_cast<double>(points.size()));
}

double hull_spacing(const RuleInput& input) {
  return kHullSpacings * mean_spacing(input.points);
}

double hull_spacing_ratio(const RuleInput& input) {
  const LengthRange lengths = edge_lengths(input.points);
  if (!(lengths.longest > lengths.shortest)) return 1.0;
  return std::clamp((hull_spacing(input) - lengths.shortest) / (lengths.longest - lengths.shortest), 0.0,
                    1.0);
}

}  // namespace hullbench
