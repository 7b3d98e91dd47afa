// What the subcommands' command lines are made of.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/base/interrupt.hpp"
#include "benchmarks/cli/commands.hpp"
#include "benchmarks/run/shard.hpp"

namespace hullbench::cli {

/// A subcommand `name` of `app`. `example` is a whole command line, which its help shows.
CLI::App& add_command(CLI::App& app, const std::string& name, const std::string& description,
                      const std::string& example);

/// Lets the subcommand do `work` with what its options have left in `command`.
template <class Command>
void set_action(CLI::App& options, Action& action, const std::shared_ptr<Command>& command,
                ExitCode (*work)(const Command&)) {
  options.callback([&action, command, work] {
    action = [command, work] {
      catch_interruptions();
      return work(*command);
    };
  });
}

/// PLAN...
void add_plans(CLI::App& options, std::vector<std::string>& plans, const std::string& meaning);
/// --adapters, folders with manifests of methods
void add_adapters(CLI::App& options, std::vector<fs::path>& folders);
/// --shard K/N
void add_shard(CLI::App& options, std::optional<run::Shard>& shard, const std::string& meaning);
/// --export-gbench
void add_export_gbench(CLI::App& options, fs::path& file);

/// What --timeout, in seconds, takes.
CLI::Validator timeout_range();
/// What --seed takes.
CLI::Validator seed_range();
/// What --mem-limit, in MiB, takes.
CLI::Range memory_range();

/// Throws ConfigurationError when the file of --export-gbench cannot be written, which would otherwise be
/// known only after the work. Empty: none is asked for.
void check_export_place(const fs::path& file);

}  // namespace hullbench::cli
