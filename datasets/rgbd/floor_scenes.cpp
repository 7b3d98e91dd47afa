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

/// Whether the right imager's image has `place`, if nothing hides it.
bool is_in_right_image(const StereoCamera& camera, const Intrinsics& intrinsics, const Vector3& place) {
  const Vector3 from_eye = place - camera.right_eye;
  const double depth = dot(from_eye, camera.forward);
  const double x = dot(from_eye, camera.right) / depth;
  const double y = dot(from_eye, camera.down) / depth;
  // The position whose ray the lens bends there. Each round leaves some thirtieth of the error.
  double bend = 1;
  for (int round = 0; round < 12; ++round) {
    bend = 1 + camera.lens * (x * x + y * y) / (bend * bend);
  }
  const double column = intrinsics.ppx + intrinsics.fx * x / bend;
  const double row = intrinsics.ppy + intrinsics.fy * y / bend;
  return column >= -0.5 && row >= -0.5 && row <= intrinsics.height - 0.5;
}

Sight look(const FloorLayout& layout, const Intrinsics& intrinsics) {
  const StereoCamera camera = stereo_camera(layout);
  Sight sight;
  for (int row = 0; row < intrinsics.height; ++row) {
    for (int column = 0; column < intrinsics.width; ++column) {
      const Vector3 direction = camera.direction(intrinsics, column, row);
      const double depth = depth_along(layout, camera.left_eye, direction);
      const Vector3 place = camera.left_eye + depth * direction;
      const bool in_right_image = camera.lens == 0 ? column - intrinsics.fx * kStereoBaseline / depth >= -0.5
                                                   : is_in_right_image(camera, intrinsics, place);
      const bool is_shared = in_right_image && sees(layout, camera.right_eye, place);
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

/// Normal with mean 0 and deviation 1, nearly: twelve uniform numbers have variance 1/12 each. Kept as it is,
/// so that the floors keep their bits; elsewhere it is Random::normal().
double normal(Random& random) {
  double sum = -6;
  for (int i = 0; i < 12; ++i) sum += random.uniform();
  return sum;
}

/// What a pixel's noise is before SensorNoise scales it.
struct PixelNoise {
  std::vector<double> error;         ///< of mean 0 and deviation 1, row-major
  std::vector<unsigned char> drops;  ///< 1: left without depth when it is at an edge
};

/// Drawn for every pixel, so that a change in one place of a scene leaves the noise elsewhere as it was.
PixelNoise independent_noise(std::size_t pixels, double dropout, Random& random) {
  PixelNoise noise;
  for (std::size_t i = 0; i < pixels; ++i) {
    noise.error.push_back(normal(random));
    noise.drops.push_back(random.uniform() < dropout ? 1 : 0);
  }
  return noise;
}

/// A pixel's error is the sum of nine independent ones, of its window, over 3.
PixelNoise window_noise(std::size_t width, std::size_t height, double dropout, Random& random) {
  std::vector<double> white((width + 2) * (height + 2));
  for (double& one : white) one = normal(random);
  PixelNoise noise;
  for (std::size_t row = 0; row < height; ++row) {
    for (std::size_t column = 0; column < width; ++column) {
      double sum = 0;
      for (std::size_t line = row; line < row + 3; ++line) {
        const std::size_t first = line * (width + 2) + column;
        sum += white[first] + white[first + 1] + white[first + 2];
      }
      noise.error.push_back(sum / 3);
      noise.drops.push_back(random.uniform() < dropout ? 1 : 0);
    }
  }
  return noise;
}

/// Whether the disparity of one of the eight neighbours of pixel i is another surface's.
bool is_low_edge(const std::vector<double>& depth, std::size_t width, std::size_t i) {
  const std::size_t row = i / width;
  const std::size_t column = i % width;
  const std::size_t last_row = std::min(row + 1, depth.size() / width - 1);
  const std::size_t last_column = std::min(column + 1, width - 1);
  for (std::size_t r = row > 0 ? row - 1 : 0; r <= last_row; ++r) {
    for (std::size_t c = column > 0 ? column - 1 : 0; c <= last_column; ++c) {
      const double difference = kFocalLength * kStereoBaseline * (1 / depth[r * width + c] - 1 / depth[i]);
      if (std::abs(difference) > kLowEdgeStep) return true;
    }
  }
  return false;
}

/// The depth, in metres, that a disparity with errors gives. Disparities are above 2.3 pixels in every scene,
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
  // Above these a scene's smallest disparity, 4 pixels, could be lost; of a low scene the one of the range.
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

Intrinsics scene_camera(std::size_t index) {
  if (index < kFloorScenes) return simulated_camera();
  return {.width = 212,
          .height = 120,
          .fx = kFocalLength / 2,
          .fy = kFocalLength / 2,
          .ppx = 105.5,
          .ppy = 59.5,
          .depth_unit = 0.001};
}

StereoCamera stereo_camera(const FloorLayout& layout) {
  return {.right = {1, 0, 0},
          .down = {0, -layout.tilt_cosine, -layout.tilt_sine},
          .forward = {0, layout.tilt_sine, -layout.tilt_cosine},
          .left_eye = {0, 0, layout.camera_height},
          .right_eye = {kStereoBaseline, 0, layout.camera_height},
          .lens = layout.is_low ? kLowLens : 0};
}

DepthImage simulate_depth(std::size_t index, std::uint64_t seed, const SensorNoise& noise) {
  check(noise);
  const Intrinsics camera = scene_camera(index);
  const FloorLayout layout = floor_layout(index);
  const Sight sight = look(layout, camera);
  const auto width = static_cast<std::size_t>(camera.width);
  Random random(derive_seed(seed, "rgbd/" + std::to_string(index)));
  DepthImage image{.intrinsics = camera, .counts = std::vector<std::uint16_t>(sight.depth.size(), 0)};
  const PixelNoise drawn =
      layout.is_low ? window_noise(width, static_cast<std::size_t>(camera.height), noise.edge_dropout, random)
                    : independent_noise(sight.depth.size(), noise.edge_dropout, random);
  for (std::size_t i = 0; i < sight.depth.size(); ++i) {
    if (sight.is_shared[i] == 0) continue;
    const bool at_edge = layout.is_low ? is_low_edge(sight.depth, width, i) : is_edge(sight.depth, width, i);
    if (at_edge && drawn.drops[i] != 0) continue;
    const double depth = measured_depth(sight.depth[i], kFocalLength, noise, drawn.error[i]);
    if (layout.is_low && depth > kLowRange) continue;
    image.counts[i] = static_cast<std::uint16_t>(std::lround(depth / camera.depth_unit));
  }
  return image;
}

FloorScene simulate_floor(std::size_t index, std::uint64_t seed) {
  return {.points = floor_points(simulate_depth(index, seed)), .ground_truth = floor_ground_truth(index)};
}

}  // namespace hullbench
