// `hullbench hull FILE`: the tool's command, `polylidar hull`, under its old name.
#include <iostream>

#include "benchmarks/cli/options.hpp"
#include "benchmarks/cli/terminal.hpp"
#include "tool/commands/commands.hpp"

namespace hullbench::cli {

using polylidar::tool::HullCommand;

void add_hull(CLI::App& app, Action& action) {
  const auto command = std::make_shared<HullCommand>();
  CLI::App& options = add_command(app, "hull", "", std::string("hullbench ") + HullCommand::kExample);
  const std::string footer = options.get_footer();
  polylidar::tool::add_hull_options(options, *command);
  options.footer(options.get_footer() + "\n" + footer);
  set_action(
      options, action, command, +[](const HullCommand& asked) {
        return polylidar::tool::make_hull(asked, {"hullbench", std::cerr, is_terminal()});
      });
}

}  // namespace hullbench::cli
