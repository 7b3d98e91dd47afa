// The whole core on any bytes: whatever they decode to is either refused for a reason or triangulated and
// outlined rightly. libFuzzer calls it with bytes of its own making, replay.cpp with those kept in
// corpus/concave_hull/.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "polylidar/check.hpp"
#include "polylidar/concave_hull.hpp"
#include "polylidar/delaunay.hpp"
#include "tests/both_ways.hpp"
#include "tests/fuzz/fuzz_input.hpp"
#include "tests/hull_oracle.hpp"
#include "tests/point_sets.hpp"

namespace polylidar::fuzz {
namespace {

using testing::canonical;
using testing::convex_corners;
using testing::hole_count;
using testing::strict_corners;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

[[noreturn]] void fail(const Input& input, const std::string& what) {
  const Options& options = input.options;
  std::cerr << "FAILED: " << what << std::hexfloat << "\nlimits (-1: not given) "
            << options.alpha.value_or(-1) << ", " << options.max_edge_length.value_or(-1) << ", "
            << options.max_perimeter.value_or(-1) << ", threads " << options.threads << ", choice "
            << unsigned{input.choice} << ", " << input.points.size() << " points:\n";
  for (const Point& point : input.points) std::cerr << '{' << point.x << ", " << point.y << "},\n";
  std::abort();
}

void require(const Input& input, bool holds, const char* what) {
  if (!holds) fail(input, what);
}

void require_no_fault(const Input& input, const std::string& fault, const char* of) {
  if (!fault.empty()) fail(input, std::string(of) + ": " + fault);
}

bool points_are_supported(std::span<const Point> points) {
  for (const Point& point : points) {
    if (!std::isfinite(point.x) || !std::isfinite(point.y)) return false;
  }
  const auto range = testing::exponents(points);
  return !range || range->greatest - range->least <= testing::kLargestSpan;
}

bool options_are_supported(const Options& options) {
  return options.alpha.value_or(0) >= 0 && options.max_edge_length.value_or(0) >= 0 &&
         options.max_perimeter.value_or(0) >= 0 && options.threads >= 1;
}

// Empty when it was refused, which must be for the reason given.
template <typename Call>
auto refused_or(const Input& input, bool supported, const char* what, Call call)
    -> std::optional<decltype(call())> {
  try {
    auto result = call();
    if (!supported) fail(input, std::string(what) + ": accepted");
    return result;
  } catch (const std::invalid_argument& error) {
    if (supported) fail(input, std::string(what) + ": refused: " + error.what());
    return std::nullopt;
  }
}

IndexedMultiPolygon checked_hull(const Input& input, const Options& options, const char* what) {
  IndexedMultiPolygon shape = concave_hull(input.points, options);
  require_no_fault(input, check_polygon(input.points, shape), what);
  return shape;
}

// An extractor that has been used, successfully or not, gives what a new one gives, with any number of
// threads.
void check_reuse(const Input& input, const IndexedMultiPolygon& shape) {
  Options one_thread = input.options;
  one_thread.threads = 1;
  Extractor extractor;
  extractor.extract(std::span(input.points).first(input.points.size() / 2));
  require(input, extractor.extract(input.points, input.options) == shape, "an extractor's second shape");
  try {
    const std::vector<Point> not_finite = {{0, 0}, {kInfinity, 0}};
    extractor.extract(not_finite);
    fail(input, "infinity was accepted");
  } catch (const std::invalid_argument&) {
    require(input, extractor.extract(input.points, one_thread) == shape,
            "an extractor's shape after an error");
  }
}

// Without limits every point of the convex hull's boundary is a vertex, so ties decide nothing.
void check_convex_hull(const Input& input, std::span<const Point> in_range) {
  const IndexedMultiPolygon shape = checked_hull(input, testing::kConvexHull, "convex hull");
  require(input, shape.polygon_count() <= 1 && shape.ring_ends.size() == shape.polygon_count(),
          "the convex hull is one ring");
  std::vector<Point> reversed(in_range.rbegin(), in_range.rend());
  const MultiPolygon hull = to_coordinates(shape, in_range);
  require(
      input,
      canonical(to_coordinates(concave_hull(reversed, testing::kConvexHull), reversed)) == canonical(hull),
      "the convex hull of the points in reverse");
  if (hull.empty()) return;
  require(input,
          canonical({{strict_corners(hull[0].shell), {}}}) == canonical({{convex_corners(reversed), {}}}),
          "the convex hull has the corners of the monotone chain");
}

// The interior may be left out for as few points as there are.
void check_without_interior(const Input& input, std::span<const Point> points, const Options& options) {
  if (points.empty() || (!options.alpha && !options.max_edge_length && !options.max_perimeter)) return;
  static testing::BothWays ways;
  const std::vector<Point> copy(points.begin(), points.end());
  if (ways.go(copy, options).way == Way::kInteriorLeftOut) {
    require(input, ways.part() == ways.whole(copy, options), "the shape without the interior");
  }
  const double limit =
      std::min({options.alpha.value_or(kInfinity), options.max_edge_length.value_or(kInfinity),
                options.max_perimeter.value_or(kInfinity)});
  const detail::SizeField field{.limit4 = {limit * limit * limit * limit},
                                .spike_share = 1.0 / (1 + input.choice % 8),
                                .least_region = input.choice % 16U,
                                .wide_square = 0.25 * (1 + input.choice % 32),
                                .wide_radius = 0.9 * limit};
  const bool fill_single = input.choice % 2 == 0;
  if (ways.go(copy, field, fill_single, options.threads).way == Way::kInteriorLeftOut) {
    const IndexedMultiPolygon part = ways.part();
    require(input, part == ways.whole(copy, field, fill_single), "the shape by sizes without the interior");
  }
}

// A limit that no triangle is near: the shape is that of the kept triangles.
void check_clear_limits(const Input& input, std::span<const Point> in_range,
                        const Triangulation& triangulation) {
  const std::vector<Options> all = testing::clear_options(in_range, triangulation);
  const Options options = all[input.choice % all.size()];
  const testing::ExpectedShape expected = testing::expected_shape(in_range, triangulation, options);
  const IndexedMultiPolygon indexed = concave_hull(in_range, options);
  require_no_fault(input, check_polygon(in_range, indexed), "polygons of clear limits");
  check_without_interior(input, in_range, options);
  const MultiPolygon shape = to_coordinates(indexed, in_range);
  require(input, shape.size() == expected.polygons, "clear limits: as many polygons as components");
  require(input, hole_count(shape) == expected.holes, "clear limits: as many holes as Euler's formula says");
  require(input, std::abs(area(shape) - expected.area) <= testing::area_tolerance(in_range),
          "clear limits: the same area");

  if (!testing::is_unique(in_range, triangulation)) return;
  const std::vector<Point> reversed(in_range.rbegin(), in_range.rend());
  require(input, canonical(to_coordinates(concave_hull(reversed, options), reversed)) == canonical(shape),
          "clear limits: the shape of the points in reverse");
}

// Scaling by a power of two changes no index, for limits near triangles too.
void check_scaled(const Input& input, const IndexedMultiPolygon& shape, std::span<const Point> in_range,
                  int exponent) {
  Options options = input.options;
  for (std::optional<double>* limit : {&options.alpha, &options.max_edge_length, &options.max_perimeter}) {
    if (!*limit) continue;
    const double scaled = std::ldexp(**limit, exponent);
    if (std::ldexp(scaled, -exponent) != **limit) return;  // it left the range of doubles
    *limit = scaled;
  }
  require(input, concave_hull(in_range, options) == shape, "the shape of the scaled points");
}

void check_everything(const Input& input) {
  const bool points_supported = points_are_supported(input.points);
  const bool supported = points_supported && options_are_supported(input.options);
  const auto triangulation = refused_or(input, points_supported, "the triangulation of these points",
                                        [&] { return delaunay(input.points); });
  const auto shape = refused_or(input, supported, "the hull of these points with these options",
                                [&] { return concave_hull(input.points, input.options); });
  if (!triangulation) return;

  const auto range = testing::exponents(input.points);
  const int exponent = range ? 149 - range->greatest : 0;
  const std::vector<Point> in_range = testing::scaled(input.points, exponent, exponent);
  require_no_fault(input, check_triangulation(in_range, *triangulation), "triangulation");
  check_convex_hull(input, in_range);
  check_clear_limits(input, in_range, *triangulation);
  check_without_interior(input, in_range, testing::kConvexHull);
  if (!shape) return;
  check_without_interior(input, input.points, input.options);
  require_no_fault(input, check_polygon(input.points, *shape), "polygons");
  check_reuse(input, *shape);
  check_scaled(input, *shape, in_range, exponent);
}

}  // namespace
}  // namespace polylidar::fuzz

// NOLINTNEXTLINE(readability-identifier-naming): the name that libFuzzer calls
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  polylidar::fuzz::check_everything(polylidar::fuzz::decode({data, size}));
  return 0;
}
