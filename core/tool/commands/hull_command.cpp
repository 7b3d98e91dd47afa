// `polylidar hull FILE`: from anybody's points to polygons.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>
#include <vector>

#include "polylidar/point_locator.hpp"
#include "tool/commands/commands.hpp"
#include "tool/commands/run_command.hpp"
#include "tool/commands/shape_choice.hpp"
#include "tool/commands/shape_output.hpp"
#include "tool/commands/streamed_hull.hpp"
#include "tool/points/numbers.hpp"
#include "tool/program/configuration_error.hpp"
#include "tool/program/interrupt.hpp"
#include "tool/program/status_line.hpp"

namespace polylidar::tool {
namespace {

std::string name_of(const HullCommand& command) {
  if (command.inputs.size() > 1) return "the " + std::to_string(command.inputs.size()) + " files";
  return command.inputs.front() == "-" ? "standard input" : command.inputs.front();
}

/// One run of the command.
class HullRun {
 public:
  HullRun(const HullCommand& command, const Surroundings& surroundings)
      : command_(command),
        surroundings_(surroundings),
        status_(surroundings.err, surroundings.terminal, quiet_time(surroundings.terminal)),
        output_(command.shape, surroundings, kAllFormats) {}

  ExitCode run() {
    check_options();
    read();
    compute();
    throw_if_interrupted();
    if (command_.by.empty()) {
      explain(hulls_.groups[0]);
    } else {
      explain_groups();
    }
    show("making the result");
    output_.write(result(), crs_, status_);
    return kExitOk;
  }

 private:
  void check_options() const {
    chosen_crs(command_.shape, {});
    output_.check_against(command_.inputs);
    if (command_.inputs.size() > 1) {
      throw ConfigurationError(
          "several files are one set of points with --stream only; give that, or ask 'polylidar "
          "footprint --union'");
    }
    for (const auto& [option, is_given] :
         {std::pair("--shard", !command_.shard.empty()), std::pair("--memory", command_.shape.memory > 0)}) {
      if (!is_given) continue;
      throw ConfigurationError(std::string(option) + " is for what --stream reads; add --stream, or leave " +
                               option + " out");
    }
    if (command_.keep_outliers && output_.holds_one_type()) {
      throw ConfigurationError(
          "--keep-outliers gives points beside polygons, and a Shapefile holds one of the two; name it "
          ".gpkg");
    }
    if (output_.has_features()) return;
    if (!command_.by.empty() && output_.text_format() != "svg") {
      throw ConfigurationError("--by gives one feature for each group, which " + output_.text_format() +
                               " cannot tell apart; ask for --format geojson or svg");
    }
    if (command_.keep_outliers) {
      throw ConfigurationError(
          "--keep-outliers gives a feature of its own, which only --format geojson has, or one of GDAL");
    }
  }

  /// Nothing if the text is empty.
  void say(const std::string& text) {
    if (!text.empty()) status_.say(surroundings_.program + ": " + text);
  }

  void show(const std::string& doing) {
    throw_if_interrupted();
    status_.show(doing);
  }

  void read() {
    PointFileOptions options = point_options(command_.shape, surroundings_);
    options.by = command_.by;
    options.on_progress = [&](std::uint64_t bytes, std::optional<std::uint64_t> size) {
      show(reading(bytes, size));
    };
    file_ = read_point_file(command_.inputs.front(), options);
    say(file_.note);
    crs_ = chosen_crs(command_.shape, file_.crs);
    are_numbers_ = are_numbers(file_.labels);
  }

  void compute() {
    if (command_.keep_outliers) check_magnitude(file_.points);
    show("triangulating " + std::to_string(file_.points.size()) + " points");
    hulls_ = locate_hulls(file_, command_.shape, !command_.by.empty(), thread_count(command_.shape),
                          [&](const std::string& doing) { show(doing); });
    const Box box = bounding_box(file_.points);
    say(crs_note(command_.shape, crs_, box, output_));
    if (!hulls_.latitude) return;
    say("longitude and latitude: lengths are in metres, true at latitude " +
        shortest(std::round(*hulls_.latitude * 100) / 100 + 0.0) +
        ", and areas are those on the sphere; --crs none takes degrees as they are");
    if (spans_date_line(box)) say(std::string(kSpansDateLine));
  }

  /// What was chosen, or why there is nothing.
  void explain(const GroupHull& hull) {
    say(limit_in_words(hull.sizes, hull.by_outlines, command_.shape.hull.wanted));
    if (!hull.shape.empty()) return;
    if (hull.extracted > 0) {
      return say("no polygon is left by --min-area and --min-triangles, so the shape is empty");
    }
    if (hull.points == 0) return say(no_points(command_.shape, name_of(command_)));
    say(hull.has_triangles
            ? "no triangle of the points is kept, so the shape is empty; larger limits "
              "give more"
            : "there are no three distinct points that are not on one line, so the shape is empty");
  }

  void explain_groups() {
    const auto empty = std::count_if(hulls_.groups.begin(), hulls_.groups.end(),
                                     [](const GroupHull& hull) { return hull.shape.empty(); });
    const std::size_t count = hulls_.groups.size();
    if (count == 0) return say(no_points(command_.shape, name_of(command_)));
    say(std::to_string(count) + (count == 1 ? " group" : " groups") +
        (empty > 0 ? "; of " + std::to_string(empty) + " the shape is empty" : ""));
  }

  std::string result() const {
    if (output_.has_features()) return geojson();
    MultiPolygon shape;
    for (const GroupHull& hull : hulls_.groups) {
      for (Polygon& polygon : to_coordinates(hull.shape, file_.points)) shape.push_back(std::move(polygon));
    }
    if (output_.text_format() == "wkt") return to_wkt(shape);
    if (output_.text_format() == "svg") return to_svg(shape, file_.points);
    return to_wkb(shape);
  }

  std::string geojson() const {
    if (command_.by.empty() && !command_.keep_outliers) {
      return geojson_feature(properties_of(0), to_coordinates(hulls_.groups[0].shape, file_.points),
                             geojson_crs(crs_)) +
             "\n";
    }
    std::vector<std::string> features;
    for (std::size_t g = 0; g < hulls_.groups.size(); ++g) {
      features.push_back(
          geojson_feature(properties_of(g), to_coordinates(hulls_.groups[g].shape, file_.points)));
      if (command_.keep_outliers) add_outliers(g, features);
    }
    return geojson_collection(features, geojson_crs(crs_));
  }

  Properties properties_of(std::size_t g) const {
    Properties properties;
    add_label(g, properties);
    properties.add("points", hulls_.groups[g].points);
    add_shape_properties(hulls_.groups[g], properties);
    return properties;
  }

  void add_outliers(std::size_t g, std::vector<std::string>& features) const {
    const std::vector<Point>& plane = hulls_.latitude ? hulls_.metres : file_.points;
    const PointLocator locator(to_coordinates(hulls_.groups[g].shape, plane));
    std::vector<Point> outside;
    const auto look_at = [&](std::size_t i) {
      if (!locator.contains(plane[i])) outside.push_back(file_.points[i]);
    };
    if (command_.by.empty()) {
      for (std::size_t i = 0; i < plane.size(); ++i) look_at(i);
    } else {
      for (const std::uint32_t i : hulls_.groups[g].members) look_at(i);
    }
    if (outside.empty()) return;
    Properties properties;
    add_label(g, properties);
    properties.add("outside", outside.size());
    features.push_back(geojson_feature(properties, outside));
  }

  void add_label(std::size_t g, Properties& properties) const {
    if (command_.by.empty()) return;
    const std::string& label = file_.labels[g];
    if (are_numbers_) {
      properties.add_json("label", label);
    } else {
      properties.add("label", std::string_view(label));
    }
  }

  /// Whether all labels are numbers as JSON writes them: 7, 200000 and -0.5, but not 007 or 1e5.
  static bool are_numbers(const std::vector<std::string>& labels) {
    return std::all_of(labels.begin(), labels.end(), [](const std::string& label) {
      double value = 0;
      const char* const last = label.data() + label.size();
      const auto [end, error] = std::from_chars(label.data(), last, value, std::chars_format::fixed);
      const bool is_number = error == std::errc() && end == last && std::isfinite(value);
      return is_number && label == point_files::plain_decimal(value);
    });
  }

  const HullCommand& command_;
  const Surroundings& surroundings_;
  StatusLine status_;
  ShapeOutput output_;
  PointFile file_;
  Crs crs_;
  LocatedHulls hulls_;
  bool are_numbers_ = false;
};

}  // namespace

ExitCode make_hull(const HullCommand& command, const Surroundings& surroundings) {
  return run_command(name_of(command), [&] {
    return command.stream ? stream_hull(command, surroundings) : HullRun(command, surroundings).run();
  });
}

void add_hull_options(CLI::App& app, HullCommand& command) {
  app.description("Turn a file of points into polygons");
  app.footer(
      "Without --alpha, --max-edge-length and --max-perimeter the program chooses the largest size of a "
      "triangle\n"
      "from the points. It varies from place to place with their density, and its range is printed to "
      "standard\n"
      "error. The size of an equilateral triangle is the length of its edge. The shape may be empty.\n"
      "The program tells the input's format by the ending of its name (.csv .tsv .txt .xyz .pts .asc "
      ".geojson\n"
      ".json .wkt .npy .ply .las .laz, also with .gz; .f64 and .raw are little-endian doubles x, y and "
      "nothing\n"
      "else), else by its content.\n"
      "Lengths are in the unit of the points, or in metres if these are longitudes and latitudes.\n" +
      std::string(kGdalHelp));
  app.add_option("FILE", command.inputs, "The points; - for standard input; several with --stream")
      ->required();
  app.add_option(
      "--by", command.by,
      "Make one shape for each value of this column of a text file or a layer, by its name or its "
      "number from 1; of this property of GeoJSON; for a LAS file: classification, return or point_source");
  add_format_option(app, command.shape, kAllFormats);
  app.add_flag("--keep-outliers", command.keep_outliers,
               "Also write the points outside the shape, as a MultiPoint (geojson, or a format of GDAL but "
               "Shapefile)");
  app.add_flag(
      "--stream", command.stream,
      "Read the files up to seven times instead of keeping all points in memory; only for LAS, LAZ, text, "
      "NumPy and raw doubles");
  add_memory_option(app, command.shape, "With --stream, the most memory");
  app.add_option("--shard", command.shard,
                 "With --stream, write only what shard K of N finds, such as 2/7, for 'polylidar merge': N "
                 "machines each need an Nth of the memory");
  add_shape_options(app, command.shape);
}

}  // namespace polylidar::tool
