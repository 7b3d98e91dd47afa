// The tables of an experiment on many shapes, each at one size: the paper's floors, letters and random
// polygons.
#pragma once

#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "benchmarks/report/table_context.hpp"
#include "benchmarks/table/table.hpp"

namespace hullbench::report {

/// Cases that stand in one row of a table, and what the paper published of them.
struct CaseGroup {
  std::string title;
  std::vector<Case> cases;
  /// In results/paper.json: by method, or of one method alone; null when there is nothing.
  json published;
};

/// Whether each of `shapes` is measured at a single size and they are ten or more, or some are of a
/// collection that the paper has a table of: then they are the rows of one table instead of having tables of
/// their own.
bool is_collection(const std::vector<Shape>& shapes);

/// Mean, standard deviation (n - 1) and maximum over the shapes of error and time, a line a method, with the
/// paper's values where it has any of these shapes. Up to 60 shapes: one group, and the error of every shape,
/// a column a method; where the paper has values of some of them only, the others have tables of their own.
/// More: groups by the convexity of the ground truth, in the paper's classes, and by family. The statistics
/// of all methods are of the cases that all solved (group_values.hpp).
std::vector<table::Table> collection_tables(TableContext& context, const std::vector<Shape>& shapes);

/// The groups that the paper has values of, for comparisons. Empty when it has none.
std::vector<CaseGroup> published_groups(const TableContext& context, const std::vector<Shape>& shapes);

/// What the paper published of `method` in a group: {"l2_percent": [mean, std, max], "milliseconds": [...]},
/// or null.
json published_values(const CaseGroup& group, const Line& line);

}  // namespace hullbench::report
