// Uniform random points in a shape.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "datasets/random.hpp"
#include "polylidar/geometry.hpp"
#include "polylidar/point_locator.hpp"

namespace hullbench {

/// The spacing h of `n` points in `shape`, sqrt(area / n): the side of the square that a point has for itself
/// on average. Infinite for n = 0.
double spacing(const polylidar::MultiPolygon& shape, std::size_t n);

/// Points without end, independent and uniform in a shape (holes left out), the same bits on every machine
/// for the same shape and seed. Drawn from the bounding box, x before y, and kept when the closed shape
/// contains them: a point exactly on a ring counts as inside. O(box area / shape area) a point.
class UniformPoints {
 public:
  /// Coordinates must be in the range of polylidar::orient2d. Throws std::invalid_argument when the shape
  /// covers less than a millionth of its bounding box (or has no area at all): drawing would hardly end.
  UniformPoints(const polylidar::MultiPolygon& shape, std::uint64_t seed);

  polylidar::Point next();

  /// Of the shape.
  const polylidar::PointLocator& locator() const { return locator_; }

 private:
  polylidar::PointLocator locator_;
  Random random_;
};

/// The first `n` of UniformPoints. Throws as its constructor.
std::vector<polylidar::Point> sample_uniform(const polylidar::MultiPolygon& shape, std::size_t n,
                                             std::uint64_t seed);

}  // namespace hullbench
