// The command line of a program whose subcommands leave their work as a function.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "tool/program/configuration_error.hpp"
#include "tool/program/exit_code.hpp"

namespace polylidar::tool {

/// Parses with `app`, whose subcommands set `action`, and gives that; nothing to do when help was asked for.
/// Throws ConfigurationError when the command line is wrong.
inline std::function<ExitCode()> parsed_action(CLI::App& app, const std::function<ExitCode()>& action,
                                               int argc, char** argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& request) {
    app.exit(request);
    return [] { return kExitOk; };
  } catch (const CLI::ParseError& error) {
    const std::string name = app.get_name();
    throw ConfigurationError(std::string(error.what()) + "; '" + name + " --help' and '" + name +
                             " COMMAND --help' show what there is");
  }
  return action;
}

}  // namespace polylidar::tool
