#include "datasets/tangled_shapes.hpp"

#include <stdexcept>

#include "datasets/random.hpp"
#include "datasets/tangled/comb.hpp"
#include "datasets/tangled/draws.hpp"
#include "datasets/tangled/ring_steps.hpp"

namespace hullbench {

using polylidar::MultiPolygon;
using polylidar::Ring;

namespace {

constexpr std::uint64_t kTangledSeed = 2022;

MultiPolygon one_polygon(Ring ring) {
  return {{.shell = std::move(ring), .holes = {}}};
}

MultiPolygon draw(TangledKind kind, Random& random) {
  switch (kind) {
    case TangledKind::kComb:
      return one_polygon(draw_comb(random));
    case TangledKind::kSpiral:
      return one_polygon(draw_spiral(random));
    case TangledKind::kPartition:
      return one_polygon(draw_partition(random));
    case TangledKind::kWalk:
      return one_polygon(draw_walk(random));
    case TangledKind::kNested:
      return draw_nested(random);
    case TangledKind::kParts:
      return draw_parts(random);
  }
  throw std::invalid_argument("there is no such kind of tangled shape");
}

}  // namespace

std::string tangled_name(TangledKind kind) {
  static constexpr std::array kNames{"comb", "spiral", "partition", "walk", "nested", "parts"};
  return kNames.at(static_cast<std::size_t>(kind));
}

std::size_t tangled_count(TangledKind kind) {
  return kind == TangledKind::kNested || kind == TangledKind::kParts ? 166 : 167;
}

MultiPolygon tangled_shape(TangledKind kind, std::size_t index) {
  const std::string name = tangled_name(kind);
  if (index >= tangled_count(kind)) {
    throw std::invalid_argument("there is no shape " + std::to_string(index) + " of kind '" + name +
                                "'; the last one is " + std::to_string(tangled_count(kind) - 1));
  }
  Random random(derive_seed(kTangledSeed, name + "/" + std::to_string(index)));
  MultiPolygon shape = draw(kind, random);
  turn(shape, random.uniform());
  return shape;
}

}  // namespace hullbench
