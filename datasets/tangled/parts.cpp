#include <algorithm>
#include <cstddef>
#include <vector>

#include "datasets/portable_math.hpp"
#include "datasets/tangled/comb.hpp"
#include "datasets/tangled/draws.hpp"
#include "datasets/tangled/ring_steps.hpp"
#include "datasets/tangled_shapes.hpp"

namespace hullbench {

using polylidar::MultiPolygon;
using polylidar::Point;
using polylidar::Ring;

namespace {

constexpr double kHalfSide = 110;
/// The least in which two teeth fit beside each other: see draw_small_comb.
constexpr double kLeastRadius = 25;

bool are_apart(const Disc& a, const Disc& b) {
  const double dx = a.centre.x - b.centre.x;
  const double dy = a.centre.y - b.centre.y;
  const double least = a.radius + b.radius + kLeastFeature;
  return dx * dx + dy * dy >= least * least;
}

/// Puts disc after disc where there is room; fewer than `count` when one finds no place in 100 tries.
std::vector<Disc> try_discs(std::size_t count, Random& random) {
  const double most = kLeastRadius + 60 / static_cast<double>(count);
  std::vector<Disc> discs;
  for (int attempt = 0; attempt < 100 && discs.size() < count; ++attempt) {
    const double radius = random.between(kLeastRadius, most);
    const double reach = kHalfSide - radius;
    const double x = random.between(-reach, reach);
    const double y = random.between(-reach, reach);
    const Disc disc{{x, y}, radius};
    const bool fits =
        std::all_of(discs.begin(), discs.end(), [&](const Disc& other) { return are_apart(disc, other); });
    if (fits) discs.push_back(disc);
  }
  return discs;
}

Ring draw_blob(double radius, Random& random) {
  return round_outline({.centre = {}, .radius = radius, .depth = 0.4, .lobes = 3 + random.below(3)}, random);
}

/// Corners on the circle of `radius`.
Ring draw_box(double radius, Random& random) {
  const Point direction = unit_vector(random.between(0.06, 0.125));
  const double x = radius * direction.x;
  const double y = radius * direction.y;
  return {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
}

/// Inside the circle of `radius`. The bar is at least 2 * 25 * cos(0.1 turns) = 40.4 long and the comb 2 * 25
/// * sin(0.08 turns) = 24 high: five pieces of kLeastFeature along the bar, and teeth longer than that.
Ring draw_small_comb(double radius, Random& random) {
  const Point direction = unit_vector(random.between(0.08, 0.1));
  const double height = 2 * radius * direction.y;
  CombPlan plan{.length = 2 * radius * direction.x};
  plan.bar = random.between(kLeastFeature, 0.4 * height);
  plan.longest_tooth = height - plan.bar;
  plan.shortest_tooth = 0.6 * plan.longest_tooth;
  const auto most_teeth = static_cast<std::size_t>((plan.length / kLeastFeature - 1) / 2);
  plan.teeth_above = 2 + random.below(most_teeth - 1);
  return make_comb(plan, random);
}

Ring draw_part(std::size_t kind, double radius, Random& random) {
  if (kind == 0) return draw_blob(radius, random);
  if (kind == 1) return draw_small_comb(radius, random);
  return draw_box(radius, random);
}

}  // namespace

MultiPolygon draw_parts(Random& random) {
  const std::size_t count = 3 + random.below(5);
  std::vector<Disc> discs;
  while (discs.size() < count) discs = try_discs(count, random);
  const std::size_t first_kind = random.below(3);
  MultiPolygon shape;
  for (std::size_t i = 0; i < count; ++i) {
    Ring part = draw_part((first_kind + i) % 3, discs[i].radius, random);
    turn(part, random.uniform());
    move(part, discs[i].centre);
    shape.push_back({.shell = std::move(part), .holes = {}});
  }
  return shape;
}

}  // namespace hullbench
