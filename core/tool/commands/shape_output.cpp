#include "tool/commands/shape_output.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>
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
/// The most that is told of what a format lacks.
constexpr std::size_t kMostNotes = 10;

std::string ending_of(const std::string& path) {
  return lower_case(std::filesystem::path(path).extension().string());
}

/// "name it .geojson, .wkt or .wkb", and what else helps.
std::string right_names(Formats formats) {
  std::string endings;
  for (std::size_t f = 0; f < formats.size(); ++f) {
    endings += (f == 0 ? "." : f + 1 < formats.size() ? ", ." : " or .") + std::string(formats[f]);
  }
  return "name it " + endings + ", or say with --format what it is";
}

/// --format, or what the output's name says.
std::string format_of(const ShapeChoice& choice, Formats offered) {
  if (choice.format != "auto") return choice.format;
  if (is_for_gdal(choice.out)) return std::string(kGdal);
  const std::string ending = ending_of(choice.out);
  if (names_polygons(choice.out)) return ending == ".json" ? "geojson" : ending.substr(1);
  if (ending.empty() || names_points(choice.out)) return "geojson";  // the latter is refused, see below
  throw ConfigurationError("--out " + choice.out + ": the ending " + ending + " names no format; " +
                           right_names(offered));
}

[[noreturn]] void fail_as_read(const std::string& out, const std::string& lost, const std::string& input) {
  throw ConfigurationError("--out " + out + " would replace " + lost + ", which is read with " + input +
                           "; give another file");
}

}  // namespace

ShapeOutput::ShapeOutput(const ShapeChoice& choice, const Surroundings& surroundings, Formats formats)
    : program_(surroundings.program),
      path_(choice.out),
      offered_(formats),
      input_format_(point_format_of(choice.input_format).value_or(PointFormat::kAuto)),
      formats_(surroundings.vector_formats),
      is_format_given_(choice.format != "auto"),
      text_format_(format_of(choice, formats)),
      replaced_{path_} {
  if (!text_format_.starts_with(kGdal)) {
    if (!choice.out_layer.empty()) {
      throw ConfigurationError("--out-layer is for what GDAL writes, such as .gpkg; leave it out");
    }
    check_output_place(path_);
    return;
  }
  if (is_standard_output(path_)) {
    throw ConfigurationError("--format " + text_format_ + " needs a file or a database; give it by --out");
  }
  if (formats_ == nullptr) throw ConfigurationError(path_ + ": " + kNoGdalToWrite);
  by_gdal_ = VectorOutput{path_, text_format_.substr(kGdal.size()), choice.out_layer};
  text_format_ = "geojson";
  for (std::string& file : formats_->check(*by_gdal_)) replaced_.push_back(std::move(file));
}

void ShapeOutput::check_against(std::span<const std::string> inputs) const {
  check_is_none_of(path_, inputs);
  for (const std::string& input : inputs) check_is_no_part_of(input);
  if (!is_format_given_ && names_points(path_)) {
    throw ConfigurationError("--out " + path_ + " has the ending of a file of points; " +
                             right_names(offered_));
  }
}

/// A Shapefile is several files, and so may be what is read.
void ShapeOutput::check_is_no_part_of(const std::string& input) const {
  std::error_code error;
  std::vector<std::string> there;
  std::copy_if(replaced_.begin(), replaced_.end(), std::back_inserter(there),
               [&](const std::string& file) { return std::filesystem::is_regular_file(file, error); });
  // What a pipe gives can be read once only.
  const bool is_file =
      std::filesystem::is_regular_file(input, error) || std::filesystem::is_directory(input, error);
  if (there.empty() || !is_file) return;
  std::vector<std::string> read = {input};
  // The .prj of a Shapefile that is replaced is its own: the same command may run again.
  if (!by_gdal_ || !std::filesystem::exists(path_, error))
    read.push_back(projection_file_beside(input).string());
  if (formats_ != nullptr && is_read_by_gdal(input, input_format_)) {
    for (std::string& file : formats_->files_of(input)) read.push_back(std::move(file));
  }
  const auto lost = std::find_if(there.begin(), there.end(), [&](const std::string& file) {
    return std::any_of(read.begin(), read.end(), [&](const std::string& part) {
      return std::filesystem::equivalent(file, part, error);
    });
  });
  if (lost != there.end()) fail_as_read(path_, *lost, input);
}

bool names_polygons(const std::string& path) {
  constexpr std::array<std::string_view, 5> kPolygonEndings = {".geojson", ".json", ".wkt", ".wkb", ".svg"};
  return std::find(kPolygonEndings.begin(), kPolygonEndings.end(), ending_of(path)) != kPolygonEndings.end();
}

void check_is_none_of(const std::string& out, std::span<const std::string> inputs) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(out, error)) return;
  for (const std::string& input : inputs) {
    if (std::filesystem::equivalent(out, input == "-" ? "/dev/stdin" : input, error)) {
      throw ConfigurationError("--out " + out + " would replace the points that are read; give another file");
    }
    if (std::filesystem::equivalent(out, projection_file_beside(input), error)) fail_as_read(out, out, input);
  }
}

bool ShapeOutput::holds_one_type() const {
  if (!by_gdal_) return false;
  const std::string ending = ending_of(path_);
  return by_gdal_->driver.empty() ? ending == ".shp" || ending == ".shz"
                                  : equal_in_any_case(by_gdal_->driver, "ESRI Shapefile");
}

bool ShapeOutput::can_tell(const Crs& crs) const {
  return !has_features() || !crs.is_given || crs.epsg > 0 || (by_gdal_ && !crs.wkt.empty());
}

std::string crs_note(const ShapeChoice& choice, const Crs& crs, const Box& box, const ShapeOutput& output) {
  if (!output.can_tell(crs)) return std::string(kNamelessCrs);
  return unknown_crs_note(choice, crs, box, output.has_features());
}

void ShapeOutput::write(std::string text, const Crs& crs, StatusLine& status) const {
  status.clear();
  // Standard output may be the same terminal.
  if (!path_.empty()) status.show("writing " + path_);
  if (by_gdal_) {
    const std::vector<std::string> notes = formats_->write(*by_gdal_, std::move(text), crs);
    status.clear();
    for (std::size_t n = 0; n < std::min(notes.size(), kMostNotes); ++n)
      status.say(program_ + ": " + path_ + ": " + notes[n]);
    if (notes.size() > kMostNotes) {
      status.say(program_ + ": " + path_ + ": there are " + std::to_string(notes.size() - kMostNotes) +
                 " more warnings of GDAL");
    }
  } else {
    write_result(path_, text);
  }
  status.clear();
}

}  // namespace polylidar::tool
