// All methods that can be named: those of this program and those of manifests.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "benchmarks/run/manifest.hpp"
#include "benchmarks/worker/method.hpp"

namespace hullbench::run {

class MethodCatalog {
 public:
  /// The methods of this build and those of the manifests in `folders`, in this order. Throws
  /// ConfigurationError when a manifest has a fault or the name of another method.
  explicit MethodCatalog(const std::vector<fs::path>& folders);

  const std::vector<worker::Method>& methods() const { return methods_; }
  std::vector<std::string> names() const;

  /// Throws ConfigurationError when there is none of that name.
  const worker::Method& find(const std::string& name) const;

  /// The entries for a plan that does not name the method: its manifest's, or one with the protocol `default`
  /// where no parameter is required. Throws ConfigurationError when neither is there.
  std::vector<plan::PlanMethod> runs_of(const std::string& name) const;

  /// The hash of the manifest, by the method's name, of those that have one.
  const std::map<std::string, std::string>& hashes() const { return hashes_; }

 private:
  std::vector<worker::Method> methods_;
  std::map<std::string, std::vector<plan::PlanMethod>> runs_;
  std::map<std::string, std::string> hashes_;
};

/// Where manifests are looked for: this project's adapters/manifests, the user's configuration folder
/// ($XDG_CONFIG_HOME/hullbench/adapters, or ~/.config/hullbench/adapters), and `folders`, which must be there
/// (ConfigurationError else).
std::vector<fs::path> manifest_folders(const std::vector<fs::path>& folders);

/// The user's configuration folder for manifests. Throws ConfigurationError when neither XDG_CONFIG_HOME nor
/// HOME says where it is.
fs::path user_manifest_folder();

}  // namespace hullbench::run
