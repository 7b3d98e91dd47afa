// Every metric, once: what rows of records, `hullbench metrics`, METRICS.md and the schemas are made from or
// checked against.
#pragma once

#include <cstdint>
#include <ostream>
#include <span>
#include <string>
#include <variant>

#include "benchmarks/base/names.hpp"
#include "benchmarks/metrics/metrics.hpp"

namespace hullbench::metrics {

/// Which values are better. kOne: the nearer to 1; kZero: the nearer to 0 from either side; kNone: it tells
/// something of the case, or of where another metric was taken.
enum class Better { kLower, kHigher, kZero, kOne, kNone };

/// "lower", "higher", "zero", "one", "none".
std::string to_string(Better better);

/// A metric's value; std::monostate where it is not defined.
using MetricValue = std::variant<std::monostate, bool, std::int64_t, double, std::string>;

/// One metric. All texts are one line.
struct MetricInfo {
  std::string name;  ///< in records: snake_case
  std::string
      group;  ///< "validity", "area", "boundary", "topology", "contract", "size", "skill", "no truth", "case"
  std::string unit;  ///< "ratio", "length", "length^2", "count", "bytes", "yes/no", "text"
  Better better = Better::kNone;
  std::string definition;  ///< R: result, T: ground truth, h: nominal spacing
  std::string undefined;   ///< when it is null; empty: never
  std::string citation;    ///< where it comes from; empty: this project's own, or plain counting
  std::string function;    ///< what computes it, in the file of benchmarks/metrics that is named
  MetricValue (*value)(const Metrics& metrics) = nullptr;
};

/// All metrics, in the order in which they are shown.
std::span<const MetricInfo> metric_table();

/// The member `metrics` of a row: every metric by name, null where it is not defined.
json metrics_to_json(const Metrics& metrics);

/// The table without the values: an array of objects with the members of MetricInfo as texts.
json metric_table_to_json();

/// The same for people.
void print_metric_table(std::ostream& out);

/// The same in Markdown, as METRICS.md has it between its marks.
std::string metric_table_to_markdown();

}  // namespace hullbench::metrics
