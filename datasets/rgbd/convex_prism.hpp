// An upright prism over a convex footprint: what stands on the simulated floors.
#pragma once

#include <optional>

#include "datasets/rgbd/vector3.hpp"
#include "polylidar/geometry.hpp"

namespace hullbench {

/// The solid over a convex footprint on the plane z = 0, up to a height.
class ConvexPrism {
 public:
  /// `footprint`: convex, counter-clockwise, at least 3 vertices, in metres; `height`: metres, > 0. None of
  /// this is checked.
  ConvexPrism(polylidar::Ring footprint, double height);

  const polylidar::Ring& footprint() const { return footprint_; }
  double height() const { return height_; }

  /// Where the ray origin + t * direction enters the prism, as t > 0; none when it misses it, starts inside
  /// or has it behind. A ray that only touches a side or an edge misses it. On a side that the ray crosses at
  /// an angle, t is off by a few roundings over the angle's sine.
  std::optional<double> entry(const Vector3& origin, const Vector3& direction) const;

 private:
  polylidar::Ring footprint_;
  polylidar::Box box_;  ///< of the footprint
  double height_;
};

}  // namespace hullbench
