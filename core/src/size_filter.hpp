// Which triangles belong to the shape where the limit is chosen: by size, and what chance makes goes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "filter_rules.hpp"
#include "half_edge.hpp"
#include "polylidar/concave_hull.hpp"
#include "scratch.hpp"
#include "size_field.hpp"
#include "thread_pool.hpp"

namespace polylidar::detail {

/// Selects triangles, keeping its memory between calls. In this order:
///
/// - A triangle beyond the field's limit is dropped.
/// - A *spike* is dropped: it stands out of the shape, with two edges on its border that meet at an acute
///   angle, and is no smaller than the field says. One pass: all are found before one is dropped. Outliers
///   and noise make them.
/// - A *part*, a region of fewer triangles than the field says, is dropped, unless all regions are.
/// - A *hole*, dropped triangles that hang together and reach no edge of the convex hull, is filled where it
///   has no wide triangle beyond the limit: chance makes such voids.
class SizeFilter {
 public:
  using Index = Mesh::Index;
  /// Whether a finite triangle of the mesh of a part is surely one of the mesh of all points.
  using IsSure = std::function<bool(const Triangle&)>;

  /// Says in `kept`, the words of `mesh`, which triangles belong to the shape; the same whatever the number
  /// of threads.
  void run(const Mesh& mesh, const Point* vertices, const SizeField& field, ThreadPool& pool,
           std::uint64_t* kept);

  /// The same with the mesh of a part (interior.hpp) and a field of one limit. All triangles with a corner
  /// that `is_tested` (vertex -> whether) are those of the whole mesh, and the whole mesh has no other wide
  /// ones. Triangles without such a corner count as kept, but for those that hang together with dropped ones
  /// that have one. Returns why not where that cannot be told from the triangles that `is_sure` of, or
  /// rounding decides; then nothing that came out of it is to be used.
  std::optional<Way> run_on_part(const Mesh& mesh, const Point* vertices, const std::uint8_t* is_tested,
                                 const SizeField& field, const IsSure& is_sure, ThreadPool& pool,
                                 std::uint64_t* kept);

 private:
  struct Part;

  void clear_found(const Chunks& chunks);
  void drop_spikes(const Mesh& mesh, const Point* vertices, const SizeField& field, ThreadPool& pool,
                   std::uint64_t* kept);
  template <class Whole>
  void drop_small_parts(const Mesh& mesh, const Whole& whole, std::size_t least_part, std::uint64_t* kept);
  template <class Whole>
  void fill_small_holes(const Mesh& mesh, const Point* vertices, const Whole& whole, const SizeField& field,
                        std::uint64_t* kept);

  std::vector<std::vector<Index>> found_of_chunk_;  ///< triangles, by the chunk of the mesh that they are in
  std::vector<Index> changed_;                      ///< triangles to be kept or dropped
  Scratch<std::uint64_t> seen_;                     ///< as Mesh's words of kept triangles
  Scratch<std::uint64_t> hidden_;  ///< the same: dropped by size, but counted as kept unless they are reached
  std::optional<Way> doubt_;       ///< why a part is not enough
  std::vector<Index> group_;       ///< triangles that hang together
};

}  // namespace polylidar::detail
