// What the man pages and the completions read of a program's table of options.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace packaging {

/// Of the program or one of its subcommands; those that no help shows are left out.
std::vector<const CLI::App*> visible_commands(const CLI::App& app);
std::vector<const CLI::Option*> visible_options(const CLI::App& app);
std::vector<const CLI::Option*> visible_arguments(const CLI::App& app);

/// The names from the program on, "hullbench adapter new", with `between` between them.
std::string full_name(const CLI::App& app, const std::string& between);

/// "-o" and "--out".
std::vector<std::string> names_of(const CLI::Option& option);

/// Whether a value follows the option's name.
bool takes_value(const CLI::Option& option);

/// Whether the option or the argument takes as many values as there are.
bool takes_many(const CLI::Option& option);

/// What the help shows as TYPE:CHECK, as in "TEXT:{auto,wkt} or gdal:DRIVER" and "UINT:UINT in [1 - 8]".
struct ValueHelp {
  std::string type;                 ///< "TEXT", "UINT"
  std::string check;                ///< "{auto,wkt} or gdal:DRIVER", "UINT in [1 - 8]"; may be empty
  std::vector<std::string> listed;  ///< "auto", "wkt": what stands between the braces
  std::string beside;               ///< "gdal:DRIVER": what the help allows beside them; may be empty
};
ValueHelp value_help(const CLI::Option& option);

std::string joined(const std::vector<std::string>& words, const std::string& between);

}  // namespace packaging
