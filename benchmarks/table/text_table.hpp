// A table of text, and the numbered notes of one.
#pragma once

#include <cstddef>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace hullbench::table {

/// Number of columns that `text` (UTF-8 without wide or combining characters) takes in a terminal.
std::size_t display_width(std::string_view text);

/// A table of text.
class TextTable {
 public:
  explicit TextTable(std::vector<std::string> header);
  /// `cells` has one text a column, else std::invalid_argument. A line break in it becomes a blank.
  void add_row(std::vector<std::string> cells);
  bool empty() const { return rows_.size() == 1; }
  /// Whether a column is set to the left: the first one, and one whose cells are words, of which none begins
  /// with a digit. Numbers are set to the right.
  bool is_left(std::size_t column) const;
  /// By row, then column; the first row is the header.
  const std::vector<std::vector<std::string>>& rows() const { return rows_; }

 private:
  std::vector<std::vector<std::string>> rows_;
};

/// Notes, numbered from 1 in the order in which they were first needed.
class Notes {
 public:
  /// The mark of `text`, such as "[2]"; the same text has the same mark.
  std::string mark(const std::string& text);
  /// Each with its mark before it.
  std::vector<std::string> marked() const;

 private:
  std::vector<std::string> texts_;
};

/// Behind a value: what it means stands below the table. CSV leaves it out.
inline constexpr const char* kSign = "†";

/// `cell` without the marks of notes at its end: "SpatiaLite (paper)" of "SpatiaLite (paper) [1] [3]".
std::string without_marks(const std::string& cell);

}  // namespace hullbench::table
