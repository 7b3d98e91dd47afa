// Points as methods do not hope for them: noisy, with outliers, of uneven density, too regular. Each kind has
// a level, and any shape can be sampled with any kind: the data set "ca~noise:0.5" is California, its points
// moved by noise of half a spacing.
//
// The spacing h of n points in a shape of area A is sqrt(A / n), the side of the square that a point has for
// itself on average.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "polylidar/geometry.hpp"

namespace hullbench {

/// One way to draw points.
struct StressKind {
  std::string name;     ///< in names of data sets: small letters
  std::string title;    ///< as tables print it: "noise"
  std::string unit;     ///< of the level: "h", "%"; empty: a plain number
  std::string meaning;  ///< one sentence, which says what the level is
  double least = 0;     ///< level
  double most = 0;      ///< level
  /// Exactly `n` points of `shape`, the same bits on every machine. `seed` is that of the uniform sample, and
  /// is the same for all levels and kinds, so that levels differ by what they are and not by chance: where a
  /// level changes nothing (see the kinds below), the points are those of sample_uniform. Throws as
  /// sample_uniform and as the kind says.
  std::vector<polylidar::Point> (*sample)(const polylidar::MultiPolygon& shape, std::size_t n, double level,
                                          std::uint64_t seed) = nullptr;
};

/// Every kind.
///
/// noise      Every point of the uniform sample moved by a Gaussian of standard deviation level * h in x and
///            in y. The shape stays as it is, so points lie outside it. 0: the uniform sample.
/// outliers   `level` percent of the points (rounded to a whole number) are no points of the shape but
/// uniform
///            in its bounding box, grown on every side by a tenth of the larger side; they are the last ones.
///            The others are the first of the uniform sample. 0: the uniform sample.
/// gradient   The density falls linearly from left to right over the bounding box, at its left side `level`
///            times that at its right. 1: the uniform sample.
/// clusters   A Thomas process: centres with a density of n / (A * level), round each a Gaussian of standard
///            deviation h; a cluster has `level` points on average. Centres lie up to 6 h outside the
///            bounding box, so that the density does not fall towards the shape's boundary. (Thomas: A
///            Generalization of Poisson's Binomial Limit for Use in Ecology, Biometrika 36, 1949)
/// poisson    No two points closer than level * h, by dart throwing. std::runtime_error when a million darts
/// in
///            a row find no room.
/// lattice    A square lattice of side h, turned by 3.6 to 14.4 degrees, every point moved by up to
///            `level` of a side in x and in y. Turn and place are drawn until exactly n points lie in the
///            shape; std::runtime_error after 10 000 draws.
/// boundary   `level` percent of the points (rounded to a whole number) lie on the rings, uniform over their
///            length and off them only by rounding; they are the last ones. The others are the first of the
///            uniform sample. 0: the uniform sample.
const std::vector<StressKind>& stress_kinds();

/// A kind at a level.
struct Stress {
  const StressKind* kind = nullptr;  ///< never null
  double level = 0;                  ///< from kind->least to kind->most
};

/// The data set's name without its stress, and the stress: {"ca", noise at 0.5} of "ca~noise:0.5", {"ca",
/// none} of "ca". None at all for a name with a '~' that is not followed by a kind, ':' and a level in its
/// range. A level stands as a plain decimal, the shortest there is ("0.5", not "0.50" or ".5"), so that a
/// data set has one name.
std::optional<std::pair<std::string, std::optional<Stress>>> split_stress(const std::string& name);

}  // namespace hullbench
