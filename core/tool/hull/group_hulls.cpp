#include "tool/hull/group_hulls.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <limits>
#include <mutex>
#include <numeric>
#include <thread>
#include <unordered_map>
#include <utility>

#include "polylidar/point_locator.hpp"
#include "tool/shapes/simplify.hpp"

namespace polylidar::tool {
namespace {

// Below this a thread's start costs more than it gives (polylidar::Options).
constexpr std::size_t kWorthThreads = 10000;

/// `options` with limits wider by `factor`; those of the convex hull when it is infinite.
Options widened(Options options, double factor) {
  const bool is_chosen = !options.alpha && !options.max_edge_length && !options.max_perimeter;
  if (std::isinf(factor)) {
    options.alpha = kNoLimit;
    options.max_edge_length = options.max_perimeter = std::nullopt;
    return options;
  }
  if (is_chosen) options.detail /= factor;
  for (std::optional<double>* limit : {&options.alpha, &options.max_edge_length, &options.max_perimeter}) {
    if (*limit) **limit *= factor;
  }
  return options;
}

/// The least factor from `least` on for which `holds`, which stays true once it is: to a thousandth.
template <class Holds>
double least_factor(double least, const Holds& holds) {
  if (holds(least)) return least;
  double low = least;
  double high = 2 * least;
  while (!holds(high)) {
    if (high > 0x1p60) return std::numeric_limits<double>::infinity();
    low = high;
    high *= 2;
  }
  while (high > low * 1.001) {
    const double middle = std::sqrt(low) * std::sqrt(high);
    (holds(middle) ? high : low) = middle;
  }
  return high;
}

/// Which polygon a boundary edge, in its direction, belongs to.
class PolygonOfEdge {
 public:
  explicit PolygonOfEdge(const IndexShape& shape) {
    const auto add = [&](const IndexRing& ring, std::size_t polygon) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        polygons_[key(ring[i], ring[(i + 1) % ring.size()])] = polygon;
      }
    };
    for (std::size_t p = 0; p < shape.size(); ++p) {
      add(shape[p].shell, p);
      for (const IndexRing& hole : shape[p].holes) add(hole, p);
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

/// One group's points, triangulated once, and shapes of them under wider and wider limits.
class Widening {
 public:
  Widening(Extractor& extractor, std::span<const Point> points, const Options& options, const OnStep& on_step)
      : extractor_(extractor), points_(points), options_(options), on_step_(on_step) {
    extractor_.triangulate(points_, options_.threads);
  }

  IndexShape shape(double factor) {
    if (on_step_) on_step_("widening the limit: step " + std::to_string(++steps_));
    extractor_.extract_regions(widened(options_, factor));
    return polygons_of(extractor_.extract_polygons());
  }

  /// The least factor with every point covered.
  double cover() {
    // Who is covered stays covered.
    std::vector<std::uint32_t> outside = points_outside(shape(1), points_);
    if (outside.empty() || !extractor_.has_triangles()) return 1;
    return least_factor(1, [&](double factor) {
      const IndexShape wider = shape(factor);
      const PointLocator locator(to_coordinates(wider, points_));
      std::vector<std::uint32_t> left;
      std::copy_if(outside.begin(), outside.end(), std::back_inserter(left),
                   [&](std::uint32_t i) { return !locator.contains(points_[i]); });
      if (left.empty()) return true;
      outside = std::move(left);
      return false;
    });
  }

  /// The least factor from `least` on with all polygons that `least` gives in one.
  double one(double least) {
    const IndexShape parts = shape(least);
    if (parts.size() < 2) return least;
    return least_factor(least, [&](double factor) {
      const IndexShape wider = shape(factor);
      return wider.size() == 1 || polygon_with_all(parts, wider).has_value();
    });
  }

  /// The polygon of `wider` that has all `parts`, which it covers.
  std::optional<std::size_t> polygon_with_all(const IndexShape& parts, const IndexShape& wider) const {
    const PointLocator locator(to_coordinates(wider, points_));
    const PolygonOfEdge polygon_of_edge(wider);
    std::optional<std::size_t> all;
    for (const IndexPolygon& part : parts) {
      // An edge of the part is an edge of that polygon or inside it. A vertex would not do: two may meet
      // there.
      const std::uint32_t from = part.shell[0];
      const std::uint32_t to = part.shell[1];
      std::optional<std::size_t> polygon = polygon_of_edge.find(from, to);
      if (!polygon) {
        const Point& a = points_[from];
        const Point& b = points_[to];
        polygon = locator.polygon_of({a.x / 2 + b.x / 2, a.y / 2 + b.y / 2});
      }
      if (!polygon || (all && *all != *polygon)) return {};
      all = polygon;
    }
    return all;
  }

 private:
  Extractor& extractor_;
  std::span<const Point> points_;
  Options options_;
  const OnStep& on_step_;
  int steps_ = 0;
};

void drop_polygons_of_few_triangles(IndexShape& shape, const std::vector<std::size_t>& triangles,
                                    std::size_t least) {
  std::size_t kept = 0;
  for (std::size_t p = 0; p < shape.size(); ++p) {
    if (triangles[p] < least) continue;
    if (kept != p) shape[kept] = std::move(shape[p]);
    ++kept;
  }
  shape.resize(kept);
}

/// The core's shape of `points`, widened where that is asked for, and the limits that it has.
GroupHull extracted(Extractor& extractor, std::span<const Point> points, const HullOptions& options,
                    const OnStep& on_step) {
  GroupHull hull;
  if (on_step) on_step("triangulating " + std::to_string(points.size()) + " points");
  Options used = options.core;
  std::optional<std::size_t> only;  // polygon
  if (options.cover || options.one) {
    Widening widening(extractor, points, options.core, on_step);
    const double covering = options.cover ? widening.cover() : 1;
    const double factor = options.one ? widening.one(covering) : covering;
    const IndexShape parts = options.one ? widening.shape(covering) : IndexShape();
    used = widened(options.core, factor);
    hull.shape = widening.shape(factor);
    if (options.one && hull.shape.size() > 1) only = widening.polygon_with_all(parts, hull.shape);
  } else {
    hull.shape = polygons_of(extractor.extract(points, used));
  }
  hull.extracted = hull.shape.size();
  hull.has_triangles = extractor.has_triangles();
  hull.by_outlines = extractor.statistics().by_outlines;
  hull.sizes = extractor.chosen_sizes();
  hull.limits = used;
  if (only) {
    IndexShape one = {std::move(hull.shape[*only])};
    hull.shape = std::move(one);
  }
  if (options.min_triangles > 1) {
    drop_polygons_of_few_triangles(hull.shape, extractor.count_triangles(), options.min_triangles);
  }
  return hull;
}

GroupHull hull_of(Extractor& extractor, std::span<const Point> points, const HullOptions& options,
                  const OnStep& on_step) {
  GroupHull hull = extracted(extractor, points, options, on_step);
  hull.points = points.size();
  if (on_step && options.simplify > 0) on_step("simplifying the outline");
  clean(hull.shape, points, options);
  hull.area = area(hull.shape, points, options.latitude);
  return hull;
}

/// The hulls of groups, which are taken by several threads.
class GroupWork {
 public:
  GroupWork(std::span<const Point> points, std::vector<GroupHull>& hulls, const HullOptions& options,
            const OnStep& on_step)
      : points_(points), hulls_(hulls), options_(options), on_step_(on_step) {}

  /// The groups of `order`, each on `threads_of_group` threads, on `threads` of ours.
  void run(std::span<const std::size_t> order, unsigned threads, unsigned threads_of_group) {
    std::atomic<std::size_t> next = 0;
    const auto work = [&] {
      try {
        Extractor extractor;
        for (std::size_t k = next++; k < order.size(); k = next++) {
          make(extractor, hulls_[order[k]], threads_of_group);
        }
      } catch (...) {
        next = order.size();
        const std::lock_guard lock(mutex_);
        if (!failure_) failure_ = std::current_exception();
      }
    };
    {
      std::vector<std::jthread> helpers;
      for (unsigned t = 1; t < std::min<std::size_t>(threads, order.size()); ++t) helpers.emplace_back(work);
      work();
    }
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  void make(Extractor& extractor, GroupHull& hull, unsigned threads) {
    HullOptions options = options_;
    options.core.threads = threads;
    std::vector<std::uint32_t> members = std::move(hull.members);
    std::vector<Point> points(members.size());
    std::transform(members.begin(), members.end(), points.begin(),
                   [&](std::uint32_t i) { return points_[i]; });
    hull = hull_of(extractor, points, options, {});
    for (IndexPolygon& polygon : hull.shape) {
      for (std::uint32_t& v : polygon.shell) v = members[v];
      for (IndexRing& hole : polygon.holes) {
        for (std::uint32_t& v : hole) v = members[v];
      }
    }
    hull.members = std::move(members);
    const std::lock_guard lock(mutex_);
    ++done_;
    if (on_step_) on_step_("group " + std::to_string(done_) + " of " + std::to_string(hulls_.size()));
  }

  std::span<const Point> points_;
  std::vector<GroupHull>& hulls_;
  const HullOptions& options_;
  const OnStep& on_step_;
  std::mutex mutex_;  ///< of the two below
  std::size_t done_ = 0;
  std::exception_ptr failure_;
};

}  // namespace

void clean(IndexShape& shape, std::span<const Point> points, const HullOptions& options) {
  if (options.min_area > 0) drop_small_areas(shape, points, options.min_area, options.latitude);
  if (options.max_parts) keep_largest(shape, points, *options.max_parts, options.latitude);
  if (options.simplify > 0) shape = simplify(shape, points, options.simplify);
}

std::vector<GroupHull> group_hulls(std::span<const Point> points, std::span<const std::uint32_t> groups,
                                   std::size_t group_count, const HullOptions& options, unsigned threads,
                                   const OnStep& on_step) {
  if (groups.empty() && group_count == 0) {
    HullOptions all = options;
    all.core.threads = points.size() < kWorthThreads ? 1 : threads;
    Extractor extractor;
    return {hull_of(extractor, points, all, on_step)};
  }
  std::vector<GroupHull> hulls(group_count);
  for (std::uint32_t i = 0; i < points.size(); ++i) hulls[groups[i]].members.push_back(i);
  std::vector<std::size_t> order(group_count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return hulls[a].members.size() > hulls[b].members.size();
  });
  // A group with more than a thread's share of the points would keep the others waiting.
  const std::size_t many = std::max(kWorthThreads, points.size() / threads);
  const auto few =
      std::find_if(order.begin(), order.end(), [&](std::size_t g) { return hulls[g].members.size() < many; });
  GroupWork work(points, hulls, options, on_step);
  work.run({order.begin(), few}, 1, threads);
  work.run({few, order.end()}, threads, 1);
  return hulls;
}

}  // namespace polylidar::tool
