#include "benchmarks/report/readme.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "benchmarks/report/documents.hpp"
#include "benchmarks/report/measurements.hpp"
#include "benchmarks/table/writers.hpp"

namespace hullbench::report {
namespace {

using nlohmann::json;

constexpr std::string_view kBegin = "<!-- results: begin -->\n";
constexpr std::string_view kEnd = "<!-- results: end -->";

/// The tables that the README shows, in its order; the others are in the run's tables.md.
constexpr std::array<std::string_view, 15> kShown = {"states_ca_holes_time",
                                                     "states_ca_holes_error",
                                                     "states_headline",
                                                     "states_ratios",
                                                     "rgbd_headline",
                                                     "rgbd_summary",
                                                     "alphabet_headline",
                                                     "alphabet_summary",
                                                     "random_convexity",
                                                     "random_convexity_others",
                                                     "steps_headline",
                                                     "steps_steps",
                                                     "differences",
                                                     "methods",
                                                     "parameters"};

const table::Table* find_table(const std::vector<table::Document>& documents, std::string_view id) {
  for (const table::Document& document : documents) {
    for (const table::Table& table : document.tables) {
      if (table.id == id) return &table;
    }
  }
  return nullptr;
}

/// The notes that belong to a value are not here; those that stand alone are the table's own.
table::Table without_notes(table::Table table) {
  for (auto& row : table.rows) {
    for (table::Cell& cell : row) {
      if (!cell.text().empty()) cell.notes.clear();
    }
  }
  return table;
}

std::size_t place_of(const std::string& text, std::string_view mark) {
  const std::size_t place = text.find(mark);
  if (place == std::string::npos || text.find(mark, place + 1) != std::string::npos) {
    throw std::runtime_error("the README must have the line " + std::string(mark.substr(0, mark.find('\n'))) +
                             " once; put it where the results are to stand");
  }
  return place;
}

}  // namespace

std::string readme_results(const std::vector<json>& reports, const std::string& folder) {
  if (reports.empty()) throw std::runtime_error("there is no run in " + folder + " yet; measure it first");
  const std::vector<table::Document> documents = make_documents(reports);
  std::size_t runs = 0;
  for (const json& report : reports) runs += report.at("runs").size();
  std::ostringstream out;
  out << "The numbers below are those of the reference run in\n[" << folder << "](" << folder
      << "), begun on " << reports.front().at("created").get<std::string>().substr(0, 10) << ": " << runs
      << " runs, " << reports.size() << (reports.size() == 1 ? " experiment" : " experiments")
      << ".\nAll of its tables are in [" << folder << "/tables.md](" << folder << "/tables.md).\n";
  for (const std::string_view id : kShown) {
    const table::Table* table = find_table(documents, id);
    if (table == nullptr) continue;
    out << "\n### " << table->caption << "\n\n";
    table::print_markdown(without_notes(*table), out);
    if (!table->remarks.empty()) out << '\n';
    for (const std::string& remark : table->remarks) table::print_item(remark, out);
  }
  out << "\n### How these numbers were taken\n\n";
  std::set<std::string> without_times;
  for (const json& report : reports) without_times.insert(Measurements(report).why_no_times());
  without_times.erase("");
  for (const std::string& note : without_times) table::print_item(note, out);
  for (const std::string& note : documents.back().common_notes) table::print_item(note, out);
  return out.str();
}

std::string with_results(const std::string& readme, const std::string& results) {
  const std::size_t begin = place_of(readme, kBegin) + kBegin.size();
  const std::size_t end = place_of(readme, kEnd);
  if (end < begin)
    throw std::runtime_error("the README's marks of the results stand in the wrong order; swap them");
  return readme.substr(0, begin) + results + readme.substr(end);
}

}  // namespace hullbench::report
