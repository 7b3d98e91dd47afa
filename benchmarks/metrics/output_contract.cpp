#include "benchmarks/metrics/output_contract.hpp"

#include <algorithm>
#include <cmath>

#include "benchmarks/metrics/segment_tree.hpp"
#include "benchmarks/metrics/shape_measures.hpp"
#include "polylidar/point_locator.hpp"

namespace hullbench::metrics {

using polylidar::PointLocator;

namespace {

/// The square of a distance below this is no number of full precision, or 0.
constexpr double kLeastDistance = 1e-150;

/// From bottom to top, as the locator has its bands.
bool is_before(const Point& a, const Point& b) {
  return a.y < b.y || (a.y == b.y && a.x < b.x);
}

std::optional<double> share(std::size_t part, std::size_t whole) {
  if (whole == 0) return std::nullopt;
  return static_cast<double>(part) / static_cast<double>(whole);
}

bool is_oriented(const MultiPolygon& shape) {
  return std::ranges::all_of(shape, [](const Polygon& polygon) {
    return polylidar::signed_area(polygon.shell) > 0 &&
           std::ranges::all_of(polygon.holes,
                               [](const Ring& hole) { return polylidar::signed_area(hole) < 0; });
  });
}

/// Of all vertices, the largest coordinate without its sign; 0 of an empty shape.
double largest_coordinate(const MultiPolygon& shape) {
  double largest = 0;
  for_each_ring(shape, [&](const Ring& ring) {
    for (const Point& vertex : ring) largest = std::max({largest, std::abs(vertex.x), std::abs(vertex.y)});
  });
  return largest;
}

std::size_t count_covered(const std::vector<Point>& points, const MultiPolygon& shape) {
  const PointLocator locator(shape);
  const SegmentTree edges(shape);
  const double rounding = kRoundingOfText * largest_coordinate(shape);
  // Told to look no farther than twice that, the tree gives up on most points outside at once.
  const auto is_on_edge = [&](const Point& point) {
    return rounding > kLeastDistance && edges.distance(point, 2 * rounding) <= rounding;
  };
  const auto is_covered = [&](const Point& point) { return locator.contains(point) || is_on_edge(point); };
  return static_cast<std::size_t>(std::ranges::count_if(points, is_covered));
}

}  // namespace

InputPoints::InputPoints(std::span<const Point> points) : sorted_(points.begin(), points.end()) {
  std::ranges::sort(sorted_, is_before);
}

ContractScores InputPoints::score(const MultiPolygon& result) const {
  ContractScores scores;
  if (has_finite_coordinates(result))
    scores.points_covered = share(count_covered(sorted_, result), sorted_.size());
  std::size_t from_input = 0;
  for_each_ring(result, [&](const Ring& ring) {
    from_input += static_cast<std::size_t>(std::ranges::count_if(ring, [&](const Point& vertex) {
      const auto found = std::lower_bound(sorted_.begin(), sorted_.end(), vertex, is_before);
      return found != sorted_.end() && *found == vertex;
    }));
  });
  scores.vertices_from_input = share(from_input, polylidar::vertex_count(result));
  if (!result.empty()) scores.oriented = is_oriented(result);
  return scores;
}

}  // namespace hullbench::metrics
