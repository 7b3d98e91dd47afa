#include "datasets/samplers/airborne.hpp"

#include <cmath>

#include "datasets/samplers/scan.hpp"
#include "polylidar/point_locator.hpp"

namespace hullbench {

using polylidar::Box;
using polylidar::MultiPolygon;
using polylidar::Point;
using polylidar::PointLocator;

std::vector<Point> fly_over(const MultiPolygon& shape, double turns, double pitch, double level,
                            Mirror mirror, Random& random) {
  const ScanFrame frame(shape, turns);
  const PointLocator locator(shape);
  const Box& box = frame.bounds();
  const double along = pitch / std::sqrt(level);   // from point to point of a line
  const double across = pitch * std::sqrt(level);  // from line to line
  const double swath = kStripWidth * (box.max.y - box.min.y);
  // One more at either end, for what the phase leaves out.
  const int lines = static_cast<int>((box.max.x - box.min.x) / across) + 3;
  std::vector<Point> points;
  for (int strip = 0; strip < kStrips; ++strip) {
    const double side = box.min.y + 0.75 * strip * swath;
    const double start = box.min.x - across * (1 + random.uniform());
    for (int line = 0; line < lines; ++line) {
      const double phase = random.uniform();
      for (int shot = 0; along * (shot + phase) < swath; ++shot) {
        const double y = along * (shot + phase);
        double x = start + line * across;
        if (mirror == Mirror::kSwings) x += across * (line % 2 == 0 ? y : swath - y) / swath;
        const double dx = kLaserJitter * along * random.between(-1, 1);
        const double dy = kLaserJitter * along * random.between(-1, 1);
        const Point point = frame.in_plane({x + dx, side + y + dy});
        if (locator.contains(point)) points.push_back(point);
      }
    }
  }
  return points;
}

namespace {

std::vector<Point> sample_flight(const MultiPolygon& shape, std::size_t n, double level, std::uint64_t seed,
                                 Mirror mirror) {
  return scan_exactly(shape, n, derive_seed(seed, "airborne"), [&](double pitch, Random& random) {
    const double turns = random.uniform();
    return fly_over(shape, turns, pitch, level, mirror, random);
  });
}

}  // namespace

std::vector<Point> sample_airborne(const MultiPolygon& shape, std::size_t n, double level,
                                   std::uint64_t seed) {
  return sample_flight(shape, n, level, seed, Mirror::kRotates);
}

std::vector<Point> sample_zigzag(const MultiPolygon& shape, std::size_t n, double level, std::uint64_t seed) {
  return sample_flight(shape, n, level, seed, Mirror::kSwings);
}

}  // namespace hullbench
