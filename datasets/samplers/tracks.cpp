#include "datasets/samplers/tracks.hpp"

#include <cmath>

#include "datasets/samplers/scan.hpp"
#include "polylidar/point_locator.hpp"

namespace hullbench {

using polylidar::Box;
using polylidar::MultiPolygon;
using polylidar::Point;
using polylidar::PointLocator;

namespace {

/// The roads of one direction.
void drive_direction(const MultiPolygon& shape, double turns, double step, double distance,
                     const PointLocator& locator, Random& random, std::vector<Point>& points) {
  const ScanFrame frame(shape, turns);
  const Box& box = frame.bounds();
  const double first = box.min.y - distance * random.uniform();
  const int roads = static_cast<int>((box.max.y - box.min.y) / distance) + 3;
  const int steps = static_cast<int>((box.max.x - box.min.x) / step) + 1;
  for (int road = 0; road < roads; ++road) {
    const double side = first + distance * (road + random.between(-kRoadShift, kRoadShift));
    for (int i = 0; i < steps; ++i) {
      const double x = box.min.x + step * (i + random.uniform());
      const double y = side + step * random.between(-kRoadHalfWidth, kRoadHalfWidth);
      const Point point = frame.in_plane({x, y});
      if (locator.contains(point)) points.push_back(point);
    }
  }
}

}  // namespace

std::vector<Point> drive_roads(const MultiPolygon& shape, double turns, double pitch, double level,
                               Random& random) {
  const PointLocator locator(shape);
  const double step = pitch * std::sqrt(2 / level);  // two directions, each with a point in step * distance
  std::vector<Point> points;
  for (const double direction : {turns, turns + 0.25}) {
    drive_direction(shape, direction, step, level * step, locator, random, points);
  }
  return points;
}

std::vector<Point> sample_tracks(const MultiPolygon& shape, std::size_t n, double level, std::uint64_t seed) {
  return scan_exactly(shape, n, derive_seed(seed, "tracks"), [&](double pitch, Random& random) {
    const double turns = random.uniform();
    return drive_roads(shape, turns, pitch, level, random);
  });
}

}  // namespace hullbench
