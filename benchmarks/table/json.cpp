#include <cmath>

#include "benchmarks/base/files.hpp"
#include "benchmarks/base/names.hpp"
#include "benchmarks/base/number_format.hpp"
#include "benchmarks/base/words.hpp"
#include "benchmarks/table/writers.hpp"

// Written by hand: a row stands on a line, and a number has the digits that the table shows of it.
namespace hullbench::table {
namespace {

std::string dump(const json& value) {
  return dump_text(value, -1);
}

std::string cell_text(const Cell& cell) {
  std::string text = "{\"text\":" + dump(cell.text());
  const auto add = [&](const char* name, const std::optional<Number>& number) {
    if (!number) return;
    text += std::string(",\"") + name +
            "\":" + (std::isfinite(number->value) ? fixed(number->value, number->decimals) : "null");
  };
  add("value", cell.value);
  add("spread", cell.spread);
  add("other", cell.other);
  add("of", cell.of);
  if (cell.range) {
    add("low", cell.range->low);
    add("high", cell.range->high);
  }
  if (!cell.notes.empty()) text += ",\"notes\":" + dump(cell.notes);
  return text + "}";
}

std::string column_text(const Column& column) {
  json entry = {{"title", column.title}, {"kind", column.kind == Kind::kWords ? "words" : "number"}};
  if (!column.unit.empty()) entry["unit"] = column.unit;
  return dump(entry);
}

/// "[a,b]"
template <typename Entries, typename Text>
std::string list_text(const Entries& entries, const Text& text_of, const std::string& between = ",") {
  return "[" + joined(entries, between, text_of) + "]";
}

std::string table_text(const Table& table) {
  const auto row_text = [](const std::vector<Cell>& row) { return list_text(row, cell_text); };
  return "{\"id\": " + dump(table.id) + ", \"caption\": " + dump(table.caption) +
         ",\n  \"columns\": " + list_text(table.columns, column_text) +
         ",\n  \"rows\": " + list_text(table.rows, row_text, ",\n    ") +
         ",\n  \"remarks\": " + dump(table.remarks) + "}";
}

std::string document_text(const Document& document) {
  std::vector<std::string> notes = document.notes;
  notes.insert(notes.end(), document.common_notes.begin(), document.common_notes.end());
  return "{\"title\": " + dump(document.title) +
         ", \"tables\": " + list_text(document.tables, table_text, ",\n ") + ",\n \"notes\": " + dump(notes) +
         "}";
}

}  // namespace

std::string to_json(const std::vector<Document>& documents) {
  return R"({"kind": "tables", "schema_version": 1, "documents": )" +
         list_text(documents, document_text, ",\n") + "}\n";
}

}  // namespace hullbench::table
