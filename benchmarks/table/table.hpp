// Tables of values, with captions and notes. writers.hpp writes them.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/table/cell.hpp"

namespace hullbench::table {

/// What a column holds.
enum class Kind {
  kWords,  ///< set to the left
  kNumber  ///< values, and the words that stand where there is none; set to the right
};

/// One of numbers, unless `words` made it.
struct Column {
  Column(std::string of_title, std::string of_unit = {})
      : title(std::move(of_title)), unit(std::move(of_unit)) {}
  Column(const char* of_title, std::string of_unit = {}) : title(of_title), unit(std::move(of_unit)) {}

  std::string title;
  std::string unit;  ///< of its values; the title or the table's caption says it too
  Kind kind = Kind::kNumber;
};

inline Column words(std::string title) {
  Column column(std::move(title));
  column.kind = Kind::kWords;
  return column;
}

/// "Time, ms": the title says the unit.
inline Column with_unit(const std::string& title, const std::string& unit) {
  return {title + ", " + unit, unit};
}

struct Table {
  /// Throws std::invalid_argument when `cells` has not one cell a column.
  void add_row(std::vector<Cell> cells) {
    if (cells.size() != columns.size()) throw std::invalid_argument("A row has not one cell a column.");
    rows.push_back(std::move(cells));
  }

  std::string id;  ///< what its files are called: small letters, digits, '_' and '-'; unique in a document
  std::string caption;  ///< without a full stop
  std::vector<Column> columns;
  std::vector<std::vector<Cell>> rows = {};  ///< by row, then column
  std::vector<std::string> remarks = {};     ///< sentences that belong to this table alone
};

/// The tables of one run, or what stands before or behind several.
struct Document {
  std::string title;
  std::vector<Table> tables = {};
  std::vector<std::string> notes =
      {};  ///< of its tables: what the marks in them stand for, and what else is special here
  std::vector<std::string> common_notes = {};  ///< how to read any table, and where the numbers were taken
};

}  // namespace hullbench::table
