// Simulated recordings of floors with obstacles, seen by an Intel RealSense D435i, with the exact outline of
// the floor that the camera sees: the stand-in for the paper's eleven recordings (PAPER: section V, plane
// segmented point clouds from RGBD images).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "datasets/rgbd/depth_image.hpp"
#include "datasets/rgbd/floor_layouts.hpp"
#include "polylidar/geometry.hpp"

namespace hullbench {

/// The floor's points and the floor itself, in the frame of floor_points, metres.
struct FloorScene {
  std::vector<polylidar::Point> points;
  polylidar::MultiPolygon ground_truth;
};

/// Metres between the two imagers (Intel RealSense D400 Series datasheet: D435i). Depth is given for the left
/// one; the right one is this far along its x axis and looks the same way.
inline constexpr double kStereoBaseline = 0.05;

/// The D435i's depth image at 424 x 240, square pixels, the optical axis through the middle, a horizontal
/// field of view of 87 degrees (datasheet: 87 by 58, each +- 3), 1 mm a count.
Intrinsics simulated_camera();

/// How the simulated sensor errs. A real one also has errors that neighbouring pixels share, wider edges from
/// its matching window, and a lens; these are left out.
struct SensorNoise {
  /// Standard deviation of the disparity in pixels, >= 0, 0: none; independent in every pixel, normal (as a
  /// sum of twelve uniform numbers, so never beyond six deviations). Intel's formula for the error of depth
  /// is depth^2 * this / (focal length in pixels * baseline) (Grunnet-Jepsen, Sweetser, Woodfill: Tuning
  /// depth cameras for best performance). Its author puts it at 0.032 at the very best and 0.08 to be safe
  /// (librealsense, issue 3904); in between, 1.5 m gives 1 cm.
  double subpixel_error = 0.05;
  /// Disparities are rounded to multiples of this, in pixels, >= 0, 0: not rounded. The D400's is 1/32 of a
  /// pixel (Grunnet-Jepsen and others: Subpixel linearity improvement for Intel RealSense depth cameras).
  double disparity_step = 0x1p-5;
  /// How likely a pixel at an edge is left without depth, 0 to 1: an edge is where one of the four neighbours
  /// is more than kEdgeStep nearer or farther. Intel gives no figure; a half keeps and loses as many.
  double edge_dropout = 0.5;
};

/// Metres of depth between neighbouring pixels that make an edge: between the 1 cm of the noise and the 8 cm
/// of the lowest obstacle.
inline constexpr double kEdgeStep = 0.05;

/// What the left imager of scene `index` gives. A pixel has no depth when the right imager does not see the
/// same place: it is hidden behind an obstacle (the shadow on the obstacle's left), or beyond the image's
/// left border (a band as wide as the disparity). Otherwise its disparity, focal length * baseline / depth,
/// errs and is rounded as `noise` says, and the depth of that is rounded to whole counts.
///
/// The same bits on every machine; every index and seed has a stream of random numbers of its own. Throws
/// std::invalid_argument when there is no such scene or `noise` is out of its ranges.
DepthImage simulate_depth(std::size_t index, std::uint64_t seed, const SensorNoise& noise = {});

/// The part of scene `index`'s floor that both imagers see, in the frame of floor_points for a camera whose
/// position is known exactly: what both images cover, without the obstacles and what they hide from either.
/// Pixels are areas here, so points stay half a pixel (3 mm at 1.5 m) inside its outer border. Valid, shells
/// counter-clockwise, holes clockwise.
///
/// The overlay's own rounding (Boost.Geometry's grid of 1e-7 of the extent) moves corners by less than a
/// micrometre, and may differ between versions of Boost. Throws std::invalid_argument when there is no such
/// scene.
polylidar::MultiPolygon floor_ground_truth(std::size_t index);

/// floor_points of simulate_depth, and floor_ground_truth. Throws as these.
FloorScene simulate_floor(std::size_t index, std::uint64_t seed);

}  // namespace hullbench
