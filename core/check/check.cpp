#include "polylidar/check.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "polylidar/predicates.hpp"

namespace polylidar {

namespace {

using Index = std::uint32_t;

bool lexicographically_less(const Point& a, const Point& b) {
  return std::tie(a.x, a.y) < std::tie(b.x, b.y);
}

/// The points multiplied by a power of two that brings them into the range of the predicates.
std::vector<Point> in_predicate_range(std::span<const Point> points) {
  double largest = 0;
  for (const Point& p : points) largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
  const int shift = largest == 0 ? 0 : 149 - std::ilogb(largest);
  std::vector<Point> scaled(points.begin(), points.end());
  for (Point& p : scaled) p = {std::ldexp(p.x, shift), std::ldexp(p.y, shift)};
  return scaled;
}

/// For each point, the lowest index of an equal one.
std::vector<Index> representatives(const std::vector<Point>& points) {
  std::vector<Index> sorted(points.size());
  std::iota(sorted.begin(), sorted.end(), Index{0});
  std::sort(sorted.begin(), sorted.end(), [&](Index a, Index b) {
    return lexicographically_less(points[a], points[b]) || (points[a] == points[b] && a < b);
  });
  std::vector<Index> result(points.size());
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const bool repeats = i > 0 && points[sorted[i]] == points[sorted[i - 1]];
    result[sorted[i]] = repeats ? result[sorted[i - 1]] : sorted[i];
  }
  return result;
}

bool all_on_a_line(const std::vector<Point>& points) {
  if (points.empty()) return true;
  const auto [low, high] = std::minmax_element(points.begin(), points.end(), lexicographically_less);
  return std::all_of(points.begin(), points.end(),
                     [&, &a = *low, &b = *high](const Point& p) { return orient2d(a, b, p) == 0; });
}

std::string half_edge(std::size_t e) {
  return "half-edge " + std::to_string(e);
}

std::size_t next_in_triangle(std::size_t e) {
  return e % 3 == 2 ? e - 2 : e + 1;
}

class TriangulationCheck {
 public:
  TriangulationCheck(std::span<const Point> points, const Triangulation& triangulation)
      : points_(in_predicate_range(points)),
        triangles_(triangulation.triangles),
        twins_(triangulation.halfedges),
        representative_(representatives(points_)) {}

  std::string run() const {
    for (const auto step : {&TriangulationCheck::check_structure, &TriangulationCheck::check_vertices,
                            &TriangulationCheck::check_triangles, &TriangulationCheck::check_hull,
                            &TriangulationCheck::check_delaunay}) {
      if (std::string fault = (this->*step)(); !fault.empty()) return fault;
      if (triangles_.empty()) break;
    }
    return {};
  }

 private:
  const Point& at(std::size_t e) const { return points_[triangles_[e]]; }

  std::string check_structure() const {
    if (triangles_.size() % 3 != 0) return "the number of half-edges is not a multiple of 3";
    if (twins_.size() != triangles_.size()) return "triangles and halfedges differ in length";
    if (triangles_.empty()) {
      return all_on_a_line(points_) ? std::string() : "no triangles, though not all points lie on a line";
    }
    for (std::size_t e = 0; e < triangles_.size(); ++e) {
      if (triangles_[e] >= points_.size()) return half_edge(e) + " starts at no point";
      const Index twin = twins_[e];
      if (twin == kNone) continue;
      if (twin >= triangles_.size() || twins_[twin] != e) return half_edge(e) + " is not its twin's twin";
    }
    for (std::size_t e = 0; e < triangles_.size(); ++e) {
      const Index twin = twins_[e];
      if (twin != kNone && triangles_[twin] != triangles_[next_in_triangle(e)]) {
        return half_edge(e) + " and its twin do not join the same points";
      }
    }
    return {};
  }

  std::string check_vertices() const {
    std::vector<bool> used(points_.size());
    for (const Index vertex : triangles_) used[vertex] = true;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (used[i] != (representative_[i] == i)) {
        return "point " + std::to_string(i) +
               (used[i] ? " repeats an earlier one, but is used" : " is not used");
      }
    }
    return {};
  }

  std::string check_triangles() const {
    for (std::size_t e = 0; e < triangles_.size(); e += 3) {
      if (!(orient2d(at(e), at(e + 1), at(e + 2)) > 0)) {
        return "triangle " + std::to_string(e / 3) + " is not counter-clockwise";
      }
    }
    return {};
  }

  /// One closed convex chain of hull edges, and Euler's formula: with counter-clockwise triangles only a
  /// triangulation of the convex hull satisfies both.
  std::string check_hull() const {
    std::map<Index, std::size_t> leaving;  // vertex -> hull half-edge that starts there
    for (std::size_t e = 0; e < triangles_.size(); ++e) {
      if (twins_[e] != kNone) continue;
      if (!leaving.emplace(triangles_[e], e).second) return "two hull edges leave one point";
    }
    if (leaving.empty()) return "no hull";
    std::size_t length = 0;
    int turning_points = 0;  // where the chain stops going right or stops going left
    const std::size_t first = leaving.begin()->second;
    for (std::size_t e = first; length == 0 || e != first; ++length) {
      const auto next = leaving.find(triangles_[next_in_triangle(e)]);
      if (next == leaving.end() || length > leaving.size()) return "the hull is not a closed chain";
      const Point& a = at(e);
      const Point& b = at(next->second);
      const Point& c = at(next_in_triangle(next->second));
      if (orient2d(a, b, c) < 0) return "the hull is not convex at point " + std::to_string(next->first);
      if (lexicographically_less(a, b) != lexicographically_less(b, c)) ++turning_points;
      e = next->second;
    }
    if (length != leaving.size()) return "the hull is more than one chain";
    if (turning_points != 2) return "the hull winds more than once";
    std::size_t distinct = 0;
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (representative_[i] == i) ++distinct;
    if (triangles_.size() / 3 != 2 * distinct - 2 - length) return "Euler's formula does not hold";
    return {};
  }

  std::string check_delaunay() const {
    for (std::size_t e = 0; e < triangles_.size(); ++e) {
      const Index twin = twins_[e];
      if (twin == kNone) continue;
      const std::size_t second = next_in_triangle(e);
      const std::size_t third = next_in_triangle(second);
      const Point& opposite = at(next_in_triangle(next_in_triangle(twin)));
      if (incircle(at(e), at(second), at(third), opposite) > 0) return half_edge(e) + " is not Delaunay";
    }
    return {};
  }

  std::vector<Point> points_;
  const std::vector<Index>& triangles_;
  const std::vector<Index>& twins_;
  std::vector<Index> representative_;
};

struct Segment {
  Point a;
  Point b;
  std::size_t ring;
};

bool strictly_between(const Point& a, const Point& b, const Point& p) {
  return orient2d(a, b, p) == 0 && p != a && p != b &&
         lexicographically_less(std::min(a, b, lexicographically_less), p) &&
         lexicographically_less(p, std::max(a, b, lexicographically_less));
}

/// Whether two segments share anything but common end points.
bool intersect_badly(const Segment& s, const Segment& t) {
  if (strictly_between(s.a, s.b, t.a) || strictly_between(s.a, s.b, t.b) || strictly_between(t.a, t.b, s.a) ||
      strictly_between(t.a, t.b, s.b)) {
    return true;
  }
  if ((s.a == t.a && s.b == t.b) || (s.a == t.b && s.b == t.a)) return true;
  const auto side = [](const Segment& line, const Point& p) { return orient2d(line.a, line.b, p); };
  const auto opposite = [](double u, double v) { return (u > 0 && v < 0) || (u < 0 && v > 0); };
  return opposite(side(s, t.a), side(s, t.b)) && opposite(side(t, s.a), side(t, s.b));
}

class PolygonCheck {
 public:
  PolygonCheck(std::span<const Point> points, const IndexedMultiPolygon& shape)
      : points_(in_predicate_range(points)), shape_(shape) {}

  std::string run() {
    for (const auto step :
         {&PolygonCheck::collect_rings, &PolygonCheck::check_rings, &PolygonCheck::check_edges,
          &PolygonCheck::check_nesting, &PolygonCheck::check_connected}) {
      if (std::string fault = (this->*step)(); !fault.empty()) return fault;
    }
    return {};
  }

 private:
  struct CheckedRing {
    std::vector<Point> points;
    std::size_t polygon;
    bool is_shell;
  };

  std::string collect_rings() {
    std::size_t vertex = 0;
    std::size_t ring = 0;
    for (std::size_t p = 0; p < shape_.polygon_ends.size(); ++p) {
      const std::size_t first = ring;
      if (shape_.polygon_ends[p] <= ring || shape_.polygon_ends[p] > shape_.ring_ends.size()) {
        return "polygon " + std::to_string(p) + " has no rings or too many";
      }
      for (; ring < shape_.polygon_ends[p]; ++ring) {
        const std::size_t end = shape_.ring_ends[ring];
        if (end > shape_.vertices.size() || end < vertex + 3) {
          return "ring " + std::to_string(ring) + " has fewer than 3 vertices";
        }
        CheckedRing checked{{}, p, ring == first};
        for (; vertex < end; ++vertex) {
          if (shape_.vertices[vertex] >= points_.size())
            return "vertex " + std::to_string(vertex) + " is no point";
          checked.points.push_back(points_[shape_.vertices[vertex]]);
        }
        rings_.push_back(std::move(checked));
      }
    }
    if (ring != shape_.ring_ends.size() || vertex != shape_.vertices.size())
      return "vertices outside any polygon";
    return {};
  }

  std::string check_rings() {
    for (std::size_t r = 0; r < rings_.size(); ++r) {
      const std::vector<Point>& ring = rings_[r].points;
      std::vector<Point> sorted = ring;
      std::sort(sorted.begin(), sorted.end(), lexicographically_less);
      if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) {
        return "ring " + std::to_string(r) + " visits a point twice";
      }
      const auto least = std::min_element(ring.begin(), ring.end(), lexicographically_less);
      const auto i = static_cast<std::size_t>(least - ring.begin());
      const double turn =
          orient2d(ring[(i + ring.size() - 1) % ring.size()], *least, ring[(i + 1) % ring.size()]);
      if (rings_[r].is_shell ? !(turn > 0) : !(turn < 0)) {
        return "ring " + std::to_string(r) + " runs the wrong way round";
      }
    }
    return {};
  }

  std::string check_edges() {
    std::vector<Segment> segments;
    for (std::size_t r = 0; r < rings_.size(); ++r) {
      const std::vector<Point>& ring = rings_[r].points;
      for (std::size_t i = 0; i < ring.size(); ++i) {
        Segment segment{ring[i], ring[(i + 1) % ring.size()], r};
        if (lexicographically_less(segment.b, segment.a)) std::swap(segment.a, segment.b);
        segments.push_back(segment);
      }
    }
    std::sort(segments.begin(), segments.end(),
              [](const Segment& s, const Segment& t) { return lexicographically_less(s.a, t.a); });
    std::vector<std::size_t> active;  // segments that reach the current one's left end
    for (std::size_t i = 0; i < segments.size(); ++i) {
      std::erase_if(active, [&](std::size_t j) { return segments[j].b.x < segments[i].a.x; });
      for (const std::size_t j : active) {
        if (intersect_badly(segments[i], segments[j])) {
          return "rings " + std::to_string(segments[j].ring) + " and " + std::to_string(segments[i].ring) +
                 " cross or overlap";
        }
      }
      active.push_back(i);
    }
    return {};
  }

  /// Even-odd rule, exact; empty when `p` lies on the ring.
  static std::optional<bool> contains(const std::vector<Point>& ring, const Point& p) {
    bool inside = false;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point& a = ring[i];
      const Point& b = ring[(i + 1) % ring.size()];
      if (p == a || strictly_between(a, b, p)) return std::nullopt;
      if ((a.y > p.y) == (b.y > p.y)) continue;
      const double side = orient2d(a, b, p);
      if (b.y > a.y ? side > 0 : side < 0) inside = !inside;
    }
    return inside;
  }

  /// Whether ring `inner` lies inside ring `outer`; their edges do not cross. Tested at a vertex that they do
  /// not share; where they share all, at the middle of an edge.
  bool lies_inside(const CheckedRing& inner, const CheckedRing& outer) const {
    for (const Point& p : inner.points) {
      if (const auto answer = contains(outer.points, p)) return *answer;
    }
    for (std::size_t i = 0; i < inner.points.size(); ++i) {
      const Point& a = inner.points[i];
      const Point& b = inner.points[(i + 1) % inner.points.size()];
      if (const auto answer = contains(outer.points, {a.x + (b.x - a.x) / 2, a.y + (b.y - a.y) / 2}))
        return *answer;
    }
    return false;
  }

  /// Holes lie in their shell and not in one another; a shell that lies in another polygon's shell lies in
  /// one of its holes.
  std::string check_nesting() {
    std::vector<std::size_t> shells;
    for (std::size_t r = 0; r < rings_.size(); ++r) {
      if (rings_[r].is_shell) shells.push_back(r);
    }
    for (std::size_t r = 0; r < rings_.size(); ++r) {
      const CheckedRing& ring = rings_[r];
      for (const std::size_t s : shells) {
        if (r == s) continue;
        const std::size_t polygon = rings_[s].polygon;
        bool in_a_hole = false;
        for (std::size_t h = s + 1; h < rings_.size() && rings_[h].polygon == polygon; ++h) {
          if (h != r) in_a_hole = in_a_hole || lies_inside(ring, rings_[h]);
        }
        if (ring.polygon == polygon) {
          if (!lies_inside(ring, rings_[s])) return "hole " + std::to_string(r) + " lies outside its shell";
          if (in_a_hole) return "hole " + std::to_string(r) + " lies in another hole";
        } else if (ring.is_shell && !in_a_hole && lies_inside(ring, rings_[s])) {
          return "polygons " + std::to_string(polygon) + " and " + std::to_string(ring.polygon) + " overlap";
        }
      }
    }
    return {};
  }

  /// Rings of a polygon that touch in a cycle would cut its interior apart.
  std::string check_connected() {
    std::size_t begin = 0;
    while (begin < rings_.size()) {
      std::size_t end = begin;
      std::vector<std::pair<Point, std::size_t>> visits;
      for (; end < rings_.size() && rings_[end].polygon == rings_[begin].polygon; ++end) {
        for (const Point& p : rings_[end].points) visits.emplace_back(p, end - begin);
      }
      std::sort(visits.begin(), visits.end(), [](const auto& u, const auto& v) {
        return lexicographically_less(u.first, v.first) || (u.first == v.first && u.second < v.second);
      });
      if (touch_in_a_cycle(visits, end - begin)) {
        return "the interior of polygon " + std::to_string(rings_[begin].polygon) + " is not connected";
      }
      begin = end;
    }
    return {};
  }

  /// Rings and the points where they touch form a graph; a ring that joins a component twice closes a cycle.
  static bool touch_in_a_cycle(const std::vector<std::pair<Point, std::size_t>>& visits,
                               std::size_t ring_count) {
    std::vector<std::size_t> parent(ring_count);
    std::iota(parent.begin(), parent.end(), std::size_t{0});
    const auto root = [&](std::size_t r) {
      while (parent[r] != r) r = parent[r] = parent[parent[r]];
      return r;
    };
    for (std::size_t i = 1; i < visits.size(); ++i) {
      if (visits[i].first != visits[i - 1].first) continue;
      const std::size_t u = root(visits[i - 1].second);
      const std::size_t v = root(visits[i].second);
      if (u == v) return true;
      parent[u] = v;
    }
    return false;
  }

  std::vector<Point> points_;
  const IndexedMultiPolygon& shape_;
  std::vector<CheckedRing> rings_;
};

}  // namespace

std::string check_triangulation(std::span<const Point> points, const Triangulation& triangulation) {
  return TriangulationCheck(points, triangulation).run();
}

std::string check_polygon(std::span<const Point> points, const IndexedMultiPolygon& shape) {
  return PolygonCheck(points, shape).run();
}

}  // namespace polylidar
