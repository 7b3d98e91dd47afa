// What the simulated floor scenes look like: where the camera is and what stands on the floor.
#pragma once

#include <cstddef>
#include <vector>

#include "datasets/rgbd/convex_prism.hpp"

namespace hullbench {

/// As many as the paper's experiment has.
inline constexpr std::size_t kFloorScenes = 11;

/// Scenes that a low, tilted camera sees; they follow the others.
inline constexpr std::size_t kLowFloorScenes = 4;

/// A scene in the floor's frame: the floor is z = 0, z is up, the origin is the foot of the camera and x runs
/// along the camera's x axis, which is level.
struct FloorLayout {
  double camera_height = 0;  ///< metres
  /// Sine and cosine of the angle between the camera's view and straight down; tilted, it looks along +y.
  double tilt_sine = 0;
  double tilt_cosine = 1;
  /// Of a low scene: its camera is a real one (see floor_scenes.hpp).
  bool is_low = false;
  std::vector<ConvexPrism> obstacles;  ///< lower than the camera; they may overlap
};

/// Scene `index`, from 0: ten from 1.5 m straight down, the last one from 2 m and tilted by
/// 20.6 degrees. Obstacles are boxes, cylinders (64-gons), triangles, hexagons and L shapes of two boxes, 8
/// to 70 cm high (one in a low scene 5 cm); some reach over the border of the image. The kLowFloorScenes
/// behind them are seen from 0.3, 0.5, 0.8 and 1.2 m, tilted by 53.1 degrees, the last one by 36.9. Throws
/// std::invalid_argument for any other index.
FloorLayout floor_layout(std::size_t index);

}  // namespace hullbench
