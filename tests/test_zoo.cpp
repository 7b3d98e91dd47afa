// The zoo: that each generator makes what it promises, the same on every machine; that the core has an answer
// to it; and that the plan lists the same cases.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "datasets/datasets.hpp"
#include "datasets/point_bytes.hpp"
#include "datasets/sha256.hpp"
#include "datasets/zoo/zoo.hpp"
#include "polylidar/check.hpp"
#include "polylidar/concave_hull.hpp"
#include "polylidar/predicates.hpp"
#include "tests/point_sets.hpp"

namespace hullbench {
namespace {

using polylidar::testing::distance;

std::vector<Point> points_of(const std::string& name) {
  const zoo::Case* one = zoo::find_case("zoo-" + name);
  if (one == nullptr) throw std::invalid_argument("there is no zoo-" + name);
  return one->make().points;
}

MultiPolygon shape_of(const std::string& name) {
  return zoo::find_case("zoo-" + name)->make().ground_truth;
}

using Places = std::set<std::pair<double, double>>;

Places places(const std::vector<Point>& points) {
  Places result;
  for (const Point& point : points) result.insert({point.x, point.y});
  return result;
}

/// Pairs of points at most `limit` apart that are not equal.
std::size_t close_pairs(const std::vector<Point>& points, double limit) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!(points[i] == points[j]) && distance(points[i], points[j]) <= limit) ++count;
    }
  }
  return count;
}

/// The two points that are farthest apart.
std::pair<Point, Point> farthest(const std::vector<Point>& points) {
  std::pair<Point, Point> best = {points.at(0), points.at(0)};
  for (const Point& a : points) {
    for (const Point& b : points) {
      if (distance(a, b) > distance(best.first, best.second)) best = {a, b};
    }
  }
  return best;
}

/// How far points are from the line through the two farthest ones, as a share of the distance of these.
double flatness(const std::vector<Point>& points) {
  const auto [a, b] = farthest(points);
  const double length = distance(a, b);
  double largest = 0;
  for (const Point& p : points) {
    const double doubled = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
    largest = std::max(largest, std::abs(doubled) / (length * length));
  }
  return largest;
}

/// Whether each coordinate is a whole multiple of 1 / per_unit, but for the last bit.
bool has_decimals(const std::vector<Point>& points, double per_unit) {
  return std::ranges::all_of(points, [&](const Point& point) {
    return std::round(point.x * per_unit) / per_unit == point.x &&
           std::round(point.y * per_unit) / per_unit == point.y;
  });
}

bool is_single_precision(const std::vector<Point>& points) {
  return std::ranges::all_of(points, [](const Point& point) {
    return static_cast<double>(static_cast<float>(point.x)) == point.x &&
           static_cast<double>(static_cast<float>(point.y)) == point.y;
  });
}

bool all_on_a_line(const std::vector<Point>& points) {
  const auto [a, b] = farthest(points);
  return std::ranges::all_of(
      points, [a = a, b = b](const Point& point) { return polylidar::orient2d(a, b, point) == 0; });
}

TEST(Zoo, EveryCaseHasANameAndAnIssueOfItsOwn) {
  EXPECT_GE(zoo::cases().size(), 40U);
  std::set<std::string> names;
  std::set<std::string> citations;
  for (const zoo::Case& one : zoo::cases()) {
    EXPECT_TRUE(names.insert(one.name).second) << one.name;
    EXPECT_TRUE(citations.insert(one.citation).second) << one.citation;
    EXPECT_TRUE(std::regex_match(one.citation, std::regex("[A-Za-z0-9_.-]+/[A-Za-z0-9_.-]+#[1-9][0-9]*")));
    EXPECT_TRUE(one.name.ends_with("-" + one.citation.substr(one.citation.find('#') + 1))) << one.name;
    EXPECT_FALSE(one.title.empty()) << one.name;
    EXPECT_FALSE(one.fault.empty()) << one.name;
  }
}

TEST(Zoo, CasesAreDataSetsWithTheirOwnPoints) {
  for (const zoo::Case& one : zoo::cases()) {
    const zoo::Input input = one.make();
    const PointSet set = make_point_set(one.name, false, 0, 1);
    EXPECT_EQ(set.points, input.points) << one.name;
    EXPECT_EQ(set.ground_truth, input.ground_truth) << one.name;
    EXPECT_EQ(make_point_set(one.name, false, 0, 2).points, input.points) << one.name;
    EXPECT_EQ(base_shape(one.name), one.name);
    EXPECT_THROW(make_point_set(one.name, false, 10, 1), std::invalid_argument) << one.name;
  }
}

TEST(Zoo, AnswersAreOfTheirKind) {
  for (const zoo::Case& one : zoo::cases()) {
    const zoo::Input input = one.make();
    EXPECT_EQ(one.answer == zoo::Answer::kShape, !input.ground_truth.empty()) << one.name;
    if (one.answer == zoo::Answer::kEmpty) {
      EXPECT_TRUE(all_on_a_line(input.points)) << one.name;
    } else {
      EXPECT_GE(places(input.points).size(), 3U) << one.name;
    }
  }
}

TEST(Zoo, SamePointsOnEveryMachine) {
  std::ifstream file(HULLBENCH_ZOO_HASHES);
  std::map<std::string, std::string> expected;
  for (std::string name, hash; file >> name >> hash;) expected[name] = hash;
  EXPECT_EQ(expected.size(), zoo::cases().size());
  for (const zoo::Case& one : zoo::cases()) {
    const zoo::Input input = one.make();
    std::string bytes = point_bytes(input.points);
    for (const Polygon& polygon : input.ground_truth) {
      bytes += point_bytes(polygon.shell);
      for (const Ring& hole : polygon.holes) bytes += point_bytes(hole);
    }
    EXPECT_EQ(expected[one.name], sha256_hex(bytes)) << one.name;
  }
}

TEST(Zoo, FewPointsAreAsManyAsPromised) {
  const std::map<std::string, std::pair<std::size_t, std::size_t>> expected = {
      {"qgis-65899", {1, 1}},         {"turf-550", {2, 2}},        {"libpysal-111", {3, 3}},
      {"merowech-1", {4, 4}},         {"hgeometry-209", {4, 4}},   {"bl4ckb0ne-32", {3, 3}},
      {"ironwallaby-8", {5, 5}},      {"concaveman-31", {6, 6}},   {"qgis-27442", {7, 7}},
      {"georust-1124", {7, 6}},       {"georust-792", {20, 16}},   {"shapely-541", {6, 6}},
      {"scipy-14185", {5, 5}},        {"openscad-2220", {8, 4}},   {"parry-49", {12, 12}},
      {"hull-js-11", {6, 6}},         {"hull-js-6", {13, 13}},     {"geos-719", {5, 5}},
      {"shapely-1873", {8, 8}},       {"shapely-1971", {5, 5}},    {"geos-946", {6, 6}},
      {"jts-1061", {8, 8}},           {"sedona-1733", {5, 5}},     {"geos-1286", {4, 4}},
      {"shapely-555", {41, 41}},      {"d3-delaunay-92", {8, 8}},  {"cgal-8748", {10, 10}},
      {"georust-1028", {24, 24}},     {"delabella-8", {8, 8}},     {"qgis-63868", {5, 5}},
      {"jts-298", {79, 79}},          {"jts-321", {5, 5}},         {"delaunator-94", {6, 6}},
      {"gdl-141", {500, 300}},        {"delaunator-13", {17, 17}}, {"delaunator-cpp-16", {64, 64}},
      {"pgrouting-1603", {148, 148}},
  };
  for (const auto& [name, counts] : expected) {
    const std::vector<Point> points = points_of(name);
    EXPECT_EQ(points.size(), counts.first) << name;
    EXPECT_EQ(places(points).size(), counts.second) << name;
  }
}

TEST(Zoo, FewPointsStandAsPromised) {
  const std::vector<Point> beside = points_of("concaveman-31");
  const Point middle = {(beside[2].x + beside[4].x) / 2, (beside[2].y + beside[4].y) / 2};
  EXPECT_LT(distance(beside[3], middle), 0.1);
  EXPECT_LT(polylidar::orient2d(beside[2], beside[4], beside[3]), 0);  // on the hull's outer side

  std::vector<Point> line = points_of("hgeometry-209");
  line.erase(line.begin());
  EXPECT_TRUE(all_on_a_line(line));

  const std::vector<Point> level = points_of("shapely-541");
  std::set<double> heights;
  for (const Point& point : level) {
    if (std::abs(point.y - 4.9) < 1e-12) heights.insert(point.y);
  }
  EXPECT_EQ(heights.size(), 3U);

  for (const Point& point : points_of("parry-49")) EXPECT_LE(std::hypot(point.x, point.y), 0x1p-75);
  EXPECT_EQ(points_of("turf-550")[0].x, points_of("turf-550")[1].x);

  const std::vector<Point> ring = points_of("senhorsolar-1");
  EXPECT_EQ(places(ring).size(), ring.size());
  for (std::size_t i = 0; i < ring.size(); ++i)
    EXPECT_LE(distance(ring[i], ring[(i + 1) % ring.size()]), std::sqrt(2)) << i;
  EXPECT_TRUE(has_decimals(ring, 1));
}

TEST(Zoo, FlatPointsAreAsFlatAsPromised) {
  const std::map<std::string, std::pair<double, double>> expected = {
      {"bl4ckb0ne-32", {0.005, 0.02}}, {"geos-719", {1e-3, 0.03}},     {"jts-1002", {1e-7, 2e-6}},
      {"shapely-1873", {1e-6, 1e-3}},  {"shapely-1971", {1e-5, 1e-3}}, {"geos-946", {1e-10, 1e-6}},
      {"jts-1061", {0.005, 0.02}},     {"sedona-1733", {1e-3, 0.01}},  {"shapely-555", {0, 1e-10}},
  };
  for (const auto& [name, range] : expected) {
    const double flat = flatness(points_of(name));
    EXPECT_GT(flat, range.first) << name;
    EXPECT_LT(flat, range.second) << name;
  }
  std::vector<Point> three = points_of("geos-1286");
  three.pop_back();
  EXPECT_LT(flatness(three), 1e-14);
  EXPECT_TRUE(is_single_precision(points_of("georust-1028")));
  EXPECT_TRUE(has_decimals(points_of("jts-1061"), 20));

  int on_the_edge = 0;
  for (const Point& point : points_of("geos-728")) on_the_edge += point.y - 4102000 <= 1.001e-4 ? 1 : 0;
  EXPECT_GE(on_the_edge, 60);
}

TEST(Zoo, ClosePointsAreAsCloseAsPromised) {
  EXPECT_EQ(close_pairs(points_of("nts-716"), 1e-9), 288U);
  EXPECT_GE(close_pairs(points_of("geos-754"), 1e-6), 540U);
  EXPECT_EQ(close_pairs(points_of("qgis-63868"), 0.03), 3U);
  const auto [a, b] = farthest(points_of("qgis-63868"));
  EXPECT_GT(distance(a, b), 2e5);
  EXPECT_EQ(close_pairs(points_of("jts-298"), 1e-13), 19U);
  EXPECT_EQ(close_pairs(points_of("jts-321"), 0.002), 1U);
  EXPECT_EQ(close_pairs(points_of("delaunator-94"), 1e-16), 1U);
  EXPECT_EQ(close_pairs(points_of("shapely-1971"), 3e-6), 2U);
  EXPECT_TRUE(has_decimals(points_of("jts-1121"), 1e7));
  EXPECT_GE(close_pairs(points_of("spatialeco-60"), 120), 400U);
  EXPECT_EQ(places(points_of("alpha-shapes-1")).size(), points_of("alpha-shapes-1").size());
  EXPECT_LT(places(points_of("turf-333")).size(), points_of("turf-333").size());

  const std::vector<Point> track = points_of("hull-js-19");
  std::map<std::pair<double, double>, int> records;
  for (const Point& point : track) ++records[{point.x, point.y}];
  EXPECT_EQ(std::ranges::count_if(records, [](const auto& one) { return one.second >= 120; }), 3);
}

TEST(Zoo, LatticesHaveTheirSteps) {
  const std::map<std::string, std::pair<std::size_t, double>> expected = {
      {"delaunator-61", {3600, 1}}, {"delaunator-cpp-19", {9600, 1.0 / 120}}, {"geometry-10", {9900, 0.25}},
      {"concaveman-28", {720, 5}},  {"concaveman-1", {1661, 0.005}},
  };
  for (const auto& [name, lattice] : expected) {
    const std::vector<Point> points = points_of(name);
    ASSERT_EQ(points.size(), lattice.first) << name;
    EXPECT_EQ(places(points).size(), points.size()) << name;
    EXPECT_NEAR(distance(points[0], points[1]), lattice.second, 1e-12) << name;
  }
  EXPECT_TRUE(has_decimals(points_of("qhull-25"), 100));
  const std::vector<Point> pixels = points_of("concaveman-cpp-5");
  EXPECT_TRUE(has_decimals(pixels, 1));
  EXPECT_TRUE(std::is_sorted(pixels.begin(), pixels.end(),
                             [](const Point& one, const Point& other) { return one.x < other.x; }));
  EXPECT_EQ(points_of("delaunator-43").size(), 120U);
  EXPECT_TRUE(is_single_precision(points_of("delaunator-cpp-16")));
  for (const Point& point : points_of("delaunator-13")) EXPECT_NEAR(distance(point, {1, 1}), 3, 1e-14);

  for (const Point& point : points_of("delabella-8")) {
    const double x = point.x - 150;
    const double y = point.y - 250;
    EXPECT_EQ(x * x + y * y, 65 * 65);  // whole numbers, so exact
  }

  const std::vector<Point> walls = points_of("delaunator-cpp-28");
  EXPECT_TRUE(has_decimals(walls, 1000));
  EXPECT_TRUE(std::ranges::all_of(walls, [](const Point& point) {
    const double x = std::abs(point.x);
    const double nearest = std::min({std::abs(x - 10), std::abs(std::abs(point.y) - 6), std::abs(point.x + 3),
                                     std::abs(point.x - 4), std::abs(point.y - 1)});
    return nearest <= 0.0031;
  }));
}

TEST(Zoo, CloudsHaveTheirParts) {
  const std::map<std::string, std::pair<std::size_t, std::size_t>> expected = {
      {"pdal-4563", {2, 0}}, {"pdal-3921", {1, 0}}, {"lasr-219", {1, 3}},        {"lidr-757", {1, 0}},
      {"pcl-1457", {1, 0}},  {"jts-948", {3, 0}},   {"concaveman-r-8", {20, 0}}, {"hull-js-14", {1, 0}},
  };
  for (const auto& [name, parts] : expected) {
    const MultiPolygon shape = shape_of(name);
    std::size_t holes = 0;
    for (const Polygon& polygon : shape) holes += polygon.holes.size();
    EXPECT_EQ(shape.size(), parts.first) << name;
    EXPECT_EQ(holes, parts.second) << name;
  }
  EXPECT_EQ(points_of("concaveman-24").size(), 250000U);
  EXPECT_EQ(points_of("concaveman-r-8").size(), 100000U);
  EXPECT_EQ(points_of("concavity-2").size(), 10000U);
  EXPECT_EQ(close_pairs(points_of("pdal-2508"), 1e-4), 0U);
  EXPECT_EQ(points_of("pcl-1457").size(), 420U);
  EXPECT_TRUE(is_single_precision(points_of("pcl-1457")));
  EXPECT_EQ(points_of("baysor-103").size(), 190U * 30 + 10U * 2);

  const std::vector<Point> shuffled = points_of("concaveman-cpp-8");
  const Ring outline = shape_of("concaveman-cpp-8").front().shell;
  EXPECT_EQ(places(shuffled), places(outline));
  EXPECT_NE(shuffled, outline);
}

// What the plan asks of every method, of the core: no error, a valid result, and one without a limit that is
// empty exactly where the points have no area.
TEST(Zoo, TheCoreHasAnAnswerToEach) {
  for (const zoo::Case& one : zoo::cases()) {
    const std::vector<Point> points = one.make().points;
    polylidar::Options convex;
    convex.alpha = polylidar::kNoLimit;
    for (const polylidar::Options& options : {polylidar::Options{}, convex}) {
      const polylidar::IndexedMultiPolygon shape = polylidar::concave_hull(points, options);
      EXPECT_EQ(polylidar::check_polygon(points, shape), "") << one.name;
      const bool has_area = one.answer != zoo::Answer::kEmpty;
      if (!has_area || options.alpha) {
        EXPECT_EQ(shape.polygon_count(), has_area ? 1U : 0U) << one.name;
      }
    }
  }
}

TEST(Zoo, ThePlanHasEveryCase) {
  std::ifstream file(HULLBENCH_ZOO_PLAN);
  const json plan = json::parse(file);
  std::vector<std::string> names;
  for (const zoo::Case& one : zoo::cases()) names.push_back(one.name);
  EXPECT_EQ(plan["cases"][0]["dataset"].get<std::vector<std::string>>(), names);
}

}  // namespace
}  // namespace hullbench
