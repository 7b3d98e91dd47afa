#include "benchmarks/labels.hpp"

namespace hullbench {
namespace {

using nlohmann::json;

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

std::string method_title(const json& report, const std::string& method) {
  return title_of(report.at("methods"), method);
}

std::string method_label(const json& report, const std::string& method, const std::string& protocol) {
  return method_title(report, method) + " (" + protocol + ")";
}

std::string shape_title(const json& report, const std::string& dataset, bool holes) {
  return title_of(report.at("datasets"), dataset) + (holes ? " with holes" : "");
}

std::string not_installed_text(const json& report, const std::string& what, const std::string& method,
                               const std::string& detail) {
  const std::string remedy = remedy_of(report, method);
  std::string text = what + " is not installed: " + sentence(detail);
  if (remedy.empty() || detail.find(remedy) != std::string::npos) return text;
  return text + " To install it: " + remedy;
}

std::string sentence(std::string text) {
  if (!text.empty() && text.back() != '.') text += '.';
  return text;
}

}  // namespace hullbench
