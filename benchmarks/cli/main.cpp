// hullbench: the command line. Every subcommand is a file of this folder.
#include <iostream>
#include <string>

#include "benchmarks/cli/options.hpp"
#include "packaging/manual/manual.hpp"
#include "tool/program/command_line.hpp"

namespace {

using namespace hullbench;
using namespace hullbench::cli;

/// In the order of the help.
constexpr auto kCommands = {&add_list,    &add_metrics,  &add_run,    &add_tune,   &add_league,
                            &add_merge,   &add_rescore,  &add_tables, &add_report, &add_compare,
                            &add_adapter, &add_submit,   &add_hull,   &add_choose, &add_points,
                            &add_readme,  &add_validate, &add_worker};

constexpr const char* kVariables =
    "HULLBENCH_POSTGIS_DSN names a PostGIS server to use instead of a private one; HULLBENCH_POSTGRES_BIN\n"
    "names the folder of the PostgreSQL programs of a private one. For postgis_legacy they are\n"
    "HULLBENCH_POSTGIS_LEGACY_DSN and HULLBENCH_POSTGRES_LEGACY_BIN.";

/// What the command line asks for; nothing more when it is help.
Action parse(int argc, char** argv) {
  CLI::App app("Benchmark of concave-hull methods: the same points for all, every result scored.",
               "hullbench");
  app.require_subcommand(1);
  app.set_version_flag("--version", "hullbench " HULLBENCH_VERSION);
  app.footer(std::string(kExitCodesHelp) + "\n" + kVariables);
  Action action;
  for (const auto add : kCommands) add(app, action);
  packaging::add_manual(app, "hullbench " HULLBENCH_VERSION);
  return polylidar::tool::parsed_action(app, action, argc, argv);
}

}  // namespace

int main(int argc, char** argv) {
  return exit_code_of("hullbench", std::cerr, [&] { return parse(argc, argv)(); });
}
