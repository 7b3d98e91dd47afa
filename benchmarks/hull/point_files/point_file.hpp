// Anybody's points: from a file in one of the usual formats, or from standard input, to a vector.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "polylidar/geometry.hpp"

namespace hullbench::hull {

/// What is wrong with a file of points, where, and what would be right: one sentence that begins with the
/// file's name and, for text, the line.
class PointFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

enum class PointFormat {
  kAuto,     ///< by the ending of the file's name, else by its first bytes
  kCsv,      ///< columns between commas, semicolons, tabs or blanks, whichever the first row has
  kXyz,      ///< columns between blanks
  kGeoJson,  ///< RFC 7946: Point, MultiPoint, GeometryCollection, Feature, FeatureCollection
  kWkt,      ///< OGC 06-103r4, 7.2: POINT, MULTIPOINT and GEOMETRYCOLLECTION, one after the other
  kNpy,      ///< NumPy's .npy, versions 1 to 3: an array of n x 2 or n x 3 numbers
  kPly,      ///< Stanford polygons, ascii and binary: the element "vertex" with x and y
};

/// The format that a name such as "geojson" stands for; nothing for a name that is none.
std::optional<PointFormat> point_format_of(const std::string& name);

struct PointFileOptions {
  PointFormat format = PointFormat::kAuto;
  /// For columns of text: which two hold x and y, such as "lon,lat" (names in the first row) or "2,3"
  /// (counted from 1). Empty: by the names x and y, lon and lat, longitude and latitude, lng and lat, or
  /// easting and northing, in any case; without these the first two.
  std::string columns;
  /// Called after every block, about a MiB, with the bytes read so far and, of a regular file, its size. What
  /// it throws ends the reading.
  std::function<void(std::uint64_t, std::optional<std::uint64_t>)> on_progress;
};

/// The points of the file at `path`, or of standard input for "-", in their order; further coordinates are
/// dropped. Throws PointFileError when it cannot be read, has no byte, is not what its format says, or has a
/// coordinate that is not finite. A file may hold no points.
std::vector<polylidar::Point> read_points(const std::string& path, const PointFileOptions& options = {});

}  // namespace hullbench::hull
