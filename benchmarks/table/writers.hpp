// The same tables as Markdown, CSV, LaTeX and JSON.
#pragma once

#include <cstddef>
#include <filesystem>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "benchmarks/table/table.hpp"

namespace hullbench::table {

/// What each cell shows, with the marks of its notes, by row, then column; the first row is of the titles.
std::vector<std::vector<std::string>> shown(const Table& table);

/// The rows as Markdown whose columns line up in a terminal. A bar is escaped; a line break becomes a blank.
void print_markdown(const Table& table, std::ostream& out);

/// Everything, as Markdown that reads as well in a terminal.
void print_markdown(const Document& document, std::ostream& out);

/// Several, one after the other.
void print_markdown(const std::vector<Document>& documents, std::ostream& out);

/// Prints `text` as a Markdown list item, broken between words so that no line is longer than 118 columns.
void print_item(std::string_view text, std::ostream& out);

/// Number of columns that `text` (UTF-8 without wide or combining characters) takes in a terminal.
std::size_t display_width(std::string_view text);

/// A field of a CSV file: in quotes where it needs them.
std::string csv_text(const std::string& text);

/// The table as comma-separated values (RFC 4180, UTF-8, lines end in a line feed). A column in which a value
/// has something beside it becomes several: its spread (the title ends in " ±"), the value by another
/// definition (" in brackets"), the ends of the range that it lies in (" from", " to"). Words stand in the
/// first one. Marks of notes are left out, here and in LaTeX, where a cell has anything else: the notes stand
/// in the Markdown only. So are signs behind a value, here.
std::string to_csv(const Table& table);

/// The table as a LaTeX table with rules of the package booktabs; nothing else is needed but UTF-8 input.
std::string to_latex(const Table& table);

/// All tables with their notes as JSON (results/tables.schema.json), a line a row.
std::string to_json(const std::vector<Document>& documents);

/// Writes `folder`/tables.md with `documents` one after another, `folder`/tables/tables.json, and of every
/// table `folder`/tables/<id>.csv and .tex; what an earlier call left there is removed. Throws
/// std::runtime_error naming the file when one cannot be written.
void write_tables(const std::filesystem::path& folder, const std::vector<Document>& documents);

}  // namespace hullbench::table
