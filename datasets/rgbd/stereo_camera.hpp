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
  double lens = 0;  ///< k1 of the Brown-Conrady model, of both lenses; 0: none

  /// From either eye, where image position (u, v) looks in truth: times a depth it leads to the point at that
  /// depth. pixel_ray is what the position is taken for.
  Vector3 direction(const Intrinsics& intrinsics, double u, double v) const {
    const Vector3 taken_for = pixel_ray(intrinsics, u, v);
    const double bend = 1 + lens * (taken_for.x * taken_for.x + taken_for.y * taken_for.y);
    const Vector3 ray = {bend * taken_for.x, bend * taken_for.y, 1};
    return ray.x * right + ray.y * down + forward;
  }
};

/// The left eye stands on the z axis at the layout's height.
StereoCamera stereo_camera(const FloorLayout& layout);

}  // namespace hullbench
