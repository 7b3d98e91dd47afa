#include "datasets/rgbd/convex_prism.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace hullbench {

using polylidar::Point;
using polylidar::Ring;

namespace {

/// The part of a ray that is left after cutting: from `first` to `last`.
struct Stretch {
  double first = -std::numeric_limits<double>::infinity();
  double last = std::numeric_limits<double>::infinity();

  bool is_empty() const { return !(first < last); }

  /// Keeps where value + t * slope >= 0.
  void cut(double value, double slope) {
    if (slope > 0) {
      first = std::max(first, -value / slope);
    } else if (slope < 0) {
      last = std::min(last, -value / slope);
    } else if (value <= 0) {
      last = first;
    }
  }
};

}  // namespace

ConvexPrism::ConvexPrism(Ring footprint, double height)
    : footprint_(std::move(footprint)), box_(polylidar::bounding_box(footprint_)), height_(height) {}

std::optional<double> ConvexPrism::entry(const Vector3& origin, const Vector3& direction) const {
  Stretch stretch;
  stretch.cut(origin.z, direction.z);
  stretch.cut(height_ - origin.z, -direction.z);
  // The box first: most rays miss it, and a round footprint has 64 sides.
  stretch.cut(origin.x - box_.min.x, direction.x);
  stretch.cut(box_.max.x - origin.x, -direction.x);
  stretch.cut(origin.y - box_.min.y, direction.y);
  stretch.cut(box_.max.y - origin.y, -direction.y);
  for (std::size_t i = 0; i < footprint_.size() && !stretch.is_empty(); ++i) {
    const Point& start = footprint_[i];
    const Point& end = footprint_[i + 1 < footprint_.size() ? i + 1 : 0];
    const double along_x = end.x - start.x;
    const double along_y = end.y - start.y;
    stretch.cut(along_x * (origin.y - start.y) - along_y * (origin.x - start.x),
                along_x * direction.y - along_y * direction.x);
  }
  if (stretch.is_empty() || !(stretch.first > 0)) return std::nullopt;
  return stretch.first;
}

}  // namespace hullbench
