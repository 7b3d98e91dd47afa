#include "tool/commands/shape_output.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include "tool/points/point_file.hpp"
#include "tool/program/configuration_error.hpp"
#include "tool/program/letter_case.hpp"
#include "tool/program/result_output.hpp"

namespace polylidar::tool {
namespace {

constexpr std::string_view kGdal = "gdal:";
constexpr std::string_view kKnownEndings =
    "name it .geojson, .wkt, .wkb or .svg, or say with --format what it is";

std::string ending_of(const std::string& path) {
  return lower_case(std::filesystem::path(path).extension().string());
}

/// --format, or what the output's name says.
std::string format_of(const ShapeChoice& choice) {
  if (choice.format != "auto") return choice.format;
  if (is_for_gdal(choice.out)) return std::string(kGdal);
  const std::string ending = ending_of(choice.out);
  if (names_polygons(choice.out)) return ending == ".json" ? "geojson" : ending.substr(1);
  if (ending.empty() || names_points(choice.out)) return "geojson";  // the latter is refused, see below
  throw ConfigurationError("--out " + choice.out + ": the ending " + ending + " names no format; " +
                           std::string(kKnownEndings));
}

}  // namespace

ShapeOutput::ShapeOutput(const ShapeChoice& choice, const VectorFormats* formats)
    : path_(choice.out),
      formats_(formats),
      is_format_given_(choice.format != "auto"),
      text_format_(format_of(choice)) {
  if (!text_format_.starts_with(kGdal)) {
    if (!choice.out_layer.empty()) {
      throw ConfigurationError("--out-layer is for what GDAL writes, such as .gpkg; leave it out");
    }
    check_output_place(path_);
    return;
  }
  if (path_.empty()) {
    throw ConfigurationError("--format " + text_format_ + " needs a file or a database; give it by --out");
  }
  if (formats_ == nullptr) throw ConfigurationError(path_ + ": " + kNoGdalToWrite);
  by_gdal_ = VectorOutput{path_, text_format_.substr(kGdal.size()), choice.out_layer};
  text_format_ = "geojson";
  formats_->check(*by_gdal_);
}

void ShapeOutput::check_against(std::span<const std::string> inputs) const {
  check_is_none_of(path_, inputs);
  if (!is_format_given_ && names_points(path_)) {
    throw ConfigurationError("--out " + path_ + " has the ending of a file of points; " +
                             std::string(kKnownEndings));
  }
}

bool names_polygons(const std::string& path) {
  constexpr std::array<std::string_view, 5> kPolygonEndings = {".geojson", ".json", ".wkt", ".wkb", ".svg"};
  return std::find(kPolygonEndings.begin(), kPolygonEndings.end(), ending_of(path)) != kPolygonEndings.end();
}

void check_is_none_of(const std::string& out, std::span<const std::string> inputs) {
  std::error_code error;
  for (const std::string& input : inputs) {
    const std::string read = input == "-" ? "/dev/stdin" : input;
    if (std::filesystem::is_regular_file(out, error) && std::filesystem::equivalent(out, read, error)) {
      throw ConfigurationError("--out " + out + " would replace the points that are read; give another file");
    }
  }
}

bool ShapeOutput::holds_one_type() const {
  if (!by_gdal_) return false;
  const std::string ending = ending_of(path_);
  return by_gdal_->driver.empty() ? ending == ".shp" || ending == ".shz"
                                  : by_gdal_->driver == "ESRI Shapefile";
}

bool ShapeOutput::can_tell(const Crs& crs) const {
  return !crs.is_given || crs.epsg > 0 || (by_gdal_ && !crs.wkt.empty());
}

void ShapeOutput::write(std::string text, const Crs& crs, StatusLine& status) const {
  status.clear();
  // Standard output may be the same terminal.
  if (!path_.empty()) status.show("writing " + path_);
  if (by_gdal_) {
    formats_->write(*by_gdal_, std::move(text), crs);
  } else {
    write_result(path_, text);
  }
  status.clear();
}

}  // namespace polylidar::tool
