#include "spacings.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "some_triangles.hpp"

namespace polylidar::detail {

namespace {

constexpr std::size_t kMostSpacings = 1024;  // about so many are looked at

/// As whole numbers doubles that are not negative have the same order, and the smaller of two is found
/// without a branch. NaN, here that of a ghost, is above infinity.
std::uint64_t in_order(double size4) {
  return std::bit_cast<std::uint64_t>(size4);
}

}  // namespace

Around look_around(const SizedMesh& sized, Mesh::Index e) {
  const Mesh& mesh = sized.mesh;
  const Point& point = sized.vertices[mesh.origin(e)];
  std::uint64_t first = in_order(std::numeric_limits<double>::infinity());
  std::uint64_t second = first;
  std::uint64_t third = first;
  double squared = std::numeric_limits<double>::infinity();
  Mesh::Index turned = e;
  do {
    const Mesh::Index t = Mesh::triangle_of(turned);
    const Mesh::Index other = mesh.origin(Mesh::next(turned));
    const std::uint64_t size4 = in_order(sized.size4 != nullptr ? sized.size4[t]
                                         : mesh.is_ghost(t)     ? std::numeric_limits<double>::quiet_NaN()
                                                                : sized.triangle(t).size4());
    third = std::min(third, std::max(size4, second));
    second = std::min(second, std::max(size4, first));
    first = std::min(first, size4);
    if (other != kNone) squared = std::min(squared, squared_length(sized.vertices[other] - point));
    turned = mesh.twin(Mesh::previous(turned));
  } while (turned != e);
  return {std::bit_cast<double>(third), squared * squared};
}

Spacings look_around_some(const SizedMesh& sized) {
  Spacings result;
  result.corners.reserve(std::size_t{2} * kMostSpacings);
  for_some_triangles(sized.mesh, kMostSpacings,
                     [&](Mesh::Index t) { result.corners.push_back(Mesh::kStride * t); });
  result.around.reserve(result.corners.size());
  for (const Mesh::Index corner : result.corners) result.around.push_back(look_around(sized, corner));
  return result;
}

}  // namespace polylidar::detail
