// The triangle mesh that all steps of the pipeline share.
#pragma once

#include <cstddef>
#include <cstdint>

#include "polylidar/delaunay.hpp"
#include "polylidar/geometry.hpp"
#include "scratch.hpp"

namespace polylidar::detail {

/// A triangulation of the sphere: the finite triangles and, outside the convex hull, one ghost triangle for
/// each hull edge. Its third vertex is the vertex at infinity, kNone. So a walk round a vertex never meets a
/// border.
///
/// A triangle is one 32-byte record, half a cache line: half-edge 8t + k (k = 0, 1, 2) belongs to triangle t,
/// and with `m` the mesh's memory
///   m[8t + k]      the vertex at which half-edge 8t + k starts; vertices run counter-clockwise
///   m[8t + 4 + k]  its twin, the same edge seen from the neighbouring triangle
///   m[8t + 3]      which of a boundary triangle's half-edges are in a ring already
///   m[8t + 7]      which walk along the boundary a boundary triangle is on
/// Whether a triangle belongs to the shape is a bit in a separate array, which is small enough to stay in the
/// cache when the records do not fit.
///
/// A ghost's third vertex is always infinity: over the hull edge u -> v its half-edges are v -> u, u ->
/// infinity and infinity -> v. n distinct points make 2n - 2 triangles, ghosts included (Euler's formula on
/// the sphere). Repeated points leave records unused; these have kNone for all vertices.
class Mesh {
 public:
  using Index = std::uint32_t;
  static constexpr Index kStride = 8;
  static_assert(2 * kMaxPoints * kStride - 1 <= kNone);

  /// Room for the triangles of `points` points, 64 bytes a point; contents undefined.
  void reset(std::size_t points) {
    triangle_count_ = points < 2 ? 0 : static_cast<Index>(2 * points - 2);
    memory_ = storage_.reserve(std::size_t{kStride} * 2 * points);
  }

  Index triangle_count() const { return triangle_count_; }
  Index* memory() { return memory_; }

  /// The memory of the records from `first_record` (a half-edge) on. It can be used for other things until
  /// triangles are written there.
  template <class T>
  T* borrow(Index first_record) {
    return reinterpret_cast<T*>(memory_ + first_record);
  }

  static Index next(Index e) { return (e & 3U) == 2U ? e - 2 : e + 1; }
  static Index previous(Index e) { return (e & 3U) == 0U ? e + 2 : e - 1; }
  static Index triangle_of(Index e) { return e / kStride; }

  Index& origin(Index e) { return memory_[e]; }
  Index origin(Index e) const { return memory_[e]; }
  Index twin(Index e) const { return memory_[e + 4]; }
  /// The three vertices of triangle `t`.
  const Index* corners(Index t) const { return &memory_[std::size_t{kStride} * t]; }
  /// The twins of its three half-edges.
  const Index* twins(Index t) const { return corners(t) + 4; }
  static Index taken_bit(Index e) { return 1U << (e & 3U); }
  Index& taken(Index t) { return memory_[kStride * t + 3]; }
  Index& walk(Index t) { return memory_[kStride * t + 7]; }
  Index walk(Index t) const { return memory_[kStride * t + 7]; }

  void bond(Index e, Index f) {
    memory_[e + 4] = f;
    memory_[f + 4] = e;
  }

  bool is_unused(Index t) const { return origin(kStride * t) == kNone; }
  /// Ghosts and unused records.
  bool is_ghost(Index t) const { return origin(kStride * t + 2) == kNone; }

  /// Word w says which of the triangles 64 w ... 64 w + 63 belong to the shape, lowest bit first.
  static constexpr Index kWordBits = 64;
  std::size_t word_count() const { return (std::size_t{triangle_count_} + kWordBits - 1) / kWordBits; }
  std::uint64_t* reserve_kept() { return kept_ = kept_storage_.reserve(word_count()); }
  bool is_kept(Index t) const { return ((kept_[t / kWordBits] >> (t % kWordBits)) & 1U) != 0; }

 private:
  Scratch<Index> storage_;
  Scratch<std::uint64_t> kept_storage_;
  Index* memory_ = nullptr;
  std::uint64_t* kept_ = nullptr;
  Index triangle_count_ = 0;
};

}  // namespace polylidar::detail
