// What the generators of the zoo share.
#pragma once

#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

#include "datasets/random.hpp"
#include "datasets/zoo/zoo.hpp"
#include "polylidar/geometry.hpp"

namespace hullbench::zoo {

/// The generator's own random numbers; `label` is unique.
Random numbers(std::string_view label);

/// `value` rounded to whole multiples of 1 / `per_unit`, as recorded coordinates are: decimal(x, 100) has two
/// decimals.
inline double decimal(double value, double per_unit) {
  return std::round(value * per_unit) / per_unit;
}

/// Both coordinates rounded so.
inline polylidar::Point decimal(polylidar::Point point, double per_unit) {
  return {decimal(point.x, per_unit), decimal(point.y, per_unit)};
}

/// An axis-parallel rectangle.
polylidar::Ring rectangle(double left, double bottom, double width, double height);

/// `n` points in `shape`, uniform.
std::vector<polylidar::Point> sample(const polylidar::MultiPolygon& shape, std::size_t n,
                                     std::string_view label);

/// Points of a shape, and the shape.
Input sampled(const polylidar::MultiPolygon& shape, std::size_t n, std::string_view label);

/// Another order of the same values, every one as likely.
template <typename Value>
void shuffle(std::vector<Value>& values, Random& random) {
  for (std::size_t i = values.size(); i > 1; --i) std::swap(values[i - 1], values[random.below(i)]);
}

}  // namespace hullbench::zoo
