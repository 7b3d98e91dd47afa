// polylidar: from points to polygons, on the command line.
#include <CLI/CLI.hpp>
#include <functional>
#include <iostream>
#include <memory>
#include <string>

#include "packaging/manual/manual.hpp"
#include "tool/commands/commands.hpp"
#include "tool/program/command_line.hpp"
#include "tool/program/exit_code.hpp"
#include "tool/program/interrupt.hpp"
#include "tool/program/surroundings.hpp"
#ifdef POLYLIDAR_WITH_GDAL
#include "tool/gdal/gdal_formats.hpp"
#endif

namespace {

using namespace polylidar::tool;

constexpr const char* kProgram = "polylidar";

using Action = std::function<ExitCode()>;

const VectorFormats* vector_formats() {
#ifdef POLYLIDAR_WITH_GDAL
  return &gdal_formats();
#else
  return nullptr;
#endif
}

/// Drivers that nearly every GDAL has, for the completion of --format.
packaging::MoreWords gdal_words() {
#ifdef POLYLIDAR_WITH_GDAL
  return {{"gdal:DRIVER",
           {"gdal:GPKG", "gdal:FlatGeobuf", "gdal:GeoJSONSeq", "gdal:GML", "gdal:KML", "gdal:SQLite",
            "gdal:PostgreSQL"}}};
#else
  return {};
#endif
}

/// Behind the version: the library that this program may have been built with or without.
std::string with_what() {
#ifdef POLYLIDAR_WITH_GDAL
  return ", with GDAL " + gdal_version();
#else
  return ", without GDAL";
#endif
}

/// What the command line asks for; nothing more when it is help.
Action parse(int argc, char** argv) {
  CLI::App app("Polygons round points: concave hulls of files of points.", kProgram);
  app.require_subcommand(1);
  app.set_version_flag("--version", "polylidar " POLYLIDAR_VERSION + with_what());
  app.footer(kToolExitCodesHelp);
  const Surroundings surroundings{kProgram, std::cerr, is_terminal(), vector_formats()};
  Action action;
  const auto add = [&]<class Command>(const char* name, void (*add_options)(CLI::App&, Command&),
                                      ExitCode (*work)(const Command&, const Surroundings&)) {
    const auto command = std::make_shared<Command>();
    CLI::App& options = *app.add_subcommand(name);
    add_options(options, *command);
    options.footer(options.get_footer() + "\nExample: " + kProgram + " " + Command::kExample + "\n" +
                   kToolExitCodesHelp);
    options.callback([&action, &surroundings, command, work] {
      action = [surroundings, command, work] { return work(*command, surroundings); };
    });
  };
  add("hull", &add_hull_options, &make_hull);
  add("merge", &add_merge_options, &merge_hulls);
  add("footprint", &add_footprint_options, &make_footprints);
  packaging::add_manual(app, "polylidar " POLYLIDAR_VERSION, gdal_words());
  return parsed_action(app, action, argc, argv);
}

}  // namespace

int main(int argc, char** argv) {
  return exit_code_of(kProgram, std::cerr, [&] {
    const Action action = parse(argc, argv);
    catch_interruptions();
    return action();
  });
}
