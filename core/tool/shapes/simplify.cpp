#include "tool/shapes/simplify.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <queue>
#include <tuple>
#include <vector>

#include "polylidar/predicates.hpp"

namespace polylidar::tool {
namespace {

double distance(const Point& a, const Point& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

double distance_to_segment(const Point& p, const Point& a, const Point& b) {
  const double length = distance(a, b);
  if (length == 0) return distance(p, a);
  const Point along = {(b.x - a.x) / length, (b.y - a.y) / length};
  const double t = std::clamp((p.x - a.x) * along.x + (p.y - a.y) * along.y, 0.0, length);
  return distance(p, {a.x + t * along.x, a.y + t * along.y});
}

/// A vertex of some ring. Indices are into Simplifier::vertices_, where a ring is one stretch in order.
struct Vertex {
  Point place;
  std::uint32_t point = 0;  ///< index into the points
  std::uint32_t before = 0;
  std::uint32_t behind = 0;
  std::uint32_t ring = 0;
  std::uint32_t version = 0;  ///< one more for each change of its neighbours
  bool is_left_out = false;
  double error = 0;  ///< at least the displacement of what was left out between it and `behind`
};

struct RingPlace {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
  std::uint32_t left = 0;  ///< vertices that are not left out
};

/// The vertices that are not left out, by place.
class VertexGrid {
 public:
  explicit VertexGrid(const std::vector<Vertex>& vertices) {
    std::vector<Point> places;
    places.reserve(vertices.size());
    for (const Vertex& vertex : vertices) places.push_back(vertex.place);
    box_ = bounding_box(places);
    side_ = std::max<std::size_t>(1, static_cast<std::size_t>(std::sqrt(static_cast<double>(places.size()))));
    cells_.resize(side_ * side_);
    for (std::uint32_t v = 0; v < vertices.size(); ++v) cell(places[v]).push_back(v);
  }

  void remove(std::uint32_t v, const Point& place) { std::erase(cell(place), v); }

  /// Whether `found` is true of a vertex in the cells that the box of a, b and c meets.
  template <class Found>
  bool any_near(const Point& a, const Point& b, const Point& c, const Found& found) const {
    const Box box = bounding_box(std::vector<Point>{a, b, c});
    for (std::size_t row = row_of(box.min.y); row <= row_of(box.max.y); ++row) {
      for (std::size_t column = column_of(box.min.x); column <= column_of(box.max.x); ++column) {
        const auto& vertices = cells_[row * side_ + column];
        if (std::any_of(vertices.begin(), vertices.end(), found)) return true;
      }
    }
    return false;
  }

 private:
  /// Never decreases with `value`, so that what is between two values is between their cells.
  std::size_t cell_of(double value, double least, double most) const {
    // Halves, since the whole of -1e308 to 1e308 is infinite. Half of the least number above 0 is 0.
    const double half_width = most / 2 - least / 2;
    const double share = half_width > 0 ? (value / 2 - least / 2) / half_width : 0;
    return std::min(side_ - 1, static_cast<std::size_t>(share * static_cast<double>(side_)));
  }
  std::size_t column_of(double x) const { return cell_of(x, box_.min.x, box_.max.x); }
  std::size_t row_of(double y) const { return cell_of(y, box_.min.y, box_.max.y); }
  std::vector<std::uint32_t>& cell(const Point& p) { return cells_[row_of(p.y) * side_ + column_of(p.x)]; }

  Box box_{};
  std::size_t side_ = 1;
  std::vector<std::vector<std::uint32_t>> cells_;  ///< row by row
};

class Simplifier {
 public:
  Simplifier(const IndexShape& shape, std::span<const Point> points, double tolerance)
      : tolerance_(tolerance), vertices_(vertices_of(shape, points)), grid_(vertices_) {}

  IndexShape run(const IndexShape& shape) {
    for (std::uint32_t v = 0; v < vertices_.size(); ++v) consider(v);
    while (!waiting_.empty()) {
      const auto [displacement, v, version] = waiting_.top();
      waiting_.pop();
      if (vertices_[v].is_left_out || vertices_[v].version != version) continue;
      if (rings_[vertices_[v].ring].left > 3 && !is_in_the_way(v)) leave_out(v, displacement);
    }
    IndexShape simple(shape.size());
    std::size_t ring = 0;
    for (std::size_t p = 0; p < shape.size(); ++p) {
      simple[p].shell = rest_of(rings_[ring++]);
      for (std::size_t h = 0; h < shape[p].holes.size(); ++h)
        simple[p].holes.push_back(rest_of(rings_[ring++]));
    }
    return simple;
  }

 private:
  /// Displacement, vertex, its version then: the least displacement on top, of equal ones the first vertex.
  using Waiting = std::tuple<double, std::uint32_t, std::uint32_t>;

  std::vector<Vertex> vertices_of(const IndexShape& shape, std::span<const Point> points) {
    std::vector<Vertex> vertices;
    const auto add = [&](const IndexRing& ring) {
      const auto begin = static_cast<std::uint32_t>(vertices.size());
      const auto size = static_cast<std::uint32_t>(ring.size());
      for (std::uint32_t i = 0; i < size; ++i) {
        vertices.push_back({.place = points[ring[i]],
                            .point = ring[i],
                            .before = begin + (i + size - 1) % size,
                            .behind = begin + (i + 1) % size,
                            .ring = static_cast<std::uint32_t>(rings_.size())});
      }
      rings_.push_back({begin, begin + size, size});
    };
    for (const IndexPolygon& polygon : shape) {
      add(polygon.shell);
      for (const IndexRing& hole : polygon.holes) add(hole);
    }
    return vertices;
  }

  /// Puts a vertex into the queue if it may be left out as far as distances tell.
  void consider(std::uint32_t v) {
    const Vertex& b = vertices_[v];
    const Vertex& a = vertices_[b.before];
    const Vertex& c = vertices_[b.behind];
    // Every place on the two old segments is no further from the new one than b is.
    double displacement = std::max(a.error, b.error) + distance_to_segment(b.place, a.place, c.place);
    if (!(displacement <= tolerance_)) {
      displacement = largest_displacement(b.before, b.behind);
      if (!(displacement <= tolerance_)) return;
    }
    waiting_.emplace(displacement, v, b.version);
  }

  /// Of the ring's own vertices between two of them, left out or not, to the segment that joins the two.
  double largest_displacement(std::uint32_t from, std::uint32_t to) const {
    const RingPlace& ring = rings_[vertices_[from].ring];
    double largest = 0;
    for (std::uint32_t v = from;;) {
      v = v + 1 == ring.end ? ring.begin : v + 1;
      if (v == to) return largest;
      const double d = distance_to_segment(vertices_[v].place, vertices_[from].place, vertices_[to].place);
      if (!(d <= tolerance_)) return d;
      largest = std::max(largest, d);
    }
  }

  /// Whether another vertex keeps v where it is.
  bool is_in_the_way(std::uint32_t v) const {
    const std::uint32_t before = vertices_[v].before;
    const std::uint32_t behind = vertices_[v].behind;
    const Point& a = vertices_[before].place;
    const Point& b = vertices_[v].place;
    const Point& c = vertices_[behind].place;
    const double turn = orient2d(a, b, c);
    return grid_.any_near(a, b, c, [&](std::uint32_t other) {
      if (other == v || other == before || other == behind) return false;
      const Point& p = vertices_[other].place;
      if (p == a) return runs_along(other, a, c);
      if (p == c) return runs_along(other, c, a);
      if (turn == 0) return orient2d(a, c, p) == 0 && is_between(p, a, c);
      const double side = turn > 0 ? 1 : -1;
      return side * orient2d(a, b, p) >= 0 && side * orient2d(b, c, p) >= 0 && side * orient2d(c, a, p) >= 0;
    });
  }

  /// Whether an edge of the vertex `other`, which is at `from`, lies on the way from there to `to`.
  bool runs_along(std::uint32_t other, const Point& from, const Point& to) const {
    for (const std::uint32_t neighbour : {vertices_[other].before, vertices_[other].behind}) {
      const Point& p = vertices_[neighbour].place;
      if (orient2d(from, to, p) == 0 && (is_between(p, from, to) || is_between(to, from, p))) return true;
    }
    return false;
  }

  /// Of three on a line.
  static bool is_between(const Point& p, const Point& a, const Point& b) {
    return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
           p.y <= std::max(a.y, b.y);
  }

  void leave_out(std::uint32_t v, double displacement) {
    Vertex& vertex = vertices_[v];
    vertex.is_left_out = true;
    --rings_[vertex.ring].left;
    grid_.remove(v, vertex.place);
    vertices_[vertex.before].behind = vertex.behind;
    vertices_[vertex.before].error = displacement;
    vertices_[vertex.behind].before = vertex.before;
    for (const std::uint32_t neighbour : {vertex.before, vertex.behind}) {
      ++vertices_[neighbour].version;
      consider(neighbour);
    }
  }

  IndexRing rest_of(const RingPlace& ring) const {
    IndexRing rest;
    for (std::uint32_t v = ring.begin; v < ring.end; ++v) {
      if (!vertices_[v].is_left_out) rest.push_back(vertices_[v].point);
    }
    return rest;
  }

  double tolerance_;
  std::vector<RingPlace> rings_;  ///< polygon by polygon, the shell first
  std::vector<Vertex> vertices_;
  VertexGrid grid_;
  std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> waiting_;
};

}  // namespace

IndexShape simplify(const IndexShape& shape, std::span<const Point> points, double tolerance) {
  return Simplifier(shape, points, tolerance).run(shape);
}

}  // namespace polylidar::tool
