#include "automatic_limit.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

#include "kernels.hpp"
#include "outliers.hpp"
#include "outline_steps.hpp"
#include "quantile.hpp"
#include "spacing_scatter.hpp"
#include "spacings.hpp"

namespace polylidar::detail {

namespace {

/// Up to so many triangles are all measured at once: their sizes stay in the cache until they are asked for
/// again.
constexpr std::size_t kMeasuredAtOnce = std::size_t{1} << 19U;

// Where points are spread at random, the square of a usual size has 1.7 points.
constexpr double kPointsPerSquare = 1.7;

// So many has the squared size of a triangle beside a void, which is larger than others.
constexpr double kPointsPerBorderSquare = 2.4;

/// The circle of a wide triangle would have so many points that chance leaves one as large empty in one of a
/// hundred sets. Of n points that is log n + 8 or so: 2 n (1 + x) / e^x triangles have a circle of x points
/// or more. Returns the square of its radius where a unit square has `density` points.
double least_wide_square(double points, double wide, double density) {
  return std::max(std::log(points) + wide, 0.0) / (std::numbers::pi * density);
}

/// A window's margin, in spacings. It takes in the circles of wide triangles, if the window's usual size is
/// that of uniform points or smaller, and a little more, as chance alone makes them differ.
double margin_of(std::uint64_t points) {
  constexpr double kRoom = 1.1;
  return kRoom * std::sqrt(least_wide_square(static_cast<double>(points), AutomaticConstants::kWide, 1));
}

/// Writes the Triangle::size4() of `first` and of the next triangle, NaN for a ghost. Two at once take less
/// than twice the time of one.
void measure_pair(const Mesh& mesh, const Point* vertices, Mesh::Index first, double* size4) {
  if (mesh.is_ghost(first) || mesh.is_ghost(first + 1)) {
    for (Mesh::Index k = 0; k < 2; ++k) {
      size4[k] = mesh.is_ghost(first + k) ? std::numeric_limits<double>::quiet_NaN()
                                          : Triangle(mesh, vertices, first + k).size4();
    }
    return;
  }
  using Pair = Coordinates<2>::Vector;
  const auto corner = [&](std::size_t k) {
    const Point& of_first = vertices[mesh.corners(first)[k]];
    const Point& of_second = vertices[mesh.corners(first + 1)[k]];
    return std::pair(Pair{of_first.x, of_second.x}, Pair{of_first.y, of_second.y});
  };
  const auto [ax, ay] = corner(0);
  const auto [bx, by] = corner(1);
  const auto [cx, cy] = corner(2);
  const Pair ab = (ax - bx) * (ax - bx) + (ay - by) * (ay - by);
  const Pair bc = (bx - cx) * (bx - cx) + (by - cy) * (by - cy);
  const Pair ca = (cx - ax) * (cx - ax) + (cy - ay) * (cy - ay);
  const Pair sizes = size4_of(ab, bc, ca, (cx - ax) * (ay - by) - (cy - ay) * (ax - bx));
  std::memcpy(size4, &sizes, sizeof sizes);
}

/// The share of the records that are used. Points that repeat others leave theirs unused. Up to a few hundred
/// records are counted. Of more it is estimated from so many, and from more of them if many are unused. These
/// are at multiples of the golden ratio modulo 1, which are spread evenly and keep step with no pattern of
/// repeats.
double used_share(const Mesh& mesh) {
  constexpr std::uint32_t kGolden = 0x9E3779B1;  // its fraction, of 2^32
  constexpr std::uint32_t kLookedAt = 512;
  constexpr std::uint32_t kMostLookedAt = 8192;
  const Mesh::Index count = mesh.triangle_count();
  if (count == 0) return 1;
  std::uint32_t used = 0;
  if (count <= kLookedAt) {
    for (Mesh::Index t = 0; t < count; ++t) used += mesh.is_unused(t) ? 0U : 1U;
    return static_cast<double>(used) / static_cast<double>(count);
  }
  for (std::uint32_t seen = 0;;) {
    const std::uint32_t turned = seen * kGolden;  // modulo 2^32
    const std::uint64_t place = std::uint64_t{turned} * count >> 32U;
    used += mesh.is_unused(static_cast<Mesh::Index>(place)) ? 0U : 1U;
    ++seen;
    const bool are_few_unused = 16 * used >= 15 * seen;
    if (seen == kMostLookedAt || (seen == kLookedAt && are_few_unused)) {
      return static_cast<double>(std::max(used, 1U)) / static_cast<double>(seen);
    }
  }
}

/// How many points of the mesh do not repeat others, about: each but one has two records. At least 3, as any
/// triangle has so many.
double distinct_points(const DelaunayBuilder& builder) {
  const double others = static_cast<double>(builder.vertex_count()) - 1;
  return std::max(3.0, 1 + used_share(builder.mesh()) * others);
}

}  // namespace

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

SizesBy AutomaticLimit::look(const PointPasses& points, const Box& box, ThreadPool& pool,
                             const AutomaticConstants& constants) {
  if (find_one(points, box, pool, constants)) return found_ = SizesBy::kOne;
  if (find_places(points, pool, constants)) return found_ = SizesBy::kPlaces;
  return found_ = SizesBy::kBlocks;
}

/// Whether the windows differ by no more than chance explains, and are wide enough for what is wide then.
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
  const double usual4 = std::exp(4 * median);
  sizes_.reset(1);
  sizes_.usual4().front() = usual4;
  areas_.clear();
  for (const WindowSample::Measured& one : windows_.triangles()) {
    if (one.squared_radius >= wide_radius_ * wide_radius_) continue;
    areas_.add(one.size4 / usual4, one.twice_area / std::sqrt(usual4), 1);
  }
  doubt_ = 1;
  return !areas_.is_empty();
}

/// Whether places can have sizes of their own: their windows tell them, and show no outlines.
bool AutomaticLimit::find_places(const PointPasses& points, ThreadPool& pool,
                                 const AutomaticConstants& constants) {
  const double in_circle = std::log(static_cast<double>(points.points)) + AutomaticConstants::kWide;
  if (!windows_.look_by_places(points, {margin_of(points.points), constants.quantile, in_circle}, pool)) {
    return false;
  }
  const std::vector<WindowSample::Place>& places = windows_.places();
  sizes_.reset(places.size());
  points_ = 0;
  std::size_t unknown = 0;
  for (std::size_t p = 0; p < places.size(); ++p) {
    sizes_.usual4()[p] = places[p].usual4;
    points_ += places[p].points;
    unknown += places[p].usual4 == UsualSizes::kUnknown ? 1U : 0U;
  }
  if (2 * unknown > places.size()) return false;
  const auto flat =
      std::count_if(windows_.triangles().begin(), windows_.triangles().end(),
                    [](const auto& one) { return is_flat(one.twice_area, one.squared_longest); });
  if (2 * static_cast<std::size_t>(flat) >= windows_.triangles().size()) return false;  // maybe outlines
  doubt_ = 1;
  for (const auto& [place, neighbour] : windows_.borders()) {
    sizes_.borders(0).push_back({place, neighbour, 0});
  }
  sizes_.take_medians_of_neighbours();
  sizes_.bound_growth(MeshBlocks::kMost, constants);  // the density of places varies by little
  constexpr double kNoiseOfMedian = 0.5;              // of half a dozen places, beside that of one
  sizes_.shrink_to_median(kNoiseOfMedian * constants.noise);
  constexpr double kByChance = 0.01;  // of the places have a size that is too small
  const double least4 = sizes_.raise_least(kByChance);
  wide_radius_ =
      std::sqrt(std::sqrt(least4) * least_wide_square(points_, AutomaticConstants::kWide, kPointsPerSquare));
  take_sample_of_places();
  return !areas_.is_empty();
}

/// The triangles of the windows that are not wide, each for its share of those of its place.
void AutomaticLimit::take_sample_of_places() {
  const std::vector<WindowSample::Place>& places = windows_.places();
  areas_.clear();
  std::size_t i = 0;
  for (std::size_t p = 0; p < places.size(); ++p) {
    const std::size_t end = windows_.window_ends()[p];
    const double stands_for = 2 * places[p].points / static_cast<double>(end - i);
    const double usual4 = sizes_.usual4()[p];
    for (; i < end; ++i) {
      const WindowSample::Measured& one = windows_.triangles()[i];
      if (one.squared_radius >= wide_radius_ * wide_radius_) continue;
      areas_.add(one.size4 / usual4, stands_for * one.twice_area / std::sqrt(usual4), stands_for);
    }
  }
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
  areas_.sum_up();
  areas_.add_wide(builder.mesh(), builder.vertices(), is_tested, field_, sizes_.usual4(), wide_radius_,
                  points_, pool);
  set_field(points_, detail, constants, kNoLimit);
}

void AutomaticLimit::choose_by_blocks(const DelaunayBuilder& builder, double detail, ThreadPool& pool,
                                      const AutomaticConstants& constants) {
  const double points = distinct_points(builder);
  found_ = SizesBy::kBlocks;
  field_.is_by_corners = false;
  blocks_.divide(builder, points, field_.block_of_vertex);
  const SizedMesh sized = measure_triangles(builder, pool);
  blocks_.measure(sized, field_.block_of_vertex, constants.quantile, pool, sizes_);
  sizes_.smooth(constants);
  const Spacings spacings = look_around_some(sized);
  constexpr double kMostInSpacings = 1.1;  // a limit, in the least ones of outliers: a larger one joins them
  double most4 = kNoLimit;
  if (blocks_.count() > 1) {
    const std::optional<double> spacing4 = spacing4_of_outliers(sized, spacings, constants.valley);
    if (spacing4) {
      const double level4 = sizes_.level_above(*spacing4);
      if (level4 < UsualSizes::kUnknown) most4 = fourth_power(kMostInSpacings) * *spacing4 / level4;
    }
  }
  sizes_.bound_growth(blocks_.count(), constants);
  sizes_.shrink_to_median(constants.noise);
  areas_.sample(sized, field_.block_of_vertex, sizes_.usual4());
  if (!areas_.is_empty()) {
    areas_.sum_up();
    doubt_ = 1 + constants.doubt * excess_scatter(sized, spacings, field_.block_of_vertex, sizes_.usual4(),
                                                  points, constants);
  }
  set_field(points, detail, constants, most4);
  look_for_outlines(sized, points, detail, constants.step);
}

/// Measures all triangles of the mesh, unless they are many.
SizedMesh AutomaticLimit::measure_triangles(const DelaunayBuilder& builder, ThreadPool& pool) {
  const Mesh& mesh = builder.mesh();
  field_.size4 = nullptr;
  if (mesh.triangle_count() <= kMeasuredAtOnce) {
    double* const size4 = size4_.reserve(mesh.triangle_count());
    const Point* const vertices = builder.vertices();
    const Chunks pairs(pool, mesh.triangle_count() / 2);
    pool.for_each(pairs.size(), [&](std::size_t c) {
      for (std::size_t pair = pairs.begin(c); pair < pairs.end(c); ++pair) {
        measure_pair(mesh, vertices, static_cast<Mesh::Index>(2 * pair), &size4[2 * pair]);
      }
    });
    field_.size4 = size4;
  }
  return {mesh, builder.vertices(), field_.size4};
}

void AutomaticLimit::look_for_outlines(const SizedMesh& sized, double points, double detail, double step) {
  const std::optional<double> squared_step = squared_outline_step(sized.mesh, sized.vertices, points, step);
  if (!squared_step) return;
  double twice_area = 0;
  // If all points lie on their hull, it is taken however much of it is within the limit.
  const bool is_compared = std::isfinite(*squared_step);
  for (Mesh::Index t = 0; is_compared && t < sized.mesh.triangle_count(); ++t) {
    if (sized.mesh.is_ghost(t)) continue;
    const double size4 = sized.size4_of(t) / sizes_.usual4()[field_.block_of_vertex[t / 2]];
    if (size4 <= steadiest4_) twice_area += sized.triangle(t).twice_area();
  }
  field_.outlines =
      OutlineSteps{*squared_step, *squared_step * std::max(1.0, 1 / (detail * detail)), twice_area};
}

/// From the usual sizes and the areas. `points`: how many are no repeats; `most4`: of the limit, in usual
/// sizes.
void AutomaticLimit::set_field(double points, double detail, const AutomaticConstants& constants,
                               double most4) {
  range_.reset();
  field_.limit4 = sizes_.usual4();
  field_.spike_share = 1;
  field_.least_region = 0;
  field_.detail4 = std::max(1.0, fourth_power(detail));
  field_.wide_square = 0;
  field_.wide_radius = 0;
  field_.outlines.reset();
  if (areas_.is_empty()) return;  // no triangle
  const double limit4 = steadiest4_ = std::min(areas_.steadiest_size4(points, doubt_, constants), most4);
  field_.spike_share = fourth_power(constants.spike) / limit4;
  field_.least_region = static_cast<std::size_t>(constants.region * std::log(points));
  field_.wide_square = least_wide_square(points, constants.wide, kPointsPerBorderSquare) / (detail * detail);
  if (found_ != SizesBy::kBlocks) field_.wide_radius = wide_radius_ / detail;
  for (double& limit : field_.limit4) limit *= limit4 / fourth_power(detail);
  scratch_ = field_.limit4;
  const auto size = [&](double quantile) { return std::sqrt(std::sqrt(quantile_of(scratch_, quantile))); };
  range_ = ChosenSizes{size(0), size(0.5), size(1)};
}

}  // namespace polylidar::detail
