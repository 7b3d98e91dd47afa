#include "benchmarks/metrics/topology.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "benchmarks/metrics/geos_session.hpp"
#include "benchmarks/metrics/shape_measures.hpp"

namespace hullbench::metrics {
namespace {

/// A hole as a polygon of its own.
struct Hole {
  GeosSession::Geometry geometry;
  double area;
};

std::vector<Hole> holes_of(const GeosSession& geos, const MultiPolygon& shape) {
  std::vector<Hole> holes;
  for (const Polygon& polygon : shape) {
    for (const Ring& ring : polygon.holes) {
      holes.push_back({geos.make_polygon({ring, {}}), std::abs(polylidar::signed_area(ring))});
    }
  }
  return holes;
}

/// Finds the holes whose boxes meet that of another one.
class HoleIndex {
 public:
  HoleIndex(const GeosSession& geos, std::vector<Hole>& holes)
      : geos_(geos.context()), tree_(GEOSSTRtree_create_r(geos_, 10)) {
    if (tree_ == nullptr) geos.fail("making an index");
    for (Hole& hole : holes) GEOSSTRtree_insert_r(geos_, tree_, hole.geometry.get(), &hole);
  }
  ~HoleIndex() { GEOSSTRtree_destroy_r(geos_, tree_); }
  HoleIndex(const HoleIndex&) = delete;
  HoleIndex& operator=(const HoleIndex&) = delete;

  std::vector<const Hole*> near(const Hole& hole) const {
    std::vector<const Hole*> found;
    const auto collect = [](void* item, void* place) {
      static_cast<std::vector<const Hole*>*>(place)->push_back(static_cast<const Hole*>(item));
    };
    GEOSSTRtree_query_r(geos_, tree_, hole.geometry.get(), collect, &found);
    return found;
  }

 private:
  GEOSContextHandle_t geos_;
  GEOSSTRtree* tree_;
};

double iou(const GeosSession& geos, const Hole& a, const Hole& b) {
  // No more than the smaller one can be shared, which spares most of the overlays.
  if (std::min(a.area, b.area) <= kHoleIou * std::max(a.area, b.area)) return 0;
  const double common = geos.common_area(a.geometry, b.geometry);
  return common / (a.area + b.area - common);
}

struct Pair {
  double iou;
  const Hole* in_result;
  const Hole* in_truth;
};

std::size_t count_one_to_one(std::vector<Pair> pairs) {
  std::ranges::stable_sort(pairs, [](const Pair& a, const Pair& b) { return a.iou > b.iou; });
  std::set<const Hole*> taken;
  for (const Pair& pair : pairs) {
    if (taken.contains(pair.in_result) || taken.contains(pair.in_truth)) continue;
    taken.insert({pair.in_result, pair.in_truth});
  }
  return taken.size() / 2;
}

std::size_t count_matches(const GeosSession& geos, const std::vector<Hole>& result,
                          std::vector<Hole>& truth) {
  const HoleIndex index(geos, truth);
  std::vector<Pair> pairs;
  for (const Hole& hole : result) {
    for (const Hole* candidate : index.near(hole)) {
      const double agreement = iou(geos, hole, *candidate);
      if (agreement > kHoleIou) pairs.push_back({agreement, &hole, candidate});
    }
  }
  return count_one_to_one(std::move(pairs));
}

}  // namespace

ShapeCounts count_shape(const MultiPolygon& result, const MultiPolygon& truth, double h) {
  const auto difference = [](std::size_t a, std::size_t b) {
    return static_cast<std::int64_t>(a) - static_cast<std::int64_t>(b);
  };
  ShapeCounts counts;
  counts.polygons_error = difference(result.size(), truth.size());
  counts.holes_error = difference(count_holes(result), count_holes(truth));
  for_each_ring(result, [&](const Ring& ring) {
    if (std::abs(polylidar::signed_area(ring)) < kSliverAreaInH2 * h * h) ++counts.slivers;
  });
  return counts;
}

HoleScores match_holes(const MultiPolygon& result, const MultiPolygon& truth) {
  const std::size_t in_result = count_holes(result);
  const std::size_t in_truth = count_holes(truth);
  if (in_result == 0 && in_truth == 0) return {};
  if (in_result == 0 || in_truth == 0) return {0.0, 0.0, 0.0};
  const GeosSession geos;
  const std::vector<Hole> result_holes = holes_of(geos, result);
  std::vector<Hole> truth_holes = holes_of(geos, truth);
  const auto matched = static_cast<double>(count_matches(geos, result_holes, truth_holes));
  return {matched / static_cast<double>(in_result), matched / static_cast<double>(in_truth),
          2 * matched / static_cast<double>(in_result + in_truth)};
}

}  // namespace hullbench::metrics
