// What stands in one place of a table: a number with what belongs to it, or words.
#pragma once

#include <concepts>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hullbench::table {

/// In a cell: there is no such value.
inline constexpr const char* kNothing = "–";

/// Behind a value: what it means stands below the table.
inline constexpr const char* kSign = "†";

/// A number, and how much of it is shown.
struct Number {
  /// Of `value` three significant digits, never an exponent.
  explicit Number(double of_value);
  /// `shown_decimals` digits after the point; `with_plus`: a number that is not negative has its sign too.
  Number(double of_value, int shown_decimals, bool with_plus = false)
      : value(of_value), decimals(shown_decimals), has_plus(with_plus) {}

  /// "1.36", "+0.12", or "∞".
  std::string text() const;

  double value;  ///< may be infinite, not NaN
  int decimals;
  bool has_plus = false;
};

/// From one number to another one.
struct Range {
  /// "1.20–1.31", with signs "-1.20 to +1.31"; "> 1.20" without an upper end, "∞" when both are infinite.
  std::string text() const;

  Number low;
  Number high;
};

/// Words, or a value, and what belongs to it. What is empty is not there.
struct Cell {
  /// There is no such value.
  Cell() : words(kNothing) {}
  Cell(std::string of_words) : words(std::move(of_words)) {}
  Cell(const char* of_words) : words(of_words) {}
  Cell(Number number) : value(number) {}
  Cell(Range of_range) : range(of_range) {}
  template <std::integral Count>
  Cell(Count count) : value(Number(static_cast<double>(count), 0)) {}

  /// What is shown, without the notes.
  std::string text() const;
  /// The marks of its notes, such as "[1] [3]".
  std::string marks() const;

  std::string words;  ///< where there is no value: a failure's name, a label
  std::optional<Number> value;
  std::optional<Number> spread;  ///< of the value, in its unit: "1.36 ±0.01"
  std::optional<Number> other;   ///< the value by another definition: "3.87 (3.99)"
  std::optional<Number> of;      ///< the whole that the value is a part of: "5 of 6"
  std::optional<Range> range;    ///< alone, or one that the value lies in: "3.87 (3.12 to 4.40)"
  std::string sign;              ///< behind a value; the text below the table says what it means
  std::vector<std::size_t> notes;
};

/// From the `low` to the `high` of an interval, both as `number` gives them; "–" without one.
template <typename Interval>
Cell range_cell(
    const std::optional<Interval>& interval,
    Number (*number)(double) = [](double end) { return Number(end); }) {
  if (!interval) return {};
  return Range{number(interval->low), number(interval->high)};
}

/// Notes, numbered from 1 in the order in which they were first needed.
class Notes {
 public:
  /// The number of `text`; the same text has the same number.
  std::size_t number(const std::string& text);
  /// Each with its mark before it: "[2] text".
  std::vector<std::string> marked() const;

 private:
  std::vector<std::string> texts_;
};

}  // namespace hullbench::table
