// Points of uneven density; stress.hpp says what each kind is.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "datasets/random.hpp"
#include "datasets/samplers/scan.hpp"
#include "polylidar/geometry.hpp"

namespace hullbench {

/// A point of `shape`, uniform and independent of the sample that has the same `seed`: where a hot spot has
/// its middle and a rotating lidar its foot. Throws as sample_uniform.
polylidar::Point drawn_place(const polylidar::MultiPolygon& shape, std::uint64_t seed);

/// The standard deviation of a hot spot over the root of the shape's area.
inline constexpr double kHotSpotDeviation = 0.1;

/// A density that is a multiplicative cascade over a shape's bounding box, turned by a random angle: halved
/// ten times, across and along in turn, and of the halves of each part one, drawn by chance, has `level`
/// times the density of the other (Meneveau, Sreenivasan: Simple Multifractal Cascade Model for Fully
/// Developed Turbulence, Physical Review Letters 59, 1987).
class Cascade {
 public:
  /// level >= 1. `random` gives the angle, and then which halves are denser.
  Cascade(const polylidar::MultiPolygon& shape, double level, Random& random);

  /// Its mean over the box is 1.
  double density(const polylidar::Point& point) const;
  /// A point of the box, by chance.
  polylidar::Point draw(Random& random) const;

 private:
  static constexpr std::size_t kHalvings = 10;

  ScanFrame frame_;
  double dense_share_;  ///< of a part's points, in its denser half
  /// Part -> whether its second half is the denser one. Part i has the halves 2 i and 2 i + 1; 1 is the box.
  std::array<bool, std::size_t{1} << kHalvings> is_second_dense_{};
};

std::vector<polylidar::Point> sample_gradient(const polylidar::MultiPolygon& shape, std::size_t n,
                                              double level, std::uint64_t seed);
std::vector<polylidar::Point> sample_hotspot(const polylidar::MultiPolygon& shape, std::size_t n,
                                             double level, std::uint64_t seed);
std::vector<polylidar::Point> sample_clusters(const polylidar::MultiPolygon& shape, std::size_t n,
                                              double level, std::uint64_t seed);
std::vector<polylidar::Point> sample_cascade(const polylidar::MultiPolygon& shape, std::size_t n,
                                             double level, std::uint64_t seed);

}  // namespace hullbench
