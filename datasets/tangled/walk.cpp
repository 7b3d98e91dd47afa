#include <array>
#include <cstddef>
#include <vector>

#include "datasets/tangled/draws.hpp"
#include "datasets/tangled/ring_steps.hpp"
#include "datasets/tangled_shapes.hpp"

namespace hullbench {

using polylidar::Ring;

namespace {

constexpr double kGridSize = 200;

/// A cell of the grid or a corner of its cells: column and row from the lower left. Corner (c, r) is the
/// lower left one of cell (c, r).
struct Place {
  int column = 0;
  int row = 0;

  friend Place operator+(const Place& a, const Place& b) { return {a.column + b.column, a.row + b.row}; }
  friend bool operator==(const Place&, const Place&) = default;
};

/// East, north, west, south.
constexpr std::array<Place, 4> kSteps{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

const Place& left_of(std::size_t direction) {
  return kSteps[(direction + 1) % 4];
}

const Place& right_of(std::size_t direction) {
  return kSteps[(direction + 3) % 4];
}

/// A tree of cells, in the order they were added.
class CellTree {
 public:
  explicit CellTree(int size)
      : size_(size), taken_(static_cast<std::size_t>(size) * static_cast<std::size_t>(size)) {}

  const std::vector<Place>& cells() const { return cells_; }

  bool has(const Place& cell) const { return is_inside(cell) && taken_[number(cell)]; }

  void add(const Place& cell) {
    taken_[number(cell)] = true;
    cells_.push_back(cell);
  }

  /// Whether the cell that `direction` leads to from `from`, a cell of the tree, may be added.
  bool can_grow(const Place& from, std::size_t direction) const {
    const Place cell = from + kSteps[direction];
    const Place ahead = cell + kSteps[direction];
    const Place& left = left_of(direction);
    const Place& right = right_of(direction);
    return is_inside(cell) && !has(cell) && !has(ahead) && !has(cell + left) && !has(cell + right) &&
           !has(ahead + left) && !has(ahead + right);
  }

 private:
  bool is_inside(const Place& cell) const {
    return cell.column >= 0 && cell.column < size_ && cell.row >= 0 && cell.row < size_;
  }
  std::size_t number(const Place& cell) const {
    return static_cast<std::size_t>(cell.row) * static_cast<std::size_t>(size_) +
           static_cast<std::size_t>(cell.column);
  }

  int size_;
  /// taken_[row * size_ + column]: whether the cell is in the tree.
  std::vector<bool> taken_;
  std::vector<Place> cells_;
};

/// The cells that may be added next to cells `first` and later of the tree.
std::vector<Place> possible_cells(const CellTree& tree, std::size_t first) {
  std::vector<Place> possible;
  for (std::size_t i = first; i < tree.cells().size(); ++i) {
    const Place& from = tree.cells()[i];
    for (std::size_t direction = 0; direction < 4; ++direction) {
      if (tree.can_grow(from, direction)) possible.push_back(from + kSteps[direction]);
    }
  }
  return possible;
}

/// Goes on from the cell added last with probability `persistence`, which makes long corridors, else from
/// any cell; ends at `cells` cells or where nothing can be added.
CellTree grow_tree(int size, std::size_t cells, double persistence, Random& random) {
  CellTree tree(size);
  tree.add({size / 2, size / 2});
  while (tree.cells().size() < cells) {
    std::vector<Place> possible;
    if (random.uniform() < persistence) possible = possible_cells(tree, tree.cells().size() - 1);
    if (possible.empty()) possible = possible_cells(tree, 0);
    if (possible.empty()) break;
    tree.add(possible[random.below(possible.size())]);
  }
  return tree;
}

/// The corners at which the tree's outline turns, counter-clockwise: the tree is on the left of the way.
std::vector<Place> trace_outline(const CellTree& tree) {
  // The lowest cell of the leftmost ones: its lower left corner is one of the outline's.
  Place start = tree.cells().front();
  for (const Place& cell : tree.cells()) {
    if (cell.column < start.column || (cell.column == start.column && cell.row < start.row)) start = cell;
  }
  // The cell to the left and ahead of a corner, seen in each direction.
  constexpr std::array<Place, 4> kAheadLeft{{{0, 0}, {-1, 0}, {-1, -1}, {0, -1}}};
  std::vector<Place> corners{start};
  std::size_t direction = 0;
  Place at = start + kSteps[0];
  while (at != start) {
    const std::size_t right = (direction + 3) % 4;
    const bool turns_right = tree.has(at + kAheadLeft[right]);
    const bool turns_left = !turns_right && !tree.has(at + kAheadLeft[direction]);
    if (turns_right || turns_left) corners.push_back(at);
    if (turns_right) direction = right;
    if (turns_left) direction = (direction + 1) % 4;
    at = at + kSteps[direction];
  }
  return corners;
}

}  // namespace

Ring draw_walk(Random& random) {
  const std::size_t size = 8 + random.below(5);
  const std::size_t cells = size * size / 4 + random.below(size * size / 4);
  const CellTree tree = grow_tree(static_cast<int>(size), cells, random.uniform(), random);
  const std::vector<double> x = random_cuts(size, kLeastFeature, kGridSize, random);
  const std::vector<double> y = random_cuts(size, kLeastFeature, kGridSize, random);
  Ring ring;
  for (const Place& corner : trace_outline(tree)) {
    ring.push_back({x[static_cast<std::size_t>(corner.column)], y[static_cast<std::size_t>(corner.row)]});
  }
  centre_on_origin(ring);
  return ring;
}

}  // namespace hullbench
