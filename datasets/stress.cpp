#include "datasets/stress.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <system_error>

#include "datasets/point_locator.hpp"
#include "datasets/portable_math.hpp"
#include "datasets/random.hpp"
#include "datasets/sampling.hpp"

namespace hullbench {

using polylidar::Box;
using polylidar::MultiPolygon;
using polylidar::Point;
using polylidar::Polygon;
using polylidar::Ring;

namespace {

double spacing(const MultiPolygon& shape, std::size_t n) {
  return std::sqrt(polylidar::area(shape) / static_cast<double>(n));
}

std::size_t share(std::size_t n, double percent) {
  return static_cast<std::size_t>(std::round(static_cast<double>(n) * percent / 100));
}

Box grown(const Box& box, double margin) {
  return {{box.min.x - margin, box.min.y - margin}, {box.max.x + margin, box.max.y + margin}};
}

Point uniform_in(const Box& box, Random& random) {
  const double x = random.between(box.min.x, box.max.x);
  const double y = random.between(box.min.y, box.max.y);
  return {x, y};
}

Point moved_by_gaussian(const Point& point, double deviation, Random& random) {
  const double x = point.x + deviation * random.normal();
  const double y = point.y + deviation * random.normal();
  return {x, y};
}

std::vector<Point> sample_noise(const MultiPolygon& shape, std::size_t n, double level, std::uint64_t seed) {
  std::vector<Point> points = sample_uniform(shape, n, seed);
  const double deviation = level * spacing(shape, n);
  Random random(derive_seed(seed, "noise"));
  for (Point& point : points) point = moved_by_gaussian(point, deviation, random);
  return points;
}

std::vector<Point> sample_outliers(const MultiPolygon& shape, std::size_t n, double level,
                                   std::uint64_t seed) {
  std::vector<Point> points = sample_uniform(shape, n - share(n, level), seed);
  const Box bounds = PointLocator(shape).bounds();
  const double side = std::max(bounds.max.x - bounds.min.x, bounds.max.y - bounds.min.y);
  const Box box = grown(bounds, side / 10);
  Random random(derive_seed(seed, "outliers"));
  while (points.size() < n) points.push_back(uniform_in(box, random));
  return points;
}

/// Draws more of the uniform sample than are needed and thins it; the sample's first points do not depend on
/// their number.
std::vector<Point> sample_gradient(const MultiPolygon& shape, std::size_t n, double level,
                                   std::uint64_t seed) {
  const Box bounds = PointLocator(shape).bounds();
  const double width = bounds.max.x - bounds.min.x;
  std::vector<Point> points;
  for (std::size_t drawn = n; points.size() < n; drawn *= 2) {
    points.clear();
    Random random(derive_seed(seed, "gradient"));
    for (const Point& point : sample_uniform(shape, drawn, seed)) {
      const double density = 1 + (level - 1) * (bounds.max.x - point.x) / width;
      if (level * random.uniform() < density && points.size() < n) points.push_back(point);
    }
  }
  return points;
}

std::vector<Point> sample_clusters(const MultiPolygon& shape, std::size_t n, double level,
                                   std::uint64_t seed) {
  const PointLocator locator(shape);
  const double h = spacing(shape, n);
  const Box box = grown(locator.bounds(), 6 * h);
  const double box_area = (box.max.x - box.min.x) * (box.max.y - box.min.y);
  const double count = static_cast<double>(n) / level * (box_area / polylidar::area(shape));
  Random random(derive_seed(seed, "clusters"));
  std::vector<Point> centres(static_cast<std::size_t>(std::ceil(count)));
  for (Point& centre : centres) centre = uniform_in(box, random);
  std::vector<Point> points;
  while (points.size() < n) {
    const Point point = moved_by_gaussian(centres[random.below(centres.size())], h, random);
    if (locator.contains(point)) points.push_back(point);
  }
  return points;
}

/// Points by squares of a grid, to find those near a place.
class NearPoints {
 public:
  /// For distances up to `reach`, and points in `box`.
  NearPoints(const Box& box, double reach)
      : origin_(box.min),
        reach_(reach),
        columns_(cell(box.max.x - box.min.x) + 1),
        rows_(cell(box.max.y - box.min.y) + 1),
        cells_(columns_ * rows_) {}

  bool is_one_near(const Point& point) const {
    const std::size_t column = cell(point.x - origin_.x);
    const std::size_t row = cell(point.y - origin_.y);
    for (std::size_t r = row > 0 ? row - 1 : 0; r <= std::min(row + 1, rows_ - 1); ++r) {
      for (std::size_t c = column > 0 ? column - 1 : 0; c <= std::min(column + 1, columns_ - 1); ++c) {
        for (const Point& other : cells_[r * columns_ + c]) {
          const double dx = other.x - point.x;
          const double dy = other.y - point.y;
          if (dx * dx + dy * dy < reach_ * reach_) return true;
        }
      }
    }
    return false;
  }

  void add(const Point& point) {
    cells_[cell(point.y - origin_.y) * columns_ + cell(point.x - origin_.x)].push_back(point);
  }

 private:
  std::size_t cell(double offset) const { return static_cast<std::size_t>(offset / reach_); }

  Point origin_;
  double reach_;
  std::size_t columns_;
  std::size_t rows_;
  std::vector<std::vector<Point>> cells_;  ///< row by row from the origin
};

std::vector<Point> sample_poisson(const MultiPolygon& shape, std::size_t n, double level,
                                  std::uint64_t seed) {
  constexpr std::size_t kMaxDarts = 1'000'000;
  const PointLocator locator(shape);
  const Box& box = locator.bounds();
  NearPoints near(box, level * spacing(shape, n));
  Random random(derive_seed(seed, "poisson"));
  std::vector<Point> points;
  for (std::size_t misses = 0; points.size() < n; ++misses) {
    if (misses > kMaxDarts) {
      throw std::runtime_error("no room for another point after " + std::to_string(kMaxDarts) +
                               " tries; ask for a lower level of poisson");
    }
    const Point point = uniform_in(box, random);
    if (!locator.contains(point) || near.is_one_near(point)) continue;
    near.add(point);
    points.push_back(point);
    misses = 0;
  }
  return points;
}

/// The points of one lattice that lie in the shape; fewer or more than n by chance.
std::vector<Point> draw_lattice(const PointLocator& locator, double side, double jitter, Random& random) {
  const Box& box = locator.bounds();
  const Point along = unit_vector(random.between(0.01, 0.04));
  const Point origin = {(box.min.x + box.max.x) / 2 + side * random.uniform(),
                        (box.min.y + box.max.y) / 2 + side * random.uniform()};
  const double width = box.max.x - box.min.x;
  const double height = box.max.y - box.min.y;
  // Rows and columns either side of the middle that reach the box's corners, and past them by what the origin
  // and the points are moved.
  const auto reach = static_cast<int>(std::ceil(std::sqrt(width * width + height * height) / (2 * side))) + 3;
  std::vector<Point> points;
  for (int row = -reach; row <= reach; ++row) {
    for (int column = -reach; column <= reach; ++column) {
      const double u = side * (column + jitter * random.between(-1, 1));
      const double v = side * (row + jitter * random.between(-1, 1));
      const Point point = {origin.x + u * along.x - v * along.y, origin.y + u * along.y + v * along.x};
      if (locator.contains(point)) points.push_back(point);
    }
  }
  return points;
}

std::vector<Point> sample_lattice(const MultiPolygon& shape, std::size_t n, double level,
                                  std::uint64_t seed) {
  constexpr int kMaxLattices = 10'000;
  const PointLocator locator(shape);
  const double side = spacing(shape, n);
  Random random(derive_seed(seed, "lattice"));
  for (int attempt = 0; attempt < kMaxLattices; ++attempt) {
    std::vector<Point> points = draw_lattice(locator, side, level, random);
    if (points.size() == n) return points;
  }
  throw std::runtime_error("none of " + std::to_string(kMaxLattices) + " lattices has exactly " +
                           std::to_string(n) + " points in the shape; ask for another number of them");
}

struct RingEdge {
  Point start;
  Point end;
  double length_before = 0;  ///< of all edges before it
};

std::vector<RingEdge> ring_edges(const MultiPolygon& shape, double& length) {
  std::vector<RingEdge> edges;
  length = 0;
  const auto add = [&](const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const RingEdge edge = {ring[i], ring[(i + 1) % ring.size()], length};
      const double dx = edge.end.x - edge.start.x;
      const double dy = edge.end.y - edge.start.y;
      length += std::sqrt(dx * dx + dy * dy);
      edges.push_back(edge);
    }
  };
  for (const Polygon& polygon : shape) {
    add(polygon.shell);
    for (const Ring& hole : polygon.holes) add(hole);
  }
  return edges;
}

std::vector<Point> sample_boundary(const MultiPolygon& shape, std::size_t n, double level,
                                   std::uint64_t seed) {
  std::vector<Point> points = sample_uniform(shape, n - share(n, level), seed);
  double length = 0;
  const std::vector<RingEdge> edges = ring_edges(shape, length);
  Random random(derive_seed(seed, "boundary"));
  while (points.size() < n) {
    const double place = length * random.uniform();
    const auto behind =
        std::upper_bound(edges.begin(), edges.end(), place,
                         [](double value, const RingEdge& edge) { return value < edge.length_before; });
    const RingEdge& edge = *(behind - 1);
    const double end = behind == edges.end() ? length : behind->length_before;
    const double part = (place - edge.length_before) / (end - edge.length_before);
    points.push_back({edge.start.x + part * (edge.end.x - edge.start.x),
                      edge.start.y + part * (edge.end.y - edge.start.y)});
  }
  return points;
}

/// A plain decimal, the shortest that gives this number; none for other texts.
std::optional<double> canonical_number(const std::string& text) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, value, std::chars_format::fixed);
  if (error != std::errc() || stopped != end || !std::isfinite(value)) return std::nullopt;
  char again[64];
  const auto written = std::to_chars(std::begin(again), std::end(again), value, std::chars_format::fixed);
  if (written.ec != std::errc() || std::string(std::begin(again), written.ptr) != text) return std::nullopt;
  return value;
}

}  // namespace

const std::vector<StressKind>& stress_kinds() {
  static const std::vector<StressKind> kinds = {
      {"noise", "noise", "h", "Gaussian noise of this standard deviation", 0, 10, &sample_noise},
      {"outliers", "outliers", "%", "so many of the points uniform in a larger box", 0, 90, &sample_outliers},
      {"gradient", "gradient", "", "density at the left side over density at the right", 1, 1000,
       &sample_gradient},
      {"clusters", "clusters", "", "points in a Gaussian cluster on average", 1, 1000, &sample_clusters},
      {"poisson", "Poisson disks", "h", "least distance of two points", 0.25, 0.75, &sample_poisson},
      {"lattice", "lattice", "", "largest move of a lattice's points, in its sides", 0, 0.5, &sample_lattice},
      {"boundary", "boundary", "%", "so many of the points on the rings", 0, 100, &sample_boundary},
  };
  return kinds;
}

std::optional<std::pair<std::string, std::optional<Stress>>> split_stress(const std::string& name) {
  const std::size_t mark = name.find('~');
  if (mark == std::string::npos) return std::pair{name, std::optional<Stress>()};
  const std::size_t colon = name.find(':', mark);
  if (colon == std::string::npos) return std::nullopt;
  const std::string kind_name = name.substr(mark + 1, colon - mark - 1);
  const auto& kinds = stress_kinds();
  const auto kind = std::find_if(kinds.begin(), kinds.end(),
                                 [&](const StressKind& candidate) { return candidate.name == kind_name; });
  const std::optional<double> level = canonical_number(name.substr(colon + 1));
  if (kind == kinds.end() || !level || *level < kind->least || *level > kind->most) return std::nullopt;
  return std::pair{name.substr(0, mark), std::optional<Stress>({&*kind, *level})};
}

}  // namespace hullbench
