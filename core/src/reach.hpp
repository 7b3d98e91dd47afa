// Which cells hold the points near an uncertain one, and whether a triangle's circle lies in such cells.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "certificate.hpp"
#include "delaunay_builder.hpp"
#include "filter_rules.hpp"
#include "half_edge.hpp"
#include "occupancy.hpp"

namespace polylidar::detail {

/// Of the cells that come within some distance of a cell: row, from the lowest on -> how many columns on
/// either side of the cell. The distance is in cells, with a little more for rounding (Grid::kSlack).
template <int kDistance>
constexpr auto make_half_widths() {
  constexpr double kWithin = kDistance + 0x1p-10;
  std::array<unsigned, std::size_t{2 * kDistance + 3}> half_widths{};
  for (int row = -kDistance - 1; row <= kDistance + 1; ++row) {
    const int gap_y = std::max(std::max(row, -row) - 1, 0);
    int columns = 0;
    while (columns * columns + gap_y * gap_y < kWithin * kWithin) ++columns;
    // Between two columns that are k apart lie k - 1 others: the gap to the next one is the first too wide.
    const int from_lowest = row + kDistance + 1;
    half_widths[static_cast<std::size_t>(from_lowest)] = static_cast<unsigned>(columns);
  }
  return half_widths;
}
/// How many of these rows are below the cell.
constexpr Grid::Cell rows_below(std::span<const unsigned> half_widths) {
  return static_cast<Grid::Cell>(half_widths.size() / 2);
}
/// As far as uncertain points reach, 2 r.
inline constexpr auto kReachedHalfWidths = make_half_widths<2 * kRadius>();
/// As most uncertain points reach, with a little of what those in open directions do: for an estimate.
inline constexpr auto kUsualHalfWidths = make_half_widths<2 * kNearRadius + 1>();

/// How far away, in rows, a cell can be that mark_reach() marks: beyond it lie 2 r of rows in between, and as
/// much as rounding may move a point.
inline constexpr Grid::Cell kReachedRows = 2 * kRadius + 1;
/// Marks the cells that may hold a point within 2 r of one in `cell`.
void mark_reach(const Grid& grid, Grid::Cell cell, ReachedCells& reached);
/// Marks the cells that may hold a corner of a triangle at one of these points, which are uncertain. `cells`:
/// point -> its cell; `open`: of each of `uncertain`, PointCertificate::open_directions().
void mark_reach(const Grid& grid, const std::uint32_t* cells, std::span<const std::uint32_t> uncertain,
                std::span<const Directions> open, Bitmap& reached);
/// As the first, for 2.7 r and the corners of these triangles of the mesh.
void mark_reach_round(std::span<const Mesh::Index> triangles, const DelaunayBuilder& builder,
                      const Grid& grid, Bitmap& reached);
void mark_reach_round(std::span<const Mesh::Index> triangles, const DelaunayBuilder& builder,
                      const Grid& grid, ReachedCells& reached);

/// Whether a triangle of a part certainly belongs to the triangulation of all points, whatever its corners:
/// all occupied cells of the box of its circumcircle are among those whose points are in the part.
bool is_surely_whole(const Triangle& triangle, const Grid& grid, const Bitmap& occupied,
                     const Bitmap& reached);
bool is_surely_whole(const Triangle& triangle, const Grid& grid, const ReachedCells& reached);

}  // namespace polylidar::detail
