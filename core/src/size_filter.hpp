// Which triangles belong to the shape if the limit is chosen: a filter by size, which also removes what
// chance makes.
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
/// - A *spike* is dropped: a triangle that stands alone, or sticks out of the shape with two border edges
///   that meet at an acute angle, and is larger than the field says. Outliers and noise make spikes. There is
///   one pass: all are found before any is dropped.
/// - A *small region*, one with fewer triangles than the field says, is dropped, unless all regions are
///   that small, also with the limit at a detail of 1.
/// - A *hole*, connected dropped triangles that do not reach the convex hull, is filled if it has no wide
///   triangle beyond the limit, because chance makes such voids.
class SizeFilter {
 public:
  using Index = Mesh::Index;
  /// Whether a finite triangle of the mesh of a part certainly belongs to the mesh of all points.
  using IsSure = std::function<bool(const Triangle&)>;

  /// Writes into `kept`, the words of `mesh`, which triangles belong to the shape. The number of threads does
  /// not change the result.
  void run(const Mesh& mesh, const Point* vertices, const SizeField& field, ThreadPool& pool,
           std::uint64_t* kept);

  /// The same with the mesh of a part (interior.hpp) and a field of one limit, or one by corners.
  /// `is_tested`: vertex -> whether it is tested. All triangles with a tested corner must belong to the whole
  /// mesh, and all wide triangles of the whole mesh must have one. Triangles without a tested corner count as
  /// kept, unless they are connected to dropped ones that have one. If the triangles for which `is_sure` is
  /// true are not enough to tell (doubtful() says where), or if rounding decides, returns that reason, and
  /// the output must not be used.
  std::optional<Way> run_on_part(const Mesh& mesh, const Point* vertices, const std::uint8_t* is_tested,
                                 const SizeField& field, const IsSure& is_sure, ThreadPool& pool,
                                 std::uint64_t* kept);
  /// After run_on_part returned Way::kReachesFar: triangles of that mesh that would have to be sure; none if
  /// that would not help.
  const std::vector<Index>& doubtful() const { return doubtful_; }

 private:
  struct PartMesh;

  void clear_found(const Chunks& chunks);
  void keep_within_limit(const Mesh& mesh, const Point* vertices, const SizeField& field, ThreadPool& pool,
                         std::uint64_t* kept);
  bool has_large_region_with_less_detail(const Mesh& mesh, const Point* vertices, const SizeField& field,
                                         ThreadPool& pool, std::uint64_t* kept);
  void drop_beyond_limit(const PartMesh& part, ThreadPool& pool, std::uint64_t* kept);
  void follow_dropped(const PartMesh& part, std::uint64_t* kept);
  void drop_spikes(const Mesh& mesh, const Point* vertices, const SizeField& field, ThreadPool& pool,
                   std::uint64_t* kept);
  template <class Whole>
  bool drop_small_regions(const Mesh& mesh, const Whole& whole, std::size_t least_region,
                          std::uint64_t* kept);
  template <class Whole, class Seen>
  bool walk_region(const Mesh& mesh, const Whole& whole, Index border, std::size_t least_region, Seen& seen);
  template <class Whole>
  void fill_small_holes(const Mesh& mesh, const Point* vertices, const Whole& whole, const SizeField& field,
                        std::uint64_t* kept);

  std::vector<std::vector<Index>> found_of_chunk_;  ///< triangles, by the chunk of the mesh that they are in
  std::vector<Index> changed_;                      ///< triangles to be kept or dropped, by the step
  Scratch<std::uint64_t> seen_;                     ///< as Mesh's words of kept triangles
  Scratch<std::uint64_t> hidden_;  ///< the same: dropped by size, but counted as kept unless they are reached
  std::optional<Way> doubt_;       ///< why a part is not enough
  std::vector<Index> doubtful_;    ///< if it is too small: where
  std::vector<Index> group_;       ///< connected triangles, or a half-edge of each
};

}  // namespace polylidar::detail
