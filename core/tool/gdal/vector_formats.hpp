// The vector formats of GDAL, behind an interface: a program has them or does without.
#pragma once

#include <string>
#include <vector>

#include "tool/points/crs.hpp"
#include "tool/points/point_file.hpp"

namespace polylidar::tool {

/// Where GDAL writes to.
struct VectorOutput {
  std::string path;  ///< a file, or how to reach a database, such as "PG:dbname=gis"
  std::string
      driver;  ///< GDAL's name of the format, such as "GPKG"; empty: by the ending or beginning of `path`
  std::string layer;  ///< empty: the file's name without its ending; in a database "polylidar"
};

class VectorFormats {
 public:
  VectorFormats() = default;
  virtual ~VectorFormats() = default;
  VectorFormats(const VectorFormats&) = delete;
  VectorFormats& operator=(const VectorFormats&) = delete;

  /// The points of a layer, grouped by a field where `options` asks for it. As read_point_file().
  virtual PointFile read(const std::string& path, const PointFileOptions& options) const = 0;

  /// The files of which the data set at `path` consists, as of a Shapefile; none where it cannot be read.
  virtual std::vector<std::string> files_of(const std::string& path) const = 0;

  /// The files beside `output` that it replaces or removes, as a Shapefile does. Throws ConfigurationError
  /// where it cannot be written: no format is known for it, GDAL writes no polygons of that format, the file
  /// has other layers or rasters, which would be lost, a file beside it is there and no part of what is
  /// replaced, or the database has such a table; std::runtime_error where the place cannot be written to or
  /// reached.
  virtual std::vector<std::string> check(const VectorOutput& output) const = 0;

  /// Writes the features of `geojson`, a Feature or a FeatureCollection, their properties as fields, in the
  /// coordinate system `crs`. A file is written whole or not at all; in a database a table of that name must
  /// not be there. Returns what a person should be told, such as what the format has no place for. Throws as
  /// check, ConfigurationError also where the format cuts or changes a label, std::runtime_error when it
  /// cannot be written, and Interrupted.
  virtual std::vector<std::string> write(const VectorOutput& output, std::string geojson,
                                         const Crs& crs) const = 0;
};

/// Whether the ending or the beginning of `path` says that GDAL is to read or write it: .gpkg, .shp, PG: and
/// so on.
bool is_for_gdal(const std::string& path);

/// Whether `path`, which is for GDAL, is how to reach a database or the like, as "PG:dbname=gis" is, and no
/// file.
bool is_database(const std::string& path);

/// What is said of an input where a program does without GDAL, behind its name.
inline constexpr const char* kNoGdalToRead =
    "it is read by GDAL, which this build is without; convert it, as in 'ogr2ogr -f CSV -lco GEOMETRY=AS_XY "
    "/vsistdout/ FILE | polylidar hull - --columns X,Y', or build polylidar with -DPOLYLIDAR_WITH_GDAL=ON "
    "('make tool GDAL=1')";

/// The same of an output.
inline constexpr const char* kNoGdalToWrite =
    "it is written by GDAL, which this build is without; write GeoJSON and convert it, as in 'ogr2ogr "
    "out.gpkg "
    "out.geojson', or build polylidar with -DPOLYLIDAR_WITH_GDAL=ON ('make tool GDAL=1')";

}  // namespace polylidar::tool
