// Where the simulated camera's two imagers are in the floor's frame.
#pragma once

#include "datasets/rgbd/depth_image.hpp"
#include "datasets/rgbd/floor_layouts.hpp"
#include "datasets/rgbd/vector3.hpp"

namespace hullbench {

/// The camera of a FloorLayout, in the layout's frame.
struct StereoCamera {
  Vector3 right;    ///< the camera's x axis, of length 1
  Vector3 down;     ///< its y axis
  Vector3 forward;  ///< its z axis
  Vector3 left_eye;
  Vector3 right_eye;

  /// From either eye through image position (u, v): times a depth it leads to the point at that depth.
  Vector3 direction(const Intrinsics& intrinsics, double u, double v) const {
    const Vector3 ray = pixel_ray(intrinsics, u, v);
    return ray.x * right + ray.y * down + forward;
  }
};

/// The left eye stands on the z axis at the layout's height.
StereoCamera stereo_camera(const FloorLayout& layout);

}  // namespace hullbench
