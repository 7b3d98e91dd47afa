// The shape without the triangulation of the interior is that of the whole triangulation, ring by ring.
//
// HULLBENCH_INTERIOR_CASES=N runs N small and N / 100 large random inputs instead of the share that fits into
// every test run; 100000 is the full battery.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/src/interior.hpp"
#include "polylidar/concave_hull.hpp"
#include "tests/hull_oracle.hpp"
#include "tests/point_sets.hpp"

namespace polylidar {
namespace {

using testing::Random;
using Points = std::vector<Point>;

// Takes the way without the interior wherever it can be gone, however little it pays.
constexpr detail::InteriorGuard kAlways{0, 1e5, 1, 1};

// Both ways, with memory that is kept.
class BothWays {
 public:
  const IndexedMultiPolygon& whole(const Points& points, const Options& options) {
    whole_.triangulate(points, options.threads);
    whole_.extract_regions(options);
    return whole_.extract_polygons();
  }

  // What the way without the interior says; its shape is in part().
  Statistics go(const Points& points, const Options& options, const detail::InteriorGuard& guard = kAlways) {
    pool_.use(options.threads);
    const Limits limits{options.alpha.value_or(kNoLimit), options.max_edge_length.value_or(kNoLimit),
                        options.max_perimeter.value_or(kNoLimit)};
    return path_.extract(points, limits, options.fill_single_triangles.value_or(false),
                         {pool_, builder_, filter_, boundary_, tracer_}, part_, guard);
  }
  const IndexedMultiPolygon& part() const { return part_; }

 private:
  Extractor whole_;
  detail::ThreadPool pool_;
  detail::DelaunayBuilder builder_;
  detail::RegionFilter filter_;
  std::vector<detail::Mesh::Index> boundary_;
  detail::BoundaryTracer tracer_;
  detail::InteriorPath path_;
  IndexedMultiPolygon part_;
};

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
    return Point{static_cast<double>(i % columns) / static_cast<double>(columns),
                 static_cast<double>(i / columns) / static_cast<double>(columns)};
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

// Limits of all kinds, singly and together, most of them where some triangles are dropped and most are not.
Options random_options(const Points& points, Random& random) {
  const Box box = bounding_box(points);
  const double spacing =
      std::sqrt((box.max.x - box.min.x) * (box.max.y - box.min.y) / static_cast<double>(points.size()));
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
      const int exponent = static_cast<int>(random.integer(60));
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

void compare_random_inputs(std::size_t cases, std::size_t least, std::size_t most) {
  BothWays ways;
  WayCounts counts;
  for (std::uint64_t seed = 0; seed < cases && !::testing::Test::HasFailure(); ++seed) {
    Random random(seed);
    const Sampler& sampler = samplers()[seed % samplers().size()];
    SCOPED_TRACE(std::string(sampler.name) + ", seed " + std::to_string(seed));
    const double size =
        std::exp(random.between(std::log(static_cast<double>(least)), std::log(static_cast<double>(most))));
    Points points = sample(sampler, static_cast<std::size_t>(size), random);
    move(points, random);
    Options options = random_options(points, random);
    options.threads = std::array{1U, 1U, 1U, 2U, 3U, 8U}[random.below(6)];
    compare(ways, points, options, counts);
  }
  std::string report;
  for (const auto& [way, count] : counts) {
    report += " " + std::to_string(static_cast<int>(way)) + ":" + std::to_string(count);
  }
  std::cout << "ways" << report << '\n';
  EXPECT_GT(counts[Way::kInteriorLeftOut], cases / 2);
}

TEST(InteriorLeftOut, GivesTheShapesOfSmallInputs) {
  compare_random_inputs(case_count(4000), 10, 2000);
}

TEST(InteriorLeftOut, GivesTheShapesOfLargeInputs) {
  compare_random_inputs(std::max<std::size_t>(case_count(2000) / 100, 1), 20'000, 200'000);
}

TEST(InteriorLeftOut, GivesTheShapesOfNastyPointSets) {
  BothWays ways;
  WayCounts counts;
  Random random(1);
  std::vector<testing::PointSet> sets = testing::nasty_point_sets();
  for (testing::NamedCase& named : testing::named_cases())
    sets.push_back({named.name, std::move(named.points)});
  for (const testing::PointSet& set : sets) {
    SCOPED_TRACE(set.name);
    if (set.points.empty()) continue;
    for (int i = 0; i < 10; ++i) compare(ways, set.points, random_options(set.points, random), counts);
  }
  EXPECT_GT(counts[Way::kInteriorLeftOut], 100U);
}

}  // namespace
}  // namespace polylidar
