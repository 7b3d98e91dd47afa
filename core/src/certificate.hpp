// Finds points that are certainly not on the outline, from the occupied cells of a grid.
//
// The claim. Let a grid's cells have the side 1, and let r = kRadius. A point p is *certified* when every
// open disk of radius r whose circle passes through p contains a point of the set. Then no Delaunay triangle
// at p has a circumradius R >= r: its open circumdisk would be empty, and with it the disk of radius r that
// touches it from inside at p.
//
// The test. The disk's centre is c = p + r u, u a unit vector. A point q is in the open disk when
//   |q - p - r u| < r,  which is  |d|^2 < 2 r (d . u)  with d = q - p.                                  (1)
// Cut the directions u into sectors of at most 22.5 degrees. p is known to lie in a box, its cell or a
// quarter of it, and a cell that is occupied has some point q in it. The cell *covers* a sector when (1)
// holds for every q of the cell, every p of its box and every u of the sector. If every sector is covered by
// an occupied cell, p is certified. (The q found is not p itself nor a copy of it, as d = 0 fails (1).)
//
// Covering is decided at corners. For fixed u, the left side minus the right side of (1) is convex in d, so
// it is greatest in a corner of the box of all d. For fixed d it is greatest where d . u is least. On an arc
// shorter than 180 degrees that is one of its ends, unless u = -d / |d| lies in between, where d . u = -|d|.
// In that case d . u < 0 at both ends, as the arc is below 90 degrees, and (1) fails there too.
//
// Few cells need that test. The *core* of a cell C is made of the cells that lie in every open disk of radius
// r with its centre in C. A cell some columns and rows away from C is one of them if
//   (|columns| + 1)^2 + (|rows| + 1)^2 < r^2.                                                           (2)
// Suppose that p is not certified. Then an open disk of radius r with p on its circle is empty, and so is the
// core of the cell of its centre. That cell is at most r + 1 columns and rows away from p's: r, and one more
// for rounding. So p is certified if no cell that near has an empty core. The code asks this of strips of
// cells, and tests the sectors only near an empty core.
//
// Rounding. Boxes are widened by kSlack on each side for the rounding of the grid (Grid). In (2) only the
// core's cells are widened, as C is where the centre exactly lies. The ends of the sectors are doubles, which
// differ from unit vectors by less than 2^-50. The code tests |d|^2 + kExtra < 2 r (d . u). The terms are
// below 2^9, so all errors together are below 2^-39, far below kExtra = 2^-20.
//
// The tables are made once from these inequalities; they do not depend on the points, as r is a fixed number
// of cells.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "kernels.hpp"
#include "occupancy.hpp"

namespace polylidar::detail {

/// The disks' radius in cells.
inline constexpr int kRadius = 6;
/// How far away, in columns or rows, a cell that covers a sector can be. A cell 2 r away has points that are
/// 2 r or more from p, and the disks reach no farther than that.
inline constexpr int kReach = 2 * kRadius - 1;
static_assert(kReach < static_cast<int>(Grid::kMargin));

/// Adds to `uncertain` the occupied cells of rows [begin, end) that are not certified as a whole, that is,
/// for every p in the cell. `uncertain` must be empty in these rows; other rows do not change.
void find_uncertain_cells(const Grid& grid, const Bitmap& occupied, Grid::Cell begin, Grid::Cell end,
                          Bitmap& uncertain, Kernel kernel = best_kernel());

/// A point is also tested with disks of this radius, two thirds of kRadius. For most points near the outline
/// these disks hold another point on the side of the shape.
inline constexpr int kNearRadius = 4;
static_assert(kNearRadius < kRadius);

/// The table of the test for single points: for each of 64 sectors the cells that cover it, for disks with a
/// radius of `kDisk` cells. The test knows in which quarter (in x and in y) of its cell a point lies.
template <int kDisk>
class SectorCover {
 public:
  SectorCover();

  /// How far away a cell that covers a sector can be, as kReach.
  static constexpr int kFarthest = 2 * kDisk - 1;
  static constexpr std::size_t kRows = 2 * kFarthest + 1;
  static constexpr std::size_t kSectors = 64;
  static constexpr std::size_t kQuarters = 4;
  /// Sector -> bit c: a cell c - kFarthest columns from the point's own covers it.
  using Row = std::array<std::uint32_t, kSectors>;

  /// The rows for a point, beginning kFarthest rows below its own. `quarter`: row by row.
  const Row* rows(std::size_t quarter) const { return covering_[quarter].data(); }

 private:
  std::array<std::array<Row, kRows>, kQuarters * kQuarters> covering_{};
};

/// A set of directions: bit k stands for those from k to k + 1 of kTurnFractions equal fractions of a turn.
using Directions = std::uint16_t;
inline constexpr unsigned kTurnFractions = 16;

/// The test for single points.
class PointCertificate {
 public:
  /// The tables are made at the first call in a process, in a fraction of a millisecond.
  static const PointCertificate& instance();

  bool is_certified(const Point& p, Grid::Cell cell, const Grid& grid, const Bitmap& occupied,
                    Kernel kernel = best_kernel()) const;
  /// Whether a point in the middle of the cell would be certified.
  bool is_middle_certified(Grid::Cell cell, const Grid& grid, const Bitmap& occupied) const;
  /// The directions with a sector in which a disk of kNearRadius at `p` may be empty. If the circumcentre of
  /// a Delaunay triangle at p lies in any other direction, its circumradius is below kNearRadius.
  Directions open_directions(const Point& p, Grid::Cell cell, const Grid& grid, const Bitmap& occupied,
                             Kernel kernel = best_kernel()) const;

 private:
  PointCertificate() = default;

  SectorCover<kRadius> cover_;
  SectorCover<kNearRadius> near_cover_;
};

}  // namespace polylidar::detail
