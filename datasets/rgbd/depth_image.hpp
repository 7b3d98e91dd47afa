// A depth camera's image and how its pixels look into space.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "datasets/rgbd/vector3.hpp"

namespace hullbench {

/// A pinhole camera without distortion, in the convention of librealsense: pixel (column, row) has its centre
/// at (column, row), so that the image spans -0.5 to width - 0.5; the camera's frame has x right, y down and
/// z forward, in metres.
struct Intrinsics {
  int width = 0;          ///< columns, >= 1
  int height = 0;         ///< rows, >= 1
  double fx = 0;          ///< focal length in pixels, along a row, > 0
  double fy = 0;          ///< the same, along a column
  double ppx = 0;         ///< column that the optical axis goes through, in pixels
  double ppy = 0;         ///< row that the optical axis goes through, in pixels
  double depth_unit = 0;  ///< metres a count, > 0: 0.001 for the D400 series as delivered

  friend bool operator==(const Intrinsics&, const Intrinsics&) = default;
};

/// The ray through image position (u, v), in pixels, scaled so that its z is 1: times a depth it is the
/// point.
Vector3 pixel_ray(const Intrinsics& intrinsics, double u, double v);

/// Depth along the optical axis (not along the ray), as depth cameras give it.
struct DepthImage {
  Intrinsics intrinsics;
  /// Row-major, width * height of them, in depth units; 0: no depth there.
  std::vector<std::uint16_t> counts;

  friend bool operator==(const DepthImage&, const DepthImage&) = default;
};

/// The 16-bit grey PNG at `path` as the image of the camera `intrinsics`; gamma and other hints in the file
/// are left aside: a count is what is stored.
///
/// Throws std::runtime_error naming the file, what is wrong and what to do when it cannot be read, is not a
/// PNG, not 16-bit grey, not of the camera's size, or damaged.
DepthImage read_depth_png(const std::filesystem::path& path, const Intrinsics& intrinsics);

/// A JSON object with the members of Intrinsics by their names. Throws std::runtime_error naming the file,
/// the member and what to give when the file is missing, not JSON, or a member is missing or out of its
/// range.
Intrinsics read_intrinsics(const std::filesystem::path& path);

}  // namespace hullbench
