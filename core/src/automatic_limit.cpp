#include "automatic_limit.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "filter_rules.hpp"
#include "kept_words.hpp"
#include "quantile.hpp"
#include "vector.hpp"

namespace polylidar::detail {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// So many triangles of a block are looked at; all of them where fewer than a quarter of these are there, as
/// points that repeat others leave records unused.
constexpr std::size_t kMeasured = 64;
/// So many triangles, at most, are looked at for the growth of the area.
constexpr std::size_t kSampled = 4096;
/// Of so many triangles all are measured at once: their sizes stay in the cache until they are asked for
/// again.
constexpr std::size_t kMeasuredAtOnce = std::size_t{1} << 19U;

double fourth_power(double x) {
  return (x * x) * (x * x);
}

// The grid of limits: 16 cells to an octave of sizes, so 4 to one of their fourth powers, by the first two
// bits of these numbers' fractions. The least size is 2^(-3/4).
constexpr unsigned kFractionBits = 52;
constexpr std::uint64_t kFirstCell = std::bit_cast<std::uint64_t>(0.125) >> (kFractionBits - 2);

/// The cell of a fourth power; those below the grid count to its first cell, and beyond it is `cells`, their
/// number.
std::size_t cell_of(double size4, std::size_t cells) {
  const std::uint64_t place = std::bit_cast<std::uint64_t>(size4) >> (kFractionBits - 2);
  return place < kFirstCell ? 0 : std::min<std::size_t>(cells, place - kFirstCell);
}

/// The fourth power of the size at which cell `c` begins.
double cell_begin(std::size_t c) {
  return std::bit_cast<double>((kFirstCell + c) << (kFractionBits - 2));
}

// So that the size which all triangles of a lattice have lies within a cell and not where one ends.
constexpr double kInCell = 1.1;

// Where points are spread at random, the square of a usual size has 1.7 points.
constexpr double kPointsPerSquare = 1.7;

// So many has the squared size of a triangle beside a void, which is larger than others.
constexpr double kPointsPerBorderSquare = 2.4;

// Height over base of a flat triangle; of points at random half have 0.4.
constexpr double kFlat = 0.17;

bool is_flat(const Triangle& triangle) {
  return triangle.twice_area() <= kFlat * triangle.squared_longest_edge();
}

/// The circle of a wide triangle would have so many points that chance leaves one as large empty in one of a
/// hundred sets. Of n points that is log n + 8 or so: 2 n (1 + x) / e^x triangles have a circle of x points
/// or more. Returns the square of its radius where a unit square has `density` points.
double least_wide_square(double points, double wide, double density) {
  constexpr double kPi = 3.141592653589793;
  return std::max(std::log(points) + wide, 0.0) / (kPi * density);
}

/// A window's margin, in spacings. It takes in the circles of wide triangles, if the window's usual size is
/// that of uniform points or smaller, and a little more, as chance alone makes them differ.
double margin_of(std::uint64_t points) {
  constexpr double kRoom = 1.1;
  return kRoom * std::sqrt(least_wide_square(static_cast<double>(points), AutomaticConstants::kWide, 1));
}

/// Triangle `t` from the least of its corners on, so that rounding does not depend on how the mesh was built.
Triangle from_least_corner(const Mesh& mesh, const Point* vertices, Mesh::Index t) {
  const Mesh::Index* const corner = mesh.corners(t);
  Mesh::Index least = 0;
  for (Mesh::Index k = 1; k < 3; ++k) {
    if (less_by_x(vertices[corner[k]], vertices[corner[least]])) least = k;
  }
  return {t, vertices[corner[least]], vertices[corner[(least + 1) % 3]], vertices[corner[(least + 2) % 3]]};
}

/// Calls visit(t) for the finite triangles in every `step`-th pair of the records from `begin` to `end`.
/// Whole pairs, since the first of a pair is smaller than the second on average.
template <class Visit>
void for_some_triangles(const Mesh& mesh, Mesh::Index begin, Mesh::Index end, Mesh::Index step,
                        const Visit& visit) {
  for (Mesh::Index i = 0; begin + 2 * step * (i / 2) + i % 2 < end; ++i) {
    const Mesh::Index t = begin + 2 * step * (i / 2) + i % 2;
    if (!mesh.is_ghost(t)) visit(t);
  }
}

/// The share of the records that are used. Points that repeat others leave theirs unused. It is estimated
/// from a few hundred records, and from more if many of these are unused. They are at multiples of the golden
/// ratio modulo 1, which are spread evenly and keep step with no pattern of repeats.
double used_share(const Mesh& mesh) {
  constexpr std::uint32_t kGolden = 0x9E3779B1;  // its fraction, of 2^32
  constexpr std::uint32_t kLookedAt = 512;
  constexpr std::uint32_t kMostLookedAt = 8192;
  if (mesh.triangle_count() == 0) return 1;
  std::uint32_t used = 0;
  for (std::uint32_t seen = 0;;) {
    const std::uint32_t turned = seen * kGolden;  // modulo 2^32
    const std::uint64_t place = std::uint64_t{turned} * mesh.triangle_count() >> 32U;
    used += mesh.is_unused(static_cast<Mesh::Index>(place)) ? 0U : 1U;
    ++seen;
    const bool are_few_unused = 16 * used >= 15 * seen;
    if (seen == kMostLookedAt || (seen == kLookedAt && are_few_unused)) {
      return static_cast<double>(std::max(used, 1U)) / static_cast<double>(seen);
    }
  }
}

/// About how many points of the mesh do not repeat others; at least 3, as any triangle has so many.
double distinct_points(const DelaunayBuilder& builder) {
  return std::max(3.0, used_share(builder.mesh()) * static_cast<double>(builder.vertex_count()));
}

}  // namespace

void AutomaticLimit::measure_triangles(const Mesh& mesh, const Point* vertices, ThreadPool& pool) {
  field_.size4 = nullptr;
  if (mesh.triangle_count() > kMeasuredAtOnce) return;
  double* const size4 = size4_.reserve(mesh.triangle_count());
  const Chunks chunks(pool, mesh.triangle_count());
  pool.for_each(chunks.size(), [&](std::size_t c) {
    for (auto t = static_cast<Mesh::Index>(chunks.begin(c)); t < chunks.end(c); ++t) {
      size4[t] =
          mesh.is_ghost(t) ? std::numeric_limits<double>::quiet_NaN() : Triangle(mesh, vertices, t).size4();
    }
  });
  field_.size4 = size4;
}

/// Of a finite triangle.
double AutomaticLimit::size4_of(const Mesh& mesh, const Point* vertices, Mesh::Index t) const {
  return field_.size4 != nullptr ? field_.size4[t] : Triangle(mesh, vertices, t).size4();
}

/// The records of `block`: the first one, and one past the last.
AutomaticLimit::Records AutomaticLimit::records_of(const Mesh& mesh, std::size_t block) const {
  return {static_cast<Mesh::Index>(block == 0 ? 0 : 2 * block_ends_[block - 1]),
          std::min(mesh.triangle_count(), static_cast<Mesh::Index>(2 * block_ends_[block]))};
}

/// Looks at `block`: returns the fourth power of its usual size, infinity where it has no triangle, and
/// appends its borders with other blocks.
double AutomaticLimit::measure_block(const Mesh& mesh, const Point* vertices, std::uint32_t block,
                                     double quantile, BlockScratch& scratch,
                                     std::vector<Border>& borders) const {
  const Records records = records_of(mesh, block);
  const Mesh::Index begin = records.begin;
  const Mesh::Index end = records.end;
  std::vector<double>& sizes = scratch.sizes;
  std::vector<Mesh::Index>& crossing = scratch.crossing;
  if (crossing.size() < 3 * std::size_t{end - begin}) crossing.resize(3 * std::size_t{end - begin});
  const Mesh::Index first_edge = Mesh::kStride * begin;
  const Mesh::Index edges = Mesh::kStride * (end - begin);
  Mesh::Index step = std::max(Mesh::Index{1}, (end - begin) / static_cast<Mesh::Index>(kMeasured));
  std::size_t crossings = 0;
  for (;; step = 1) {
    sizes.clear();
    Mesh::Index* next = crossing.data();
    for_some_triangles(mesh, begin, end, step, [&](Mesh::Index t) {
      sizes.push_back(size4_of(mesh, vertices, t));
      for (Mesh::Index e = Mesh::kStride * t; e < Mesh::kStride * t + 3; ++e) {
        *next = e;  // without a branch, which nobody could predict
        next += mesh.twin(e) - first_edge >= edges ? 1 : 0;
      }
    });
    crossings = static_cast<std::size_t>(next - crossing.data());
    if (step == 1 || sizes.size() >= kMeasured / 4) break;
  }
  const std::size_t first_border = borders.size();
  scratch.border_with.resize(usual4_.size(), 0);
  for (std::size_t c = 0; c < crossings; ++c) {
    const Mesh::Index twin = mesh.twin(crossing[c]);
    if (mesh.is_ghost(Mesh::triangle_of(twin))) continue;
    const std::uint32_t neighbour = field_.block_of_vertex[Mesh::triangle_of(twin) / 2];
    const double squared = squared_length(vertices[mesh.origin(crossing[c])] - vertices[mesh.origin(twin)]);
    const double length4 = squared * squared;
    std::uint32_t& place = scratch.border_with[neighbour];
    if (place < first_border || place >= borders.size() || borders[place].neighbour != neighbour) {
      place = static_cast<std::uint32_t>(borders.size());
      borders.push_back({block, neighbour, length4});
    }
    borders[place].length4 = std::min(borders[place].length4, length4);
  }
  return sizes.empty() ? kInfinity : quantile_of(sizes, quantile);
}

/// Divides the vertices, of which `points` are no repeats, into blocks.
void AutomaticLimit::divide(const DelaunayBuilder& builder, double points) {
  const std::size_t count = builder.vertex_count();
  const double blocks = std::clamp(points / kBlockPoints, 1.0, static_cast<double>(kMostBlocks));
  const auto usual = static_cast<std::size_t>(static_cast<double>(count) / blocks);
  const std::size_t least = std::max<std::size_t>(1, usual / 2);
  const std::size_t most = usual + least;
  const std::uint32_t* const keys = builder.keys();
  block_ends_.clear();
  for (std::size_t begin = 0; begin < count;) {
    std::size_t end = count;
    if (count - begin > most) {
      // Where the curve leaves the largest cell, the last such place of equals.
      std::uint32_t highest = 0;
      for (std::size_t i = begin + least; i <= begin + most; ++i) {
        const std::uint32_t differing = keys[i - 1] ^ keys[i];
        if (differing < highest) continue;
        highest = std::bit_floor(differing);
        end = i;
      }
    }
    block_ends_.push_back(end);
    begin = end;
  }
  field_.block_of_vertex.resize(count);
  for (std::size_t b = 0, v = 0; b < block_ends_.size(); ++b) {
    for (; v < block_ends_[b]; ++v) field_.block_of_vertex[v] = static_cast<std::uint32_t>(b);
  }
}

void AutomaticLimit::measure_blocks(const Mesh& mesh, const Point* vertices, ThreadPool& pool,
                                    const AutomaticConstants& constants) {
  const Chunks chunks(pool, mesh.triangle_count());
  const std::size_t blocks = usual4_.size();
  const auto begin_of = [&](std::size_t chunk) { return blocks * chunk / chunks.size(); };
  scratch_of_chunk_.resize(std::max(scratch_of_chunk_.size(), chunks.size()));
  borders_of_chunk_.resize(chunks.size());
  pool.for_each(chunks.size(), [&](std::size_t c) {
    borders_of_chunk_[c].clear();
    for (std::size_t b = begin_of(c); b < begin_of(c + 1); ++b) {
      usual4_[b] = measure_block(mesh, vertices, static_cast<std::uint32_t>(b), constants.quantile,
                                 scratch_of_chunk_[c], borders_of_chunk_[c]);
    }
  });
}

/// Calls visit(block, neighbour) for each side of each border that is short in the block's own scale, by
/// measured4_: beyond lies another part, or nothing is known of the block.
template <class Visit>
void AutomaticLimit::for_each_neighbour(double reach, const Visit& visit) const {
  const double reach4 = fourth_power(reach);
  for (const std::vector<Border>& borders : borders_of_chunk_) {
    for (const Border& border : borders) {
      if (border.length4 <= reach4 * measured4_[border.block]) visit(border.block, border.neighbour);
      if (border.length4 <= reach4 * measured4_[border.neighbour]) visit(border.neighbour, border.block);
    }
  }
}

/// How much a length scatters among the triangles of a block: the logarithm of its 0.8 quantile over its 0.4
/// quantile. for_each_length4(block, visit) calls visit() for the fourth powers of the lengths of some
/// triangles. Returns the 0.4 quantile of this over up to 32 blocks, as a block along a thin part of the
/// shape also has triangles outside it, which scatter more; 0 where no block has enough triangles.
template <class ForEach>
double AutomaticLimit::scatter_in_blocks(std::size_t blocks, const ForEach& for_each_length4) {
  constexpr std::size_t kMostBlocksLookedAt = 32;
  constexpr std::size_t kFewest = 16;  // triangles
  constexpr double kQuantile = 0.4;
  std::vector<double> scatters;
  for (std::size_t b = 0; b < blocks; b += (blocks - 1) / kMostBlocksLookedAt + 1) {
    scratch_.clear();
    for_each_length4(b, [&](double length4) { scratch_.push_back(length4); });
    const std::size_t count = scratch_.size();
    if (count < kFewest) continue;
    const Ranking ranking(scratch_);
    const std::size_t small_place = 2 * count / 5;
    const std::size_t large_place = 4 * count / 5;
    const auto small = ranking.at(small_place);
    const auto large = ranking.at(large_place);
    const double small4 = small ? *small : value_at(scratch_, small_place);
    const double large4 = large ? *large : value_at(scratch_, large_place);
    scatters.push_back(small4 > 0 ? std::log(large4 / small4) / 4 : 0);
  }
  return scatters.empty() ? 0 : quantile_of(scatters, kQuantile);
}

/// By how much sizes and shortest edges both scatter more than those of points that do not cluster; 0 if one
/// of them does not. In fewer than 16 blocks many triangles lie outside the shape, so sizes scatter anyway;
/// but the shortest edges of most of these are steps along the outline. So there the edges alone are looked
/// at, all together, and their scatter must be surely larger: 1.8 / sqrt(number) is two of its standard
/// deviations. If half of the triangles are flat, points lie on lines or outlines, whose steps scatter
/// without clusters.
double AutomaticLimit::excess_scatter(const Mesh& mesh, const Point* vertices,
                                      const AutomaticConstants& constants) {
  constexpr std::size_t kFewestBlocks = 16;
  constexpr Mesh::Index kRecords = 128;  // of a block
  constexpr Mesh::Index kRecordsOfAll = 512;
  constexpr double kTwoDeviations = 1.8;
  const auto edge4_of = [&](Mesh::Index t) {
    const double squared = Triangle(mesh, vertices, t).squared_shortest_edge();
    return squared * squared;
  };
  if (block_ends_.size() < kFewestBlocks) {
    std::size_t count = 0;
    std::size_t flat = 0;
    const double of_edges = scatter_in_blocks(1, [&](std::size_t, const auto& visit) {
      const Mesh::Index step = std::max(Mesh::Index{1}, mesh.triangle_count() / kRecordsOfAll);
      for_some_triangles(mesh, 0, mesh.triangle_count(), step, [&](Mesh::Index t) {
        visit(edge4_of(t));
        ++count;
        flat += is_flat(Triangle(mesh, vertices, t)) ? 1U : 0U;
      });
    });
    if (2 * flat >= count) return 0;
    const double unsure = kTwoDeviations / std::sqrt(static_cast<double>(std::max<std::size_t>(count, 1)));
    return std::max(of_edges - constants.even_edges - unsure, 0.0);
  }
  const auto scatter = [&](const auto& length4_of) {
    return scatter_in_blocks(block_ends_.size(), [&](std::size_t block, const auto& visit) {
      const Records records = records_of(mesh, block);
      const Mesh::Index step = std::max(Mesh::Index{1}, (records.end - records.begin) / kRecords);
      for_some_triangles(mesh, records.begin, records.end, step,
                         [&](Mesh::Index t) { visit(length4_of(t)); });
    });
  };
  const double of_sizes =
      scatter([&](Mesh::Index t) { return size4_of(mesh, vertices, t); }) - constants.even_sizes;
  if (of_sizes <= 0) return 0;
  return std::clamp(scatter(edge4_of) - constants.even_edges, 0.0, of_sizes);
}

/// The same of the windows of places.
double AutomaticLimit::excess_scatter_of_places(const AutomaticConstants& constants) {
  const std::size_t step = windows_.kept_step();
  const auto scatter = [&](const auto& length4_of) {
    return scatter_in_blocks((usual4_.size() - 1) / step + 1, [&](std::size_t kept, const auto& visit) {
      const std::size_t place = kept * step;
      const std::size_t begin = place == 0 ? 0 : windows_.window_ends()[place - 1];
      for (std::size_t i = begin; i < windows_.window_ends()[place]; ++i) {
        visit(length4_of(windows_.triangles()[i]));
      }
    });
  };
  const double of_sizes =
      scatter([](const WindowSample::Measured& one) { return one.size4; }) - constants.even_sizes;
  if (of_sizes <= 0) return 0;
  const double of_edges =
      scatter([](const WindowSample::Measured& one) { return one.squared_shortest * one.squared_shortest; });
  return std::clamp(of_edges - constants.even_edges, 0.0, of_sizes);
}

/// Where blocks differ from those round them by more than noise explains, moves each towards the mean of
/// itself and its neighbours, by the share of the difference's variance that is not noise's.
void AutomaticLimit::smooth(const AutomaticConstants& constants) {
  if (usual4_.size() < constants.smoothed_from) return;
  constexpr double kFine = 0x1p32;  // whole numbers, so that a sum does not depend on the order
  measured4_ = usual4_;
  logs_.resize(usual4_.size());
  std::transform(usual4_.begin(), usual4_.end(), logs_.begin(),
                 [](double usual4) { return std::log(usual4) / 4; });
  around_.assign(usual4_.size(), {});
  for_each_neighbour(constants.reach, [&](std::uint32_t block, std::uint32_t neighbour) {
    if (!std::isfinite(logs_[neighbour])) return;
    around_[block].sum += std::llround(kFine * logs_[neighbour]);
    ++around_[block].count;
  });
  scratch_.clear();
  for (std::size_t b = 0; b < usual4_.size(); ++b) {
    const auto [sum, count] = around_[b];
    const bool is_alone = !std::isfinite(logs_[b]) || count == 0;
    constexpr double kSides = 2;  // of a border
    const double share = static_cast<double>(count) / (static_cast<double>(count) + kSides);
    const double difference =
        is_alone ? 0 : static_cast<double>(sum) / (kFine * static_cast<double>(count)) - logs_[b];
    logs_[b] = share * difference;  // to the mean of the block and its neighbours
    if (!is_alone) scratch_.push_back(std::sqrt(share) * difference);  // as a block's own deviation
  }
  if (scratch_.empty()) return;
  const double rough = robust_deviation(scratch_, 0);
  if (rough <= constants.noise) return;
  const double kept = (constants.noise / rough) * (constants.noise / rough);
  for (std::size_t b = 0; b < usual4_.size(); ++b) usual4_[b] *= std::exp(4 * (1 - kept) * logs_[b]);
}

/// No block may be larger than its two smallest neighbours allow, nor these than theirs. Two, as one may hold
/// a bit of a dense place beside it.
void AutomaticLimit::bound_growth(const AutomaticConstants& constants) {
  measured4_ = usual4_;
  // Of places the density varies by little.
  const std::size_t blocks = found_ == SizesBy::kPlaces ? kMostBlocks : usual4_.size();
  const double factor4 = fourth_power(1 + constants.growth / std::sqrt(static_cast<double>(blocks)));
  bool is_changed = true;
  while (is_changed) {
    smallest_.assign(usual4_.size(), {});
    for_each_neighbour(constants.reach, [&](std::uint32_t block, std::uint32_t neighbour) {
      Smallest& smallest = smallest_[block];
      if (neighbour == smallest.neighbour) return;
      if (usual4_[neighbour] < smallest.first4) {
        smallest = {neighbour, usual4_[neighbour], smallest.first4};
      } else {
        smallest.second4 = std::min(smallest.second4, usual4_[neighbour]);
      }
    });
    is_changed = false;
    for (std::size_t b = 0; b < usual4_.size(); ++b) {
      const Smallest& smallest = smallest_[b];
      const double most4 = factor4 * (smallest.second4 < kInfinity ? smallest.second4 : smallest.first4);
      if (usual4_[b] <= most4) continue;
      usual4_[b] = most4;
      is_changed = true;
    }
  }
}

/// Gives each place the median of its own usual size and those of its neighbours, as far as they are known.
/// Among scan lines a window may lie where two lines nearly meet.
void AutomaticLimit::take_medians_of_neighbours() {
  measured4_ = usual4_;
  std::vector<std::vector<double>> round(usual4_.size());
  const auto add = [&](std::uint32_t block, std::uint32_t neighbour) {
    if (measured4_[neighbour] != kInfinity) round[block].push_back(measured4_[neighbour]);
  };
  for (std::uint32_t b = 0; b < usual4_.size(); ++b) add(b, b);
  for (const Border& border : borders_of_chunk_[0]) {
    add(border.block, border.neighbour);
    add(border.neighbour, border.block);
  }
  for (std::size_t b = 0; b < usual4_.size(); ++b) {
    if (!round[b].empty()) usual4_[b] = quantile_of(round[b], 0.5);
  }
}

/// Takes from the usual sizes' differences what noise explains.
void AutomaticLimit::shrink_to_median(double noise) {
  scratch_.clear();
  for (const double usual4 : usual4_) {
    if (usual4 != kInfinity) scratch_.push_back(std::log(usual4) / 4);
  }
  if (scratch_.empty()) return;
  const double median = quantile_of(scratch_, 0.5);
  const double spread = robust_deviation(scratch_, median);
  const double kept = spread > noise ? std::sqrt(1 - (noise / spread) * (noise / spread)) : 0;
  for (double& usual4 : usual4_) {
    const double log = usual4 == kInfinity ? median : std::log(usual4) / 4;
    usual4 = std::exp(4 * (median + kept * (log - median)));
  }
}

/// Takes triangles evenly from the whole mesh.
void AutomaticLimit::sample(const Mesh& mesh, const Point* vertices) {
  std::vector<double>& unit2 = scratch_;  // block -> the square of its usual size
  unit2.resize(usual4_.size());
  std::transform(usual4_.begin(), usual4_.end(), unit2.begin(),
                 [](double unit4) { return std::sqrt(unit4); });
  for (std::size_t step = (mesh.triangle_count() / kSampled) | 1U;; step = 1) {
    samples_.clear();
    for (std::size_t i = 0; i < mesh.triangle_count(); i += step) {
      const auto t = static_cast<Mesh::Index>(i);
      if (mesh.is_ghost(t)) continue;
      const std::uint32_t block = field_.block_of_vertex[t / 2];
      samples_.push_back({size4_of(mesh, vertices, t) / usual4_[block],
                          Triangle(mesh, vertices, t).twice_area() / unit2[block]});
    }
    if (step == 1 || samples_.size() >= kSampled / 4) break;
  }
}

/// Chooses the grid's unit, and sorts the samples into it.
void AutomaticLimit::sum_up_areas() {
  // A median of so many is sure enough, and finding one of all takes longer than all else here.
  constexpr std::size_t kForMedian = 512;
  scratch_.clear();
  for (std::size_t i = 0; i < samples_.size(); i += samples_.size() / kForMedian + 1) {
    scratch_.push_back(samples_[i].size4);
  }
  unit4_ = quantile_of(scratch_, 0.5) / kInCell;
  area_.fill(0);
  for (const Sampled& one : samples_) area_[cell_of(one.size4 / unit4_, kCells)] += one.area;
}

/// The fourth power of the size of the least cost among `points` points, in usual sizes.
double AutomaticLimit::steadiest_size4(double points, const AutomaticConstants& constants) const {
  constexpr double kLeast = 1.2;
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
  double least_cost = kInfinity;
  double steadiest = log_usual;
  for (std::size_t c = constants.below; c + constants.above < kCells; ++c) {
    const std::size_t low = c - constants.below;
    const std::size_t high = c + constants.above;
    if (log_size[c] < std::log(kLeast) || log_size[c] > std::log(kMost)) continue;
    const double growth = (log_area[high] - log_area[low]) / (log_size[high] - log_size[low]);
    const double distance = log_size[c] - log_usual;
    const double pull = distance > 0 ? pull_of_n / doubt_ : pull_of_n;
    const double cost = std::log(growth + constants.still) + pull * distance * distance;
    if (cost < least_cost) {  // no: without an area below, where it is infinite or NaN
      least_cost = cost;
      steadiest = log_size[c];
    }
  }
  return std::exp(4 * steadiest) * unit4_ * kInCell;
}

void AutomaticLimit::choose(const DelaunayBuilder& builder, double detail, ThreadPool& pool,
                            const AutomaticConstants& constants) {
  const std::span<const Point> vertices(builder.vertices(), builder.vertex_count());
  if (vertices.size() < WindowSample::kLeastPoints ||
      look(passes_over(vertices, pool), bounding_box(vertices), pool, constants) == SizesBy::kBlocks) {
    choose_by_blocks(builder, detail, pool, constants);
  } else {
    choose_found(builder, nullptr, detail, pool, constants);
  }
}

void AutomaticLimit::choose_by_blocks(const DelaunayBuilder& builder, double detail, ThreadPool& pool,
                                      const AutomaticConstants& constants) {
  const Mesh& mesh = builder.mesh();
  const Point* const vertices = builder.vertices();
  const double points = distinct_points(builder);
  found_ = SizesBy::kBlocks;
  field_.is_by_corners = false;
  divide(builder, points);
  usual4_.assign(block_ends_.size(), kInfinity);
  measure_triangles(mesh, vertices, pool);
  measure_blocks(mesh, vertices, pool, constants);
  doubt_ = 1 + constants.doubt * excess_scatter(mesh, vertices, constants);
  smooth(constants);
  bound_growth(constants);
  shrink_to_median(constants.noise);
  sample(mesh, vertices);
  if (!samples_.empty()) sum_up_areas();
  set_field(points, detail, constants);
  look_for_outlines(mesh, vertices, points, detail, constants);
}

/// Whether points may lie on outlines only, as far as some triangles tell.
void AutomaticLimit::look_for_outlines(const Mesh& mesh, const Point* vertices, double points, double detail,
                                       const AutomaticConstants& constants) {
  constexpr double kFewest = 256;                    // of fewer points, those of a thin shape lie as these do
  constexpr double kLeastShare = 0.06;               // of triangles that span from one outline to another
  constexpr double kMedianGap = 0.6931471805599453;  // log 2, of the mean
  if (points < kFewest) return;
  const auto for_some = [&](std::size_t number, const auto& visit) {
    for (std::size_t i = 0; i < mesh.triangle_count(); i += (mesh.triangle_count() / number) | 1U) {
      const auto t = static_cast<Mesh::Index>(i);
      if (!mesh.is_ghost(t)) visit(Triangle(mesh, vertices, t));
    }
  };
  std::size_t looked_at = 0;
  std::size_t flat = 0;
  for_some(256, [&](const Triangle& triangle) {
    ++looked_at;
    flat += is_flat(triangle) ? 1U : 0U;
  });
  if (looked_at == 0 || 2 * flat < looked_at) return;

  std::vector<double>& shortest = scratch_;  // squares of edges
  std::vector<double> second;
  shortest.clear();
  for_some(2048, [&](const Triangle& triangle) {
    std::array<double, 3> edges{triangle.squared_ab(), triangle.squared_bc(), triangle.squared_ca()};
    std::sort(edges.begin(), edges.end());
    shortest.push_back(edges[0]);
    second.push_back(edges[1]);
  });
  if (second.empty()) return;  // nearly all records are unused
  const double steps = (std::log(points) + constants.step) / kMedianGap;
  const double squared_step = quantile_of(shortest, 0.5) * steps * steps;
  const auto longer =
      std::count_if(second.begin(), second.end(), [&](double edge) { return edge > squared_step; });
  if (static_cast<double>(longer) < kLeastShare * static_cast<double>(second.size())) return;
  double twice_area = 0;
  for (Mesh::Index t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.is_ghost(t)) continue;
    const double size4 = size4_of(mesh, vertices, t) / usual4_[field_.block_of_vertex[t / 2]];
    if (size4 <= steadiest4_) twice_area += Triangle(mesh, vertices, t).twice_area();
  }
  field_.outlines =
      OutlineSteps{squared_step, squared_step * std::max(1.0, 1 / (detail * detail)), twice_area};
}

SizesBy AutomaticLimit::look(const PointPasses& points, const Box& box, ThreadPool& pool,
                             const AutomaticConstants& constants) {
  found_ = SizesBy::kOne;
  if (find_one(points, box, pool, constants)) return found_;
  found_ = SizesBy::kPlaces;
  if (find_places(points, pool, constants)) return found_;
  return found_ = SizesBy::kBlocks;
}

bool AutomaticLimit::find_one(const PointPasses& points, const Box& box, ThreadPool& pool,
                              const AutomaticConstants& constants) {
  if (!windows_.look(points, box, {constants.noise, margin_of(points.points), constants.quantile}, pool)) {
    return false;
  }
  if (windows_.usual4().size() < windows_.window_ends().size() / 2) return false;
  std::vector<double> logs;
  for (const double usual4 : windows_.usual4()) logs.push_back(std::log(usual4) / 4);
  const double median = quantile_of(logs, 0.5);
  // One in some 600 uniform sets is beyond. The fewer windows there are, the less sure is their deviation.
  const double of_windows = 0.97 * std::cbrt(static_cast<double>(WindowSample::kMostWindows) /
                                             static_cast<double>(windows_.window_ends().size()));
  if (!(robust_deviation(logs, median) <= of_windows * constants.noise)) return false;
  points_ = windows_.distinct_share() * static_cast<double>(points.points);
  wide_radius_ =
      std::exp(median) * std::sqrt(least_wide_square(points_, AutomaticConstants::kWide, kPointsPerSquare));
  if (!(wide_radius_ <= windows_.margin())) return false;
  usual4_.assign(1, std::exp(4 * median));
  samples_.clear();
  for (const WindowSample::Measured& one : windows_.triangles()) {
    if (one.squared_radius >= wide_radius_ * wide_radius_) continue;
    samples_.push_back({one.size4 / usual4_[0], one.twice_area / std::sqrt(usual4_[0])});
  }
  sampled_ = static_cast<double>(samples_.size());
  doubt_ = 1;
  return !samples_.empty();
}

bool AutomaticLimit::find_places(const PointPasses& points, ThreadPool& pool,
                                 const AutomaticConstants& constants) {
  const double in_circle = std::log(static_cast<double>(points.points)) + AutomaticConstants::kWide;
  if (!windows_.look_by_places(points, {margin_of(points.points), constants.quantile, in_circle}, pool)) {
    return false;
  }
  const std::vector<WindowSample::Place>& places = windows_.places();
  const auto unknown = std::count_if(places.begin(), places.end(),
                                     [](const auto& place) { return place.usual4 == kInfinity; });
  if (2 * static_cast<std::size_t>(unknown) > places.size()) return false;
  const auto flat =
      std::count_if(windows_.triangles().begin(), windows_.triangles().end(),
                    [](const auto& one) { return one.twice_area <= kFlat * one.squared_longest; });
  if (2 * static_cast<std::size_t>(flat) >= windows_.triangles().size()) return false;  // maybe outlines

  usual4_.clear();
  points_ = 0;
  for (const WindowSample::Place& place : places) {
    usual4_.push_back(place.usual4);
    points_ += place.points;
  }
  borders_of_chunk_.resize(1);
  borders_of_chunk_[0].clear();
  for (const auto& [place, neighbour] : windows_.borders()) {
    borders_of_chunk_[0].push_back({place, neighbour, 0});
  }
  if (excess_scatter_of_places(constants) > 0) return false;  // clusters
  doubt_ = 1;
  take_medians_of_neighbours();
  bound_growth(constants);
  constexpr double kNoiseOfMedian = 0.5;  // of half a dozen places, beside that of one
  shrink_to_median(kNoiseOfMedian * constants.noise);
  scratch_ = usual4_;
  constexpr double kByChance = 0.01;  // of the places have a size that is too small
  const double least4 = quantile_of(scratch_, kByChance);
  for (double& usual4 : usual4_) usual4 = std::max(usual4, least4);
  wide_radius_ =
      std::sqrt(std::sqrt(least4) * least_wide_square(points_, AutomaticConstants::kWide, kPointsPerSquare));

  samples_.clear();
  sampled_ = 0;
  std::size_t i = 0;
  for (std::size_t p = 0; p < places.size(); ++p) {
    const std::size_t end = windows_.window_ends()[p];
    const double stands_for = 2 * places[p].points / static_cast<double>(end - i);
    for (; i < end; ++i) {
      const WindowSample::Measured& one = windows_.triangles()[i];
      if (one.squared_radius >= wide_radius_ * wide_radius_) continue;
      samples_.push_back({one.size4 / usual4_[p], stands_for * one.twice_area / std::sqrt(usual4_[p])});
      sampled_ += stands_for;
    }
  }
  return !samples_.empty();
}

void AutomaticLimit::choose_found(const DelaunayBuilder& builder, const std::uint8_t* is_tested,
                                  double detail, ThreadPool& pool, const AutomaticConstants& constants) {
  field_.size4 = nullptr;
  field_.is_by_corners = found_ == SizesBy::kPlaces;
  if (field_.is_by_corners) {
    field_.block_of_vertex.resize(builder.vertex_count());
    const std::span<const Point> vertices(builder.vertices(), builder.vertex_count());
    const Chunks chunks(pool, vertices.size());
    pool.for_each(chunks.size(), [&](std::size_t c) {
      const std::size_t begin = chunks.begin(c);
      const std::span<const Point> some = vertices.subspan(begin, chunks.end(c) - begin);
      if (!windows_.places_of(some, &field_.block_of_vertex[begin])) throw has_changed();
    });
  }
  sum_up_areas();
  add_wide_areas(builder.mesh(), builder.vertices(), is_tested, pool);
  set_field(points_, detail, constants);
}

/// The samples stand for all triangles that are not wide; those that are wide, few, are all looked at.
void AutomaticLimit::add_wide_areas(const Mesh& mesh, const Point* vertices, const std::uint8_t* is_tested,
                                    ThreadPool& pool) {
  constexpr double kFine = 0x1p20;  // whole numbers, so that the sum does not depend on the order
  struct Wide {
    std::array<std::int64_t, kCells + 1> area{};
    std::int64_t count = 0;
  };
  const CircumradiusRule surely_not_wide(wide_radius_ * (1 - 0x1p-10));
  const CircumradiusRule not_wide(wide_radius_);
  const Chunks chunks(pool, mesh.triangle_count());
  std::vector<Wide> wide_of_chunk(chunks.size());
  pool.for_each(chunks.size(), [&](std::size_t c) {
    Wide& wide = wide_of_chunk[c];
    for (auto t = static_cast<Mesh::Index>(chunks.begin(c)); t < chunks.end(c); ++t) {
      if (mesh.is_ghost(t) || (is_tested != nullptr && !has_marked_corner(mesh, t, is_tested))) continue;
      if (surely_not_wide.keeps(Triangle(mesh, vertices, t))) continue;
      const Triangle triangle = from_least_corner(mesh, vertices, t);
      if (not_wide.keeps(triangle)) continue;
      const double usual4 = field_.value_at(usual4_, mesh, t);
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
  const double others = std::max(2 * points_ - static_cast<double>(all.count), 0.0);
  const double share = others / sampled_;
  for (std::size_t c = 0; c <= kCells; ++c) {
    area_[c] = area_[c] * share + static_cast<double>(all.area[c]) / kFine;
  }
}

/// From the usual sizes and the samples. `points`: how many are no repeats.
void AutomaticLimit::set_field(double points, double detail, const AutomaticConstants& constants) {
  range_.reset();
  field_.limit4 = usual4_;
  field_.spike_share = 1;
  field_.least_part = 0;
  field_.wide_square = 0;
  field_.wide_radius = 0;
  field_.outlines.reset();
  if (samples_.empty()) return;  // no triangle
  const double limit4 = steadiest4_ = steadiest_size4(points, constants);
  field_.spike_share = fourth_power(constants.spike) / limit4;
  field_.least_part = static_cast<std::size_t>(constants.part * std::log(points));
  field_.wide_square = least_wide_square(points, constants.wide, kPointsPerBorderSquare) / (detail * detail);
  if (found_ != SizesBy::kBlocks) field_.wide_radius = wide_radius_ / detail;
  for (double& limit : field_.limit4) limit *= limit4 / fourth_power(detail);
  scratch_ = field_.limit4;
  const auto size = [&](double quantile) { return std::sqrt(std::sqrt(quantile_of(scratch_, quantile))); };
  range_ = ChosenSizes{size(0), size(0.5), size(1)};
}

}  // namespace polylidar::detail
