#include "datasets/stress_shapes.hpp"

#include <algorithm>
#include <cmath>

#include "datasets/holes.hpp"

namespace hullbench {

using polylidar::MultiPolygon;
using polylidar::Ring;

namespace {

/// Counter-clockwise.
Ring box(double left, double bottom, double right, double top) {
  return {{left, bottom}, {right, bottom}, {right, top}, {left, top}};
}

Ring clockwise(Ring ring) {
  std::reverse(ring.begin(), ring.end());
  return ring;
}

/// Area of a disc of radius 1.
double disc_area() {
  static const double area = polylidar::signed_area(circle_ring({0, 0}, 1));
  return area;
}

MultiPolygon pierced(double radius) {
  const double side = std::sqrt(kGradedArea + 4 * disc_area() * radius * radius);
  std::vector<Ring> holes;
  for (const double x : {side / 4, 3 * side / 4}) {
    for (const double y : {side / 4, 3 * side / 4}) holes.push_back(clockwise(circle_ring({x, y}, radius)));
  }
  return {{box(0, 0, side, side), holes}};
}

MultiPolygon annulus(double radius) {
  const double outer = std::sqrt(kGradedArea / disc_area() + radius * radius);
  return {{circle_ring({0, 0}, outer), {clockwise(circle_ring({0, 0}, radius))}}};
}

MultiPolygon windows(double radius) {
  const double side = std::sqrt(kGradedArea + 9 * 4 * radius * radius);
  std::vector<Ring> holes;
  for (const double x : {side / 6, side / 2, 5 * side / 6}) {
    for (const double y : {side / 6, side / 2, 5 * side / 6}) {
      holes.push_back(clockwise(box(x - radius, y - radius, x + radius, y + radius)));
    }
  }
  return {{box(0, 0, side, side), holes}};
}

/// Of the squares with a channel or a bar, as a part of the square's side.
constexpr double kLength = 0.6;

/// A square from the origin on, its upper side broken from `left` to `right` by a slot, or a bar, up to
/// height `end`.
Ring with_slot(double side, double left, double right, double end) {
  return {{0, 0}, {side, 0}, {side, side}, {right, side}, {right, end}, {left, end}, {left, side}, {0, side}};
}

MultiPolygon channel(double width) {
  // side^2 - kLength side width = area
  const double half = kLength * width / 2;
  const double side = half + std::sqrt(half * half + kGradedArea);
  return {{with_slot(side, (side - width) / 2, (side + width) / 2, side - kLength * side), {}}};
}

MultiPolygon peninsula(double width) {
  // side^2 + kLength side width = area
  const double half = kLength * width / 2;
  const double side = std::sqrt(half * half + kGradedArea) - half;
  return {{with_slot(side, (side - width) / 2, (side + width) / 2, side + kLength * side), {}}};
}

MultiPolygon teeth(double width) {
  constexpr double kToothLength = 25;
  constexpr double kUsualLength = 45;  // of the bar, roughly
  const int count = std::max(2, static_cast<int>(std::round((kUsualLength / width + 1) / 2)));
  const double length = (2 * count - 1) * width;
  const double height = (kGradedArea - count * width * kToothLength) / length;
  Ring outline = {{0, 0}, {length, 0}};
  for (int tooth = count - 1; tooth >= 0; --tooth) {
    const double left = 2 * tooth * width;
    if (tooth < count - 1) outline.push_back({left + width, height});
    outline.push_back({left + width, height + kToothLength});
    outline.push_back({left, height + kToothLength});
    if (tooth > 0) outline.push_back({left, height});
  }
  return {{outline, {}}};
}

MultiPolygon squares(double gap) {
  const double side = std::sqrt(kGradedArea / 4);
  const double pitch = side + gap;
  MultiPolygon shape;
  for (const double y : {0.0, pitch}) {
    for (const double x : {0.0, pitch}) shape.push_back({box(x, y, x + side, y + side), {}});
  }
  return shape;
}

MultiPolygon discs(double gap) {
  const double radius = std::sqrt(kGradedArea / (9 * disc_area()));
  const double pitch = 2 * radius + gap;
  MultiPolygon shape;
  for (const double y : {0.0, pitch, 2 * pitch}) {
    for (const double x : {0.0, pitch, 2 * pitch}) shape.push_back({circle_ring({x, y}, radius), {}});
  }
  return shape;
}

MultiPolygon strips(double gap) {
  MultiPolygon shape;
  for (int i = 0; i < 5; ++i) {
    const double left = i * (8 + gap);
    shape.push_back({box(left, 0, left + 8, 50), {}});
  }
  return shape;
}

}  // namespace

const std::vector<GradedShape>& graded_shapes() {
  static const std::vector<GradedShape> shapes = {
      {"pierced", "Square, four round holes, radius", "radius", &pierced},
      {"annulus", "Disc, round hole, radius", "radius", &annulus},
      {"windows", "Square, nine square holes, radius", "radius", &windows},
      {"channel", "Square, channel, width", "width", &channel},
      {"peninsula", "Square, bar on it, width", "width", &peninsula},
      {"teeth", "Teeth and gaps, width", "width", &teeth},
      {"squares", "Four squares, gap", "gap", &squares},
      {"discs", "Nine discs, gap", "gap", &discs},
      {"strips", "Five strips, gap", "gap", &strips},
  };
  return shapes;
}

}  // namespace hullbench
