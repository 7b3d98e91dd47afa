// Man pages and the completion of shells, from the tables of options that the help is printed from.
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <vector>

namespace packaging {

/// Of a program and each of its subcommands a man page of section 1, by the name of the file: "hullbench.1",
/// "hullbench-adapter-new.1". `version` stands at the foot of each, such as "hullbench 0.2.0". Hidden options
/// and subcommands are left out. Of the footer of a help, lines that begin with "Example: " go into EXAMPLES,
/// and the indented lines "CODE MEANING" after a line "Exit codes:" into EXIT STATUS. The rest are NOTES,
/// which are filled anew; a line that ends with a full stop, or an empty one, ends a paragraph.
std::map<std::string, std::string> man_pages(const CLI::App& program, const std::string& version);

/// Words that complete what the help names beside a list: {"gdal:DRIVER", {"gdal:GPKG"}} for an option whose
/// help says "{auto,wkt} or gdal:DRIVER".
using MoreWords = std::map<std::string, std::vector<std::string>>;

/// A script for bash that completes subcommands, options, the words that an option takes where these are
/// listed, also after '=', and else the names of files. To be sourced, or put into
/// share/bash-completion/completions under the program's name.
std::string bash_completion(const CLI::App& program, const MoreWords& more = {});

/// The same for zsh, to be put into a folder of its fpath, such as share/zsh/site-functions, under the
/// program's name after a '_'.
std::string zsh_completion(const CLI::App& program, const MoreWords& more = {});

/// Gives the program the option --write-manual FOLDER, which no help shows: it makes the folder if need be,
/// writes the man pages and, into a file with the program's name and into another with '_' before it, the
/// completions for bash and zsh, and ends the program as --help does. Throws std::runtime_error where
/// something cannot be written. To be called when `program` has all its subcommands.
void add_manual(CLI::App& program, const std::string& version, const MoreWords& more = {});

}  // namespace packaging
