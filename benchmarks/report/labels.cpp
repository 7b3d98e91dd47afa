#include "benchmarks/report/labels.hpp"

#include "benchmarks/base/words.hpp"

namespace hullbench::report {
namespace {

std::string title_of(const json& list, const std::string& name) {
  for (const json& entry : list) {
    if (entry.value("name", "") == name) return entry.value("title", name);
  }
  return name;
}

std::string remedy_of(const json& report, const std::string& name) {
  for (const json& method : report.at("methods")) {
    if (method.value("name", "") == name) return method.value("remedy", "");
  }
  return "";
}

}  // namespace

std::optional<std::string> family_of(const json& report, const std::string& dataset) {
  for (const json& entry : report.at("datasets")) {
    const std::string name = entry.value("name", "");
    if (entry.value("members", 0) > 0 && dataset.starts_with(name + "-")) return name;
  }
  return std::nullopt;
}

std::string stress_title(const std::string& stress) {
  std::string title;
  for (const char c : stress) title += c == ':' ? " " : c == '~' ? ", " : std::string(1, c);
  return title;
}

std::string method_title(const json& report, const std::string& method) {
  return title_of(report.at("methods"), method);
}

std::string method_label(const json& report, const std::string& method, const std::string& protocol) {
  return method_title(report, method) + " (" + protocol + ")";
}

std::string method_label(const std::vector<json>& reports, const std::string& method,
                         const std::string& protocol) {
  for (const json& report : reports) {
    if (report.contains("methods") && method_title(report, method) != method)
      return method_label(report, method, protocol);
  }
  return method + " (" + protocol + ")";
}

std::string family_title(const json& report, const std::string& dataset) {
  const std::string shape = dataset.substr(0, dataset.find('~'));
  return title_of(report.at("datasets"), family_of(report, shape).value_or(shape));
}

std::string shape_title(const json& report, const std::string& dataset_name, bool holes) {
  const std::size_t mark = dataset_name.find('~');
  const std::string dataset = dataset_name.substr(0, mark);
  const auto family = family_of(report, dataset);
  const std::string number = family ? " " + dataset.substr(family->size() + 1) : "";
  return family_title(report, dataset) + number + (holes ? " with holes" : "") +
         (mark == std::string::npos ? "" : ", " + stress_title(dataset_name.substr(mark + 1)));
}

std::string not_installed_text(const json& report, const std::string& what, const std::string& method,
                               const std::string& detail) {
  const std::string remedy = remedy_of(report, method);
  std::string text = what + " is not installed: " + sentence(detail);
  if (remedy.empty() || detail.find(remedy) != std::string::npos) return text;
  return text + " To install it: " + remedy;
}

}  // namespace hullbench::report
