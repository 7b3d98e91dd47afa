// Which triangles belong to the shape, and where the shape ends.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "filter_rules.hpp"
#include "half_edge.hpp"
#include "outline_fill.hpp"
#include "size_field.hpp"
#include "size_filter.hpp"
#include "thread_pool.hpp"

namespace polylidar::detail {

/// Selects triangles, keeping its memory between calls.
class RegionFilter {
 public:
  using Index = Mesh::Index;

  /// Keeps the finite triangles of `mesh` that keep to `rules` and, if `fill_single` says so, those whose
  /// three neighbours do. Puts into `boundary` the half-edges of kept triangles whose twin is not kept, in
  /// the same order whatever the number of threads. Can be called again with other rules.
  void run(Mesh& mesh, const Point* vertices, const FilterRules& rules, bool fill_single, ThreadPool& pool,
           std::vector<Index>& boundary);

  /// The same where only triangles with a tested corner are asked for the rules, and all others are kept.
  /// `is_tested`: vertex of the mesh -> whether. Returns why not where rounding decides: where a rule
  /// would answer otherwise if a triangle's corners were given in another order; then nothing that came out
  /// of it is to be used.
  std::optional<Way> run_on_part(Mesh& mesh, const Point* vertices, const std::uint8_t* is_tested,
                                 const FilterRules& rules, bool fill_single, ThreadPool& pool,
                                 std::vector<Index>& boundary);

  /// As run with the limit that is chosen (SizeFilter), before `fill_single`. Returns whether the shape is
  /// what outlines enclose instead (OutlineFill).
  bool run(Mesh& mesh, const Point* vertices, const SizeField& field, bool fill_single, ThreadPool& pool,
           std::vector<Index>& boundary);

  /// The same with the mesh of a part (SizeFilter::run_on_part). Returns what that does.
  std::optional<Way> run_on_part(Mesh& mesh, const Point* vertices, const std::uint8_t* is_tested,
                                 const SizeField& field, const SizeFilter::IsSure& is_sure, bool fill_single,
                                 ThreadPool& pool, std::vector<Index>& boundary);

 private:
  void find_boundary(Mesh& mesh, bool fill_single, ThreadPool& pool, std::uint64_t* kept,
                     std::vector<Index>& boundary);

  SizeFilter size_filter_;
  OutlineFill outline_fill_;
  std::vector<std::vector<Index>> boundary_of_chunk_;  ///< of all chunks but the first
  std::vector<std::vector<Index>> filled_of_chunk_;
};

}  // namespace polylidar::detail
