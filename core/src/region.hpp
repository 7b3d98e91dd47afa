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

  /// Keeps the finite triangles of `mesh` that obey `rules` and, if `fill_single` is set, those whose three
  /// neighbours do. Puts into `boundary` the half-edges of kept triangles whose twin is not kept, in the same
  /// order whatever the number of threads. Can be called again with other rules.
  void run(Mesh& mesh, const Point* vertices, const FilterRules& rules, bool fill_single, ThreadPool& pool,
           std::vector<Index>& boundary);

  /// The same, but only triangles with a tested corner must obey the rules; all others are kept. `is_tested`:
  /// vertex of the mesh -> whether it is tested. If rounding decides, that is, if a rule's answer depends on
  /// the order of a triangle's corners, returns that reason, and the output must not be used.
  std::optional<Way> run_on_part(Mesh& mesh, const Point* vertices, const std::uint8_t* is_tested,
                                 const FilterRules& rules, bool fill_single, ThreadPool& pool,
                                 std::vector<Index>& boundary);

  /// As run, but by the chosen limit (SizeFilter), before `fill_single`. Returns whether the shape is what
  /// outlines enclose (OutlineFill).
  bool run(Mesh& mesh, const Point* vertices, const SizeField& field, bool fill_single, ThreadPool& pool,
           std::vector<Index>& boundary);

  /// The same with the mesh of a part. Returns what SizeFilter::run_on_part returns.
  std::optional<Way> run_on_part(Mesh& mesh, const Point* vertices, const std::uint8_t* is_tested,
                                 const SizeField& field, const SizeFilter::IsSure& is_sure, bool fill_single,
                                 ThreadPool& pool, std::vector<Index>& boundary);
  /// As SizeFilter::doubtful().
  const std::vector<Index>& doubtful() const { return size_filter_.doubtful(); }

 private:
  void find_boundary(Mesh& mesh, bool fill_single, ThreadPool& pool, std::uint64_t* kept,
                     std::vector<Index>& boundary);

  SizeFilter size_filter_;
  OutlineFill outline_fill_;
  std::vector<std::vector<Index>> boundary_of_chunk_;  ///< of all chunks but the first
  std::vector<std::vector<Index>> filled_of_chunk_;
};

}  // namespace polylidar::detail
