#include "tool/points/point_file.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "tool/gdal/vector_formats.hpp"
#include "tool/points/block_reader.hpp"
#include "tool/points/readers.hpp"
#include "tool/program/letter_case.hpp"

namespace polylidar::tool {
namespace {

using point_files::BlockReader;

struct Ending {
  std::string_view ending;
  PointFormat format;
};

constexpr std::array<Ending, 15> kEndings = {{{".csv", PointFormat::kCsv},
                                              {".tsv", PointFormat::kCsv},
                                              {".txt", PointFormat::kCsv},
                                              {".xyz", PointFormat::kXyz},
                                              {".pts", PointFormat::kXyz},
                                              {".asc", PointFormat::kXyz},
                                              {".geojson", PointFormat::kGeoJson},
                                              {".json", PointFormat::kGeoJson},
                                              {".wkt", PointFormat::kWkt},
                                              {".npy", PointFormat::kNpy},
                                              {".f64", PointFormat::kRaw},
                                              {".raw", PointFormat::kRaw},
                                              {".ply", PointFormat::kPly},
                                              {".las", PointFormat::kLas},
                                              {".laz", PointFormat::kLas}}};

/// What people may well give that is not read, by its first bytes.
struct Foreign {
  std::string_view start;
  const char* what;
};

constexpr std::array<Foreign, 8> kForeign = {
    {{"BZh", "it is compressed; give it unpacked, as in 'bzip2 -dc FILE | polylidar hull -'"},
     {"\x1F\x8B",
      "it is packed by gzip twice, or this was built without zlib; unpack it, as in 'gunzip -c FILE | "
      "polylidar hull -'"},
     {"\xFD\x37zXZ", "it is compressed; give it unpacked, as in 'xz -dc FILE | polylidar hull -'"},
     {"PK\x03\x04", "it is an archive (.zip or .npz); unpack it and give the file inside"},
     {"\xFF\xFE", "it is text in UTF-16; save it as UTF-8"},
     {"\xFE\xFF", "it is text in UTF-16; save it as UTF-8"},
     {"SQLite format 3",
      "it is a database of SQLite, such as a GeoPackage; name it .gpkg, or read it by 'polylidar hull "
      "--input gdal', in a build with GDAL"},
     {"%PDF", "it is a PDF; give a file of points"}}};

/// Whether `text` begins with a geometry's name followed by what may follow one, so that a header such as
/// "point,x,y" does not count.
bool looks_like_wkt(std::string_view text) {
  const std::string start = lower_case(std::string(text.substr(0, 64)));
  if (start.starts_with("srid=")) return true;
  for (const std::string_view name : {"point", "multipoint", "geometrycollection", "linestring", "polygon",
                                      "multilinestring", "multipolygon"}) {
    if (!start.starts_with(name)) continue;
    const std::size_t next = start.find_first_not_of(' ', name.size());
    const std::string_view rest = next == std::string::npos ? "" : std::string_view(start).substr(next);
    if (rest.starts_with('(') || rest.starts_with("empty") || rest.starts_with("z ") ||
        rest.starts_with("z(") || rest.starts_with("m ") || rest.starts_with("m(") ||
        rest.starts_with("zm")) {
      return true;
    }
  }
  return false;
}

/// Behind empty lines and comments.
std::string_view first_row(std::string_view start) {
  const auto skip_blanks = [&] {
    start.remove_prefix(std::min(start.find_first_not_of(" \t\r\n"), start.size()));
  };
  for (skip_blanks(); start.starts_with('#'); skip_blanks()) {
    start.remove_prefix(std::min(start.find('\n'), start.size()));
  }
  return start;
}

PointFormat format_of_content(std::string_view start) {
  if (start.starts_with("\x93NUMPY")) return PointFormat::kNpy;
  if (start.starts_with("ply\n") || start.starts_with("ply\r")) return PointFormat::kPly;
  start = first_row(start);
  if (start.starts_with('{') || start.starts_with('[')) return PointFormat::kGeoJson;
  return looks_like_wkt(start) ? PointFormat::kWkt : PointFormat::kCsv;
}

/// The format that the file's name says, if any, be it compressed or not.
PointFormat format_of_name(const std::filesystem::path& name) {
  const std::string last = lower_case(name.extension().string());
  const std::string ending = last == ".gz" ? lower_case(name.stem().extension().string()) : last;
  const auto known =
      std::find_if(kEndings.begin(), kEndings.end(), [&](const Ending& e) { return e.ending == ending; });
  return known == kEndings.end() ? PointFormat::kAuto : known->format;
}

PointFormat find_format(const std::string& path, BlockReader& reader) {
  const std::string_view start = reader.ahead();
  for (const Foreign& foreign : kForeign) {
    if (start.starts_with(foreign.start)) reader.fail(foreign.what);
  }
  if (start.starts_with("LASF")) return PointFormat::kLas;
  const PointFormat named = format_of_name(path);
  if (named != PointFormat::kAuto) return named;
  // A pipe may have given its first comment only.
  while (first_row(reader.ahead()).find_first_of("\n([{") == std::string_view::npos && reader.read_on()) {
  }
  return format_of_content(reader.ahead());
}

void read_as(PointFormat format, BlockReader& reader, PointFile& file) {
  switch (format) {
    case PointFormat::kGeoJson:
      return point_files::read_geojson_points(reader, file);
    case PointFormat::kWkt:
      return point_files::read_wkt_points(reader, file);
    case PointFormat::kNpy:
      return point_files::read_npy(reader, file);
    case PointFormat::kRaw:
      return point_files::read_raw(reader, file);
    case PointFormat::kPly:
      file.points = point_files::read_ply(reader);
      return;
    case PointFormat::kLas:
      return point_files::read_las(reader, file);
    case PointFormat::kXyz:
      return point_files::read_columns(reader, true, file);
    case PointFormat::kCsv:
    case PointFormat::kAuto:
    case PointFormat::kGdal:
      return point_files::read_columns(reader, false, file);
  }
}

/// Refuses options that the format cannot obey.
void check_options(PointFormat format, const BlockReader& reader) {
  const PointFileOptions& options = reader.options();
  const bool is_text = format == PointFormat::kCsv || format == PointFormat::kXyz;
  if (!options.layer.empty()) {
    reader.fail("--layer is for what GDAL reads, and this file is read without it; leave --layer out");
  }
  if (!options.columns.empty() && !is_text) {
    reader.fail("--columns is for columns of text, and this file has none; leave --columns out");
  }
  if (!options.by.empty() && !is_text && format != PointFormat::kLas && format != PointFormat::kGeoJson) {
    reader.fail(
        "--by is for columns of text, GeoJSON and LAS, and this file is none of these; leave --by out");
  }
  if (options.take_points && !options.whole_if_needed && !is_text && format != PointFormat::kLas &&
      format != PointFormat::kNpy && format != PointFormat::kRaw) {
    reader.fail("--stream is for LAS, columns of text, NumPy's arrays and raw doubles; leave --stream out");
  }
  if ((options.returns != Returns::kAll || options.classes) && format != PointFormat::kLas) {
    reader.fail("--returns and --classes are for LAS, and this file is not; leave them out");
  }
}

/// Many files have no place for their coordinate system; Esri's programs put it beside.
void read_projection_beside(const std::string& path, PointFile& file) {
  constexpr std::streamsize kLongest = 1 << 16;
  std::ifstream stream(projection_file_beside(path), std::ios::binary);
  std::string text(kLongest, '\0');
  stream.read(text.data(), kLongest);
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.starts_with(point_files::kByteOrderMark)) text.erase(0, point_files::kByteOrderMark.size());
  if (const std::optional<Crs> crs = crs_of_wkt(text)) file.crs = *crs;
}

/// LAS, text, GeoJSON and what is streamed choose points as they come; others have been read whole.
void keep_window(const Box& window, PointFile& file) {
  std::erase_if(file.points, [&](const Point& p) { return !point_files::is_inside(p, window); });
}

PointFile read_from(BlockReader& reader, const std::string& path) {
  if (reader.peek() == BlockReader::kEnd) reader.fail("it is empty; give a file with at least one point");
  const PointFormat asked = reader.options().format;
  const PointFormat format = asked == PointFormat::kAuto ? find_format(path, reader) : asked;
  check_options(format, reader);
  PointFile file;
  read_as(format, reader, file);
  const bool is_text = format == PointFormat::kCsv || format == PointFormat::kXyz;
  if (reader.options().window && !is_text && format != PointFormat::kLas && format != PointFormat::kGeoJson) {
    keep_window(*reader.options().window, file);
  }
  // What was not while it was read.
  point_files::hand_on(file, reader.options(), true);
  if (path != "-" && file.crs == Crs()) read_projection_beside(path, file);
  return file;
}

}  // namespace

std::optional<PointFormat> point_format_of(const std::string& name) {
  if (name == "auto") return PointFormat::kAuto;
  if (name == "csv") return PointFormat::kCsv;
  if (name == "xyz") return PointFormat::kXyz;
  if (name == "geojson") return PointFormat::kGeoJson;
  if (name == "wkt") return PointFormat::kWkt;
  if (name == "npy") return PointFormat::kNpy;
  if (name == "raw") return PointFormat::kRaw;
  if (name == "ply") return PointFormat::kPly;
  if (name == "las") return PointFormat::kLas;
  if (name == "gdal") return PointFormat::kGdal;
  return {};
}

bool is_read_by_gdal(const std::string& path, PointFormat format) {
  return format == PointFormat::kGdal || (format == PointFormat::kAuto && is_for_gdal(path));
}

std::filesystem::path projection_file_beside(const std::string& path) {
  std::filesystem::path beside = path;
  if (lower_case(beside.extension().string()) == ".gz") beside.replace_extension();
  return beside.replace_extension(".prj");
}

PointFile read_point_file(const std::string& path, const PointFileOptions& options) {
  if (options.format == PointFormat::kAuto && format_of_name(path) == PointFormat::kRaw) {
    // Known before the first byte is looked at: any bytes may be a coordinate.
    PointFileOptions raw = options;
    raw.format = PointFormat::kRaw;
    return read_point_file(path, raw);
  }
  if (is_read_by_gdal(path, options.format)) {
    if (options.vector_formats == nullptr) throw PointFileError(path + ": " + kNoGdalToRead);
    return options.vector_formats->read(path, options);
  }
  BlockReader reader(path, options);
  return read_from(reader, path);
}

bool is_read_in_parts(const std::string& path, const PointFileOptions& options) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return false;
  if (is_read_by_gdal(path, options.format)) return false;
  PointFileOptions of_start = options;
  if (of_start.format == PointFormat::kAuto && format_of_name(path) == PointFormat::kRaw) {
    of_start.format = PointFormat::kRaw;
  }
  try {
    BlockReader reader(path, of_start);
    if (!reader.remaining()) return false;
    const PointFormat format =
        of_start.format == PointFormat::kAuto ? find_format(path, reader) : of_start.format;
    if (format == PointFormat::kRaw || format == PointFormat::kLas) return true;
    return format == PointFormat::kNpy &&
           reader.ahead().substr(0, 256).find("'fortran_order': False") != std::string_view::npos;
  } catch (const PointFileError&) {
    return false;
  }
}

std::optional<ExpectedPoints> expected_points(const std::string& path, const PointFileOptions& options) {
  constexpr std::uint64_t kLeastLasRecord = 20;  // bytes of a point
  constexpr std::uint64_t kUsualLazRecord = 1;   // few points take less
  if (!point_files::takes_all_points(options) || !is_read_in_parts(path, options)) return {};
  try {
    BlockReader reader(path, options);
    const std::optional<ExpectedPoints> expected = point_files::expected_points_of_las(reader.ahead());
    // A map for so many points is made before the first one is read.
    const std::uint64_t least = point_files::is_laz(reader.ahead()) ? kUsualLazRecord : kLeastLasRecord;
    const bool is_possible = expected && expected->count <= reader.remaining().value_or(0) / least;
    return is_possible ? expected : std::nullopt;
  } catch (const PointFileError&) {
    return {};
  }
}

std::optional<std::uint64_t> promised_points(const std::string& path) {
  std::error_code error;
  if (format_of_name(path) != PointFormat::kLas || !std::filesystem::is_regular_file(path, error)) return {};
  try {
    const PointFileOptions options;
    BlockReader reader(path, options);
    return point_files::promised_points_of_las(reader.ahead());
  } catch (const PointFileError&) {
    return {};
  }
}

bool names_points(const std::string& path) {
  const PointFormat format = format_of_name(path);
  return format != PointFormat::kAuto && format != PointFormat::kGeoJson && format != PointFormat::kWkt;
}

bool names_binary(const std::string& path) {
  const PointFormat format = format_of_name(path);
  return format == PointFormat::kNpy || format == PointFormat::kPly || format == PointFormat::kRaw;
}

std::vector<Point> read_points(const std::string& path, const PointFileOptions& options) {
  return read_point_file(path, options).points;
}

}  // namespace polylidar::tool
