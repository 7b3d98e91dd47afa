#include <set>
#include <string_view>

#include "benchmarks/metrics/metric_table.hpp"

namespace hullbench::metrics {
namespace {

json to_json(const MetricValue& value) {
  json result;
  std::visit(
      [&result](const auto& held) {
        if constexpr (!std::is_same_v<std::decay_t<decltype(held)>, std::monostate>) result = held;
      },
      value);
  return result;
}

std::string direction_text(Better better) {
  switch (better) {
    case Better::kLower:
      return "lower is better";
    case Better::kHigher:
      return "higher is better";
    case Better::kZero:
      return "nearer to 0 is better";
    case Better::kOne:
      return "nearer to 1 is better";
    case Better::kNone:
      return "no better or worse";
  }
  return {};
}

/// `text` where a cell of a Markdown table can hold it.
std::string cell(std::string text) {
  for (std::size_t at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2)) {
    text.insert(at, "\\");
  }
  return text;
}

std::string definition_text(const MetricInfo& metric) {
  std::string text = metric.definition;
  if (!metric.undefined.empty()) text += "; null " + metric.undefined;
  return text;
}

/// Whether `describe` gives the metric.
bool known_without_truth(const MetricInfo& metric) {
  static const std::set<std::string> names = {"area", "ground_truth_area", "ground_truth_convexity"};
  static const std::set<std::string> groups = {"validity", "contract", "size", "no truth"};
  return names.contains(metric.name) || groups.contains(metric.group);
}

}  // namespace

std::string to_string(Better better) {
  switch (better) {
    case Better::kLower:
      return "lower";
    case Better::kHigher:
      return "higher";
    case Better::kZero:
      return "zero";
    case Better::kOne:
      return "one";
    case Better::kNone:
      return "none";
  }
  return {};
}

json metrics_to_json(const Metrics& metrics) {
  json result = json::object();
  for (const MetricInfo& metric : metric_table()) {
    const bool known = metrics.has_truth || known_without_truth(metric);
    result[metric.name] = known ? to_json(metric.value(metrics)) : json(nullptr);
  }
  return result;
}

json metric_table_to_json() {
  json result = json::array();
  for (const MetricInfo& metric : metric_table()) {
    result.push_back({{"name", metric.name},
                      {"group", metric.group},
                      {"unit", metric.unit},
                      {"better", to_string(metric.better)},
                      {"definition", metric.definition},
                      {"undefined", metric.undefined},
                      {"citation", metric.citation},
                      {"function", metric.function}});
  }
  return result;
}

void print_metric_table(std::ostream& out) {
  std::string_view group;
  for (const MetricInfo& metric : metric_table()) {
    if (metric.group != group) out << metric.group << "\n";
    group = metric.group;
    out << "  " << metric.name << "  " << metric.unit << ", " << direction_text(metric.better) << "\n"
        << "      " << definition_text(metric) << "\n";
    if (!metric.citation.empty()) out << "      " << metric.citation << "\n";
  }
}

std::string metric_table_to_markdown() {
  std::string text;
  std::string_view group;
  for (const MetricInfo& metric : metric_table()) {
    if (metric.group != group) {
      text += (group.empty() ? "### " : "\n### ") + metric.group +
              "\n\n| Metric | Unit | Better | Definition | Source | Function |\n|---|---|---|---|---|---|\n";
    }
    group = metric.group;
    text += "| `" + metric.name + "` | " + metric.unit + " | " + to_string(metric.better) + " | " +
            cell(definition_text(metric)) + " | " + cell(metric.citation) + " | `" + metric.function +
            "` |\n";
  }
  return text;
}

}  // namespace hullbench::metrics
