#include "interior.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "near_points.hpp"
#include "selected.hpp"

namespace polylidar::detail {

namespace {

/// At most one point in so many is looked at before the others.
constexpr std::size_t kLeastStep = 32;
/// And at most so many, for the share of uncertain points and for that of the part.
constexpr std::size_t kMostLookedAt = 256;
constexpr std::size_t kMostOfPart = 40;
/// Before all points have their cells: so many points in a row out of each kRowOutOf have theirs, and points
/// among random ones are hardly ever certain where a disk of radius r holds fewer cells with points.
constexpr std::size_t kRow = 64;
constexpr std::size_t kRowOutOf = 16 * kRow;
constexpr double kFewCellsInDisk = 5;

template <class T>
void append(std::vector<T>& all, const std::vector<T>& part) {
  all.insert(all.end(), part.begin(), part.end());
}

/// So many threads have bitmaps of the whole grid of their own.
constexpr std::size_t kMostFills = 8;

/// Number k of a sequence of places among `points` points, of which any first ones are spread evenly, and at
/// no regular distance: points that come row by row might all begin one.
std::size_t spread(std::size_t k, std::size_t points) {
  constexpr double kGoldenRatio = 0.6180339887498949;
  const double turns = kGoldenRatio * static_cast<double>(k + 1);
  return static_cast<std::size_t>((turns - std::floor(turns)) * static_cast<double>(points));
}

/// Puts these points into their cells.
void fill(std::span<const Point> points, const CellNumbering& numbering, std::uint32_t* cells,
          Bitmap& occupied) {
  number_in_blocks(points, numbering, cells,
                   [&](std::size_t begin, std::size_t end) { occupied.set_all(cells + begin, end - begin); });
}

}  // namespace

double least_dropped_radius(const Limits& limits) {
  constexpr double kPerimeterOfRadius = 5.196152422706632;  // 3 sqrt(3)
  return std::min({limits.alpha, limits.max_edge_length / 2, limits.max_perimeter / kPerimeterOfRadius});
}

std::optional<Way> InteriorPart::choose(std::span<const Point> points, const CoordinateRange& range,
                                        double radius, bool circumradii_matter, const InteriorGuard& guard,
                                        ThreadPool& pool) {
  if (points.size() < guard.least_points) return Way::kFewPoints;
  if (range.scale_exponent != 0) return Way::kExtremeCoordinates;
  radius = choose_grid(points, range.box, radius, guard);
  if (radius == 0) return Way::kTooSparse;

  // Lengths are rounded harmlessly, areas of triangles with close corners are not.
  const bool pairs_matter = circumradii_matter && range.unit == 0;
  begin_cells(points);
  if (guard.most_uncertain < 1 && cells_in_disk(points) < kFewCellsInDisk &&
      are_uncertain_beside_one(points)) {
    return Way::kMuchOutline;
  }
  fill_other_cells(points, pool);
  if (are_many_uncertain(points, guard.most_uncertain)) return Way::kMuchOutline;
  find_uncertain_cells(pool);
  if (share_of_part(points) > guard.most_triangulated) return Way::kMuchOutline;
  if (pairs_matter) {
    find_shared_cells(points.size(), pool);
    if (close_pairs_.may_exist(points, grid_, cells_.data(), shared(), kTooClose * radius, pool)) {
      return Way::kClosePoints;
    }
  }
  find_uncertain_points(points, pool);
  mark_reach(pool);
  gather(points, pool);
  const double most = guard.most_gathered * static_cast<double>(points.size());
  if (static_cast<double>(points_.size()) > most) return Way::kMuchOutline;
  return std::nullopt;
}

/// Returns the radius, in the unit of the points, of which the claim is made; 0 where there are too many
/// cells for it.
double InteriorPart::choose_grid(std::span<const Point> points, const Box& box, double radius,
                                 const InteriorGuard& guard) {
  const double width = box.max.x - box.min.x;
  const double height = box.max.y - box.min.y;
  const auto count = static_cast<double>(points.size());
  radius = std::min(radius, kWidestInSpacings * std::sqrt(width * height / count));
  radius *= (1 - kSafety) * (1 - kUneven);
  const double cells_per_length = kRadius / radius;
  if (!(Grid::cell_count(box, cells_per_length) <= guard.most_cells_a_point * count)) return 0;
  grid_ = Grid(box, cells_per_length);
  return radius;
}

/// Calls task(fill, i) for every i below `count`, with the bitmaps of the thread that takes it. Before,
/// begin(fill) is called once for the first bitmaps and for those of every thread that takes a task.
template <class Begin, class Task>
void InteriorPart::for_each_into_fills(std::size_t count, ThreadPool& pool, const Begin& begin,
                                       const Task& task) {
  const std::size_t most = std::min<std::size_t>(pool.threads(), kMostFills);
  while (fills_.size() < most) fills_.emplace_back();
  for (Fill& fill : fills_) fill.is_used = false;
  const auto use = [&](Fill& fill) {
    if (!fill.is_used) begin(fill);
    fill.is_used = true;
  };
  pool.for_each_by_thread(count, most, [&](std::size_t thread, std::size_t i) {
    use(fills_[thread]);
    task(fills_[thread], i);
  });
  use(fills_.front());
}

/// After for_each_into_fills(): calls join(word, fill) for every word of a bitmap and all bitmaps that were
/// used but the first.
template <class Join>
void InteriorPart::join_fills(ThreadPool& pool, const Join& join) {
  const auto is_other = [&](const Fill& fill) { return fill.is_used && &fill != &fills_.front(); };
  if (std::none_of(fills_.begin(), fills_.end(), is_other)) return;
  const Chunks chunks(pool, grid_.word_count());
  pool.for_each(chunks.size(), [&](std::size_t c) {
    for (const Fill& fill : fills_) {
      if (!is_other(fill)) continue;
      for (std::size_t w = chunks.begin(c); w < chunks.end(c); ++w) join(w, fill);
    }
  });
}

/// Puts some of the points into their cells: rows of them, as copies of a point often follow one another.
void InteriorPart::begin_cells(std::span<const Point> points) {
  std::uint32_t* const cells = cells_.reserve(points.size());
  if (fills_.empty()) fills_.emplace_back();
  occupied().clear(grid_.word_count());
  for (std::size_t begin = 0; begin < points.size(); begin += kRowOutOf) {
    const std::size_t count = std::min(kRow, points.size() - begin);
    fill(points.subspan(begin, count), grid_.numbering(), cells + begin, occupied());
  }
}

/// Puts all points into their cells after begin_cells(), each thread into a bitmap of its own.
void InteriorPart::fill_other_cells(std::span<const Point> points, ThreadPool& pool) {
  const Chunks chunks(pool, points.size());
  for_each_into_fills(
      chunks.size(), pool,
      [&](Fill& fill) {
        if (&fill != &fills_.front()) fill.occupied.clear(grid_.word_count());
      },
      [&](Fill& into, std::size_t c) {
        const std::size_t begin = chunks.begin(c);
        fill(points.subspan(begin, chunks.end(c) - begin), grid_.numbering(), cells_.data() + begin,
             into.occupied);
      });
  join_fills(pool,
             [&](std::size_t w, const Fill& other) { occupied().words()[w] |= other.occupied.words()[w]; });
}

void InteriorPart::fill_cells(std::span<const Point> points, ThreadPool& pool) {
  begin_cells(points);
  fill_other_cells(points, pool);
}

/// After begin_cells(): how many cells with points a disk of radius r about a point holds, on average over
/// the points; if points share cells, perhaps fewer.
double InteriorPart::cells_in_disk(std::span<const Point> points) const {
  constexpr std::size_t kLookedAt = 16;
  constexpr Grid::Cell kHalf = 10;  // of a square's side
  constexpr unsigned kSide = 2 * kHalf + 1;
  constexpr unsigned kRowsAtOnce = 3;  // so many fill a word
  static_assert(std::size_t{kRowsAtOnce} * kSide <= Grid::kWordBits && kSide % kRowsAtOnce == 0);
  constexpr double kDiskOfSquare = std::numbers::pi * kRadius * kRadius / kSide / kSide;
  const Grid::Cell row_bits = grid_.row_words() * Grid::kWordBits;
  int count = 0;
  for (std::size_t k = 0; k < kLookedAt; ++k) {
    Grid::Cell first = grid_.cell(points[spread(k, points.size())]) - kHalf * row_bits - kHalf;
    for (unsigned row = 0; row < kSide; row += kRowsAtOnce) {
      Bitmap::Word cells = 0;
      for (unsigned i = 0; i < kRowsAtOnce; ++i, first += row_bits) {
        cells = cells << kSide | (occupied().window(first) & ((Bitmap::Word{1} << kSide) - 1));
      }
      count += std::popcount(cells);
    }
  }
  static_assert(kRowOutOf % kRow == 0);
  constexpr std::size_t kStandsFor = kRowOutOf / kRow;  // rows for each that is looked at
  return kDiskOfSquare * static_cast<double>(kStandsFor) * count / kLookedAt;
}

/// After begin_cells(): whether many points near one of them are uncertain. Those of a lattice are not, even
/// if a disk holds few cells.
bool InteriorPart::are_uncertain_beside_one(std::span<const Point> points) {
  constexpr std::size_t kLookedAt = 8;
  constexpr std::size_t kMany = 3;
  constexpr double kNear = 1.5 * kRadius;  // in cells
  // A disk that touches a point reaches no farther than its diameter.
  constexpr double kWithin = kNear + 2 * kRadius + 0x1p-10;
  const auto squared = [&](double cells) {
    return cells * cells / (grid_.cells_per_length() * grid_.cells_per_length());
  };
  const Point centre = points[spread(0, points.size())];
  std::vector<std::uint32_t> near;
  const double squared_near = squared(kNear);
  for_each_near(points, centre, squared(kWithin), [&](std::size_t i, double squared_distance) {
    occupied().set(grid_.cell(points[i]));
    if (squared_distance < squared_near) near.push_back(static_cast<std::uint32_t>(i));
  });
  const PointCertificate& certificate = PointCertificate::instance();
  std::size_t uncertain = 0;
  for (std::size_t k = 0; k < kLookedAt && uncertain < kMany; ++k) {
    const Point& p = points[near[k * near.size() / kLookedAt]];
    uncertain += certificate.is_certified(p, grid_.cell(p), grid_, occupied()) ? 0U : 1U;
  }
  return uncertain >= kMany;
}

/// Finds the cells with more than one point.
void InteriorPart::find_shared_cells(std::size_t points, ThreadPool& pool) {
  const std::uint32_t* const cells = cells_.data();
  const Chunks chunks(pool, points);
  for_each_into_fills(
      chunks.size(), pool,
      [&](Fill& fill) {
        fill.reached.clear(grid_.word_count());  // not needed yet: the cells seen so far
        fill.shared.clear(grid_.word_count());
      },
      [&](Fill& fill, std::size_t c) {
        Bitmap& seen = fill.reached;
        for (std::size_t i = chunks.begin(c); i < chunks.end(c); ++i) {
          if (seen.test(cells[i])) fill.shared.set(cells[i]);
          seen.set(cells[i]);
        }
      });
  join_fills(pool, [&](std::size_t w, const Fill& other) {
    Bitmap::Word& seen = reached().words()[w];
    const Bitmap::Word more = other.reached.words()[w];
    shared().words()[w] |= other.shared.words()[w] | (seen & more);
    seen |= more;
  });
}

/// Whether more than a share of `most` of the points are uncertain, as far as some tell.
bool InteriorPart::are_many_uncertain(std::span<const Point> points, double most) const {
  if (most >= 1) return false;
  const PointCertificate& certificate = PointCertificate::instance();
  const std::size_t looked_at = std::min(kMostLookedAt, points.size() / kLeastStep + 1);
  constexpr std::size_t kFew = 16;     // of which all are uncertain only where most are
  constexpr std::size_t kEnough = 64;  // from which on they may be so few that it is plain
  std::size_t uncertain = 0;
  for (std::size_t k = 0; k < looked_at; ++k) {
    const std::size_t i = spread(k, points.size());
    uncertain += certificate.is_certified(points[i], cells_.data()[i], grid_, occupied()) ? 0U : 1U;
    const std::size_t so_far = k + 1;
    if (uncertain == kFew && so_far == kFew) return true;
    if (static_cast<double>(uncertain) > most * static_cast<double>(looked_at)) return true;
    const double at_most = most * static_cast<double>(so_far);
    constexpr double kDeviations = 2;  // fewer than chance makes of a share of `most`
    if (so_far >= kEnough && static_cast<double>(uncertain) < at_most - kDeviations * std::sqrt(at_most))
      return false;
  }
  return false;
}

/// The part's share of the points, as far as a few tell: near how many is an uncertain cell whose middle is
/// uncertain too?
double InteriorPart::share_of_part(std::span<const Point> points) const {
  const PointCertificate& certificate = PointCertificate::instance();
  const Grid::Cell row_bits = grid_.row_words() * Grid::kWordBits;
  const auto is_in_part = [&](Grid::Cell cell) {
    Grid::Cell centre = cell - rows_below(kUsualHalfWidths) * row_bits;
    for (const unsigned half_width : kUsualHalfWidths) {
      Bitmap::Word cells =
          uncertain_cells_.window(centre - half_width) & ((Bitmap::Word{2} << 2 * half_width) - 1);
      for (; cells != 0; cells &= cells - 1) {
        const Grid::Cell near = centre - half_width + static_cast<Grid::Cell>(std::countr_zero(cells));
        if (!certificate.is_middle_certified(near, grid_, occupied())) return true;
      }
      centre += row_bits;
    }
    return false;
  };
  const std::size_t looked_at = std::min(kMostOfPart, points.size() / (16 * kLeastStep) + 1);
  std::size_t in_part = 0;
  for (std::size_t k = 0; k < looked_at; ++k) {
    in_part += is_in_part(cells_.data()[spread(k, points.size())]) ? 1U : 0U;
  }
  return static_cast<double>(in_part) / static_cast<double>(looked_at);
}

void InteriorPart::find_uncertain_cells(ThreadPool& pool) {
  uncertain_cells_.clear(grid_.word_count());
  constexpr Grid::Cell kLeastRows = 48;  // beside which the kReach rows below and above do not matter
  const Grid::Cell rows = grid_.rows();
  // As many for each thread.
  const Grid::Cell bands =
      pool.threads() == 1 ? 1
                          : pool.threads() * std::max(Grid::Cell{1}, rows / (kLeastRows * pool.threads()));
  pool.for_each(bands, [&](std::size_t band) {
    const auto begin = static_cast<Grid::Cell>(rows * band / bands);
    const auto end = static_cast<Grid::Cell>(rows * (band + 1) / bands);
    detail::find_uncertain_cells(grid_, occupied(), begin, end, uncertain_cells_);
  });
}

void InteriorPart::find_uncertain_points(std::span<const Point> points, ThreadPool& pool) {
  const PointCertificate& certificate = PointCertificate::instance();
  const Chunks chunks(pool, points.size());
  chunks_.resize(std::max(chunks_.size(), chunks.size()));
  pool.for_each(chunks.size(), [&](std::size_t c) {
    std::vector<std::uint32_t>& uncertain = chunks_[c].uncertain;
    std::vector<Directions>& open = chunks_[c].open;
    uncertain.clear();
    open.clear();
    for_each_selected(
        chunks.begin(c), chunks.end(c),
        [&](std::size_t i) { return uncertain_cells_.test(cells_.data()[i]); },
        [&](std::uint32_t i) {
          const Grid::Cell cell = cells_.data()[i];
          if (certificate.is_certified(points[i], cell, grid_, occupied())) return;
          uncertain.push_back(i);
          open.push_back(certificate.open_directions(points[i], cell, grid_, occupied()));
        });
  });
  uncertain_.clear();
  open_.clear();
  for (std::size_t c = 0; c < chunks.size(); ++c) {
    append(uncertain_, chunks_[c].uncertain);
    append(open_, chunks_[c].open);
  }
}

void InteriorPart::reach_round(std::span<const Mesh::Index> triangles, const DelaunayBuilder& builder,
                               std::span<const Point> points, ThreadPool& pool) {
  mark_reach_round(triangles, builder, grid_, reached());
  gather(points, pool);
}

/// Marks the cells that may hold a corner of a triangle at an uncertain point, each thread in a bitmap of its
/// own.
void InteriorPart::mark_reach(ThreadPool& pool) {
  constexpr std::size_t kSmallestChunk = 256;  // of uncertain points, each of which marks many cells
  const Chunks chunks(pool, uncertain_.size(), kSmallestChunk);
  for_each_into_fills(
      chunks.size(), pool, [&](Fill& fill) { fill.reached.clear(grid_.word_count()); },
      [&](Fill& fill, std::size_t c) {
        const std::size_t begin = chunks.begin(c);
        const std::size_t count = chunks.end(c) - begin;
        detail::mark_reach(grid_, cells_.data(), std::span(uncertain_).subspan(begin, count),
                           std::span(open_).subspan(begin, count), fill.reached);
      });
  join_fills(pool,
             [&](std::size_t w, const Fill& other) { reached().words()[w] |= other.reached.words()[w]; });
}

void InteriorPart::gather(std::span<const Point> points, ThreadPool& pool) {
  const Chunks chunks(pool, points.size());
  chunks_.resize(std::max(chunks_.size(), chunks.size()));
  pool.for_each(chunks.size(), [&](std::size_t c) {
    std::vector<std::uint32_t>& gathered = chunks_[c].gathered;
    gathered.clear();
    for_each_selected(
        chunks.begin(c), chunks.end(c), [&](std::size_t i) { return reached().test(cells_.data()[i]); },
        [&](std::uint32_t i) { gathered.push_back(i); });
  });
  caller_index_.clear();
  for (std::size_t c = 0; c < chunks.size(); ++c) append(caller_index_, chunks_[c].gathered);
  points_.resize(caller_index_.size());
  is_uncertain_.resize(caller_index_.size());
  const Chunks parts(pool, caller_index_.size());
  pool.for_each(parts.size(), [&](std::size_t c) {
    const std::size_t begin = parts.begin(c);
    if (begin == parts.end(c)) return;
    auto next = std::lower_bound(uncertain_.begin(), uncertain_.end(), caller_index_[begin]);
    for (std::size_t i = begin; i < parts.end(c); ++i) {
      points_[i] = points[caller_index_[i]];
      is_uncertain_[i] = next != uncertain_.end() && *next == caller_index_[i];
      next += is_uncertain_[i];
    }
  });
}

Statistics InteriorPath::extract(std::span<const Point> points, const CoordinateRange& range,
                                 const Limits& limits, bool fill_single, const Steps& steps,
                                 IndexedMultiPolygon& shape, const InteriorGuard& guard) {
  const auto filter = [&] {
    return steps.filter.run_on_part(steps.builder.mesh(), steps.builder.vertices(), is_tested_.data(),
                                    filter_rules(limits), fill_single, steps.pool, steps.boundary);
  };
  return extract_part(points, range, least_dropped_radius(limits), limits.alpha != kNoLimit, steps, shape,
                      guard, filter);
}

Statistics InteriorPath::extract(std::span<const Point> points, const CoordinateRange& range, double radius,
                                 const ChooseField& choose_field, bool fill_single, const Steps& steps,
                                 IndexedMultiPolygon& shape, const InteriorGuard& guard) {
  const SizeFilter::IsSure is_sure = [&](const Triangle& triangle) {
    return part_.is_surely_whole(triangle);
  };
  const auto filter = [&] {
    return steps.filter.run_on_part(steps.builder.mesh(), steps.builder.vertices(), is_tested_.data(),
                                    choose_field(is_tested_.data()), is_sure, fill_single, steps.pool,
                                    steps.boundary);
  };
  return extract_part(points, range, radius, false, steps, shape, guard, filter);
}

/// Triangulates the part and filters its mesh by filter(), which says why where that cannot be done.
template <class Filter>
std::optional<Way> InteriorPath::filter_part(const CoordinateRange& range, const Steps& steps,
                                             const Filter& filter) {
  // The part reaches as far as all points: those at the sides of their box are uncertain.
  steps.builder.build(part_.points(), range, steps.pool);
  const std::size_t count = part_.points().size();
  is_tested_.resize(count);
  caller_index_.resize(count);
  const Chunks chunks(steps.pool, count);
  steps.pool.for_each(chunks.size(), [&](std::size_t c) {
    for (std::size_t v = chunks.begin(c); v < chunks.end(c); ++v) {
      const std::uint32_t point = steps.builder.caller_index()[v];
      is_tested_[v] = part_.is_uncertain()[point];
      caller_index_[v] = part_.caller_index()[point];
    }
  });
  return filter();
}

template <class Filter>
Statistics InteriorPath::extract_part(std::span<const Point> points, const CoordinateRange& range,
                                      double radius, bool circumradii_matter, const Steps& steps,
                                      IndexedMultiPolygon& shape, const InteriorGuard& guard,
                                      const Filter& filter) {
  Statistics statistics{Way::kWhole, points.size(), points.size(), points.size()};
  if (const std::optional<Way> whole =
          part_.choose(points, range, radius, circumradii_matter, guard, steps.pool)) {
    statistics.way = *whole;
    return statistics;
  }
  std::optional<Way> whole = filter_part(range, steps, filter);
  for (int k = 0; whole == Way::kReachesFar && !steps.filter.doubtful().empty() && k < kMostEnlarged; ++k) {
    part_.reach_round(steps.filter.doubtful(), steps.builder, points, steps.pool);
    whole = filter_part(range, steps, filter);
  }
  if (whole) {
    statistics.way = *whole;
    return statistics;
  }
  const std::size_t count = part_.points().size();
  steps.tracer.trace(steps.builder.mesh(), steps.builder.vertices(), count, caller_index_.data(),
                     steps.boundary, shape);
  return {Way::kInteriorLeftOut, points.size(), part_.uncertain_count(), count};
}

}  // namespace polylidar::detail
