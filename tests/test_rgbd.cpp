#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "datasets/point_bytes.hpp"
#include "datasets/rgbd/floor_points.hpp"
#include "datasets/rgbd/floor_scenes.hpp"
#include "datasets/rgbd/stereo_camera.hpp"
#include "datasets/sampling.hpp"
#include "datasets/sha256.hpp"
#include "polylidar/point_locator.hpp"
#include "tests/boost_checks.hpp"
#include "tests/complaint.hpp"

namespace hullbench::testing {

using polylidar::PointLocator;

namespace {

constexpr SensorNoise kNoNoise{.subpixel_error = 0, .disparity_step = 0, .edge_dropout = 0};
constexpr std::uint64_t kSeed = 1;

std::uint16_t count_at(const DepthImage& image, int column, int row) {
  return image.counts[static_cast<std::size_t>(row) * static_cast<std::size_t>(image.intrinsics.width) +
                      static_cast<std::size_t>(column)];
}

double inside_share(const FloorScene& scene) {
  const PointLocator floor(scene.ground_truth);
  const auto inside =
      std::ranges::count_if(scene.points, [&](const Point& point) { return floor.contains(point); });
  return static_cast<double>(inside) / static_cast<double>(scene.points.size());
}

TEST(SimulatedCamera, HasTheD435isFieldOfView) {
  const Intrinsics camera = simulated_camera();
  const auto degrees = [](double half_pixels, double focal_length) {
    return 2 * std::atan(half_pixels / focal_length) * 180 / std::numbers::pi;
  };
  EXPECT_EQ(camera.width, 424);
  EXPECT_EQ(camera.height, 240);
  // The focal length is given to all digits of a double.
  EXPECT_NEAR(degrees(camera.width / 2.0, camera.fx), 87, 1e-12);
  // The datasheet's tolerance; square pixels make it 56.5.
  EXPECT_NEAR(degrees(camera.height / 2.0, camera.fy), 58, 3);
  const Vector3 left = pixel_ray(camera, -0.5, -0.5);
  const Vector3 right = pixel_ray(camera, camera.width - 0.5, camera.height - 0.5);
  EXPECT_EQ(left, (Vector3{-right.x, -right.y, 1}));
}

class FloorSceneOf : public ::testing::TestWithParam<std::size_t> {};

INSTANTIATE_TEST_SUITE_P(All, FloorSceneOf, ::testing::Range<std::size_t>(0, kFloorScenes));

TEST_P(FloorSceneOf, WithoutNoiseLiesInItsGroundTruth) {
  // Half a count of depth is half a millimetre, on rays that reach at most 1.28 along the floor for 1 of
  // depth; the plane, which the lowest pixels of the obstacles' sides pull at, adds up to half a millimetre.
  constexpr double kBound = 0.0012;
  const std::vector<Point> points = floor_points(simulate_depth(GetParam(), kSeed, kNoNoise));
  const MultiPolygon truth = floor_ground_truth(GetParam());
  const PointLocator floor(truth);
  const auto beyond = std::ranges::count_if(points, [&](const Point& point) {
    return !floor.contains(point) && boost_distance(point, truth) > kBound;
  });
  // Where two obstacles meet, the foot of one's side, below the band, can show over the other's shadow: one
  // pixel in scenes 2 and 9.
  EXPECT_LE(beyond, 1);
}

TEST_P(FloorSceneOf, GroundTruthIsWhatBothImagersSee) {
  const FloorLayout layout = floor_layout(GetParam());
  const StereoCamera camera = stereo_camera(layout);
  const DepthImage image = simulate_depth(GetParam(), kSeed, kNoNoise);
  const Intrinsics& intrinsics = image.intrinsics;
  const MultiPolygon truth = floor_ground_truth(GetParam());
  std::size_t looked_at = 0;
  for (const Point& point : sample_uniform(truth, 3000, kSeed)) {
    // A pixel covers up to 12 by 16 mm of floor; its centre must be clear of the boundary.
    if (boost_distance(point, truth) < 0.012) continue;
    ++looked_at;
    const Vector3 place = Vector3{point.x, point.y, 0} - camera.left_eye;
    const double depth = dot(place, camera.forward);
    const double u = intrinsics.ppx + intrinsics.fx * dot(place, camera.right) / depth;
    const double v = intrinsics.ppy + intrinsics.fy * dot(place, camera.down) / depth;
    const int column = static_cast<int>(std::lround(u));
    const int row = static_cast<int>(std::lround(v));
    const Vector3 direction = camera.direction(intrinsics, column, row);
    // The floor's depth in that pixel; half a count of rounding.
    EXPECT_NEAR(count_at(image, column, row) * intrinsics.depth_unit, -camera.left_eye.z / direction.z,
                0.00051)
        << point.x << ' ' << point.y;
  }
  EXPECT_GT(looked_at, 2500U);
}

TEST_P(FloorSceneOf, GroundTruthIsAValidShape) {
  const MultiPolygon truth = floor_ground_truth(GetParam());
  EXPECT_EQ(boost_fault(truth), "");
  ASSERT_FALSE(truth.empty());
  for (const Polygon& polygon : truth) {
    EXPECT_GT(polylidar::signed_area(polygon.shell), 0);
    for (const Ring& hole : polygon.holes) EXPECT_LT(polylidar::signed_area(hole), 0);
  }
}

TEST_P(FloorSceneOf, PlaneIsTheTrueOne) {
  const FloorLayout layout = floor_layout(GetParam());
  const FloorPlane plane = find_floor(simulate_depth(GetParam(), kSeed));
  // Pixels on the obstacles' sides within the band pull at the plane: 0.25 milliradians and 0.6 mm were seen.
  EXPECT_NEAR(plane.normal.x, 0, 0.0005);
  EXPECT_NEAR(plane.normal.y, layout.tilt_sine, 0.0005);
  EXPECT_NEAR(plane.normal.z, layout.tilt_cosine, 0.0005);
  EXPECT_NEAR(length(plane.normal), 1, 1e-15);
  EXPECT_NEAR(plane.camera_height, layout.camera_height, 0.001);
}

TEST(FloorScenes, HaveThePapersNumberOfPoints) {
  std::size_t sum = 0;
  for (std::size_t index = 0; index < kFloorScenes; ++index) {
    const FloorScene scene = simulate_floor(index, kSeed);
    // Noise moves points along their rays, over the border by a centimetre or two.
    EXPECT_GT(inside_share(scene), 0.97) << index;
    sum += scene.points.size();
  }
  // 83,184 in the paper.
  EXPECT_GT(sum / kFloorScenes, 78'000U);
  EXPECT_LT(sum / kFloorScenes, 88'000U);
}

TEST(FloorScenes, GroundTruthHasTheAreaOfItsPixels) {
  for (std::size_t index = 0; index + 1 < kFloorScenes; ++index) {
    const DepthImage image = simulate_depth(index, kSeed, kNoNoise);
    const auto floor = std::ranges::count(image.counts, std::uint16_t{1500});
    const double side = 1.5 / image.intrinsics.fx;
    const double area = polylidar::area(floor_ground_truth(index));
    // Along borders that follow a row or column of pixels half a pixel can be lost: 1000 pixels' sides, half
    // of each, are 0.6 % of 80,000 pixels.
    EXPECT_NEAR(static_cast<double>(floor) * side * side, area, 0.006 * area) << index;
  }
}

TEST(FloorScenes, AreTheSameBitsEverywhere) {
  EXPECT_EQ(sha256_hex(point_bytes(simulate_floor(0, kSeed).points)),
            "01237d65bd0ba97d08cb6c252d2ac284822e20e0099d81be7c5bc02a7f3a31fd");
  EXPECT_EQ(sha256_hex(point_bytes(simulate_floor(10, kSeed).points)),
            "a6d1453b369435acee4e7e56a31582a6534ea177a10829b8361de9e64da9c915");
  EXPECT_EQ(sha256_hex(point_bytes(simulate_floor(kFloorScenes, kSeed).points)),
            "224dc6bf0490072313825daefa53caf2f0a48be518d6bd3ac7fe103b5239bb4d");
}

TEST(FloorScenes, SeedAndIndexDecide) {
  EXPECT_EQ(simulate_depth(3, 7), simulate_depth(3, 7));
  EXPECT_NE(simulate_depth(3, 7), simulate_depth(3, 8));
  // The last row shows bare floor in both scenes: only the noise can differ.
  const DepthImage one = simulate_depth(0, 7);
  const DepthImage other = simulate_depth(3, 7);
  EXPECT_FALSE(std::equal(one.counts.end() - one.intrinsics.width, one.counts.end(),
                          other.counts.end() - other.intrinsics.width));
}

/// The place of the floor that a pixel's middle sees, were there nothing on it, and its depth.
struct FloorSight {
  Point place;
  double depth = 0;
};

FloorSight floor_sight(const StereoCamera& camera, const Intrinsics& intrinsics, double column, double row) {
  const Vector3 direction = camera.direction(intrinsics, column, row);
  const double depth = -camera.left_eye.z / direction.z;
  const Vector3 place = camera.left_eye + depth * direction;
  return {{place.x, place.y}, depth};
}

class LowFloorOf : public ::testing::TestWithParam<std::size_t> {};

INSTANTIATE_TEST_SUITE_P(All, LowFloorOf,
                         ::testing::Range<std::size_t>(kFloorScenes, kFloorScenes + kLowFloorScenes));

TEST_P(LowFloorOf, GroundTruthIsWhatBothImagersSee) {
  const StereoCamera camera = stereo_camera(floor_layout(GetParam()));
  EXPECT_EQ(camera.lens, kLowLens);
  const DepthImage image = simulate_depth(GetParam(), kSeed, kNoNoise);
  const Intrinsics& intrinsics = image.intrinsics;
  const MultiPolygon truth = floor_ground_truth(GetParam());
  EXPECT_EQ(boost_fault(truth), "");
  const PointLocator floor(truth);
  std::size_t inside = 0;
  std::size_t beyond = 0;
  for (int row = 0; row < intrinsics.height; ++row) {
    for (int column = 0; column < intrinsics.width; ++column) {
      const FloorSight sight = floor_sight(camera, intrinsics, column, row);
      // The pieces of the curved border are 0.01 mm off, and of depth whole counts remain.
      if (boost_distance(sight.place, truth) < 1e-4 || std::abs(sight.depth - kLowRange) < 0.001) continue;
      const bool shows_floor =
          std::abs(count_at(image, column, row) * intrinsics.depth_unit - sight.depth) < 0.00051;
      if (floor.contains(sight.place)) {
        ++inside;
        EXPECT_TRUE(shows_floor) << column << ", " << row;
      } else {
        beyond += shows_floor ? 1U : 0U;
      }
    }
  }
  EXPECT_GT(inside, 12'000U);
  // The foot of an obstacle's side is as far as the floor.
  EXPECT_LE(beyond, 8U);
}

TEST_P(LowFloorOf, PointsLieOnTheFloorButForTheLensAndTheNoise) {
  const FloorScene scene = simulate_floor(GetParam(), kSeed);
  const PointLocator floor(scene.ground_truth);
  std::size_t far = 0;
  for (const Point& point : scene.points) {
    if (floor.contains(point)) continue;
    // A hundredth of the distance for the lens; and 5 deviations of the disparity.
    const double distance = std::hypot(point.x, point.y);
    const double deviation =
        distance * distance * SensorNoise().subpixel_error / (simulated_camera().fx * kStereoBaseline);
    far += boost_distance(point, scene.ground_truth) > 0.015 * distance + 5 * deviation ? 1U : 0U;
  }
  EXPECT_GT(inside_share(scene), 0.9);
  EXPECT_LE(far, scene.points.size() / 1000);
}

TEST(LowFloors, DifferFromTheOthersAsTheyAreSaidTo) {
  double most_across = 0;
  double most_density = 0;
  double most_rows = 0;
  for (std::size_t index = kFloorScenes; index < kFloorScenes + kLowFloorScenes; ++index) {
    const StereoCamera camera = stereo_camera(floor_layout(index));
    const Intrinsics intrinsics = scene_camera(index);
    std::vector<double> cells;  // m^2 of floor by pixel
    for (int row = 0; row + 1 < intrinsics.height; ++row) {
      const FloorSight here = floor_sight(camera, intrinsics, intrinsics.ppx, row);
      const FloorSight below = floor_sight(camera, intrinsics, intrinsics.ppx, row + 1);
      const FloorSight beside = floor_sight(camera, intrinsics, intrinsics.ppx + 1, row);
      if (here.depth > kLowRange) continue;
      const double across = here.place.y - below.place.y;
      const double along = beside.place.x - here.place.x;
      most_across = std::max(most_across, across / along);
      cells.push_back(across * along);
      most_rows =
          std::max(most_rows, simulated_camera().fx * kStereoBaseline * (1 / below.depth - 1 / here.depth));
    }
    const auto [least, most] = std::ranges::minmax_element(cells);
    most_density = std::max(most_density, *most / *least);
  }
  EXPECT_NEAR(most_across, 5.6, 0.05);
  EXPECT_NEAR(most_density, 200, 2);
  EXPECT_LT(most_rows, kLowEdgeStep);
}

TEST(FloorScenes, ThereAreFifteenOfThem) {
  EXPECT_EQ(
      complaint_of<std::invalid_argument>([] { simulate_depth(kFloorScenes + kLowFloorScenes, kSeed); }),
      "there is no floor scene 15; give 0 to 14");
  EXPECT_THROW(floor_ground_truth(kFloorScenes + kLowFloorScenes), std::invalid_argument);
}

/// The standard deviation of depth errors in rows `first` to `last`, in metres, and over what Intel's formula
/// gives for a sub-pixel error of 1.
struct Spread {
  double metres = 0;
  double subpixel = 0;
};

Spread spread_in_rows(const DepthImage& noisy, const DepthImage& clean, int first, int last) {
  const Intrinsics& camera = clean.intrinsics;
  double squares = 0;
  double subpixel_squares = 0;
  double pixels = 0;
  for (int row = first; row <= last; ++row) {
    for (int column = 0; column < camera.width; ++column) {
      if (count_at(noisy, column, row) == 0 || count_at(clean, column, row) == 0) continue;
      const double depth = count_at(clean, column, row) * camera.depth_unit;
      const double error = count_at(noisy, column, row) * camera.depth_unit - depth;
      const double subpixel = error / (depth * depth / (camera.fx * kStereoBaseline));
      squares += error * error;
      subpixel_squares += subpixel * subpixel;
      ++pixels;
    }
  }
  return {std::sqrt(squares / pixels), std::sqrt(subpixel_squares / pixels)};
}

TEST(SensorNoise, GrowsWithTheSquareOfTheDistance) {
  // The tilted scene: its lowest rows see the floor at 1.8 m, its highest ones at 2.6 m.
  const DepthImage noisy = simulate_depth(10, kSeed);
  const DepthImage clean = simulate_depth(10, kSeed, kNoNoise);
  const Spread near = spread_in_rows(noisy, clean, 220, 239);
  const Spread far = spread_in_rows(noisy, clean, 0, 19);
  const SensorNoise noise;
  const double expected = std::sqrt(noise.subpixel_error * noise.subpixel_error +
                                    noise.disparity_step * noise.disparity_step / 12);
  // 8000 pixels give a deviation to 0.8 %; 3 % are four of these.
  EXPECT_NEAR(near.subpixel, expected, 0.03 * expected);
  EXPECT_NEAR(far.subpixel, expected, 0.03 * expected);
  EXPECT_GT(far.metres, 1.8 * near.metres);
}

TEST(SensorNoise, DepthTakesTheValuesOfDisparitySteps) {
  const DepthImage image = simulate_depth(0, kSeed);
  const double scale = image.intrinsics.fx * kStereoBaseline;
  std::set<std::uint16_t> floor_counts;
  for (const std::uint16_t count : image.counts) {
    if (count == 0) continue;
    const double steps = std::round(scale / (count * 0.001) * 32);
    EXPECT_EQ(count, std::lround(scale / (steps / 32) * 1000));
    if (count > 1400) floor_counts.insert(count);
  }
  // From 1.40 to 1.60 m the disparity has 32 steps of 1/32 pixel; the noise stays inside.
  EXPECT_GT(floor_counts.size(), 8U);
  EXPECT_LE(floor_counts.size(), 32U);
}

bool has_neighbour_across_edge(const DepthImage& clean, const DepthImage& exact, std::size_t i) {
  const auto width = static_cast<std::size_t>(clean.intrinsics.width);
  const auto differs = [&](std::size_t other) {
    // A neighbour without depth is in a shadow, whose surface the image does not tell.
    return exact.counts[other] == 0 || std::abs(exact.counts[other] - exact.counts[i]) >= 50;
  };
  const std::size_t column = i % width;
  return (column > 0 && differs(i - 1)) || (column + 1 < width && differs(i + 1)) ||
         (i >= width && differs(i - width)) || (i + width < exact.counts.size() && differs(i + width));
}

TEST(SensorNoise, PixelsDropOutAtEdgesOnly) {
  const DepthImage all = simulate_depth(8, kSeed, kNoNoise);
  const DepthImage none = simulate_depth(8, kSeed, {0, 0, 1});
  const DepthImage half = simulate_depth(8, kSeed, {0, 0, 0.5});
  double edges = 0;
  double dropped = 0;
  for (std::size_t i = 0; i < all.counts.size(); ++i) {
    if (all.counts[i] == none.counts[i]) {
      EXPECT_EQ(half.counts[i], all.counts[i]);
      continue;
    }
    EXPECT_TRUE(has_neighbour_across_edge(none, all, i)) << i;
    ++edges;
    if (half.counts[i] == 0) ++dropped;
  }
  EXPECT_GT(edges, 500);
  // Four standard deviations of a fair coin.
  EXPECT_NEAR(dropped / edges, 0.5, 2 / std::sqrt(edges));
}

TEST(SensorNoise, StereoShadowIsOnTheLeft) {
  // Scene 4: row 150 goes through the tall bin, whose top is at 0.8 m.
  const DepthImage image = simulate_depth(4, kSeed, kNoNoise);
  constexpr int kRow = 150;
  const auto is_top = [&](int column) {
    return count_at(image, column, kRow) > 0 && count_at(image, column, kRow) < 900;
  };
  int first = 0;
  while (!is_top(first)) ++first;
  int last = first;
  while (is_top(last + 1)) ++last;
  // The top's disparity is 14.0 pixels and the floor's 7.4: 6.5 pixels are hidden from the right imager.
  for (int column = first - 6; column < first; ++column)
    EXPECT_EQ(count_at(image, column, kRow), 0) << column;
  EXPECT_EQ(count_at(image, first - 8, kRow), 1500);
  EXPECT_EQ(count_at(image, last + 1, kRow), 1500);
  // The right image's border: the floor's disparity of 7.4 pixels, from -0.5 on.
  EXPECT_EQ(count_at(image, 6, kRow), 0);
  EXPECT_EQ(count_at(image, 7, kRow), 1500);
  EXPECT_EQ(count_at(image, 423, kRow), 1500);
}

TEST(SensorNoise, HasRanges) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const SensorNoise& noise :
       {SensorNoise{-0.1, 0, 0}, SensorNoise{0.6, 0, 0}, SensorNoise{nan, 0, 0}, SensorNoise{0, -0.1, 0},
        SensorNoise{0, 1.1, 0}, SensorNoise{0, 0, -0.1}, SensorNoise{0, 0, 1.1}, SensorNoise{0, 0, nan}}) {
    EXPECT_THROW(simulate_depth(0, kSeed, noise), std::invalid_argument);
  }
}

DepthImage blank_image() {
  return {.intrinsics = {40, 30, 20, 20, 19.5, 14.5, 0.001}, .counts = std::vector<std::uint16_t>(1200, 0)};
}

TEST(FindFloor, TakesThePlaneOfMostPixels) {
  DepthImage image = blank_image();
  for (std::size_t i = 0; i < 1200; ++i) image.counts[i] = i % 40 < 18 ? 1000 : 2000;
  const FloorPlane plane = find_floor(image);
  // Exact depths: only rounding is left.
  EXPECT_NEAR(plane.camera_height, 2, 1e-12);
  EXPECT_NEAR(plane.normal.z, 1, 1e-12);
  // Seen from above, with the foot of the camera as origin: left columns are raised, and gone.
  const std::vector<Point> points = floor_points(image);
  ASSERT_EQ(points.size(), 22U * 30U);
  EXPECT_NEAR(points.front().x, (18 - 19.5) / 20 * 2, 1e-12);
  EXPECT_NEAR(points.front().y, 14.5 / 20 * 2, 1e-12);
  EXPECT_NEAR(points.back().x, 19.5 / 20 * 2, 1e-12);
  EXPECT_NEAR(points.back().y, -14.5 / 20 * 2, 1e-12);
}

TEST(FloorPoints, EndAtTheMedianHeightPlusTheBand) {
  DepthImage image = blank_image();
  std::ranges::fill(image.counts, std::uint16_t{2000});
  image.counts[0] = 2000 - 34;
  image.counts[1] = 2000 - 36;
  image.counts[2] = 2500;
  const std::vector<Point> points = floor_points(image);
  // The pixel 36 mm up is gone; the one 34 mm up stays, and so does the one under the floor.
  EXPECT_EQ(points.size(), 1199U);
}

std::string floor_error(const DepthImage& image) {
  return complaint_of<std::exception>([&] { floor_points(image); });
}

TEST(FloorPoints, ImagesWithoutAFloorAreErrors) {
  DepthImage image = blank_image();
  const std::string too_few =
      "the depth image has fewer than 3 pixels with depth; take one that shows a floor";
  EXPECT_EQ(floor_error(image), too_few);
  image.counts[0] = image.counts[700] = 2000;
  EXPECT_EQ(floor_error(image), too_few);
  image.counts[0] = image.counts[700] = 0;
  for (std::size_t i = 0; i < 30; ++i) image.counts[41 * i] = static_cast<std::uint16_t>(1000 + 7 * i);
  EXPECT_EQ(floor_error(image),
            "the depth image has depth hardly anywhere but along one line; take one that shows a floor");
  image.counts[1] = 1500;
  EXPECT_EQ(floor_error(image), kNoComplaint);
  image.counts.pop_back();
  EXPECT_EQ(floor_error(image), "a depth image must have a count for each of its width * height pixels");
}

}  // namespace
}  // namespace hullbench::testing
