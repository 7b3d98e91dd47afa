// The floor in a depth image: its plane, and its points as the paper's experiment took them (PAPER: section
// V, plane segmented point clouds from RGBD images).
#pragma once

#include <vector>

#include "datasets/rgbd/depth_image.hpp"
#include "datasets/rgbd/vector3.hpp"
#include "polylidar/geometry.hpp"

namespace hullbench {

/// How far above the median a floor point may lie, in metres: the experiment's 3.5 cm. Also how near to the
/// plane a point must be to have a say in it.
inline constexpr double kFloorBand = 0.035;

/// How many planes through three random pixels are tried. When half of the pixels are floor, one try in eight
/// has all three on it, and 100 tries without one happen in one image of 600,000.
inline constexpr int kPlaneTries = 100;

/// The floor in the camera's frame (x right, y down, z forward).
struct FloorPlane {
  Vector3 normal;            ///< of length 1, from the camera into the floor
  double camera_height = 0;  ///< metres from the camera straight to the floor, > 0
};

/// The plane that most of the pixels with depth lie on: random sample consensus (Fischler, Bolles: Random
/// Sample Consensus, CACM 24(6), 1981) of kPlaneTries tries with a fixed seed, then least squares over the
/// pixels within kFloorBand of it. The squares are of errors of 1 / depth, which on a plane is a linear
/// function of the pixel and, from a stereo camera, has the same noise near and far; squares of distances
/// would let the far floor's noise decide. Only + - * / and square roots: the same bits on every machine.
///
/// Throws std::invalid_argument when there are not width * height counts, std::runtime_error when fewer than
/// 3 pixels have depth or (nearly) all of them lie on one line.
FloorPlane find_floor(const DepthImage& image);

/// The points of the floor, in the floor's frame and in metres, row by row: origin at the camera's foot, x
/// along the camera's x axis laid on the floor, y so that the floor is seen from above (in an image taken
/// straight down: x right, y up). A pixel is floor when its height above find_floor's plane is below the
/// median height of all pixels with depth plus kFloorBand; the experiment's "depth below the median plus 3.5
/// cm" is read so because what stands on the floor is above it, and as there is no bound from below, noise
/// under the floor stays in.
///
/// Throws as find_floor, and std::runtime_error when the camera's x axis stands upright on the floor.
std::vector<polylidar::Point> floor_points(const DepthImage& image);

}  // namespace hullbench
