// The families of shapes that are made, not read: by name, how many there are and how to get each.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "datasets/shapes.hpp"
#include "polylidar/geometry.hpp"

namespace hullbench {

/// Shapes of one kind, numbered 0 .. count - 1, each the same on every machine.
struct ShapeFamily {
  std::string name;       ///< identifier, unique among the families: "star"
  std::string title;      ///< as printed in tables: "Star-shaped polygon"
  std::string source;     ///< where the kind of shape comes from, one sentence
  std::string licence;    ///< of the shapes
  std::size_t count = 0;  ///< >= 1
  /// None: no variants with holes. The seed is the family's; each shape derives its own.
  std::optional<HoleParameters> holes = {};
  /// What the member's number, index + 1, measures ("radius", see stress_shapes.hpp): then the members are
  /// one shape at several levels. Empty: each member is a shape of its own.
  std::string feature = {};
  /// The shape without added holes; std::invalid_argument when `index` is not below count.
  std::function<polylidar::MultiPolygon(std::size_t index)> make;
};

/// Every family, the paper's first, those with a feature last.
const std::vector<ShapeFamily>& shape_families();

/// Shape `index` of `family`; `holes`: with the family's circular holes cut out, which lie in the same places
/// on every machine. A shape without holes is family.make(index).
///
/// Throws std::invalid_argument when `index` is not below family.count, or `holes` is asked of a family that
/// has none; otherwise as with_circular_holes.
polylidar::MultiPolygon family_shape(const ShapeFamily& family, std::size_t index, bool holes);

}  // namespace hullbench
