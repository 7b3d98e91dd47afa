#include "tool/hull/group_hulls.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <numeric>
#include <thread>
#include <utility>

#include "tool/shapes/simplify.hpp"

namespace polylidar::tool {
namespace {

// Below this a thread's start costs more than it gives (polylidar::Options).
constexpr std::size_t kWorthThreads = 10000;

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
  hull.limits = options.core;
  if (options.wanted.cover || options.wanted.one) {
    int steps = 0;
    const auto tell = [&] {
      if (on_step) on_step("widening the limit: step " + std::to_string(++steps));
    };
    WidenedHull widened = widened_hull(extractor, points, options.core, options.wanted, tell);
    hull.shape = polygons_of(widened.shape);
    hull.limits = widened.options;
  } else {
    hull.shape = polygons_of(extractor.extract(points, options.core));
  }
  hull.extracted = hull.shape.size();
  hull.has_triangles = extractor.has_triangles();
  hull.by_outlines = extractor.statistics().by_outlines;
  hull.sizes = extractor.chosen_sizes();
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
