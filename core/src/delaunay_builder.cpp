#include "delaunay_builder.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "predicates_inline.hpp"

namespace polylidar::detail {

namespace {

// Coordinates between these magnitudes keep every product of the predicates (degree 4) and of the filter
// (degree 6) away from overflow, and its last bit away from underflow: (2^151)^6 < 2^1024 and (2^(-116 -
// 52))^6 > 2^-1022.
constexpr int kLargestExponent = 150;
constexpr int kSmallestExponent = -116;

// Cells with at most this many points are halved by sorting them; larger ones get a finer curve of their own.
constexpr std::uint32_t kSmallCell = 16;

struct Range {
  Box box;
  double largest = 0;                                         ///< greatest magnitude of a coordinate
  double smallest = std::numeric_limits<double>::infinity();  ///< least magnitude of one that is not zero
};

Range measure(std::span<const Point> points) {
  Range range;
  double poison = 0;  // becomes NaN with the first coordinate that is not finite
  for (const Point& p : points) {
    poison += p.x * 0 + p.y * 0;
    for (const double c : {std::abs(p.x), std::abs(p.y)}) {
      range.largest = std::max(range.largest, c);
      if (c != 0) range.smallest = std::min(range.smallest, c);
    }
  }
  if (poison != 0 || std::isnan(poison)) {
    const auto bad = std::find_if(points.begin(), points.end(),
                                  [](const Point& p) { return !std::isfinite(p.x) || !std::isfinite(p.y); });
    throw std::invalid_argument("point " + std::to_string(bad - points.begin()) + " is not finite");
  }
  range.box = bounding_box(points);
  return range;
}

/// The power of two by which all coordinates are multiplied; 0 unless they are extremely large or small.
int choose_scale(const Range& range) {
  if (range.largest == 0) return 0;
  const int largest = std::ilogb(range.largest);
  const int smallest = std::ilogb(range.smallest);
  if (largest < kLargestExponent && smallest >= kSmallestExponent) return 0;
  const int scale = kLargestExponent - 1 - largest;
  if (smallest + scale < kSmallestExponent) {
    throw std::invalid_argument("coordinates span more than a factor of 2^" +
                                std::to_string(kLargestExponent - 1 - kSmallestExponent) +
                                " in magnitude; move or round those closest to zero");
  }
  return scale;
}

/// The bits of `value`, at most 16 of them, at the even places.
std::uint32_t spread_bits(std::uint32_t value) {
  value = (value | (value << 8U)) & 0x00FF00FFU;
  value = (value | (value << 4U)) & 0x0F0F0F0FU;
  value = (value | (value << 2U)) & 0x33333333U;
  value = (value | (value << 1U)) & 0x55555555U;
  return value;
}

/// Morton keys of the cells of a square grid over a box: x in the odd bits, y in the even ones. Subtraction
/// and multiplication round monotonically, so that of two points in different columns (or rows) the order of
/// the cells is the order of the coordinates.
class Curve {
 public:
  Curve(const Box& box, std::size_t points) : minimum_(box.min) {
    // A few cells for every point: enough to tell most points apart, few enough to sort by few digits.
    const int bits = std::clamp(static_cast<int>(std::bit_width(points)) / 2 + 3, 4, 16);
    const double extent = std::max(box.max.x - box.min.x, box.max.y - box.min.y);
    cells_per_length_ = extent > 0 ? ((1U << static_cast<unsigned>(bits)) - 1) / extent : 0;
    key_bits_ = 2 * bits;
  }

  std::uint32_t key(const Point& p) const {
    const auto column = static_cast<std::uint32_t>((p.x - minimum_.x) * cells_per_length_);
    const auto row = static_cast<std::uint32_t>((p.y - minimum_.y) * cells_per_length_);
    return (spread_bits(column) << 1U) | spread_bits(row);
  }
  int key_bits() const { return key_bits_; }

 private:
  Point minimum_;
  double cells_per_length_;
  int key_bits_;
};

/// Sorts `count` entries, whose lower 32 bits ascend, by their upper 32 bits, stably, least significant digit
/// first. Returns where the result is: `entries` or `spare`.
std::uint64_t* radix_sort(std::uint64_t* entries, std::uint64_t* spare, std::size_t count, int key_bits) {
  constexpr std::size_t kWorthCounting = 1024;
  if (count < kWorthCounting) {  // clearing and summing the counters would cost more than comparing
    std::sort(entries, entries + count);
    return entries;
  }
  constexpr int kDigitBits = 11;
  constexpr std::size_t kDigits = std::size_t{1} << kDigitBits;
  std::array<std::uint32_t, kDigits> offset;
  for (int done = 0; done < key_bits; done += kDigitBits) {
    const auto shift = static_cast<unsigned>(32 + done);
    const auto digit = [shift](std::uint64_t entry) { return (entry >> shift) & (kDigits - 1); };
    offset.fill(0);
    for (std::size_t i = 0; i < count; ++i) ++offset[digit(entries[i])];
    std::uint32_t total = 0;
    for (std::uint32_t& o : offset) {
      const std::uint32_t here = o;
      o = total;
      total += here;
    }
    for (std::size_t i = 0; i < count; ++i) spare[offset[digit(entries[i])]++] = entries[i];
    std::swap(entries, spare);
  }
  return entries;
}

bool less_by_x(const Point& a, const Point& b) {
  return a.x < b.x || (a.x == b.x && a.y < b.y);
}
bool less_by_y(const Point& a, const Point& b) {
  return a.y < b.y || (a.y == b.y && a.x < b.x);
}

}  // namespace

void DelaunayBuilder::build(std::span<const Point> points) {
  if (points.size() > Mesh::kMaxPoints) {
    throw std::invalid_argument("more than 2^28 points: split the input");
  }
  mesh_.reset(points.size());
  scale_exponent_ = 0;
  if (points.empty()) return;
  sort_along_curve(points);
  build_range(0, static_cast<Index>(points.size()));
}

/// Copies the caller's points, scaled, in the order of the curve.
void DelaunayBuilder::sort_along_curve(std::span<const Point> points) {
  const std::size_t count = points.size();
  const Range range = measure(points);
  scale_exponent_ = choose_scale(range);

  std::uint64_t* entries = sorting_.reserve(count);
  const Curve curve(range.box, count);
  for (std::size_t i = 0; i < count; ++i) entries[i] = (std::uint64_t{curve.key(points[i])} << 32U) | i;
  entries = radix_sort(entries, sorting_spare_.reserve(count), count, curve.key_bits());

  Point* sorted = points_.reserve(count);
  Index* order = order_.reserve(count);
  std::uint32_t* keys = keys_.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    order[i] = static_cast<Index>(entries[i]);
    keys[i] = static_cast<std::uint32_t>(entries[i] >> 32U);
    sorted[i] = points[order[i]];
  }
  if (scale_exponent_ != 0) {
    for (std::size_t i = 0; i < count; ++i) {
      sorted[i] = {std::ldexp(sorted[i].x, scale_exponent_), std::ldexp(sorted[i].y, scale_exponent_)};
    }
  }
}

/// Triangulates the points [begin, end), which stand in the order of keys of one curve.
DelaunayBuilder::Hull DelaunayBuilder::build_range(Index begin, Index end) {
  if (end - begin == 1) return {begin, kNone};
  const std::uint32_t* keys = keys_.data();
  const std::uint32_t difference = keys[begin] ^ keys[end - 1];
  if (difference == 0) return build_cell(begin, end);

  // The highest bit in which the keys differ cuts the range by a vertical or a horizontal line.
  const auto bit = static_cast<unsigned>(std::bit_width(difference)) - 1;
  const auto first_beyond = std::partition_point(
      keys + begin, keys + end, [bit](std::uint32_t key) { return ((key >> bit) & 1U) == 0; });
  const auto middle = static_cast<Index>(first_beyond - keys);
  const Hull left = build_range(begin, middle);
  const Hull right = build_range(middle, end);
  return merge(left, right, middle, (bit & 1U) != 0 ? Axis::kX : Axis::kY);
}

/// Triangulates points that fell into one cell of the curve.
DelaunayBuilder::Hull DelaunayBuilder::build_cell(Index begin, Index end) {
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

  // The curve's memory is free again by now, but enclosing calls still need the keys outside this range.
  std::uint64_t* entries = sorting_.data() + begin;
  const Curve curve(box, count);
  for (std::size_t i = 0; i < count; ++i) entries[i] = (std::uint64_t{curve.key(points[i])} << 32U) | i;
  entries = radix_sort(entries, sorting_spare_.data() + begin, count, curve.key_bits());

  std::vector<Point> old_points(points, points + count);
  std::vector<Index> old_order(order, order + count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto from = static_cast<std::uint32_t>(entries[i]);
    keys_.data()[begin + i] = static_cast<std::uint32_t>(entries[i] >> 32U);
    points[i] = old_points[from];
    order[i] = old_order[from];
  }
}

/// Triangulates points in lexicographic order: halves are separated by a line that is vertical but for an
/// infinitesimal tilt.
DelaunayBuilder::Hull DelaunayBuilder::build_sorted(Index begin, Index end) {
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
DelaunayBuilder::Hull DelaunayBuilder::collapse(Index begin, Index end) {
  for (Index t = 2 * begin; t < 2 * (end - 1); ++t) {
    for (Index k = 0; k < 3; ++k) mesh_.origin(Mesh::kStride * t + k) = kNone;
  }
  return {begin, kNone};
}

/// Moves `hull` to its least or greatest vertex along `axis`. Coordinates along a convex polygon rise and
/// fall once, and ties are broken by the other axis.
void DelaunayBuilder::move_to_extreme(Hull& hull, Axis axis, bool greatest) const {
  if (hull.is_point()) return;
  const Point* points = points_.data();
  const auto better = [&](Index candidate, Index current) {
    const Point& a = points[greatest ? current : candidate];
    const Point& b = points[greatest ? candidate : current];
    return axis == Axis::kX ? less_by_x(a, b) : less_by_y(a, b);
  };
  const auto advance = [&](auto step) {
    bool moved = false;
    for (Index e = step(hull.to_infinity); better(mesh_.origin(e), hull.vertex); e = step(e)) {
      hull = {mesh_.origin(e), e};
      moved = true;
    }
    return moved;
  };
  if (!advance([this](Index e) { return next_on_hull(e); })) {
    advance([this](Index e) { return previous_on_hull(e); });
  }
}

/// From the vertices of two hulls that face each other, walks down to the edge below which neither hull has a
/// point. Collinear points beyond the ends are left where they are: the strict test keeps the edge as short
/// as possible.
void DelaunayBuilder::find_lower_tangent(Hull& left, Hull& right) const {
  const Point* points = points_.data();
  const auto is_below = [&](Index candidate) {
    return orient2d_fast(points[left.vertex], points[right.vertex], points[candidate]) < 0;
  };
  for (bool moved = true; moved;) {
    moved = false;
    if (!left.is_point()) {
      const Index e = previous_on_hull(left.to_infinity);
      if (is_below(mesh_.origin(e))) {
        left = {mesh_.origin(e), e};
        moved = true;
      }
    }
    if (!right.is_point()) {
      const Index e = next_on_hull(right.to_infinity);
      if (is_below(mesh_.origin(e))) {
        right = {mesh_.origin(e), e};
        moved = true;
      }
    }
  }
}

/// Joins two triangulations that a line across `axis` separates, `left` on its lower side. Directions in the
/// comments are those of a vertical line; nothing below depends on it but the starting points of the tangent.
///
/// From the lower tangent upwards, `base` is the topmost edge that joins the halves. The next triangle stands
/// on it with its apex at the next hull vertex of one half; edges of that half whose far side violates the
/// empty circle are flipped to the hull first.
DelaunayBuilder::Hull DelaunayBuilder::merge(Hull left, Hull right, Index middle, Axis axis) {
  move_to_extreme(left, axis, true);
  move_to_extreme(right, axis, false);
  find_lower_tangent(left, right);

  const Point* points = points_.data();
  Mesh& mesh = mesh_;
  const Index bottom = Mesh::kStride * (2 * middle - 2);
  const Index top = bottom + Mesh::kStride;
  Index l = left.vertex;
  Index r = right.vertex;
  const Index bottom_l_to_infinity = bottom + 1;
  const Index bottom_infinity_to_r = bottom + 2;
  mesh.origin(bottom) = r;
  mesh.origin(bottom_l_to_infinity) = l;
  mesh.origin(bottom_infinity_to_r) = kNone;

  // In the ghost over the hull edge that rises from l: l -> infinity. kNone when the left half is one point.
  Index left_ghost = left.to_infinity;
  // In the ghost over the hull edge that comes down to r: infinity -> r. kNone when the right half is one
  // point.
  Index right_ghost = kNone;
  if (!left.is_point()) mesh.bond(bottom_l_to_infinity, mesh.twin(left_ghost));
  if (!right.is_point()) {
    right_ghost = mesh.twin(right.to_infinity);
    mesh.bond(bottom_infinity_to_r, right.to_infinity);
  }

  Index base = bottom;  // runs r -> l: the upper side of the topmost joining edge is its twin
  for (;;) {
    const Index l2 = left.is_point() ? kNone : find_left_candidate(left_ghost, l, r);
    const Index r2 = right.is_point() ? kNone : find_right_candidate(right_ghost, l, r);
    if (l2 == kNone && r2 == kNone) break;
    const bool take_left =
        r2 == kNone || (l2 != kNone && incircle_fast(points[l], points[r], points[l2], points[r2]) <= 0);
    if (take_left) {
      // The ghost (l2, l, infinity) becomes the triangle (l2, l, r).
      const Index infinity = Mesh::next(left_ghost);
      const Index next_ghost = mesh.twin(infinity);
      mesh.origin(infinity) = r;
      mesh.bond(left_ghost, base);
      base = infinity;
      left_ghost = next_ghost;
      l = l2;
    } else {
      // The ghost (r, r2, infinity) becomes the triangle (r, r2, l).
      const Index infinity = right_ghost;
      const Index r2_to_infinity = Mesh::previous(infinity);
      const Index next_ghost = mesh.twin(r2_to_infinity);
      mesh.origin(infinity) = l;
      mesh.bond(infinity, base);
      base = r2_to_infinity;
      right_ghost = next_ghost;
      r = r2;
    }
  }

  const Index top_r_to_infinity = top + 1;
  const Index top_infinity_to_l = top + 2;
  mesh.origin(top) = l;
  mesh.origin(top_r_to_infinity) = r;
  mesh.origin(top_infinity_to_l) = kNone;
  mesh.bond(top, base);
  mesh.bond(top_r_to_infinity, right.is_point() ? bottom_infinity_to_r : right_ghost);
  mesh.bond(top_infinity_to_l, left.is_point() ? bottom_l_to_infinity : left_ghost);
  return {left.vertex, bottom_l_to_infinity};
}

/// The apex that the left half offers for the triangle on the base l - r: the next hull vertex above l once
/// the edges that this triangle's circle forbids are flipped away. kNone when it does not lie above the base.
Mesh::Index DelaunayBuilder::find_left_candidate(Index left_ghost, Index l, Index r) {
  const Point* points = points_.data();
  Mesh& mesh = mesh_;
  const Index infinity = Mesh::next(left_ghost);
  const Index hull_edge = Mesh::previous(left_ghost);  // l2 -> l
  Index l2 = mesh.origin(hull_edge);
  if (orient2d_fast(points[l], points[r], points[l2]) <= 0) return kNone;
  for (;;) {
    const Index inner = mesh.twin(hull_edge);  // l -> l2
    const Index inner_previous = Mesh::previous(inner);
    const Index apex = mesh.origin(inner_previous);
    if (apex == kNone || incircle_fast(points[l], points[r], points[l2], points[apex]) <= 0) return l2;
    // Flip l - l2: the triangle (l, l2, apex) and the ghost (l2, l, infinity) become the ghosts (l2, apex,
    // infinity) and (apex, l, infinity). The edge l2 -> apex keeps its record and its twin.
    const Index beyond_l2 = mesh.twin(infinity);
    mesh.origin(hull_edge) = apex;
    mesh.bond(hull_edge, mesh.twin(inner_previous));
    mesh.origin(inner) = kNone;
    mesh.bond(inner, beyond_l2);
    mesh.bond(inner_previous, infinity);
    l2 = apex;
  }
}

/// The mirror image of find_left_candidate. `right_ghost` is infinity -> r in the ghost (r, r2, infinity).
Mesh::Index DelaunayBuilder::find_right_candidate(Index right_ghost, Index l, Index r) {
  const Point* points = points_.data();
  Mesh& mesh = mesh_;
  const Index hull_edge = Mesh::next(right_ghost);  // r -> r2
  const Index r2_to_infinity = Mesh::previous(right_ghost);
  Index r2 = mesh.origin(r2_to_infinity);
  if (orient2d_fast(points[l], points[r], points[r2]) <= 0) return kNone;
  for (;;) {
    const Index inner = mesh.twin(hull_edge);  // r2 -> r
    const Index inner_next = Mesh::next(inner);
    const Index apex = mesh.origin(Mesh::previous(inner));
    if (apex == kNone || incircle_fast(points[l], points[r], points[r2], points[apex]) <= 0) return r2;
    // Flip r2 - r: the triangle (r2, r, apex) and the ghost (r, r2, infinity) become the ghosts (apex, r2,
    // infinity) and (r, apex, infinity).
    const Index beyond_r2 = mesh.twin(r2_to_infinity);
    mesh.origin(r2_to_infinity) = apex;
    mesh.bond(hull_edge, mesh.twin(inner_next));
    mesh.origin(inner_next) = kNone;
    mesh.bond(inner, beyond_r2);
    mesh.bond(inner_next, r2_to_infinity);
    r2 = apex;
  }
}

}  // namespace polylidar::detail
