// `polylidar merge PART...`: from what the shards of a hull found to polygons.
#include <CLI/CLI.hpp>
#include <stdexcept>
#include <vector>

#include "polylidar/stream.hpp"
#include "tool/commands/commands.hpp"
#include "tool/commands/run_command.hpp"
#include "tool/commands/shape_choice.hpp"
#include "tool/commands/shape_output.hpp"
#include "tool/commands/streamed_hull.hpp"
#include "tool/hull/shard_file.hpp"
#include "tool/program/configuration_error.hpp"
#include "tool/program/interrupt.hpp"
#include "tool/program/status_line.hpp"

namespace polylidar::tool {
namespace {

/// The parts and what all of them say of the points' coordinate system.
Crs read_parts(const std::vector<std::string>& paths, std::vector<StreamShard>& shards, StatusLine& status) {
  Crs crs;
  for (const std::string& path : paths) {
    throw_if_interrupted();
    status.show("reading part " + std::to_string(shards.size() + 1) + " of " + std::to_string(paths.size()));
    ShardFile file = read_shard_file(path);
    if (!shards.empty() && file.crs != crs) {
      throw ConfigurationError(path + ": its coordinate system is not that of " + paths.front() +
                               "; make all parts with the same --crs");
    }
    crs = std::move(file.crs);
    shards.push_back(std::move(file.shard));
  }
  return crs;
}

ExitCode merge(const MergeCommand& command, const Surroundings& surroundings) {
  const ShapeOutput output(command.shape, surroundings, kFormatsWithoutPoints);
  if (output.text_format() == "svg") {
    throw ConfigurationError(
        "svg shows all points, which parts do not have; write the polygons as geojson, wkt or wkb");
  }
  output.check_against(command.inputs);
  StatusLine status(surroundings.err, surroundings.terminal, quiet_time(surroundings.terminal));
  std::vector<StreamShard> shards;
  const Crs crs = read_parts(command.inputs, shards, status);
  std::size_t points = 0;
  for (const StreamShard& shard : shards) points += shard.points.size();
  status.show("triangulating " + std::to_string(points) + " points");
  const StreamedHull hull = concave_hull_of_shards(shards, thread_count(command.shape));
  throw_if_interrupted();
  write_streamed_hull(hull, shards.front().options, crs, output, surroundings.program, status);
  if (!output.can_tell(crs)) {
    status.say(surroundings.program + ": " + std::string(kNamelessCrs) + " where the shards are made");
  }
  return kExitOk;
}

}  // namespace

ExitCode merge_hulls(const MergeCommand& command, const Surroundings& surroundings) {
  return run_command("the parts", [&] {
    try {
      return merge(command, surroundings);
    } catch (const std::invalid_argument& error) {
      throw ConfigurationError(error.what());  // names the parts itself
    }
  });
}

void add_merge_options(CLI::App& app, MergeCommand& command) {
  app.description("Join the parts of a hull that 'polylidar hull --stream --shard' made");
  app.footer(
      "Give all parts, in any order. The result has the same bytes as that of 'polylidar hull --stream' with "
      "the same\n"
      "files and options on one machine.");
  app.add_option("PART", command.inputs, "The parts")->required();
  add_format_option(app, command.shape, kFormatsWithoutPoints);
  add_output_options(app, command.shape);
}

}  // namespace polylidar::tool
