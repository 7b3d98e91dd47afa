#include <algorithm>
#include <array>

#include "benchmarks/table/writers.hpp"

namespace hullbench::table {
namespace {

/// What each of a column's fields has behind its title: there is one more for whatever its values have beside
/// them.
constexpr std::array<const char*, 5> kTitles = {"", " ±", " in brackets", " from", " to"};

std::array<std::string, kTitles.size()> fields_of(const Cell& cell) {
  const auto text_of = [](const std::optional<Number>& number) { return number ? number->text() : ""; };
  Cell first = cell;
  first.spread.reset();
  first.other.reset();
  first.sign.clear();
  std::array<std::string, kTitles.size()> fields = {"", text_of(cell.spread), text_of(cell.other)};
  if (cell.value && cell.range) {
    first.range.reset();
    fields[3] = cell.range->low.text();
    fields[4] = cell.range->high.text();
  }
  fields[0] = first.text();
  // A mark that stands alone stays.
  if (fields[0].empty()) fields[0] = cell.marks();
  return fields;
}

}  // namespace

std::string csv_text(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + '"';
}

std::string to_csv(const Table& table) {
  std::vector<std::string> lines(1 + table.rows.size());
  for (std::size_t column = 0; column < table.columns.size(); ++column) {
    std::vector<std::array<std::string, kTitles.size()>> cells;
    for (const auto& row : table.rows) cells.push_back(fields_of(row[column]));
    for (std::size_t field = 0; field < kTitles.size(); ++field) {
      if (field > 0 && std::ranges::all_of(cells, [&](const auto& one) { return one[field].empty(); }))
        continue;
      lines[0] += csv_text(table.columns[column].title + kTitles[field]) + ',';
      for (std::size_t row = 0; row < cells.size(); ++row)
        lines[row + 1] += csv_text(cells[row][field]) + ',';
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
