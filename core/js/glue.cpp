// The core as a WebAssembly module. What goes in and out is numbers and addresses, which src/module.js knows.
//
// A throw unwinds nothing here: it ends the call in JavaScript with the exception's sentence. JavaScript then
// forgets the whole module's memory, so that no object that was left half made is used again.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <limits>
#include <new>
#include <optional>
#include <typeinfo>
#include <vector>

#include "polylidar/concave_hull.hpp"
#include "polylidar/widened_hull.hpp"

/// Throws in JavaScript an error that says the `size` bytes of UTF-8 at `message`.
extern "C" [[noreturn, clang::import_module("polylidar"), clang::import_name("fail")]] void fail(
    const char* message, std::size_t size);

namespace {

using polylidar::Options;
using polylidar::Point;

[[noreturn]] void fail_for_memory() {
  constexpr char kMessage[] = "there is not enough memory: a WebAssembly module has 4 GB at most";
  fail(kMessage, sizeof kMessage - 1);
}

void* allocate(std::size_t bytes, std::size_t alignment) {
  // A multiple of the alignment, as aligned_alloc wants it, and not 0, for which it may give no address.
  bytes = bytes == 0 ? alignment : (bytes + alignment - 1) & ~(alignment - 1);
  void* const memory = std::aligned_alloc(alignment, bytes);
  if (memory == nullptr) fail_for_memory();
  return memory;
}

}  // namespace

// What the compiler and the standard library call; they know them by these names.
extern "C" {
void* __cxa_allocate_exception(std::size_t size) noexcept {
  return allocate(size, alignof(std::max_align_t));
}
[[noreturn]] void __cxa_throw(void* exception, std::type_info* /*type*/, void (* /*destroy*/)(void*)) {
  // The core and the standard library throw nothing but what begins with a std::exception.
  const char* const message = static_cast<std::exception*>(exception)->what();
  fail(message, std::strlen(message));
}
}

// The library's own give null where there is no memory, as it is built without exceptions.
void* operator new(std::size_t size) {
  return allocate(size, alignof(std::max_align_t));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocate(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::align_val_t /*alignment*/) noexcept {
  std::free(memory);
}

namespace {

/// The last result, hull after hull in one multipolygon.
struct Result {
  polylidar::IndexedMultiPolygon shape;
  /// hull h is polygons[hull_ends[h - 1] .. hull_ends[h])
  std::vector<std::uint32_t> hull_ends;
  std::optional<polylidar::ChosenSizes> sizes;

  void clear() {
    shape.clear();
    hull_ends.clear();
    sizes.reset();
  }

  std::array<const std::vector<std::uint32_t>*, 4> arrays() const {
    return {&shape.vertices, &shape.ring_ends, &shape.polygon_ends, &hull_ends};
  }

  void add(const polylidar::IndexedMultiPolygon& hull) {
    const auto vertices = static_cast<std::uint32_t>(shape.vertices.size());
    const auto rings = static_cast<std::uint32_t>(shape.ring_ends.size());
    shape.vertices.insert(shape.vertices.end(), hull.vertices.begin(), hull.vertices.end());
    for (const std::uint32_t end : hull.ring_ends) shape.ring_ends.push_back(vertices + end);
    for (const std::uint32_t end : hull.polygon_ends) shape.polygon_ends.push_back(rings + end);
    hull_ends.push_back(static_cast<std::uint32_t>(shape.polygon_ends.size()));
  }
};

std::vector<Point> points;
std::vector<std::int32_t> labels;
polylidar::Extractor extractor;
Result result;

/// Bit i of `given` says whether the i-th of alpha, maxEdgeLength, maxPerimeter and fillSingleTriangles was,
/// and the next two what is wanted.
Options options_of(std::uint32_t given, double detail, double alpha, double max_edge_length,
                   double max_perimeter, bool fill_single_triangles) {
  Options options;
  options.detail = detail;
  if ((given & 1U) != 0) options.alpha = alpha;
  if ((given & 2U) != 0) options.max_edge_length = max_edge_length;
  if ((given & 4U) != 0) options.max_perimeter = max_perimeter;
  if ((given & 8U) != 0) options.fill_single_triangles = fill_single_triangles;
  return options;
}

polylidar::Wanted wanted_of(std::uint32_t given) {
  return {.cover = (given & 16U) != 0, .one = (given & 32U) != 0};
}

/// How many points are vertices of each polygon's triangles, inside it or on its rings: V of Euler's formula
/// V - E + T = 1 - holes, where 3 T = 2 E - (edges of the rings).
std::vector<std::size_t> count_points(const polylidar::IndexedMultiPolygon& shape,
                                      const std::vector<std::size_t>& triangles) {
  std::vector<std::size_t> counts;
  std::size_t ring = 0;
  std::size_t vertex = 0;
  for (std::size_t p = 0; p < shape.polygon_count(); ++p) {
    const std::size_t holes = shape.polygon_ends[p] - ring - 1;
    ring = shape.polygon_ends[p];
    const std::size_t edges = shape.ring_ends[ring - 1] - vertex;
    vertex = shape.ring_ends[ring - 1];
    counts.push_back((triangles[p] + edges) / 2 + 1 - holes);
  }
  return counts;
}

/// The polygon of the triangulated points' hull by `options` that holds `wanted` points, if there is one.
std::optional<std::size_t> polygon_with(std::size_t wanted, const Options& options) {
  extractor.extract_regions(options);
  const auto& shape = extractor.extract_polygons();
  const std::vector<std::size_t> counts = count_points(shape, extractor.count_triangles());
  for (std::size_t p = 0; p < counts.size(); ++p) {
    if (counts[p] == wanted) return p;
  }
  return {};
}

/// The shell of polygon `p` of the extractor's shape, as a polygon without holes.
polylidar::IndexedMultiPolygon shell_of(std::size_t p) {
  const polylidar::IndexedMultiPolygon& shape = extractor.extract_polygons();
  const std::uint32_t ring = p == 0 ? 0 : shape.polygon_ends[p - 1];
  const std::uint32_t begin = ring == 0 ? 0 : shape.ring_ends[ring - 1];
  const std::uint32_t end = shape.ring_ends[ring];
  return {{shape.vertices.begin() + begin, shape.vertices.begin() + end}, {end - begin}, {1}};
}

}  // namespace

extern "C" {

/// Where to write `count` points, as pairs of doubles.
[[clang::export_name("reserve_points")]] Point* reserve_points(std::size_t count) {
  // No array of the core's has more than 127 bytes a point: the size of none exceeds 32 bits.
  constexpr std::size_t kMostPoints = std::size_t{1} << 25U;
  if (count > kMostPoints) fail_for_memory();
  points.resize(count);
  return points.data();
}

/// Where to write `count` labels, one a point.
[[clang::export_name("reserve_labels")]] std::int32_t* reserve_labels(std::size_t count) {
  labels.resize(count);
  return labels.data();
}

/// The hull of the points.
[[clang::export_name("concave_hull")]] void concave_hull(std::uint32_t given, double detail, double alpha,
                                                         double max_edge_length, double max_perimeter,
                                                         bool fill_single_triangles) {
  result.clear();
  const Options options =
      options_of(given, detail, alpha, max_edge_length, max_perimeter, fill_single_triangles);
  const polylidar::Wanted wanted = wanted_of(given);
  result.add(wanted == polylidar::Wanted() ? extractor.extract(points, options)
                                           : widened_hull(extractor, points, options, wanted).shape);
  result.sizes = extractor.chosen_sizes();
}

/// The hulls of the points by their labels, in ascending order.
[[clang::export_name("concave_hulls")]] void concave_hulls(std::uint32_t given, double detail, double alpha,
                                                           double max_edge_length, double max_perimeter,
                                                           bool fill_single_triangles) {
  result.clear();
  const std::vector<std::int64_t> wide(labels.begin(), labels.end());
  for (const auto& [label, shape] : polylidar::concave_hulls(
           points, wide,
           options_of(given, detail, alpha, max_edge_length, max_perimeter, fill_single_triangles),
           wanted_of(given))) {
    result.add(shape);
  }
}

/// One ring round all points: the shell of the hull by the smallest limit of a sequence by which one polygon
/// has all points inside or on it. The limits are those of the details 2^(-k/2) `detail`, k = 0, 1 ...; or
/// longest edges of 2^(k/2) `length_threshold`, if that is more than twice the median size by `detail`. A
/// triangle across a bay has a size of half the bay's width or more: so up to there the sizes fill what is
/// narrower. A larger limit keeps more triangles, and one polygon that has all points keeps them: so k can be
/// found by halving. Empty where there is no triangle.
[[clang::export_name("one_ring")]] void one_ring(double detail, double length_threshold) {
  constexpr int kSteps = 60;
  result.clear();
  extractor.triangulate(points);
  if (!extractor.has_triangles()) return;
  const Options convex{.alpha = polylidar::kNoLimit};
  extractor.extract_regions(convex);
  const std::size_t all = count_points(extractor.extract_polygons(), extractor.count_triangles())[0];

  bool is_by_length = false;
  if (length_threshold > 0) {
    extractor.extract_regions({.detail = detail});
    is_by_length = length_threshold > 2 * extractor.chosen_sizes()->median;
  }
  const auto polygon = [&](int step) {
    Options options{.detail = detail * std::exp2(-0.5 * step)};
    if (is_by_length) options.max_edge_length = length_threshold * std::exp2(0.5 * step);
    return polygon_with(all, options);
  };
  std::optional<std::size_t> found = polygon(0);
  if (!found) {
    int fine = 0;
    int coarse = kSteps;
    while (coarse - fine > 1) {
      const int middle = (fine + coarse) / 2;
      (polygon(middle) ? coarse : fine) = middle;
    }
    found = coarse < kSteps ? polygon(coarse) : polygon_with(all, convex);
  }
  result.add(shell_of(*found));
}

/// The least, median and largest of the chosen sizes; NaN where a limit was given or there is no triangle.
[[clang::export_name("chosen_size")]] double chosen_size(std::uint32_t which) {
  if (!result.sizes) return std::numeric_limits<double>::quiet_NaN();
  return which == 0 ? result.sizes->least : which == 1 ? result.sizes->median : result.sizes->most;
}

/// The result's arrays by number, and their lengths: vertices, ring ends, polygon ends, hull ends.
[[clang::export_name("result_array")]] const std::uint32_t* result_array(std::uint32_t which) {
  return result.arrays()[which]->data();
}
[[clang::export_name("result_length")]] std::size_t result_length(std::uint32_t which) {
  return result.arrays()[which]->size();
}
}
