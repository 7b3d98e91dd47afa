#include "interior.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace polylidar::detail {

namespace {

/// The certificate's radius is smaller than r by this share, and two points so much closer than r are too
/// close: INTERIOR.md derives both from the rounding of the filter's rules.
constexpr double kSafety = 0x1p-8;
constexpr double kTooClose = 0x1p-40;

/// A radius well beyond the spacing makes a wider part, not a smaller one: the greatest that is worth taking,
/// in multiples of the spacing that the points would have if they filled their box.
constexpr double kWidestInSpacings = 2.5;

/// At most one point in so many is looked at before the others.
constexpr std::size_t kLeastStep = 32;

/// Row, from kMargin below a cell on -> how many columns on either side of the cell come within 2 r of it.
constexpr int kReachRows = static_cast<int>(Grid::kMargin);
constexpr auto make_half_widths() {
  constexpr double kWithin = 2 * kRadius + 0x1p-10;
  std::array<unsigned, 2 * kReachRows + 1> half_widths{};
  for (int row = -kReachRows; row <= kReachRows; ++row) {
    const int gap_y = std::max(std::max(row, -row) - 1, 0);
    int columns = 0;
    while (columns * columns + gap_y * gap_y < kWithin * kWithin) ++columns;
    // Between two columns that are k apart lie k - 1 others: the gap to the next one is the first too wide.
    half_widths[static_cast<std::size_t>(row + kReachRows)] = static_cast<unsigned>(columns);
  }
  return half_widths;
}
constexpr auto kHalfWidths = make_half_widths();
static_assert(kHalfWidths[kReachRows] == Grid::kMargin && kHalfWidths[0] > 0);

void append(std::vector<std::uint32_t>& all, const std::vector<std::uint32_t>& part) {
  all.insert(all.end(), part.begin(), part.end());
}

}  // namespace

double least_dropped_radius(const Limits& limits) {
  constexpr double kPerimeterOfRadius = 5.196152422706632;  // 3 sqrt(3)
  return std::min({limits.alpha, limits.max_edge_length / 2, limits.max_perimeter / kPerimeterOfRadius});
}

std::optional<Way> InteriorPart::choose(std::span<const Point> points, const CoordinateRange& range,
                                        const Limits& limits, const InteriorGuard& guard, ThreadPool& pool) {
  if (points.size() < guard.least_points) return Way::kFewPoints;
  if (range.scale_exponent != 0) return Way::kExtremeCoordinates;
  const double radius = choose_grid(points, range.box, least_dropped_radius(limits), guard);
  if (radius == 0) return Way::kTooSparse;

  // Lengths are rounded harmlessly, areas of triangles with close corners are not.
  const bool pairs_matter = limits.alpha != kNoLimit && range.unit == 0;
  fill_cells(points, pairs_matter, pool);
  if (share_of_uncertain(points) > guard.most_uncertain) return Way::kMuchOutline;
  find_uncertain_cells(pool);
  if (share_of_part(points) > guard.most_triangulated) return Way::kMuchOutline;
  if (pairs_matter && close_pairs_.may_exist(points, grid_, cells_.data(), shared(), kTooClose * radius)) {
    return Way::kClosePoints;
  }
  find_uncertain_points(points, pool);
  mark_reach();
  gather(points, pool);
  const double most = guard.most_triangulated * static_cast<double>(points.size());
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
  radius = std::min(radius, kWidestInSpacings * std::sqrt(width * height / count)) * (1 - kSafety);
  const double cells_per_length = kRadius / radius;
  if (!(Grid::cell_count(box, cells_per_length) <= guard.most_cells_a_point * count)) return 0;
  grid_ = Grid(box, cells_per_length);
  return radius;
}

/// Puts the points into their cells, each thread into a bitmap of its own.
void InteriorPart::fill_cells(std::span<const Point> points, bool with_shared, ThreadPool& pool) {
  Grid::Cell* const cells = cells_.reserve(points.size());
  const std::size_t words = grid_.word_count();
  const std::size_t parts = pool.threads();
  while (fills_.size() < parts) fills_.emplace_back();
  pool.for_each(parts, [&](std::size_t part) {
    auto& [occupied, shared] = fills_[part];
    occupied.clear(words);
    if (with_shared) shared.clear(words);
    const std::size_t end = points.size() * (part + 1) / parts;
    for (std::size_t i = points.size() * part / parts; i < end; ++i) {
      cells[i] = grid_.cell(points[i]);
      if (with_shared && occupied.test(cells[i])) shared.set(cells[i]);
      occupied.set(cells[i]);
    }
  });
  for (std::size_t part = 1; part < parts; ++part) {
    for (std::size_t w = 0; w < words; ++w) {
      const Bitmap::Word more = fills_[part].occupied.words()[w];
      if (with_shared) {
        shared().words()[w] |= fills_[part].shared.words()[w] | (occupied().words()[w] & more);
      }
      occupied().words()[w] |= more;
    }
  }
}

/// Of the points, as far as some tell.
double InteriorPart::share_of_uncertain(std::span<const Point> points) const {
  const PointCertificate& certificate = PointCertificate::instance();
  const std::size_t step = std::max(kLeastStep, points.size() / 256) | 1U;
  std::size_t looked_at = 0;
  std::size_t uncertain = 0;
  for (std::size_t i = 0; i < points.size(); i += step, ++looked_at) {
    uncertain += certificate.is_certified(points[i], cells_.data()[i], grid_, occupied()) ? 0U : 1U;
  }
  return static_cast<double>(uncertain) / static_cast<double>(looked_at);
}

/// The part's share of the points, as far as a few tell: near how many is an uncertain cell whose middle is
/// uncertain too?
double InteriorPart::share_of_part(std::span<const Point> points) const {
  const PointCertificate& certificate = PointCertificate::instance();
  const Grid::Cell row_bits = grid_.row_words() * Grid::kWordBits;
  const auto is_in_part = [&](Grid::Cell cell) {
    Grid::Cell centre = cell - kReachRows * row_bits;
    for (const unsigned half_width : kHalfWidths) {
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
  const std::size_t step = std::max(16 * kLeastStep, points.size() / 40) | 1U;
  std::size_t looked_at = 0;
  std::size_t in_part = 0;
  for (std::size_t i = step / 2; i < points.size(); i += step, ++looked_at) {
    in_part += is_in_part(cells_.data()[i]) ? 1U : 0U;
  }
  return looked_at == 0 ? 0 : static_cast<double>(in_part) / static_cast<double>(looked_at);
}

void InteriorPart::find_uncertain_cells(ThreadPool& pool) {
  uncertain_cells_.clear(grid_.word_count());
  constexpr Grid::Cell kLeastRows = 64;  // beside which the kReach rows below and above do not matter
  const Grid::Cell rows = grid_.rows();
  const Grid::Cell bands = pool.threads() == 1 ? 1 : (rows + kLeastRows - 1) / kLeastRows;
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
    uncertain.clear();
    for (std::size_t i = chunks.begin(c); i < chunks.end(c); ++i) {
      const Grid::Cell cell = cells_.data()[i];
      if (!uncertain_cells_.test(cell)) continue;
      if (certificate.is_certified(points[i], cell, grid_, occupied())) continue;
      uncertain.push_back(static_cast<std::uint32_t>(i));
    }
  });
  uncertain_.clear();
  for (std::size_t c = 0; c < chunks.size(); ++c) append(uncertain_, chunks_[c].uncertain);
}

/// Marks the cells that may hold a point within 2 r of an uncertain one.
void InteriorPart::mark_reach() {
  reached_.clear(grid_.word_count());
  uncertain_cells_.clear(grid_.word_count());  // from now on, of the points that are
  const Grid::Cell row_bits = grid_.row_words() * Grid::kWordBits;
  for (const std::uint32_t point : uncertain_) {
    const Grid::Cell cell = cells_.data()[point];
    if (uncertain_cells_.test(cell)) continue;
    uncertain_cells_.set(cell);
    Grid::Cell centre = cell - kReachRows * row_bits;
    for (const unsigned half_width : kHalfWidths) {
      reached_.set_run(centre - half_width, 2 * half_width + 1);
      centre += row_bits;
    }
  }
}

void InteriorPart::gather(std::span<const Point> points, ThreadPool& pool) {
  const Chunks chunks(pool, points.size());
  chunks_.resize(std::max(chunks_.size(), chunks.size()));
  pool.for_each(chunks.size(), [&](std::size_t c) {
    std::vector<std::uint32_t>& reached = chunks_[c].reached;
    reached.clear();
    for (std::size_t i = chunks.begin(c); i < chunks.end(c); ++i) {
      if (reached_.test(cells_.data()[i])) reached.push_back(static_cast<std::uint32_t>(i));
    }
  });
  caller_index_.clear();
  for (std::size_t c = 0; c < chunks.size(); ++c) append(caller_index_, chunks_[c].reached);
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
  Statistics statistics{Way::kWhole, points.size(), points.size(), points.size()};
  if (const std::optional<Way> whole = part_.choose(points, range, limits, guard, steps.pool)) {
    statistics.way = *whole;
    return statistics;
  }
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
  if (!steps.filter.run_on_part(steps.builder.mesh(), steps.builder.vertices(), is_tested_.data(),
                                filter_rules(limits), fill_single, steps.pool, steps.boundary)) {
    statistics.way = Way::kRoundingDecides;
    return statistics;
  }
  steps.tracer.trace(steps.builder.mesh(), steps.builder.vertices(), count, caller_index_.data(),
                     steps.boundary, shape);
  return {Way::kInteriorLeftOut, points.size(), part_.uncertain_count(), count};
}

}  // namespace polylidar::detail
