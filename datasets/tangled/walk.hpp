// A walk: corridors through a grid.
#pragma once

#include "datasets/random.hpp"
#include "polylidar/geometry.hpp"

namespace hullbench {

/// A counter-clockwise ring with the middle of its bounding box on the origin: the outline of cells that form
/// a random tree in a grid of 8 to 12 rows and columns of random widths, 200 units across.
///
/// A cell is added only when it has one neighbour in the tree and touches none of the cells beyond, by an
/// edge or a corner. So the cells enclose no hole, the outline passes no place twice, and any two branches
/// have a whole row or column between them.
polylidar::Ring draw_walk(Random& random);

}  // namespace hullbench
