#include "benchmarks/metrics/segment_tree.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "benchmarks/metrics/shape_measures.hpp"

namespace hullbench::metrics {
namespace {

using polylidar::Box;
using polylidar::joined;

constexpr std::size_t kLeafSize = 4;

/// Infinity for an empty box.
double squared_distance(const Point& point, const Box& box) {
  const double dx = std::max({box.min.x - point.x, point.x - box.max.x, 0.0});
  const double dy = std::max({box.min.y - point.y, point.y - box.max.y, 0.0});
  return dx * dx + dy * dy;
}

double squared_distance(const Point& point, const Point& from, const Point& to) {
  const double along_x = to.x - from.x;
  const double along_y = to.y - from.y;
  const double length_squared = along_x * along_x + along_y * along_y;
  const double projected = (point.x - from.x) * along_x + (point.y - from.y) * along_y;
  const double t = length_squared > 0 ? std::clamp(projected / length_squared, 0.0, 1.0) : 0;
  const double dx = point.x - (from.x + t * along_x);
  const double dy = point.y - (from.y + t * along_y);
  return dx * dx + dy * dy;
}

}  // namespace

SegmentTree::SegmentTree(const MultiPolygon& shape) {
  for_each_edge(shape, [this](const Point& from, const Point& to) { segments_.push_back({from, to}); });
  leaf_count_ = std::bit_ceil(std::max<std::size_t>(1, (segments_.size() + kLeafSize - 1) / kLeafSize));
  boxes_.assign(2 * leaf_count_, polylidar::bounding_box({}));
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    Box& box = boxes_[leaf_count_ + i / kLeafSize];
    box = joined(box, joined({segments_[i].from, segments_[i].from}, {segments_[i].to, segments_[i].to}));
  }
  for (std::size_t node = leaf_count_ - 1; node > 0; --node) {
    boxes_[node] = joined(boxes_[2 * node], boxes_[2 * node + 1]);
  }
}

double SegmentTree::distance(const Point& point, double bound) const {
  // Widened by far more than the rounding of a distance, so that the nearest edge itself is found.
  const double widened = bound * (1 + 1e-9);
  double best_squared = widened * widened;
  search(1, point, best_squared);
  return std::sqrt(best_squared);
}

void SegmentTree::search(std::size_t node, const Point& point, double& best_squared) const {
  if (node >= leaf_count_) {
    const std::size_t begin = (node - leaf_count_) * kLeafSize;
    const std::size_t end = std::min(begin + kLeafSize, segments_.size());
    for (std::size_t i = begin; i < end; ++i) {
      best_squared = std::min(best_squared, squared_distance(point, segments_[i].from, segments_[i].to));
    }
    return;
  }
  const std::size_t left = 2 * node;
  const double to_left = squared_distance(point, boxes_[left]);
  const double to_right = squared_distance(point, boxes_[left + 1]);
  const std::size_t nearer = to_right < to_left ? left + 1 : left;
  const std::size_t other = to_right < to_left ? left : left + 1;
  if (std::min(to_left, to_right) < best_squared) search(nearer, point, best_squared);
  if (std::max(to_left, to_right) < best_squared) search(other, point, best_squared);
}

}  // namespace hullbench::metrics
