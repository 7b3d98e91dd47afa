// What the commands have in common: options, and what becomes of them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "polylidar/stream.hpp"
#include "tool/commands/commands.hpp"
#include "tool/hull/group_hulls.hpp"
#include "tool/points/point_file.hpp"
#include "tool/shapes/polygon_writers.hpp"

namespace polylidar::tool {

/// Adds the options to `app`.
void add_shape_options(CLI::App& app, ShapeChoice& choice);
/// Of these, those that are about the result alone, and the threads.
void add_output_options(CLI::App& app, ShapeChoice& choice);

/// Adds --memory, whose help begins with `when`.
void add_memory_option(CLI::App& app, ShapeChoice& choice, const std::string& when);

/// Formats that are written here, by the names that --format has for them.
using Formats = std::span<const std::string_view>;
inline constexpr std::array<std::string_view, 4> kAllFormats = {"geojson", "wkt", "wkb", "svg"};
/// Those that show no points beside polygons.
inline constexpr Formats kFormatsWithoutPoints = Formats(kAllFormats).first(3);
/// Those that have properties.
inline constexpr Formats kFormatsWithProperties = Formats(kAllFormats).first(1);

/// Adds --format, which takes these words, auto, and the drivers of GDAL.
void add_format_option(CLI::App& app, ShapeChoice& choice, Formats formats);

/// Which points are read, with what. Throws ConfigurationError for classes or a window that are none.
PointFileOptions point_options(const ShapeChoice& choice, const Surroundings& surroundings);

/// --threads, or the number of processors.
unsigned thread_count(const ShapeChoice& choice);

/// The most that points may take, in bytes: --memory, or half of what is free.
std::uint64_t memory_for_points(const ShapeChoice& choice);
/// For StreamOptions::most_map_bytes: half of that, the rest for what is near the outline. Without --memory
/// it is at least as much as StreamOptions has, which is what shards get then: their grids must be the same
/// on all machines.
double most_map_bytes(const ShapeChoice& choice);
/// How many may be in memory for a triangulation of all.
std::uint64_t most_points_in_memory(const ShapeChoice& choice);

/// "reading: 12 of 300 MiB", for PointFileOptions::on_progress.
std::string reading(std::uint64_t bytes, std::optional<std::uint64_t> size);
/// "pass 2 of 6: 1000 points", of `all` where that is known.
std::string passing(const StreamProgress& progress, std::optional<std::uint64_t> all = {});

/// The coordinate system that `choice` gives, else that of the file. Throws ConfigurationError for a name
/// that is none.
Crs chosen_crs(const ShapeChoice& choice, const Crs& of_file);

/// What is to be said of points in `box` whose coordinate system is not known: that the result names none, if
/// it would have one (`has_crs`) and the coordinates are no longitudes and latitudes, or that they look like
/// these; empty: nothing.
std::string unknown_crs_note(const ShapeChoice& choice, const Crs& crs, const Box& box, bool has_crs);

/// Throws ConfigurationError where a system is longitude and latitude, and a coordinate in `box` cannot be
/// one, also where GeoJSON names no system, and where they are in another unit than degrees: as metres the
/// shape would be as wrong as unseen.
void check_degrees(const Crs& crs, const Box& box);

/// What is said where longitudes span more than half of the globe.
inline constexpr std::string_view kSpansDateLine =
    "the points span more than 180 degrees of longitude; if they lie on both sides of the date line, write "
    "western longitudes as 180 to 360";

/// Whether kSpansDateLine is to be said of longitudes and latitudes in `box`.
bool spans_date_line(const Box& box);

/// What the help of hull and footprint says of GDAL.
inline constexpr std::string_view kGdalHelp =
    "A build with GDAL (-DPOLYLIDAR_WITH_GDAL=ON) also reads points from GeoPackage, Shapefile, FlatGeobuf, "
    "PostGIS (PG:)\n"
    "and GDAL's other formats, and writes polygons to them, with their properties as fields.";

/// A file's points, and the hulls of its groups, in metres where the coordinates are degrees.
struct LocatedHulls {
  std::vector<GroupHull> groups;
  std::vector<Point> metres;       ///< empty where the coordinates are plane
  std::optional<double> latitude;  ///< of the metres
};

/// Throws std::invalid_argument where orient2d() is not exact for the coordinates: the core scales its
/// points, but what works on its shapes does not.
void check_magnitude(std::span<const Point> points);

/// Without groups there is one hull, but none of a file that is grouped by something and has no points.
LocatedHulls locate_hulls(const PointFile& file, const ShapeChoice& choice, bool is_grouped, unsigned threads,
                          const OnStep& on_step);

/// Whether points of a file may be left out.
bool chooses_points(const ShapeChoice& choice);

/// What is said where there are no points: in the file, or none that is asked for.
std::string no_points(const ShapeChoice& choice, const std::string& file);

/// What is said behind a limit that was chosen.
inline constexpr std::string_view kByHand = "--alpha, --max-edge-length or --max-perimeter sets a limit";

/// What is asked for where a limit cannot be chosen in the memory that there is.
inline constexpr std::string_view kLimitOrMemory =
    "--alpha, --max-edge-length or --max-perimeter, or more --memory";

/// What is said of the range of the sizes that were chosen, and widened for what is `wanted`, or of a shape
/// `by_outlines`; empty where a limit was given.
std::string limit_in_words(const std::optional<ChosenSizes>& sizes, bool by_outlines, const Wanted& wanted);

/// Adds the limits that were given, or this range, which decides nothing `by_outlines`.
void add_limits(const Options& limits, const std::optional<ChosenSizes>& sizes, bool by_outlines,
                Properties& properties);

/// Adds how many parts and holes a shape has, and its area.
void add_extent(std::size_t parts, std::size_t holes, double area, Properties& properties);

/// Adds the limits that the shape has, its parts, holes and area.
void add_shape_properties(const GroupHull& hull, Properties& properties);

}  // namespace polylidar::tool
