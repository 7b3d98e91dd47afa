#include "datasets/rgbd/floor_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <string>

#include "datasets/random.hpp"
#include "datasets/rgbd/floor_points.hpp"
#include "datasets/rgbd/stereo_camera.hpp"

namespace hullbench {

namespace {

/// 212 pixels, half of the image's width, over the tangent of 43.5 degrees.
constexpr double kFocalLength = 223.40138655956403;

/// A surface hides a point when it is nearer to the eye by more than this part of the way: above the rounding
/// of the point itself, some 1e-15, and far below anything that an image shows.
constexpr double kSameSurface = 1e-9;

/// What the left imager sees without errors, row-major.
struct Sight {
  std::vector<double> depth;  ///< metres, > 0: every ray meets an obstacle or the floor
  /// 1 when the right imager sees the same place, else 0. (std::vector<bool> packs bits, which is slower.)
  std::vector<unsigned char> is_shared;
};

double depth_along(const FloorLayout& layout, const Vector3& eye, const Vector3& direction) {
  double depth = -eye.z / direction.z;
  for (const ConvexPrism& obstacle : layout.obstacles) {
    const std::optional<double> entry = obstacle.entry(eye, direction);
    if (entry && *entry < depth) depth = *entry;
  }
  return depth;
}

bool sees(const FloorLayout& layout, const Vector3& eye, const Vector3& place) {
  return std::none_of(layout.obstacles.begin(), layout.obstacles.end(), [&](const ConvexPrism& obstacle) {
    const std::optional<double> entry = obstacle.entry(eye, place - eye);
    return entry && *entry < 1 - kSameSurface;
  });
}

Sight look(const FloorLayout& layout, const Intrinsics& intrinsics) {
  const StereoCamera camera = stereo_camera(layout);
  Sight sight;
  for (int row = 0; row < intrinsics.height; ++row) {
    for (int column = 0; column < intrinsics.width; ++column) {
      const Vector3 direction = camera.direction(intrinsics, column, row);
      const double depth = depth_along(layout, camera.left_eye, direction);
      const double right_column = column - intrinsics.fx * kStereoBaseline / depth;
      const bool is_shared =
          right_column >= -0.5 && sees(layout, camera.right_eye, camera.left_eye + depth * direction);
      sight.depth.push_back(depth);
      sight.is_shared.push_back(is_shared ? 1 : 0);
    }
  }
  return sight;
}

/// Whether one of the four neighbours of pixel i is on another surface.
bool is_edge(const std::vector<double>& depth, std::size_t width, std::size_t i) {
  const auto differs = [&](std::size_t neighbour) {
    return std::abs(depth[neighbour] - depth[i]) > kEdgeStep;
  };
  const std::size_t column = i % width;
  return (column > 0 && differs(i - 1)) || (column + 1 < width && differs(i + 1)) ||
         (i >= width && differs(i - width)) || (i + width < depth.size() && differs(i + width));
}

/// Normal with mean 0 and deviation 1, nearly: twelve uniform numbers have variance 1/12 each. Logarithms and
/// sines, as the exact ways need them, are not the same on every machine.
double normal(Random& random) {
  double sum = -6;
  for (int i = 0; i < 12; ++i) sum += random.uniform();
  return sum;
}

/// The depth, in metres, that a disparity with errors gives. Disparities are above 4 pixels in every scene,
/// so none comes near 0.
double measured_depth(double depth, double focal_length, const SensorNoise& noise, double error) {
  double disparity = focal_length * kStereoBaseline / depth + noise.subpixel_error * error;
  if (noise.disparity_step > 0) {
    disparity = std::floor(disparity / noise.disparity_step + 0.5) * noise.disparity_step;
  }
  return focal_length * kStereoBaseline / disparity;
}

void check(const SensorNoise& noise) {
  const auto is_below = [](double value, double limit) { return value >= 0 && value <= limit; };
  // Above these a scene's smallest disparity, 4 pixels, could be lost.
  if (!is_below(noise.subpixel_error, 0.5) || !is_below(noise.disparity_step, 1)) {
    throw std::invalid_argument("the error of a disparity must be 0 to 0.5 pixels and its step 0 to 1 pixel");
  }
  if (!is_below(noise.edge_dropout, 1)) {
    throw std::invalid_argument("the dropout at edges must be a probability, 0 to 1");
  }
}

}  // namespace

Intrinsics simulated_camera() {
  return {.width = 424,
          .height = 240,
          .fx = kFocalLength,
          .fy = kFocalLength,
          .ppx = 211.5,
          .ppy = 119.5,
          .depth_unit = 0.001};
}

StereoCamera stereo_camera(const FloorLayout& layout) {
  return {.right = {1, 0, 0},
          .down = {0, -layout.tilt_cosine, -layout.tilt_sine},
          .forward = {0, layout.tilt_sine, -layout.tilt_cosine},
          .left_eye = {0, 0, layout.camera_height},
          .right_eye = {kStereoBaseline, 0, layout.camera_height}};
}

DepthImage simulate_depth(std::size_t index, std::uint64_t seed, const SensorNoise& noise) {
  check(noise);
  const Intrinsics camera = simulated_camera();
  const Sight sight = look(floor_layout(index), camera);
  const auto width = static_cast<std::size_t>(camera.width);
  Random random(derive_seed(seed, "rgbd/" + std::to_string(index)));
  DepthImage image{.intrinsics = camera, .counts = std::vector<std::uint16_t>(sight.depth.size(), 0)};
  for (std::size_t i = 0; i < sight.depth.size(); ++i) {
    // Drawn for every pixel, so that a change in one place of a scene leaves the noise elsewhere as it was.
    const double error = normal(random);
    const bool drops = random.uniform() < noise.edge_dropout;
    if (sight.is_shared[i] == 0 || (drops && is_edge(sight.depth, width, i))) continue;
    const double depth = measured_depth(sight.depth[i], camera.fx, noise, error);
    image.counts[i] = static_cast<std::uint16_t>(std::lround(depth / camera.depth_unit));
  }
  return image;
}

FloorScene simulate_floor(std::size_t index, std::uint64_t seed) {
  return {.points = floor_points(simulate_depth(index, seed)), .ground_truth = floor_ground_truth(index)};
}

}  // namespace hullbench
