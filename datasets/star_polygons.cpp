#include "datasets/star_polygons.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <stdexcept>
#include <string>

#include "datasets/portable_math.hpp"
#include "datasets/random.hpp"
#include "polylidar/predicates.hpp"

namespace hullbench {

using polylidar::MultiPolygon;
using polylidar::Point;
using polylidar::Ring;

namespace {

constexpr std::uint64_t kStarSeed = 2020;

/// step i leads from vertex i to the next; their unit does not matter.
std::array<double, kStarVertices> draw_steps(double irregularity, Random& random) {
  std::array<double, kStarVertices> steps{};
  for (double& step : steps) step = random.between(1 - irregularity, 1 + irregularity);
  return steps;
}

Ring draw_ring(const StarParameters& parameters, Random& random) {
  const std::array<double, kStarVertices> steps = draw_steps(parameters.irregularity, random);
  const double full_turn = std::accumulate(steps.begin(), steps.end(), 0.0);
  const double start = random.uniform();
  Ring ring;
  ring.reserve(kStarVertices);
  double travelled = 0;
  for (const double step : steps) {
    const double drawn = kStarMeanRadius * (1 + parameters.spikiness * random.normal());
    const double radius = std::clamp(drawn, kStarMeanRadius / 2, 2 * kStarMeanRadius);
    const Point direction = unit_vector(start + travelled / full_turn);
    ring.push_back({radius * direction.x, radius * direction.y});
    travelled += step;
  }
  return ring;
}

}  // namespace

StarParameters star_parameters(std::size_t index) {
  if (index >= kStarPolygons) {
    throw std::invalid_argument("there is no star polygon " + std::to_string(index) + "; the last one is " +
                                std::to_string(kStarPolygons - 1));
  }
  const std::size_t pair = index % kStarPairs;
  const std::size_t row = pair / 7;
  const std::size_t column = pair % 7;
  // Divided, because 3 * 0.1 is not the double nearest to 0.3.
  return {.irregularity = static_cast<double>(1 + row) / 10,
          .spikiness = static_cast<double>(1 + column) / 10};
}

bool circles_origin_once(std::span<const Point> ring) {
  if (ring.size() < 3) return false;
  std::size_t rounds = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point& start = ring[i];
    const Point& end = ring[(i + 1) % ring.size()];
    if (!(polylidar::orient2d({0, 0}, start, end) > 0)) return false;
    // Less than half a turn on, so this is where the positive x axis is passed.
    if (start.y < 0 && end.y >= 0) ++rounds;
  }
  return rounds == 1;
}

MultiPolygon star_polygon(std::size_t index) {
  const StarParameters parameters = star_parameters(index);
  Random random(derive_seed(kStarSeed, "star/" + std::to_string(index)));
  Ring ring;
  while (!circles_origin_once(ring)) ring = draw_ring(parameters, random);
  return {{.shell = std::move(ring), .holes = {}}};
}

}  // namespace hullbench
