// What finding the shards of a stream and putting them together have in common.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "boundary.hpp"
#include "delaunay_builder.hpp"
#include "polylidar/stream.hpp"
#include "region.hpp"
#include "thread_pool.hpp"

namespace polylidar::detail {

/// Up to so many points are put into memory whatever the options say, all by the first shard.
inline constexpr std::uint64_t kAlwaysInMemory = std::uint64_t{1} << 16U;

/// Whether all points are on a line parallel to an axis, where a grid has no cells.
inline bool is_flat(const Box& box) {
  return box.min.x == box.max.x || box.min.y == box.max.y;
}

/// For messages.
inline std::string name_of(const Shard& shard) {
  return "shard " + std::to_string(shard.number) + " of " + std::to_string(shard.count);
}

inline std::invalid_argument too_much_outline() {
  return std::invalid_argument("more than 2^28 points are near the outline: give a larger limit");
}

/// The triangulation of the points near the outline, and the shape in it. `part` and `pool` must live as
/// long.
class PartHull {
 public:
  /// Throws std::invalid_argument where the points cannot be all that are near the outline of a source.
  PartHull(const StreamShard& part, ThreadPool& pool);

  const DelaunayBuilder& builder() const { return builder_; }
  /// Vertex of the mesh -> whether it may be on the outline.
  const std::uint8_t* is_tested() const { return is_tested_.data(); }

  /// Both as RegionFilter::run_on_part; before trace().
  std::optional<Way> filter(const FilterRules& rules, bool fill_single);
  std::optional<Way> filter(const SizeField& field, const SizeFilter::IsSure& is_sure, bool fill_single);
  const std::vector<Mesh::Index>& doubtful() const { return filter_.doubtful(); }
  /// What was kept.
  StreamedHull trace();

 private:
  const StreamShard& part_;
  ThreadPool& pool_;
  DelaunayBuilder builder_;
  std::vector<std::uint8_t> is_tested_;
  RegionFilter filter_;
  std::vector<Mesh::Index> boundary_;
};

/// The hull where `all` has all points of the source.
StreamedHull hull_in_memory(const StreamShard& all, unsigned threads);

/// The hull of points on a line.
StreamedHull hull_without_area(const StreamShard& all);

/// What to do about Way::kRoundingDecides.
inline std::invalid_argument rounding_decides() {
  return std::invalid_argument(
      "the rounding of a triangle's size decides whether it is kept: make the limit a little larger or "
      "smaller");
}

}  // namespace polylidar::detail
