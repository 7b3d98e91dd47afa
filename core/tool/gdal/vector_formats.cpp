#include "tool/gdal/vector_formats.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <string_view>

#include "tool/program/letter_case.hpp"

namespace polylidar::tool {
namespace {

/// Of files that nobody but GDAL reads or writes here. Others are named by --input and --format.
constexpr std::array<std::string_view, 17> kEndings = {
    ".gpkg", ".shp", ".shz", ".fgb",    ".parquet", ".arrow", ".gml", ".kml",     ".kmz",
    ".gpx",  ".gdb", ".tab", ".sqlite", ".mif",     ".dxf",   ".vrt", ".geojsonl"};

/// In front of what is no file.
constexpr std::array<std::string_view, 8> kBeginnings = {
    "pg:", "postgresql:", "mysql:", "mssql:", "oapif:", "wfs:", "es:", "/vsi"};

}  // namespace

bool is_database(const std::string& path) {
  const auto is_of_name = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  const auto colon = std::find_if_not(path.begin(), path.end(), is_of_name);
  // One letter is a drive.
  if (colon - path.begin() < 2 || colon == path.end() || *colon != ':') return false;
  std::error_code error;
  return !std::filesystem::exists(path, error);
}

bool is_for_gdal(const std::string& path) {
  const std::string ending = lower_case(std::filesystem::path(path).extension().string());
  if (std::find(kEndings.begin(), kEndings.end(), ending) != kEndings.end()) return true;
  const std::string start = lower_case(path.substr(0, 16));
  return std::any_of(kBeginnings.begin(), kBeginnings.end(),
                     [&](std::string_view beginning) { return start.starts_with(beginning); });
}

}  // namespace polylidar::tool
