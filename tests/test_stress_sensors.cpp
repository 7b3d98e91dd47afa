// Samplers that imitate a sensor: where their points stand, row by row, line by line and ring by ring.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "datasets/portable_math.hpp"
#include "datasets/random.hpp"
#include "datasets/rgbd/floor_scenes.hpp"
#include "datasets/samplers/airborne.hpp"
#include "datasets/samplers/depth_camera.hpp"
#include "datasets/samplers/rotating.hpp"
#include "datasets/samplers/scan.hpp"
#include "datasets/samplers/tracks.hpp"
#include "polylidar/point_locator.hpp"

namespace hullbench {
namespace {

using polylidar::MultiPolygon;
using polylidar::Point;
using polylidar::PointLocator;

/// Of 100 squared units.
MultiPolygon small_square() {
  return {{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {}}};
}

/// As wide in every direction, but for 0.5 %.
MultiPolygon disk() {
  MultiPolygon shape(1);
  for (int i = 0; i < 64; ++i) {
    const Point to = unit_vector(i / 64.0);
    shape[0].shell.push_back({5 * to.x, 5 * to.y});
  }
  return shape;
}

using Pixel = std::pair<std::int64_t, std::int64_t>;  ///< row, column

/// The pixel that gave a point, and by how much its disparity errs.
struct Reading {
  Pixel pixel;
  double error = 0;
};

/// The row whose ray through the point meets a whole column, and gives a whole number of disparity steps.
/// The point stands at most 12 rows from it: an error of 12 / 0.2 = 60 deviations.
std::optional<Reading> read_back(const DepthShot& shot, const Point& point) {
  const Point in_frame = shot.frame.in_frame(point);
  const Point place = {in_frame.x - shot.foot.x, in_frame.y - shot.foot.y};
  const auto near_row = std::llround(shot.view.row(place) - shot.row_offset);
  for (std::int64_t row = near_row - 12; row <= near_row + 12; ++row) {
    const double forward = shot.view.place(static_cast<double>(row) + shot.row_offset, 0).x;
    const Point seen = {forward, place.y / place.x * forward};
    const double column = shot.view.column(seen) - shot.column_offset;
    const double measured = shot.view.disparity(forward) * forward / place.x;
    const double steps = measured / SensorNoise().disparity_step;
    // Coordinates of up to 15 have errors of 1e-15 each, and up to 1000 pixels in them.
    if (std::abs(column - std::round(column)) > 1e-8 || std::abs(steps - std::round(steps)) > 1e-8) continue;
    const double true_disparity = shot.view.disparity(
        shot.view.seen(static_cast<double>(row) + shot.row_offset, std::round(column) + shot.column_offset)
            .x);
    return Reading{{row, std::llround(column)}, measured - true_disparity};
  }
  return std::nullopt;
}

constexpr double kTestPitch = 0.06;
constexpr double kTestLevel = 10;

DepthShot test_shot() {
  Random random(3);
  return take_depth_shot(disk(), 0.1, kTestPitch, kTestLevel, random);
}

std::map<Pixel, double> errors_of(const DepthShot& shot) {
  std::map<Pixel, double> errors;
  for (const Point& point : shot.points) {
    const auto reading = read_back(shot, point);
    if (reading) errors[reading->pixel] = reading->error;
  }
  return errors;
}

TEST(DepthCamera, EveryPointIsAPixelWithARoundedDisparity) {
  const DepthShot shot = test_shot();
  ASSERT_GT(shot.points.size(), 10'000U);
  EXPECT_EQ(errors_of(shot).size(), shot.points.size());
}

TEST(DepthCamera, EveryPixelOfTheFloorIsThereButHalfOfThoseAtItsEdge) {
  const DepthShot shot = test_shot();
  const std::map<Pixel, double> errors = errors_of(shot);
  const PointLocator locator(disk());
  const auto is_floor = [&](const Pixel& pixel) {
    const Point place = shot.view.seen(static_cast<double>(pixel.first) + shot.row_offset,
                                       static_cast<double>(pixel.second) + shot.column_offset);
    return locator.contains(shot.frame.in_plane({shot.foot.x + place.x, shot.foot.y + place.y}));
  };
  const auto low_row = static_cast<std::int64_t>(shot.view.row({shot.view.distance / 2, 0})) - 1;
  const auto high_row = static_cast<std::int64_t>(shot.view.row({1.5 * shot.view.distance, 0})) + 1;
  const auto side =
      static_cast<std::int64_t>(shot.view.column({shot.view.distance / 2, shot.view.distance / 2})) + 1;
  std::size_t inner = 0;
  std::size_t edge = 0;
  std::size_t edge_kept = 0;
  for (std::int64_t row = low_row; row <= high_row; ++row) {
    for (std::int64_t column = -side; column <= side; ++column) {
      if (!is_floor({row, column})) continue;
      if (is_floor({row - 1, column}) && is_floor({row + 1, column}) && is_floor({row, column - 1}) &&
          is_floor({row, column + 1})) {
        ++inner;
        EXPECT_TRUE(errors.contains({row, column})) << row << ", " << column;
      } else {
        ++edge;
        edge_kept += errors.contains({row, column}) ? 1U : 0U;
      }
    }
  }
  EXPECT_EQ(inner + edge_kept, errors.size());
  ASSERT_GT(edge, 200U);
  EXPECT_NEAR(static_cast<double>(edge_kept), static_cast<double>(edge) / 2,
              5 * std::sqrt(static_cast<double>(edge) / 4));
}

TEST(DepthCamera, TheLensTurnsRaysByAHundredthAt45Degrees) {
  const DepthView view{.distance = 10, .height = 2, .focal = 500};
  EXPECT_EQ(view.seen(0, 0), view.place(0, 0));
  for (const auto& [row, column, bent] :
       {std::tuple{0.0, 500.0, 1.01}, {-30.0, 40.0, 1.0001}, {60.0, -80.0, 1.0004}}) {
    const Point seen = view.seen(row, column);
    EXPECT_NEAR(view.row(seen), bent * row, 1e-9);
    EXPECT_NEAR(view.column(seen), bent * column, 1e-9);
  }
}

TEST(DepthCamera, PointsOfARowAreNearerThanRowsByWhatTheLevelSays) {
  for (const double level : {1.0, 4.0, 20.0}) {
    Random random(3);
    const DepthShot shot = take_depth_shot(small_square(), 0, 0.05, level, random);
    const DepthView& view = shot.view;
    EXPECT_NEAR(view.distance, 10, 1e-12);
    EXPECT_NEAR(view.distance / view.height, level, 1e-12);
    // Half a pixel either side of the optical axis; the third order is left out, at most 1.2e-4.
    const double across = view.place(0.5, 0).x - view.place(-0.5, 0).x;
    const double along = view.place(0, 0.5).y - view.place(0, -0.5).y;
    EXPECT_NEAR(across / along / std::sqrt(1 + level * level), 1, 2e-4) << level;
    EXPECT_NEAR(across * along / (0.05 * 0.05), 1, 2e-4) << level;
  }
}

TEST(DepthCamera, DensityFallsWithTheCubeOfTheDepth) {
  // The depth is (forward * distance + height^2) / slant. Shares of three bands of the disk, by adding up
  // over fine cells. A band's pixels come without chance but for its ends and the floor's edge. At an end it
  // is up to half a row, of the 20 or more rows of the first two bands and the nine of the last: 0.007 of all
  // points. Half of the edge's pixels are lost, 0.015 more if those too many lay in one band. (With the
  // square of the depth the shares would be 0.1 off.)
  const DepthShot shot = test_shot();
  const DepthView& view = shot.view;
  const auto band = [&](double forward) {
    return std::min<std::size_t>(static_cast<std::size_t>(3 * (forward / view.distance - 0.5)), 2);
  };
  std::vector<double> masses(3);
  const PointLocator locator(disk());
  for (int i = 0; i < 600; ++i) {
    for (int j = 0; j < 600; ++j) {
      const double forward = view.distance * (0.5 + (i + 0.5) / 600);
      const double left = view.distance * ((j + 0.5) / 600 - 0.5);
      if (!locator.contains(shot.frame.in_plane({shot.foot.x + forward, shot.foot.y + left}))) continue;
      const double depth = forward * view.distance + view.height * view.height;
      masses[band(forward)] += 1 / (depth * depth * depth);
    }
  }
  std::vector<double> counts(3);
  for (const auto& [pixel, error] : errors_of(shot)) {
    counts[band(view.place(static_cast<double>(pixel.first) + shot.row_offset, 0).x)] += 1;
  }
  const double mass = masses[0] + masses[1] + masses[2];
  const auto points = static_cast<double>(shot.points.size());
  EXPECT_GT(masses[0] / masses[2], 5);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(counts[i] / points, masses[i] / mass, 0.03) << i;
}

TEST(DepthCamera, NeighboursShareTwoThirdsOfTheError) {
  // Independent of the noise is the rounding, uniform over a step: its variance is step^2 / 12. The sum of
  // the squared correlations over all pairs of pixels is (1 + 2 (4/9 + 1/9))^2 = 4.46 a pixel, so a mean of n
  // squares or products has a variance of at most 2 * 4.46 / n.
  const std::map<Pixel, double> errors = errors_of(test_shot());
  const SensorNoise sensor;
  const double noise = sensor.subpixel_error * sensor.subpixel_error;
  const double variance = noise + sensor.disparity_step * sensor.disparity_step / 12;
  const auto n = static_cast<double>(errors.size());
  double squares = 0;
  for (const auto& [pixel, error] : errors) squares += error * error;
  EXPECT_NEAR(squares / n / variance, 1, 5 * std::sqrt(2 * 4.46 / n));
  const std::map<std::int64_t, double> correlations{{1, 2.0 / 3}, {2, 1.0 / 3}, {3, 0}};
  for (const auto& [away, correlation] : correlations) {
    for (const Pixel& step : {Pixel{0, away}, Pixel{away, 0}}) {
      double products = 0;
      double pairs = 0;
      for (const auto& [pixel, error] : errors) {
        const auto other = errors.find({pixel.first + step.first, pixel.second + step.second});
        if (other == errors.end()) continue;
        products += error * other->second;
        pairs += 1;
      }
      EXPECT_NEAR(products / pairs / variance, correlation * noise / variance,
                  5 * std::sqrt(2 * 4.46 / pairs))
          << step.first << ", " << step.second;
    }
  }
}

constexpr double kAlong = 0.0125;  ///< from point to point of a line
constexpr double kAcross = 0.125;  ///< from line to line

/// Over the square along x: strips from y = 0 to 4, 3 to 7 and 6 to 10.
std::vector<Point> flight(Mirror mirror) {
  Random random(3);
  return fly_over(small_square(), 0, std::sqrt(kAlong * kAcross), kAcross / kAlong, mirror, random);
}

TEST(Airborne, StripsOverlapTwoToOne) {
  for (const Mirror mirror : {Mirror::kRotates, Mirror::kSwings}) {
    // 80 lines of 80 points a unit. A band has a line more or less, and a line two points, at its ends.
    const std::vector<Point> points = flight(mirror);
    const std::vector<std::pair<double, double>> bands{{0, 3}, {3, 4}, {4, 6}, {6, 7}, {7, 10}};
    for (const auto& [low, high] : bands) {
      const double strips = high - low == 1 ? 2 : 1;
      const auto count = std::ranges::count_if(
          points, [low = low, high = high](const Point& point) { return point.y >= low && point.y < high; });
      const double in_line = 80 * (high - low);
      EXPECT_NEAR(static_cast<double>(count), strips * 80 * in_line, strips * (in_line + 2 * 81)) << low;
    }
  }
}

/// The points with y in [low, high), line by line: lines are more than four points' distances apart.
std::vector<std::vector<Point>> lines_of(std::vector<Point> points, double low, double high) {
  std::ranges::sort(points, [](const Point& a, const Point& b) { return a.x < b.x; });
  std::vector<std::vector<Point>> lines;
  for (const Point& point : points) {
    if (point.y < low || point.y >= high) continue;
    if (lines.empty() || point.x - lines.back().back().x > 4 * kAlong) lines.emplace_back();
    lines.back().push_back(point);
  }
  return lines;
}

TEST(Airborne, LinesOfARotatingMirrorAreParallelAndEven) {
  std::vector<std::vector<Point>> lines = lines_of(flight(Mirror::kRotates), 0, 2.9);
  EXPECT_NEAR(static_cast<double>(lines.size()), 80, 1);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    std::vector<Point>& line = lines[i];
    const double jitter = 2 * kLaserJitter * kAlong + 1e-14;  // of the difference of two
    EXPECT_LE(line.back().x - line.front().x, jitter);
    if (i > 0) {
      EXPECT_NEAR(line.front().x - lines[i - 1].front().x, kAcross, jitter);
    }
    std::ranges::sort(line, [](const Point& a, const Point& b) { return a.y < b.y; });
    for (std::size_t j = 1; j < line.size(); ++j) EXPECT_NEAR(line[j].y - line[j - 1].y, kAlong, jitter);
  }
}

TEST(Airborne, LinesOfASwingingMirrorMeetAtTheSidesOfTheStrip) {
  // At the height y of a strip 4 wide lines are by turns 2 y / 4 and 2 - 2 y / 4 mean distances apart. A
  // slice has one or two points of a line. They lie off it by a tenth, and in the slice a line moves by 0.02
  // / 4 of kAcross, another twentieth of kAlong.
  for (const double y : {1.0, 2.0, 2.9}) {
    const std::vector<std::vector<Point>> lines = lines_of(flight(Mirror::kSwings), y - 0.01, y + 0.01);
    ASSERT_NEAR(static_cast<double>(lines.size()), 80, 1);
    std::vector<double> gaps;
    for (std::size_t i = 1; i < lines.size(); ++i)
      gaps.push_back(lines[i].front().x - lines[i - 1].front().x);
    for (std::size_t i = 1; i < gaps.size(); ++i) {
      const double larger = std::max(gaps[i], gaps[i - 1]);
      const double less = std::min(gaps[i], gaps[i - 1]);
      EXPECT_NEAR(larger, kAcross * std::max(y / 2, 2 - y / 2), 0.3 * kAlong) << y;
      EXPECT_NEAR(less, kAcross * std::min(y / 2, 2 - y / 2), 0.3 * kAlong) << y;
    }
  }
}

TEST(Rotating, RingsStandAtEvenAnglesAndTheirPointsToo) {
  const Point foot{5, 5};
  constexpr double kLevel = 10;
  const LidarRings rings = lidar_rings(small_square(), foot, 0.05, kLevel);
  EXPECT_NEAR(rings.range, std::sqrt(50), 1e-12);
  Random random(3);
  std::map<std::int64_t, std::vector<double>> azimuths;  // by radius, in units of 1e-9
  for (const Point& point : rotate_lidar(small_square(), foot, rings, random)) {
    const double radius = std::hypot(point.x - foot.x, point.y - foot.y);
    azimuths[std::llround(radius * 1e9)].push_back(std::atan2(point.y - foot.y, point.x - foot.x));
  }
  // Rounding could part a ring at a border of these units; that would show as a ring of too few points.
  double angle_before = 0;
  double radius_before = 0;
  std::size_t at_half_range = 0;
  for (auto& [billionths, ring] : azimuths) {
    const double radius = static_cast<double>(billionths) * 1e-9;
    const double angle = std::atan2(radius, rings.range * kLidarHeight);
    if (radius_before > 0) {
      EXPECT_NEAR(angle - angle_before, 2 * std::numbers::pi * rings.beam_step, 1e-8) << radius;
    }
    if (radius < 5) {  // in the square all round
      ASSERT_EQ(ring.size(), rings.shots) << radius;
      std::ranges::sort(ring);
      const double step = 2 * std::numbers::pi / static_cast<double>(rings.shots);
      for (std::size_t i = 1; i < ring.size(); ++i) EXPECT_NEAR(ring[i] - ring[i - 1], step, 1e-9);
      if (radius_before < rings.range / 2 && radius >= rings.range / 2) {
        // The middle of the two is within half their distance of half the range, 2.3 % of it. The ratio
        // grows more slowly than the radius, the product more slowly than its square.
        ++at_half_range;
        const double between = radius - radius_before;
        const double in_ring = step * (radius + radius_before) / 2;
        EXPECT_NEAR(between / in_ring / kLevel, 1, 0.023);
        EXPECT_NEAR(between * in_ring / (0.05 * 0.05), 1, 0.046);
      }
    }
    angle_before = angle;
    radius_before = radius;
  }
  EXPECT_EQ(at_half_range, 1U);
}

/// Points of the square in the order of drive_roads, along x or along y.
struct Road {
  bool is_along_x = false;
  std::vector<Point> points;
};

TEST(Tracks, RoadsAreStraightAndTheirPointsEvenlySpread) {
  constexpr double kStep = 0.02;
  constexpr double kDistance = 0.2;
  Random random(3);
  const std::vector<Point> points =
      drive_roads(small_square(), 0, std::sqrt(kStep * kDistance / 2), kDistance / kStep, random);
  // A road goes on while the next point is at most two steps further, and on the road. Where it starts the
  // point five further shows its direction.
  std::vector<Road> roads;
  const double width = 2 * kRoadHalfWidth * kStep + 1e-13;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point& point = points[i];
    if (!roads.empty()) {
      Road& road = roads.back();
      const double dx = point.x - road.points.back().x;
      const double dy = point.y - road.points.back().y;
      const double along = road.is_along_x ? dx : dy;
      const double aside = road.is_along_x ? dy : dx;
      if (along >= 0 && along <= 2 * kStep && std::abs(aside) <= width) {
        road.points.push_back(point);
        continue;
      }
    }
    const Point& ahead = points[std::min(i + 5, points.size() - 1)];
    roads.push_back({std::abs(ahead.x - point.x) > std::abs(ahead.y - point.y), {point}});
  }
  std::vector<double> sides[2];
  for (const Road& road : roads) {
    // 500 steps, each with a point; the outermost may be cut off.
    EXPECT_NEAR(static_cast<double>(road.points.size()), 500, 1);
    const auto middle = std::ranges::count_if(road.points, [&](const Point& point) {
      const double along = road.is_along_x ? point.x : point.y;
      return along >= 3 && along < 6;
    });
    EXPECT_NEAR(static_cast<double>(middle), 150, 1);
    sides[road.is_along_x ? 1 : 0].push_back(road.is_along_x ? road.points[0].y : road.points[0].x);
  }
  for (std::vector<double>& family : sides) {
    EXPECT_NEAR(static_cast<double>(family.size()), 10 / kDistance, 1);
    std::ranges::sort(family);
    for (std::size_t i = 1; i < family.size(); ++i) {
      EXPECT_NEAR(family[i] - family[i - 1], kDistance, 2 * kRoadShift * kDistance + width);
    }
  }
}

TEST(ScanExactly, LosesAFewOfAFinerScansPoints) {
  for (const std::size_t n : {1U, 7U, 1000U}) {
    std::size_t last = 0;
    const std::vector<Point> points = scan_exactly(small_square(), n, 5, [&](double pitch, Random&) {
      // Three times as many as the pitch says.
      last = static_cast<std::size_t>(300 / (pitch * pitch));
      std::vector<Point> scanned(last);
      for (std::size_t i = 0; i < last; ++i) scanned[i] = {static_cast<double>(i), 0};
      return scanned;
    });
    EXPECT_EQ(points.size(), n);
    EXPECT_LE(last, n + n / 20 + 8);
    EXPECT_TRUE(std::is_sorted(points.begin(), points.end(),
                               [](const Point& a, const Point& b) { return a.x < b.x; }));
  }
}

TEST(ScanExactly, TakesTooManyPointsWhereTheirNumberJumps) {
  const std::vector<Point> points = scan_exactly(small_square(), 150, 5, [](double pitch, Random&) {
    return std::vector<Point>(100 * static_cast<std::size_t>(1 / pitch));
  });
  EXPECT_EQ(points.size(), 150U);
}

TEST(ScanExactly, LosesEveryPointWithTheSameChance) {
  // 4000 of 4080 stay: of the first half of them and of the second as many, but for chance, which has a
  // standard deviation of sqrt(80 / 4) = 4.5 points.
  std::size_t scanned = 0;
  const std::vector<Point> points = scan_exactly(small_square(), 4000, 5, [&](double pitch, Random&) {
    scanned = static_cast<std::size_t>(102 / (pitch * pitch));
    std::vector<Point> result(scanned);
    for (std::size_t i = 0; i < scanned; ++i) result[i] = {static_cast<double>(i), 0};
    return result;
  });
  const auto lost_before = [&](std::size_t place) {
    return static_cast<double>(place) -
           static_cast<double>(std::ranges::count_if(
               points, [&](const Point& point) { return point.x < static_cast<double>(place); }));
  };
  const auto lost = static_cast<double>(scanned - 4000);
  EXPECT_NEAR(lost_before(scanned / 2), lost / 2, 5 * std::sqrt(lost / 4) + 1);
}

TEST(ScanExactly, RefusesShapesWithoutArea) {
  const MultiPolygon nothing = {{{{0, 0}, {1, 1}, {2, 2}}, {}}};
  EXPECT_THROW(scan_exactly(nothing, 5, 1, [](double, Random&) { return std::vector<Point>(5); }),
               std::invalid_argument);
}

}  // namespace
}  // namespace hullbench
