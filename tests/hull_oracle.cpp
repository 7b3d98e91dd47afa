#include "tests/hull_oracle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <sstream>
#include <tuple>
#include <utility>

#include "polylidar/predicates.hpp"

namespace polylidar::testing {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A triangle's measures in long double, whose range no double coordinates exceed here.
struct Measures {
  long double longest_edge = 0;
  long double perimeter = 0;
  long double twice_area = 0;
  long double least_circumradius = 0;  // what double arithmetic may come to, at least ...
  long double most_circumradius = 0;   // ... and at most; infinite when the area may vanish
};

Measures measure(std::span<const Point> points, const Triangulation& triangulation, std::size_t triangle) {
  std::array<long double, 3> x;
  std::array<long double, 3> y;
  for (std::size_t i = 0; i < 3; ++i) {
    const Point& point = points[triangulation.triangles[3 * triangle + i]];
    x[i] = point.x;
    y[i] = point.y;
  }
  Measures measures;
  long double product = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    const long double length = std::hypot(x[(i + 1) % 3] - x[i], y[(i + 1) % 3] - y[i]);
    measures.longest_edge = std::max(measures.longest_edge, length);
    measures.perimeter += length;
    product *= length;
  }
  const long double left = (x[1] - x[0]) * (y[2] - y[0]);
  const long double right = (y[1] - y[0]) * (x[2] - x[0]);
  measures.twice_area = left - right;
  // A cross product of doubles has three roundings a product and one for the difference: below 4 half ulps of
  // the products, here taken 4 times over.
  const long double error = 0x1p-49L * (std::abs(left) + std::abs(right));
  measures.least_circumradius = product / (2 * (measures.twice_area + error));
  measures.most_circumradius =
      measures.twice_area > error ? product / (2 * (measures.twice_area - error)) : kInfinity;
  return measures;
}

std::vector<Measures> measure_all(std::span<const Point> points, const Triangulation& triangulation) {
  std::vector<Measures> all;
  for (std::size_t t = 0; t < triangulation.triangles.size() / 3; ++t)
    all.push_back(measure(points, triangulation, t));
  return all;
}

struct Interval {
  long double low;
  long double high;
};

// Values between the intervals, from a few quantiles on; the last one lies above all of them.
std::vector<double> values_between(std::vector<Interval> intervals) {
  std::sort(intervals.begin(), intervals.end(), [](const auto& a, const auto& b) { return a.low < b.low; });
  std::vector<double> values;
  for (const double quantile : {0.02, 0.25, 0.5, 0.75, 0.9, 1.0}) {
    const auto start = static_cast<std::size_t>(quantile * static_cast<double>(intervals.size() - 1));
    long double high = 0;
    for (std::size_t i = 0; i < intervals.size(); ++i) {
      high = std::max(high, intervals[i].high);
      if (i < start || !(high < std::numeric_limits<double>::max() / 4)) continue;
      const long double next = i + 1 < intervals.size() ? intervals[i + 1].low : 2 * high;
      if (!(next > high * (1 + 1e-9L))) continue;
      values.push_back(static_cast<double>(std::sqrt(high) * std::sqrt(next)));
      break;
    }
  }
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

class Components {
 public:
  explicit Components(std::size_t size) : parent_(size) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  void join(std::size_t a, std::size_t b) { parent_[root(a)] = root(b); }
  std::size_t root(std::size_t a) {
    while (parent_[a] != a) a = parent_[a] = parent_[parent_[a]];
    return a;
  }

 private:
  std::vector<std::size_t> parent_;
};

bool less(const Point& a, const Point& b) {
  return std::tie(a.x, a.y) < std::tie(b.x, b.y);
}

bool ring_less(const Ring& a, const Ring& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), less);
}

void start_at_least(Ring& ring) {
  std::rotate(ring.begin(), std::min_element(ring.begin(), ring.end(), less), ring.end());
}

}  // namespace

std::string describe(const Options& options) {
  const auto text = [](const std::optional<double>& limit) {
    std::ostringstream out;
    if (limit) out << *limit;
    return limit ? out.str() : "not given";
  };
  return "alpha " + text(options.alpha) + ", max_edge_length " + text(options.max_edge_length) +
         ", max_perimeter " + text(options.max_perimeter);
}

Options scaled(Options options, double scale) {
  if (options.alpha) *options.alpha *= scale;
  if (options.max_edge_length) *options.max_edge_length *= scale;
  if (options.max_perimeter) *options.max_perimeter *= scale;
  return options;
}

ExpectedShape expected_shape(std::span<const Point> points, const Triangulation& triangulation,
                             const Options& options) {
  std::vector<std::size_t> kept;
  long double twice_area = 0;
  for (std::size_t t = 0; t < triangulation.triangles.size() / 3; ++t) {
    const Measures measures = measure(points, triangulation, t);
    const double alpha = options.alpha.value_or(kNoLimit);
    const bool small = alpha == kNoLimit || measures.most_circumradius <= alpha;
    if (!small || measures.longest_edge > options.max_edge_length.value_or(kNoLimit) ||
        measures.perimeter > options.max_perimeter.value_or(kNoLimit)) {
      continue;
    }
    kept.push_back(t);
    twice_area += measures.twice_area;
  }

  std::map<Edge, std::size_t> triangle_at;  // the first kept triangle that has the edge
  Components components(kept.size());
  for (std::size_t k = 0; k < kept.size(); ++k) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = triangulation.triangles[3 * kept[k] + i];
      const std::uint32_t b = triangulation.triangles[3 * kept[k] + (i + 1) % 3];
      components.join(k, triangle_at.emplace(std::minmax(a, b), k).first->second);
    }
  }
  std::set<std::pair<std::uint32_t, std::size_t>>
      vertices;  // with the component, since components may share one
  ExpectedShape expected;
  expected.area = static_cast<double>(twice_area / 2);
  for (std::size_t k = 0; k < kept.size(); ++k) {
    expected.polygons += components.root(k) == k ? 1U : 0U;
    for (std::size_t i = 0; i < 3; ++i) {
      vertices.emplace(triangulation.triangles[3 * kept[k] + i], components.root(k));
    }
  }
  // A closed, connected region with h holes has vertices - edges + triangles = 1 - h, touching rings or not.
  expected.holes = expected.polygons + triangle_at.size() - vertices.size() - kept.size();
  return expected;
}

std::vector<Options> clear_options(std::span<const Point> points, const Triangulation& triangulation) {
  if (triangulation.triangles.empty()) return {kConvexHull};
  std::vector<Interval> radii;
  std::vector<Interval> lengths;
  std::vector<Interval> perimeters;
  for (const Measures& measures : measure_all(points, triangulation)) {
    radii.push_back({measures.least_circumradius, measures.most_circumradius});
    lengths.push_back({measures.longest_edge, measures.longest_edge});
    perimeters.push_back({measures.perimeter, measures.perimeter});
  }
  std::vector<Options> all = {kConvexHull};
  for (const double alpha : values_between(radii)) all.push_back({.alpha = alpha});
  for (const double length : values_between(lengths)) all.push_back({.max_edge_length = length});
  for (const double perimeter : values_between(perimeters)) all.push_back({.max_perimeter = perimeter});
  const std::size_t single = all.size();
  const auto limit = [&](std::size_t i, std::optional<double> Options::*which) {
    return (all[i % single].*which).value_or(kNoLimit);
  };
  for (std::size_t i = 1; i < single; i += 2) {
    all.push_back({.alpha = limit(i, &Options::alpha),
                   .max_edge_length = limit(i + single / 3, &Options::max_edge_length),
                   .max_perimeter = limit(i + 2 * single / 3, &Options::max_perimeter)});
  }
  return all;
}

MultiPolygon core_hull(std::span<const Point> points, const Options& options) {
  return to_coordinates(concave_hull(points, options), points);
}

MultiPolygon canonical(MultiPolygon shape) {
  for (Polygon& polygon : shape) {
    start_at_least(polygon.shell);
    for (Ring& hole : polygon.holes) start_at_least(hole);
    std::sort(polygon.holes.begin(), polygon.holes.end(), ring_less);
  }
  std::sort(shape.begin(), shape.end(),
            [](const Polygon& a, const Polygon& b) { return ring_less(a.shell, b.shell); });
  return shape;
}

bool is_unique(std::span<const Point> points, const Triangulation& triangulation) {
  const std::vector<std::uint32_t>& twins = triangulation.halfedges;
  const auto at = [&](std::size_t half_edge) { return points[triangulation.triangles[half_edge]]; };
  for (std::size_t e = 0; e < twins.size(); ++e) {
    if (twins[e] == kNone) continue;
    const std::size_t first = e - e % 3;
    const std::size_t opposite = twins[e] - twins[e] % 3 + (twins[e] + 2) % 3;
    if (incircle(at(first), at(first + 1), at(first + 2), at(opposite)) == 0) return false;
  }
  return true;
}

double area_tolerance(std::span<const Point> points) {
  const Box box = bounding_box(points);
  const double extent = std::max(box.max.x - box.min.x, box.max.y - box.min.y);
  return points.empty() ? 0 : 1e-12 * extent * extent;
}

Ring convex_corners(std::vector<Point> points) {
  const auto less = [](const Point& a, const Point& b) { return std::tie(a.x, a.y) < std::tie(b.x, b.y); };
  std::sort(points.begin(), points.end(), less);
  Ring chain;
  const auto half = [&](auto begin, auto end) {
    const std::size_t start = chain.size();
    for (auto it = begin; it != end; ++it) {
      while (chain.size() >= start + 2 && !(orient2d(chain[chain.size() - 2], chain.back(), *it) > 0))
        chain.pop_back();
      chain.push_back(*it);
    }
    chain.pop_back();
  };
  half(points.begin(), points.end());
  half(points.rbegin(), points.rend());
  return chain;
}

Ring strict_corners(const Ring& ring) {
  Ring corners;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point& before = ring[(i + ring.size() - 1) % ring.size()];
    if (orient2d(before, ring[i], ring[(i + 1) % ring.size()]) != 0) corners.push_back(ring[i]);
  }
  return corners;
}

}  // namespace polylidar::testing
