// Cells of a tissue: shapes that touch each other, as those whose molecules a microscope finds.
#pragma once

#include <cstddef>

#include "polylidar/geometry.hpp"

namespace hullbench {

/// In rows of kTissueColumns.
inline constexpr std::size_t kTissueCells = 48;
inline constexpr std::size_t kTissueColumns = 8;

/// Cell `index`, a polygon without holes, about 20 units across, the same bits on every machine: the Voronoi
/// cell of a point that is up to 0.35 of a cell off its place in a grid, with bent sides. Neighbours share a
/// side: between them is no gap and no overlap but for rounding. std::invalid_argument when `index` is not
/// below kTissueCells.
polylidar::MultiPolygon tissue_cell(std::size_t index);

}  // namespace hullbench
