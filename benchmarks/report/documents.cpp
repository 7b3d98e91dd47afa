#include "benchmarks/report/documents.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "benchmarks/report/overview_tables.hpp"
#include "benchmarks/report/paper_comparison.hpp"
#include "benchmarks/report/tables.hpp"

namespace hullbench::report {
namespace {

/// Leaves out the steps of a report that has other cases too, when a report of the steps alone is there.
void drop_repeated_steps(std::vector<table::Document>& documents) {
  const std::string steps = std::string("_") + kStepsTable;
  const auto is_steps = [&](const table::Table& table) { return table.id.ends_with(steps); };
  const bool alone = std::ranges::any_of(documents, [&](const table::Document& document) {
    return !document.tables.empty() && is_steps(document.tables.front());
  });
  if (!alone) return;
  for (table::Document& document : documents) {
    if (!document.tables.empty() && !is_steps(document.tables.front()))
      std::erase_if(document.tables, is_steps);
  }
}

/// Takes the common notes out of `documents`: each text once, in the order in which they first occur.
std::vector<std::string> take_common_notes(std::vector<table::Document>& documents) {
  std::vector<std::string> result;
  std::set<std::string> seen;
  for (table::Document& document : documents) {
    for (std::string& note : document.common_notes) {
      if (seen.insert(note).second) result.push_back(std::move(note));
    }
    document.common_notes.clear();
  }
  return result;
}

}  // namespace

std::vector<table::Document> make_documents(const std::vector<json>& reports) {
  std::vector<table::Document> documents;
  documents.reserve(reports.size() + 2);
  for (const json& report : reports) documents.push_back(make_document(report));
  drop_repeated_steps(documents);
  table::Document end = {"Beside the paper", {differences_table(reports)}};
  if (end.tables.front().rows.empty()) end = table::Document{"All runs"};
  end.common_notes = take_common_notes(documents);
  documents.push_back(std::move(end));
  documents.insert(documents.begin(), table::Document{"Methods and parameters",
                                                      {methods_table(reports), parameters_table(reports)}});
  return documents;
}

}  // namespace hullbench::report
