#include "datasets/tissue.hpp"

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "datasets/portable_math.hpp"
#include "datasets/random.hpp"

namespace hullbench {

using polylidar::MultiPolygon;
using polylidar::Point;
using polylidar::Ring;

namespace {

constexpr double kPitch = 20;
constexpr double kJitter = 0.35;
/// How far the middle of a side is off the straight line, over its length.
constexpr double kBend = 0.08;
constexpr int kPiecesOfASide = 8;
constexpr std::uint64_t kSeed = 2026;

/// Where a cell stands in the grid; beside the tissue there are others that only bound it.
struct Place {
  int column = 0;
  int row = 0;
  bool operator==(const Place&) const = default;
  bool operator<(const Place& other) const {
    return std::pair(row, column) < std::pair(other.row, other.column);
  }
  std::string name() const { return std::to_string(column) + "/" + std::to_string(row); }
};

Point middle_of(const Place& place) {
  Random random(derive_seed(kSeed, "tissue/" + place.name()));
  const double x = place.column + random.between(-kJitter, kJitter);
  const double y = place.row + random.between(-kJitter, kJitter);
  return {kPitch * x, kPitch * y};
}

/// A corner, and who is on the other side of the edge from there to the next one, counter-clockwise.
struct Corner {
  Point point;
  Place neighbour;
};

/// What of `cell`, convex, is nearer to `middle` than to that of `other`.
std::vector<Corner> cut(const std::vector<Corner>& cell, const Point& middle, const Place& other) {
  const Point there = middle_of(other);
  const double nx = there.x - middle.x;
  const double ny = there.y - middle.y;
  const double border = nx * (middle.x + there.x) / 2 + ny * (middle.y + there.y) / 2;
  const auto beyond = [&](const Point& p) { return nx * p.x + ny * p.y - border; };
  std::vector<Corner> kept;
  for (std::size_t i = 0; i < cell.size(); ++i) {
    const Corner& here = cell[i];
    const Corner& next = cell[(i + 1) % cell.size()];
    const double from = beyond(here.point);
    const double to = beyond(next.point);
    if (from <= 0) kept.push_back(here);
    if ((from <= 0) == (to <= 0)) continue;
    const double part = from / (from - to);
    const Point crossing = {here.point.x + part * (next.point.x - here.point.x),
                            here.point.y + part * (next.point.y - here.point.y)};
    kept.push_back({crossing, from <= 0 ? other : here.neighbour});
  }
  return kept;
}

std::vector<Corner> voronoi_cell(const Place& place) {
  constexpr double kFar = 2 * kPitch;
  const Point middle = middle_of(place);
  std::vector<Corner> cell;
  for (const auto& [x, y] :
       {std::pair(-kFar, -kFar), std::pair(kFar, -kFar), std::pair(kFar, kFar), std::pair(-kFar, kFar)})
    cell.push_back({{middle.x + x, middle.y + y}, place});
  // A cell reaches no farther than 1.2 steps of the grid, and middles are off by 0.35 at most.
  constexpr int kFarthest = 3;
  for (int row = place.row - kFarthest; row <= place.row + kFarthest; ++row) {
    for (int column = place.column - kFarthest; column <= place.column + kFarthest; ++column) {
      const Place other = {column, row};
      if (!(other == place)) cell = cut(cell, middle, other);
    }
  }
  return cell;
}

/// Appends the side from `begin` to before `end` as both of its cells have it.
void add_side(const Place& place, const Corner& begin, const Point& end, Ring& ring) {
  const bool is_first = place < begin.neighbour;
  const Place& first = is_first ? place : begin.neighbour;
  const Place& second = is_first ? begin.neighbour : place;
  const bool bends_left = (derive_seed(kSeed, "side/" + first.name() + "/" + second.name()) & 1U) != 0;
  // Seen from the second cell the same bend is on the other hand.
  const double bend = bends_left == is_first ? kBend : -kBend;
  const double dx = end.x - begin.point.x;
  const double dy = end.y - begin.point.y;
  for (int k = 0; k < kPiecesOfASide; ++k) {
    const double part = static_cast<double>(k) / kPiecesOfASide;
    const double off = bend * unit_vector(part / 2).y;
    const double minus_off = -off;  // sums in both coordinates: see turned()
    ring.push_back({begin.point.x + part * dx + minus_off * dy, begin.point.y + part * dy + off * dx});
  }
}

}  // namespace

MultiPolygon tissue_cell(std::size_t index) {
  if (index >= kTissueCells)
    throw std::invalid_argument("there are only " + std::to_string(kTissueCells) + " cells");
  const Place place = {static_cast<int>(index % kTissueColumns), static_cast<int>(index / kTissueColumns)};
  const std::vector<Corner> cell = voronoi_cell(place);
  Ring ring;
  for (std::size_t i = 0; i < cell.size(); ++i)
    add_side(place, cell[i], cell[(i + 1) % cell.size()].point, ring);
  return {{.shell = std::move(ring), .holes = {}}};
}

}  // namespace hullbench
