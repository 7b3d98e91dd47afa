// `hullbench hull FILE`: from anybody's points to polygons.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace hullbench::hull {

/// The command line of `hull`. Lengths are in the unit of the points.
struct HullCommand {
  std::string input;                      ///< a path, or "-" for standard input
  std::optional<double> alpha;            ///< >= 0; the three limits are those of polylidar::Options
  std::optional<double> max_edge_length;  ///< >= 0
  std::optional<double> max_perimeter;    ///< >= 0
  std::string input_format = "auto";      ///< a name that point_format_of() knows
  std::string columns;                    ///< see PointFileOptions
  std::string format = "geojson";         ///< "geojson", "wkt", "wkb" or "svg"
  double min_area = 0;            ///< squared units; smaller holes are filled, smaller polygons dropped
  std::size_t min_triangles = 0;  ///< polygons of fewer Delaunay triangles are dropped
  double simplify = 0;            ///< how far the outline may move; 0: not at all
  unsigned threads = 0;           ///< 0: as many as there are processors
  std::string out;                ///< a file; empty: standard output
};

/// Reads, computes and writes; the alpha that was chosen, notes and, on a terminal, progress go to standard
/// error. Returns 0. Throws ConfigurationError when the input cannot be read or used, std::runtime_error when
/// the result cannot be written, Interrupted.
int hull_command(const HullCommand& command);

}  // namespace hullbench::hull
