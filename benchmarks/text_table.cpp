#include "benchmarks/text_table.hpp"

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace hullbench {
namespace {

constexpr std::size_t kLineWidth = 118;

/// `cells` as they can stand in a Markdown table: a bar is escaped, and a line break, which would end the
/// table, becomes a blank.
std::vector<std::string> escaped(std::vector<std::string> cells) {
  for (std::string& cell : cells) {
    std::string result;
    for (const char c : cell) {
      if (c == '|') result += '\\';
      result += c == '\n' || c == '\r' ? ' ' : c;
    }
    cell = std::move(result);
  }
  return cells;
}

}  // namespace

std::size_t display_width(std::string_view text) {
  // Every byte but the continuation bytes 10xxxxxx begins a character.
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

TextTable::TextTable(std::vector<std::string> header) {
  rows_.push_back(escaped(std::move(header)));
}

void TextTable::add_row(std::vector<std::string> cells) {
  if (cells.size() != rows_.front().size()) throw std::invalid_argument("A row has not one cell a column.");
  rows_.push_back(escaped(std::move(cells)));
}

void TextTable::print(std::ostream& out) const {
  const std::size_t columns = rows_.front().size();
  std::vector<std::size_t> widths(columns, 3);
  for (const auto& row : rows_) {
    for (std::size_t column = 0; column < columns; ++column) {
      widths[column] = std::max(widths[column], display_width(row[column]));
    }
  }
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      const std::string& cell = rows_[row][column];
      const std::string padding(widths[column] - display_width(cell), ' ');
      out << "| " << (column == 0 ? cell + padding : padding + cell) << ' ';
    }
    out << "|\n";
    if (row != 0) continue;
    for (std::size_t column = 0; column < columns; ++column) {
      out << '|' << std::string(widths[column] + 1, '-') << (column == 0 ? '-' : ':');
    }
    out << "|\n";
  }
}

std::string Notes::mark(const std::string& text) {
  auto found = std::find(texts_.begin(), texts_.end(), text);
  if (found == texts_.end()) found = texts_.insert(texts_.end(), text);
  return "[" + std::to_string(found - texts_.begin() + 1) + "]";
}

void Notes::print(std::ostream& out) const {
  for (std::size_t index = 0; index < texts_.size(); ++index) {
    print_item("[" + std::to_string(index + 1) + "] " + texts_[index], out);
  }
}

void print_item(std::string_view text, std::ostream& out) {
  std::istringstream words{std::string(text)};
  std::string line = "-";
  for (std::string word; words >> word;) {
    if (display_width(line) + 1 + display_width(word) > kLineWidth) {
      out << line << '\n';
      line = " ";
    }
    line += ' ' + word;
  }
  out << line << '\n';
}

}  // namespace hullbench
