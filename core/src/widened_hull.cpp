#include "polylidar/widened_hull.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "coordinate_range.hpp"
#include "options_check.hpp"
#include "polylidar/point_locator.hpp"

namespace polylidar {

namespace {

/// A factor from `least` on for which `holds`, to a thousandth: the least one if it stays true once it is.
template <class Holds>
double least_factor(double least, const Holds& holds) {
  if (holds(least)) return least;
  double low = least;
  double high = 2 * least;
  while (!holds(high)) {
    if (high >= 0x1p60) return kNoLimit;
    low = high;
    high *= 2;
  }
  while (high > low * 1.001) {
    const double middle = std::sqrt(low) * std::sqrt(high);
    (holds(middle) ? high : low) = middle;
  }
  return high;
}

/// The points as the predicates can handle them, multiplied by a power of two if need be: into `scaled` then.
std::span<const Point> for_predicates(std::span<const Point> points, std::vector<Point>& scaled) {
  detail::RangeOfBlocks range;
  range.add(points);
  const int exponent = points.empty() ? 0 : range.range().scale_exponent;
  if (exponent == 0) return points;
  scaled.reserve(points.size());
  for (const Point& p : points) scaled.push_back({std::ldexp(p.x, exponent), std::ldexp(p.y, exponent)});
  return scaled;
}

/// The rings of polygon `polygon`, shell first, as [first, last).
std::pair<std::size_t, std::size_t> rings_of(const IndexedMultiPolygon& shape, std::size_t polygon) {
  return {polygon == 0 ? 0 : shape.polygon_ends[polygon - 1], shape.polygon_ends[polygon]};
}

/// The vertices of a ring.
std::span<const std::uint32_t> ring_of(const IndexedMultiPolygon& shape, std::size_t ring) {
  const std::size_t begin = ring == 0 ? 0 : shape.ring_ends[ring - 1];
  return std::span(shape.vertices).subspan(begin, shape.ring_ends[ring] - begin);
}

/// Which polygon a boundary edge, in its direction, belongs to.
class PolygonOfEdge {
 public:
  explicit PolygonOfEdge(const IndexedMultiPolygon& shape) {
    for (std::size_t polygon = 0; polygon < shape.polygon_count(); ++polygon) {
      const auto [first, last] = rings_of(shape, polygon);
      for (std::size_t r = first; r < last; ++r) {
        const std::span<const std::uint32_t> ring = ring_of(shape, r);
        for (std::size_t i = 0; i < ring.size(); ++i) {
          polygons_[key(ring[i], ring[(i + 1) % ring.size()])] = polygon;
        }
      }
    }
  }

  std::optional<std::size_t> find(std::uint32_t from, std::uint32_t to) const {
    const auto found = polygons_.find(key(from, to));
    return found == polygons_.end() ? std::nullopt : std::optional(found->second);
  }

 private:
  static std::uint64_t key(std::uint32_t from, std::uint32_t to) { return std::uint64_t{from} << 32U | to; }

  std::unordered_map<std::uint64_t, std::size_t> polygons_;
};

/// `shape` without all its other polygons.
IndexedMultiPolygon only(const IndexedMultiPolygon& shape, std::size_t polygon) {
  IndexedMultiPolygon one;
  const auto [first, last] = rings_of(shape, polygon);
  for (std::size_t r = first; r < last; ++r) {
    const std::span<const std::uint32_t> ring = ring_of(shape, r);
    one.vertices.insert(one.vertices.end(), ring.begin(), ring.end());
    one.ring_ends.push_back(static_cast<std::uint32_t>(one.vertices.size()));
  }
  one.polygon_ends = {static_cast<std::uint32_t>(one.ring_ends.size())};
  return one;
}

/// Points, triangulated once, and their shapes under wider and wider limits.
class Widening {
 public:
  Widening(Extractor& extractor, std::span<const Point> points, const Options& options,
           const std::function<void()>& on_step)
      : extractor_(extractor), options_(options), on_step_(on_step) {
    detail::checked_limits(options_);  // before the points are triangulated in vain
    extractor_.triangulate(points, options_.threads);
    points_ = for_predicates(points, scaled_);
  }

  /// Valid until that of another factor is asked for.
  const IndexedMultiPolygon& shape(double factor) {
    if (shape_ && factor == factor_) return *shape_;
    if (on_step_) on_step_();
    extractor_.extract_regions(detail::widened(options_, factor));
    factor_ = factor;
    shape_ = &extractor_.extract_polygons();
    return *shape_;
  }

  /// The least factor with every point covered.
  double cover() {
    if (!extractor_.has_triangles()) return 1;
    std::vector<std::uint32_t> all(points_.size());
    std::iota(all.begin(), all.end(), 0U);
    std::vector<std::uint32_t> outside = all;
    const double factor = least_factor(1, [&](double wider) {
      std::vector<std::uint32_t> left = outside_of(shape(wider), outside);
      if (left.empty()) return true;
      outside = std::move(left);  // who is covered stays covered
      return false;
    });
    // But a small region may be dropped beside one that has grown.
    if (factor == 1 || outside_of(shape(factor), all).empty()) return factor;
    return least_factor(factor, [&](double wider) { return outside_of(shape(wider), all).empty(); });
  }

  /// The least factor from `least` on with all polygons that `least` gives in one.
  double one(double least) {
    const IndexedMultiPolygon parts = shape(least);
    if (parts.polygon_count() < 2) return least;
    return least_factor(least,
                        [&](double factor) { return polygon_with_all(parts, shape(factor)).has_value(); });
  }

  /// The polygon of `wider` that has all `parts`, if there is one. Each part is in one of them, or gone.
  std::optional<std::size_t> polygon_with_all(const IndexedMultiPolygon& parts,
                                              const IndexedMultiPolygon& wider) const {
    const PointLocator locator(to_coordinates(wider, points_));
    const PolygonOfEdge polygon_of_edge(wider);
    std::optional<std::size_t> all;
    for (std::size_t part = 0; part < parts.polygon_count(); ++part) {
      // An edge of the part is an edge of that polygon or inside it. A vertex would not do: two may meet
      // there.
      const std::span<const std::uint32_t> shell = ring_of(parts, rings_of(parts, part).first);
      std::optional<std::size_t> polygon = polygon_of_edge.find(shell[0], shell[1]);
      if (!polygon) {
        const Point& a = points_[shell[0]];
        const Point& b = points_[shell[1]];
        polygon = locator.polygon_of({a.x / 2 + b.x / 2, a.y / 2 + b.y / 2});
      }
      if (!polygon || (all && *all != *polygon)) return {};
      all = polygon;
    }
    return all;
  }

 private:
  /// Those of `some` points that the shape does not cover.
  std::vector<std::uint32_t> outside_of(const IndexedMultiPolygon& shape,
                                        const std::vector<std::uint32_t>& some) const {
    const PointLocator locator(to_coordinates(shape, points_));
    std::vector<std::uint32_t> left;
    std::copy_if(some.begin(), some.end(), std::back_inserter(left),
                 [&](std::uint32_t i) { return !locator.contains(points_[i]); });
    return left;
  }

  Extractor& extractor_;
  std::vector<Point> scaled_;      ///< empty unless they differ from the caller's
  std::span<const Point> points_;  ///< as the predicates can handle them
  Options options_;
  const std::function<void()>& on_step_;
  double factor_ = 0;                           ///< of shape_
  const IndexedMultiPolygon* shape_ = nullptr;  ///< the extractor's; none yet
};

}  // namespace

WidenedHull widened_hull(Extractor& extractor, std::span<const Point> points, const Options& options,
                         const Wanted& wanted, const std::function<void()>& on_step) {
  Widening widening(extractor, points, options, on_step);
  double covering = wanted.cover ? widening.cover() : 1;
  // Where no triangle is kept, each point is a part.
  if (wanted.one && !wanted.cover && widening.shape(1).polygon_count() == 0) covering = widening.cover();
  const double factor = wanted.one ? widening.one(covering) : covering;
  const IndexedMultiPolygon parts = wanted.one ? widening.shape(covering) : IndexedMultiPolygon();
  const IndexedMultiPolygon& shape = widening.shape(factor);
  std::optional<std::size_t> with_all;
  if (wanted.one && shape.polygon_count() > 1) with_all = widening.polygon_with_all(parts, shape);
  return {with_all ? only(shape, *with_all) : shape, detail::widened(options, factor)};
}

}  // namespace polylidar
