// What is printed of a run: tables with captions, and notes; as Markdown, CSV and LaTeX.
#pragma once

#include <filesystem>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "benchmarks/table/text_table.hpp"

namespace hullbench::table {

/// One table of a document.
struct TableSection {
  std::string id;  ///< what its files are called: small letters, digits, '_' and '-'; unique in a document
  std::string caption;  ///< without a full stop
  TextTable table;
  std::vector<std::string> remarks;  ///< sentences that belong to this table alone
};

/// The tables of one run, or what stands before or behind several.
struct Document {
  std::string title;
  std::vector<TableSection> tables;
  std::vector<std::string>
      notes;  ///< of its tables: what the marks in them stand for, and what else is special here
  std::vector<std::string> common_notes;  ///< how to read any table, and where the numbers were taken
};

/// The table as Markdown whose columns line up in a terminal. A bar in a cell is escaped.
void print_markdown(const TextTable& table, std::ostream& out);

/// Everything, as Markdown that reads as well in a terminal.
void print_markdown(const Document& document, std::ostream& out);

/// Several, one after the other.
void print_markdown(const std::vector<Document>& documents, std::ostream& out);

/// Prints `text` as a Markdown list item, broken between words so that no line is longer than 118 columns.
void print_item(std::string_view text, std::ostream& out);

/// The table as comma-separated values (RFC 4180, UTF-8, lines end in a line feed). A column whose cells hold
/// a value and its spread ("1.36 ±0.01") or two values ("3.87 (3.99)") becomes two: the second one's header
/// ends in "±" or in "in brackets". A cell of another form (a failure's name, a dash) stands in the first.
/// Marks of notes are left out, here and in LaTeX: the notes stand in the Markdown only. So is kSign here.
std::string to_csv(const TextTable& table);

/// The table as a LaTeX table with rules of the package booktabs; nothing else is needed but UTF-8 input.
std::string to_latex(const TableSection& section);

/// Writes `folder`/tables.md with `documents` one after another, and of every table `folder`/tables/<id>.csv
/// and .tex; what an earlier call left there is removed. Throws std::runtime_error naming the file when one
/// cannot be written.
void write_tables(const std::filesystem::path& folder, const std::vector<Document>& documents);

}  // namespace hullbench::table
