// The shape without the triangulation of the interior is that of the whole triangulation, ring by ring.
//
// HULLBENCH_INTERIOR_CASES=N runs N small and N / 100 large random inputs, and N / 500 of the default by
// places, instead of the share that fits into every test run; 100000 is the full battery.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/src/automatic_limit.hpp"
#include "polylidar/concave_hull.hpp"
#include "polylidar/delaunay.hpp"
#include "tests/both_ways.hpp"
#include "tests/hull_oracle.hpp"
#include "tests/point_sets.hpp"

namespace polylidar {
namespace {

using testing::BothWays;
using testing::Random;
using Points = std::vector<Point>;

struct Sampler {
  const char* name;
  std::function<Point(Random&, std::size_t i, std::size_t n)> point;
};

bool is_in_shape_with_holes(const Point& p) {
  const double angle = std::atan2(p.y - 0.5, p.x - 0.5);
  const double distance = std::hypot(p.x - 0.5, p.y - 0.5);
  if (distance > 0.35 + 0.12 * std::cos(5 * angle)) return false;
  for (const auto& [x, y, r] : {std::array{0.4, 0.45, 0.08}, {0.65, 0.6, 0.05}, {0.5, 0.7, 0.03}}) {
    if (std::hypot(p.x - x, p.y - y) < r) return false;
  }
  return true;
}

// Points of [0, 1)^2, so dense or so regular in different ways.
const std::vector<Sampler>& samplers() {
  const auto cell = [](std::size_t i, std::size_t n) {
    const auto columns = static_cast<std::size_t>(std::sqrt(static_cast<double>(n)));
    const std::size_t row = i / columns;
    return Point{static_cast<double>(i % columns) / static_cast<double>(columns),
                 static_cast<double>(row) / static_cast<double>(columns)};
  };
  static const std::vector<Sampler> all = {
      {"uniform",
       [](Random& r, std::size_t, std::size_t) {
         return Point{r.unit(), r.unit()};
       }},
      {"shape with holes",
       [](Random& r, std::size_t, std::size_t) {
         for (;;) {
           const Point p{r.unit(), r.unit()};
           if (is_in_shape_with_holes(p)) return p;
         }
       }},
      {"jittered lattice",
       [=](Random& r, std::size_t i, std::size_t n) {
         const double step = 1 / std::sqrt(static_cast<double>(n));
         const Point p = cell(i, n);
         return Point{p.x + step * r.unit(), p.y + step * r.unit()};
       }},
      {"lattice", [=](Random&, std::size_t i, std::size_t n) { return cell(i, n); }},
      {"lattice with gaps",
       [=](Random& r, std::size_t i, std::size_t n) { return r.below(8) == 0 ? cell(0, n) : cell(i, n); }},
      {"binary lattice",
       [](Random& r, std::size_t, std::size_t n) {
         const auto side = std::size_t{1}
                           << static_cast<unsigned>(std::ilogb(std::sqrt(static_cast<double>(n))));
         return Point{static_cast<double>(r.below(side)) / static_cast<double>(side),
                      static_cast<double>(r.below(side)) / static_cast<double>(side)};
       }},
      {"hexagonal lattice",
       [=](Random&, std::size_t i, std::size_t n) {
         const auto columns = static_cast<std::size_t>(std::sqrt(static_cast<double>(n)));
         const double step = 1 / static_cast<double>(columns);
         const Point p = cell(i, n);
         return Point{p.x + (i / columns % 2 == 0 ? 0 : step / 2), p.y * 0.8660254037844386};
       }},
      {"every point four times",
       [](Random& r, std::size_t i, std::size_t) {
         Random own(i / 4 + r.below(2));
         return Point{own.unit(), own.unit()};
       }},
      {"rings",
       [](Random& r, std::size_t i, std::size_t n) {
         const auto rings = static_cast<std::size_t>(std::sqrt(static_cast<double>(n) / 6)) + 1;
         const double ring = static_cast<double>(i % rings + 1) / static_cast<double>(rings);
         const double angle =
             6.283185307179586 * static_cast<double>(r.below(4 * rings)) / static_cast<double>(4 * rings);
         return Point{0.5 + 0.5 * ring * std::cos(angle), 0.5 + 0.5 * ring * std::sin(angle)};
       }},
      {"gradient",
       [](Random& r, std::size_t, std::size_t) {
         return Point{std::pow(r.unit(), 1.5), r.unit()};
       }},
      {"clusters",
       [](Random& r, std::size_t i, std::size_t) {
         Random centre(i % 5);
         return Point{0.8 * centre.unit() + 0.3 * r.unit() * r.unit(), 0.8 * centre.unit() + 0.3 * r.unit()};
       }},
      {"close pairs",
       [](Random& r, std::size_t i, std::size_t) {
         Random own(i / 2);
         const Point p{own.unit(), own.unit()};
         if (i % 2 == 0) return p;
         const double distance = std::ldexp(1.0, -static_cast<int>(4 + own.below(60)));
         return Point{p.x + distance * r.unit(), p.y + distance * r.unit()};
       }},
      {"centred, with fine coordinates",
       [](Random& r, std::size_t, std::size_t) {
         return Point{(r.unit() - 0.5) * std::ldexp(1.0, -static_cast<int>(r.below(3) * r.below(60))),
                      r.unit() - 0.5};
       }},
      {"lines", [](Random& r, std::size_t i, std::size_t) {
         return Point{static_cast<double>(i % 40) / 40, r.unit()};
       }}};
  return all;
}

Points sample(const Sampler& sampler, std::size_t n, Random& random) {
  Points points(n);
  for (std::size_t i = 0; i < n; ++i) points[i] = sampler.point(random, i, n);
  return testing::shuffled(points, random.below(1U << 30U));
}

double spacing_in_box(const Points& points) {
  const Box box = bounding_box(points);
  return std::sqrt((box.max.x - box.min.x) * (box.max.y - box.min.y) / static_cast<double>(points.size()));
}

// Limits of all kinds, singly and together, most of them where some triangles are dropped and most are not.
Options random_options(const Points& points, Random& random) {
  const double spacing = spacing_in_box(points);
  const auto radius = [&] {
    const double r = spacing * random.between(0.8, 5);
    // A round number of spacings hits the triangles of lattices exactly.
    return random.below(4) == 0 ? spacing * std::sqrt(static_cast<double>(random.below(24) + 1)) / 2 : r;
  };
  Options options;
  const std::size_t kinds = 1 + random.below(7);
  if ((kinds & 1U) != 0) options.alpha = random.below(8) == 0 ? kNoLimit : radius();
  if ((kinds & 2U) != 0) options.max_edge_length = random.below(8) == 0 ? kNoLimit : 2 * radius();
  if ((kinds & 4U) != 0) options.max_perimeter = random.below(8) == 0 ? kNoLimit : 5.2 * radius();
  if (random.below(3) == 0) options.fill_single_triangles = random.below(2) == 0;
  return options;
}

// In units of another size and at another place; exact only in its size.
void move(Points& points, Random& random) {
  switch (random.below(4)) {
    case 0: {
      // Anywhere in the range in which coordinates are not scaled, its ends included.
      const auto [least, greatest] = testing::exponents(points).value();
      const int lowest = -116 - least;
      const int highest = 149 - greatest;
      const int between =
          lowest + static_cast<int>(random.below(static_cast<std::size_t>(highest - lowest) + 1));
      const int exponent = std::array{lowest, between, between, highest}[random.below(4)];
      for (Point& p : points) p = {std::ldexp(p.x, exponent), std::ldexp(p.y, exponent)};
      break;
    }
    case 1: {
      const double scale = std::exp(random.between(-20, 20));
      const Point offset{random.between(-100, 100), random.between(-100, 100)};
      for (Point& p : points) p = {scale * (p.x + offset.x), scale * (p.y + offset.y)};
      break;
    }
    default:
      break;
  }
}

std::size_t case_count(std::size_t usual) {
  const char* const wanted = std::getenv("HULLBENCH_INTERIOR_CASES");
  return wanted == nullptr ? usual : std::stoul(wanted);
}

// How often which way was gone: a test that always goes the whole way tests nothing.
using WayCounts = std::map<Way, std::size_t>;

void compare(BothWays& ways, const Points& points, const Options& options, WayCounts& counts) {
  const Statistics statistics = ways.go(points, options);
  ++counts[statistics.way];
  if (statistics.way != Way::kInteriorLeftOut) return;
  EXPECT_LE(statistics.uncertain_points, statistics.triangulated_points);
  EXPECT_LE(statistics.triangulated_points, points.size());
  EXPECT_EQ(ways.part(), ways.whole(points, options)) << testing::describe(options);
}

// A limit as the default chooses it, most often one where holes come and go.
detail::SizeField random_field(const Points& points, Random& random) {
  const double spacing = spacing_in_box(points);
  const double limit = spacing * random.between(1.2, 4.5);
  return {.limit4 = {std::pow(limit, 4)},
          .spike_share = random.below(4) == 0 ? 1 : random.between(0.1, 1),
          .least_region = random.below(40),
          .wide_square = random.below(4) == 0 ? 0x1p-20 : random.between(0, 8),
          .wide_radius = spacing * random.between(0.8, 3.5),
          .block_of_vertex = {}};
}

// Divides the box of the points into squares, and gives `field` a limit in each, about that which it has.
testing::BlockOf divide(const Points& points, Random& random, detail::SizeField& field) {
  const Box box = bounding_box(points);
  const auto columns = static_cast<std::uint32_t>(2 + random.below(6));
  const double side = (box.max.x - box.min.x) / columns;
  const auto cell = [side](double from, double to) {
    return side > 0 ? static_cast<std::uint32_t>(std::min((to - from) / side, 1e3)) : 0U;
  };
  const std::uint32_t blocks = columns * 7;
  const double limit4 = field.limit4[0];
  field.limit4.clear();
  for (std::uint32_t b = 0; b < blocks; ++b) {
    field.limit4.push_back(limit4 * std::pow(random.between(0.6, 1.7), 4));
  }
  return [=](const Point& p) { return (cell(box.min.y, p.y) * columns + cell(box.min.x, p.x)) % blocks; };
}

void compare_sizes(BothWays& ways, const Points& points, unsigned threads, Random& random,
                   WayCounts& counts) {
  detail::SizeField field = random_field(points, random);
  const bool fill_single = random.below(2) == 0;
  testing::BlockOf block_of;
  if (random.below(2) == 0) block_of = divide(points, random, field);
  const Statistics statistics = ways.go(points, field, fill_single, threads, block_of);
  ++counts[statistics.way];
  if (statistics.way != Way::kInteriorLeftOut) return;
  const IndexedMultiPolygon part = ways.part();
  EXPECT_EQ(part, ways.whole(points, field, fill_single, block_of))
      << "limits " << field.limit4.size() << " limit^4 " << field.limit4[0] << " spikes " << field.spike_share
      << " regions " << field.least_region << " wide " << field.wide_square << ' ' << field.wide_radius;
}

// Of all samplers in turn: `cases` inputs with every `step`-th seed from `first` on.
void compare_random_inputs(std::size_t cases, std::size_t least, std::size_t most, std::uint64_t first = 0,
                           std::uint64_t step = 1) {
  BothWays ways;
  WayCounts counts;
  WayCounts counts_of_sizes;
  for (std::size_t i = 0; i < cases && !::testing::Test::HasFailure(); ++i) {
    const std::uint64_t seed = first + step * i;
    Random random(seed);
    const Sampler& sampler = samplers()[seed % samplers().size()];
    SCOPED_TRACE(std::string(sampler.name) + ", seed " + std::to_string(seed));
    const double size =
        std::exp(random.between(std::log(static_cast<double>(least)), std::log(static_cast<double>(most))));
    Points points = sample(sampler, static_cast<std::size_t>(size), random);
    move(points, random);
    Options options = random_options(points, random);
    // In turn, as starting threads takes longer than the rest where other tests keep the cores busy.
    options.threads = std::array{1U, 1U, 1U, 2U, 3U, 8U}[6 * i / cases];
    compare(ways, points, options, counts);
    compare_sizes(ways, points, options.threads, random, counts_of_sizes);
  }
  EXPECT_GT(counts_of_sizes[Way::kInteriorLeftOut], cases / 3);
  EXPECT_GT(counts[Way::kInteriorLeftOut], cases / 2);
}

TEST(InteriorLeftOut, GivesTheShapesOfSmallInputs) {
  compare_random_inputs(case_count(2500), 10, 2000);
}

// Here borders of small regions go through certain points, whose triangles are not all known.
TEST(InteriorLeftOut, GivesTheShapesOfRepeatedPoints) {
  constexpr std::uint64_t kEveryPointFourTimes = 7;
  ASSERT_STREQ(samplers()[kEveryPointFourTimes].name, "every point four times");
  compare_random_inputs(700, 10, 2000, kEveryPointFourTimes, samplers().size());
}

TEST(InteriorLeftOut, GivesTheShapesOfLargeInputs) {
  compare_random_inputs(std::max<std::size_t>(case_count(2800) / 100, 1), 20'000, 120'000);
}

// Where no limit is given, of so many points that one may be found for all places.
TEST(InteriorLeftOut, GivesTheShapesOfTheDefault) {
  Extractor extractor;
  Extractor steps;
  WayCounts counts;
  WayCounts counts_of_few;
  for (std::uint64_t seed = 0; seed < 6 * samplers().size(); ++seed) {
    Random random(seed);
    const Sampler& sampler = samplers()[seed % samplers().size()];
    const bool are_few = seed / samplers().size() % 2 == 1;
    const std::size_t count = are_few ? 7'500 + random.below(25'500) : 33'000 + random.below(60'000);
    Points points = sample(sampler, count, random);
    move(points, random);
    Options options{.detail = std::array{0.5, 1.0, 1.0, 1.0, 1.5}[random.below(5)],
                    .threads = std::array{1U, 2U, 3U, 8U}[random.below(4)]};
    if (random.below(3) == 0) options.fill_single_triangles = false;
    SCOPED_TRACE(::testing::Message() << sampler.name << ", seed " << seed << ", detail " << options.detail
                                      << ", threads " << options.threads);
    steps.triangulate(points, options.threads);
    steps.extract_regions(options);
    const IndexedMultiPolygon whole = steps.extract_polygons();
    EXPECT_EQ(extractor.extract(points, options), whole);
    EXPECT_EQ(extractor.chosen_sizes(), steps.chosen_sizes());
    EXPECT_EQ(extractor.limits(), Limits{});
    ++(are_few ? counts_of_few : counts)[extractor.statistics().way];
    if (extractor.statistics().way != Way::kInteriorLeftOut) continue;
    EXPECT_EQ(extractor.count_triangles(), steps.count_triangles());
    EXPECT_LE(static_cast<double>(extractor.statistics().triangulated_points),
              detail::InteriorGuard().most_gathered * static_cast<double>(points.size()));
  }
  EXPECT_GT(counts_of_few[Way::kInteriorLeftOut], 4U);
  EXPECT_GT(counts[Way::kInteriorLeftOut], 8U);
  EXPECT_GT(counts[Way::kWhole], 3U);
}

// Where the density of many points varies by a few times: those inputs of all samplers for which the sizes
// are found place by place.
TEST(InteriorLeftOut, GivesTheShapesOfTheDefaultByPlaces) {
  Extractor extractor;
  Extractor steps;
  detail::AutomaticLimit limit;
  detail::ThreadPool pool;
  std::set<std::string> samplers_of_inputs;
  WayCounts counts;
  const std::size_t cases = std::max(2 * samplers().size(), case_count(0) / 500);
  for (std::uint64_t seed = 0; seed < cases; ++seed) {
    Random random(seed);
    const Sampler& sampler = samplers()[seed % samplers().size()];
    Points points = sample(sampler, 265'000 + random.below(60'000), random);
    const double sparser = random.between(0.2, 2);  // to one side
    for (Point& p : points) p.x *= 1 + sparser * std::abs(p.x);
    move(points, random);
    const auto by = limit.look(detail::passes_over(points, pool), bounding_box(points), pool);
    if (by != detail::SizesBy::kPlaces) continue;
    samplers_of_inputs.insert(sampler.name);
    Options options{.detail = std::array{0.7, 1.0, 1.5}[random.below(3)]};
    if (random.below(3) == 0) options.fill_single_triangles = false;
    SCOPED_TRACE(::testing::Message() << sampler.name << ", seed " << seed << ", detail " << options.detail);
    steps.triangulate(points);
    steps.extract_regions(options);
    const IndexedMultiPolygon whole = steps.extract_polygons();
    for (const unsigned threads : {1U, 2U, 3U, 8U}) {
      options.threads = threads;
      EXPECT_EQ(extractor.extract(points, options), whole) << threads << " threads";
      EXPECT_EQ(extractor.chosen_sizes(), steps.chosen_sizes()) << threads << " threads";
      ++counts[extractor.statistics().way];
    }
  }
  EXPECT_GT(samplers_of_inputs.size(), 5U);
  EXPECT_GT(counts[Way::kInteriorLeftOut], 20U);
}

TEST(InteriorLeftOut, GivesTheShapesOfNastyPointSets) {
  BothWays ways;
  WayCounts counts;
  WayCounts counts_of_sizes;
  Random random(1);
  std::vector<testing::PointSet> sets = testing::nasty_point_sets();
  for (testing::NamedCase& named : testing::named_cases())
    sets.push_back({named.name, std::move(named.points)});
  for (const testing::PointSet& set : sets) {
    SCOPED_TRACE(set.name);
    if (set.points.empty()) continue;
    for (int i = 0; i < 10; ++i) {
      compare(ways, set.points, random_options(set.points, random), counts);
      compare_sizes(ways, set.points, 1, random, counts_of_sizes);
    }
  }
  EXPECT_GT(counts[Way::kInteriorLeftOut], 100U);
  EXPECT_GT(counts_of_sizes[Way::kInteriorLeftOut], 0U);
}

// A dense cloud with a round hole, all of whose points but the outermost lie on the hole's circle: the limit
// decides whether the hole is there, and the certificate's radius lies just below it.
TEST(InteriorLeftOut, FindsAHoleWhoseRadiusIsTheLimit) {
  BothWays ways;
  std::size_t holes = 0;
  std::size_t none = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Random random(seed);
    const double radius = random.between(0.04, 0.06);
    const Point centre{random.between(0.3, 0.7), random.between(0.3, 0.7)};
    Points points;
    while (points.size() < 3000) {
      const Point p{random.unit(), random.unit()};
      if (std::hypot(p.x - centre.x, p.y - centre.y) > radius * 1.001) points.push_back(p);
    }
    const Points rim = testing::circle(64, radius, centre);
    points.insert(points.end(), rim.begin(), rim.end());
    for (const double share : {1 - 0x1p-6, 1 - 0x1p-8, 1 - 0x1p-9, 1 - 0x1p-30, 1 - 0x1p-50, 1 - 0x1p-53, 1.0,
                               1 + 0x1p-52, 1 + 0x1p-50, 1 + 0x1p-30, 1 + 0x1p-9, 1 + 0x1p-8, 1 + 0x1p-6}) {
      SCOPED_TRACE(::testing::Message() << "seed " << seed << ", limit " << share << " radii");
      const Options options{.alpha = share * radius};
      const Statistics statistics = ways.go(points, options);
      const IndexedMultiPolygon& whole = ways.whole(points, options);
      (whole.ring_ends.size() > 1 ? holes : none) += 1;
      if (std::abs(share - 1) > 0x1p-40) {
        EXPECT_EQ(statistics.way, Way::kInteriorLeftOut);
      }
      if (statistics.way == Way::kInteriorLeftOut) {
        EXPECT_EQ(ways.part(), whole);
      }
    }
  }
  EXPECT_GT(holes, 100U);
  EXPECT_GT(none, 100U);
}

// A limit that is some triangle's own size up to rounding: the answer depends on the corner where the
// arithmetic starts, and then the whole way is gone.
TEST(InteriorLeftOut, LeavesToTheWholeWayWhatRoundingDecides) {
  BothWays ways;
  WayCounts counts;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Points points = sample(samplers()[1], 1000, random);
    const Triangulation triangulation = delaunay(points);
    const double spacing = 0.6 / std::sqrt(static_cast<double>(points.size()));
    for (int i = 0; i < 20; ++i) {
      const std::size_t t = 3 * random.below(triangulation.triangles.size() / 3);
      const auto corner = [&](std::size_t k) { return points[triangulation.triangles[t + k]]; };
      const double radius = testing::circumradius(corner(0), corner(1), corner(2));
      if (radius < 1.5 * spacing || radius > 20 * spacing) continue;
      compare(ways, points, {.alpha = radius}, counts);
    }
  }
  EXPECT_GT(counts[Way::kRoundingDecides], 5U);
  EXPECT_GT(counts[Way::kInteriorLeftOut], 100U);
}

// The same of a limit on sizes, as the core chooses it where none is given.
TEST(InteriorLeftOut, LeavesToTheWholeWayASizeThatRoundingDecides) {
  BothWays ways;
  WayCounts counts;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Points points = sample(samplers()[1], 1000, random);
    const Triangulation triangulation = delaunay(points);
    const double spacing = 0.6 / std::sqrt(static_cast<double>(points.size()));
    for (std::size_t t = 0; t < triangulation.triangles.size(); t += 3) {
      const auto corner = [&](std::size_t k) -> const Point& {
        return points[triangulation.triangles[t + k]];
      };
      const double limit4 = detail::Triangle(0, corner(0), corner(1), corner(2)).size4();
      const double limit = std::sqrt(std::sqrt(limit4));
      if (limit < 1.5 * spacing || limit > 5 * spacing) continue;
      const detail::SizeField field{
          .limit4 = {limit4}, .spike_share = 1, .wide_square = 2, .wide_radius = 0.9 * limit};
      const Statistics statistics = ways.go(points, field, true, 1 + static_cast<unsigned>(seed % 3));
      ++counts[statistics.way];
      if (statistics.way != Way::kInteriorLeftOut) continue;
      const IndexedMultiPolygon part = ways.part();
      EXPECT_EQ(part, ways.whole(points, field, true)) << limit4;
    }
  }
  EXPECT_GT(counts[Way::kRoundingDecides], 5U);
  EXPECT_GT(counts[Way::kInteriorLeftOut], 100U);
}

// Two points of the interior that nearly coincide make slivers whose area is lost in rounding, so that the
// rule may drop them although their circles are small.
TEST(InteriorLeftOut, LeavesToTheWholeWaySliversBetweenClosePoints) {
  BothWays ways;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Random random(seed);
    Points points = testing::uniform_points(3000, seed);
    for (Point& p : points) p = {p.x - 0.5, p.y - 0.5};
    std::erase_if(points, [](const Point& p) { return std::hypot(p.x, p.y) < 0.01; });
    const double distance = std::ldexp(random.between(0.5, 1), -static_cast<int>(40 + random.below(30)));
    const double angle = random.between(0, 6.3);
    points.push_back({0, 0});
    points.push_back({distance * std::cos(angle), distance * std::sin(angle)});
    for (const double alpha : {0.05, 0.08}) {
      SCOPED_TRACE(::testing::Message() << "seed " << seed << ", alpha " << alpha);
      const Statistics statistics = ways.go(points, {.alpha = alpha});
      const IndexedMultiPolygon& whole = ways.whole(points, {.alpha = alpha});
      if (distance < 0x1p-47) {
        EXPECT_EQ(statistics.way, Way::kClosePoints);
      }
      if (statistics.way == Way::kInteriorLeftOut) {
        EXPECT_EQ(ways.part(), whole);
      }
      // Lengths are never lost.
      const Options by_length{.max_edge_length = 2 * alpha, .max_perimeter = 5 * alpha};
      ASSERT_EQ(ways.go(points, by_length).way, Way::kInteriorLeftOut);
      EXPECT_EQ(ways.part(), ways.whole(points, by_length));
    }
  }
}

// By size, such slivers make no hole: none is wide, however its area is rounded.
TEST(InteriorLeftOut, SliversBetweenClosePointsMakeNoHole) {
  BothWays ways;
  std::size_t left_out = 0;
  const detail::SizeField field{
      .limit4 = {std::pow(1.7, 4)}, .spike_share = 1, .wide_square = 0x1p-20, .wide_radius = 2.45};
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    Points points = testing::lattice(61, 61);
    for (Point& p : points) p = {p.x - 30 + random.between(-0.2, 0.2), p.y - 30 + random.between(-0.2, 0.2)};
    std::erase_if(points, [](const Point& p) { return std::hypot(p.x, p.y) < 3.6; });
    const double distance = std::ldexp(random.between(0.5, 1), -static_cast<int>(45 + random.below(30)));
    const double angle = random.between(0, 6.3);
    points.push_back({0, 0});
    points.push_back({distance * std::cos(angle), distance * std::sin(angle)});
    if (ways.go(points, field, true, 1).way != Way::kInteriorLeftOut) continue;
    ++left_out;
    const IndexedMultiPolygon part = ways.part();
    EXPECT_EQ(part, ways.whole(points, field, true));
  }
  EXPECT_GT(left_out, 50U);
}

// Why: the same sliver, from one corner and from another.
TEST(InteriorLeftOut, SliversBetweenClosePointsAreKeptOrNotByTheirFirstCorner) {
  const Points corners = {{0, 0}, {0x1p-70, 0}, {0.0123, 0.0231}};
  detail::Mesh mesh;
  mesh.reset(2);
  const auto is_kept = [&](detail::Mesh::Index first) {
    for (detail::Mesh::Index k = 0; k < 3; ++k) mesh.origin(k) = (first + k) % 3;
    return detail::CircumradiusRule(0.05).keeps(detail::Triangle(mesh, corners.data(), 0));
  };
  EXPECT_TRUE(is_kept(0));
  EXPECT_FALSE(is_kept(2));
}

// A LAS file has whole numbers and a scale, of which no double is a power of two; limits have few decimals.
TEST(InteriorLeftOut, AlsoOfCoordinatesWithFewDecimals) {
  BothWays ways;
  for (const double scale : {0.01, 0.001, 1e-7}) {
    Points points = testing::uniform_points(200'000, 1, 400);
    for (Point& p : points) p = {std::floor(p.x / scale) * scale, std::floor(p.y / scale) * scale};
    for (const double alpha : {2.0, 2.5, 3.0, 1.12 * 2}) {
      SCOPED_TRACE(::testing::Message() << "scale " << scale << ", alpha " << alpha);
      EXPECT_EQ(ways.go(points, {.alpha = alpha}).way, Way::kInteriorLeftOut);
      EXPECT_EQ(ways.part(), ways.whole(points, {.alpha = alpha}));
    }
  }
}

TEST(InteriorLeftOut, AlsoOfPointsThatComeRowByRow) {
  // Looked at from row to row, their first column alone says nothing of the others.
  for (const std::size_t columns : {100U, 160U, 424U}) {
    for (std::size_t rows = 64; rows <= 256; rows += 16) {
      const Points points = testing::lattice(columns, rows);
      Extractor extractor;
      extractor.extract(points, {.alpha = 2});
      EXPECT_EQ(extractor.statistics().way, Way::kInteriorLeftOut) << columns << " x " << rows;
    }
  }
}

// What the proof needs of the part: it has every uncertain point's neighbours in the triangulation of all
// points.
TEST(InteriorPart, HasAllNeighboursOfUncertainPoints) {
  detail::InteriorPart part;
  detail::ThreadPool pool;
  pool.use(1);
  std::size_t neighbours = 0;
  std::size_t left_out = 0;
  for (std::uint64_t seed = 0; seed < 20 * samplers().size(); ++seed) {
    Random random(seed);
    const Sampler& sampler = samplers()[seed % samplers().size()];
    SCOPED_TRACE(::testing::Message() << sampler.name << ", seed " << seed);
    const Points points = sample(sampler, 200 + random.below(4000), random);
    const double radius = random.between(0.9, 2.4) / std::sqrt(static_cast<double>(points.size()));
    if (part.choose(points, detail::measure_coordinates(points, pool), radius, false, testing::kAlways,
                    pool)) {
      continue;
    }
    std::vector<bool> is_in_part(points.size());
    std::vector<bool> is_uncertain(points.size());
    for (std::size_t i = 0; i < part.points().size(); ++i) {
      is_in_part[part.caller_index()[i]] = true;
      is_uncertain[part.caller_index()[i]] = part.is_uncertain()[i] != 0;
    }
    left_out += points.size() - part.points().size();
    const Triangulation whole = delaunay(points);
    for (std::size_t e = 0; e < whole.triangles.size(); ++e) {
      const std::uint32_t from = whole.triangles[e];
      const std::uint32_t to = whole.triangles[e % 3 == 2 ? e - 2 : e + 1];
      neighbours += is_uncertain[from] || is_uncertain[to] ? 1U : 0U;
      ASSERT_TRUE(!is_uncertain[from] || is_in_part[to]) << from << ", " << to;
      ASSERT_TRUE(!is_uncertain[to] || is_in_part[from]) << from << ", " << to;
    }
  }
  EXPECT_GT(neighbours, 100'000U);
  EXPECT_GT(left_out, 100'000U);
}

TEST(InteriorLeftOut, CanBeAskedAbout) {
  const Points points = testing::uniform_points(20'000, 1);
  Extractor extractor;
  const auto way = [&](const Points& of, const Options& options) {
    extractor.extract(of, options);
    return extractor.statistics().way;
  };
  EXPECT_EQ(way(points, {.max_perimeter = 0.09}), Way::kInteriorLeftOut);
  EXPECT_EQ(extractor.statistics().points, points.size());
  EXPECT_GT(extractor.statistics().uncertain_points, 0U);
  EXPECT_LT(extractor.statistics().uncertain_points, points.size() / 10);
  EXPECT_GT(extractor.statistics().triangulated_points, extractor.statistics().uncertain_points);
  EXPECT_LT(extractor.statistics().triangulated_points, points.size() / 3);
  EXPECT_EQ(way(points, testing::kConvexHull), Way::kInteriorLeftOut);
  EXPECT_EQ(way(points, {}), Way::kInteriorLeftOut);
  EXPECT_EQ(way(testing::uniform_points(7'000, 1), {}), Way::kFewPoints);
  EXPECT_EQ(extractor.statistics().triangulated_points, 7'000U);
  EXPECT_EQ(way(testing::uniform_points(1000, 1), {.alpha = 0.1}), Way::kFewPoints);
  EXPECT_EQ(way(points, {.alpha = 0.001}), Way::kTooSparse);
  EXPECT_EQ(way(points, {.alpha = 0}), Way::kTooSparse);
  EXPECT_EQ(way(points, {.alpha = 0.0085}), Way::kMuchOutline);
  EXPECT_EQ(way(testing::circle(20'000, 1), {.alpha = 2}), Way::kMuchOutline);
  // Each point four times: a disk holds few different ones. That is enough where they are a lattice.
  const auto four_times = [](const Points& once) {
    Points copies;
    for (const Point& p : once) copies.insert(copies.end(), 4, p);
    return copies;
  };
  EXPECT_EQ(way(four_times(testing::uniform_points(2000, 1)), {.alpha = 0.0224}), Way::kMuchOutline);
  EXPECT_EQ(way(four_times(testing::lattice(50, 50, 0.1)), {.alpha = 0.1}), Way::kInteriorLeftOut);
  Points other = testing::scaled(points, 600, 600);
  EXPECT_EQ(way(other, {.alpha = std::ldexp(0.02, 600)}), Way::kExtremeCoordinates);
  other = points;
  other.push_back({other[10'000].x, std::nextafter(other[10'000].y, 2)});
  EXPECT_EQ(way(other, {.alpha = 0.02}), Way::kClosePoints);
  EXPECT_EQ(way(other, {.max_edge_length = 0.04}), Way::kInteriorLeftOut);
  extractor.triangulate(points);
  EXPECT_EQ(extractor.statistics().way, Way::kWhole);
}

TEST(InteriorLeftOut, TheRestIsTriangulatedWhenItIsAskedFor) {
  const Points points = testing::shuffled(testing::uniform_points(20'000, 2), 1);
  const Options options{.max_perimeter = 0.085};
  Extractor steps;
  steps.triangulate(points);
  steps.extract_regions(options);
  const IndexedMultiPolygon whole = steps.extract_polygons();
  Extractor extractor;
  ASSERT_EQ(extractor.extract(points, options), whole);
  ASSERT_EQ(extractor.statistics().way, Way::kInteriorLeftOut);
  EXPECT_TRUE(extractor.has_triangles());
  EXPECT_EQ(extractor.limits(), steps.limits());
  EXPECT_EQ(extractor.count_triangles(), steps.count_triangles());
  EXPECT_EQ(extractor.extract_polygons(), whole);
  for (const double alpha : {0.01, 0.02}) {
    extractor.extract(points, options);
    extractor.extract_regions({.alpha = alpha});
    EXPECT_EQ(extractor.statistics().way, Way::kWhole);
    EXPECT_EQ(extractor.statistics().triangulated_points, points.size());
    steps.extract_regions({.alpha = alpha});
    EXPECT_EQ(extractor.extract_polygons(), steps.extract_polygons());
    EXPECT_EQ(extractor.count_triangles(), steps.count_triangles());
  }
  const Points flat = testing::lattice(20'000, 1);
  extractor.extract(flat, options);
  EXPECT_FALSE(extractor.has_triangles());
}

}  // namespace
}  // namespace polylidar
