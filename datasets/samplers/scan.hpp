// What the samplers that imitate a sensor share: a shape seen in a direction, and the search for the
// resolution with which a scan has a given number of points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "datasets/portable_math.hpp"
#include "datasets/random.hpp"
#include "polylidar/geometry.hpp"

namespace hullbench {

/// Coordinates turned about the origin, so that x runs along a direction of the plane.
class ScanFrame {
 public:
  /// The direction is `turns` full turns counter-clockwise from x.
  ScanFrame(const polylidar::MultiPolygon& shape, double turns);

  polylidar::Point in_frame(const polylidar::Point& point) const {
    return turned(point, {along_.x, -along_.y});
  }
  polylidar::Point in_plane(const polylidar::Point& point) const { return turned(point, along_); }
  /// Of the shape, in the frame.
  const polylidar::Box& bounds() const { return bounds_; }

 private:
  polylidar::Point along_;
  polylidar::Box bounds_;
};

/// Leaves `n` of the points, each as likely to stay as the others, in their order (Knuth: The Art of Computer
/// Programming 2, algorithm 3.4.2 S).
std::vector<polylidar::Point> lose_points(const std::vector<polylidar::Point>& points, std::size_t n,
                                          Random& random);

/// The points that a sensor gets from a shape, in the order in which it gets them. `pitch` is its resolution:
/// about the spacing that the points will have, in units of the coordinates.
using Scan = std::function<std::vector<polylidar::Point>(double pitch, Random& random)>;

/// The points of `scan`, of which the pitch is chosen so that there are `n` and at most a twentieth and 8
/// more, or after 20 tries however many more, and the ones too many are lost at random. Every scan that is
/// tried has the same random numbers, those of `seed`. Throws as UniformPoints for a shape without area.
std::vector<polylidar::Point> scan_exactly(const polylidar::MultiPolygon& shape, std::size_t n,
                                           std::uint64_t seed, const Scan& scan);

}  // namespace hullbench
