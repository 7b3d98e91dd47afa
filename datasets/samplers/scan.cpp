#include "datasets/samplers/scan.hpp"

#include <algorithm>
#include <cmath>

#include "datasets/portable_math.hpp"
#include "datasets/sampling.hpp"

namespace hullbench {

using polylidar::MultiPolygon;
using polylidar::Point;
using polylidar::Polygon;

namespace {

/// Scans that are tried before one with too many points will do. Two or three are enough but where few points
/// make the count jump.
constexpr int kMaxScans = 20;

}  // namespace

std::vector<Point> lose_points(const std::vector<Point>& points, std::size_t n, Random& random) {
  std::vector<Point> kept;
  kept.reserve(n);
  for (std::size_t i = 0; i < points.size() && kept.size() < n; ++i) {
    if (random.below(points.size() - i) < n - kept.size()) kept.push_back(points[i]);
  }
  return kept;
}

ScanFrame::ScanFrame(const MultiPolygon& shape, double turns) : along_(unit_vector(turns)) {
  std::vector<Point> corners;
  for (const Polygon& polygon : shape) {
    for (const Point& corner : polygon.shell) corners.push_back(in_frame(corner));
  }
  bounds_ = polylidar::bounding_box(corners);
}

std::vector<Point> scan_exactly(const MultiPolygon& shape, std::size_t n, std::uint64_t seed,
                                const Scan& scan) {
  const UniformPoints refuses_shapes_without_area(shape, seed);
  const auto wanted = static_cast<double>(n);
  double pitch = spacing(shape, n);
  for (int tries = 1;; ++tries) {
    Random random(seed);
    const std::vector<Point> points = scan(pitch, random);
    if (points.size() >= n && (points.size() <= n + n / 20 + 8 || tries >= kMaxScans)) {
      return lose_points(points, n, random);
    }
    // The count goes with the inverse square of the pitch. A fiftieth more than is needed, so that the next
    // scan's chance does not make it too few.
    const double factor = std::sqrt(static_cast<double>(points.size() + 2) / (1.02 * wanted + 4));
    pitch *= tries < kMaxScans ? std::clamp(factor, 0.5, 2.0) : 0.9;
  }
}

}  // namespace hullbench
