// Mean, deviation and maximum over a group of shapes: what the paper's tables of many shapes consist of.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/table_context.hpp"

namespace hullbench {

/// Of one value a shape.
struct Spread {
  double mean = 0;
  std::optional<double> deviation;  ///< with n - 1; empty for a single shape
  double maximum = 0;
};

/// A line's values over a group of cases, of the cases on which it succeeded. Of several runs of a case the
/// median counts.
struct GroupValues {
  std::size_t measured = 0;          ///< cases with a result that is believed
  std::size_t invalid = 0;           ///< cases whose result is not a valid multipolygon
  std::optional<Spread> error;       ///< fractions of the result's area, as the paper divides it
  std::optional<Spread> time;        ///< milliseconds, as the paper took it
  std::optional<Spread> equal_work;  ///< milliseconds
};

GroupValues group_values(const TableContext& context, const Line& line, const std::vector<Case>& cases);

/// Mean, standard deviation and maximum as three cells; percent with one digit after the point.
std::vector<std::string> percent_cells(const std::optional<Spread>& fractions);
/// The same of milliseconds, with three digits.
std::vector<std::string> millisecond_cells(const std::optional<Spread>& milliseconds);

}  // namespace hullbench
