// Which cells of a square grid hold points. The certificate uses these cells instead of the points.
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "cell_numbers.hpp"
#include "polylidar/geometry.hpp"
#include "scratch.hpp"
#include "thread_pool.hpp"

namespace polylidar::detail {

/// A square grid over a box, with a margin of empty cells all round. A cell is identified by the place of its
/// bit in a bitmap whose rows are whole words.
///
/// The coordinate of a point in cells is u = (x - minimum) * cells_per_length. Its computed value u' is off
/// by at most u 2^-52, less than kSlack. So for a point in column c the exact u, with the double
/// cells_per_length taken as exact, lies between c - kSlack and c + 1 + kSlack. The same holds for the
/// quarters of a cell and for rows.
class Grid {
 public:
  using Cell = std::size_t;
  static constexpr Cell kWordBits = 64;
  /// How many rows above and below, and at most how many columns on either side, may be looked at beyond the
  /// box.
  static constexpr Cell kMargin = 17;
  static constexpr double kSlack = 0x1p-30;
  static constexpr double kMostColumns = 0x1p20;  ///< and rows
  static constexpr double kMostCells = 0x1p31;    ///< with the margin, where points keep theirs in 32 bits

  Grid() = default;
  /// The box must have a finite extent, and cell_count() must be finite.
  Grid(const Box& box, double cells_per_length)
      : minimum_(box.min),
        cells_per_length_(cells_per_length),
        columns_(static_cast<Cell>((box.max.x - box.min.x) * cells_per_length) + 1),
        rows_(static_cast<Cell>((box.max.y - box.min.y) * cells_per_length) + 1),
        row_words_((columns_ + kWordBits - 1) / kWordBits + 2),
        origin_(first_word(0) * kWordBits + kWordBits) {}

  /// Its rows [begin, end) as a grid of their own, the first of them row 0, with a margin of its own. A point
  /// has a cell there where its row_number() is in [begin, end).
  Grid band(Cell begin, Cell end) const {
    Grid grid = *this;
    grid.rows_ = end - begin;
    grid.origin_ -= std::uint64_t{begin} * row_words_ * kWordBits;
    return grid;
  }

  /// How many cells a grid has, without the margin; infinite if there are too many.
  static double cell_count(const Box& box, double cells_per_length, double most_cells = kMostCells) {
    const double columns = std::floor((box.max.x - box.min.x) * cells_per_length) + 1;
    const double rows = std::floor((box.max.y - box.min.y) * cells_per_length) + 1;
    const double with_margin = (columns + 3 * kWordBits) * (rows + 2 * kMargin);
    const bool fits = columns <= kMostColumns && rows <= kMostColumns && with_margin <= most_cells;
    return fits ? columns * rows : HUGE_VAL;
  }

  double cells_per_length() const { return cells_per_length_; }
  Cell columns() const { return columns_; }
  Cell rows() const { return rows_; }
  Cell row_words() const { return row_words_; }
  std::size_t word_count() const { return std::size_t{row_words_} * (rows_ + 2 * kMargin); }
  /// The word of a bitmap where row `row` of the box starts; its first word is margin.
  std::size_t first_word(Cell row) const { return std::size_t{row_words_} * (row + kMargin); }

  double column(const Point& p) const { return (p.x - minimum_.x) * cells_per_length_; }
  double row(const Point& p) const { return (p.y - minimum_.y) * cells_per_length_; }
  /// The row of a point of the box, counted from the box's side, also in a band.
  Cell row_number(const Point& p) const { return whole(row(p)); }
  /// As cell() numbers them; of a grid whose cell_count() is finite.
  CellNumbering numbering() const {
    return {minimum_, cells_per_length_, static_cast<std::uint32_t>(row_words_ * kWordBits),
            static_cast<std::uint32_t>(origin_)};
  }
  /// The same, of any grid.
  WideNumbering wide_numbering() const {
    return {minimum_, cells_per_length_, static_cast<std::uint32_t>(row_words_ * kWordBits), origin_};
  }
  Cell cell(const Point& p) const {
    return row_number(p) * row_words_ * kWordBits + origin_ + whole(column(p));
  }

 private:
  static Cell whole(double u) {
    return static_cast<Cell>(static_cast<std::uint32_t>(static_cast<std::int32_t>(u)));
  }

  Point minimum_;
  double cells_per_length_ = 0;
  Cell columns_ = 0;
  Cell rows_ = 0;
  Cell row_words_ = 0;
  /// The cell in column 0 of the box's first row; wraps round where a band is above it, as wide numbers do.
  std::uint64_t origin_ = 0;
};

/// One bit a cell, memory kept between calls.
class Bitmap {
 public:
  using Word = std::uint64_t;

  void clear(std::size_t words);
  /// The same, shared by the threads: for what is so large that touching its memory takes its time.
  void clear(std::size_t words, ThreadPool& pool);
  bool test(Grid::Cell cell) const {
    return ((words_[cell / Grid::kWordBits] >> (cell % Grid::kWordBits)) & 1U) != 0;
  }
  /// As set(), but several threads may call it at once.
  void set_shared(Grid::Cell cell) {
    set_bits_shared(cell / Grid::kWordBits, Word{1} << (cell % Grid::kWordBits));
  }
  /// Sets the bits of a word.
  void set_bits(std::size_t word, Word bits) { words_[word] |= bits; }
  /// The same, but several threads may call it at once.
  void set_bits_shared(std::size_t word, Word bits) {
    if ((bits & ~__atomic_load_n(&words_[word], __ATOMIC_RELAXED)) == 0) return;
    __atomic_fetch_or(&words_[word], bits, __ATOMIC_RELAXED);
  }
  void set(Grid::Cell cell) { words_[cell / Grid::kWordBits] |= Word{1} << (cell % Grid::kWordBits); }
  /// Those of `count` cells.
  void set_all(const std::uint32_t* cells, std::size_t count) {
    constexpr std::size_t kAtOnce = 8;
    std::size_t i = 0;
    for (; i + kAtOnce <= count; i += kAtOnce) {
      for (std::size_t k = 0; k < kAtOnce; ++k) set(cells[i + k]);
    }
    for (; i < count; ++i) set(cells[i]);
  }
  /// Sets the `count` < 64 bits from `first` on.
  void set_run(Grid::Cell first, unsigned count) {
    const Word bits = (Word{1} << count) - 1;
    const unsigned shift = first % Grid::kWordBits;
    words_[first / Grid::kWordBits] |= bits << shift;
    if (shift + count > Grid::kWordBits)
      words_[first / Grid::kWordBits + 1] |= bits >> (Grid::kWordBits - shift);
  }
  /// Clears the `count` < 64 bits from `first` on.
  void clear_run(Grid::Cell first, unsigned count) {
    const Word bits = (Word{1} << count) - 1;
    const unsigned shift = first % Grid::kWordBits;
    words_[first / Grid::kWordBits] &= ~(bits << shift);
    if (shift + count > Grid::kWordBits)
      words_[first / Grid::kWordBits + 1] &= ~(bits >> (Grid::kWordBits - shift));
  }
  /// The 64 bits from `first` on.
  Word window(Grid::Cell first) const {
    const Word* word = words_ + first / Grid::kWordBits;
    const unsigned shift = first % Grid::kWordBits;
    return word[0] >> shift | word[1] << 1U << (Grid::kWordBits - 1 - shift);
  }
  Word* words() { return words_; }
  const Word* words() const { return words_; }
  /// Has the processor fetch the word of a cell, to be changed.
  void prefetch(Grid::Cell cell) const { __builtin_prefetch(words_ + cell / Grid::kWordBits, 1); }
  /// The bits from word `first` on as a map of their own, without a copy, to be read as long as this one
  /// lives.
  Bitmap from_word(std::size_t first) const { return Bitmap(words_ + first); }

  Bitmap() = default;

 private:
  explicit Bitmap(Word* words) : words_(words) {}

  Scratch<Word> storage_;
  Word* words_ = nullptr;
};

/// Few of the cells of a grid, in little memory.
class FewCells {
 public:
  /// Replaces the cells by those that find(first, end, found) puts into the rows from `first` to before
  /// `end`, of the grid's rows [begin, rows_end) a few at a time. `found` is a bitmap of a band() of these
  /// rows; find() is called by several threads.
  using Find = std::function<void(Grid::Cell first, Grid::Cell end, Bitmap& found)>;
  void fill(const Grid& grid, Grid::Cell begin, Grid::Cell rows_end, const Find& find, ThreadPool& pool);

  std::size_t count() const { return count_; }
  /// Calls visit(cell) for those in the words [begin, end) of the grid's bitmap.
  template <class Visit>
  void for_each(std::size_t begin, std::size_t end, const Visit& visit) const {
    for (std::size_t w = begin; w < end; ++w) {
      const Bitmap::Word group = has_any_.words()[w / Grid::kWordBits] >> (w % Grid::kWordBits);
      // On to the next word that has any, or to the last of this group.
      w += group == 0 ? Grid::kWordBits - 1 - w % Grid::kWordBits
                      : static_cast<std::size_t>(std::countr_zero(group));
      if (group == 0 || w >= end) continue;
      for (Bitmap::Word left = words_[index_of(w)]; left != 0; left &= left - 1) {
        visit(w * Grid::kWordBits + static_cast<std::size_t>(std::countr_zero(left)));
      }
    }
  }

  /// Whether the word of the cell has any; quick, and mostly true where test() is.
  bool may_have(Grid::Cell cell) const { return has_any_.test(cell / Grid::kWordBits); }
  /// Of a cell that it may have.
  void prefetch(Grid::Cell cell) const { __builtin_prefetch(&words_[index_of(cell / Grid::kWordBits)]); }
  bool test(Grid::Cell cell) const {
    return ((words_[index_of(cell / Grid::kWordBits)] >> (cell % Grid::kWordBits)) & 1U) != 0;
  }

 private:
  std::size_t index_of(std::size_t word) const {
    const Bitmap::Word below = (Bitmap::Word{1} << (word % Grid::kWordBits)) - 1;
    const std::size_t group = word / Grid::kWordBits;
    return before_group_[group] + static_cast<std::size_t>(std::popcount(has_any_.words()[group] & below));
  }

  Bitmap has_any_;                           ///< bit w: word w of the grid's bitmap has cells
  std::vector<std::uint32_t> before_group_;  ///< 64 words of the bitmap -> how many before them have cells
  std::vector<Bitmap::Word> words_;          ///< those that have
  std::size_t count_ = 0;                    ///< of the cells
};

/// Which cells a part reaches, in the map of the occupied cells: their bits are cleared there. So it can be
/// asked of occupied cells only.
class ReachedCells {
 public:
  /// Of a map with so many words, which changes and must live as long; none are reached yet.
  void begin(Bitmap& occupied, std::size_t words) {
    not_reached_ = &occupied;
    has_any_.clear(words / Grid::kWordBits + 1);
  }
  /// The `count` < 64 cells from `first` on are reached.
  void set_run(Grid::Cell first, unsigned count) {
    not_reached_->clear_run(first, count);
    has_any_.set(first / Grid::kWordBits);
    has_any_.set((first + count - 1) / Grid::kWordBits);
  }
  /// Of an occupied cell, as the next two: as those of FewCells.
  bool may_have(Grid::Cell cell) const { return has_any_.test(cell / Grid::kWordBits); }
  void prefetch(Grid::Cell cell) const { not_reached_->prefetch(cell); }
  bool test(Grid::Cell cell) const { return !not_reached_->test(cell); }
  /// Of the 64 cells from `first` on those that are occupied and not reached.
  Bitmap::Word not_reached(Grid::Cell first) const { return not_reached_->window(first); }

 private:
  Bitmap* not_reached_ = nullptr;
  Bitmap has_any_;  ///< bit w: of word w of the map some cells are reached; fits into a processor's cache
};

/// Whether two different points may lie within `distance` of each other in x and in y. `distance` times
/// cells_per_length must be below half of Grid::kSlack. `cells`: point -> cell; `shared`: the cells with more
/// than one point. May also say yes if more than a few dozen points share a cell or lie on the borders of
/// cells.
class ClosePairs {
 public:
  bool may_exist(std::span<const Point> points, const Grid& grid, const std::uint32_t* cells,
                 const Bitmap& shared, double distance, ThreadPool& pool);

 private:
  /// A point in a shared cell, and the one before it in the same cell.
  struct Link {
    std::uint32_t point;
    std::uint32_t before;  ///< in Band::links, or kNone
    std::uint16_t x;       ///< where in the cell, in 2^-16 of its side
    std::uint16_t y;
  };
  /// The points of a chunk that have to be looked at.
  struct Chunk {
    std::vector<std::vector<Link>> in_shared;  ///< band -> points in shared cells, not linked yet
    /// Points so near a cell's border that a close one may be beyond it.
    std::vector<std::uint32_t> on_borders;
  };

  /// Consecutive words of the bitmap of cells.
  struct Band {
    std::vector<std::uint32_t> last;  ///< shared cell -> the last of its points so far in `links`, or kNone
    std::vector<Link> links;          ///< different points in shared cells
  };

  struct Words {
    std::size_t begin;
    std::size_t end;
  };

  void look_at(std::span<const Point> points, std::size_t begin, std::size_t end, const Grid& grid,
               const std::uint32_t* cells, const Bitmap& shared, Chunk& chunk) const;
  Words words_of_band(const Grid& grid, std::size_t band) const;
  bool are_in_band(std::size_t number, std::span<const Point> points, const Grid& grid,
                   const std::uint32_t* cells, const Bitmap& shared, double distance,
                   std::span<const Chunk> looked_at);

  std::vector<Chunk> chunks_;
  std::vector<Band> bands_;
  std::vector<std::uint32_t> rank_;  ///< word -> how many cells are shared before it in its band
};

}  // namespace polylidar::detail
