#include "benchmarks/footprint/hexbin.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <unordered_map>
#include <utility>
#include <vector>

namespace hullbench::footprint {
namespace {

using polylidar::Box;

/// A place of the lattice that has all centres and corners, by which corners of neighbours are the same: x in
/// halves of a hexagon's height, y in halves of its side.
struct Place {
  std::int64_t x = 0;
  std::int64_t y = 0;
};

/// Corners counter-clockwise from their hexagon's centre, and behind the side from corner k to the next one
/// the neighbour's centre.
constexpr std::array<Place, 6> kCorners = {{{1, -1}, {1, 1}, {0, 2}, {-1, 1}, {-1, -1}, {0, -2}}};
constexpr std::array<Place, 6> kNeighbours = {{{2, 0}, {1, 3}, {-1, 3}, {-2, 0}, {-1, -3}, {1, -3}}};

/// A honeycomb over a box, rows of hexagons with a corner upwards, every other one moved by half a hexagon.
/// One row and column more on each side stays empty.
class Honeycomb {
 public:
  Honeycomb(const Box& box, double height)
      : origin_(box.min), half_height_(height / 2), half_side_(height / std::numbers::sqrt3 / 2) {
    const double columns = std::ceil((box.max.x - box.min.x) / height) + 4;
    const double rows = std::ceil((box.max.y - box.min.y) / (3 * half_side_)) + 4;
    if (!(columns * rows <= 0x1p31)) throw std::invalid_argument("there are too many hexagons of this size");
    columns_ = static_cast<std::int64_t>(columns);
    counts_.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  }

  void count(const Point& point) {
    const double x = (point.x - origin_.x) / half_height_;
    const double y = (point.y - origin_.y) / half_side_;
    // The nearest centre, of the two rows that it can be in.
    const auto row = static_cast<std::int64_t>(std::floor(y / 3));
    std::int64_t best = 0;
    double least = HUGE_VAL;
    for (const std::int64_t r : {row, row + 1}) {
      const std::int64_t odd = r & 1;
      const auto column = static_cast<std::int64_t>(std::floor((x - static_cast<double>(odd)) / 2 + 0.5));
      const double dx = (x - static_cast<double>(2 * column + odd)) * half_height_;
      const double dy = (y - static_cast<double>(3 * r)) * half_side_;
      if (dx * dx + dy * dy >= least) continue;
      least = dx * dx + dy * dy;
      best = index(column, r);
    }
    ++counts_[static_cast<std::size_t>(best)];
  }

  std::size_t size() const { return counts_.size(); }
  std::uint32_t points(std::size_t cell) const { return counts_[cell]; }
  Place centre(std::size_t cell) const {
    const std::int64_t row = static_cast<std::int64_t>(cell) / columns_ - 1;
    const std::int64_t column = static_cast<std::int64_t>(cell) % columns_ - 1;
    return {2 * column + (row & 1), 3 * row};
  }
  std::size_t cell(const Place& centre) const {
    const std::int64_t row = centre.y / 3;
    return static_cast<std::size_t>(index((centre.x - (row & 1)) / 2, row));
  }
  Point at(const Place& place) const {
    return {origin_.x + static_cast<double>(place.x) * half_height_,
            origin_.y + static_cast<double>(place.y) * half_side_};
  }

 private:
  std::int64_t index(std::int64_t column, std::int64_t row) const {
    return (row + 1) * columns_ + column + 1;
  }

  Point origin_;  ///< a centre
  double half_height_;
  double half_side_;
  std::int64_t columns_ = 0;
  std::vector<std::uint32_t> counts_;  ///< cell -> points
};

Place operator+(const Place& a, const Place& b) {
  return {a.x + b.x, a.y + b.y};
}

std::uint64_t key_of(const Place& place) {
  return static_cast<std::uint64_t>(place.x) << 32U | static_cast<std::uint32_t>(place.y);
}

/// Where a side of the outline that starts at a corner ends. At a corner three hexagons meet, so that no more
/// than one side starts there.
struct Side {
  Place end;
  std::uint32_t polygon = 0;
};

class Outline {
 public:
  Outline(const Honeycomb& comb, std::uint32_t least) : comb_(comb), least_(least) {}

  MultiPolygon trace() {
    find_sides();
    MultiPolygon shape(polygon_count_);
    while (!sides_.empty()) {
      const std::uint32_t polygon = sides_.begin()->second.polygon;
      Ring ring = take_ring();
      // A hexagon of the shape is on the left of its sides.
      if (polylidar::signed_area(ring) > 0) {
        shape[polygon].shell = std::move(ring);
      } else {
        shape[polygon].holes.push_back(std::move(ring));
      }
    }
    return shape;
  }

 private:
  bool is_in(std::size_t cell) const { return comb_.points(cell) >= least_; }

  /// Those of one polygon after the other, hexagons that hang together.
  void find_sides() {
    std::vector<bool> is_seen(comb_.size());
    std::vector<std::size_t> waiting;
    for (std::size_t first = 0; first < comb_.size(); ++first) {
      if (is_seen[first] || !is_in(first)) continue;
      is_seen[first] = true;
      waiting.push_back(first);
      while (!waiting.empty()) {
        const Place centre = comb_.centre(waiting.back());
        waiting.pop_back();
        for (std::size_t k = 0; k < 6; ++k) {
          const std::size_t neighbour = comb_.cell(centre + kNeighbours[k]);
          if (!is_in(neighbour)) {
            sides_[key_of(centre + kCorners[k])] = {centre + kCorners[(k + 1) % 6], polygon_count_};
          } else if (!is_seen[neighbour]) {
            is_seen[neighbour] = true;
            waiting.push_back(neighbour);
          }
        }
      }
      ++polygon_count_;
    }
  }

  Ring take_ring() {
    Ring ring;
    for (auto side = sides_.begin(); side != sides_.end();) {
      const Place end = side->second.end;
      sides_.erase(side);
      ring.push_back(comb_.at(end));
      side = sides_.find(key_of(end));
    }
    return ring;
  }

  const Honeycomb& comb_;
  std::uint32_t least_;
  std::uint32_t polygon_count_ = 0;
  std::unordered_map<std::uint64_t, Side> sides_;  ///< by the corner that they start at
};

}  // namespace

MultiPolygon hexbin(std::span<const Point> points, double height, std::uint32_t least) {
  if (points.empty()) return {};
  Honeycomb comb(polylidar::bounding_box(points), height);
  for (const Point& point : points) comb.count(point);
  return Outline(comb, least).trace();
}

double hexer_height(std::span<const Point> points, std::uint32_t least) {
  constexpr std::size_t kSample = 5000;
  const std::size_t count = std::min(points.size(), kSample);
  double sum = 0;
  for (std::size_t i = 1; i < count; ++i) {
    sum += std::hypot(points[i].x - points[i - 1].x, points[i].y - points[i - 1].y);
  }
  return count < 2 ? 0 : least * sum / static_cast<double>(count);
}

}  // namespace hullbench::footprint
