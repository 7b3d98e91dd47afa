// The tool's commands: for each, what its options say, the options, and the work. A program adds the options
// to its own command line and says where it runs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tool/hull/group_hulls.hpp"
#include "tool/program/exit_code.hpp"
#include "tool/program/surroundings.hpp"

// NOLINTNEXTLINE(readability-identifier-naming): CLI11's name
namespace CLI {
class App;
}

namespace polylidar::tool {

/// How a shape is made of points, and which points: what hull and footprint have, and of it the output merge.
/// Lengths are in the unit of the points, of longitudes and latitudes in metres.
struct ShapeChoice {
  HullOptions hull;                   ///< how the shape is made; without threads and latitude
  std::string returns = "all";        ///< "all", "first" or "last"
  std::string classes;                ///< such as "2,6"; empty: all
  std::string window;                 ///< "xmin,ymin,xmax,ymax"; empty: no window
  std::string crs;                    ///< "none", "EPSG:n" or "n"; empty: what the file says
  std::string input_format = "auto";  ///< a name that point_format_of() knows
  std::string columns;                ///< see PointFileOptions
  unsigned threads = 0;               ///< 0: as many as there are processors
  std::uint64_t memory = 0;           ///< the most for points, in MiB; 0: half of what is free
  std::string out;                    ///< a file, or what GDAL writes to; empty: standard output
  std::string format = "auto";        ///< "geojson" and so on, or "gdal:" and the name of a driver
  std::string layer;                  ///< of the input, where GDAL reads it
  std::string out_layer;              ///< of the output, where GDAL writes it
};

/// From a file of points to polygons.
struct HullCommand {
  /// Behind the program's name.
  static constexpr const char* kExample = "hull points.csv --columns lon,lat --format svg --out hull.svg";

  std::vector<std::string> inputs;  ///< paths, or "-" for standard input; several for `stream` only
  ShapeChoice shape;
  std::string by;              ///< see PointFileOptions
  bool keep_outliers = false;  ///< the points left outside are written too
  bool stream = false;         ///< the files are read again and again, their points are not kept
  std::string shard;           ///< such as "2/7": only what that shard finds, for MergeCommand
};

/// From what all shards of `hull --stream --shard` found to polygons.
struct MergeCommand {
  static constexpr const char* kExample = "merge part-1 part-2 part-3 --out hull.geojson";

  std::vector<std::string> inputs;  ///< paths
  ShapeChoice shape;                ///< of which only what add_output_options() adds matters
};

/// From files of points to an index of their footprints, or to the footprint of all of them together.
struct FootprintCommand {
  static constexpr const char* kExample = "footprint tiles/*.las --returns first --out index.geojson";

  std::vector<std::string> inputs;  ///< paths
  ShapeChoice shape;
  bool is_union = false;  ///< one shape of all points
};

/// Each adds its options, description and notes to `app`. `command` must live as long.
void add_hull_options(CLI::App& app, HullCommand& command);
void add_merge_options(CLI::App& app, MergeCommand& command);
void add_footprint_options(CLI::App& app, FootprintCommand& command);

/// Each writes the result to standard output or the file, whole or not at all; notes and, on a terminal,
/// progress go to surroundings.err. They throw what exit_code_of() takes.
ExitCode make_hull(const HullCommand& command, const Surroundings& surroundings);
ExitCode merge_hulls(const MergeCommand& command, const Surroundings& surroundings);
/// kExitFailures when a file could not be read; the index has the others.
ExitCode make_footprints(const FootprintCommand& command, const Surroundings& surroundings);

}  // namespace polylidar::tool
