#include "tool/hull/streamed_shape.hpp"

#include <algorithm>
#include <stdexcept>

namespace polylidar::tool {

StreamedShape streamed_shape(const StreamedHull& hull) {
  StreamedShape streamed;
  streamed.numbers = hull.vertices;
  std::sort(streamed.numbers.begin(), streamed.numbers.end());
  streamed.numbers.erase(std::unique(streamed.numbers.begin(), streamed.numbers.end()),
                         streamed.numbers.end());
  streamed.points.resize(streamed.numbers.size());
  auto number = hull.vertices.begin();
  const auto indexed = [&](const Ring& ring) {
    IndexRing indices;
    indices.reserve(ring.size());
    for (const Point& point : ring) {
      const auto place = std::lower_bound(streamed.numbers.begin(), streamed.numbers.end(), *number++);
      const auto index = static_cast<std::uint32_t>(place - streamed.numbers.begin());
      streamed.points[index] = point;
      indices.push_back(index);
    }
    return indices;
  };
  for (const Polygon& polygon : hull.polygons) {
    streamed.shape.push_back({indexed(polygon.shell), {}});
    for (const Ring& hole : polygon.holes) streamed.shape.back().holes.push_back(indexed(hole));
  }
  return streamed;
}

std::vector<Point> points_of_numbers(std::span<const PointSource> sources,
                                     const std::vector<std::uint64_t>& numbers) {
  std::vector<Point> points;
  points.reserve(numbers.size());
  std::uint64_t first = 0;  // of the block
  const auto take = [&](std::span<const Point> block) {
    while (points.size() < numbers.size() && numbers[points.size()] < first + block.size()) {
      points.push_back(block[numbers[points.size()] - first]);
    }
    first += block.size();
  };
  for (const PointSource& source : sources) source(take);
  if (points.size() != numbers.size()) {
    throw std::runtime_error("the source has other points than when it was read before");
  }
  return points;
}

}  // namespace polylidar::tool
