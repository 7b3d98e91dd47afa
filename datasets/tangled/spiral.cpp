#include <algorithm>
#include <cstddef>

#include "datasets/portable_math.hpp"
#include "datasets/tangled/draws.hpp"

namespace hullbench {

using polylidar::Point;
using polylidar::Ring;

namespace {

constexpr std::size_t kRays = 64;
constexpr double kSpiralRadius = 100;

/// Lengths of a band of given turns: along a ray, inner edge to outer edge to the inner edge of the next
/// winding.
struct Band {
  double start = 0;  ///< distance of the inner edge from the origin where the band begins
  double pitch = 0;  ///< how much farther it is one turn on
  double width = 0;  ///< of the band, along the ray
};

Band draw_band(double turns, Random& random) {
  Band band;
  // Nearer to the origin the band would run so steeply along the ray that it is much thinner than wide.
  band.start = random.between(16, 24);
  const double share = random.between(0.4, 0.6);
  band.pitch = (kSpiralRadius - band.start) / (turns + share);
  band.width = share * band.pitch;
  return band;
}

}  // namespace

Ring draw_spiral(Random& random) {
  const std::size_t steps = kRays * 3 / 2 + random.below(kRays * 3 / 2 + 1);
  const Band band = draw_band(static_cast<double>(steps) / kRays, random);
  Ring outer;
  Ring inner;
  for (std::size_t i = 0; i <= steps; ++i) {
    const double turns = static_cast<double>(i) / kRays;
    const Point direction = unit_vector(turns);
    const double radius = band.start + band.pitch * turns;
    inner.push_back({radius * direction.x, radius * direction.y});
    outer.push_back({(radius + band.width) * direction.x, (radius + band.width) * direction.y});
  }
  Ring ring = std::move(outer);
  ring.insert(ring.end(), inner.rbegin(), inner.rend());
  if (random.below(2) == 0) {
    for (Point& vertex : ring) vertex.x = -vertex.x;
    std::reverse(ring.begin(), ring.end());
  }
  return ring;
}

}  // namespace hullbench
