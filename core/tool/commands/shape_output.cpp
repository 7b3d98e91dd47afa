#include "tool/commands/shape_output.hpp"

#include <algorithm>
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

/// --format, or what the output's name says.
std::string format_of(const ShapeChoice& choice) {
  if (choice.format != "auto") return choice.format;
  if (is_for_gdal(choice.out)) return std::string(kGdal);
  const std::string ending = lower_case(std::filesystem::path(choice.out).extension().string());
  return ending == ".wkt" || ending == ".wkb" || ending == ".svg" ? ending.substr(1) : "geojson";
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
  static const std::string kStandardInput = "/dev/stdin";
  std::error_code error;
  for (const std::string& input : inputs) {
    const std::string& read = input == "-" ? kStandardInput : input;
    if (std::filesystem::is_regular_file(path_, error) && std::filesystem::equivalent(path_, read, error)) {
      throw ConfigurationError("--out " + path_ +
                               " would replace the points that are read; give another file");
    }
  }
  if (!is_format_given_ && names_points(path_)) {
    throw ConfigurationError(
        "--out " + path_ +
        " has the ending of a file of points; name it .geojson, .wkt, .wkb or .svg, or say "
        "with --format what it is");
  }
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
