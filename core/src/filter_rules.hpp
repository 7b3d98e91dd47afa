// What a triangle must satisfy to belong to the shape: each rule is one small object.
//
// To add a rule, write a class with `bool keeps(const Triangle&) const` and name it in filter_rules(). Its
// limit is a member of Options and Limits (options_check.cpp lists them), and least_dropped_radius() in
// interior.cpp says from which circumradius on it may drop a triangle.
#pragma once

#include <algorithm>
#include <cmath>
#include <tuple>
#include <variant>

#include "half_edge.hpp"
#include "polylidar/concave_hull.hpp"
#include "size_field.hpp"
#include "vector.hpp"

namespace polylidar::detail {

/// Points closer than this share of a radius are too close: rounding may lose the whole area of a triangle
/// with two of them, and with it the circumradius.
inline constexpr double kTooClose = 0x1p-40;

/// The fourth power of the size of a triangle with these squared edges and this area. `Number` is double, or
/// a vector with a number for each of several triangles.
template <class Number>
[[gnu::always_inline]] inline Number size4_of(const Number& ab, const Number& bc, const Number& ca,
                                              const Number& twice_area) {
  constexpr double kEquilateral = 1.1547005383792515;  // 2 / sqrt 3
  const auto least = [](const Number& a, const Number& b) { return a < b ? a : b; };
  const auto most = [](const Number& a, const Number& b) { return a > b ? a : b; };
  const Number middle = most(least(ab, bc), least(most(ab, bc), ca));
  return middle * most(kEquilateral * twice_area, middle / 16.0);
}

/// A finite triangle of the mesh, as the rules use it. All is inlined, so only what a rule asks for is
/// computed.
struct Triangle {
  Triangle(const Mesh& mesh, const Point* vertices, Mesh::Index t)
      : Triangle(t, vertices[mesh.origin(Mesh::kStride * t)], vertices[mesh.origin(Mesh::kStride * t + 1)],
                 vertices[mesh.origin(Mesh::kStride * t + 2)]) {}
  /// Triangle `t` with its corners, counter-clockwise.
  Triangle(Mesh::Index t, const Point& first, const Point& second, const Point& third)
      : index(t), a(first), b(second), c(third) {}

  double squared_ab() const { return squared_length(a - b); }
  double squared_bc() const { return squared_length(b - c); }
  double squared_ca() const { return squared_length(c - a); }
  double squared_shortest_edge() const { return std::min({squared_ab(), squared_bc(), squared_ca()}); }
  double squared_longest_edge() const { return std::max({squared_ab(), squared_bc(), squared_ca()}); }
  double perimeter() const {
    return std::sqrt(squared_ab()) + std::sqrt(squared_bc()) + std::sqrt(squared_ca());
  }
  /// Rounded; only rounding can make it negative.
  double twice_area() const { return cross(c - a, a - b); }
  /// The fourth power of the triangle's size. The size is a length: (4 / sqrt 3 e^2 A)^(1/4) with area A and
  /// second-longest edge e, or e / 2 if that is more, as in almost flat triangles. The size of an equilateral
  /// triangle is its edge. A triangle that spans a hole has a size like its circumradius; a sliver along the
  /// outline has a small size, even with a long edge.
  double size4() const { return size4(twice_area()); }
  /// The same for a triangle with this area.
  double size4(double twice_area) const {
    return size4_of(squared_ab(), squared_bc(), squared_ca(), twice_area);
  }

  Mesh::Index index;
  const Point& a;
  const Point& b;
  const Point& c;
};

/// The rule that every triangle obeys.
struct NoRule {
  bool keeps(const Triangle& /*triangle*/) const { return true; }
};

class LongestEdgeRule {
 public:
  explicit LongestEdgeRule(double limit) : squared_limit_(limit * limit) {}
  bool keeps(const Triangle& triangle) const { return triangle.squared_longest_edge() <= squared_limit_; }

 private:
  double squared_limit_;
};

/// A perimeter is more than twice and at most three times the longest edge. This decides nearly all triangles
/// without a square root.
class PerimeterRule {
 public:
  explicit PerimeterRule(double limit) : limit_(limit), squared_limit_(limit * limit) {}
  bool keeps(const Triangle& triangle) const {
    const double longest = triangle.squared_longest_edge();
    if (9 * longest <= squared_limit_) return true;
    if (4 * longest > squared_limit_) return false;
    return triangle.perimeter() <= limit_;
  }

 private:
  double limit_;
  double squared_limit_;
};

/// One limit for all places.
class OneSizeRule {
 public:
  explicit OneSizeRule(double limit4) : limit4_(limit4) {}
  bool keeps(const Triangle& triangle) const { return triangle.size4() <= limit4_; }
  double most4() const { return limit4_; }

 private:
  double limit4_;
};

/// The limit that varies by place.
class SizeRule {
 public:
  SizeRule(const SizeField& field, const Mesh& mesh) : field_(field), mesh_(mesh) {}
  bool keeps(const Triangle& triangle) const {
    return triangle.size4() <= field_.limit4_at(mesh_, triangle.index);
  }

 private:
  const SizeField& field_;
  const Mesh& mesh_;
};

/// circumradius = |ab| |bc| |ca| / (2 cross), with cross twice the area: compared squared and without
/// division, so that a triangle that is flat up to rounding counts as infinitely large instead of giving NaN.
class CircumradiusRule {
 public:
  explicit CircumradiusRule(double limit) : four_squared_limit_(4 * limit * limit) {}
  bool keeps(const Triangle& triangle) const {
    const double cross = triangle.twice_area();
    return triangle.squared_ab() * triangle.squared_bc() * triangle.squared_ca() <=
           four_squared_limit_ * (cross * cross);
  }

 private:
  double four_squared_limit_;
};

/// Rule(limit), if there is a limit.
template <class Rule>
std::variant<NoRule, Rule> rule_of(double limit) {
  if (limit == kNoLimit) return NoRule{};
  return Rule(limit);
}

/// The rules of one shape, in the best order to ask them; a triangle must obey all of them. The filter is
/// compiled for every combination, so an unused rule costs nothing.
inline auto filter_rules(const Limits& limits) {
  return std::tuple{rule_of<LongestEdgeRule>(limits.max_edge_length),
                    rule_of<PerimeterRule>(limits.max_perimeter), rule_of<CircumradiusRule>(limits.alpha)};
}
using FilterRules = decltype(filter_rules({}));

}  // namespace polylidar::detail
