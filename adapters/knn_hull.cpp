// The k-nearest-neighbours concave hull of Moreira and Santos (2007): a walk round the points, always to the
// one of the k nearest points that turns most to the right without crossing the way so far. A walk that gets
// stuck or leaves points outside is begun again with k + 1 neighbours.
//
// Where the paper is silent: of candidates in one direction the nearer one comes first; a hull that touches
// itself counts as crossing itself; points on the hull count as inside; and when all points are neighbours
// the walk may close after three points, which makes it gift wrapping: then it always succeeds, with the
// convex hull. Fewer than 3 distinct points, or points all on a line, give an empty multipolygon.
#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

#include "adapters/adapter.hpp"
#include "polylidar/predicates.hpp"

namespace hullbench {
namespace {

namespace bg = boost::geometry;
namespace bgi = boost::geometry::index;
using polylidar::orient2d;
using Index = std::uint32_t;
using BoostPoint = bg::model::d2::point_xy<double>;
using BoostBox = bg::model::box<BoostPoint>;
// Nodes of 16 entries: Boost's own examples use it, and the walk's small queries want small nodes.
using PointTree = bgi::rtree<std::pair<BoostPoint, Index>, bgi::quadratic<16>>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kFewestNeighbours = 3;

bool is_lower(const Point& a, const Point& b) {
  return std::tie(a.y, a.x) < std::tie(b.y, b.x);
}

BoostBox box_round(const Point& a, const Point& b) {
  return {{std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)}};
}

// Whether `p`, on the line through a and b, lies on the segment between them.
bool is_between(const Point& p, const Point& a, const Point& b) {
  return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}

int sign(double value) {
  return (value > 0) - (value < 0);
}

// Whether the segments a-b and c-d have any point in common but an end that they share. Exact. The segments
// are not the same one.
bool collide(const Point& a, const Point& b, const Point& c, const Point& d) {
  const int c_side = sign(orient2d(a, b, c));
  const int d_side = sign(orient2d(a, b, d));
  if (a == c || a == d || b == c || b == d) {
    if (c_side != 0 || d_side != 0) return false;
    return (c != a && c != b && is_between(c, a, b)) || (d != a && d != b && is_between(d, a, b)) ||
           (a != c && a != d && is_between(a, c, d)) || (b != c && b != d && is_between(b, c, d));
  }
  const int a_side = sign(orient2d(c, d, a));
  const int b_side = sign(orient2d(c, d, b));
  if (c_side * d_side < 0 && a_side * b_side < 0) return true;
  return (c_side == 0 && is_between(c, a, b)) || (d_side == 0 && is_between(d, a, b)) ||
         (a_side == 0 && is_between(a, c, d)) || (b_side == 0 && is_between(b, c, d));
}

// The order of the candidates at `at`: by the angle counter-clockwise from the way back, so that the
// sharpest right turn comes first. Exact.
class RightmostFirst {
 public:
  // `back`: the point before; null at the walk's start, the lowest point, from where all others lie in
  // the half-turn counter-clockwise from "to the right".
  RightmostFirst(const Point& at, const Point* back) : at_(at), back_(back) {}

  bool operator()(const Point& p, const Point& q) const {
    const int p_quarter = quarter(p);
    const int q_quarter = quarter(q);
    if (p_quarter != q_quarter) return p_quarter < q_quarter;
    const double turn = orient2d(at_, p, q);
    if (turn != 0) return turn > 0;
    return bg::comparable_distance(boost_point(at_), boost_point(p)) <
           bg::comparable_distance(boost_point(at_), boost_point(q));
  }

 private:
  static BoostPoint boost_point(const Point& point) { return {point.x, point.y}; }

  // 0: to the right of the way here; 1: straight on; 2: to the left; 3: straight back.
  int quarter(const Point& p) const {
    if (back_ == nullptr) return 0;
    const double side = orient2d(*back_, at_, p);
    if (side != 0) return side < 0 ? 0 : 2;
    return is_between(at_, *back_, p) ? 1 : 3;
  }

  const Point& at_;
  const Point* back_;
};

// The edges of a walk, found by where they are.
class Edges {
 public:
  void add(const Point& a, const Point& b) {
    tree_.insert({box_round(a, b), static_cast<Index>(edges_.size())});
    edges_.emplace_back(a, b);
  }

  bool collide_with(const Point& a, const Point& b) const {
    return any_near(box_round(a, b),
                    [&](const auto& edge) { return collide(a, b, edge.first, edge.second); });
  }

  // Whether `p` is inside the polygon of the edges or on it: by counting those that a ray to the right
  // crosses, each with its lower end and without its upper one.
  bool surround(const Point& p) const {
    bool is_inside = false;
    const bool is_on_edge = any_near({{p.x, p.y}, {kInfinity, p.y}}, [&](const auto& edge) {
      const auto& [low, high] = std::minmax(edge.first, edge.second, is_lower);
      const double side = orient2d(low, high, p);
      if (side == 0 && is_between(p, low, high)) return true;
      if (side > 0 && low.y <= p.y && p.y < high.y) is_inside = !is_inside;
      return false;
    });
    return is_inside || is_on_edge;
  }

 private:
  template <class Test>
  bool any_near(const BoostBox& box, Test test) const {
    return std::any_of(tree_.qbegin(bgi::intersects(box)), tree_.qend(),
                       [&](const auto& entry) { return test(edges_[entry.second]); });
  }

  std::vector<std::pair<Point, Point>> edges_;
  bgi::rtree<std::pair<BoostBox, Index>, bgi::quadratic<16>> tree_;
};

// One walk with a fixed number of neighbours.
class Walk {
 public:
  // `points` are distinct and sorted by is_lower; `tree` holds them with their indices.
  Walk(std::span<const Point> points, const PointTree& tree, std::size_t neighbours)
      : points_(points), tree_(tree), neighbours_(neighbours), is_taken_(points.size(), false) {}

  // The hull's vertices as they were met; nothing when the walk got stuck or a point is outside.
  std::optional<Ring> hull() {
    const std::size_t closable = neighbours_ + 1 >= points_.size() ? 3 : 4;  // vertices
    take(0);
    do {
      if (ring_.size() == closable) is_taken_[0] = false;
      if (!advance()) return std::nullopt;
    } while (is_open_);
    for (Index i = 0; i < points_.size(); ++i) {
      if (!is_taken_[i] && !edges_.surround(points_[i])) return std::nullopt;
    }
    return std::move(ring_);
  }

 private:
  void take(Index index) {
    ring_.push_back(points_[index]);
    is_taken_[index] = true;
  }

  // To the best candidate that the way so far lets through; false when there is none.
  bool advance() {
    const Point at = ring_.back();
    candidates_.clear();
    tree_.query(bgi::nearest(BoostPoint(at.x, at.y), static_cast<unsigned>(neighbours_)) &&
                    bgi::satisfies([&](const auto& entry) { return !is_taken_[entry.second]; }),
                boost::make_function_output_iterator(
                    [&](const auto& entry) { candidates_.push_back(entry.second); }));
    const RightmostFirst rightmost_first(at, ring_.size() > 1 ? &ring_[ring_.size() - 2] : nullptr);
    std::sort(candidates_.begin(), candidates_.end(),
              [&](Index a, Index b) { return rightmost_first(points_[a], points_[b]); });
    for (const Index candidate : candidates_) {
      if (edges_.collide_with(at, points_[candidate])) continue;
      edges_.add(at, points_[candidate]);
      is_open_ = candidate != 0;
      if (is_open_) {
        take(candidate);
      } else {
        is_taken_[0] = true;
      }
      return true;
    }
    return false;
  }

  std::span<const Point> points_;
  const PointTree& tree_;
  std::size_t neighbours_;
  std::vector<bool> is_taken_;  // point -> whether it is no candidate, being on the way already
  Ring ring_;
  Edges edges_;
  bool is_open_ = true;
  std::vector<Index> candidates_;  // scratch of advance()
};

// The hull of distinct points that are not all on a line and are sorted by is_lower.
Ring nearest_neighbours_hull(std::span<const Point> points, const PointTree& tree, std::size_t neighbours) {
  while (true) {
    if (std::optional<Ring> ring = Walk(points, tree, neighbours).hull()) return *std::move(ring);
    // Gift wrapping with exact predicates ends in the convex hull.
    if (neighbours + 1 >= points.size()) {
      throw std::runtime_error(
          "knn_hull needs coordinates that are 0 or between 2^-116 and 2^150 in magnitude");
    }
    ++neighbours;
  }
}

// The first vertex is the lowest one, where a simple ring is strictly convex.
void turn_counter_clockwise(Ring& ring) {
  if (orient2d(ring.back(), ring[0], ring[1]) < 0) std::reverse(ring.begin() + 1, ring.end());
}

MethodInfo describe() {
  MethodInfo info;
  info.name = "knn_hull";
  info.title = "k-nearest-neighbours hull";
  info.version = HULLBENCH_VERSION;
  info.licence = "MIT";
  info.citation =
      "A. Moreira, M. Y. Santos, Concave hull: a k-nearest neighbours approach for the computation of the "
      "region occupied by a set of points, GRAPP 2007";
  info.native_output = "ring";
  info.parameters = {
      {.name = "k",
       .unit = "count",
       .description = "Neighbours that the first walk looks at, a whole number; more when it fails.",
       .minimum = kFewestNeighbours,
       .maximum = kInfinity,
       .default_value = kFewestNeighbours}};
  info.capabilities = {.holes = false, .several_polygons = false};
  return info;
}

class KnnHull final : public Adapter {
 public:
  KnnHull() { info_ = describe(); }

 private:
  void do_load(std::span<const Point> points) override { points_.assign(points.begin(), points.end()); }

  void do_run(const Parameters& parameters, Steps& steps) override {
    const double k = parameters.at("k");
    if (k != std::floor(k)) throw std::invalid_argument("knn_hull takes 'k' as a whole number");
    if (!has_area()) return;

    steps.begin("neighbours");
    std::vector<Point> points = points_;
    std::sort(points.begin(), points.end(), is_lower);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    std::vector<std::pair<BoostPoint, Index>> entries;
    entries.reserve(points.size());
    for (const Point& point : points) {
      entries.emplace_back(BoostPoint(point.x, point.y), static_cast<Index>(entries.size()));
    }
    const PointTree tree(entries);

    steps.begin("shape");
    const auto all_others = static_cast<double>(points.size() - 1);
    ring_ = nearest_neighbours_hull(points, tree, static_cast<std::size_t>(std::min(k, all_others)));
  }

  MultiPolygon do_extract(Steps& steps) override {
    steps.begin("polygon");
    if (ring_.empty()) return {};
    Ring shell = ring_;
    turn_counter_clockwise(shell);
    return {Polygon{std::move(shell), {}}};
  }

  void do_reset() override { ring_ = Ring(); }

  std::vector<Point> points_;
  Ring ring_;
};

}  // namespace

std::unique_ptr<Adapter> make_knn_hull() {
  return std::make_unique<KnnHull>();
}

}  // namespace hullbench
