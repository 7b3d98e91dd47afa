// Outlines of real things: countries, counties, clip art, clothes, characters and symbols, from freely
// licensed sources (datasets/world/make_world.py). A family a source.
#pragma once

#include <vector>

#include "datasets/families.hpp"

namespace hullbench {

/// The families "country", "county", "clipart", "fashion", "han" and "symbol", 290 shapes together, as
/// datasets/shapes/world/manifest.json lists them. Every shape is a valid multipolygon in a square of side
/// 200, with at most 900 vertices and without parts and holes below a thousandth of its area.
///
/// A family's file is read when its first shape is asked for; make() then throws std::runtime_error naming
/// the file when it is missing, or its SHA-256 or its number of shapes is not the manifest's. make() may be
/// called from several threads.
std::vector<ShapeFamily> world_families();

}  // namespace hullbench
