#include "polylidar/stream.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <deque>
#include <exception>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "automatic_limit.hpp"
#include "certificate.hpp"
#include "coordinate_range.hpp"
#include "interior.hpp"
#include "options_check.hpp"
#include "point_passes.hpp"
#include "reach.hpp"
#include "selected.hpp"
#include "shards.hpp"
#include "source_passes.hpp"

namespace polylidar {
namespace {

using detail::Bitmap;
using detail::Grid;
using detail::has_changed;
using detail::kAlwaysInMemory;

/// Thrown in the first pass, where the points are not those of StreamOptions::expected.
class NotAsExpected : public std::exception {};

/// Whether a grid may be laid over a box that nobody has measured.
bool is_usual(const Box& box) {
  constexpr double kFarthest = 1e100;
  constexpr double kLeastSide = 1e-100;
  const auto is_usual_side = [](double low, double high) {
    return low >= -kFarthest && high <= kFarthest && high - low >= kLeastSide;
  };
  return is_usual_side(box.min.x, box.max.x) && is_usual_side(box.min.y, box.max.y);
}

bool is_within(const Box& box, const Box& outer) {
  return box.min.x >= outer.min.x && box.min.y >= outer.min.y && box.max.x <= outer.max.x &&
         box.max.y <= outer.max.y;
}

bool all_sources(std::size_t /*source*/) {
  return true;
}

/// Where all passes but the first, and those that look for sizes, are to come.
constexpr int kPassesAfterSizes = 3;

/// Rows from `begin` on, before `end`.
struct Rows {
  Grid::Cell begin = 0;
  Grid::Cell end = 0;

  bool empty() const { return begin == end; }
  bool has(Grid::Cell row) const { return row >= begin && row < end; }
  bool meets(const Rows& other) const { return begin < other.end && other.begin < end; }
  /// With so many more on either side, as far as there are any.
  Rows with_halo(Grid::Cell halo, Grid::Cell rows) const {
    return {begin - std::min(begin, halo), std::min(end + halo, rows)};
  }
};

// What a shard must know beyond its band. A point of the band is in the part where an uncertain one lies at
// most kReachedRows away, so these are looked for there. Whether one is uncertain is decided by the cells
// at most kReach rows away from its own, so cells are marked as occupied there, too: 24 rows, which are 4
// radii. On less, points of the part would be missing, and points be taken for uncertain that are not.
constexpr Grid::Cell kHaloOfUncertain = detail::kReachedRows;
constexpr Grid::Cell kHaloOfOccupied = kHaloOfUncertain + detail::kReach;
// What is marked beyond them falls into the margin.
static_assert(kHaloOfUncertain + detail::kReachedRows <= kHaloOfOccupied + Grid::kMargin);

Rows band(const Shard& shard, Grid::Cell rows) {
  const auto begin = [&](std::uint64_t number) {
    return static_cast<Grid::Cell>(std::uint64_t{rows} * number / shard.count);
  };
  return {begin(shard.number - 1), begin(shard.number)};
}

/// How many rows the map of a shard can have.
Grid::Cell most_rows(const Shard& shard, Grid::Cell rows) {
  return std::min(rows, (rows + shard.count - 1) / shard.count + 2 * kHaloOfOccupied);
}

/// The same whatever blocks the points come in.
std::uint64_t checksum(std::span<const Point> block, std::uint64_t first) {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < block.size(); ++i) {
    // Odd numbers with many bits, and shifts between the products, as in splitmix64.
    std::uint64_t mixed = std::bit_cast<std::uint64_t>(block[i].x) + (first + i) * 0x9E3779B97F4A7C15U;
    mixed = (mixed ^ mixed >> 30U) * 0xBF58476D1CE4E5B9U;
    mixed += std::bit_cast<std::uint64_t>(block[i].y);
    mixed = (mixed ^ mixed >> 27U) * 0x94D049BB133111EBU;
    sum += mixed ^ mixed >> 31U;
  }
  return sum;
}

/// Points of a block on their way through a pass over some rows of cells, and their cells.
struct CellBlock {
  std::uint64_t first;  ///< number of the first point among all
  std::span<const Point> points;
  const std::uint64_t* cells;  ///< of each point; of those below or above the map, of no meaning
  Grid::Cell begin_of_rows;    ///< the first cell of the rows
  Grid::Cell cells_of_rows;    ///< how many they have
  bool has_all;                ///< whether all points lie in the rows

  /// Whether point i lies in the rows.
  bool has(std::size_t i) const { return has_all || cells[i] - begin_of_rows < cells_of_rows; }
};

/// The steps from the sources to a shard's part or to the hull.
class Stream {
 public:
  Stream(std::span<const PointSource> sources, const Options& options, const Shard& shard,
         const StreamOptions& stream_options)
      : stream_options_(stream_options),
        limits_(detail::checked_limits(options)),
        passes_(sources, stream_options, pool_) {
    if (shard.number < 1 || shard.number > shard.count) {
      throw std::invalid_argument("there is no " + detail::name_of(shard));
    }
    pool_.use(options.threads);
    while (slots_.size() < passes_.slot_count()) slots_.emplace_back();
    part_.shard = shard;
    part_.options = options;
  }

  StreamShard find_part();
  StreamedHull find_hull();

 private:
  using NumberedPoint = std::pair<std::uint64_t, Point>;
  /// An uncertain point of the slot that it is found in.
  struct Uncertain {
    std::uint64_t number;
    Grid::Cell cell;
    bool is_own;
  };
  /// What a pass finds in a slot (SourcePasses), until it is put behind that of the slots before.
  struct Slot {
    std::size_t source = 0;  ///< whose points the next two are of
    detail::RangeOfBlocks range;
    std::uint64_t checksum = 0;
    std::vector<Uncertain> uncertain;
    std::vector<NumberedPoint> gathered;
    std::vector<Point> points;
  };
  // As in SourcePasses::Pass:
  using TakeBlock = std::function<void(std::size_t slot, const detail::SourceBlock& block)>;
  using EndOfSlots = std::function<void(std::size_t slots)>;

  template <class Take>
  void run_checked(const std::function<bool(std::size_t source)>& is_read, const Take& take,
                   const EndOfSlots& end);
  template <class Take>
  void run_over_cells(const Rows& rows, const Take& take, const EndOfSlots& end);
  template <class Cells, class Visit>
  void run_over_some(const Rows& rows, const Cells& some, const Visit& visit, const EndOfSlots& end);

  void find_extents(bool is_for_others, const TakeBlock& also = {});
  void begin_as_expected();
  void check_scale() const;
  detail::SizesBy look_for_sizes();
  bool fit_grid(double widest);
  void choose_grid(double widest);
  void find_occupied_cells();
  void find_uncertain_points();
  bool find_near_cells(const detail::FewCells& uncertain_cells, detail::FewCells& near_cells);
  void keep_near(Slot& slot, std::uint64_t number, const Point& point);
  void mark_reached();
  void gather();
  void find_points(bool keeps_map);
  void take_all();
  StreamedHull hull_in_memory();
  StreamedHull hull_by_limits();
  std::optional<StreamedHull> hull_by_chosen_sizes();

  const StreamOptions& stream_options_;
  Limits limits_;
  detail::ThreadPool pool_;
  detail::SourcePasses passes_;
  bool is_first_pass_ = true;
  bool is_as_expected_ = false;                 ///< the first pass has done what the second one does
  std::vector<detail::RangeOfBlocks> extents_;  ///< one a source
  detail::CoordinateRange range_;               ///< of all
  Rows own_;                                    ///< the shard's band
  Rows tested_;                                 ///< in which uncertain points are looked for
  Rows seen_;                                   ///< in which cells are marked as occupied
  Grid grid_;                                   ///< the rows seen_ of the grid over the box
  std::deque<Slot> slots_;
  std::optional<Bitmap> occupied_;        ///< cells with points; from mark_reached() on without reached ones
  detail::ReachedCells reached_;          ///< cells of the part
  std::vector<Grid::Cell> reaching_;      ///< cells with uncertain points, until they are marked
  std::vector<std::uint64_t> uncertain_;  ///< of the shard's own band, ascending
  bool keeps_near_ = false;               ///< whether the next has all points that gather() looks for
  /// Of the shard's own band, near uncertain cells, ascending; as they come from the slots.
  std::vector<std::vector<NumberedPoint>> near_;
  std::size_t most_near_ = 0;               ///< how many may be kept
  std::atomic<std::size_t> kept_near_ = 0;  ///< roughly
  StreamShard part_;
  detail::AutomaticLimit automatic_limit_;
  std::optional<detail::SizesBy> sizes_by_;  ///< what look_for_sizes() has returned
};

/// The first pass. `is_for_others`: whether those who look for other shards must see the same source. `also`
/// is what the second pass would do: it gets the blocks as long as they lie in the expected box, and has got
/// all points where is_as_expected_ is true afterwards.
void Stream::find_extents(bool is_for_others, const TakeBlock& also) {
  std::vector<detail::RangeOfBlocks> found(passes_.source_count());
  std::atomic<bool> is_expected = also != nullptr;
  const auto take = [&](std::size_t number, const detail::SourceBlock& block) {
    Slot& slot = slots_[number];
    slot.source = block.source;
    detail::RangeOfBlocks of_block;
    of_block.add(block.points);
    slot.range.add(of_block);
    if (is_for_others) slot.checksum += checksum(block.points, block.first);
    if (!is_expected.load(std::memory_order_relaxed)) return;
    if (!of_block.not_finite() && is_within(of_block.box(), stream_options_.expected->box)) {
      also(number, block);
    } else {
      is_expected.store(false, std::memory_order_relaxed);
    }
  };
  const auto end = [&](std::size_t slots) {
    for (std::size_t s = 0; s < slots; ++s) {
      detail::RangeOfBlocks& of_source = found[slots_[s].source];
      of_source.add(std::exchange(slots_[s].range, {}));
      part_.source_checksum += std::exchange(slots_[s].checksum, 0);
      if (of_source.not_finite() && !passes_.are_read_at_once()) {
        throw detail::point_not_finite(passes_.first_of(slots_[s].source) + *of_source.not_finite());
      }
    }
  };
  passes_.run({all_sources, take, end});
  is_first_pass_ = false;
  detail::RangeOfBlocks all;
  std::vector<std::uint64_t> counts;
  for (const detail::RangeOfBlocks& extent : found) {
    all.add(extent);
    counts.push_back(extent.count());
  }
  if (all.not_finite()) throw detail::point_not_finite(*all.not_finite());
  extents_ = std::move(found);
  passes_.know_counts(std::move(counts));
  part_.source_points = all.count();
  part_.box = all.box();
  if (all.count() > 0) range_ = all.range();
  is_as_expected_ = is_expected && stream_options_.expected->count == all.count() &&
                    stream_options_.expected->box == all.box();
}

/// A later pass: take(slot, block) with points that lie where the first pass found them.
template <class Take>
void Stream::run_checked(const std::function<bool(std::size_t source)>& is_read, const Take& take,
                         const EndOfSlots& end) {
  const auto check_and_take = [&](std::size_t slot, const detail::SourceBlock& block) {
    if (!detail::are_within(block.points, extents_[block.source].box())) throw has_changed();
    take(slot, block);
  };
  passes_.run({is_read, check_and_take, end});
}

/// A pass: take(slot, block) with points that have their cells, as a CellBlock. Sources without points in
/// these rows, which are among seen_, are not read. In a first pass numbers are not known, and `end` is not
/// called.
template <class Take>
void Stream::run_over_cells(const Rows& rows, const Take& take, const EndOfSlots& end) {
  const auto is_read = [&](std::size_t s) {
    if (extents_[s].count() == 0) return false;
    const Box& box = extents_[s].box();
    return rows.meets({grid_.row_number(box.min), grid_.row_number(box.max) + 1});
  };
  const auto first_cell = [&](Grid::Cell row) {
    return grid_.first_word(row - seen_.begin) * Grid::kWordBits;
  };
  const Grid::Cell begin_of_rows = first_cell(rows.begin);
  const Grid::Cell cells_of_rows = first_cell(rows.end) - begin_of_rows;
  const bool has_all = part_.shard.count == 1;
  const auto take_block = [&](std::size_t slot, const detail::SourceBlock& block) {
    detail::visit_numbered(block.points, grid_.wide_numbering(),
                           [&](std::size_t begin, std::span<const Point> points, const std::uint64_t* cells) {
                             take(slots_[slot], CellBlock{block.first + begin, points, cells, begin_of_rows,
                                                          cells_of_rows, has_all});
                           });
  };
  if (is_first_pass_) return find_extents(false, take_block);
  run_checked(is_read, take_block, end);
}

/// The same: visit(slot, point, cell, number) for the points in these rows that lie in cells of `some`, which
/// are FewCells or ReachedCells.
template <class Cells, class Visit>
void Stream::run_over_some(const Rows& rows, const Cells& some, const Visit& visit, const EndOfSlots& end) {
  const auto take = [&](Slot& slot, const CellBlock& block) {
    // Many points wait for memory at the same time: no branch depends on what is read before the last loop.
    std::array<std::uint32_t, detail::kNumberedAtOnce> chosen;
    std::size_t count = 0;
    detail::for_each_selected(
        0, block.points.size(), [&](std::size_t i) { return block.has(i) && some.may_have(block.cells[i]); },
        [&](std::uint32_t i) {
          some.prefetch(block.cells[i]);
          chosen[count++] = i;
        });
    for (std::size_t k = 0; k < count; ++k) {
      const std::uint32_t i = chosen[k];
      if (some.test(block.cells[i])) visit(slot, block.points[i], block.cells[i], block.first + i);
    }
  };
  run_over_cells(rows, take, end);
}

/// The same for all shards, and where the shard has its band in it. `widest`: no dropped triangle has a
/// smaller circumradius. Returns false where no grid fits into the memory.
bool Stream::fit_grid(double widest) {
  const Box& box = part_.box;
  widest *= (1 - detail::kSafety) * (1 - detail::kUneven);
  const double area = (box.max.x - box.min.x) * (box.max.y - box.min.y);
  double radius = std::min(
      widest, detail::kWidestInSpacings * std::sqrt(area / static_cast<double>(part_.source_points)));
  constexpr double kWider = 1.1;
  const auto fits = [&] {
    if (!std::isfinite(Grid::cell_count(box, detail::kRadius / radius, HUGE_VAL))) return false;
    const Grid grid(box, detail::kRadius / radius);
    const auto rows = static_cast<double>(most_rows(part_.shard, grid.rows()) + 2 * Grid::kMargin);
    const double words = rows * static_cast<double>(grid.row_words());
    constexpr Grid::Cell kMostWords = std::numeric_limits<Grid::Cell>::max() / Grid::kWordBits;
    return words <= static_cast<double>(kMostWords) &&
           sizeof(Bitmap::Word) * words <= stream_options_.most_map_bytes;
  };
  while (!fits() && radius < widest) radius = std::min(radius * kWider, widest);
  if (!fits()) return false;
  const Grid grid(box, detail::kRadius / radius);
  part_.cells_per_length = grid.cells_per_length();
  own_ = band(part_.shard, grid.rows());
  tested_ = own_.with_halo(kHaloOfUncertain, grid.rows());
  seen_ = own_.with_halo(kHaloOfOccupied, grid.rows());
  grid_ = grid.band(seen_.begin, seen_.end);
  return true;
}

void Stream::choose_grid(double widest) {
  if (fit_grid(widest)) return;
  throw std::invalid_argument(
      detail::is_any_limit_given(part_.options)
          ? "the limit is too small for the distances between the points: give a larger one, or more memory"
          : "the map of cells needs more memory than it may take: allow more, or give alpha, "
            "max_edge_length or max_perimeter");
}

void Stream::find_occupied_cells() {
  occupied_.emplace().clear(grid_.word_count(), pool_);
  const bool is_alone = pool_.threads() == 1;
  const auto take = [&](Slot&, const CellBlock& block) {
    for (std::size_t i = 0; i < block.points.size(); ++i) {
      if (block.has(i)) occupied_->prefetch(block.cells[i]);  // many wait for memory at the same time
    }
    // Points that follow one another in a scan line mostly have their bits in one word. A change that all
    // threads see takes its time, so these bits are set together.
    std::size_t word = 0;
    Bitmap::Word bits = 0;
    const auto set_bits = [&] {
      if (is_alone) {
        occupied_->set_bits(word, bits);
      } else {
        occupied_->set_bits_shared(word, bits);
      }
    };
    for (std::size_t i = 0; i < block.points.size(); ++i) {
      if (!block.has(i)) continue;
      const Grid::Cell cell = block.cells[i];
      if (cell / Grid::kWordBits != word) {
        set_bits();
        word = cell / Grid::kWordBits;
        bits = 0;
      }
      bits |= Bitmap::Word{1} << (cell % Grid::kWordBits);
    }
    set_bits();
  };
  run_over_cells(seen_, take, [](std::size_t) {});
}

void Stream::find_uncertain_points() {
  detail::FewCells uncertain_cells;
  const auto find = [&](Grid::Cell begin, Grid::Cell end, Bitmap& found) {
    // By rows of their own.
    detail::find_uncertain_cells(grid_.band(begin, end), occupied_->from_word(begin * grid_.row_words()), 0,
                                 end - begin, found);
  };
  uncertain_cells.fill(grid_, tested_.begin - seen_.begin, tested_.end - seen_.begin, find, pool_);

  detail::FewCells near_cells;
  keeps_near_ = find_near_cells(uncertain_cells, near_cells);

  const detail::PointCertificate& certificate = detail::PointCertificate::instance();
  const auto look = [&](Slot& slot, const Point& p, Grid::Cell cell, std::uint64_t number) {
    if (certificate.is_certified(p, cell, grid_, *occupied_)) return;
    slot.uncertain.push_back({number, cell, own_.has(grid_.row_number(p))});
  };
  const auto look_and_keep = [&](Slot& slot, const Point& p, Grid::Cell cell, std::uint64_t number) {
    if (own_.has(grid_.row_number(p))) keep_near(slot, number, p);
    if (uncertain_cells.may_have(cell) && uncertain_cells.test(cell)) look(slot, p, cell, number);
  };
  std::size_t near_count = 0;
  const auto end = [&](std::size_t slots) {
    for (std::size_t s = 0; s < slots; ++s) {
      for (const auto& [number, cell, is_own] : slots_[s].uncertain) {
        if (is_own) {
          if (uncertain_.size() == kMaxPoints) throw detail::too_much_outline();
          uncertain_.push_back(number);
        }
        if (reaching_.empty() || reaching_.back() != cell) reaching_.push_back(cell);
      }
      slots_[s].uncertain.clear();
      near_count += slots_[s].gathered.size();
      if (!slots_[s].gathered.empty()) near_.push_back(std::exchange(slots_[s].gathered, {}));
    }
    kept_near_ = std::max(kept_near_.load(), near_count);
  };
  if (!keeps_near_) return run_over_some(tested_, uncertain_cells, look, end);
  passes_.expect_passes(passes_.passes() + 1);
  run_over_some(tested_, near_cells, look_and_keep, end);
  if (kept_near_ <= most_near_) return;
  keeps_near_ = false;
  near_.clear();
  passes_.expect_another();
}

/// The cells that mark_reach() may mark for uncertain points. Returns false where the points in them are not
/// to be kept, as they may be too many.
bool Stream::find_near_cells(const detail::FewCells& uncertain_cells, detail::FewCells& near_cells) {
  constexpr std::uint64_t kPointsForOneKept = 4;
  constexpr std::uint64_t kPointsForOneCell = 32;
  constexpr double kMostBytes = 0x1p28;
  constexpr std::size_t kWordsOfReach = 2 * detail::kReachedHalfWidths.size();  // at most, for each cell
  const std::size_t words = std::min(kWordsOfReach * uncertain_cells.count(), grid_.word_count());
  const auto bytes = static_cast<double>(sizeof(Bitmap::Word) * (grid_.word_count() + 2 * words));
  const double room = std::min(stream_options_.most_map_bytes - bytes, kMostBytes);
  const double most = std::max(room, 0.0) / sizeof(NumberedPoint);
  const std::uint64_t share = part_.source_points / kPointsForOneKept;
  most_near_ = static_cast<std::size_t>(std::min(static_cast<double>(share), most));
  kept_near_ = 0;
  if (kPointsForOneCell * uncertain_cells.count() > part_.source_points) return false;
  const Box& box = part_.box;
  const double per_length = grid_.cells_per_length();
  const double cells = (box.max.x - box.min.x) * per_length * ((box.max.y - box.min.y) * per_length);
  const double points_a_cell = static_cast<double>(part_.source_points) / cells;
  constexpr double kNearOne = 200;  // a quarter of the cells within 2 r of one, as neighbours share them
  const double expected = kNearOne * points_a_cell * static_cast<double>(uncertain_cells.count());
  if (expected > most) return false;

  const Grid::Cell in_row = grid_.row_words() * Grid::kWordBits;
  const Rows tested{tested_.begin - seen_.begin, tested_.end - seen_.begin};
  const auto find = [&](Grid::Cell begin, Grid::Cell end, Bitmap& found) {
    const Rows wanted{begin, end};
    const Rows around = wanted.with_halo(detail::kReachedRows, grid_.rows());
    uncertain_cells.for_each(
        grid_.first_word(around.begin), grid_.first_word(around.end), [&](Grid::Cell cell) {
          const Grid::Cell row = cell / in_row - Grid::kMargin;
          const Grid::Cell column = cell % in_row;
          constexpr auto kHalfWidths = detail::kReachedHalfWidths;
          for (std::size_t k = 0; k < kHalfWidths.size(); ++k) {
            const Grid::Cell other = row + k - detail::kReachedRows;  // wraps round below the first
            if (!wanted.has(other)) continue;
            found.set_run((other - begin + Grid::kMargin) * in_row + column - kHalfWidths[k],
                          2 * kHalfWidths[k] + 1);
          }
        });
  };
  near_cells.fill(grid_, tested.begin, tested.end, find, pool_);
  return true;
}

/// Puts a point into those that gather() chooses from, as long as these are not too many.
void Stream::keep_near(Slot& slot, std::uint64_t number, const Point& point) {
  constexpr std::size_t kCountedAtOnce = 1024;  // as all threads share the count
  if (kept_near_.load(std::memory_order_relaxed) > most_near_) return;
  slot.gathered.emplace_back(number, point);
  if (slot.gathered.size() % kCountedAtOnce == 0) kept_near_ += kCountedAtOnce;
}

/// Takes the cells that may hold points of the part out of occupied_, where they count as reached.
void Stream::mark_reached() {
  reached_.begin(*occupied_, grid_.word_count());
  std::sort(reaching_.begin(), reaching_.end());  // so that what is marked is near what was marked before
  for (const Grid::Cell cell : reaching_) detail::mark_reach(grid_, cell, reached_);
  reaching_ = {};
}

/// The points of the part: from the points near uncertain cells where these were kept, otherwise by a pass.
void Stream::gather() {
  part_.points.clear();
  part_.numbers.clear();
  part_.uncertain.clear();
  auto next = uncertain_.begin();
  const auto add = [&](const NumberedPoint& one) {
    const bool is_uncertain = next != uncertain_.end() && *next == one.first;
    if (is_uncertain) ++next;
    part_.points.push_back(one.second);
    part_.numbers.push_back(one.first);
    part_.uncertain.push_back(is_uncertain ? 1 : 0);
  };
  const auto check_count = [&] {
    if (part_.points.size() > kMaxPoints) throw detail::too_much_outline();
  };
  if (std::exchange(keeps_near_, false)) {
    constexpr std::size_t kAhead = 16;
    for (const std::vector<NumberedPoint>& points : near_) {
      for (std::size_t i = 0; i < points.size(); ++i) {
        if (i + kAhead < points.size()) reached_.prefetch(grid_.cell(points[i + kAhead].second));
        if (reached_.test(grid_.cell(points[i].second))) add(points[i]);
      }
    }
    near_.clear();
    check_count();
  } else {
    const auto look = [](Slot& slot, const Point& p, Grid::Cell, std::uint64_t number) {
      slot.gathered.emplace_back(number, p);
    };
    const auto end = [&](std::size_t slots) {
      for (std::size_t s = 0; s < slots; ++s) {
        for (const NumberedPoint& one : slots_[s].gathered) add(one);
        slots_[s].gathered.clear();
      }
      check_count();
    };
    run_over_some(own_, reached_, look, end);
  }
  if (next != uncertain_.end()) throw has_changed();
  // The corners of the convex hull are uncertain, so one shard alone reaches as far as all points.
  if (part_.shard.count == 1 && bounding_box(part_.points) != part_.box) throw has_changed();
}

/// Puts all points into the part.
void Stream::take_all() {
  passes_.expect_passes(passes_.passes() + 1);
  part_.points.clear();
  part_.points.reserve(part_.source_points);
  const auto take = [&](std::size_t slot, const detail::SourceBlock& block) {
    slots_[slot].points.insert(slots_[slot].points.end(), block.points.begin(), block.points.end());
  };
  const auto end = [&](std::size_t slots) {
    for (std::size_t s = 0; s < slots; ++s) {
      std::vector<Point>& points = slots_[s].points;
      part_.points.insert(part_.points.end(), points.begin(), points.end());
      points.clear();
    }
    if (part_.points.size() > part_.source_points) throw has_changed();
  };
  passes_.run({all_sources, take, end});
  if (!part_.points.empty() && bounding_box(part_.points) != part_.box) throw has_changed();
}

StreamedHull Stream::hull_in_memory() {
  occupied_.reset();  // its memory is needed
  take_all();
  return detail::hull_in_memory(part_, part_.options.threads);
}

void Stream::check_scale() const {
  if (range_.scale_exponent == 0) return;
  throw std::invalid_argument("coordinates as large or as small as these cannot be streamed: scale them");
}

/// What is near the outline, where the grid is chosen. `keeps_map`: whether reached_ is needed afterwards.
void Stream::find_points(bool keeps_map) {
  if (own_.empty()) return;  // more shards than rows
  if (!occupied_) find_occupied_cells();
  find_uncertain_points();
  mark_reached();
  gather();
  if (!keeps_map) occupied_.reset();
}

StreamShard Stream::find_part() {
  find_extents(true);
  if (part_.source_points <= kAlwaysInMemory) {
    if (part_.shard.number > 1) return std::move(part_);  // the first has all of them
    take_all();
    part_.numbers.resize(part_.points.size());
    std::iota(part_.numbers.begin(), part_.numbers.end(), std::uint64_t{0});
    part_.uncertain.assign(part_.points.size(), 1);
    return std::move(part_);
  }
  if (!detail::is_any_limit_given(part_.options)) {
    throw std::invalid_argument(
        "a shard of more than 65536 points needs a limit: give alpha, max_edge_length or max_perimeter");
  }
  check_scale();
  if (detail::is_flat(part_.box)) return std::move(part_);
  choose_grid(detail::least_dropped_radius(limits_));
  find_points(false);
  return std::move(part_);
}

/// Looks for the sizes of triangles where no limit is given.
detail::SizesBy Stream::look_for_sizes() {
  const auto pass = [&](const detail::TakeOfShare& take) {
    const auto take_block = [&](std::size_t slot, const detail::SourceBlock& block) {
      take(slot, block.points);
    };
    if (is_first_pass_) {
      find_extents(false, take_block);
      if (!is_as_expected_) throw NotAsExpected();
      return check_scale();
    }
    run_checked(all_sources, take_block, [](std::size_t) {});
  };
  constexpr int kPassesForSizes = 2;  // or three
  passes_.expect_passes(passes_.passes() + kPassesForSizes + kPassesAfterSizes);
  const detail::PointPasses points{part_.source_points, slots_.size(), pass};
  return automatic_limit_.look(points, part_.box, pool_);
}

/// Where no limit is given; nothing where the triangulation of all points must tell.
std::optional<StreamedHull> Stream::hull_by_chosen_sizes() {
  if (!sizes_by_) sizes_by_ = look_for_sizes();
  if (*sizes_by_ == detail::SizesBy::kBlocks) return {};
  passes_.expect_passes(passes_.passes() + kPassesAfterSizes);
  const double wide_radius = automatic_limit_.wide_radius() / std::max(part_.options.detail, 1.0);
  choose_grid(wide_radius);
  find_points(true);
  const auto is_sure = [&](const detail::Triangle& triangle) {
    return detail::is_surely_whole(triangle, grid_, reached_);
  };
  for (int k = 0;; ++k) {
    detail::PartHull hull(part_, pool_);
    automatic_limit_.choose_found(hull.builder(), hull.is_tested(), part_.options.detail, pool_);
    const auto why = hull.filter(automatic_limit_.field(), is_sure, detail::is_filled(part_.options));
    if (!why) {
      StreamedHull found = hull.trace();
      found.chosen_sizes = automatic_limit_.range();
      return found;
    }
    if (why != Way::kReachesFar) throw detail::rounding_decides();
    if (hull.doubtful().empty() || k == detail::kMostEnlarged) return {};
    passes_.expect_another();
    detail::mark_reach_round(hull.doubtful(), hull.builder(), grid_, reached_);
    gather();
  }
}

StreamedHull Stream::hull_by_limits() {
  if (!occupied_) choose_grid(detail::least_dropped_radius(limits_));
  find_points(false);
  detail::PartHull hull(part_, pool_);
  if (hull.filter(detail::filter_rules(limits_), detail::is_filled(part_.options))) {
    throw detail::rounding_decides();
  }
  return hull.trace();
}

/// Where it is told what to expect of the points: does with the first pass what the second one does, and
/// takes that back if the points are others.
void Stream::begin_as_expected() {
  const std::optional<ExpectedPoints>& expected = stream_options_.expected;
  if (!expected || expected->count <= kAlwaysInMemory || !is_usual(expected->box)) return;
  part_.source_points = expected->count;
  part_.box = expected->box;
  if (detail::is_any_limit_given(part_.options)) {
    passes_.expect_passes(kPassesAfterSizes);
    // Where the map has a word for each point, the box is hardly that of the points.
    const bool fits =
        fit_grid(detail::least_dropped_radius(limits_)) && grid_.word_count() <= expected->count;
    if (fits) find_occupied_cells();
  } else {
    try {
      sizes_by_ = look_for_sizes();
    } catch (const NotAsExpected&) {
    }
  }
  if (is_as_expected_) return;
  passes_.expect_another();
  occupied_.reset();
  sizes_by_.reset();
}

StreamedHull Stream::find_hull() {
  begin_as_expected();
  if (is_first_pass_) find_extents(false);
  if (part_.source_points <= kAlwaysInMemory) return hull_in_memory();
  check_scale();
  if (detail::is_flat(part_.box)) return detail::hull_without_area(part_);
  if (detail::is_any_limit_given(part_.options)) return hull_by_limits();
  if (std::optional<StreamedHull> hull = hull_by_chosen_sizes()) return std::move(*hull);
  if (part_.source_points <= stream_options_.most_points_in_memory && part_.source_points <= kMaxPoints) {
    return hull_in_memory();
  }
  const char* const what = *sizes_by_ == detail::SizesBy::kBlocks ? "limit" : "shape";
  throw NeedsAllPoints(
      std::string("the ") + what + " of these " + std::to_string(part_.source_points) +
      " points is found by a triangulation of them all, which needs more memory: give alpha, "
      "max_edge_length or max_perimeter");
}

}  // namespace

StreamShard part_of_stream(std::span<const PointSource> sources, const Options& options, const Shard& shard,
                           const StreamOptions& stream_options) {
  StreamOptions in_order = stream_options;
  in_order.reads_at_once = false;  // the numbers of points are part of the checksum
  return Stream(sources, options, shard, in_order).find_part();
}

StreamedHull concave_hull_of_stream(std::span<const PointSource> sources, const Options& options,
                                    const StreamOptions& stream_options) {
  return Stream(sources, options, Shard(), stream_options).find_hull();
}

StreamedHull concave_hull_of_stream(const PointSource& source, const Options& options,
                                    const StreamOptions& stream_options) {
  return concave_hull_of_stream({&source, 1}, options, stream_options);
}

}  // namespace polylidar
