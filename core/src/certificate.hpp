// Which points are surely not on the outline, from occupied cells alone.
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
// that it is greatest in a corner of the box of all d. For fixed d it is greatest where d . u is least, and
// on an arc shorter than 180 degrees that is at an end, unless u = -d / |d| is in between, where it is -|d|:
// then at both ends d . u < 0, as the arc is below 90 degrees, and (1) fails there too.
//
// Rounding. Boxes are widened by kSlack on each side for the grid's rounding (Grid), and the sectors' ends
// are doubles, which differ from unit vectors by less than 2^-50; tested is |d|^2 + kExtra < 2 r (d . u). The
// terms are below 2^9, so that all errors together are below 2^-39, far below kExtra = 2^-20.
//
// The tables are made once from these inequalities; they do not depend on the points, as r is a fixed number
// of cells.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "occupancy.hpp"

namespace polylidar::detail {

/// The disks' radius in cells.
inline constexpr int kRadius = 6;
/// How far away, in columns or rows, a cell can be that covers a sector: 2 r of them away it has points that
/// are 2 r or more from p, which is as far as the disks reach.
inline constexpr int kReach = 2 * kRadius - 1;
static_assert(kReach < static_cast<int>(Grid::kMargin));

/// What the loops over cells are compiled for; all give the same.
enum class Kernel : std::uint8_t { kPortable, kAvx2, kAvx512 };
/// Whether this processor, and this build, has it.
bool is_supported(Kernel kernel);
/// The fastest that is supported.
Kernel best_kernel();

/// Puts into `uncertain`, which is empty in rows [begin, end), the occupied cells of these rows that are not
/// certified as a whole: with p anywhere in the cell. Other rows are left as they are.
void find_uncertain_cells(const Grid& grid, const Bitmap& occupied, Grid::Cell begin, Grid::Cell end,
                          Bitmap& uncertain, Kernel kernel = best_kernel());

/// Of a point the disks of this radius are looked at as well, which most points near the outline have filled
/// on the side of the shape: a radius of two thirds.
inline constexpr int kNearRadius = 4;
static_assert(kNearRadius < kRadius);

/// The table of the test for single points, which knows in which quarter (in x and in y) of its cell one
/// lies, and cuts the directions into 64 sectors: the cells that cover each, for disks of a radius of `kDisk`
/// cells.
template <int kDisk>
class SectorCover {
 public:
  SectorCover();

  /// How far away a cell can be that covers a sector, as kReach.
  static constexpr int kFarthest = 2 * kDisk - 1;
  static constexpr std::size_t kRows = 2 * kFarthest + 1;
  static constexpr std::size_t kSectors = 64;
  static constexpr std::size_t kQuarters = 4;
  /// Sector -> bit c: a cell c - kFarthest columns from the point's own covers it.
  using Row = std::array<std::uint32_t, kSectors>;

  /// The rows of a point, from kFarthest below its own on. `quarter`: row by row.
  const Row* rows(std::size_t quarter) const { return covering_[quarter].data(); }

 private:
  std::array<std::array<Row, kRows>, kQuarters * kQuarters> covering_{};
};

/// Directions: bit k stands for those from k to k + 1 parts of a turn.
using Directions = std::uint16_t;
inline constexpr unsigned kPartsOfTurn = 16;

/// The test for single points.
class PointCertificate {
 public:
  /// The tables are made at the first call in a process, in a fraction of a millisecond.
  static const PointCertificate& instance();

  bool is_certified(const Point& p, Grid::Cell cell, const Grid& grid, const Bitmap& occupied,
                    Kernel kernel = best_kernel()) const;
  /// Whether a point in the middle of the cell would be.
  bool is_middle_certified(Grid::Cell cell, const Grid& grid, const Bitmap& occupied) const;
  /// The directions that have a sector in which a disk of kNearRadius at `p` may be empty. In all others a
  /// Delaunay triangle at p has a circumradius below kNearRadius, if its circumcentre lies there.
  Directions open_directions(const Point& p, Grid::Cell cell, const Grid& grid, const Bitmap& occupied,
                             Kernel kernel = best_kernel()) const;

 private:
  PointCertificate() = default;

  SectorCover<kRadius> cover_;
  SectorCover<kNearRadius> near_cover_;
};

}  // namespace polylidar::detail
