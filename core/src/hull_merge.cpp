#include "hull_merge.hpp"

#include <array>
#include <cmath>

#include "predicates_inline.hpp"

namespace polylidar::detail {

namespace {

using Index = Mesh::Index;

enum class Side : std::uint8_t { kLeft, kRight };

struct Vector {
  double x;
  double y;
};

Vector operator-(const Point& a, const Point& b) {
  return {a.x - b.x, a.y - b.y};
}
double squared(const Vector& v) {
  return v.x * v.x + v.y * v.y;
}

/// Cross product, mirrored for the right side, where everything turns the other way.
template <Side kSide>
double cross(const Vector& a, const Vector& b) {
  return kSide == Side::kLeft ? a.x * b.y - a.y * b.x : b.x * a.y - b.y * a.x;
}

/// A point as seen from the end of the base on its own side, which is the origin of the predicates'
/// arithmetic there: what one test has computed serves the next.
struct Apex {
  Index vertex = kNone;  ///< kNone: there is none
  Vector offset{};       ///< from the origin
  double squared = 0;    ///< of the offset's length
  double over_base = 0;  ///< twice the area of the triangle on the base: positive above it
};

/// One merge. Directions in the names are those of halves to the left and the right of a vertical line; but
/// for the vertices from which the search for the lower tangent starts, nothing depends on the line's
/// direction.
///
/// From the lower tangent upwards, `base_` is the topmost edge that joins the halves. The next triangle
/// stands on it with its apex at the next hull vertex of one half, of which the edges that the empty circle
/// forbids have been flipped away (Guibas and Stolfi 1985, section 6).
class Merge {
 public:
  Merge(Mesh& mesh, const Point* points, const ExactLimits& limits)
      : mesh_(mesh), points_(points), limits_(limits) {}

  Hull run(const Hull& left_half, const Hull& right_half, Index first_record, Axis axis) {
    // Halves of a cell are mostly cut across each other: seen from this cut, the last one's tangents lie in
    // front and behind.
    HullVertex left = axis == Axis::kX ? left_half.lower : left_half.upper;
    HullVertex right = axis == Axis::kX ? right_half.upper : right_half.lower;
    move_to_extreme(left, axis, true);
    move_to_extreme(right, axis, false);
    find_lower_tangent(left, right);
    open_bottom(left, right, first_record);
    close_gap();
    close_top(first_record);
    return {{left.vertex, first_record + 1}, {r_, first_record + Mesh::kStride + 1}};
  }

 private:
  Index next_on_hull(Index to_infinity) const { return mesh_.twin(Mesh::next(to_infinity)); }
  Index previous_on_hull(Index to_infinity) const { return Mesh::previous(mesh_.twin(to_infinity)); }

  void move_to_extreme(HullVertex& hull, Axis axis, bool greatest) const;
  void find_lower_tangent(HullVertex& left, HullVertex& right) const;
  void open_bottom(const HullVertex& left, const HullVertex& right, Index bottom);
  void close_gap();
  void close_top(Index bottom);

  template <Side kSide>
  Apex apex(Index vertex) const;
  template <Side kSide>
  double over_base(const Apex& apex) const;
  double orient2d(const Point& a, const Point& b, const Point& c) const;
  double incircle(const Apex& inner, const Apex& outer, double cross) const;
  template <Side kSide>
  Apex find_candidate();
  bool left_wins(const Apex& left, const Apex& right) const;
  void take_left(Index vertex);
  void take_right(Index vertex);

  Mesh& mesh_;
  const Point* points_;
  const ExactLimits& limits_;
  Index l_ = 0;                ///< left end of the base
  Index r_ = 0;                ///< right end
  Index base_ = 0;             ///< half-edge r -> l of the triangle under the base
  Index left_ghost_ = kNone;   ///< l -> infinity, in the ghost over the hull edge that rises from l
  Index right_ghost_ = kNone;  ///< infinity -> r, in the ghost over the hull edge that comes down to r
  Vector base_from_l_{};       ///< r - l
  double squared_base_ = 0;
};

/// Moves `hull` to its least or greatest vertex along `axis`. Coordinates along a convex polygon rise and
/// fall once, and ties are broken by the other axis.
void Merge::move_to_extreme(HullVertex& hull, Axis axis, bool greatest) const {
  if (hull.to_infinity == kNone) return;
  const auto better = [&](Index candidate, Index current) {
    const Point& a = points_[greatest ? current : candidate];
    const Point& b = points_[greatest ? candidate : current];
    return axis == Axis::kX ? a.x < b.x || (a.x == b.x && a.y < b.y) : a.y < b.y || (a.y == b.y && a.x < b.x);
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
void Merge::find_lower_tangent(HullVertex& left, HullVertex& right) const {
  const auto is_below = [&](Index candidate) {
    return orient2d(points_[left.vertex], points_[right.vertex], points_[candidate]) < 0;
  };
  for (bool moved = true; moved;) {
    moved = false;
    if (left.to_infinity != kNone) {
      for (Index e = previous_on_hull(left.to_infinity); is_below(mesh_.origin(e)); e = previous_on_hull(e)) {
        left = {mesh_.origin(e), e};
      }
    }
    if (right.to_infinity != kNone) {
      for (Index e = next_on_hull(right.to_infinity); is_below(mesh_.origin(e)); e = next_on_hull(e)) {
        right = {mesh_.origin(e), e};
        moved = true;
      }
    }
    if (left.to_infinity == kNone) moved = false;
  }
}

/// The ghost (r, l, infinity) under the lower tangent l - r.
void Merge::open_bottom(const HullVertex& left, const HullVertex& right, Index bottom) {
  l_ = left.vertex;
  r_ = right.vertex;
  base_ = bottom;
  mesh_.origin(bottom) = r_;
  mesh_.origin(bottom + 1) = l_;
  mesh_.origin(bottom + 2) = kNone;
  if (left.to_infinity != kNone) {
    left_ghost_ = left.to_infinity;
    mesh_.bond(bottom + 1, mesh_.twin(left_ghost_));
  }
  if (right.to_infinity != kNone) {
    right_ghost_ = mesh_.twin(right.to_infinity);
    mesh_.bond(bottom + 2, right.to_infinity);
  }
}

/// The ghost (l, r, infinity) over the upper tangent, to which the base has risen.
void Merge::close_top(Index bottom) {
  const Index top = bottom + Mesh::kStride;
  mesh_.origin(top) = l_;
  mesh_.origin(top + 1) = r_;
  mesh_.origin(top + 2) = kNone;
  mesh_.bond(top, base_);
  mesh_.bond(top + 1, right_ghost_ == kNone ? bottom + 2 : right_ghost_);
  mesh_.bond(top + 2, left_ghost_ == kNone ? bottom + 1 : left_ghost_);
}

void Merge::close_gap() {
  for (;;) {
    base_from_l_ = points_[r_] - points_[l_];
    squared_base_ = squared(base_from_l_);
    const Apex left = left_ghost_ != kNone ? find_candidate<Side::kLeft>() : Apex{};
    const Apex right = right_ghost_ != kNone ? find_candidate<Side::kRight>() : Apex{};
    if (left.vertex == kNone && right.vertex == kNone) return;
    if (right.vertex == kNone || (left.vertex != kNone && left_wins(left, right))) {
      take_left(left.vertex);
    } else {
      take_right(right.vertex);
    }
  }
}

template <Side kSide>
Apex Merge::apex(Index vertex) const {
  Apex result;
  result.vertex = vertex;
  result.offset = points_[vertex] - points_[kSide == Side::kLeft ? l_ : r_];
  result.squared = squared(result.offset);
  const Vector base = kSide == Side::kLeft ? base_from_l_ : Vector{-base_from_l_.x, -base_from_l_.y};
  result.over_base = cross<kSide>(base, result.offset);
  return result;
}

double Merge::orient2d(const Point& a, const Point& b, const Point& c) const {
  const double left = (a.x - c.x) * (b.y - c.y);
  const double right = (a.y - c.y) * (b.x - c.x);
  const double magnitude = std::abs(left) + std::abs(right);
  if (std::abs(left - right) > kOrientBound * magnitude || magnitude < limits_.orient2d) [[likely]]
    return left - right;
  return orient2d_exact(a, b, c);
}

/// orient2d(l, r, apex), from what the apex already knows where its sign is certain.
template <Side kSide>
double Merge::over_base(const Apex& apex) const {
  const double magnitude =
      std::abs(base_from_l_.x * apex.offset.y) + std::abs(base_from_l_.y * apex.offset.x);
  if (std::abs(apex.over_base) > kOrientBound * magnitude || magnitude < limits_.orient2d) [[likely]]
    return apex.over_base;
  return orient2d_exact(points_[l_], points_[r_], points_[apex.vertex]);
}

/// incircle(l, r, inner, outer), where `inner` lies above the base, both apexes are seen from one end of the
/// base, and `cross` is the cross product of their offsets on that side.
///
/// With u the base, v and w the offsets, the determinant with its origin at that end of the base is
/// |v|^2 (u x w) - |w|^2 (u x v) - |u|^2 (v x w). Its error bound is that of incircle_fast with something
/// larger and cheaper in place of the permanent: the two products of a cross product v x w are together at
/// most |v| |w| <= (|v|^2 + |w|^2) / 2, so the permanent is at most the sum of the products of two of the
/// three squares, which is at most a third of the square of their sum. 4 instead of 10 / 3 leaves room for
/// the rounding of that sum.
double Merge::incircle(const Apex& inner, const Apex& outer, double cross) const {
  const double determinant =
      inner.squared * outer.over_base - outer.squared * inner.over_base - squared_base_ * cross;
  const double sum = squared_base_ + inner.squared + outer.squared;
  const double magnitude = sum * sum;
  if (std::abs(determinant) > 4 * kEpsilon * magnitude || magnitude < limits_.incircle) [[likely]]
    return determinant;
  return incircle_exact(points_[l_], points_[r_], points_[inner.vertex], points_[outer.vertex]);
}

/// The apex that one half offers for the triangle on the base: its next hull vertex once the edges that this
/// triangle's circle forbids are flipped away. None when that vertex does not lie above the base.
///
/// Said of the left half: the triangle (l, l2, x) behind the hull edge l - l2 and the ghost (l2, l, infinity)
/// become the ghosts (l2, x, infinity) and (x, l, infinity), and x is the next candidate. The right half is
/// its mirror image.
template <Side kSide>
Apex Merge::find_candidate() {
  constexpr bool kLeft = kSide == Side::kLeft;
  const Index ghost = kLeft ? left_ghost_ : right_ghost_;
  const Index hull_edge = kLeft ? Mesh::previous(ghost) : Mesh::next(ghost);  // l2 -> l or r -> r2
  const Index far_edge =
      kLeft ? Mesh::next(ghost) : Mesh::previous(ghost);  // infinity -> l2 or r2 -> infinity
  Index& far_vertex = mesh_.origin(kLeft ? hull_edge : far_edge);
  Apex candidate = apex<kSide>(far_vertex);
  if (over_base<kSide>(candidate) <= 0) return {};
  for (;;) {
    const Index inner = mesh_.twin(hull_edge);  // l -> l2 or r2 -> r
    const Index before = Mesh::previous(inner);
    const Index x = mesh_.origin(before);
    if (x == kNone) return candidate;
    const Apex next = apex<kSide>(x);
    if (incircle(candidate, next, cross<kSide>(candidate.offset, next.offset)) <= 0) return candidate;
    const Index beyond = mesh_.twin(far_edge);
    const Index after = Mesh::next(inner);
    far_vertex = x;
    mesh_.bond(hull_edge, mesh_.twin(kLeft ? before : after));
    mesh_.origin(kLeft ? inner : after) = kNone;
    mesh_.bond(inner, beyond);
    mesh_.bond(kLeft ? before : after, far_edge);
    candidate = next;
  }
}

/// Whether the right candidate lies outside, or on, the circle of the base and the left one.
bool Merge::left_wins(const Apex& left, const Apex& right) const {
  const Apex from_left = apex<Side::kLeft>(right.vertex);
  return incircle(left, from_left, cross<Side::kLeft>(left.offset, from_left.offset)) <= 0;
}

/// The ghost (l2, l, infinity) becomes the triangle (l2, l, r).
void Merge::take_left(Index vertex) {
  const Index infinity = Mesh::next(left_ghost_);
  const Index next_ghost = mesh_.twin(infinity);
  mesh_.origin(infinity) = r_;
  mesh_.bond(left_ghost_, base_);
  base_ = infinity;
  left_ghost_ = next_ghost;
  l_ = vertex;
}

/// The ghost (r, r2, infinity) becomes the triangle (r, r2, l).
void Merge::take_right(Index vertex) {
  const Index infinity = right_ghost_;
  const Index r2_to_infinity = Mesh::previous(infinity);
  const Index next_ghost = mesh_.twin(r2_to_infinity);
  mesh_.origin(infinity) = l_;
  mesh_.bond(infinity, base_);
  base_ = r2_to_infinity;
  right_ghost_ = next_ghost;
  r_ = vertex;
}

/// The edge a - b with a ghost on either side, in two records.
Hull join_points(Mesh& mesh, Index a, Index b, Index first_record) {
  const Index second_record = first_record + Mesh::kStride;
  mesh.origin(first_record) = b;
  mesh.origin(first_record + 1) = a;
  mesh.origin(first_record + 2) = kNone;
  mesh.origin(second_record) = a;
  mesh.origin(second_record + 1) = b;
  mesh.origin(second_record + 2) = kNone;
  mesh.bond(first_record, second_record);
  mesh.bond(first_record + 1, second_record + 2);
  mesh.bond(first_record + 2, second_record + 1);
  return {{a, first_record + 1}, {b, second_record + 1}};
}

}  // namespace

Hull join_triangle(Mesh& mesh, Index a, Index b, Index c, Index first_record) {
  const std::array<Index, 3> vertices{a, b, c};
  for (Index k = 0; k < 3; ++k) {
    const Index next = k == 2 ? 0 : k + 1;
    const Index ghost = first_record + Mesh::kStride * (k + 1);
    const Index next_ghost = first_record + Mesh::kStride * (next + 1);
    mesh.origin(first_record + k) = vertices[k];
    mesh.origin(ghost) = vertices[next];
    mesh.origin(ghost + 1) = vertices[k];
    mesh.origin(ghost + 2) = kNone;
    mesh.bond(first_record + k, ghost);
    mesh.bond(ghost + 2, next_ghost + 1);
  }
  return {{a, first_record + Mesh::kStride + 1}, {c, first_record + 3 * Mesh::kStride + 1}};
}

Hull merge_hulls(Mesh& mesh, const Point* points, const ExactLimits& limits, const Hull& left,
                 const Hull& right, Index first_record, Axis axis) {
  if (left.is_point() && right.is_point()) {
    return join_points(mesh, left.lower.vertex, right.lower.vertex, first_record);
  }
  return Merge(mesh, points, limits).run(left, right, first_record, axis);
}

}  // namespace polylidar::detail
