// `hullbench validate`
#include <iostream>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/base/files.hpp"
#include "benchmarks/cli/options.hpp"
#include "benchmarks/record/validate.hpp"
#include "benchmarks/run/manifest.hpp"

namespace hullbench::cli {
namespace {

/// What a manifest's schema cannot tell, such as a protocol that does not exist. Nothing of other files.
std::vector<std::string> faults_of_manifest(const fs::path& path) {
  if (!run::is_manifest(path)) return {};
  const json document = json::parse(read_text_file(path).value_or("null"));
  if (!document.is_object() || !document.contains("manifest_version")) return {};
  try {
    run::load_manifest(path);
    return {};
  } catch (const ConfigurationError& error) {
    return {error.what()};
  }
}

ExitCode validate(const std::string& path) {
  if (!fs::is_regular_file(path)) throw ConfigurationError("there is no file " + path + " to validate");
  if (path.ends_with(".json.xz"))
    throw ConfigurationError(path + " is compressed; give it unpacked, as by xz -dk");
  std::vector<std::string> faults = record::validate_file(path);
  if (faults.empty()) faults = faults_of_manifest(path);
  for (const std::string& fault : faults) std::cerr << "hullbench: " << path << ": " << fault << "\n";
  if (faults.empty()) std::cout << path << " is valid\n";
  return faults.empty() ? kExitOk : kExitError;
}

}  // namespace

void add_validate(CLI::App& app, Action& action) {
  const auto path = std::make_shared<std::string>();
  CLI::App& options = add_command(app, "validate",
                                  "Check a manifest, or a record of a run, a search, a league, tables or a "
                                  "submission (.json, .jsonl, .jsonl.xz), against its schema",
                                  "hullbench validate results/latest/report.json");
  options.add_option("FILE", *path, "The file")->required();
  set_action(options, action, path, &validate);
}

}  // namespace hullbench::cli
