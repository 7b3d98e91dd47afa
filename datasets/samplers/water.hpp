// Lakes that give no points; stress.hpp says what the kind is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "polylidar/geometry.hpp"

namespace hullbench {

inline constexpr std::size_t kLakes = 4;

/// Discs of one size.
class Lakes {
 public:
  /// None.
  Lakes() = default;
  /// kLakes in `shape`, `level` percent of its area together; centres are uniform in it. Throws as
  /// sample_uniform.
  Lakes(const polylidar::MultiPolygon& shape, double level, std::uint64_t seed);

  bool contain(const polylidar::Point& point) const;
  const std::vector<polylidar::Point>& centres() const { return centres_; }
  double radius() const { return radius_; }

 private:
  std::vector<polylidar::Point> centres_;
  double radius_ = 0;
};

/// `n` of the points that `draw` gives for a number of them and that are in none of `lakes`. More are drawn
/// than needed, so that the density beside the lakes is even, and the ones too many are lost at random.
std::vector<polylidar::Point> draw_beside(
    const Lakes& lakes, std::size_t n, std::uint64_t seed,
    const std::function<std::vector<polylidar::Point>(std::size_t)>& draw);

}  // namespace hullbench
