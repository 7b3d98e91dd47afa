// The hull of a stream is that of the same points in memory.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "polylidar/stream.hpp"
#include "tests/complaint.hpp"
#include "tests/point_sets.hpp"

namespace polylidar {
namespace {

using Points = std::vector<Point>;

// Points in memory, in blocks of one size; what it gives in the second pass may be other points.
class MemorySource {
 public:
  explicit MemorySource(Points points, std::size_t block = 10'000)
      : points_(std::move(points)), block_(block) {}

  StreamedHull hull(const Options& options, const StreamOptions& stream_options = {}) {
    return concave_hull_of_stream([this](const TakePoints& take) { read(take); }, options, stream_options);
  }
  void change(int pass, Points to) {
    changes_in_pass_ = pass;
    changed_ = std::move(to);
  }
  int passes() const { return passes_; }

 private:
  void read(const TakePoints& take) {
    if (++passes_ == changes_in_pass_) points_ = changed_;
    for (std::size_t next = 0; next < points_.size(); next += block_) {
      take(std::span(points_).subspan(next, std::min(block_, points_.size() - next)));
    }
  }

  Points points_;
  std::size_t block_;
  int passes_ = 0;
  int changes_in_pass_ = 0;
  Points changed_;
};

std::string complaint(MemorySource& source, const Options& options,
                      const StreamOptions& stream_options = {}) {
  return hullbench::testing::complaint_of<std::exception>([&] { source.hull(options, stream_options); });
}

TEST(Stream, GivesTheShapeOfThePointsInMemory) {
  std::size_t rings = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    testing::Random random(seed);
    Points points = testing::uniform_points(70'000 + random.below(60'000), seed);
    std::erase_if(points, [](const Point& p) {
      return std::hypot(p.x - 0.4, p.y - 0.5) < 0.1 || std::hypot(p.x - 0.7, p.y - 0.6) < 0.03;
    });
    if (seed % 3 == 0) points.insert(points.end(), points.begin(), points.begin() + 5000);
    const double spacing = 1 / std::sqrt(static_cast<double>(points.size()));
    Options options{.threads = 1 + static_cast<unsigned>(random.below(3))};
    if (seed % 2 == 0) options.max_perimeter = random.between(9, 25) * spacing;
    if (seed % 2 == 1) options.alpha = random.between(1.8, 5) * spacing;
    if (seed % 4 == 3) options.max_edge_length = 6 * spacing;
    options.fill_single_triangles = seed % 5 == 0;
    SCOPED_TRACE(seed);
    const IndexedMultiPolygon shape = concave_hull(points, options);
    MemorySource source(points, 1 + random.below(30'000));
    const StreamedHull hull = source.hull(options);
    EXPECT_EQ(hull.polygons, to_coordinates(shape, points));
    EXPECT_TRUE(
        std::equal(hull.vertices.begin(), hull.vertices.end(), shape.vertices.begin(), shape.vertices.end()));
    EXPECT_EQ(hull.points, points.size());
    EXPECT_LT(hull.triangulated_points, points.size() / 2);
    EXPECT_EQ(source.passes(), 4);
    rings += shape.ring_ends.size();
  }
  EXPECT_GT(rings, 36U) << "the shapes have holes";
}

// A wider radius than usual, up to the limit's, keeps the maps small.
TEST(Stream, KeepsToTheMemoryThatItMayUse) {
  const Points points = testing::uniform_points(100'000, 1);
  const Options options{.max_edge_length = 0.1};
  const IndexedMultiPolygon shape = concave_hull(points, options);
  MemorySource source(points);
  EXPECT_EQ(source.hull(options, {.most_map_bytes = 8000}).polygons, to_coordinates(shape, points));
  EXPECT_EQ(complaint(source, options, {.most_map_bytes = 1000}),
            "the limit is too small for the distances between the points: give a larger one, or more memory");
  EXPECT_EQ(complaint(source, {.alpha = 1e-9}),
            "the limit is too small for the distances between the points: give a larger one, or more memory");
}

TEST(Stream, PutsFewPointsIntoMemory) {
  const Points points = testing::uniform_points(3000, 2);
  MemorySource source(points);
  EXPECT_EQ(source.hull({}).polygons, to_coordinates(concave_hull(points), points));
  EXPECT_EQ(source.passes(), 2);
  MemorySource none({});
  EXPECT_TRUE(none.hull({}).polygons.empty());
}

TEST(Stream, PointsOnALineHaveNoShape) {
  for (const Point& step : {Point{1, 0}, Point{0, 1}, Point{0, 0}}) {
    Points points(70'000);
    for (std::size_t i = 0; i < points.size(); ++i) {
      points[i] = {static_cast<double>(i) * step.x, static_cast<double>(i) * step.y};
    }
    const StreamedHull hull = MemorySource(points).hull({.alpha = 10});
    EXPECT_TRUE(hull.polygons.empty());
    EXPECT_EQ(hull.points, points.size());
  }
}

TEST(Stream, TellsHowFarItHasCome) {
  MemorySource source(testing::uniform_points(70'000, 3), 7000);
  int calls = 0;
  StreamProgress last;
  source.hull({.alpha = 0.02}, {.progress = [&](const StreamProgress& progress) {
                EXPECT_TRUE(progress.pass > last.pass || progress.points > last.points);
                last = progress;
                ++calls;
              }});
  EXPECT_EQ(calls, 40);
  EXPECT_EQ(last.pass, last.passes);
  EXPECT_EQ(last.points, 70'000U);
}

TEST(Stream, SaysWhatIsWrong) {
  const Points points = testing::uniform_points(70'000, 4);
  MemorySource many(points);
  EXPECT_EQ(complaint(many, {}),
            "a stream of more than 65536 points needs a limit: give alpha, max_edge_length or max_perimeter");
  EXPECT_EQ(complaint(many, {.alpha = -1}), "alpha must be zero or more");
  Points bad = points;
  bad[54'321].y = std::numeric_limits<double>::quiet_NaN();
  MemorySource not_finite(bad);
  EXPECT_EQ(complaint(not_finite, {.alpha = 0.02}), "point 54321 is not finite");
  Points huge = points;
  for (Point& p : huge) p.x *= 1e300;
  MemorySource extreme(huge);
  EXPECT_NE(complaint(extreme, {.alpha = 0.02}), hullbench::testing::kNoComplaint);
}

TEST(Stream, NoticesASourceThatChanges) {
  const Points points = testing::uniform_points(70'000, 5);
  for (int pass = 2; pass <= 4; ++pass) {
    Points longer = points;
    longer.push_back({0.5, 0.5});
    Points shorter = points;
    shorter.pop_back();
    Points moved = points;
    moved[100] = {2, 2};
    Points lost = points;
    lost[100].x = std::numeric_limits<double>::quiet_NaN();
    for (const Points& changed : {longer, shorter, moved, lost}) {
      MemorySource source(points);
      source.change(pass, changed);
      EXPECT_EQ(complaint(source, {.alpha = 0.02}),
                "the source has other points than when it was read before");
    }
  }
  MemorySource few(testing::uniform_points(100, 6));
  few.change(2, testing::uniform_points(101, 6));
  EXPECT_EQ(complaint(few, {}), "the source has other points than when it was read before");
}

}  // namespace
}  // namespace polylidar
