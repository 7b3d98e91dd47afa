// The points of a data set one after the other, so that there may be more of them than fit into memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "datasets/random.hpp"
#include "datasets/samplers/water.hpp"
#include "datasets/sampling.hpp"
#include "datasets/stress.hpp"
#include "polylidar/geometry.hpp"

namespace hullbench {

/// What sample_stressed returns, point by point. A copy goes on from where its original is.
class PointStream {
 public:
  /// These points as they are.
  explicit PointStream(std::vector<polylidar::Point> points);
  /// A kind that draws is drawn at once and kept: 16 bytes a point, and some times more while it is drawn.
  /// Uniform points are drawn when they are asked for and take no memory. Throws as sample_stressed.
  PointStream(const polylidar::MultiPolygon& shape, std::size_t n, const std::vector<Stress>& stresses,
              std::uint64_t seed);

  /// Of all points, given or not.
  std::size_t size() const { return size_; }

  /// The next point. There are size() of them; what comes after the last is not defined.
  polylidar::Point next();

 private:
  polylidar::Point next_drawn();
  polylidar::Point next_inner();

  std::size_t size_ = 0;
  std::size_t given_ = 0;  ///< points
  std::size_t inner_ = 0;  ///< points that are no outliers; they come first
  std::shared_ptr<const std::vector<polylidar::Point>> drawn_;  ///< null: they are uniform
  std::optional<UniformPoints> uniform_;                        ///< none: they are drawn
  Lakes lakes_;
  double deviation_ = 0;  ///< of the noise, units of the coordinates
  double step_ = 0;       ///< of the rounding; 0: none
  polylidar::Box outlier_box_;
  Random noise_{0};
  Random outliers_{0};
};

}  // namespace hullbench
