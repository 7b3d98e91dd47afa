// Points as a stereo depth camera low over the floor sees a floor that has the shape's outline; stress.hpp
// says what the kind is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "datasets/random.hpp"
#include "datasets/samplers/scan.hpp"
#include "polylidar/geometry.hpp"

namespace hullbench {

/// How the camera stands and what its pixels see. The floor is in the camera's own frame: x forward and y to
/// the left, from the camera's foot. The optical axis meets the floor at (distance, 0). A pixel's row grows
/// with the distance and its column to the left; (0, 0) is the optical axis.
struct DepthView {
  double distance = 0;  ///< from the foot to the middle of the shape, units of the coordinates
  double height = 0;    ///< the same units
  double focal = 0;     ///< pixels

  polylidar::Point place(double row, double column) const;
  /// What a pixel sees in truth: the lens turns the ray that it is taken for away from the optical axis, by
  /// kLensDistortion * r^2 of its r focal lengths (the first term of Brown: Close-Range Camera Calibration,
  /// Photogrammetric Engineering 37(8), 1971).
  polylidar::Point seen(double row, double column) const;
  double row(const polylidar::Point& place) const;
  double column(const polylidar::Point& place) const;
  /// Pixels between the two images of a place `forward` of the foot.
  double disparity(double forward) const;

 private:
  double slant() const;
  double depth(double forward) const;
};

/// What calibration leaves of the lens, k1 of the Brown-Conrady model: a hundredth at 45 degrees off the
/// axis. Users of a D415 saw rings of a hundredth of the distance on a plane (librealsense, issue 3210).
inline constexpr double kLensDistortion = 0.01;

/// The camera's baseline, in distances to the middle: 5 cm at 2 m.
inline constexpr double kDepthBaseline = 1.0 / 40;

struct DepthShot {
  ScanFrame frame;        ///< x is the direction of view
  polylidar::Point foot;  ///< of the camera, in the frame
  DepthView view;
  double row_offset = 0;     ///< rows are whole numbers and this, from 0 to 1
  double column_offset = 0;  ///< the same of columns
  std::vector<polylidar::Point> points;
};

/// One image, `turns` full turns counter-clockwise from x being the direction of view. At the middle of the
/// shape a pixel covers `pitch` squared. `level` as in stress.hpp.
DepthShot take_depth_shot(const polylidar::MultiPolygon& shape, double turns, double pitch, double level,
                          Random& random);

std::vector<polylidar::Point> sample_depth_camera(const polylidar::MultiPolygon& shape, std::size_t n,
                                                  double level, std::uint64_t seed);

}  // namespace hullbench
