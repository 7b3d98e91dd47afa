#include "datasets/rgbd/floor_layouts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <string>

#include "datasets/holes.hpp"

namespace hullbench {

using polylidar::Point;
using polylidar::Ring;

namespace {

enum class Footprint { kBox, kCylinder, kTriangle, kHexagon };

/// One row of the scenes below. Metres.
struct Obstacle {
  Footprint footprint;
  Point centre;
  double length;    ///< of the footprint along `direction`
  double width;     ///< across it
  Point direction;  ///< of any length but 0
  double height;
};

constexpr auto kBox = Footprint::kBox;
constexpr auto kCylinder = Footprint::kCylinder;
constexpr auto kTriangle = Footprint::kTriangle;
constexpr auto kHexagon = Footprint::kHexagon;

/// The floor that both imagers see reaches from -1.37 to 1.42 and from -0.80 to 0.80 in the first ten scenes,
/// and in the last one from -0.27 (3.4 wide) to 2.29 (5.1 wide).
const std::array<std::vector<Obstacle>, kFloorScenes + kLowFloorScenes> kScenes{{
    // 0: a box and a bin
    {{kBox, {0.30, 0.10}, 0.60, 0.40, {5, 2}, 0.35}, {kCylinder, {-0.75, -0.25}, 0.40, 0.40, {1, 0}, 0.30}},
    // 1: two boxes and a bin
    {{kBox, {-0.80, 0.30}, 0.50, 0.35, {1, 1}, 0.30},
     {kBox, {0.70, -0.30}, 0.45, 0.30, {3, -1}, 0.40},
     {kCylinder, {0.25, 0.45}, 0.30, 0.30, {1, 0}, 0.45}},
    // 2: an L of two boxes, and a small box
    {{kBox, {-0.40, 0.00}, 0.80, 0.25, {1, 0}, 0.30},
     {kBox, {-0.675, -0.20}, 0.25, 0.60, {1, 0}, 0.30},
     {kBox, {0.80, 0.30}, 0.30, 0.25, {2, 1}, 0.20}},
    // 3: low things spread out
    {{kBox, {-0.90, 0.45}, 0.35, 0.25, {4, 1}, 0.08},
     {kTriangle, {-0.35, -0.35}, 0.45, 0.45, {0, 1}, 0.10},
     {kHexagon, {0.30, 0.30}, 0.45, 0.45, {1, 0}, 0.12},
     {kCylinder, {0.85, -0.25}, 0.40, 0.40, {1, 0}, 0.15},
     {kBox, {-1.05, -0.40}, 0.25, 0.40, {1, 3}, 0.10},
     {kBox, {1.00, 0.45}, 0.40, 0.20, {1, -2}, 0.18}},
    // 4: one tall bin near the middle, and a crate at the upper border
    {{kCylinder, {0.10, -0.10}, 0.35, 0.35, {1, 0}, 0.70}, {kBox, {-0.85, 0.75}, 0.60, 0.40, {6, 1}, 0.25}},
    // 5: hexagons and a triangle
    {{kHexagon, {-0.55, 0.20}, 0.50, 0.50, {3, 1}, 0.25},
     {kHexagon, {0.60, -0.35}, 0.40, 0.40, {1, 0}, 0.35},
     {kTriangle, {0.75, 0.45}, 0.45, 0.45, {-2, 1}, 0.20},
     {kCylinder, {-1.10, -0.50}, 0.22, 0.22, {1, 0}, 0.30}},
    // 6: a wall of two boxes that nearly divides the floor
    {{kBox, {0.05, 0.30}, 0.14, 0.80, {6, 1}, 0.30},
     {kBox, {-0.15, -0.62}, 0.14, 0.50, {6, 1}, 0.30},
     {kHexagon, {0.90, 0.00}, 0.35, 0.35, {2, 1}, 0.15}},
    // 7: obstacles at all four borders
    {{kBox, {-1.35, 0.10}, 0.40, 0.50, {8, 1}, 0.20},
     {kBox, {1.40, -0.20}, 0.35, 0.60, {9, -1}, 0.25},
     {kCylinder, {-0.30, 0.80}, 0.45, 0.45, {1, 0}, 0.20},
     {kTriangle, {0.45, -0.75}, 0.55, 0.55, {1, 2}, 0.20},
     {kBox, {0.20, 0.10}, 0.25, 0.25, {1, 1}, 0.30}},
    // 8: many thin posts
    {{kCylinder, {-1.00, 0.50}, 0.12, 0.12, {1, 0}, 0.50},
     {kCylinder, {-0.95, -0.35}, 0.10, 0.10, {1, 0}, 0.60},
     {kCylinder, {-0.40, 0.10}, 0.15, 0.15, {1, 0}, 0.55},
     {kCylinder, {0.05, -0.45}, 0.12, 0.12, {1, 0}, 0.50},
     {kCylinder, {0.15, 0.45}, 0.10, 0.10, {1, 0}, 0.60},
     {kCylinder, {0.55, -0.05}, 0.16, 0.16, {1, 0}, 0.45},
     {kCylinder, {0.95, 0.40}, 0.12, 0.12, {1, 0}, 0.40},
     {kCylinder, {0.90, -0.50}, 0.14, 0.14, {1, 0}, 0.40}},
    // 9: two boxes of different heights that meet, a box on its corner, and low plates between them
    {{kBox, {0.50, 0.30}, 0.60, 0.20, {4, -1}, 0.40},
     {kBox, {0.30, 0.10}, 0.20, 0.55, {4, -1}, 0.20},
     {kBox, {-0.75, -0.15}, 0.40, 0.40, {1, 1}, 0.25},
     {kBox, {-0.30, 0.50}, 0.35, 0.20, {1, 0}, 0.08},
     {kTriangle, {0.95, -0.45}, 0.40, 0.40, {0, -1}, 0.12}},
    // 10: the tilted view of a room
    {{kBox, {-1.00, 0.60}, 0.60, 0.45, {3, 1}, 0.50},
     {kCylinder, {0.30, 0.40}, 0.40, 0.40, {1, 0}, 0.40},
     {kBox, {1.30, 1.10}, 0.50, 0.70, {5, -1}, 0.60},
     {kHexagon, {-0.30, 1.50}, 0.50, 0.50, {1, 0}, 0.30},
     {kTriangle, {1.00, 0.05}, 0.50, 0.50, {1, 1}, 0.15},
     {kBox, {0.40, 1.90}, 0.40, 0.30, {2, 1}, 0.20}},
    // 11: a robot's view over the floor in front of it, from 0.14 to 1.98
    {{kBox, {0.25, 0.70}, 0.20, 0.15, {3, 1}, 0.12},
     {kCylinder, {-0.35, 1.00}, 0.15, 0.15, {1, 0}, 0.20},
     {kTriangle, {-0.10, 0.45}, 0.12, 0.12, {0, 1}, 0.05}},
    // 12: the same from higher up, from 0.23 to 3.3
    {{kBox, {-0.60, 1.40}, 0.40, 0.30, {2, 1}, 0.25},
     {kCylinder, {0.40, 1.00}, 0.25, 0.25, {1, 0}, 0.30},
     {kHexagon, {0.90, 2.00}, 0.40, 0.40, {1, 0}, 0.20},
     {kBox, {-0.10, 0.60}, 0.15, 0.20, {4, 1}, 0.10}},
    // 13: a room from 0.37 to 4.4, where the camera's range ends
    {{kBox, {0.80, 1.80}, 0.60, 0.40, {5, 1}, 0.50},
     {kCylinder, {-0.70, 1.50}, 0.30, 0.30, {1, 0}, 0.60},
     {kBox, {-1.20, 2.60}, 0.50, 0.50, {1, 1}, 0.40},
     {kHexagon, {0.20, 2.90}, 0.40, 0.40, {1, 0}, 0.25},
     {kCylinder, {0.00, 0.90}, 0.20, 0.20, {1, 0}, 0.15}},
    // 14: from a table's height and steeper, from 0.18 to 2.6
    {{kBox, {-0.80, 1.00}, 0.50, 0.40, {3, 1}, 0.40},
     {kCylinder, {0.30, 0.80}, 0.30, 0.30, {1, 0}, 0.70},
     {kTriangle, {0.90, 1.60}, 0.50, 0.50, {1, 2}, 0.30},
     {kBox, {-0.20, 1.90}, 0.60, 0.30, {6, -1}, 0.50}},
}};

constexpr double kStraightDownHeight = 1.5;
constexpr double kTiltedHeight = 2.0;
/// 44 and 117 are the legs of a right triangle with the hypotenuse 125: an angle of 20.6 degrees whose sine
/// and cosine need no rounded function.
constexpr double kTiltSine = 0.352;
constexpr double kTiltCosine = 0.936;

/// Where the camera of a low scene is.
struct LowCamera {
  double height;  ///< metres
  double tilt_sine;
  double tilt_cosine;
};

/// The angles of the triangle with the sides 3, 4 and 5.
constexpr std::array<LowCamera, kLowFloorScenes> kLowCameras{
    {{0.3, 0.8, 0.6}, {0.5, 0.8, 0.6}, {0.8, 0.8, 0.6}, {1.2, 0.6, 0.8}}};

/// The footprint in a square of side 1 round the origin, counter-clockwise.
Ring unit_footprint(Footprint footprint) {
  if (footprint == kBox) return {{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}};
  if (footprint == kTriangle) return {{-0.5, -0.5}, {0.5, -0.5}, {0, 0.5}};
  if (footprint == kHexagon) {
    const double across = std::sqrt(3.0) / 4;
    return {{0.5, 0}, {0.25, across}, {-0.25, across}, {-0.5, 0}, {-0.25, -across}, {0.25, -across}};
  }
  Ring circle;
  const auto directions = hole_directions();
  std::transform(directions.begin(), directions.end(), std::back_inserter(circle),
                 [](const Point& direction) {
                   return Point{direction.x / 2, direction.y / 2};
                 });
  return circle;
}

ConvexPrism stand(const Obstacle& obstacle) {
  const Point& direction = obstacle.direction;
  const double norm = std::sqrt(direction.x * direction.x + direction.y * direction.y);
  const double cosine = direction.x / norm;
  const double sine = direction.y / norm;
  const double minus_sine = -sine;  // sums in both coordinates: see turned() in portable_math.hpp
  Ring footprint = unit_footprint(obstacle.footprint);
  for (Point& vertex : footprint) {
    const double along = vertex.x * obstacle.length;
    const double across = vertex.y * obstacle.width;
    vertex = {obstacle.centre.x + cosine * along + minus_sine * across,
              obstacle.centre.y + sine * along + cosine * across};
  }
  return {std::move(footprint), obstacle.height};
}

}  // namespace

FloorLayout floor_layout(std::size_t index) {
  if (index >= kScenes.size()) {
    throw std::invalid_argument("there is no floor scene " + std::to_string(index) + "; give 0 to " +
                                std::to_string(kScenes.size() - 1));
  }
  FloorLayout layout;
  layout.camera_height = kStraightDownHeight;
  if (index == kFloorScenes - 1) {
    layout.camera_height = kTiltedHeight;
    layout.tilt_sine = kTiltSine;
    layout.tilt_cosine = kTiltCosine;
  } else if (index >= kFloorScenes) {
    const LowCamera& camera = kLowCameras[index - kFloorScenes];
    layout.camera_height = camera.height;
    layout.tilt_sine = camera.tilt_sine;
    layout.tilt_cosine = camera.tilt_cosine;
    layout.is_low = true;
  }
  std::transform(kScenes[index].begin(), kScenes[index].end(), std::back_inserter(layout.obstacles), stand);
  return layout;
}

}  // namespace hullbench
