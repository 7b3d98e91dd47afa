// What the tables of a report share: what a line is, what a cell says, and how failures are explained.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "benchmarks/report/claims.hpp"
#include "benchmarks/report/measurements.hpp"
#include "benchmarks/table/table.hpp"

namespace hullbench::report {

/// A report while its tables are printed.
struct TableContext {
  const json& report;
  Measurements measurements;
  table::Notes notes;
};

/// One shape: the cases of one data set, with or without holes, that differ in n only.
using Shape = std::vector<Case>;

/// `cases`, which stand in the order of Measurements::cases, by shape.
std::vector<Shape> shapes(const std::vector<Case>& cases);

/// The lines that have a run of `shape`: in the order of the report's methods, then of the protocols.
std::vector<Line> lines_of(const TableContext& context, const Shape& shape);

std::string label(const TableContext& context, const Line& line);
std::string shape_title(const TableContext& context, const Case& which);
table::Number milliseconds(double nanoseconds);
/// The median in milliseconds; nothing of no times.
table::Cell median_cell(const std::vector<std::int64_t>& nanoseconds);

std::vector<std::int64_t> all_times(const Runs& runs, Boundary boundary);
std::vector<std::int64_t> all_step_times(const Runs& runs, const PaperStep& step);

/// How it is called in a cell: its status, or "invalid".
std::string failure_name(const record::RunRecord& run);
/// The notes that explain a line's failures on a shape, one a kind of failure.
std::vector<std::size_t> failure_notes(TableContext& context, const Line& line, const Shape& shape);

enum class Quantity { kEqualWork, kPaperBoundary, kError };

/// How many repetitions most rows with times have; 0 without times.
std::size_t usual_repetitions(const Measurements& measurements);

/// The line's label, with its number of repetitions on `cases` where that is not the usual one:
/// "Turf concave (paper), 3 repetitions".
std::string row_label(const TableContext& context, const Line& line, const std::vector<Case>& cases);

/// Behind an error: the result is worse than the convex hull of the points. Empty when it is not.
std::string hull_sign(const Runs& runs);
/// Adds to `table` what the sign means, if a cell has it.
void explain_hull_sign(table::Table& table);

/// The metric and the words of the errors in tables of many shapes: of the result's area in the paper's own
/// experiments, as the paper divides them, else of the ground truth's.
struct ErrorKind {
  const char* metric;
  const char* area;  ///< "of the result's area"
};
ErrorKind error_kind(const TableContext& context);

/// What the cell of one line and case says.
table::Cell cell(const Runs& runs, Quantity quantity);

/// Of a row's cells, the label first: "not installed", said once instead of in every column.
void say_not_installed(std::vector<table::Cell>& cells);
/// The same where every column says it.
void say_not_installed_once(std::vector<table::Cell>& cells);

/// A line's cells.
std::vector<table::Cell> row(TableContext& context, const Line& line, const Shape& shape, Quantity quantity);

}  // namespace hullbench::report
