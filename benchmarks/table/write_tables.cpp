#include <sstream>
#include <stdexcept>

#include "benchmarks/base/files.hpp"
#include "benchmarks/record/stored_run.hpp"
#include "benchmarks/table/writers.hpp"

namespace hullbench::table {

void write_tables(const fs::path& folder, const std::vector<Document>& documents) {
  const fs::path tables = folder / record::kTablesFolder;
  std::error_code error;
  fs::remove_all(tables, error);
  fs::create_directory(tables, error);
  if (error) throw std::runtime_error("cannot write " + tables.string() + ": " + error.message());
  std::ostringstream markdown;
  print_markdown(documents, markdown);
  for (const Document& document : documents) {
    for (const Table& table : document.tables) {
      write_text_file(tables / (table.id + ".csv"), to_csv(table));
      write_text_file(tables / (table.id + ".tex"), to_latex(table));
    }
  }
  write_text_file(tables / "tables.json", to_json(documents));
  write_text_file(folder / record::kTablesFile, markdown.str());
}

}  // namespace hullbench::table
