#include "clusters.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "outline_steps.hpp"
#include "quantile.hpp"

namespace polylidar::detail {

namespace {

/// How much a length scatters among the triangles of a block: the logarithm of its 0.8 quantile over its 0.4
/// quantile. for_each_length4(block, of_all, visit) calls visit() for the fourth powers of the lengths of
/// some triangles, or of all. Returns the 0.4 quantile of this over up to 32 blocks, as a block along a thin
/// part of the shape also has triangles outside it, which scatter more; 0 where no block has enough.
template <class ForEach>
double scatter_in_blocks(std::size_t blocks, const ForEach& for_each_length4) {
  constexpr std::size_t kMostBlocksLookedAt = 32;
  constexpr std::size_t kFewest = 16;  // triangles
  constexpr std::size_t kEnough = 32;  // of some: with fewer, as points repeat others, all are looked at
  constexpr double kQuantile = 0.4;
  std::vector<double> scatters;
  std::vector<double> lengths4;
  constexpr std::size_t kUsualMost = 1024;
  lengths4.reserve(kUsualMost);
  for (std::size_t b = 0; b < blocks; b += (blocks - 1) / kMostBlocksLookedAt + 1) {
    for (const bool of_all : {false, true}) {
      lengths4.clear();
      for_each_length4(b, of_all, [&](double length4) { lengths4.push_back(length4); });
      if (lengths4.size() >= kEnough) break;
    }
    const std::size_t count = lengths4.size();
    if (count < kFewest) continue;
    const Ranking ranking(lengths4);
    const std::size_t small_place = 2 * count / 5;
    const std::size_t large_place = 4 * count / 5;
    const std::optional<double> small = ranking.at(small_place);
    const std::optional<double> large = ranking.at(large_place);
    const double small4 = small ? *small : value_at(lengths4, small_place);
    const double large4 = large ? *large : value_at(lengths4, large_place);
    scatters.push_back(small4 > 0 ? std::log(large4 / small4) / 4 : 0);
  }
  return scatters.empty() ? 0 : quantile_of(scatters, kQuantile);
}

/// Of few blocks, all together, by the shortest edges alone.
double excess_scatter_of_edges(const SizedMesh& sized, const AutomaticConstants& constants) {
  constexpr Mesh::Index kRecords = 512;
  constexpr double kTwoDeviations = 1.8;  // of a scatter, times the root of the number of triangles
  const Mesh& mesh = sized.mesh;
  std::size_t count = 0;
  std::size_t flat = 0;
  const double scatter = scatter_in_blocks(1, [&](std::size_t, bool of_all, const auto& visit) {
    const Mesh::Index step = of_all ? 1U : std::max(Mesh::Index{1}, mesh.triangle_count() / kRecords);
    count = flat = 0;
    for_some_triangles(mesh, 0, mesh.triangle_count(), step, [&](Mesh::Index t) {
      const Triangle triangle = sized.triangle(t);
      const double squared = triangle.squared_shortest_edge();
      visit(squared * squared);
      ++count;
      flat += is_flat(triangle.twice_area(), triangle.squared_longest_edge()) ? 1U : 0U;
    });
  });
  if (2 * flat >= count) return 0;
  return std::max(scatter - constants.even_edges - kTwoDeviations / std::sqrt(static_cast<double>(count)),
                  0.0);
}

/// The usual limit leaves the points in pieces: returns the share of them that is not in the largest piece.
double share_outside_largest_piece(const SizedMesh& sized, const UsualLimit& usual) {
  const Mesh& mesh = sized.mesh;
  const auto for_each_triangle = [&](const auto& visit) {
    for_some_triangles(mesh, 0, mesh.triangle_count(), 1, visit);
  };
  // Point -> a point of the same piece, itself if it stands for the piece; kNone if it repeats another.
  std::vector<Mesh::Index> next(usual.block_of_vertex.size(), kNone);
  double points = 0;
  for_each_triangle([&](Mesh::Index t) {
    for (Mesh::Index k = 0; k < 3; ++k) {
      const Mesh::Index v = mesh.corners(t)[k];
      points += next[v] == kNone ? 1 : 0;
      next[v] = v;
    }
  });
  const auto standing_for = [&](Mesh::Index v) {
    while (next[v] != v) v = next[v] = next[next[v]];
    return v;
  };
  for_each_triangle([&](Mesh::Index t) {
    if (sized.size4_of(t) > usual.limit4 * usual.usual4[usual.block_of_vertex[t / 2]]) return;
    const Mesh::Index* const corner = mesh.corners(t);
    next[standing_for(corner[0])] = standing_for(corner[1]);
    next[standing_for(corner[1])] = standing_for(corner[2]);
  });
  std::vector<std::uint32_t> points_of_piece(next.size());
  for (const Mesh::Index v : next) {
    if (v != kNone) ++points_of_piece[standing_for(v)];
  }
  return 1 - *std::max_element(points_of_piece.begin(), points_of_piece.end()) / points;
}

}  // namespace

double excess_scatter(const SizedMesh& sized, const MeshBlocks& blocks, const UsualLimit& usual,
                      const AutomaticConstants& constants) {
  constexpr std::size_t kFewestBlocks = 16;
  constexpr std::size_t kEnoughBlocks = 96;
  constexpr Mesh::Index kRecords = 128;  // of a block
  constexpr double kSurely = 0.4;        // of the excess, where pieces must confirm it
  const auto share_in_pieces = [&](double most) {
    return std::min(1.0, share_outside_largest_piece(sized, usual) / most);
  };
  if (blocks.count() < kFewestBlocks) {
    const double excess = excess_scatter_of_edges(sized, constants);
    return excess == 0 ? 0 : kSurely * excess * share_in_pieces(0.25);
  }
  const auto scatter = [&](const auto& length4_of) {
    return scatter_in_blocks(blocks.count(), [&](std::size_t block, bool of_all, const auto& visit) {
      const MeshBlocks::Records records = blocks.records_of(sized.mesh, block);
      const Mesh::Index step =
          of_all ? 1U : std::max(Mesh::Index{1}, (records.end - records.begin) / kRecords);
      for_some_triangles(sized.mesh, records.begin, records.end, step,
                         [&](Mesh::Index t) { visit(length4_of(t)); });
    });
  };
  const double of_sizes = scatter([&](Mesh::Index t) { return sized.size4_of(t); }) - constants.even_sizes;
  if (of_sizes <= 0) return 0;
  const double of_edges = scatter([&](Mesh::Index t) {
    const double squared = sized.triangle(t).squared_shortest_edge();
    return squared * squared;
  });
  const double excess = std::clamp(of_edges - constants.even_edges, 0.0, of_sizes);
  if (excess == 0 || blocks.count() >= kEnoughBlocks) return excess;
  return excess * (kSurely + (1 - kSurely) * share_in_pieces(0.5));
}

double excess_scatter(const WindowSample& windows, const AutomaticConstants& constants) {
  const std::size_t step = windows.kept_step();
  const std::size_t kept_windows = (windows.window_ends().size() - 1) / step + 1;
  const auto scatter = [&](const auto& length4_of) {
    return scatter_in_blocks(kept_windows, [&](std::size_t kept, bool /*of_all*/, const auto& visit) {
      const std::size_t place = kept * step;
      const std::size_t begin = place == 0 ? 0 : windows.window_ends()[place - 1];
      for (std::size_t i = begin; i < windows.window_ends()[place]; ++i) {
        visit(length4_of(windows.triangles()[i]));
      }
    });
  };
  const double of_sizes =
      scatter([](const WindowSample::Measured& one) { return one.size4; }) - constants.even_sizes;
  if (of_sizes <= 0) return 0;
  const double of_edges =
      scatter([](const WindowSample::Measured& one) { return one.squared_shortest * one.squared_shortest; });
  return std::clamp(of_edges - constants.even_edges, 0.0, of_sizes);
}

}  // namespace polylidar::detail
