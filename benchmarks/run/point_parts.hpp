// Random parts of points, to see whether a method's result stays when some of them are gone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"

namespace hullbench::run {

/// One draw. Every part keeps the order of the whole.
struct PointParts {
  std::vector<Point> half;        ///< half of them, rounded down
  std::vector<Point> other_half;  ///< all others
  std::vector<Point> most;        ///< 90 %, rounded up, drawn by themselves
};

/// The draw `number` (from 0) of the points of data set `name` with `seed`: the same on every machine.
PointParts draw_parts(std::span<const Point> points, const std::string& name, std::uint64_t seed, int number);

/// `count` of the points in their order, drawn with `seed`: the same on every machine. All of them where
/// there are no more.
std::vector<Point> draw_sample(std::span<const Point> points, std::size_t count, std::uint64_t seed);

}  // namespace hullbench::run
