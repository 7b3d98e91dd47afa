// Mean, deviation and maximum over a group of shapes: what the paper's tables of many shapes consist of.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "benchmarks/report/table_context.hpp"

namespace hullbench::report {

/// Of one value a shape.
struct Spread {
  double mean = 0;
  std::optional<double> deviation;  ///< with n - 1; empty for a single shape
  double maximum = 0;
};

/// A line's values over a group of cases. A mean of what happened to succeed would be better the more of the
/// hard cases fail, so the spreads of all lines are of the same cases: those that all of them solved. A line
/// that solved less than half as many as another one would leave too few; it has no spreads and does not
/// narrow those of the others. Of several runs of a case the median counts.
struct GroupValues {
  std::size_t cases = 0;             ///< that the spreads are of; 0: the line has none
  std::size_t solved = 0;            ///< cases with a result that is believed
  std::size_t failed = 0;            ///< cases without; where a method is not installed it has not failed
  std::size_t invalid = 0;           ///< of the failed ones those whose result is not a valid multipolygon
  std::optional<Spread> error;       ///< as a fraction of the area that error_kind() names
  std::optional<Spread> time;        ///< milliseconds, as the paper took it
  std::optional<Spread> equal_work;  ///< milliseconds
};

/// Of each of `lines`, in their order.
std::vector<GroupValues> group_values(const TableContext& context, const std::vector<Line>& lines,
                                      const std::vector<Case>& cases);

/// Mean, standard deviation and maximum as three cells; percent with one digit after the point.
std::vector<table::Cell> percent_cells(const std::optional<Spread>& fractions);
/// The same of milliseconds, with three digits.
std::vector<table::Cell> millisecond_cells(const std::optional<Spread>& milliseconds);

}  // namespace hullbench::report
