#include "mesh_blocks.hpp"

#include <algorithm>
#include <bit>

#include "quantile.hpp"
#include "vector.hpp"

namespace polylidar::detail {

namespace {

/// About so many triangles of a block are looked at. Where that finds fewer than a quarter of them, since the
/// records of points that repeat others are unused, all are.
constexpr std::size_t kMeasured = 64;

}  // namespace

void MeshBlocks::divide(const DelaunayBuilder& builder, double points,
                        std::vector<std::uint32_t>& block_of_vertex) {
  const std::size_t count = builder.vertex_count();
  const double blocks = std::clamp(points / kPoints, 1.0, static_cast<double>(kMost));
  const auto usual = static_cast<std::size_t>(static_cast<double>(count) / blocks);
  const std::size_t least = std::max<std::size_t>(1, usual / 2);
  const std::size_t most = usual + least;
  const std::uint32_t* const keys = builder.keys();
  ends_.clear();
  for (std::size_t begin = 0; begin < count;) {
    std::size_t end = count;
    if (count - begin > most) {
      // Where the curve leaves the largest cell; of several such places the last.
      std::uint32_t highest = 0;
      for (std::size_t i = begin + least; i <= begin + most; ++i) {
        const std::uint32_t differing = keys[i - 1] ^ keys[i];
        if (differing < highest) continue;
        highest = std::bit_floor(differing);
        end = i;
      }
    }
    ends_.push_back(end);
    begin = end;
  }
  block_of_vertex.resize(count);
  for (std::size_t b = 0, v = 0; b < ends_.size(); ++b) {
    for (; v < ends_[b]; ++v) block_of_vertex[v] = static_cast<std::uint32_t>(b);
  }
}

MeshBlocks::Records MeshBlocks::records_of(const Mesh& mesh, std::size_t block) const {
  return {static_cast<Mesh::Index>(block == 0 ? 0 : 2 * ends_[block - 1]),
          std::min(mesh.triangle_count(), static_cast<Mesh::Index>(2 * ends_[block]))};
}

void MeshBlocks::measure(const SizedMesh& sized, std::span<const std::uint32_t> block_of_vertex,
                         double quantile, ThreadPool& pool, UsualSizes& sizes) {
  const Chunks chunks(pool, sized.mesh.triangle_count());
  const std::size_t blocks = count();
  const auto begin_of = [&](std::size_t chunk) { return blocks * chunk / chunks.size(); };
  scratch_of_chunk_.resize(std::max(scratch_of_chunk_.size(), chunks.size()));
  sizes.reset(blocks, chunks.size());
  pool.for_each(chunks.size(), [&](std::size_t c) {
    for (std::size_t b = begin_of(c); b < begin_of(c + 1); ++b) {
      sizes.usual4()[b] = measure_block(sized, block_of_vertex, static_cast<std::uint32_t>(b), quantile,
                                        scratch_of_chunk_[c], sizes.borders(c));
    }
  });
}

/// Returns the fourth power of the usual size of `block`, UsualSizes::kUnknown where it has no triangle, and
/// appends its borders with other blocks.
double MeshBlocks::measure_block(const SizedMesh& sized, std::span<const std::uint32_t> block_of_vertex,
                                 std::uint32_t block, double quantile, BlockScratch& scratch,
                                 std::vector<UsualSizes::Border>& borders) const {
  const Mesh& mesh = sized.mesh;
  const Point* const vertices = sized.vertices;
  const Records records = records_of(mesh, block);
  const Mesh::Index begin = records.begin;
  const Mesh::Index end = records.end;
  std::vector<double>& sizes = scratch.sizes;
  std::vector<Mesh::Index>& crossing = scratch.crossing;
  if (sizes.size() < end - begin) sizes.resize(end - begin);
  if (crossing.size() < 3 * std::size_t{end - begin}) crossing.resize(3 * std::size_t{end - begin});
  const Mesh::Index first_edge = Mesh::kStride * begin;
  const Mesh::Index edges = Mesh::kStride * (end - begin);
  Mesh::Index step = std::max(Mesh::Index{1}, (end - begin) / static_cast<Mesh::Index>(kMeasured));
  std::size_t count = 0;
  std::size_t crossings = 0;
  for (;; step = 1) {
    double* next_size = sizes.data();
    Mesh::Index* next = crossing.data();
    for_every_nth_pair(mesh, begin, end, step, [&](Mesh::Index t) {
      *next_size++ = sized.size4_of(t);
      const Mesh::Index* const twins = mesh.twins(t);
      for (Mesh::Index k = 0; k < 3; ++k) {
        *next = Mesh::kStride * t + k;  // without a branch, which nobody could predict
        next += twins[k] - first_edge >= edges ? 1 : 0;
      }
    });
    count = static_cast<std::size_t>(next_size - sizes.data());
    crossings = static_cast<std::size_t>(next - crossing.data());
    if (step == 1 || count >= kMeasured / 4) break;
  }
  const std::size_t first_border = borders.size();
  scratch.border_with.resize(ends_.size(), 0);
  for (std::size_t c = 0; c < crossings; ++c) {
    const Mesh::Index twin = mesh.twin(crossing[c]);
    if (mesh.is_ghost(Mesh::triangle_of(twin))) continue;
    const std::uint32_t neighbour = block_of_vertex[Mesh::triangle_of(twin) / 2];
    const double squared = squared_length(vertices[mesh.origin(crossing[c])] - vertices[mesh.origin(twin)]);
    const double length4 = squared * squared;
    std::uint32_t& border = scratch.border_with[neighbour];
    if (border < first_border || border >= borders.size() || borders[border].neighbour != neighbour) {
      border = static_cast<std::uint32_t>(borders.size());
      borders.push_back({block, neighbour, length4});
    }
    borders[border].length4 = std::min(borders[border].length4, length4);
  }
  return count == 0 ? UsualSizes::kUnknown : quantile_of(std::span(sizes).first(count), quantile);
}

}  // namespace polylidar::detail
