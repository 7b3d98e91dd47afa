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

/// The largest power of two of which all coordinates are multiples, or 0 once it turns out to be too small to
/// matter: below 2^-20 of the extent no predicate of lattice neighbours fits into 53 bits. Most inputs show
/// that at once.
double common_unit(std::span<const Point> points, const Box& box) {
  const double too_small = std::max(box.max.x - box.min.x, box.max.y - box.min.y) * 0x1p-20;
  double unit = std::numeric_limits<double>::infinity();
  for (const Point& p : points) {
    for (const double c : {p.x, p.y}) {
      if (c == 0) continue;
      const auto bits = std::bit_cast<std::uint64_t>(c);
      const int exponent = static_cast<int>((bits >> 52U) & 0x7FFU);
      if (exponent == 0) return 0;  // subnormal
      constexpr std::uint64_t kLeadingOne = std::uint64_t{1} << 52U;
      const int trailing_zeros = std::countr_zero(bits | kLeadingOne);
      unit = std::min(unit, std::ldexp(1.0, exponent - 1075 + trailing_zeros));
      if (unit < too_small) return 0;
    }
  }
  return unit;
}

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

}  // namespace

void DelaunayBuilder::build(std::span<const Point> points) {
  if (points.size() > Mesh::kMaxPoints) {
    throw std::invalid_argument("more than 2^28 points: split the input");
  }
  mesh_.reset(points.size());
  vertex_count_ = points.size();
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
  const double unit = scale_exponent_ == 0 ? common_unit(points, range.box) : 0;
  exact_limits_ = {0x1p53 * (unit * unit), 0x1p53 * (unit * unit) * (unit * unit)};

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
///
/// Where two neighbours' keys first differ, counted from the highest bit, is where a vertical or a horizontal
/// line separates them, and the higher that bit, the later the two sides are merged. Going through the points
/// once, a stack holds the parts that wait for what comes after them.
Hull DelaunayBuilder::build_range(Index begin, Index end) {
  struct Part {
    Hull hull;
    unsigned level;  ///< bit that separates it from the next part, counted from 1; kLast for the last
    Index end;       ///< one past its last point
  };
  constexpr unsigned kLast = 33;
  std::array<Part, kLast + 1> waiting;  // levels fall from bottom to top, so that there are never more
  std::size_t count = 0;
  const std::uint32_t* keys = keys_.data();
  // The level between a point and the one before it; 0 inside a cell of the curve.
  const auto level_before = [&](Index point) {
    return point == end ? kLast : static_cast<unsigned>(std::bit_width(keys[point - 1] ^ keys[point]));
  };
  unsigned level = kLast;  // before `first`
  for (Index first = begin; first < end;) {
    Index next = first + 1;
    Part part{Hull::of_point(first), level_before(next), next};
    if (part.level == 0) {
      while ((part.level = level_before(++next)) == 0) continue;
      part = {build_cell(first, next), part.level, next};
    } else if (end - first >= 3) {
      const unsigned inner = level_before(first + 2);
      const unsigned after = level_before(first + 3);
      if (inner != 0 && std::max(part.level, inner) < std::min(level, after) &&
          build_triangle(first, part.hull)) {
        next = first + 3;
        part.level = after;
        part.end = next;
      }
    }
    level = part.level;
    while (count > 0 && waiting[count - 1].level < part.level) {
      const Part& before = waiting[--count];
      part.hull = merge(before.hull, part.hull, before.end, (before.level & 1U) != 0 ? Axis::kY : Axis::kX);
    }
    waiting[count++] = part;
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
  hull = join_triangle(mesh_, first, b, c, Mesh::kStride * 2 * first);
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
