// Man pages and the completion of a shell, from the tables of options that the help is printed from.
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>

namespace packaging {

/// Of a program and each of its subcommands a man page of section 1, by the name of the file: "hullbench.1",
/// "hullbench-adapter-new.1". `version` stands at the foot of each, such as "hullbench 0.2.0". Hidden options
/// and subcommands are left out.
std::map<std::string, std::string> man_pages(const CLI::App& program, const std::string& version);

/// A script for bash that completes subcommands, options, the words that an option takes where these are
/// listed, and else the names of files. To be sourced, or put into share/bash-completion/completions under
/// the program's name.
std::string bash_completion(const CLI::App& program);

/// Gives the program the option --write-manual FOLDER, which no help shows: it writes the man pages and, into
/// a file with the program's name, the completion, and ends the program as --help does. The folder must be
/// there; throws std::runtime_error where a file cannot be written. To be called when `program` has all its
/// subcommands.
void add_manual(CLI::App& program, const std::string& version);

}  // namespace packaging
