#include "tool/shapes/index_shape.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "tool/hull/degrees.hpp"

namespace polylidar::tool {
namespace {

Ring coordinates(const IndexRing& ring, std::span<const Point> points) {
  Ring vertices(ring.size());
  std::transform(ring.begin(), ring.end(), vertices.begin(), [&](std::uint32_t i) { return points[i]; });
  return vertices;
}

}  // namespace

IndexShape polygons_of(const IndexedMultiPolygon& shape) {
  IndexShape polygons(shape.polygon_count());
  std::size_t ring = 0;
  std::uint32_t begin = 0;
  for (std::size_t p = 0; p < polygons.size(); ++p) {
    for (bool is_shell = true; ring < shape.polygon_ends[p]; ++ring, is_shell = false) {
      const std::uint32_t end = shape.ring_ends[ring];
      IndexRing vertices(shape.vertices.begin() + begin, shape.vertices.begin() + end);
      if (is_shell) {
        polygons[p].shell = std::move(vertices);
      } else {
        polygons[p].holes.push_back(std::move(vertices));
      }
      begin = end;
    }
  }
  return polygons;
}

MultiPolygon to_coordinates(const IndexShape& shape, std::span<const Point> points) {
  MultiPolygon polygons;
  for (const IndexPolygon& polygon : shape) {
    polygons.push_back({coordinates(polygon.shell, points), {}});
    for (const IndexRing& hole : polygon.holes) polygons.back().holes.push_back(coordinates(hole, points));
  }
  return polygons;
}

double signed_area(const IndexRing& ring, std::span<const Point> points, const Latitude& latitude) {
  const Ring vertices = coordinates(ring, points);
  return latitude ? signed_area_on_sphere(vertices, *latitude) : polylidar::signed_area(vertices);
}

double area(const IndexPolygon& polygon, std::span<const Point> points, const Latitude& latitude) {
  double area = signed_area(polygon.shell, points, latitude);
  for (const IndexRing& hole : polygon.holes) area += signed_area(hole, points, latitude);
  return area;
}

double area(const IndexShape& shape, std::span<const Point> points, const Latitude& latitude) {
  return area(to_coordinates(shape, points), latitude);
}

double area(const MultiPolygon& shape, const Latitude& latitude) {
  if (!latitude) return polylidar::area(shape);
  double area = 0;
  for (const Polygon& polygon : shape) {
    area += std::abs(signed_area_on_sphere(polygon.shell, *latitude));
    for (const Ring& hole : polygon.holes) area -= std::abs(signed_area_on_sphere(hole, *latitude));
  }
  return area;
}

std::size_t hole_count(const IndexShape& shape) {
  return std::accumulate(
      shape.begin(), shape.end(), std::size_t{0},
      [](std::size_t count, const IndexPolygon& polygon) { return count + polygon.holes.size(); });
}

void drop_small_areas(IndexShape& shape, std::span<const Point> points, double least,
                      const Latitude& latitude) {
  for (IndexPolygon& polygon : shape) {
    std::erase_if(polygon.holes,
                  [&](const IndexRing& hole) { return -signed_area(hole, points, latitude) < least; });
  }
  std::erase_if(shape, [&](const IndexPolygon& polygon) { return area(polygon, points, latitude) < least; });
}

void keep_largest(IndexShape& shape, std::span<const Point> points, std::size_t count,
                  const Latitude& latitude) {
  if (shape.size() <= count) return;
  std::vector<std::pair<double, std::size_t>> areas;  // negative, so that the largest come first
  for (std::size_t p = 0; p < shape.size(); ++p) areas.emplace_back(-area(shape[p], points, latitude), p);
  std::nth_element(areas.begin(), areas.begin() + static_cast<std::ptrdiff_t>(count), areas.end());
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < count; ++i) kept.push_back(areas[i].second);
  std::sort(kept.begin(), kept.end());
  IndexShape largest;
  for (const std::size_t p : kept) largest.push_back(std::move(shape[p]));
  shape = std::move(largest);
}

}  // namespace polylidar::tool
