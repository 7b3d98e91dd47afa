#include "hull_merge.hpp"

#include <array>
#include <cmath>

#include "predicates_inline.hpp"
#include "vector.hpp"

namespace polylidar::detail {

namespace {

using Index = Mesh::Index;

enum class Side : std::uint8_t { kLeft, kRight };

/// Writes the origins of the ghost over the hull edge from -> to: it runs the other way round and ends at
/// infinity.
[[gnu::always_inline]] inline void write_ghost(Index* memory, std::size_t ghost, Index from, Index to) {
  memory[ghost] = to;
  memory[ghost + 1] = from;
  memory[ghost + 2] = kNone;
}

/// A point as seen from the end of the base on its own side, which is the origin of the predicates'
/// arithmetic there: what one test has computed serves the next.
struct Apex {
  Index vertex = kNone;  ///< kNone: there is none
  Vector offset{};       ///< from the origin
  double squared = 0;    ///< of the offset's length
  double over_base = 0;  ///< twice the area of the triangle on the base: positive above it
};

/// What one half offers for the triangle on the base. But for the apexes' `over_base` it depends on the
/// base's end on this side only, and stays as it is while the other end rises.
struct Front {
  Index ghost = kNone;  ///< record of the ghost over the hull edge that rises from l, or comes down to r;
                        ///< kNone: the half is a single point
  Index inner = 0;      ///< that hull edge in the triangle behind it
  Apex candidate;       ///< its end that is not the base's
  Apex behind;          ///< the third vertex of the triangle behind it; kNone where that is a ghost
  double cross = 0;     ///< of the two offsets, mirrored on the right side: positive when the edge's other
                        ///< side is the infinite one
};

/// One merge. Directions in the names are those of halves to the left and the right of a vertical line;
/// nothing depends on the line's direction.
///
/// From the lower tangent upwards, `base_` is the topmost edge that joins the halves. The next triangle
/// stands on it with its apex at the next hull vertex of one half, of which the edges that the empty circle
/// forbids have been flipped away (Guibas and Stolfi 1985, section 6).
///
/// Everything is inlined into one function, so that the compiler keeps the fronts in registers: left to
/// itself it passes them through memory, and the kernel takes twice as long.
class Merge {
 public:
  [[gnu::always_inline]] inline Merge(Mesh& mesh, const Point* points, const ExactLimits& limits)
      : memory_(mesh.memory()), points_(points), limits_(limits) {}

  /// `left` and `right` are the vertices of the halves that are nearest to the line; the two records from
  /// `bottom` on get the ghosts under the lower tangent, from left to right, and over the upper one, from
  /// right to left.
  [[gnu::always_inline]] inline void run(HullVertex left, HullVertex right, Index bottom) {
    find_lower_tangent(left, right);
    lower_left_ = left.vertex;
    open_bottom(left, right, bottom);
    close_gap();
    close_top(bottom);
  }
  Index lower_left() const { return lower_left_; }
  Index upper_right() const { return r_; }

 private:
  // As in Mesh; sums in 64 bits go into the address and cost nothing.
  [[gnu::always_inline]] inline Index& origin(std::size_t e) const { return memory_[e]; }
  [[gnu::always_inline]] inline Index twin(std::size_t e) const { return memory_[e + 4]; }
  [[gnu::always_inline]] inline void bond(Index e, Index f) const {
    memory_[std::size_t{e} + 4] = f;
    memory_[std::size_t{f} + 4] = e;
  }

  [[gnu::always_inline]] inline void find_lower_tangent(HullVertex& left, HullVertex& right) const;
  [[gnu::always_inline]] inline void open_bottom(const HullVertex& left, const HullVertex& right,
                                                 Index bottom);
  [[gnu::always_inline]] inline void close_gap();
  [[gnu::always_inline]] inline void close_top(Index bottom) const;

  template <Side kSide>
  [[gnu::always_inline]] inline Front& front() {
    return kSide == Side::kLeft ? left_ : right_;
  }
  [[gnu::always_inline]] inline Apex apex(Index vertex, const Point& base_end) const;
  [[gnu::always_inline]] inline bool is_below(const Point& left, const Point& right, Index candidate) const;
  [[gnu::always_inline]] inline bool is_above_base(Apex& apex) const;
  [[gnu::always_inline]] inline bool is_in_circle(const Apex& inner, const Apex& outer, double cross) const;
  template <Side kSide>
  [[gnu::always_inline]] inline void read_front();
  template <Side kSide>
  [[gnu::always_inline]] inline void read_behind();
  template <Side kSide>
  [[gnu::always_inline]] inline bool has_candidate();
  template <Side kSide>
  [[gnu::always_inline]] inline void flip();
  [[gnu::always_inline]] inline bool left_wins() const;
  [[gnu::always_inline]] inline void take_left();
  [[gnu::always_inline]] inline void take_right();

  Index* memory_;
  const Point* points_;
  const ExactLimits& limits_;
  Index l_ = 0;     ///< left end of the base
  Index r_ = 0;     ///< right end
  Index base_ = 0;  ///< half-edge r -> l of the triangle under the base
  Front left_;
  Front right_;
  Point left_end_{};  ///< l
  Point right_end_{};
  Vector base_from_l_{};  ///< r - l
  double squared_base_ = 0;
  Index lower_left_ = 0;
};

/// From the vertices of two hulls that face each other, walks down to the edge below which neither hull has a
/// point. Collinear points beyond the ends are left where they are: the strict test keeps the edge as short
/// as possible.
///
/// A round walks the left end down, then the right one. Only the right one's steps ask for another round:
/// they change the edge after the left end was tested, while the left one's are followed by the right one's
/// tests in the same round. A left half that is a single point has nowhere to go.
void Merge::find_lower_tangent(HullVertex& left, HullVertex& right) const {
  Point left_end = points_[left.vertex];
  Point right_end = points_[right.vertex];
  for (bool right_moved = true; right_moved;) {
    right_moved = false;
    if (left.ghost != kNone) {
      for (;;) {
        const Index ghost = twin(std::size_t{left.ghost} + 1) - 2;  // of the edge that arrives
        const Index candidate = origin(std::size_t{ghost} + 1);
        if (!is_below(left_end, right_end, candidate)) break;
        left = {candidate, ghost};
        left_end = points_[candidate];
      }
    }
    if (right.ghost != kNone) {
      for (;;) {
        const Index candidate = origin(right.ghost);
        if (!is_below(left_end, right_end, candidate)) break;
        right = {candidate, twin(std::size_t{right.ghost} + 2) - 1};
        right_end = points_[candidate];
        right_moved = true;
      }
    }
    if (left.ghost == kNone) right_moved = false;
  }
}

/// orient2d(left, right, candidate) < 0.
bool Merge::is_below(const Point& left, const Point& right, Index candidate) const {
  const Point& p = points_[candidate];
  const double one = (left.x - p.x) * (right.y - p.y);
  const double other = (left.y - p.y) * (right.x - p.x);
  const double magnitude = std::abs(one) + std::abs(other);
  if (std::abs(one - other) > kOrientBound * magnitude || magnitude < limits_.orient2d) [[likely]]
    return one < other;
  return orient2d_exact(left, right, p) < 0;
}

/// The ghost (r, l, infinity) under the lower tangent l - r.
void Merge::open_bottom(const HullVertex& left, const HullVertex& right, Index bottom) {
  l_ = left.vertex;
  r_ = right.vertex;
  left_end_ = points_[l_];
  right_end_ = points_[r_];
  base_ = bottom;
  write_ghost(memory_, bottom, l_, r_);
  if (left.ghost != kNone) {
    left_.ghost = left.ghost;
    bond(bottom + 1, twin(std::size_t{left.ghost} + 1));
    read_front<Side::kLeft>();
  }
  if (right.ghost != kNone) {
    right_.ghost = twin(std::size_t{right.ghost} + 1) - 2;
    bond(bottom + 2, right.ghost + 1);
    read_front<Side::kRight>();
  }
}

/// The ghost (l, r, infinity) over the upper tangent, to which the base has risen.
void Merge::close_top(Index bottom) const {
  const Index top = bottom + Mesh::kStride;
  write_ghost(memory_, top, r_, l_);
  bond(top, base_);
  bond(top + 1, right_.ghost == kNone ? bottom + 2 : right_.ghost + 2);
  bond(top + 2, left_.ghost == kNone ? bottom + 1 : left_.ghost + 1);
}

void Merge::close_gap() {
  for (;;) {
    base_from_l_ = right_end_ - left_end_;
    squared_base_ = squared_length(base_from_l_);
    const bool left = left_.ghost != kNone && has_candidate<Side::kLeft>();
    const bool right = right_.ghost != kNone && has_candidate<Side::kRight>();
    if (!left && !right) return;
    if (!right || (left && left_wins())) {
      take_left();
    } else {
      take_right();
    }
  }
}

Apex Merge::apex(Index vertex, const Point& base_end) const {
  Apex result;
  result.vertex = vertex;
  result.offset = points_[vertex] - base_end;
  result.squared = squared_length(result.offset);
  return result;
}

/// orient2d(l, r, apex) > 0, from what the apex already knows where its sign is certain. Seen from either end
/// of the base it is the cross product of base and offset.
bool Merge::is_above_base(Apex& apex) const {
  const double one = base_from_l_.x * apex.offset.y;
  const double other = base_from_l_.y * apex.offset.x;
  apex.over_base = one - other;
  const double magnitude = std::abs(one) + std::abs(other);
  if (std::abs(apex.over_base) > kOrientBound * magnitude || magnitude < limits_.orient2d) [[likely]]
    return apex.over_base > 0;
  return orient2d_exact(points_[l_], points_[r_], points_[apex.vertex]) > 0;
}

/// Whether `outer` is inside the circle of l, r and `inner`, ties decided as is_in_circle_exact does. `inner`
/// lies above the base, both apexes are seen from one end of the base, and `cross` is the cross product of
/// their offsets, mirrored on the right side.
///
/// With u the base, v and w the offsets, the determinant with its origin at that end of the base is
/// |v|^2 (u x w) - |w|^2 (u x v) - |u|^2 (v x w). Its error bound is that of incircle_fast with something
/// larger and cheaper in place of the permanent: the two products of a cross product v x w are together at
/// most |v| |w| <= (|v|^2 + |w|^2) / 2, so the permanent is at most the sum of the products of two of the
/// three squares, which is at most a third of the square of their sum. 4 instead of 10 / 3 leaves room for
/// the rounding of that sum.
bool Merge::is_in_circle(const Apex& inner, const Apex& outer, double cross) const {
  const double determinant =
      inner.squared * outer.over_base - outer.squared * inner.over_base - squared_base_ * cross;
  const double sum = squared_base_ + inner.squared + outer.squared;
  const double magnitude = sum * sum;
  if (std::abs(determinant) > 4 * kEpsilon * magnitude) [[likely]]
    return determinant > 0;
  if (magnitude < limits_.incircle && determinant != 0) return determinant > 0;
  return is_in_circle_exact(points_[l_], points_[r_], points_[inner.vertex], points_[outer.vertex],
                            magnitude < limits_.incircle);
}

/// After the base's end on this side has moved to the next ghost.
template <Side kSide>
void Merge::read_front() {
  Front& front = this->front<kSide>();
  constexpr std::size_t kFar = kSide == Side::kLeft ? 0 : 1;  // (l2, l, infinity) or (r, r2, infinity)
  front.candidate = apex(origin(front.ghost + kFar), kSide == Side::kLeft ? left_end_ : right_end_);
  front.inner = twin(front.ghost);
  read_behind<kSide>();
}

template <Side kSide>
void Merge::read_behind() {
  Front& front = this->front<kSide>();
  const Index vertex = origin(Mesh::previous(front.inner));
  if (vertex == kNone) {
    front.behind.vertex = kNone;
    return;
  }
  front.behind = apex(vertex, kSide == Side::kLeft ? left_end_ : right_end_);
  front.cross = kSide == Side::kLeft ? cross(front.candidate.offset, front.behind.offset)
                                     : cross(front.behind.offset, front.candidate.offset);
}

/// Whether one half offers an apex for the triangle on the base: its next hull vertex, once the edges that
/// this triangle's circle forbids are flipped away, unless that vertex does not lie above the base.
template <Side kSide>
bool Merge::has_candidate() {
  Front& front = this->front<kSide>();
  if (!is_above_base(front.candidate)) return false;
  while (front.behind.vertex != kNone) {
    front.behind.over_base = cross(base_from_l_, front.behind.offset);
    if (!is_in_circle(front.candidate, front.behind, front.cross)) break;
    flip<kSide>();
  }
  return true;
}

/// Left half: the triangle (l, l2, x) behind the hull edge l - l2 and the ghost (l2, l, infinity) become the
/// ghosts (l2, x, infinity) and (x, l, infinity), and x is the next candidate. Right half: the triangle (r2,
/// r, x) and the ghost (r, r2, infinity) become (x, r2, infinity) and (r, x, infinity).
template <Side kSide>
void Merge::flip() {
  constexpr bool kLeft = kSide == Side::kLeft;
  Front& front = this->front<kSide>();
  const Index ghost = front.ghost;
  const Index far_ghost = front.inner & ~(Mesh::kStride - 1);
  const Index after = twin(Mesh::next(front.inner));       // outside l2 -> x or r -> x
  const Index before = twin(Mesh::previous(front.inner));  // outside x -> l or x -> r2
  const Index x = front.behind.vertex;
  write_ghost(memory_, far_ghost, kLeft ? x : front.candidate.vertex, kLeft ? front.candidate.vertex : x);
  bond(far_ghost, kLeft ? after : before);
  if constexpr (kLeft) {
    bond(far_ghost + 2, twin(std::size_t{ghost} + 2));
    bond(far_ghost + 1, ghost + 2);
    origin(ghost) = x;
  } else {
    bond(far_ghost + 1, twin(std::size_t{ghost} + 1));
    bond(far_ghost + 2, ghost + 1);
    origin(std::size_t{ghost} + 1) = x;
  }
  front.inner = kLeft ? before : after;
  bond(ghost, front.inner);
  front.candidate = front.behind;
  read_behind<kSide>();
}

/// Whether the right candidate lies outside, or on, the circle of the base and the left one.
bool Merge::left_wins() const {
  Apex right = apex(right_.candidate.vertex, left_end_);
  right.over_base = cross(base_from_l_, right.offset);
  return !is_in_circle(left_.candidate, right, cross(left_.candidate.offset, right.offset));
}

/// The ghost (l2, l, infinity) becomes the triangle (l2, l, r).
void Merge::take_left() {
  const Index ghost = left_.ghost;
  origin(std::size_t{ghost} + 2) = r_;
  bond(ghost + 1, base_);
  base_ = ghost + 2;
  l_ = left_.candidate.vertex;
  left_end_ = points_[l_];
  left_.ghost = twin(std::size_t{ghost} + 2) - 1;
  read_front<Side::kLeft>();
}

/// The ghost (r, r2, infinity) becomes the triangle (r, r2, l).
void Merge::take_right() {
  const Index ghost = right_.ghost;
  origin(std::size_t{ghost} + 2) = l_;
  bond(ghost + 2, base_);
  base_ = ghost + 1;
  r_ = right_.candidate.vertex;
  right_end_ = points_[r_];
  right_.ghost = twin(std::size_t{ghost} + 1) - 2;
  read_front<Side::kRight>();
}

/// The edge a - b with a ghost on either side, in two records.
void join_points(Mesh& mesh, Index a, Index b, Index first_record) {
  const Index second_record = first_record + Mesh::kStride;
  mesh.bond(first_record, second_record);
  mesh.bond(first_record + 1, second_record + 2);
  mesh.bond(first_record + 2, second_record + 1);
  write_ghost(mesh.memory(), first_record, a, b);
  write_ghost(mesh.memory(), second_record, b, a);
}

HullVertex choose(bool first, const HullVertex& a, const HullVertex& b) {
  return {first ? a.vertex : b.vertex, first ? a.ghost : b.ghost};
}

}  // namespace

Hull join_triangle(Mesh& mesh, const Point* points, Index a, Index b, Index c, Index first_record) {
  const std::array<Index, 3> vertices{a, b, c};
  std::array<HullVertex, 3> hull;
  for (Index k = 0; k < 3; ++k) {
    const Index next = k == 2 ? 0 : k + 1;
    const Index ghost = first_record + Mesh::kStride * (k + 1);
    const Index next_ghost = first_record + Mesh::kStride * (next + 1);
    mesh.origin(first_record + k) = vertices[k];
    write_ghost(mesh.memory(), ghost, vertices[k], vertices[next]);
    mesh.bond(first_record + k, ghost);
    mesh.bond(ghost + 2, next_ghost + 1);
    hull[k] = {vertices[k], ghost};
  }
  const auto first_of = [&](auto less) {
    const HullVertex& one = choose(less(points[a], points[b]), hull[0], hull[1]);
    return choose(less(points[one.vertex], points[c]), one, hull[2]);
  };
  const auto greater_by_x = [](const Point& p, const Point& q) { return less_by_x(q, p); };
  const auto greater_by_y = [](const Point& p, const Point& q) { return less_by_y(q, p); };
  return {first_of(less_by_x), first_of(greater_by_x), first_of(less_by_y), first_of(greater_by_y)};
}

Hull merge_hulls(Mesh& mesh, const Point* points, const ExactLimits& limits, const Hull& before,
                 const Hull& after, Index first_record, Axis axis) {
  Index lower_left = before.left.vertex;
  Index upper_right = after.left.vertex;
  if (before.is_point() && after.is_point()) {
    join_points(mesh, lower_left, upper_right, first_record);
  } else {
    Merge merge(mesh, points, limits);
    if (axis == Axis::kX) {
      merge.run(before.right, after.left, first_record);
    } else {
      merge.run(before.top, after.bottom, first_record);
    }
    lower_left = merge.lower_left();
    upper_right = merge.upper_right();
  }

  // An extreme vertex of the whole is one of a half, and its ghost stays unless a tangent leaves it.
  const auto less_x = [&](const HullVertex& a, const HullVertex& b) {
    return less_by_x(points[a.vertex], points[b.vertex]);
  };
  const auto less_y = [&](const HullVertex& a, const HullVertex& b) {
    return less_by_y(points[a.vertex], points[b.vertex]);
  };
  Hull hull;
  if (axis == Axis::kX) {
    hull.left = before.left;
    hull.right = after.right;
    hull.bottom = choose(less_y(before.bottom, after.bottom), before.bottom, after.bottom);
    hull.top = choose(less_y(before.top, after.top), after.top, before.top);
  } else {
    hull.bottom = before.bottom;
    hull.top = after.top;
    hull.left = choose(less_x(before.left, after.left), before.left, after.left);
    hull.right = choose(less_x(before.right, after.right), after.right, before.right);
  }
  for (HullVertex* extreme : {&hull.left, &hull.right, &hull.bottom, &hull.top}) {
    Index ghost = extreme->ghost;
    if (extreme->vertex == lower_left) ghost = first_record;
    if (extreme->vertex == upper_right) ghost = first_record + Mesh::kStride;
    extreme->ghost = ghost;
  }
  return hull;
}

}  // namespace polylidar::detail
