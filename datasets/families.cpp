#include "datasets/families.hpp"

#include <stdexcept>
#include <utility>

#include "datasets/holes.hpp"
#include "datasets/random.hpp"
#include "datasets/star_polygons.hpp"
#include "datasets/stress_shapes.hpp"
#include "datasets/tangled_shapes.hpp"
#include "datasets/tissue.hpp"
#include "datasets/world_shapes.hpp"

namespace hullbench {

using polylidar::MultiPolygon;

namespace {

ShapeFamily star_family() {
  return {.name = "star",
          .title = "Star-shaped polygon",
          .source =
              "Random polygons as J. Castagno and E. Atkins describe them in Polylidar - Polygons from "
              "Triangular Meshes (section on random polygon tests), drawn anew",
          .licence = "MIT",
          .count = kStarPolygons,
          .holes = HoleParameters{.count = 5, .radius = 7.5, .seed = 2021},
          .make = star_polygon};
}

template <TangledKind kKind>
ShapeFamily tangled_family(const char* title, const char* source) {
  return {.name = tangled_name(kKind),
          .title = title,
          .source = source,
          .licence = "MIT",
          .count = tangled_count(kKind),
          .make = [](std::size_t index) { return tangled_shape(kKind, index); }};
}

ShapeFamily graded_family(const GradedShape& shape) {
  const auto make = [make_shape = shape.make](std::size_t index) {
    if (index >= kGradedMembers) {
      throw std::invalid_argument("there are only " + std::to_string(kGradedMembers) +
                                  " shapes of this kind");
    }
    return make_shape(static_cast<double>(index + 1));
  };
  return {.name = shape.name,
          .title = shape.title,
          .source = "Drawn for this project: the " + shape.feature +
                    " is the member's number in spacings of 2000 points",
          .licence = "MIT",
          .count = kGradedMembers,
          .feature = shape.feature,
          .make = make};
}

std::vector<ShapeFamily> make_families() {
  std::vector<ShapeFamily> families = {
      star_family(),
      tangled_family<TangledKind::kComb>(
          "Comb", "Drawn for this project: a bar with teeth of random width, length and gap"),
      tangled_family<TangledKind::kSpiral>("Spiral",
                                           "Drawn for this project: a band along an Archimedean spiral"),
      tangled_family<TangledKind::kPartition>(
          "Polygon from a partition",
          "Drawn for this project: a polygon grown triangle by triangle in a randomly shifted lattice"),
      tangled_family<TangledKind::kWalk>("Walk on a grid",
                                         "Drawn for this project: the cells of a random tree in a grid"),
      tangled_family<TangledKind::kNested>("Nested rings",
                                           "Drawn for this project: rings with islands in their holes"),
      tangled_family<TangledKind::kParts>("Separate parts",
                                          "Drawn for this project: blobs, combs and boxes with gaps between"),
  };
  families.push_back(
      {.name = "cell",
       .title = "Cell of a tissue",
       .source = "Drawn for this project: Voronoi cells with bent sides, which touch each other",
       .licence = "MIT",
       .count = kTissueCells,
       .make = tissue_cell});
  for (ShapeFamily& family : world_families()) families.push_back(std::move(family));
  for (const GradedShape& shape : graded_shapes()) families.push_back(graded_family(shape));
  return families;
}

}  // namespace

const std::vector<ShapeFamily>& shape_families() {
  static const std::vector<ShapeFamily> families = make_families();
  return families;
}

MultiPolygon family_shape(const ShapeFamily& family, std::size_t index, bool holes) {
  MultiPolygon shape = family.make(index);
  if (!holes) return shape;
  if (!family.holes) {
    throw std::invalid_argument("the shapes of family '" + family.name + "' have no variants with holes");
  }
  const std::string label = "holes/" + family.name + "-" + std::to_string(index);
  return with_circular_holes(shape, family.holes->count, family.holes->radius,
                             derive_seed(family.holes->seed, label));
}

}  // namespace hullbench
