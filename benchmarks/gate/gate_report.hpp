// What a gate tells: a table and a verdict for people, JSON for programs.
#pragma once

#include <ostream>
#include <string>

#include "benchmarks/base/names.hpp"
#include "benchmarks/gate/gate_verdict.hpp"

namespace hullbench::gate {

/// What was compared and how, beside the findings.
struct GateContext {
  std::string tier;  ///< "time" or "instructions"
  std::string base;  ///< what base is, in words
  std::string head;
  double seconds = 0;  ///< that measuring took
  /// Raw data: of times {"round": {"change": {QUANTITY: [log-ratio a block]}, "null_control": ...}}, of
  /// instructions {QUANTITY: [base, base again, head]}.
  json samples;
};

/// Base and head, the table of changes with the null control beside them, and whose results changed by how
/// much; then what improved, what was not confirmed, and the verdict as the last line.
void print_gate(const GateFindings& findings, const GateVerdict& verdict, const GateContext& context,
                std::ostream& out);

/// {"schema_version": 1, "tier", "base", "head", "rules", "seconds", "exit_code", "verdict", "regressions",
/// "improvements", "unconfirmed", "undecided", "failed_controls", "changed_results", "first", "second",
/// "null_control", "accuracy", "samples"}; what is infinite is null.
json gate_json(const GateFindings& findings, const GateVerdict& verdict, const GateRules& rules,
               const GateContext& context);

}  // namespace hullbench::gate
