// Where polygons go, and as what.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tool/commands/commands.hpp"
#include "tool/commands/shape_choice.hpp"
#include "tool/gdal/vector_formats.hpp"
#include "tool/points/crs.hpp"
#include "tool/points/point_file.hpp"
#include "tool/program/status_line.hpp"
#include "tool/program/surroundings.hpp"

namespace polylidar::tool {

/// Whether the ending of `path` is that of a format of polygons that is written here.
bool names_polygons(const std::string& path);

/// Throws ConfigurationError where `out` is one of the files that are read, or the .prj file beside one.
void check_is_none_of(const std::string& out, std::span<const std::string> inputs);

/// What --format, --out and --out-layer ask for.
class ShapeOutput {
 public:
  /// `formats` are those that a message offers. Throws ConfigurationError where the output cannot be,
  /// std::runtime_error where no file can be written there.
  ShapeOutput(const ShapeChoice& choice, const Surroundings& surroundings, Formats formats);

  /// Throws ConfigurationError where the result would replace one of the files that are read, a part of one
  /// or what says its coordinate system, or look like a file of points.
  void check_against(std::span<const std::string> inputs) const;

  /// What write() takes: "geojson", "wkt", "wkb" or "svg".
  const std::string& text_format() const { return text_format_; }
  /// Whether it has features with properties.
  bool has_features() const { return text_format_ == "geojson"; }
  /// Whether all features are of one type, as in a Shapefile.
  bool holds_one_type() const;
  /// Whether the result says in which coordinate system it is, as far as its format has a place for it, or
  /// there is nothing to say.
  bool can_tell(const Crs& crs) const;

  /// The whole result, or nothing of it; `status` shows that, and says what is lost in the format. Throws
  /// std::runtime_error and Interrupted, as ResultOutput, and ConfigurationError where the format cannot hold
  /// a label.
  void write(std::string text, const Crs& crs, StatusLine& status) const;

 private:
  void check_is_no_part_of(const std::string& input) const;

  std::string program_;
  std::string path_;
  Formats offered_;
  PointFormat input_format_;
  const VectorFormats* formats_;
  bool is_format_given_;
  std::string text_format_;
  std::optional<VectorOutput> by_gdal_;
  std::vector<std::string> replaced_;  ///< files that the result takes the place of, be they there or not
};

/// What is said where a result cannot tell its system, as GeoJSON names one by its number only.
inline constexpr std::string_view kNamelessCrs =
    "the coordinate system has no EPSG number that is known here, so that the result names none; --crs gives "
    "it one";

/// What is to be said of the coordinate system of points in `box`; empty: nothing.
std::string crs_note(const ShapeChoice& choice, const Crs& crs, const Box& box, const ShapeOutput& output);

}  // namespace polylidar::tool
