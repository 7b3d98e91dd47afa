// Points of a LAS file in memory, in less room than as coordinates.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "polylidar/geometry.hpp"
#include "polylidar/stream.hpp"

namespace polylidar::tool::point_files {

/// The whole numbers of a point in a LAS file.
struct LatticePoint {
  std::int32_t x;
  std::int32_t y;
};

/// How the whole numbers of a LAS file are made coordinates.
struct Lattice {
  Point scale;
  Point offset;

  Point at(const LatticePoint& p) const { return {p.x * scale.x + offset.x, p.y * scale.y + offset.y}; }
  /// The whole numbers nearest to a point.
  LatticePoint nearest(const Point& p) const;
};

/// All points of a file, or of a part of one, so that it need not be read again: 8 bytes each.
class KeptPoints {
 public:
  /// No points are kept that would take more than so many bytes.
  explicit KeptPoints(std::uint64_t most_bytes) : most_bytes_(most_bytes) {}

  /// Forgets all and gets room for up to `count` points. Returns false where that is too much; nothing may be
  /// added then.
  bool begin(std::uint64_t count, const Lattice& lattice);
  /// Where the next points go. There is room for those that begin() was told of.
  LatticePoint* end() { return points_.get() + count_; }
  /// So many points were put there.
  void add(std::size_t count) { count_ += count; }
  /// No more come.
  void finish() { is_whole_ = points_ != nullptr; }

  /// Whether all points are there.
  bool is_whole() const { return is_whole_; }
  /// Hands them to `take` in blocks of `block_size` points.
  void hand_on(const TakePoints& take, std::size_t block_size) const;

 private:
  std::uint64_t most_bytes_;
  Lattice lattice_{};
  std::unique_ptr<LatticePoint[]> points_;
  std::size_t count_ = 0;
  bool is_whole_ = false;
};

}  // namespace polylidar::tool::point_files
