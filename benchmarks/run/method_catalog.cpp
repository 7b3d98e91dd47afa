#include "benchmarks/run/method_catalog.hpp"

#include <algorithm>
#include <cstdlib>

#include "adapters/adapter.hpp"
#include "benchmarks/base/configuration_error.hpp"
#include "datasets/data_folder.hpp"

namespace hullbench::run {
namespace {

/// This program as a worker. /proc/self/exe is this very file, wherever it was started from and even when it
/// was replaced since.
worker::Method built_in(const AdapterEntry& entry) {
  worker::Method method;
  method.name = entry.name;
  method.title = entry.title;
  method.command = {"/proc/self/exe", "worker", "--method", entry.name};
  method.sources = entry.sources;
  return method;
}

bool has_value(const char* variable) {
  const char* value = std::getenv(variable);
  return value && *value;
}

}  // namespace

MethodCatalog::MethodCatalog(const std::vector<fs::path>& folders) {
  for (const AdapterEntry& entry : adapter_registry()) methods_.push_back(built_in(entry));
  const std::size_t built_ins = methods_.size();
  for (Manifest& manifest : load_manifests(folders)) {
    const std::string& name = manifest.method.name;
    const auto end = methods_.begin() + static_cast<std::ptrdiff_t>(built_ins);
    if (std::any_of(methods_.begin(), end,
                    [&](const worker::Method& method) { return method.name == name; })) {
      throw ConfigurationError("the manifest " + manifest.file.string() +
                               " has the name of the built-in method '" + name + "'; choose another one");
    }
    runs_[name] = std::move(manifest.runs);
    hashes_[name] = manifest.sha256;
    methods_.push_back(std::move(manifest.method));
  }
}

std::vector<std::string> MethodCatalog::names() const {
  std::vector<std::string> names;
  names.reserve(methods_.size());
  for (const worker::Method& method : methods_) names.push_back(method.name);
  return names;
}

const worker::Method& MethodCatalog::find(const std::string& name) const {
  const auto found =
      std::ranges::find_if(methods_, [&](const worker::Method& method) { return method.name == name; });
  if (found == methods_.end()) {
    throw ConfigurationError("there is no method '" + name + "'; 'hullbench list' shows them");
  }
  return *found;
}

std::vector<plan::PlanMethod> MethodCatalog::runs_of(const std::string& name) const {
  const worker::Method& method = find(name);
  if (!method.info) {
    throw ConfigurationError("the method '" + name +
                             "' is built in, and no manifest says how to choose its parameters; name it in a "
                             "plan");
  }
  if (const auto& runs = runs_.at(name); !runs.empty()) return runs;
  for (const ParameterInfo& parameter : method.info->parameters) {
    if (parameter.default_value) continue;
    throw ConfigurationError("the method '" + name + "' needs the parameter '" + parameter.name +
                             "': say in the key 'runs' of its manifest how to choose it");
  }
  plan::PlanMethod run;
  run.method = name;
  run.protocol = "default";
  return {run};
}

fs::path user_manifest_folder() {
  if (has_value("XDG_CONFIG_HOME"))
    return fs::path(std::getenv("XDG_CONFIG_HOME")) / "hullbench" / "adapters";
  if (has_value("HOME")) return fs::path(std::getenv("HOME")) / ".config" / "hullbench" / "adapters";
  throw ConfigurationError(
      "neither XDG_CONFIG_HOME nor HOME says where the user's configuration is; set one");
}

std::vector<fs::path> manifest_folders(const std::vector<fs::path>& folders) {
  std::vector<fs::path> all = {data_folder() / "adapters" / "manifests"};
  if (has_value("XDG_CONFIG_HOME") || has_value("HOME")) all.push_back(user_manifest_folder());
  for (const fs::path& folder : folders) {
    if (!fs::is_directory(folder)) throw ConfigurationError("there is no folder " + folder.string());
    all.push_back(folder);
  }
  return all;
}

}  // namespace hullbench::run
