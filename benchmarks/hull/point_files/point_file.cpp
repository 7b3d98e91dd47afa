#include "benchmarks/hull/point_files/point_file.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <string_view>

#include "benchmarks/hull/point_files/block_reader.hpp"
#include "benchmarks/hull/point_files/readers.hpp"

namespace hullbench::hull {
namespace {

using point_files::BlockReader;
using polylidar::Point;

struct Ending {
  std::string_view ending;
  PointFormat format;
};

constexpr std::array<Ending, 11> kEndings = {{{".csv", PointFormat::kCsv},
                                              {".tsv", PointFormat::kCsv},
                                              {".txt", PointFormat::kCsv},
                                              {".xyz", PointFormat::kXyz},
                                              {".pts", PointFormat::kXyz},
                                              {".asc", PointFormat::kXyz},
                                              {".geojson", PointFormat::kGeoJson},
                                              {".json", PointFormat::kGeoJson},
                                              {".wkt", PointFormat::kWkt},
                                              {".npy", PointFormat::kNpy},
                                              {".ply", PointFormat::kPly}}};

/// What people may well give that is not read, by its first bytes.
struct Foreign {
  std::string_view start;
  const char* what;
};

constexpr std::array<Foreign, 7> kForeign = {
    {{"LASF", "it is a LAS file; convert it first, for example with 'las2txt --parse xyz'"},
     {"\x1F\x8B", "it is compressed; give it unpacked, as in 'gunzip -c FILE | hullbench hull -'"},
     {"\xFD\x37zXZ", "it is compressed; give it unpacked, as in 'xz -dc FILE | hullbench hull -'"},
     {"PK\x03\x04", "it is an archive (.zip or .npz); unpack it and give the file inside"},
     {"\xFF\xFE", "it is text in UTF-16; save it as UTF-8"},
     {"\xFE\xFF", "it is text in UTF-16; save it as UTF-8"},
     {"%PDF", "it is a PDF; give a file of points"}}};

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// Whether `text` begins with a geometry's name followed by what may follow one, so that a header such as
/// "point,x,y" does not count.
bool looks_like_wkt(std::string_view text) {
  const std::string start = lower(std::string(text.substr(0, 64)));
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

PointFormat format_of_content(std::string_view start) {
  if (start.starts_with("\x93NUMPY")) return PointFormat::kNpy;
  if (start.starts_with("ply\n") || start.starts_with("ply\r")) return PointFormat::kPly;
  const auto skip_blanks = [&] {
    start.remove_prefix(std::min(start.find_first_not_of(" \t\r\n"), start.size()));
  };
  for (skip_blanks(); start.starts_with('#'); skip_blanks()) {
    start.remove_prefix(std::min(start.find('\n'), start.size()));
  }
  if (start.starts_with('{') || start.starts_with('[')) return PointFormat::kGeoJson;
  return looks_like_wkt(start) ? PointFormat::kWkt : PointFormat::kCsv;
}

PointFormat find_format(const std::string& path, BlockReader& reader) {
  const std::string_view start = reader.ahead();
  for (const Foreign& foreign : kForeign) {
    if (start.starts_with(foreign.start)) reader.fail(foreign.what);
  }
  const std::string ending = lower(std::filesystem::path(path).extension().string());
  const auto known =
      std::find_if(kEndings.begin(), kEndings.end(), [&](const Ending& e) { return e.ending == ending; });
  return known == kEndings.end() ? format_of_content(start) : known->format;
}

std::vector<Point> read_as(PointFormat format, BlockReader& reader) {
  switch (format) {
    case PointFormat::kGeoJson:
      return point_files::read_geojson_points(reader);
    case PointFormat::kWkt:
      return point_files::read_wkt_points(reader);
    case PointFormat::kNpy:
      return point_files::read_npy(reader);
    case PointFormat::kPly:
      return point_files::read_ply(reader);
    case PointFormat::kXyz:
      return point_files::read_columns(reader, true);
    case PointFormat::kCsv:
    case PointFormat::kAuto:
      break;
  }
  return point_files::read_columns(reader, false);
}

}  // namespace

std::optional<PointFormat> point_format_of(const std::string& name) {
  if (name == "auto") return PointFormat::kAuto;
  if (name == "csv") return PointFormat::kCsv;
  if (name == "xyz") return PointFormat::kXyz;
  if (name == "geojson") return PointFormat::kGeoJson;
  if (name == "wkt") return PointFormat::kWkt;
  if (name == "npy") return PointFormat::kNpy;
  if (name == "ply") return PointFormat::kPly;
  return {};
}

std::vector<Point> read_points(const std::string& path, const PointFileOptions& options) {
  BlockReader reader(path, options);
  if (reader.peek() == BlockReader::kEnd) reader.fail("it is empty; give a file with at least one point");
  const PointFormat format =
      options.format == PointFormat::kAuto ? find_format(path, reader) : options.format;
  if (!options.columns.empty() && format != PointFormat::kCsv && format != PointFormat::kXyz) {
    reader.fail("--columns is for columns of text, and this file has none; leave --columns out");
  }
  return read_as(format, reader);
}

}  // namespace hullbench::hull
