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

/// The camera of scene `index`: simulated_camera(), and in the low scenes the same at half the resolution, as
/// librealsense's decimation filter leaves it.
Intrinsics scene_camera(std::size_t index);

/// Depth beyond which the low scenes have none, in metres: that of librealsense's threshold filter.
inline constexpr double kLowRange = 4;

/// k1 of the low scenes' lens: what calibration leaves (samplers/depth_camera.hpp has the source).
inline constexpr double kLowLens = 0.01;

/// Difference of the disparities of neighbours that makes an edge in the low scenes, in pixels of the whole
/// resolution: above the 0.27 by which rows of the floor differ there at most. In depth, far rows differ by
/// more than obstacles do.
inline constexpr double kLowEdgeStep = 0.5;

/// How the simulated sensor errs. A real one also has errors that neighbouring pixels share, wider edges from
/// its matching window, and a lens: the low scenes have these too, the others do not.
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
/// The low scenes differ from the others as depth cameras on robots do. Rows stand apart by up to 5.6 times
/// of what pixels of a row do, and the nearest floor is 200 times as dense as the farthest. The errors of a
/// window of 3 x 3 pixels are shared, with the same standard deviation. An edge is where the disparity of one
/// of the eight neighbours differs by more than kLowEdgeStep. The lens is bent by kLowLens. Depth ends at
/// kLowRange.
///
/// The same bits on every machine; every index and seed has a stream of random numbers of its own. Throws
/// std::invalid_argument when there is no such scene or `noise` is out of its ranges.
DepthImage simulate_depth(std::size_t index, std::uint64_t seed, const SensorNoise& noise = {});

/// The part of scene `index`'s floor that both imagers see, in the frame of floor_points for a camera whose
/// position is known exactly: what both images cover, without the obstacles and what they hide from either.
/// Pixels are areas here, so points stay half a pixel (3 mm at 1.5 m) inside its outer border. In the low
/// scenes that is where the bent rays of the border meet the floor, in 64 straight pieces a side, less than
/// 0.01 mm off, and ends at kLowRange. Valid, shells counter-clockwise, holes clockwise.
///
/// The overlay's own rounding (Boost.Geometry's grid of 1e-7 of the extent) moves corners by less than a
/// micrometre, and may differ between versions of Boost. Throws std::invalid_argument when there is no such
/// scene.
polylidar::MultiPolygon floor_ground_truth(std::size_t index);

/// floor_points of simulate_depth, and floor_ground_truth. Throws as these.
FloorScene simulate_floor(std::size_t index, std::uint64_t seed);

}  // namespace hullbench
