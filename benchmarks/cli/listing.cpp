#include "benchmarks/cli/listing.hpp"

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "benchmarks/worker/method_session.hpp"
#include "datasets/real/real_points.hpp"
#include "datasets/stress.hpp"

namespace hullbench::cli {
namespace {

json list_methods(const std::vector<worker::Method>& methods, const worker::WorkerLimits& limits) {
  std::vector<std::unique_ptr<worker::MethodSession>> sessions;
  for (const worker::Method& method : methods) {
    sessions.push_back(std::make_unique<worker::MethodSession>(method, limits));
    sessions.back()->begin_start();
  }
  json described = json::array();
  for (const auto& session : sessions) {
    session->finish_start();
    described.push_back(worker::describe_method(*session));
  }
  return described;
}

std::string limit_text(const json& value) {
  return value.is_null() ? "infinity" : value.dump();
}

std::string parameter_text(const json& parameter) {
  std::string text = parameter["name"].get<std::string>() + " (" + parameter["unit"].get<std::string>() +
                     ", " + limit_text(parameter["minimum"]) + " to " + limit_text(parameter["maximum"]);
  text += parameter.contains("default") ? ", default " + limit_text(parameter["default"]) : ", required";
  return text + "): " + parameter["description"].get<std::string>();
}

void print_method(const json& method, std::ostream& out) {
  out << "  " << method["name"].get<std::string>() << "  " << method["title"].get<std::string>();
  if (const auto version = method["version"].get<std::string>(); !version.empty()) out << " " << version;
  out << "\n";
  if (!method["installed"].get<bool>()) {
    out << "      not installed: " << method["detail"].get<std::string>() << "\n";
    if (const auto remedy = method["remedy"].get<std::string>(); !remedy.empty())
      out << "      remedy: " << remedy << "\n";
    return;
  }
  const json& capabilities = method["capabilities"];
  out << "      result: "
      << (capabilities["several_polygons"].get<bool>() ? "several polygons" : "one polygon")
      << (capabilities["holes"].get<bool>() ? " with holes" : " without holes") << "; the library gives "
      << method["native_output"].get<std::string>() << "\n";
  for (const json& parameter : method["parameters"]) out << "      " << parameter_text(parameter) << "\n";
  out << "      licence " << method["licence"].get<std::string>() << "; "
      << method["citation"].get<std::string>() << "\n";
}

void print_dataset(const json& dataset, std::ostream& out) {
  out << "  " << dataset["name"].get<std::string>();
  if (const auto members = dataset["members"].get<std::size_t>(); members > 0) out << "-1 ... -" << members;
  out << "  " << dataset["title"].get<std::string>();
  if (!dataset["area"].is_null()) out << ", area " << dataset["area"].get<double>();
  if (!dataset["holes_area"].is_null()) out << ", with holes " << dataset["holes_area"].get<double>();
  out << "\n      " << dataset["source"].get<std::string>() << "; licence "
      << dataset["licence"].get<std::string>() << "\n";
}

json list_stress() {
  json kinds = json::array();
  for (const StressKind& kind : stress_kinds()) {
    kinds.push_back({{"name", kind.name},
                     {"title", kind.title},
                     {"unit", kind.unit},
                     {"meaning", kind.meaning},
                     {"minimum", kind.least},
                     {"maximum", kind.most}});
  }
  return kinds;
}

void print_stress(const json& kind, std::ostream& out) {
  out << "  ~" << kind["name"].get<std::string>() << ":LEVEL  " << kind["meaning"].get<std::string>() << " ("
      << kind["minimum"].get<double>() << " to " << kind["maximum"].get<double>();
  if (const auto unit = kind["unit"].get<std::string>(); !unit.empty()) out << " " << unit;
  out << ")\n";
}

}  // namespace

json make_listing(const std::vector<worker::Method>& methods, const worker::WorkerLimits& limits) {
  return {{"methods", list_methods(methods, limits)},
          {"datasets", describe_datasets()},
          {"stress", list_stress()}};
}

void print_listing(const json& listing, std::ostream& out) {
  out << "Methods\n";
  for (const json& method : listing["methods"]) print_method(method, out);
  out << "Data sets\n";
  for (const json& dataset : listing["datasets"]) print_dataset(dataset, out);
  out << "Stress, behind the name of a data set that does not come with its points (ca~noise:0.5)\n"
         "      h: the spacing, the root of the ground truth's area over the number of points\n";
  for (const json& kind : listing["stress"]) print_stress(kind, out);
}

json describe_datasets(const DataFolders& folders, const std::vector<std::string>& names) {
  const std::vector<DatasetInfo> infos = datasets(folders);
  std::set<const DatasetInfo*> used;
  for (const std::string& name : names) used.insert(find_dataset(infos, name));
  json result = json::array();
  for (const DatasetInfo& dataset : infos) {
    if (!names.empty() && !used.contains(&dataset)) continue;
    json holes_area = nullptr;
    if (dataset.has_holes_variant && dataset.members == 0) {
      holes_area = polylidar::area(make_ground_truth(dataset.name, true, folders));
    }
    const real::Source* real_set = real::find_source(dataset.name);
    result.push_back({{"name", dataset.name},
                      {"title", dataset.title},
                      {"source", real_set ? real::describe(*real_set, folders.system) : dataset.source},
                      {"licence", dataset.licence},
                      {"sha256", dataset.sha256.empty() ? json(nullptr) : json(dataset.sha256)},
                      {"area", dataset.area ? json(*dataset.area) : json(nullptr)},
                      {"holes_area", holes_area},
                      {"members", dataset.members}});
  }
  return result;
}

}  // namespace hullbench::cli
