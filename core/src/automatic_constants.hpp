// The constants of the limit that is chosen automatically.
#pragma once

#include <cstddef>

namespace polylidar::detail {

/// The constants of AutomaticLimit's rule, fitted on the training shapes of this project, some with
/// errors on other shapes in view. core/AUTOMATIC.md says how, and what `make fit-default` finds now. Sizes
/// are lengths: the fourth roots of Triangle::size4().
struct AutomaticConstants {
  /// With this value chance makes a hole in one of a hundred sets.
  static constexpr double kWide = 8;

  double quantile = 0.6;  ///< a block's usual size is this quantile of its triangles' sizes
  double growth = 10;     ///< a block's usual size is at most 1 + growth / sqrt(blocks) times its neighbours'
  double reach = 5;       ///< an edge joins two blocks if it is at most this many usual sizes long
  double noise = 0.12;    ///< standard deviation, by chance alone, of the logarithm of a usual size
  std::size_t smoothed_from = 16;  ///< with fewer blocks none is moved towards its neighbours

  double valley = 2;  ///< the outliers' density is another one from so many standard deviations on

  double usual = 0.667;   ///< the usual limit, in median sizes times sqrt(log n)
  double pull = 10.9;     ///< the cost of a limit away from it, times n^(-1/5)
  double even = 0.33;     ///< most scatter of the spacings where the density varies smoothly
  double doubt = 160;     ///< how strongly more scatter weakens the pull on larger limits
  double still = 0.018;   ///< a growth of the area that counts as none, of up to 5,000 points
  std::size_t below = 3;  ///< the growth is measured over this many cells of the grid below a limit
  std::size_t above = 6;  ///< and this many above it
  double spike = 1.57;    ///< the size from which a triangle may be a spike
  double region = 2.4;    ///< a region has at least this many times log n triangles
  double wide = kWide;    ///< a hole has a triangle whose circle would hold log n + wide points or more;
                          ///< windows always take kWide
  double step = 3;        ///< neighbours on an outline are at most log n + step mean distances apart
};

inline double fourth_power(double x) {
  return (x * x) * (x * x);
}

}  // namespace polylidar::detail
