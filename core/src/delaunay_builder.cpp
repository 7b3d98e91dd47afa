#include "delaunay_builder.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "curve.hpp"
#include "predicates_inline.hpp"
#include "vector.hpp"

namespace polylidar::detail {

namespace {

// Cells with at most this many points are halved by sorting them; larger ones get a finer curve of their own.
constexpr std::uint32_t kSmallCell = 16;

/// Which line separates points whose keys differ first in bit `level`, counted from 1.
Axis axis_of_level(unsigned level) {
  return (level & 1U) != 0 ? Axis::kY : Axis::kX;
}

}  // namespace

void check_point_count(std::size_t points) {
  if (points > kMaxPoints) throw std::invalid_argument("more than 2^28 points: split the input");
}

void DelaunayBuilder::build(std::span<const Point> points, ThreadPool& pool) {
  check_point_count(points.size());
  if (!points.empty()) return build(points, measure_coordinates(points, pool), pool);
  mesh_.reset(0);
  vertex_count_ = 0;
  scale_exponent_ = 0;
}

// What can be refused is refused by now, before anything is changed.
void DelaunayBuilder::build(std::span<const Point> points, const CoordinateRange& range, ThreadPool& pool) {
  mesh_.reset(points.size());
  vertex_count_ = points.size();
  scale_exponent_ = range.scale_exponent;
  sort_along_curve(points, range, pool);
  if (pool.threads() == 1) {
    build_range(0, static_cast<Index>(points.size()));
  } else {
    build_subtrees(pool);
  }
}

/// Copies the caller's points, scaled, in the order of the curve.
void DelaunayBuilder::sort_along_curve(std::span<const Point> points, CoordinateRange range,
                                       ThreadPool& pool) {
  const std::size_t count = points.size();
  std::vector<Point> scaled;  // before anything is computed: differences might overflow, or lose bits
  if (scale_exponent_ != 0) {
    const auto scale = [this](const Point& p) {
      return Point{std::ldexp(p.x, scale_exponent_), std::ldexp(p.y, scale_exponent_)};
    };
    scaled.resize(count);
    std::transform(points.begin(), points.end(), scaled.begin(), scale);
    points = scaled;
    range.box = {scale(range.box.min), scale(range.box.max)};
  }
  const double squared_unit = range.unit * range.unit;
  exact_limits_ = {0x1p53 * squared_unit, 0x1p53 * squared_unit * squared_unit};

  auto* memory = mesh_.borrow<CurveEntry>(0);
  const CurveEntry* entries = sort_along(Curve(range.box, count), points, memory, memory + count, pool);

  Point* sorted = points_.reserve(count);
  Index* order = order_.reserve(count);
  std::uint32_t* keys = keys_.reserve(count);
  const Chunks chunks(pool, count);
  pool.for_each(chunks.size(), [&](std::size_t chunk) {
    for (std::size_t i = chunks.begin(chunk); i < chunks.end(chunk); ++i) {
      order[i] = static_cast<Index>(entries[i]);
      keys[i] = static_cast<std::uint32_t>(entries[i] >> 32U);
      sorted[i] = points[order[i]];
    }
  });
}

/// Triangulates all points on several threads.
///
/// The lines that build_range follows cut the points into subtrees whose triangulations touch none of each
/// other's memory. Whoever finishes the second of two neighbouring subtrees merges them, as build_range
/// would.
void DelaunayBuilder::build_subtrees(ThreadPool& pool) {
  constexpr std::size_t kSubtreesPerThread = 8;
  constexpr Index kSmallestSubtree = 128;
  const auto count = static_cast<Index>(vertex_count_);
  std::deque<Subtree> subtrees;
  subtrees.emplace_back(0, count, nullptr);
  const std::size_t wanted = kSubtreesPerThread * std::max<std::size_t>(2, pool.threads());
  cut(subtrees.front(), std::max(kSmallestSubtree, static_cast<Index>(count / wanted)), subtrees);

  std::vector<Subtree*> uncut;
  for (Subtree& subtree : subtrees) {
    if (subtree.first == nullptr) uncut.push_back(&subtree);
  }
  std::sort(uncut.begin(), uncut.end(),
            [](const Subtree* a, const Subtree* b) { return a->begin < b->begin; });
  pool.for_each(uncut.size(), [&](std::size_t i) {
    uncut[i]->hull = build_range(uncut[i]->begin, uncut[i]->end);
    finish(*uncut[i]);
  });
}

/// Cuts `subtree` and what comes out of it, appended to `subtrees`, until none has more than `largest`
/// points.
void DelaunayBuilder::cut(Subtree& subtree, Index largest, std::deque<Subtree>& subtrees) {
  if (subtree.end - subtree.begin <= largest) return;
  std::uint32_t* keys = keys_.data();
  if (keys[subtree.begin] == keys[subtree.end - 1]) {
    const Box box = bounding_box({points_.data() + subtree.begin, points_.data() + subtree.end});
    if (box.min == box.max) return;
    refine_curve(subtree.begin, subtree.end, box);
  }
  // The line is where the highest bit in which keys differ changes.
  const std::uint32_t differing = keys[subtree.begin] ^ keys[subtree.end - 1];
  const std::uint32_t bit = std::bit_floor(differing);
  const auto middle =
      static_cast<Index>(std::partition_point(keys + subtree.begin, keys + subtree.end,
                                              [bit](std::uint32_t key) { return (key & bit) == 0; }) -
                         keys);
  subtree.axis = axis_of_level(static_cast<unsigned>(std::bit_width(differing)));
  subtree.first = &subtrees.emplace_back(subtree.begin, middle, &subtree);
  subtree.second = &subtrees.emplace_back(middle, subtree.end, &subtree);
  cut(*subtree.first, largest, subtrees);
  cut(*subtree.second, largest, subtrees);
}

/// Merges upwards from a subtree that has its hull, as far as the neighbours have theirs.
void DelaunayBuilder::finish(Subtree& subtree) {
  for (Subtree* whole = subtree.parent; whole != nullptr; whole = whole->parent) {
    if (whole->unfinished.fetch_sub(1, std::memory_order_acq_rel) != 1) return;
    whole->hull = merge(whole->first->hull, whole->second->hull, whole->second->begin, whole->axis);
  }
}

/// Triangulates the points [begin, end), which stand in the order of keys of one curve.
///
/// Where two neighbours' keys first differ, counted from the highest bit, is where a vertical or a horizontal
/// line separates them, and the higher that bit, the later the two sides are merged. Going through the points
/// once, a stack holds the subtrees that wait for what comes after them.
Hull DelaunayBuilder::build_range(Index begin, Index end) {
  struct Waiting {
    Hull hull;
    unsigned level;  ///< bit that separates it from the next subtree, counted from 1; kLast for the last
    Index end;       ///< one past its last point
  };
  constexpr unsigned kLast = 33;
  std::array<Waiting, kLast + 1> waiting;  // levels fall from bottom to top, so that there are never more
  std::size_t count = 0;
  const std::uint32_t* keys = keys_.data();
  // The level between a point and the one before it; 0 inside a cell of the curve.
  const auto level_before = [&](Index point) {
    return point == end ? kLast : static_cast<unsigned>(std::bit_width(keys[point - 1] ^ keys[point]));
  };
  unsigned level = kLast;  // before `first`
  for (Index first = begin; first < end;) {
    Index next = first + 1;
    Waiting subtree{Hull::of_point(first), level_before(next), next};
    if (subtree.level == 0) {
      while ((subtree.level = level_before(++next)) == 0) continue;
      subtree = {build_cell(first, next), subtree.level, next};
    } else if (end - first >= 3) {
      const unsigned inner = level_before(first + 2);
      const unsigned after = level_before(first + 3);
      if (inner != 0 && std::max(subtree.level, inner) < std::min(level, after) &&
          build_triangle(first, subtree.hull)) {
        next = first + 3;
        subtree.level = after;
        subtree.end = next;
      }
    }
    level = subtree.level;
    while (count > 0 && waiting[count - 1].level < subtree.level) {
      const Waiting& before = waiting[--count];
      subtree.hull = merge(before.hull, subtree.hull, before.end, axis_of_level(before.level));
    }
    waiting[count++] = subtree;
    first = next;
  }
  return waiting[0].hull;
}

/// Triangulates the three points from `first` on, unless they lie on a line.
bool DelaunayBuilder::build_triangle(Index first, Hull& hull) {
  const Point* points = points_.data();
  const double turn = orient2d(points[first], points[first + 1], points[first + 2]);
  if (turn == 0) return false;
  const Index b = turn > 0 ? first + 1 : first + 2;
  const Index c = turn > 0 ? first + 2 : first + 1;
  hull = join_triangle(mesh_, points, first, b, c, Mesh::kStride * 2 * first);
  return true;
}

/// Triangulates points that fell into one cell of the curve.
Hull DelaunayBuilder::build_cell(Index begin, Index end) {
  if (end - begin <= kSmallCell) {
    sort_small_cell(begin, end);
    return build_sorted(begin, end);
  }
  const Box box = bounding_box({points_.data() + begin, points_.data() + end});
  if (box.min == box.max) return collapse(begin, end);
  refine_curve(begin, end, box);
  return build_range(begin, end);
}

void DelaunayBuilder::sort_small_cell(Index begin, Index end) {
  struct Entry {
    Point point;
    Index order;
  };
  std::array<Entry, kSmallCell> entries;
  const Index count = end - begin;
  for (Index i = 0; i < count; ++i) entries[i] = {points_.data()[begin + i], order_.data()[begin + i]};
  // Of equal points the caller's lowest index comes first and stands for all.
  std::sort(entries.begin(), entries.begin() + count, [](const Entry& a, const Entry& b) {
    return less_by_x(a.point, b.point) || (a.point == b.point && a.order < b.order);
  });
  for (Index i = 0; i < count; ++i) {
    points_.data()[begin + i] = entries[i].point;
    order_.data()[begin + i] = entries[i].order;
  }
}

/// Sorts [begin, end) along a curve through `box`, the points' own bounding box, which is wider than a point:
/// at least two keys differ.
void DelaunayBuilder::refine_curve(Index begin, Index end, const Box& box) {
  const std::size_t count = end - begin;
  Point* points = points_.data() + begin;
  Index* order = order_.data() + begin;

  // The records of these points, 64 bytes for each but one, are not written yet.
  auto* old_points = mesh_.borrow<Point>(Mesh::kStride * 2 * begin);
  auto* memory = reinterpret_cast<CurveEntry*>(old_points + count);
  auto* old_order = reinterpret_cast<Index*>(memory + 2 * count);
  std::copy_n(points, count, old_points);
  std::copy_n(order, count, old_order);

  ThreadPool this_thread;
  const CurveEntry* entries =
      sort_along(Curve(box, count), {old_points, count}, memory, memory + count, this_thread);
  for (std::size_t i = 0; i < count; ++i) {
    const auto from = static_cast<std::uint32_t>(entries[i]);
    keys_.data()[begin + i] = static_cast<std::uint32_t>(entries[i] >> 32U);
    points[i] = old_points[from];
    order[i] = old_order[from];
  }
}

/// Triangulates points in lexicographic order: halves are separated by a line that is vertical but for an
/// infinitesimal tilt.
Hull DelaunayBuilder::build_sorted(Index begin, Index end) {
  const Point* points = points_.data();
  if (points[begin] == points[end - 1]) return collapse(begin, end);
  Index middle = begin + (end - begin) / 2;
  while (middle > begin && points[middle] == points[middle - 1]) --middle;
  if (middle == begin) {
    middle = begin + (end - begin) / 2;
    while (points[middle] == points[middle - 1]) ++middle;
  }
  const Hull left = build_sorted(begin, middle);
  const Hull right = build_sorted(middle, end);
  return merge(left, right, middle, Axis::kX);
}

/// Repetitions of one point: the first stands for all, and the records of the merges that do not happen stay
/// unused.
Hull DelaunayBuilder::collapse(Index begin, Index end) {
  for (Index t = 2 * begin; t < 2 * (end - 1); ++t) {
    for (Index k = 0; k < 3; ++k) mesh_.origin(Mesh::kStride * t + k) = kNone;
  }
  return Hull::of_point(begin);
}

}  // namespace polylidar::detail
