#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "datasets/tangled/draws.hpp"
#include "datasets/tangled/ring_steps.hpp"
#include "datasets/tangled_shapes.hpp"

namespace hullbench {

using polylidar::Point;
using polylidar::Ring;

namespace {

constexpr double kDiscRadius = 100;
constexpr std::size_t kLeastVertices = 30;
constexpr std::size_t kMostVertices = 80;
/// Lattice points in the disc for each vertex asked for: growth stops earlier when most points are taken.
constexpr double kPointsPerVertex = 1.35;

/// A point of the lattice: steps along the x axis and along the direction a sixth of a turn on.
struct Node {
  int along = 0;
  int up = 0;

  friend Node operator+(const Node& a, const Node& b) { return {a.along + b.along, a.up + b.up}; }
  friend bool operator==(const Node&, const Node&) = default;
};

/// The neighbours of a node, counter-clockwise.
constexpr std::array<Node, 6> kNeighbours{{{1, 0}, {0, 1}, {-1, 1}, {-1, 0}, {0, -1}, {1, -1}}};

/// The third corner of the triangle on the right of the edge from `start` to its neighbour `end`.
Node across(const Node& start, const Node& end) {
  std::size_t direction = 0;
  while (start + kNeighbours[direction] != end) ++direction;
  return start + kNeighbours[(direction + 5) % 6];
}

/// Uniform in the disc of `radius` round the origin.
Point draw_shift(double radius, Random& random) {
  Point shift{radius, radius};
  while (shift.x * shift.x + shift.y * shift.y > radius * radius) {
    shift.x = random.between(-radius, radius);
    shift.y = random.between(-radius, radius);
  }
  return shift;
}

/// The lattice round the origin with shifted points.
class ShiftedLattice {
 public:
  ShiftedLattice(double spacing, Random& random)
      : reach_(static_cast<int>(kDiscRadius / (kRowHeight * spacing)) + 1) {
    const double shift = (kRowHeight * spacing - kLeastFeature) / 2;
    const double inner_radius = kDiscRadius - shift;
    for (int up = -reach_; up <= reach_; ++up) {
      for (int along = -reach_; along <= reach_; ++along) {
        const Point regular{spacing * (along + 0.5 * up), kRowHeight * spacing * up};
        const bool free = regular.x * regular.x + regular.y * regular.y <= inner_radius * inner_radius;
        const Point moved = free ? draw_shift(shift, random) : Point{};
        points_.push_back({regular.x + moved.x, regular.y + moved.y});
        free_.push_back(free);
      }
    }
  }

  bool is_free(const Node& node) const {
    return std::abs(node.along) <= reach_ && std::abs(node.up) <= reach_ && free_[number(node)];
  }
  void take(const Node& node) { free_[number(node)] = false; }
  const Point& point(const Node& node) const { return points_[number(node)]; }

 private:
  /// Of an equilateral triangle, in its sides.
  static constexpr double kRowHeight = std::numbers::sqrt3 / 2;

  std::size_t number(const Node& node) const {
    const int row = node.up + reach_;
    const int column = node.along + reach_;
    const int nodes_in_row = 2 * reach_ + 1;
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(nodes_in_row) +
           static_cast<std::size_t>(column);
  }

  /// Nodes have coordinates -reach_ .. reach_; those far out are not in the disc.
  int reach_;
  /// points_[number(node)], free_[number(node)]: where it is; whether it is in the disc and not yet taken.
  std::vector<Point> points_;
  std::vector<bool> free_;
};

/// The polygon's nodes, counter-clockwise: `vertices` of them, or fewer when no edge can be replaced any
/// more.
std::vector<Node> grow_ring(ShiftedLattice& lattice, std::size_t vertices, Random& random) {
  std::vector<Node> ring{{0, 0}, {1, 0}, {0, 1}};
  for (const Node& node : ring) lattice.take(node);
  std::vector<std::size_t> open;
  while (ring.size() < vertices) {
    open.clear();
    for (std::size_t i = 0; i < ring.size(); ++i) {
      if (lattice.is_free(across(ring[i], ring[(i + 1) % ring.size()]))) open.push_back(i);
    }
    if (open.empty()) break;
    const std::size_t edge = open[random.below(open.size())];
    const Node added = across(ring[edge], ring[(edge + 1) % ring.size()]);
    lattice.take(added);
    ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(edge) + 1, added);
  }
  return ring;
}

}  // namespace

Ring draw_partition(Random& random) {
  const std::size_t vertices = kLeastVertices + random.below(kMostVertices - kLeastVertices + 1);
  // Each lattice point has sqrt(3) / 2 squared spacings of the disc to itself.
  const double points = kPointsPerVertex * static_cast<double>(vertices);
  const double spacing = kDiscRadius * std::sqrt(2 * std::numbers::pi / (std::numbers::sqrt3 * points));
  ShiftedLattice lattice(spacing, random);
  Ring ring;
  for (const Node& node : grow_ring(lattice, vertices, random)) ring.push_back(lattice.point(node));
  centre_on_origin(ring);
  return ring;
}

}  // namespace hullbench
