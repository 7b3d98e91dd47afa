#include "datasets/samplers/transcripts.hpp"

#include <cmath>

#include "datasets/random.hpp"
#include "datasets/samplers/density.hpp"
#include "datasets/samplers/draw.hpp"
#include "datasets/sampling.hpp"
#include "polylidar/point_locator.hpp"

namespace hullbench {

using polylidar::MultiPolygon;
using polylidar::Point;
using polylidar::PointLocator;

std::vector<Point> sample_transcripts(const MultiPolygon& shape, std::size_t n, double level,
                                      std::uint64_t seed) {
  UniformPoints uniform(shape, seed);
  const Point nucleus = drawn_place(shape, seed);
  const double deviation = kNucleusDeviation * std::sqrt(polylidar::area(shape));
  Random random(derive_seed(seed, "transcripts"));
  const std::size_t own = n - share(n, level);
  std::vector<Point> points;
  points.reserve(n);
  while (points.size() < own) {
    if (random.uniform() >= kNucleusShare) {
      points.push_back(uniform.next());
      continue;
    }
    Point point;
    do {
      point = moved_by_gaussian(nucleus, deviation, random);
    } while (!uniform.locator().contains(point));
    points.push_back(point);
  }
  const double reach = 2 * spacing(shape, n);
  while (points.size() < n) {
    const Point point = moved_by_gaussian(uniform.next(), reach, random);
    if (!uniform.locator().contains(point)) points.push_back(point);
  }
  return points;
}

}  // namespace hullbench
