// `hullbench list`
#include <iostream>

#include "benchmarks/cli/listing.hpp"
#include "benchmarks/cli/options.hpp"
#include "benchmarks/run/method_catalog.hpp"

namespace hullbench::cli {
namespace {

struct ListCommand {
  bool json = false;
  std::vector<fs::path> adapters;
};

/// Memory for a worker that only says who it is.
constexpr std::int64_t kListMemoryMib = 4096;

ExitCode list(const ListCommand& command) {
  const run::MethodCatalog catalog(run::manifest_folders(command.adapters));
  const json listing = make_listing(catalog.methods(), {kListMemoryMib, std::nullopt});
  if (command.json) {
    std::cout << listing.dump(2) << "\n";
  } else {
    print_listing(listing, std::cout);
  }
  return kExitOk;
}

}  // namespace

void add_list(CLI::App& app, Action& action) {
  const auto command = std::make_shared<ListCommand>();
  CLI::App& options = add_command(app, "list", "Show methods and data sets", "hullbench list");
  options.add_flag("--json", command->json, "Print JSON");
  add_adapters(options, command->adapters);
  set_action(options, action, command, &list);
}

}  // namespace hullbench::cli
