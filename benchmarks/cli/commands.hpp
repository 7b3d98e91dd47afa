// The subcommands of hullbench, each in a file of its name.
#pragma once

#include <functional>

#include "benchmarks/base/exit_code.hpp"

namespace CLI {
class App;
}

namespace hullbench::cli {

/// What the command line asks for. Results go to standard output, everything else to standard error. Throws
/// what exit_code_of() takes.
using Action = std::function<ExitCode()>;

/// Each adds its subcommand to `app`, with its options, help and an example. Parsing it sets `action`, which
/// must live until then.
void add_list(CLI::App& app, Action& action);
void add_metrics(CLI::App& app, Action& action);
void add_run(CLI::App& app, Action& action);
void add_tune(CLI::App& app, Action& action);
void add_league(CLI::App& app, Action& action);
void add_merge(CLI::App& app, Action& action);
void add_rescore(CLI::App& app, Action& action);
void add_submit(CLI::App& app, Action& action);
void add_tables(CLI::App& app, Action& action);
void add_report(CLI::App& app, Action& action);
void add_compare(CLI::App& app, Action& action);
void add_adapter(CLI::App& app, Action& action);
void add_hull(CLI::App& app, Action& action);
void add_choose(CLI::App& app, Action& action);
void add_points(CLI::App& app, Action& action);
void add_readme(CLI::App& app, Action& action);
void add_validate(CLI::App& app, Action& action);
void add_worker(CLI::App& app, Action& action);

}  // namespace hullbench::cli
