// The generators of the zoo by the names of their cases; zoo.json says which issue each one is made after.
#pragma once

#include <map>
#include <string>

#include "datasets/zoo/zoo.hpp"

namespace hullbench::zoo {

using Generators = std::map<std::string, Input (*)()>;

/// So few points that every one matters.
Generators few_points();
/// All on a line, or nearly.
Generators flat_points();
/// Equal or nearly equal points.
Generators close_points();
/// Rows, columns, circles, pixels.
Generators lattices();
/// Many points in shapes with parts and holes.
Generators clouds();

}  // namespace hullbench::zoo
