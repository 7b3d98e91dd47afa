#include "benchmarks/run/point_parts.hpp"

#include <algorithm>

#include "datasets/random.hpp"

namespace hullbench::run {
namespace {

/// Which `chosen` of `count` things are drawn.
std::vector<bool> draw(std::size_t count, std::size_t chosen, std::uint64_t seed) {
  std::vector<bool> drawn(count);
  Random random(seed);
  // Of each thing by what is still to be chosen of what is left (Knuth, TAOCP 2, 3.4.2, algorithm S).
  for (std::size_t i = 0; i < count; ++i) {
    drawn[i] = random.below(count - i) < chosen;
    if (drawn[i]) --chosen;
  }
  return drawn;
}

}  // namespace

PointParts draw_parts(std::span<const Point> points, const std::string& name, std::uint64_t seed,
                      int number) {
  const std::string label = name + "/draw:" + std::to_string(number);
  const std::vector<bool> in_half =
      draw(points.size(), points.size() / 2, derive_seed(seed, "half/" + label));
  const std::vector<bool> in_most =
      draw(points.size(), points.size() - points.size() / 10, derive_seed(seed, "most/" + label));
  PointParts parts;
  for (std::size_t i = 0; i < points.size(); ++i) {
    (in_half[i] ? parts.half : parts.other_half).push_back(points[i]);
    if (in_most[i]) parts.most.push_back(points[i]);
  }
  return parts;
}

std::vector<Point> draw_sample(std::span<const Point> points, std::size_t count, std::uint64_t seed) {
  const std::vector<bool> drawn =
      draw(points.size(), std::min(count, points.size()), derive_seed(seed, "sample"));
  std::vector<Point> sample;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (drawn[i]) sample.push_back(points[i]);
  }
  return sample;
}

}  // namespace hullbench::run
