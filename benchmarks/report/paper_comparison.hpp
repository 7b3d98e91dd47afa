// What differs from the paper, and why.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "benchmarks/table/table.hpp"

namespace hullbench::report {

/// One published value beside the same of a run.
struct Comparison {
  std::string where;     ///< in the paper: "Table IV"
  std::string row;       ///< of that table: "high (from 0.75)"; empty where a method has one row
  std::string method;    ///< identifier
  std::string quantity;  ///< "error" (percent of the result's area, mean), "time" (ms) or a step's name (ms)
  double published = 0;
  std::optional<double> measured;  ///< none: the method did not run here, or failed

  /// measured / published; 0 when nothing was measured.
  double ratio() const { return measured.value_or(0) / published; }
  /// Whether the ratio or its inverse reaches `differences.large_from` of results/paper.json, or nothing was
  /// measured.
  bool is_large() const;
};

/// The values of the paper's tables on cases like those of `report`, of the methods in its plan.
std::vector<Comparison> compare_with_paper(const json& report);

/// Why such a difference is there: the first of the reasons in results/paper.json that applies; none when
/// there is none.
std::optional<std::string> reason_of(const Comparison& comparison);

/// All comparisons of `reports`: value, paper, here, ratio, and of every large difference the
/// reason, or that none is known. Without rows when the reports share nothing with the paper's tables.
table::Table differences_table(const std::vector<json>& reports);

}  // namespace hullbench::report
