// What is left of the triangles within the limit when small regions are dropped and holes are filled, against
// a walk through all triangles.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/src/delaunay_builder.hpp"
#include "core/src/region.hpp"
#include "core/src/size_field.hpp"
#include "core/src/thread_pool.hpp"
#include "tests/point_sets.hpp"

namespace polylidar::detail {
namespace {

using testing::Random;
using Points = std::vector<Point>;

constexpr double kNoSpike = 1e300;

struct Filtered {
  Filtered(const Points& points, SizeField given) : field(std::move(given)) {
    ThreadPool pool;
    pool.use(1);
    builder.build(points, pool);
    std::vector<Mesh::Index> boundary;
    filter.run(builder.mesh(), builder.vertices(), field, false, pool, boundary);
  }
  bool is_within_limit(Mesh::Index t) const {
    const Mesh& mesh = builder.mesh();
    return !mesh.is_ghost(t) && Triangle(mesh, builder.vertices(), t).size4() <= field.limit4.front();
  }

  SizeField field;
  DelaunayBuilder builder;
  RegionFilter filter;
};

// Triangle -> whether it is within the limit and of a region of at least `least_region` triangles; of all
// that are within the limit, where no region is so large.
std::vector<bool> of_large_regions(const Filtered& filtered, std::size_t least_region) {
  const Mesh& mesh = filtered.builder.mesh();
  std::vector<bool> is_seen(mesh.triangle_count());
  std::vector<bool> is_large(mesh.triangle_count());
  std::vector<bool> is_kept(mesh.triangle_count());
  bool any = false;
  for (Mesh::Index start = 0; start < mesh.triangle_count(); ++start) {
    is_kept[start] = filtered.is_within_limit(start);
    if (is_seen[start] || !is_kept[start]) continue;
    std::vector<Mesh::Index> region{start};
    is_seen[start] = true;
    for (std::size_t next = 0; next < region.size(); ++next) {
      for (Mesh::Index k = 0; k < 3; ++k) {
        const Mesh::Index other = Mesh::triangle_of(mesh.twin(Mesh::kStride * region[next] + k));
        if (is_seen[other] || !filtered.is_within_limit(other)) continue;
        is_seen[other] = true;
        region.push_back(other);
      }
    }
    if (region.size() < least_region) continue;
    any = true;
    for (const Mesh::Index t : region) is_large[t] = true;
  }
  return any ? is_large : is_kept;
}

TEST(SizeFilter, DropsRegionsOfFewTriangles) {
  std::size_t dropped = 0;
  std::size_t kept = 0;
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    Points points = testing::uniform_points(20 + random.below(1500), seed);
    if (seed % 5 == 1) {  // many rings: a lattice with gaps
      points = testing::lattice(5 + random.below(30), 5 + random.below(30));
      std::erase_if(points, [&](const Point&) { return random.below(4) == 0; });
      for (Point& p : points) p = {p.x / 30, p.y / 30};
    }
    const double spacing = seed % 5 == 1 ? 1.0 / 30 : 1 / std::sqrt(static_cast<double>(points.size()));
    const std::size_t least_region = random.below(40);
    const Filtered filtered(points, {.limit4 = {std::pow(spacing * random.between(0.6, 2.2), 4)},
                                     .spike_share = kNoSpike,
                                     .least_region = least_region});
    const std::vector<bool> expected = of_large_regions(filtered, least_region);
    for (Mesh::Index t = 0; t < filtered.builder.mesh().triangle_count(); ++t) {
      ASSERT_EQ(filtered.builder.mesh().is_kept(t), expected[t]) << t;
      kept += expected[t] ? 1U : 0U;
      dropped += !expected[t] && filtered.is_within_limit(t) ? 1U : 0U;
    }
  }
  EXPECT_GT(kept, 100'000U);
  EXPECT_GT(dropped, 10'000U);
}

// Triangle -> whether it is beyond the limit and connected by such triangles to the outside.
std::vector<bool> reached_from_outside(const Filtered& filtered) {
  const Mesh& mesh = filtered.builder.mesh();
  std::vector<bool> is_reached(mesh.triangle_count());
  std::vector<Mesh::Index> reached;
  for (Mesh::Index t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.is_ghost(t) && !mesh.is_unused(t)) reached.push_back(t);
  }
  for (std::size_t next = 0; next < reached.size(); ++next) {
    for (Mesh::Index k = 0; k < 3; ++k) {
      const Mesh::Index other = Mesh::triangle_of(mesh.twin(Mesh::kStride * reached[next] + k));
      if (mesh.is_ghost(other) || is_reached[other] || filtered.is_within_limit(other)) continue;
      is_reached[other] = true;
      reached.push_back(other);
    }
  }
  return is_reached;
}

TEST(SizeFilter, FillsHolesButNothingThatTheOutsideReaches) {
  constexpr double kFillsAll = 1e9;
  std::size_t outside = 0;
  std::size_t filled = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Points points = testing::uniform_points(20 + random.below(1000), seed);
    const double size = random.between(0.8, 2.2) / std::sqrt(static_cast<double>(points.size()));
    const Filtered filtered(
        points, {.limit4 = {std::pow(size, 4)}, .spike_share = kNoSpike, .wide_square = kFillsAll});
    const std::vector<bool> is_outside = reached_from_outside(filtered);
    const Mesh& mesh = filtered.builder.mesh();
    for (Mesh::Index t = 0; t < mesh.triangle_count(); ++t) {
      if (mesh.is_ghost(t)) continue;
      ASSERT_EQ(mesh.is_kept(t), !is_outside[t]) << t;
      outside += is_outside[t] ? 1U : 0U;
      filled += mesh.is_kept(t) && !filtered.is_within_limit(t) ? 1U : 0U;
    }
  }
  EXPECT_GT(outside, 10'000U);
  EXPECT_GT(filled, 10'000U);
}

}  // namespace
}  // namespace polylidar::detail
