// `hullbench worker`
#include "adapters/adapter.hpp"
#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/cli/options.hpp"
#include "benchmarks/worker/worker.hpp"

namespace hullbench::cli {
namespace {

ExitCode work(const std::string& method) {
  const AdapterEntry* entry = find_adapter(method);
  if (!entry) throw ConfigurationError("there is no method '" + method + "'; 'hullbench list' shows them");
  return worker::run_worker(*entry);
}

}  // namespace

void add_worker(CLI::App& app, Action& action) {
  const auto method = std::make_shared<std::string>();
  CLI::App& options =
      add_command(app, "worker", "Run one method for another process (see adapters/process/PROTOCOL.md)",
                  R"(echo '{"request": "hello"}' | hullbench worker --method polylidar)");
  options.add_option("--method", *method, "The method's name")->required();
  // No set_action: a worker does not catch an interruption, it ends at once.
  options.callback([&action, method] { action = [method] { return work(*method); }; });
}

}  // namespace hullbench::cli
