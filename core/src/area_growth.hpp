// How the area of all triangles up to a size grows with that size, and where it hardly does.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "automatic_constants.hpp"
#include "half_edge.hpp"
#include "mesh_blocks.hpp"
#include "size_field.hpp"
#include "thread_pool.hpp"
#include "usual_sizes.hpp"

namespace polylidar::detail {

/// Let A(s) be the area of all triangles of size at most s, measured in usual sizes. While s passes through
/// the sizes of the voids that chance leaves, A grows quickly. Once s exceeds the width of holes, notches and
/// gaps, A grows quickly again, by what is outside the shape. Between the two it hardly grows. The rule takes
/// the s where A is stable and which is not far from the usual place of such an s:
///
///   s = argmin  log(g(s) + still(n)) + pull n^(-1/5) log^2(s / (usual sqrt(log n))),
///   g = d log A / d log s,
///
/// with s in median sizes of the triangles, on a grid of 16 sizes to the octave, g as a difference over
/// `below` + `above` cells. The largest void that chance makes among n points has a width that grows with
/// sqrt(log n). Triangles near such sizes cover a strip along the outline, whose share of the area falls with
/// n^(-1/2). So does still(n), the growth that counts as none, from 5,000 points on; it is `still` below. The
/// fewer points there are, the less A says, and the more the usual place counts.
///
/// The triangles are a sample. In this order: clear() and add(), or sample(); sum_up(); add_wide() where not
/// all sizes are in the sample; steadiest_size4(). From sum_up() on the steps may be repeated. Keeps its
/// memory.
class AreaGrowth {
 public:
  void clear() {
    samples_.clear();
    sampled_ = 0;
  }
  /// A triangle that stands for so many. `size4` is in usual sizes of its place, `area` is that of all for
  /// which it stands, doubled, in squares of usual sizes.
  void add(double size4, double area, double stands_for) {
    samples_.push_back({size4, area});
    sampled_ += stands_for;
  }
  /// Takes triangles evenly from the whole mesh. `usual4_of_block`: block -> fourth power of its usual size.
  void sample(const SizedMesh& sized, std::span<const std::uint32_t> block_of_vertex,
              const std::vector<double>& usual4_of_block);
  bool is_empty() const { return samples_.empty(); }

  /// Chooses the grid's unit, and sorts the sample into it. Needs a triangle, as the next two.
  void sum_up();
  /// If the sample stands for all triangles but those that are wide: adds these, few, which are all looked
  /// at. `is_tested` as in AutomaticLimit::choose_found; `points`: of the whole mesh, without repeats.
  void add_wide(const Mesh& mesh, const Point* vertices, const std::uint8_t* is_tested,
                const SizeField& field, const std::vector<double>& usual4_of_block, double wide_radius,
                double points, ThreadPool& pool);
  /// The fourth power of the s of the rule, in usual sizes, among so many points. `doubt`: what the pull on
  /// larger sizes is divided by.
  double steadiest_size4(double points, double doubt, const AutomaticConstants& constants) const;

 private:
  /// Cells of the grid of sizes; 16 cells cover one octave.
  static constexpr std::size_t kCells = 72;

  struct Sampled {
    double size4;
    double area;
  };

  std::vector<Sampled> samples_;
  double sampled_ = 0;                     ///< how many triangles those that were added stand for
  double unit4_ = 0;                       ///< fourth power of the grid's unit
  std::array<double, kCells + 1> area_{};  ///< cell of the grid -> area of the triangles of its sizes
  std::vector<double> per_square_;         ///< block -> 1 / the square of its usual size
  std::vector<double> scratch_;
};

}  // namespace polylidar::detail
