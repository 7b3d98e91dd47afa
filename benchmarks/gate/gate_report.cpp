#include "benchmarks/gate/gate_report.hpp"

#include <algorithm>

#include "benchmarks/base/number_format.hpp"
#include "benchmarks/table/writers.hpp"

namespace hullbench::gate {
namespace {

const char* word_of(SpeedChange change) {
  switch (change) {
    case SpeedChange::kSlower:
      return "slower";
    case SpeedChange::kFaster:
      return "faster";
    case SpeedChange::kUndecided:
      return "too noisy";
    case SpeedChange::kNone:
      break;
  }
  return "-";
}

/// "+3.21" of 1.0321.
table::Number percent(double ratio) {
  return {(ratio - 1) * 100, 2, true};
}

const Judged* find(const std::vector<Judged>& rows, const std::string& name) {
  const auto found = std::ranges::find_if(rows, [&](const Judged& row) { return row.name == name; });
  return found == rows.end() ? nullptr : &*found;
}

void print_times(const GateFindings& findings, std::ostream& out) {
  table::Table table{
      "times",
      "Change of time",
      {table::words("quantity"), table::with_unit("head / base", "%"), table::with_unit("95 % interval", "%"),
       table::words("verdict"), table::with_unit("measured again", "%"), table::words("confirmed"),
       table::with_unit("base / base", "%")}};
  for (const Judged& row : findings.first) {
    const Judged* again = find(findings.second, row.name);
    const Judged* control = find(findings.null_control, row.name);
    table.add_row({row.name, percent(row.ratio),
                   table::Range{percent(row.interval.low), percent(row.interval.high)}, word_of(row.change),
                   again == nullptr ? table::Cell("") : percent(again->ratio),
                   again == nullptr              ? ""
                   : again->change == row.change ? "yes"
                                                 : "no",
                   control == nullptr ? table::Cell("") : percent(control->ratio)});
  }
  table::print_markdown(table, out);
}

void print_counts(const GateFindings& findings, std::ostream& out) {
  table::Table table{"counts",
                     "Change of instructions",
                     {table::words("quantity"), table::with_unit("head / base", "%"), table::words("verdict"),
                      table::with_unit("base / base", "%")}};
  for (std::size_t i = 0; i < findings.first.size(); ++i) {
    const Judged& row = findings.first[i];
    table.add_row(
        {row.name, percent(row.ratio), word_of(row.change), percent(findings.null_control[i].ratio)});
  }
  table::print_markdown(table, out);
}

void print_list(const char* title, const std::vector<std::string>& names, std::ostream& out) {
  for (const std::string& name : names) out << title << ": " << name << "\n";
}

void print_accuracy(const std::vector<AccuracyRow>& rows, std::ostream& out) {
  const bool all_same = std::ranges::all_of(rows, [](const AccuracyRow& row) { return row.same; });
  if (all_same) {
    out << "results: the same bytes in all " << rows.size() << " cases\n";
    return;
  }
  for (const AccuracyRow& row : rows) {
    if (row.same) continue;
    out << "result of " << row.name << ": ";
    if (row.reason.empty()) {
      out << "symmetric difference " << json(row.difference).dump() << " of base's area\n";
    } else {
      out << row.reason << "\n";
    }
  }
}

json json_of(const std::vector<Judged>& rows) {
  json list = json::array();
  for (const Judged& row : rows) {
    list.push_back({{"quantity", row.name},
                    {"ratio", row.ratio},
                    {"interval", {row.interval.low, row.interval.high}},
                    {"p_holm", row.p},
                    {"change", word_of(row.change)}});
  }
  return list;
}

json json_of(const std::vector<AccuracyRow>& rows) {
  json list = json::array();
  for (const AccuracyRow& row : rows) {
    list.push_back(
        {{"case", row.name}, {"same", row.same}, {"difference", row.difference}, {"reason", row.reason}});
  }
  return list;
}

}  // namespace

void print_gate(const GateFindings& findings, const GateVerdict& verdict, const GateContext& context,
                std::ostream& out) {
  out << "base: " << context.base << "\nhead: " << context.head << "\n\n";
  if (context.tier == "time") {
    print_times(findings, out);
  } else {
    print_counts(findings, out);
  }
  out << "\n";
  print_accuracy(findings.accuracy, out);
  print_list("improvement", verdict.improvements, out);
  print_list("not confirmed", verdict.unconfirmed, out);
  out << "gate (" << context.tier << ", " << fixed(context.seconds, 0) << " s): " << verdict.sentence << "\n";
}

json gate_json(const GateFindings& findings, const GateVerdict& verdict, const GateRules& rules,
               const GateContext& context) {
  return {{"schema_version", 1},
          {"tier", context.tier},
          {"base", context.base},
          {"head", context.head},
          {"rules",
           {{"threshold", rules.threshold},
            {"confidence", rules.confidence},
            {"accuracy_tolerance", rules.accuracy_tolerance},
            {"null_tolerance", rules.null_tolerance}}},
          {"seconds", context.seconds},
          {"exit_code", verdict.exit_code},
          {"verdict", verdict.sentence},
          {"regressions", verdict.regressions},
          {"improvements", verdict.improvements},
          {"unconfirmed", verdict.unconfirmed},
          {"undecided", verdict.undecided},
          {"failed_controls", verdict.failed_controls},
          {"changed_results", verdict.changed_results},
          {"first", json_of(findings.first)},
          {"second", json_of(findings.second)},
          {"null_control", json_of(findings.null_control)},
          {"accuracy", json_of(findings.accuracy)},
          {"samples", context.samples}};
}

}  // namespace hullbench::gate
