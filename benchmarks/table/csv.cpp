#include <algorithm>
#include <array>

#include "benchmarks/table/writers.hpp"

namespace hullbench::table {
namespace {

using Part = std::optional<Number>;

/// What may stand beside a value, each in a column of its own.
constexpr std::array<const char*, 4> kPartTitles = {" ±", " in brackets", " from", " to"};

std::array<Part, kPartTitles.size()> parts_of(const Cell& cell) {
  const bool lies_in_range = cell.value && cell.range;
  return {cell.spread, cell.other, lies_in_range ? Part(cell.range->low) : Part(),
          lies_in_range ? Part(cell.range->high) : Part()};
}

/// What stands before those parts, or a mark that stands alone.
std::string first_text(const Cell& cell) {
  Cell first = cell;
  first.spread.reset();
  first.other.reset();
  first.sign.clear();
  if (cell.value) first.range.reset();
  const std::string text = first.text();
  return text.empty() ? cell.marks() : text;
}

std::string field(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

}  // namespace

std::string to_csv(const Table& table) {
  std::vector<std::string> lines(1 + table.rows.size());
  for (std::size_t column = 0; column < table.columns.size(); ++column) {
    const auto add = [&](const std::string& title, const auto& text_of) {
      lines.front() += field(title) + ',';
      for (std::size_t row = 0; row < table.rows.size(); ++row)
        lines[row + 1] += field(text_of(table.rows[row][column])) + ',';
    };
    const std::string& title = table.columns[column].title;
    add(title, first_text);
    for (std::size_t part = 0; part < kPartTitles.size(); ++part) {
      if (std::any_of(table.rows.begin(), table.rows.end(),
                      [&](const auto& row) { return parts_of(row[column])[part].has_value(); }))
        add(title + kPartTitles[part], [&](const Cell& cell) {
          const Part number = parts_of(cell)[part];
          return number ? number->text() : std::string();
        });
    }
  }
  std::string text;
  for (std::string& line : lines) {
    line.back() = '\n';
    text += line;
  }
  return text;
}

}  // namespace hullbench::table
