// Anybody's points: from a file in one of the usual formats, or from standard input, to a vector.
#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "polylidar/geometry.hpp"
#include "polylidar/stream.hpp"
#include "tool/points/crs.hpp"

namespace polylidar::tool {

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
  kRaw,      ///< little-endian doubles x, y, one point behind the other, and nothing else
  kPly,      ///< Stanford polygons, ascii and binary: the element "vertex" with x and y
  kLas,  ///< ASPRS LAS 1.0 to 1.4, point formats 0 to 10, and LAZ, 0 to 3 and 6 to 8; without withheld points
  kGdal,  ///< whatever VectorFormats reads
};

/// Which returns of a LAS file's pulses.
enum class Returns {
  kAll,
  kFirst,  ///< number 1 of its pulse, or 0, which says nothing
  kLast,   ///< the number that its pulse has returns
};

/// The format that a name such as "geojson" stands for; nothing for a name that is none.
std::optional<PointFormat> point_format_of(const std::string& name);

class VectorFormats;
namespace point_files {
class KeptPoints;
}

/// Part `number`, from 0 on, of `count` of about the same size.
struct FilePart {
  std::size_t number = 0;
  std::size_t count = 1;

  /// Of a file with `points` points, the number of the part's first, and that behind its last.
  std::uint64_t begin(std::uint64_t points) const { return place(points, number); }
  std::uint64_t end(std::uint64_t points) const { return place(points, number + 1); }

 private:
  std::uint64_t place(std::uint64_t points, std::size_t part) const {
    return points / count * part + points % count * part / count;
  }
};

struct PointFileOptions {
  PointFormat format = PointFormat::kAuto;
  /// For columns of text: which two hold x and y, such as "lon,lat" (names in the first row) or "2,3"
  /// (counted from 1). Empty: by the names x and y, lon (lng, long, longitude) and lat (latitude), or easting
  /// and northing, in any case; without these the only two.
  std::string columns = {};
  /// What to group points by: a column of text or of a layer, by its name or its number from 1; a property of
  /// GeoJSON's features; classification, return or point_source of a LAS file. Empty: nothing.
  std::string by = {};
  /// Of a LAS file.
  Returns returns = Returns::kAll;
  /// Of a LAS file: the classifications that are taken; not given: all.
  std::optional<std::bitset<256>> classes = {};
  /// Only points in it, or on its border, are taken; in the coordinates of the file.
  std::optional<Box> window = {};
  /// Where given, it is called with the points, block by block in their order, and PointFile::points stays
  /// empty: for files of more points than fit into memory. Of LAS, columns of text, NumPy's rows, raw doubles
  /// and layers; other files are refused.
  std::function<void(std::span<const Point>)> take_points = {};
  /// With `take_points`, of a file that is_read_in_parts(): only the points of this part are read.
  FilePart part = {};
  /// With `take_points`: where the points of a LAS file are kept as well, if there is room and all are taken.
  point_files::KeptPoints* keep = nullptr;
  /// Files that cannot be taken block by block are read whole, and handed to `take_points` then, instead of
  /// being refused.
  bool whole_if_needed = false;
  /// What reads kGdal; null: such files are refused.
  const VectorFormats* vector_formats = nullptr;
  /// Of kGdal, which of several layers; empty: the only one, or the only one of points.
  std::string layer = {};
  /// Called after every block, about a MiB, and while points are unpacked, with the bytes read so far and, of
  /// a regular file, its size. What it throws ends the reading.
  std::function<void(std::uint64_t, std::optional<std::uint64_t>)> on_progress = {};
};

/// What a file holds.
struct PointFile {
  std::vector<Point> points;  ///< in their order; further coordinates are dropped
  std::vector<std::uint32_t>
      groups;  ///< of each point, its index in `labels`; empty where nothing is grouped by
  std::vector<std::string> labels;  ///< distinct; numbers by value, then other texts by their bytes
  std::string note;                 ///< what a person should be told of how it was read; mostly empty
  Crs crs;                          ///< that the file names, else a .prj file beside it
  std::array<std::uint64_t, 256> classes{};  ///< of a LAS file: classification -> points taken
};

/// The file at `path`, or standard input for "-". A file that gzip compressed is unpacked, where zlib was
/// there when this was built. Throws PointFileError when it cannot be read, has no byte, is not what its
/// format says, or has a coordinate that is not finite. A file may hold no points.
PointFile read_point_file(const std::string& path, const PointFileOptions& options = {});

/// Whether parts of the file can be read by themselves: LAS, LAZ, NumPy's rows and raw doubles, if it is no
/// pipe and gzip did not compress it. Also not if the file cannot be read: reading it then says why.
bool is_read_in_parts(const std::string& path, const PointFileOptions& options);

/// What the header of a LAS file that is_read_in_parts() says of its points; nothing of other files, and
/// where the options leave some out. It may be wrong.
std::optional<ExpectedPoints> expected_points(const std::string& path, const PointFileOptions& options);

/// How many points the header of a file promises whose name ends with .las or .laz, also with .gz; nothing of
/// other files, and where that cannot be read.
std::optional<std::uint64_t> promised_points(const std::string& path);

/// Whether GDAL reads the file at `path`, as its name says or `format` asks.
bool is_read_by_gdal(const std::string& path, PointFormat format);

/// Where the coordinate system of the file at `path` may stand that has no place for it: points.prj for
/// points.csv and points.csv.gz.
std::filesystem::path projection_file_beside(const std::string& path);

/// Whether `path` has the ending of a format that holds points only, such as .las.
bool names_points(const std::string& path);

/// Whether `path` has the ending of a format whose points are numbers in binary, or may be: .npy, .ply, .f64
/// or .raw, also with .gz.
bool names_binary(const std::string& path);

/// The points of the file alone.
std::vector<Point> read_points(const std::string& path, const PointFileOptions& options = {});

}  // namespace polylidar::tool
