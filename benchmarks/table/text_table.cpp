#include "benchmarks/table/text_table.hpp"

#include <algorithm>
#include <regex>
#include <stdexcept>
#include <utility>

namespace hullbench::table {
namespace {

/// `cells` on one line each: a line break would end the table.
std::vector<std::string> on_one_line(std::vector<std::string> cells) {
  for (std::string& cell : cells) {
    std::replace_if(
        cell.begin(), cell.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
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
  rows_.push_back(on_one_line(std::move(header)));
}

void TextTable::add_row(std::vector<std::string> cells) {
  if (cells.size() != rows_.front().size()) throw std::invalid_argument("A row has not one cell a column.");
  rows_.push_back(on_one_line(std::move(cells)));
}

bool TextTable::is_left(std::size_t column) const {
  const auto begins_with = [&](bool (*is_kind)(char)) {
    return std::any_of(rows_.begin() + 1, rows_.end(), [&](const std::vector<std::string>& row) {
      return !row[column].empty() && is_kind(row[column].front());
    });
  };
  return column == 0 ||
         (begins_with([](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }) &&
          !begins_with([](char c) { return c >= '0' && c <= '9'; }));
}

std::string Notes::mark(const std::string& text) {
  auto found = std::find(texts_.begin(), texts_.end(), text);
  if (found == texts_.end()) found = texts_.insert(texts_.end(), text);
  return "[" + std::to_string(found - texts_.begin() + 1) + "]";
}

std::vector<std::string> Notes::marked() const {
  std::vector<std::string> result;
  for (std::size_t index = 0; index < texts_.size(); ++index) {
    result.push_back("[" + std::to_string(index + 1) + "] " + texts_[index]);
  }
  return result;
}

std::string without_marks(const std::string& cell) {
  static const std::regex marks("( \\[[0-9]+\\])+$");
  return std::regex_replace(cell, marks, "");
}

}  // namespace hullbench::table
