#include "datasets/point_stream.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "datasets/samplers/draw.hpp"
#include "polylidar/point_locator.hpp"

namespace hullbench {

using polylidar::Box;
using polylidar::MultiPolygon;
using polylidar::Point;
using polylidar::PointLocator;

namespace {

const Stress* find_role(const std::vector<Stress>& stresses, StressRole role) {
  const auto found = std::find_if(stresses.begin(), stresses.end(),
                                  [&](const Stress& stress) { return stress.kind->role == role; });
  return found == stresses.end() ? nullptr : &*found;
}

/// 0, which changes nothing, where there is no stress of the role.
double level_of(const std::vector<Stress>& stresses, StressRole role) {
  const Stress* found = find_role(stresses, role);
  return found == nullptr ? 0 : found->level;
}

Lakes lakes_of(const MultiPolygon& shape, const std::vector<Stress>& stresses, std::uint64_t seed) {
  const double level = level_of(stresses, StressRole::kDries);
  return level > 0 ? Lakes(shape, level, seed) : Lakes();
}

Box box_of_outliers(const MultiPolygon& shape) {
  const Box bounds = PointLocator(shape).bounds();
  return grown(bounds, std::max(bounds.max.x - bounds.min.x, bounds.max.y - bounds.min.y) / 10);
}

}  // namespace

PointStream::PointStream(std::vector<Point> points)
    : size_(points.size()),
      inner_(size_),
      drawn_(std::make_shared<const std::vector<Point>>(std::move(points))) {}

PointStream::PointStream(const MultiPolygon& shape, std::size_t n, const std::vector<Stress>& stresses,
                         std::uint64_t seed)
    : size_(n),
      inner_(n - share(n, level_of(stresses, StressRole::kOutliers))),
      lakes_(lakes_of(shape, stresses, seed)),
      outlier_box_(box_of_outliers(shape)),
      noise_(derive_seed(seed, "noise")),
      outliers_(derive_seed(seed, "outliers")) {
  const Stress* kind = find_role(stresses, StressRole::kDraws);
  // Where all points are outliers there is nothing to draw, and no spacing.
  if (kind == nullptr || inner_ == 0) {
    uniform_.emplace(shape, seed);
  } else {
    const auto draw = [&](std::size_t count) { return kind->kind->draw(shape, count, kind->level, seed); };
    drawn_ = std::make_shared<const std::vector<Point>>(draw_beside(lakes_, inner_, seed, draw));
  }
  // The spacing of no points is infinite, and 0 times it is no number.
  if (n == 0) return;
  deviation_ = level_of(stresses, StressRole::kNoise) * spacing(shape, n);
  step_ = level_of(stresses, StressRole::kRounds) * spacing(shape, n);
}

Point PointStream::next_drawn() {
  if (drawn_) return (*drawn_)[given_];
  while (true) {
    const Point point = uniform_->next();
    if (!lakes_.contain(point)) return point;
  }
}

Point PointStream::next_inner() {
  const Point point = next_drawn();
  return deviation_ > 0 ? moved_by_gaussian(point, deviation_, noise_) : point;
}

Point PointStream::next() {
  const Point point = given_ < inner_ ? next_inner() : uniform_in(outlier_box_, outliers_);
  ++given_;
  if (!(step_ > 0)) return point;
  return {step_ * std::round(point.x / step_), step_ * std::round(point.y / step_)};
}

}  // namespace hullbench
