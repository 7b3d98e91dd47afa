#include "datasets/rgbd/floor_points.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <stdexcept>

#include "datasets/random.hpp"

namespace hullbench {

using polylidar::Point;

namespace {

constexpr std::uint64_t kPlaneSeed = 1;

/// Each round takes the pixels near the plane of the round before; from the second on they hardly change.
constexpr int kRefinements = 5;

/// A pixel with depth.
struct Sample {
  std::int64_t column = 0;
  std::int64_t row = 0;
  Vector3 ray;  ///< with z = 1
  double depth = 0;
};

/// The plane's normal over its distance from the camera: on the plane, dot(plane, ray) is 1 / depth.
using InversePlane = Vector3;

std::vector<Sample> samples_of(const DepthImage& image) {
  const Intrinsics& camera = image.intrinsics;
  const auto width = static_cast<std::size_t>(camera.width);
  if (image.counts.size() != width * static_cast<std::size_t>(camera.height)) {
    throw std::invalid_argument("a depth image must have a count for each of its width * height pixels");
  }
  std::vector<Sample> samples;
  samples.reserve(image.counts.size());
  for (std::size_t i = 0; i < image.counts.size(); ++i) {
    if (image.counts[i] == 0) continue;
    const std::size_t column = i % width;
    const std::size_t row = i / width;
    samples.push_back({.column = static_cast<std::int64_t>(column),
                       .row = static_cast<std::int64_t>(row),
                       .ray = pixel_ray(camera, static_cast<double>(column), static_cast<double>(row)),
                       .depth = image.counts[i] * camera.depth_unit});
  }
  return samples;
}

/// The x with dot(a, x), dot(b, x), dot(c, x) = right.x, right.y, right.z; none when a, b, c lie in one
/// plane.
std::optional<Vector3> solve(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& right) {
  const double determinant = dot(a, cross(b, c));
  if (determinant == 0) return std::nullopt;
  return (1 / determinant) * (right.x * cross(b, c) + right.y * cross(c, a) + right.z * cross(a, b));
}

/// Whether the pixels, and with them the rays, determine no plane. In integers, because a determinant of
/// rounded rays is hardly ever exactly 0.
bool are_in_line(const Sample& a, const Sample& b, const Sample& c) {
  return (b.column - a.column) * (c.row - a.row) == (b.row - a.row) * (c.column - a.column);
}

/// Metres above the plane, towards the camera.
double height_above(const InversePlane& plane, double plane_length, const Sample& sample) {
  return (1 - dot(plane, sample.ray) * sample.depth) / plane_length;
}

std::size_t count_near(const InversePlane& plane, const std::vector<Sample>& samples) {
  const double plane_length = length(plane);
  return static_cast<std::size_t>(std::count_if(samples.begin(), samples.end(), [&](const Sample& sample) {
    return std::abs(height_above(plane, plane_length, sample)) <= kFloorBand;
  }));
}

/// The best of kPlaneTries planes through three pixels; none when every three were in line.
std::optional<InversePlane> consensus(const std::vector<Sample>& samples) {
  Random random(kPlaneSeed);
  const auto draw = [&]() -> const Sample& { return samples[random.below(samples.size())]; };
  std::optional<InversePlane> best;
  std::size_t best_count = 0;
  for (int attempt = 0; attempt < kPlaneTries; ++attempt) {
    const Sample& a = draw();
    const Sample& b = draw();
    const Sample& c = draw();
    if (are_in_line(a, b, c)) continue;
    const auto plane = solve(a.ray, b.ray, c.ray, {1 / a.depth, 1 / b.depth, 1 / c.depth});
    if (!plane) continue;
    const std::size_t count = count_near(*plane, samples);
    if (count > best_count) {
      best = plane;
      best_count = count;
    }
  }
  return best;
}

/// Least squares of dot(plane, ray) - 1 / depth over the samples near `guess`, by its normal equations.
std::optional<InversePlane> refine(const InversePlane& guess, const std::vector<Sample>& samples) {
  const double guess_length = length(guess);
  Vector3 row_x;
  Vector3 row_y;
  Vector3 row_1;
  Vector3 right;
  for (const Sample& sample : samples) {
    if (std::abs(height_above(guess, guess_length, sample)) > kFloorBand) continue;
    row_x = row_x + sample.ray.x * sample.ray;
    row_y = row_y + sample.ray.y * sample.ray;
    row_1 = row_1 + sample.ray;
    right = right + (1 / sample.depth) * sample.ray;
  }
  return solve(row_x, row_y, row_1, right);
}

InversePlane fit_floor(const std::vector<Sample>& samples) {
  if (samples.size() < 3) {
    throw std::runtime_error(
        "the depth image has fewer than 3 pixels with depth; take one that shows a floor");
  }
  std::optional<InversePlane> plane = consensus(samples);
  if (!plane) {
    throw std::runtime_error(
        "the depth image has depth hardly anywhere but along one line; take one that shows a floor");
  }
  for (int round = 0; round < kRefinements; ++round) {
    const auto refined = refine(*plane, samples);
    if (!refined) break;
    plane = refined;
  }
  return *plane;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

FloorPlane find_floor(const DepthImage& image) {
  const InversePlane plane = fit_floor(samples_of(image));
  const double distance = 1 / length(plane);
  return {.normal = distance * plane, .camera_height = distance};
}

std::vector<Point> floor_points(const DepthImage& image) {
  const std::vector<Sample> samples = samples_of(image);
  const InversePlane plane = fit_floor(samples);
  const double plane_length = length(plane);
  const Vector3 normal = (1 / plane_length) * plane;
  const Vector3 along = Vector3{1, 0, 0} - normal.x * normal;
  if (length(along) == 0) {
    throw std::runtime_error("the camera's x axis stands upright on the floor; turn the camera");
  }
  const Vector3 x_axis = (1 / length(along)) * along;
  // The floor's own z axis is -normal, up.
  const Vector3 y_axis = cross(x_axis, normal);

  std::vector<double> heights(samples.size());
  std::transform(samples.begin(), samples.end(), heights.begin(),
                 [&](const Sample& sample) { return height_above(plane, plane_length, sample); });
  const double limit = median(heights) + kFloorBand;
  std::vector<Point> points;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!(heights[i] < limit)) continue;
    const Vector3 position = samples[i].depth * samples[i].ray;
    points.push_back({dot(position, x_axis), dot(position, y_axis)});
  }
  return points;
}

}  // namespace hullbench
