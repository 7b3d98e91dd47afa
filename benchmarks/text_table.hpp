// A Markdown table whose columns line up in a terminal, and its numbered notes.
#pragma once

#include <cstddef>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace hullbench {

/// Number of columns that `text` (UTF-8 without wide or combining characters) takes in a terminal.
std::size_t display_width(std::string_view text);

/// A table of text: the first column is set to the left, all others to the right.
class TextTable {
 public:
  explicit TextTable(std::vector<std::string> header);
  /// `cells` has one text a column, else std::invalid_argument. A "|" in it is escaped.
  void add_row(std::vector<std::string> cells);
  bool empty() const { return rows_.size() == 1; }
  void print(std::ostream& out) const;

 private:
  std::vector<std::vector<std::string>> rows_;  ///< by row, then column; the first row is the header
};

/// Notes, numbered from 1 in the order in which they were first needed.
class Notes {
 public:
  /// The mark of `text`, such as "[2]"; the same text has the same mark.
  std::string mark(const std::string& text);
  void print(std::ostream& out) const;

 private:
  std::vector<std::string> texts_;
};

/// Prints `text` as a Markdown list item, broken between words so that no line is longer than 118 columns.
void print_item(std::string_view text, std::ostream& out);

}  // namespace hullbench
