// A hull of a stream as a shape by index, which can be cleaned and simplified as others are.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "polylidar/stream.hpp"
#include "tool/shapes/index_shape.hpp"

namespace polylidar::tool {

struct StreamedShape {
  IndexShape shape;                    ///< indices into the two below
  std::vector<std::uint64_t> numbers;  ///< of the vertices, as points of the source; ascending, each once
  std::vector<Point> points;           ///< where they are
};

StreamedShape streamed_shape(const StreamedHull& hull);

/// The points of these ascending `numbers` in `sources`, which are one after the other, and are read once.
std::vector<Point> points_of_numbers(std::span<const PointSource> sources,
                                     const std::vector<std::uint64_t>& numbers);

}  // namespace polylidar::tool
