// `hullbench validate`
#include <iostream>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/cli/options.hpp"
#include "benchmarks/record/validate.hpp"

namespace hullbench::cli {
namespace {

ExitCode validate(const std::string& path) {
  if (!fs::is_regular_file(path)) throw ConfigurationError("there is no file " + path + " to validate");
  const std::vector<std::string> faults = record::validate_file(path);
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
