#include <algorithm>
#include <sstream>

#include "benchmarks/table/writers.hpp"

namespace hullbench::table {
namespace {

constexpr std::size_t kLineWidth = 118;

/// `text` as it may stand in a cell: neither a bar nor a line break ends it.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '|') result += '\\';
    result += c == '\n' || c == '\r' ? ' ' : c;
  }
  return result;
}

}  // namespace

std::size_t display_width(std::string_view text) {
  // Every byte but the continuation bytes 10xxxxxx begins a character.
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::vector<std::vector<std::string>> shown(const Table& table) {
  std::vector<std::vector<std::string>> rows(1);
  for (const Column& column : table.columns) rows.front().push_back(column.title);
  for (const auto& cells : table.rows) {
    std::vector<std::string>& row = rows.emplace_back();
    for (const Cell& cell : cells) {
      std::string& text = row.emplace_back(cell.text());
      const std::string marks = cell.marks();
      if (!text.empty() && !marks.empty()) text += ' ';
      text += marks;
    }
  }
  return rows;
}

void print_markdown(const Table& table, std::ostream& out) {
  std::vector<std::vector<std::string>> rows = shown(table);
  std::vector<std::size_t> widths(table.columns.size(), 3);
  for (auto& row : rows) {
    for (std::size_t column = 0; column < row.size(); ++column) {
      row[column] = escaped(row[column]);
      widths[column] = std::max(widths[column], display_width(row[column]));
    }
  }
  const auto is_left = [&](std::size_t column) { return table.columns[column].kind == Kind::kWords; };
  for (std::size_t row = 0; row < rows.size(); ++row) {
    for (std::size_t column = 0; column < widths.size(); ++column) {
      const std::string& cell = rows[row][column];
      const std::string padding(widths[column] - display_width(cell), ' ');
      out << "| " << (is_left(column) ? cell + padding : padding + cell) << ' ';
    }
    out << "|\n";
    if (row != 0) continue;
    for (std::size_t column = 0; column < widths.size(); ++column) {
      out << '|' << std::string(widths[column] + 1, '-') << (is_left(column) ? '-' : ':');
    }
    out << "|\n";
  }
}

void print_markdown(const Document& document, std::ostream& out) {
  out << "## " << document.title << "\n\n";
  for (const Table& table : document.tables) {
    out << "### " << table.caption << "\n\n";
    print_markdown(table, out);
    out << '\n';
    for (const std::string& remark : table.remarks) print_item(remark, out);
    if (!table.remarks.empty()) out << '\n';
  }
  if (document.notes.empty() && document.common_notes.empty()) return;
  out << "### Notes\n\n";
  for (const std::string& note : document.notes) print_item(note, out);
  for (const std::string& note : document.common_notes) print_item(note, out);
}

void print_markdown(const std::vector<Document>& documents, std::ostream& out) {
  for (const Document& document : documents) {
    print_markdown(document, out);
    const bool ends_with_notes = !document.notes.empty() || !document.common_notes.empty();
    if (ends_with_notes && &document != &documents.back()) out << '\n';
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

}  // namespace hullbench::table
