// Rules that choose a parameter for a case, by name in plans: {"rule": "paper_alpha"}.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"

namespace hullbench::plan {

/// What a rule may look at.
struct RuleInput {
  std::span<const Point> points;
  double ground_truth_area = 0;  ///< squared unit of the points; only for rules that say so
  bool holes = false;            ///< whether the case asks for holes
  /// Its polygons; only for rules that say so.
  std::span<const Polygon> ground_truth = {};
};

struct ParameterRule {
  std::string name;
  std::string formula;  ///< as tables show it
  /// Whether the value depends on the ground truth beyond the question whether it has holes: then the rule is
  /// oracle-informed and only the protocols `paper` and `oracle` may use it.
  bool reads_ground_truth = false;
  double (*value)(const RuleInput& input) = nullptr;
};

/// Nullptr when there is none of that name.
const ParameterRule* find_rule(const std::string& name);

/// All names, for messages.
std::vector<std::string> rule_names();

/// `paper_alpha`: 2 * sqrt(A / n) with the ground truth's area A, the paper's 2 / p_d (section V): a
/// circumradius in the length unit of the points. Oracle-informed. 0 for no points.
double paper_alpha(const RuleInput& input);

/// `paper_alpha_squared`: its square, for methods that want a squared radius (CGAL). Oracle-informed.
double paper_alpha_squared(const RuleInput& input);

/// `paper_edge_length`: 2 * paper_alpha, the longest edge that a triangle of that circumradius can have, for
/// methods that want an edge length. Oracle-informed.
double paper_edge_length(const RuleInput& input);

/// `paper_target_percent`: the ground truth's area over the area of its convex hull, the share of the points'
/// convex hull that PostGIS before 3.3 is to shrink to; a ratio in (0, 1]. The paper's choice, "to provide
/// the optimal accuracy based on percent area reduction required" (section V); its experiment took the figure
/// from each shape so. Oracle-informed. 1 (the convex hull) for a ground truth without an area.
double paper_target_percent(const RuleInput& input);

/// `holes`: 1 when the case has holes, else 0. What a user knows of the shape before asking for its hull,
/// hence open to every protocol.
double holes_switch(const RuleInput& input);

/// sqrt(A / n): the mean spacing of n points spread over the area A of their convex hull, in the unit of the
/// points. What lengths are given in where no ground truth may be known. 0 for no points and for points
/// without an area.
double mean_spacing(std::span<const Point> points);

/// The core's own choice for these points (Extractor::chosen_sizes), its median S over the set: the largest
/// size of a triangle of the shape where the points are as dense as usual. What the other rules from the
/// points take their lengths from. The core finds its sizes inside of its own time; the others are told S,
/// one length for all places, as that is what they take.
///
/// `auto_size`: S, a length in the unit of the points. 0 for points without a triangle.
double auto_size(const RuleInput& input);

/// The shares of S that stand for it where a method limits something else than that size. Fitted on the
/// training side (tune/split.hpp) of the plans world_* by `make fit-rules`.
extern const double kEdgeShare;
extern const double kCircumradiusShare;

/// `auto_edge_length`: kEdgeShare * S, a length in the unit of the points: of the longest edge of a triangle
/// that stays, or of an edge of a border beyond which the shape is eroded.
double auto_edge_length(const RuleInput& input);

/// `auto_border_length`: the same for methods that change the outer border only and keep all that is inside.
/// They can make the shape of points that all lie on its outline, so if the core takes the points for such,
/// the length is at least the core's step along outlines (Statistics::outline_step; infinity for a convex
/// outline). Methods that also erode holes would lose the inside.
double auto_border_length(const RuleInput& input);

/// `auto_circumradius`: kCircumradiusShare * S, a length in the unit of the points.
double auto_circumradius(const RuleInput& input);

/// `auto_circumradius_squared`: its square, for methods that want a squared radius (CGAL).
double auto_circumradius_squared(const RuleInput& input);

}  // namespace hullbench::plan
