#include "area_growth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "filter_rules.hpp"
#include "kept_words.hpp"
#include "log_cells.hpp"
#include "quantile.hpp"
#include "some_triangles.hpp"

namespace polylidar::detail {

namespace {

/// So many triangles, at most, are taken from a mesh.
constexpr std::size_t kSampled = 4096;

// The grid begins at the size 2^(-3/4), in its unit.
constexpr std::int64_t kFirstCell = log_cell(0.125);

/// The cell of a fourth power; those below the grid count to its first cell, and beyond it is `cells`, their
/// number.
std::size_t cell_of(double size4, std::size_t cells) {
  return static_cast<std::size_t>(
      std::clamp(log_cell(size4) - kFirstCell, std::int64_t{0}, static_cast<std::int64_t>(cells)));
}

/// The fourth power of the size at which cell `c` begins.
double cell_begin(std::size_t c) {
  return log_cell_begin(kFirstCell + static_cast<std::int64_t>(c));
}

}  // namespace

void AreaGrowth::sample(const SizedMesh& sized, std::span<const std::uint32_t> block_of_vertex,
                        const std::vector<double>& usual4_of_block) {
  const Mesh& mesh = sized.mesh;
  per_square_.resize(usual4_of_block.size());
  std::transform(usual4_of_block.begin(), usual4_of_block.end(), per_square_.begin(),
                 [](double usual4) { return 1 / std::sqrt(usual4); });
  samples_.clear();
  for_some_triangles(mesh, kSampled, [&](Mesh::Index t) {
    const double per_square = per_square_[block_of_vertex[t / 2]];
    samples_.push_back(
        {sized.size4_of(t) * (per_square * per_square), sized.triangle(t).twice_area() * per_square});
  });
}

void AreaGrowth::sum_up() {
  // A median of so many is sure enough, and finding one of all takes longer than all else here.
  constexpr std::size_t kForMedian = 512;
  scratch_.clear();
  for (std::size_t i = 0; i < samples_.size(); i += samples_.size() / kForMedian + 1) {
    scratch_.push_back(samples_[i].size4);
  }
  // Not zero where most triangles are tiny beside the usual ones of their block.
  constexpr double kLeast4 = 0x1p-900;
  unit4_ = std::max(quantile_of(scratch_, 0.5), kLeast4) / kInCell;
  area_.fill(0);
  const double per_unit4 = 1 / unit4_;
  for (const Sampled& one : samples_) area_[cell_of(one.size4 * per_unit4, kCells)] += one.area;
}

void AreaGrowth::add_wide(const Mesh& mesh, const Point* vertices, const std::uint8_t* is_tested,
                          const SizeField& field, const std::vector<double>& usual4_of_block,
                          double wide_radius, double points, ThreadPool& pool) {
  constexpr double kFine = 0x1p20;  // whole numbers, so that the sum does not depend on the order
  struct Wide {
    std::array<std::int64_t, kCells + 1> area{};
    std::int64_t count = 0;
  };
  const CircumradiusRule surely_not_wide(wide_radius * (1 - 0x1p-10));
  const CircumradiusRule not_wide(wide_radius);
  const Chunks chunks(pool, mesh.triangle_count());
  std::vector<Wide> wide_of_chunk(chunks.size());
  pool.for_each(chunks.size(), [&](std::size_t c) {
    Wide& wide = wide_of_chunk[c];
    for (auto t = static_cast<Mesh::Index>(chunks.begin(c)); t < chunks.end(c); ++t) {
      if (mesh.is_ghost(t) || (is_tested != nullptr && !has_marked_corner(mesh, t, is_tested))) continue;
      if (surely_not_wide.keeps(Triangle(mesh, vertices, t))) continue;
      const Triangle triangle = from_least_corner(mesh, vertices, t);
      if (not_wide.keeps(triangle)) continue;
      const double usual4 = field.value_at(usual4_of_block, mesh, t);
      const double area = std::max(triangle.twice_area(), 0.0) / std::sqrt(usual4);
      constexpr double kMostArea = 0x1p40;
      const std::int64_t fine_area = std::llround(kFine * std::min(area, kMostArea));
      wide.area[cell_of(triangle.size4() / usual4 / unit4_, kCells)] += fine_area;
      wide.count += fine_area > 0 ? 1 : 0;  // slivers that rounding makes wide do not count
    }
  });
  Wide all;
  for (const Wide& wide : wide_of_chunk) {
    for (std::size_t c = 0; c <= kCells; ++c) all.area[c] += wide.area[c];
    all.count += wide.count;
  }
  const double others = std::max(2 * points - static_cast<double>(all.count), 0.0);
  const double share = others / sampled_;
  for (std::size_t c = 0; c <= kCells; ++c) {
    area_[c] = area_[c] * share + static_cast<double>(all.area[c]) / kFine;
  }
}

double AreaGrowth::steadiest_size4(double points, double doubt, const AutomaticConstants& constants) const {
  constexpr double kLeast = 1.2;  // for s, in median sizes of the sample
  constexpr double kMost = 8;
  std::array<double, kCells> log_size{};
  std::array<double, kCells> log_area{};  // below the size at which the cell begins
  double below = 0;
  for (std::size_t c = 0; c < kCells; ++c) {
    log_size[c] = std::log(cell_begin(c) / kInCell) / 4;
    log_area[c] = std::log(below);
    below += std::max(area_[c], 0.0);
  }
  const double log_usual = std::log(constants.usual * std::sqrt(std::log(points)));
  const double pull_of_n = constants.pull * std::pow(points, -0.2);
  constexpr double kStillUpTo = 5000;
  const double still = constants.still * std::min(std::sqrt(kStillUpTo / points), 1.0);
  double least_cost = std::numeric_limits<double>::infinity();
  double steadiest = std::max(log_usual, std::log(kLeast));  // where the areas of all are zero by rounding
  for (std::size_t c = constants.below; c + constants.above < kCells; ++c) {
    const std::size_t low = c - constants.below;
    const std::size_t high = c + constants.above;
    if (log_size[c] < std::log(kLeast) || log_size[c] > std::log(kMost)) continue;
    const double growth = (log_area[high] - log_area[low]) / (log_size[high] - log_size[low]);
    const double distance = log_size[c] - log_usual;
    const double pull = distance > 0 ? pull_of_n / doubt : pull_of_n;
    const double cost = std::log(growth + still) + pull * distance * distance;
    if (cost < least_cost) {  // no: without an area below, where it is infinite or NaN
      least_cost = cost;
      steadiest = log_size[c];
    }
  }
  return std::exp(4 * steadiest) * unit4_ * kInCell;
}

}  // namespace polylidar::detail
