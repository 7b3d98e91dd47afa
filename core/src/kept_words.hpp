// Code that the filters share, for the words of Mesh that say which triangles are kept.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "filter_rules.hpp"
#include "half_edge.hpp"
#include "polylidar/geometry.hpp"
#include "thread_pool.hpp"
#include "vector.hpp"

namespace polylidar::detail {

inline std::uint64_t bit_of(Mesh::Index t) {
  return std::uint64_t{1} << (t % Mesh::kWordBits);
}
inline void keep(std::uint64_t* kept, Mesh::Index t) {
  kept[t / Mesh::kWordBits] |= bit_of(t);
}
inline void drop(std::uint64_t* kept, Mesh::Index t) {
  kept[t / Mesh::kWordBits] &= ~bit_of(t);
}

/// The triangle beyond half-edge `k` of `t`.
inline Mesh::Index neighbour(const Mesh& mesh, Mesh::Index t, Mesh::Index k) {
  return Mesh::triangle_of(mesh.twin(Mesh::kStride * t + k));
}

/// Calls task(chunk, begin, end) for chunks of whole words, so that no two threads write to the same word.
/// `chunks` are those of the triangles.
template <class Task>
void for_each_word_chunk(const Mesh& mesh, const Chunks& chunks, ThreadPool& pool, const Task& task) {
  pool.for_each(chunks.size(), [&](std::size_t c) {
    task(c, chunks.begin(c) / Mesh::kWordBits,
         c + 1 == chunks.size() ? mesh.word_count() : chunks.end(c) / Mesh::kWordBits);
  });
}

/// Writes into words [begin, end) of `kept` for which triangles `is_kept` is true.
template <class IsKept>
void fill_words(const Mesh& mesh, std::size_t begin, std::size_t end, std::uint64_t* kept,
                const IsKept& is_kept) {
  for (std::size_t w = begin; w < end; ++w) {
    const auto first = static_cast<Mesh::Index>(Mesh::kWordBits * w);
    const Mesh::Index count = std::min(Mesh::kWordBits, mesh.triangle_count() - first);
    std::uint64_t word = 0;
    for (Mesh::Index k = 0; k < count; ++k) word |= std::uint64_t{is_kept(first + k)} << k;
    kept[w] = word;
  }
}

/// Calls visit(t) for every triangle, ghosts included, in words [begin, end) of `kept` that is not kept.
template <class Visit>
void for_each_dropped(const Mesh& mesh, std::size_t begin, std::size_t end, const std::uint64_t* kept,
                      const Visit& visit) {
  for (std::size_t w = begin; w < end; ++w) {
    const auto first = static_cast<Mesh::Index>(Mesh::kWordBits * w);
    for (std::uint64_t dropped = ~kept[w]; dropped != 0; dropped &= dropped - 1) {
      const Mesh::Index t = first + static_cast<Mesh::Index>(std::countr_zero(dropped));
      if (t >= mesh.triangle_count()) break;
      if (!mesh.is_unused(t)) visit(t);
    }
  }
}

/// Whether any corner of finite triangle `t` is marked.
inline bool has_marked_corner(const Mesh& mesh, Mesh::Index t, const std::uint8_t* is_marked) {
  const Mesh::Index* const corner = mesh.corners(t);
  return (is_marked[corner[0]] | is_marked[corner[1]] | is_marked[corner[2]]) != 0;
}

/// Finite triangle `t` from the least of its corners on, so that rounding does not depend on how the mesh was
/// built.
inline Triangle from_least_corner(const Mesh& mesh, const Point* vertices, Mesh::Index t) {
  const Mesh::Index* const corner = mesh.corners(t);
  Mesh::Index least = 0;
  for (Mesh::Index k = 1; k < 3; ++k) {
    if (less_by_x(vertices[corner[k]], vertices[corner[least]])) least = k;
  }
  return {t, vertices[corner[least]], vertices[corner[(least + 1) % 3]], vertices[corner[(least + 2) % 3]]};
}

/// The answer to a question about a triangle, or that rounding decides it.
enum class Answer : std::uint8_t { kNo, kYes, kRoundingDecides };

/// Calls asked(triangle) for finite triangle `t` three times, with each corner as the one where the
/// arithmetic starts. Which corner comes first in a mesh depends on how the mesh was built.
template <class Asked>
Answer ask_from_all_corners(const Mesh& mesh, const Point* vertices, Mesh::Index t, const Asked& asked) {
  const Mesh::Index* const corner = mesh.corners(t);
  unsigned votes = 0;
  for (std::size_t first = 0; first < 3; ++first) {
    votes += asked(Triangle(t, vertices[corner[first]], vertices[corner[(first + 1) % 3]],
                            vertices[corner[(first + 2) % 3]]))
                 ? 1U
                 : 0U;
  }
  return votes == 0 ? Answer::kNo : votes == 3 ? Answer::kYes : Answer::kRoundingDecides;
}

}  // namespace polylidar::detail
