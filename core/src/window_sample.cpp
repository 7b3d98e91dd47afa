#include "window_sample.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "filter_rules.hpp"
#include "quantile.hpp"
#include "selected.hpp"
#include "vector.hpp"

namespace polylidar::detail {

namespace {

/// So many points are in a cell on average, and there are at most so many cells.
constexpr double kPointsInCell = 16;
constexpr double kMostCells = 16384;
/// Of fewer points windows hold a good part: they pay only where at least this share lies well inside.
constexpr std::size_t kManyPoints = std::size_t{1} << 15U;
constexpr double kLeastShareInside = 0.7;
/// Points for one window, and the fewest windows that tell whether they differ.
constexpr std::size_t kPointsForWindow = 1120;
constexpr std::size_t kFewestWindows = 7;
/// Half the side of a window in spacings of the points.
constexpr double kHalfInner = 4;
/// The margin, in spacings, of a window that only tells a usual size: of points at random, 1 triangle in 150
/// has a wider circle.
constexpr double kNarrowMargin = 1.5;
/// Beyond so many times what they would have where the density is the same everywhere, windows are not looked
/// into.
constexpr double kMostPointsOfUsual = 2;

/// A place with more points than this, or than this share of all, is divided if it has more than one cell.
constexpr std::size_t kMostPointsInPlace = 4096;
constexpr std::uint64_t kMostShareInPlace = 1024;  // one in so many
/// With fewer triangles a window says little of its place. Half of those of points at random.
constexpr std::size_t kFewTrianglesOfPlace = 64;
/// Fewer cells inside the shape do not tell how much the density varies.
constexpr std::size_t kFewCells = 256;

}  // namespace

bool WindowSample::look(const PointPasses& points, const Box& box, const Wanted& wanted, ThreadPool& pool) {
  shares_.resize(points.shares);
  are_counted_ = points.points >= kLeastPoints && count_cells(points, box);
  if (!are_counted_) return false;
  const double in_cell = usual_count(points.points, wanted.most_spread);
  if (in_cell == 0) return false;
  const double spacing = 1 / (cells_per_length_ * std::sqrt(in_cell));
  const double half_side = (kHalfInner + wanted.margin) * spacing;
  const auto windows = static_cast<std::size_t>(
      std::clamp<std::uint64_t>(points.points / kPointsForWindow, kFewestWindows, kMostWindows));
  place_windows(points.points, windows, half_side);
  const double usual = 4 * half_side * half_side / (spacing * spacing);
  const auto most = static_cast<std::size_t>(kMostPointsOfUsual * static_cast<double>(windows) * usual);
  const std::size_t gathered = gather(
      points, most, [&](std::uint32_t cell) { return windows_of_cell_[cell] != 0; },
      [&](std::uint32_t cell, const auto& visit) {
        for (std::uint64_t left = windows_of_cell_[cell]; left != 0; left &= left - 1) {
          visit(static_cast<std::uint32_t>(std::countr_zero(left)));
        }
      });
  if (gathered > most) return false;
  margin_ = wanted.margin * spacing;
  for (Window& window : windows_) window.half_inner = kHalfInner * spacing;
  measure_windows(wanted.quantile, pool);
  return true;
}

void WindowSample::measure_windows(double quantile, ThreadPool& pool) {
  const auto begin_of = [&](std::size_t share) { return windows_.size() * share / shares_.size(); };
  pool.for_each(shares_.size(), [&](std::size_t s) {
    shares_[s].triangles.clear();
    for (std::size_t w = begin_of(s); w < begin_of(s + 1); ++w) {
      const std::size_t before = shares_[s].triangles.size();
      measure(windows_[w], quantile, shares_[s]);
      if (w % kept_step() != 0) shares_[s].triangles.resize(before);
    }
  });
  window_ends_.clear();
  triangles_.clear();
  usual4_.clear();
  std::size_t gathered = 0;
  std::size_t distinct = 0;
  for (const Share& share : shares_) {
    triangles_.insert(triangles_.end(), share.triangles.begin(), share.triangles.end());
  }
  std::size_t end = 0;
  for (std::size_t w = 0; w < windows_.size(); ++w) {
    const Window& window = windows_[w];
    if (w % kept_step() == 0) end += window.triangles;
    window_ends_.push_back(end);
    if (window.usual4) usual4_.push_back(*window.usual4);
    gathered += window.points.size();
    distinct += window.distinct;
  }
  distinct_share_ = static_cast<double>(distinct) / static_cast<double>(gathered);
}

bool WindowSample::look_by_places(const PointPasses& points, const WantedPlaces& wanted, ThreadPool& pool) {
  if (!are_counted_ || points.points < kLeastPointsForPlaces) return false;
  if (!is_wide_rare(points.points, wanted.points_in_circle) || !is_smooth()) return false;
  divide(points.points);
  const auto most = static_cast<std::size_t>(kMostPointsOfUsual * place_window_of_each(wanted));
  const std::size_t gathered = gather(
      points, most, [&](std::uint32_t cell) { return window_of_cell_[cell] != kNone; },
      [&](std::uint32_t cell, const auto& visit) { visit(window_of_cell_[cell]); });
  if (gathered > most) return false;
  measure_windows(wanted.quantile, pool);
  places_.clear();
  for (std::size_t w = 0; w < windows_.size(); ++w) {
    const Window& window = windows_[w];
    const double distinct_share = window.points.empty() ? 1
                                                        : static_cast<double>(window.distinct) /
                                                              static_cast<double>(window.points.size());
    const bool is_known = window.usual4 && window.triangles >= kFewTrianglesOfPlace;
    places_.push_back({is_known ? *window.usual4 : std::numeric_limits<double>::infinity(),
                       distinct_share * static_cast<double>(cells_of_place_[w].points)});
  }
  find_borders();
  return true;
}

/// Whether most points lie well inside, and few triangles there have a circle as wide as one that would hold
/// `points_in_circle` points in the densest hundredth: among points at random, (1 + x) / e^x of the triangles
/// have a wider circle than one that would hold x points.
bool WindowSample::is_wide_rare(std::uint64_t points, double points_in_circle) const {
  constexpr double kMostWide = 0.02;  // then about a tenth of the points are near such a triangle
  constexpr double kDensest = 0.01;
  std::vector<std::uint32_t> inside;
  double total = 0;
  for_each_inside_cell([&](const std::uint32_t* own) {
    inside.push_back(*own);
    total += *own;
  });
  if (inside.size() < kFewCells || total < kLeastShareInside * static_cast<double>(points)) return false;
  std::sort(inside.begin(), inside.end(), std::greater<>());
  auto dense = inside.begin();
  for (double above = *dense; above < kDensest * total;) above += *++dense;
  double wide = 0;
  for (const std::uint32_t count : inside) {
    const double x = points_in_circle * std::min(1.0, static_cast<double>(count) / *dense);
    wide += count * (1 + x) * std::exp(-x);
  }
  return wide <= kMostWide * total;
}

/// Whether the number of points in a cell differs from the mean of the eight round it by hardly more than
/// chance and a usual unevenness explain. Of clusters that are not small beside a cell it differs by more.
bool WindowSample::is_smooth() const {
  constexpr double kUneven = 0.12;    // standard deviation of a number as a share of it, as of scan lines
  constexpr double kMostRough = 1.3;  // what both explain is 1
  std::vector<double> differences;
  for_each_inside_cell([&](const std::uint32_t* own) {
    const std::uint32_t* const above = own + columns_;
    const std::uint32_t* const below = own - columns_;
    const double round =
        0.0 + own[-1] + own[1] + above[-1] + above[0] + above[1] + below[-1] + below[0] + below[1];
    const double mean = round / 8;
    const double variance = (mean + kUneven * kUneven * mean * mean) * 9 / 8;
    differences.push_back((*own - mean) / std::sqrt(variance));
  });
  return robust_deviation(differences, 0) <= kMostRough;
}

/// Divides the cells with points into places: squares are quartered as long as they have many points.
void WindowSample::divide(std::uint64_t points) {
  const std::uint64_t most = std::max<std::uint64_t>(kMostPointsInPlace, points / kMostShareInPlace);
  place_of_cell_.assign(counts_.size(), kNone);
  cells_of_place_.clear();
  std::vector<PlaceCells> squares;  // whose points are not known yet
  squares.push_back({0, 0, std::bit_ceil(std::max(columns_, rows_)), 0, 0});
  std::vector<std::uint32_t> cells;
  while (!squares.empty()) {
    PlaceCells square = squares.back();
    squares.pop_back();
    cells.clear();
    for (std::uint32_t r = square.row; r < std::min(square.row + square.side, rows_); ++r) {
      for (std::uint32_t c = square.column; c < std::min(square.column + square.side, columns_); ++c) {
        const std::uint32_t cell = r * columns_ + c;
        square.points += counts_[cell];
        if (counts_[cell] > 0) cells.push_back(cell);
      }
    }
    if (square.points > most && square.side > 1) {
      const std::uint32_t half = square.side / 2;
      for (const std::uint32_t up : {half, 0U}) {
        for (const std::uint32_t right : {half, 0U}) {
          squares.push_back({square.row + up, square.column + right, half, 0, 0});
        }
      }
    } else if (!cells.empty()) {
      for (const std::uint32_t cell : cells)
        place_of_cell_[cell] = static_cast<std::uint32_t>(cells_of_place_.size());
      // The upper quartile, as cells across the outline have fewer points.
      const auto quartile = cells.begin() + static_cast<std::ptrdiff_t>(cells.size() / 4);
      std::nth_element(cells.begin(), quartile, cells.end(), [&](std::uint32_t a, std::uint32_t b) {
        return std::pair(counts_[b], a) < std::pair(counts_[a], b);
      });
      square.typical = *quartile;
      cells_of_place_.push_back(square);
    }
  }
}

void WindowSample::find_borders() {
  borders_.clear();
  for (std::uint32_t r = 0; r < rows_; ++r) {
    for (std::uint32_t c = 0; c < columns_; ++c) {
      const std::uint32_t place = place_of_cell_[r * columns_ + c];
      if (place == kNone) continue;
      const auto add = [&](std::uint32_t row, std::uint32_t column) {
        if (row >= rows_ || column >= columns_) return;  // also to the left of column 0
        const std::uint32_t other = place_of_cell_[row * columns_ + column];
        if (other != kNone && other != place)
          borders_.emplace_back(std::min(place, other), std::max(place, other));
      };
      add(r, c + 1);
      add(r + 1, c - 1);
      add(r + 1, c);
      add(r + 1, c + 1);
    }
  }
  std::sort(borders_.begin(), borders_.end());
  borders_.erase(std::unique(borders_.begin(), borders_.end()), borders_.end());
}

/// Puts the window of each place about the middle of its typical cell, but not beyond the place. Returns how
/// many points there should be in all windows.
double WindowSample::place_window_of_each(const WantedPlaces& wanted) {
  windows_.resize(cells_of_place_.size());
  window_of_cell_.assign(counts_.size(), kNone);
  double expected = 0;
  for (std::uint32_t w = 0; w < windows_.size(); ++w) {
    const PlaceCells& cells = cells_of_place_[w];
    Window& window = windows_[w];
    // In cells, from the place's corner on.
    const std::uint32_t side = cells.side;
    const double spacing = 1 / std::sqrt(counts_[cells.typical]);
    const double margin = w % kept_step() == 0 ? wanted.margin : std::min(kNarrowMargin, wanted.margin);
    const double half_side = std::min((kHalfInner + margin) * spacing, side / 2.0);
    const auto middle_of = [&](std::uint32_t cell, std::uint32_t first) {
      return std::clamp(cell - first + 0.5, half_side, side - half_side);
    };
    const double x = middle_of(cells.typical % columns_, cells.column);
    const double y = middle_of(cells.typical / columns_, cells.row);
    expected += 4 * half_side * half_side / (spacing * spacing);
    window.centre = {minimum_.x + (cells.column + x) / cells_per_length_,
                     minimum_.y + (cells.row + y) / cells_per_length_};
    window.half_side = half_side / cells_per_length_;
    window.half_inner = window.half_side * kHalfInner / (kHalfInner + margin);
    const auto first_of = [&](double at) { return static_cast<std::uint32_t>(at - half_side); };
    const auto last_of = [&](double at) {
      return std::min(static_cast<std::uint32_t>(at + half_side), side - 1);
    };
    const std::uint32_t right = std::min(cells.column + last_of(x), columns_ - 1);
    const std::uint32_t top = std::min(cells.row + last_of(y), rows_ - 1);
    for (std::uint32_t r = cells.row + first_of(y); r <= top; ++r) {
      for (std::uint32_t c = cells.column + first_of(x); c <= right; ++c)
        window_of_cell_[r * columns_ + c] = w;
    }
  }
  return expected;
}

bool WindowSample::places_of(std::span<const Point> some, std::uint32_t* places) const {
  std::uint32_t greatest = 0;
  visit_numbered(some, numbering(),
                 [&](std::size_t begin, std::span<const Point> block, const std::uint32_t* cells) {
                   for (std::size_t i = 0; i < block.size(); ++i) {
                     const std::uint32_t place = place_of_cell_[cells[i]];
                     places[begin + i] = place;
                     greatest = std::max(greatest, place);
                   }
                 });
  return greatest != kNone;
}

/// Counts the points in square cells. Returns false where the box is too narrow for them, or one has too
/// many.
bool WindowSample::count_cells(const PointPasses& points, const Box& box) {
  const double width = box.max.x - box.min.x;
  const double height = box.max.y - box.min.y;
  const double cells = std::min(kMostCells, static_cast<double>(points.points) / kPointsInCell);
  minimum_ = box.min;
  cells_per_length_ = std::sqrt(cells / (width * height));
  constexpr double kLeastSide = 4;
  if (!(std::min(width, height) * cells_per_length_ >= kLeastSide)) return false;
  columns_ = column(box.max.x) + 1;
  rows_ = row(box.max.y) + 1;
  counts_.assign(std::size_t{columns_} * rows_, 0);
  add_up_points(points);
  // Where a cell has 2^32 points or more, its count is too small.
  return std::accumulate(counts_.begin(), counts_.end(), std::uint64_t{0}) == points.points;
}

/// Counts the points in counts_ and in as many others beside it as threads count at the same time: few, even
/// if there are many shares, one for each file of a stream.
void WindowSample::add_up_points(const PointPasses& points) {
  std::vector<std::vector<std::uint32_t>*> unused{&counts_};
  std::size_t others = 0;
  Turns turns;
  const auto take_counts = [&] {
    if (unused.empty()) {
      if (others == other_counts_.size()) other_counts_.emplace_back();
      other_counts_[others].assign(counts_.size(), 0);
      unused.push_back(&other_counts_[others++]);
    }
    std::vector<std::uint32_t>* const counts = unused.back();
    unused.pop_back();
    return counts;
  };
  points.pass([&](std::size_t, std::span<const Point> own) {
    std::vector<std::uint32_t>* counts = nullptr;
    turns.take([&] { counts = take_counts(); });
    std::uint32_t* const count_of = counts->data();
    visit_numbered(own, numbering(),
                   [&](std::size_t, std::span<const Point> block, const std::uint32_t* numbers) {
                     for (std::size_t i = 0; i < block.size(); ++i) ++count_of[numbers[i]];
                   });
    turns.take([&] { unused.push_back(counts); });
  });
  for (std::size_t k = 0; k < others; ++k) {
    std::transform(counts_.begin(), counts_.end(), other_counts_[k].begin(), counts_.begin(), std::plus<>());
  }
}

/// Calls visit(place among counts_) for the cells that have points, as have all cells round them.
template <class Visit>
void WindowSample::for_each_inside_cell(const Visit& visit) const {
  for (std::uint32_t r = 1; r + 1 < rows_; ++r) {
    for (std::uint32_t c = 1; c + 1 < columns_; ++c) {
      const std::uint32_t* const own = &counts_[r * columns_ + c];
      if (own[0] == 0 || own[-1] == 0 || own[1] == 0) continue;
      const std::uint32_t* const above = own + columns_;
      const std::uint32_t* const below = own - columns_;
      if (above[-1] == 0 || above[0] == 0 || above[1] == 0) continue;
      if (below[-1] == 0 || below[0] == 0 || below[1] == 0) continue;
      visit(own);
    }
  }
}

/// How many points a cell inside the shape usually has; 0 where the numbers differ by too much, or there are
/// too few such cells to tell.
double WindowSample::usual_count(std::uint64_t points, double most_spread) {
  numbers_.clear();
  std::size_t inside = 0;
  for_each_inside_cell([&](const std::uint32_t* own) {
    numbers_.add(*own);
    inside += *own;
  });
  const bool are_enough = points < kManyPoints
                              ? static_cast<double>(inside) >= kLeastShareInside * static_cast<double>(points)
                              : numbers_.total() >= kFewCells;
  if (!are_enough) return 0;
  const double usual = numbers_.median();
  // A number of points is the inverse square of the spacing; chance alone makes numbers differ by a root of
  // them. Half as much again is let pass, as points may repeat others: it is the windows that decide.
  const double spread = numbers_.robust_deviation_of_logarithms(usual);
  const double most = 4 * most_spread * most_spread + 1 / usual;
  constexpr double kRoom = 1.5;
  return spread * spread <= kRoom * most ? usual : 0;
}

/// At the middles of the cells in which points of evenly spaced ranks lie, counted cell by cell.
void WindowSample::place_windows(std::uint64_t points, std::size_t windows, double half_side) {
  windows_.resize(windows);
  windows_of_cell_.assign(counts_.size(), 0);
  std::size_t cell = 0;
  std::uint64_t counted = counts_[0];
  for (std::size_t w = 0; w < windows; ++w) {
    const std::uint64_t rank = points * (2 * w + 1) / (2 * windows);
    while (counted <= rank) counted += counts_[++cell];
    Window& window = windows_[w];
    window.half_side = half_side;
    const std::size_t cell_row = cell / columns_;
    window.centre = {minimum_.x + (static_cast<double>(cell % columns_) + 0.5) / cells_per_length_,
                     minimum_.y + (static_cast<double>(cell_row) + 0.5) / cells_per_length_};
    const std::uint32_t left = column(std::max(window.centre.x - half_side, minimum_.x));
    const std::uint32_t right = std::min(column(window.centre.x + half_side), columns_ - 1);
    const std::uint32_t bottom = row(std::max(window.centre.y - half_side, minimum_.y));
    const std::uint32_t top = std::min(row(window.centre.y + half_side), rows_ - 1);
    for (std::uint32_t r = bottom; r <= top; ++r) {
      for (std::uint32_t c = left; c <= right; ++c)
        windows_of_cell_[r * columns_ + c] |= std::uint64_t{1} << w;
    }
  }
}

/// Returns how many points were put into windows; where that is more than `most` they are of no use, and a
/// share keeps no more than that. is_reached(cell): whether a window reaches it. for_each_window(cell, visit)
/// calls visit(window) for those.
template <class IsReached, class ForEachWindow>
std::size_t WindowSample::gather(const PointPasses& points, std::size_t most, const IsReached& is_reached,
                                 const ForEachWindow& for_each_window) {
  for (Share& share : shares_) {
    share.gathered.clear();
    share.gathered.reserve(most / shares_.size());
  }
  points.pass([&](std::size_t s, std::span<const Point> own) {
    auto& gathered = shares_[s].gathered;
    const auto gather_block = [&](std::size_t, std::span<const Point> block, const std::uint32_t* cells) {
      for_each_selected(
          0, block.size(), [&](std::size_t i) { return is_reached(cells[i]); },
          [&](std::size_t i) {
            const Point& p = block[i];
            for_each_window(cells[i], [&](std::uint32_t w) {
              const Window& window = windows_[w];
              const double away = std::max(std::abs(p.x - window.centre.x), std::abs(p.y - window.centre.y));
              if (away <= window.half_side && gathered.size() <= most) gathered.emplace_back(w, p);
            });
          });
    };
    visit_numbered(own, numbering(), gather_block);
  });
  std::size_t count = 0;
  for (const Share& share : shares_) count += share.gathered.size();
  if (count > most) return count;
  std::vector<std::size_t> ends(windows_.size() + 1);  // of the window before
  for (const Share& share : shares_) {
    for (const auto& [window, point] : share.gathered) ++ends[window + 1];
  }
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  points_of_windows_.resize(count);
  for (std::size_t w = 0; w < windows_.size(); ++w) {
    windows_[w].points = std::span(points_of_windows_).subspan(ends[w], ends[w + 1] - ends[w]);
  }
  for (const Share& share : shares_) {
    for (const auto& [window, point] : share.gathered) points_of_windows_[ends[window]++] = point;
  }
  return count;
}

/// Finds the window's triangles and their usual size, in an order that depends on the points alone, not on
/// theirs.
void WindowSample::measure(Window& window, double quantile, Share& share) {
  window.triangles = 0;
  window.usual4.reset();
  window.distinct = window.points.size();
  if (window.points.size() < 3) return;
  share.builder.build(window.points, share.this_thread);
  const Mesh& mesh = share.builder.mesh();
  const std::size_t first = share.triangles.size();
  std::size_t used = 0;  // two records for each point but one that repeats no other
  for (Mesh::Index t = 0; t < mesh.triangle_count(); ++t) {
    used += mesh.is_unused(t) ? 0U : 1U;
    if (mesh.is_ghost(t)) continue;
    const Triangle triangle(mesh, share.builder.vertices(), t);
    const Vector b = triangle.b - triangle.a;
    const Vector c = triangle.c - triangle.a;
    // Of a flat triangle both coordinates are infinite or NaN, and the comparison below leaves it out.
    const Vector centre = circumcentre(b, c, 2 * cross(b, c));
    const double x = std::abs(triangle.a.x + centre.x - window.centre.x);
    const double y = std::abs(triangle.a.y + centre.y - window.centre.y);
    if (!(std::max(x, y) <= window.half_inner)) continue;
    share.triangles.push_back(
        {triangle.size4(), triangle.twice_area(), squared_length(centre), triangle.squared_longest_edge()});
  }
  window.distinct = used / 2 + 1;
  constexpr std::size_t kFewTriangles = 24;
  window.triangles = share.triangles.size() - first;
  if (window.triangles < kFewTriangles) return;
  share.sizes4.clear();
  for (std::size_t t = first; t < share.triangles.size(); ++t)
    share.sizes4.push_back(share.triangles[t].size4);
  window.usual4 = quantile_of(share.sizes4, quantile);
}

}  // namespace polylidar::detail
