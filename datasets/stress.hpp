// Points as methods do not hope for them: noisy, with outliers, of uneven density, too regular, as sensors
// give them. Each kind has a level, and any shape can be sampled with any kind: the data set "ca~noise:0.5"
// is California, its points moved by noise of half a spacing. Kinds can be combined:
// "ca~gradient:16~outliers:3~noise:0.5".
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

/// What a kind does. A name has at most one kind of each, in this order, so that a data set has one name.
/// They are applied in another order: points are drawn, those in lakes are left out, they are moved by noise,
/// outliers are put behind them, and all are rounded.
enum class StressRole { kDraws, kDries, kOutliers, kNoise, kRounds };

/// One thing that can be done to points.
struct StressKind {
  std::string name;     ///< in names of data sets: small letters
  std::string title;    ///< as tables print it: "noise"
  std::string unit;     ///< of the level: "h", "%"; empty: a plain number
  std::string meaning;  ///< one sentence, which says what the level is
  double least = 0;     ///< level
  double most = 0;      ///< level
  StressRole role = StressRole::kDraws;
  /// Of a kind that draws, else null: exactly `n` >= 1 points of `shape`, the same bits on every machine. May
  /// throw as sample_uniform and as the kind says.
  std::vector<polylidar::Point> (*draw)(const polylidar::MultiPolygon& shape, std::size_t n, double level,
                                        std::uint64_t seed) = nullptr;
};

/// Every kind.
///
/// Those that change points. h is that of all points, outliers too. 0 changes nothing.
///
/// noise      Every point moved by a Gaussian of standard deviation level * h in x and in y. The shape stays
///            as it is, so points lie outside it.
/// outliers   `level` percent of the points (rounded to a whole number) are no points of the shape but
///            uniform in its bounding box, grown on every side by a tenth of the larger side; they are the
///            last ones. Nothing but rounding moves them.
/// quantised  x and y rounded to multiples of level * h, as files with so many decimals hold them. Points
///            that fall on each other stay, as they do in such files: to draw them anew would even out the
///            density, and never end where there are more points than places. Points lie outside the shape
///            by up to half a step in x and in y.
///
/// water      Four lakes, discs of one size whose centres are uniform in the shape, give no points. Together
///            they have `level` percent of the shape's area, less what they share or have beyond the shore.
///            There are as many points as without them; the density is even beside them. The truth is the
///            shape as it was, lakes and all: what was surveyed, as an airborne scanner gets nothing back
///            from water. (Where the lakes should be holes of the truth: the variant with holes.)
///
/// Those that draw points, instead of the uniform sample. h is that of the points drawn. All points lie in
/// the shape unless said otherwise.
///
/// gradient   The density falls linearly from left to right over the bounding box, at its left side `level`
///            times that at its right. 1: the uniform sample.
/// hotspot    The density has a Gaussian peak, `level` times the background, of standard deviation
///            sqrt(A) / 10 round a point that is uniform in the shape. 1: the uniform sample.
/// clusters   A Thomas process: centres with a density of n / (A * level), round each a Gaussian of standard
///            deviation h; a cluster has `level` points on average. Centres lie up to 6 h outside the
///            bounding box, so that the density does not fall towards the shape's boundary. (Thomas: A
///            Generalization of Poisson's Binomial Limit for Use in Ecology, Biometrika 36, 1949)
///            std::runtime_error when ten million draws in a row miss the shape, as no cluster reaches into
///            it.
/// cascade    The density varies by chance, on all scales down to a 32nd of the extent. The bounding box,
///            turned by chance, is halved ten times; of the halves of each part one has `level` times the
///            density of the other. The logarithm of the density has a standard deviation of
///            1.6 log(level). Towns are a little like that. 1: uniform, but not the uniform sample.
/// poisson    No two points closer than level * h, by dart throwing. std::runtime_error when a million darts
///            in a row find no room.
/// lattice    A square lattice of side h, turned by 3.6 to 14.4 degrees, every point moved by up to
///            `level` of a side in x and in y. Turn and place are drawn until exactly n points lie in the
///            shape; std::runtime_error after 10 000 draws.
/// boundary   `level` percent of the points (rounded to a whole number) lie on the rings, uniform over their
///            length and off them only by rounding; they are the last ones. The others are the first of the
///            uniform sample. 0: the uniform sample.
/// outline    All points on the rings, uniform over their length, and then moved by a Gaussian of standard
///            deviation `level` times their mean distance along the rings, length / n, in x and in y. Points
///            lie outside the shape.
///
/// Those that draw points as a sensor does whose shots hit nothing but the shape. It looks or moves in a
/// direction drawn at random. Its resolution is chosen so that there are n points; up to a twentieth of them
/// and 8 are too many and are lost at random. What falls between its lines gets no point, a small part of the
/// shape too.
///
/// depthcamera  A stereo camera over the floor, half the shape's extent in front of it: `level` is the
///              distance of its middle over the camera's height. A point stands for a pixel, so the density
///              falls with the cube of the depth, from near to far up to 27 to 1; at the middle rows are
///              sqrt(1 + level^2) times as far apart as points of a row. The disparity errs and is rounded as
///              SensorNoise says (rgbd/floor_scenes.hpp), the error shared over windows of 3 x 3 pixels; the
///              baseline is a 40th of the distance of the middle. The lens bends rays by a hundredth at 45
///              degrees off the axis, and nobody knows. At the middle the error is of
///              2 / sqrt(1 + level^2) rows: points lie outside the shape. Half of the pixels with a neighbour
///              off the floor have no depth, nor has one whose disparity comes out below half.
/// airborne     A laser scanner with a rotating mirror over three strips, which cover 0.4 of the extent each
///              and share a quarter with the next: there the density is 2 to 1. Lines are `level` times as
///              far apart as points of a line; points are off by up to a tenth of the latter in x and in y.
/// zigzag       The same with a swinging mirror: lines meet at the sides of a strip; `level` is that of mean
///              distances.
/// rotating     A lidar that stands at a point uniform in the shape. Beams fall at even angles, from straight
///              down to its range, the farthest corner of the shape, 4 times its height; each draws a ring of
///              the same number of points. At half the range rings are `level` times as far apart as points
///              of a ring.
/// tracks       Points along straight roads in two directions at right angles; roads are `level` times as far
///              apart as points of a road and up to a quarter of that off an even grid, points up to a tenth
///              of their mean distance off the middle of the road.
/// transcripts  Molecules that a microscope finds in a cell: each of the cell's own is with a probability of
///              a half of a Gaussian round a nucleus, of standard deviation 0.2 sqrt(A) round a point uniform
///              in the shape, and else uniform. `level` percent of all points (rounded to a whole number) are
///              neighbours' that were taken for this cell's: uniform points which a Gaussian of standard
///              deviation 2 h moves out of the shape; they are the last ones.
const std::vector<StressKind>& stress_kinds();

/// A kind at a level.
struct Stress {
  const StressKind* kind = nullptr;  ///< never null
  double level = 0;                  ///< from kind->least to kind->most
};

/// The data set's name without its stress, and the stresses in the name's order: {"ca", {noise at 0.5}} of
/// "ca~noise:0.5", {"ca", {}} of "ca". None at all for a name with a '~' that is not followed by a kind, ':'
/// and a level in its range, or with kinds in another order than StressRole's. A level stands as a plain
/// decimal, the shortest there is ("0.5", not "0.50" or ".5"), so that a data set has one name.
std::optional<std::pair<std::string, std::vector<Stress>>> split_stress(const std::string& name);

/// Exactly `n` points of `shape` with all of `stresses`, at most one of each role; the same bits on every
/// machine. `seed` is that of the uniform sample, and is the same for all levels and kinds, so that levels
/// differ by what they are and not by chance: where a level changes nothing (see the kinds above), the points
/// are those without it. Throws as sample_uniform and as the kinds say.
std::vector<polylidar::Point> sample_stressed(const polylidar::MultiPolygon& shape, std::size_t n,
                                              const std::vector<Stress>& stresses, std::uint64_t seed);

}  // namespace hullbench
