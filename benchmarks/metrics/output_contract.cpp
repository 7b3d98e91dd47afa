#include "benchmarks/metrics/output_contract.hpp"

#include <algorithm>

#include "benchmarks/metrics/shape_measures.hpp"
#include "datasets/point_locator.hpp"

namespace hullbench::metrics {
namespace {

using polylidar::MultiPolygon;
using polylidar::Point;
using polylidar::Polygon;
using polylidar::Ring;

/// From bottom to top, as the locator has its bands.
bool is_before(const Point& a, const Point& b) {
  return a.y < b.y || (a.y == b.y && a.x < b.x);
}

std::optional<double> share(std::size_t part, std::size_t whole) {
  if (whole == 0) return std::nullopt;
  return static_cast<double>(part) / static_cast<double>(whole);
}

bool is_oriented(const MultiPolygon& shape) {
  return std::all_of(shape.begin(), shape.end(), [](const Polygon& polygon) {
    return polylidar::signed_area(polygon.shell) > 0 &&
           std::all_of(polygon.holes.begin(), polygon.holes.end(),
                       [](const Ring& hole) { return polylidar::signed_area(hole) < 0; });
  });
}

std::size_t count_covered(const std::vector<Point>& points, const MultiPolygon& shape) {
  const PointLocator locator(shape);
  return static_cast<std::size_t>(std::count_if(points.begin(), points.end(),
                                                [&](const Point& point) { return locator.contains(point); }));
}

}  // namespace

InputPoints::InputPoints(std::span<const Point> points) : sorted_(points.begin(), points.end()) {
  std::sort(sorted_.begin(), sorted_.end(), is_before);
}

ContractScores InputPoints::score(const MultiPolygon& result) const {
  ContractScores scores;
  if (has_finite_coordinates(result))
    scores.points_covered = share(count_covered(sorted_, result), sorted_.size());
  std::size_t from_input = 0;
  for_each_ring(result, [&](const Ring& ring) {
    from_input += static_cast<std::size_t>(std::count_if(ring.begin(), ring.end(), [&](const Point& vertex) {
      const auto found = std::lower_bound(sorted_.begin(), sorted_.end(), vertex, is_before);
      return found != sorted_.end() && *found == vertex;
    }));
  });
  scores.vertices_from_input = share(from_input, polylidar::vertex_count(result));
  if (!result.empty()) scores.oriented = is_oriented(result);
  return scores;
}

}  // namespace hullbench::metrics
