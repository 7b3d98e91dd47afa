#include "tool/commands/shape_choice.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>
#include <thread>

#include "tool/commands/file_work.hpp"
#include "tool/hull/degrees.hpp"
#include "tool/program/configuration_error.hpp"
#include "tool/program/free_memory.hpp"

namespace polylidar::tool {
namespace {

/// What is said where the shape is what walls enclose.
constexpr std::string_view kOnlyOutlines =
    "the points lie on outlines only, and the shape is what these enclose; --detail below 1 closes wider "
    "gaps, ";

/// A number that `fits`; `words` say which are, `shown` says it in help.
CLI::Validator number_that(bool (*fits)(double), const std::string& words, const std::string& shown) {
  return {[fits, words](const std::string& text) {
            double value = 0;
            const bool is_one = CLI::detail::lexical_cast(text, value) && fits(value);
            return is_one ? std::string() : "'" + text + "' is not a number " + words;
          },
          shown};
}

CLI::Validator zero_or_more() {
  return number_that([](double value) { return value >= 0 && std::isfinite(value); }, "of 0 or more", ">=0");
}

/// A limit; infinity is none, as in the core.
CLI::Validator zero_or_more_or_inf() {
  return number_that([](double value) { return value >= 0; }, "of 0 or more, or inf", ">=0 or inf");
}

CLI::Validator above_zero() {
  return number_that([](double value) { return value > 0 && std::isfinite(value); }, "above 0", ">0");
}

/// The whole text as numbers between commas; empty when it is none.
template <class Number>
std::vector<Number> numbers_of(std::string_view text) {
  std::vector<Number> numbers;
  for (;;) {
    Number number{};
    const char* const end = text.data() + text.size();
    const auto [next, error] = std::from_chars(text.data(), end, number);
    if (error != std::errc() || (next != end && *next != ',')) return {};
    numbers.push_back(number);
    if (next == end) return numbers;
    text.remove_prefix(static_cast<std::size_t>(next - text.data()) + 1);
  }
}

CLI::Validator whole_number_from(std::size_t least) {
  const std::string from = std::to_string(least);
  return {[least, from](const std::string& text) {
            const std::vector<std::size_t> numbers = numbers_of<std::size_t>(text);
            const bool is_one = numbers.size() == 1 && numbers[0] >= least;
            return is_one ? std::string() : "'" + text + "' is not a whole number from " + from + " on";
          },
          ">=" + from};
}

}  // namespace

void add_shape_options(CLI::App& app, ShapeChoice& choice) {
  HullOptions& hull = choice.hull;
  app.add_option("--alpha", hull.core.alpha, "Largest circumradius of a triangle of the shape; inf: no limit")
      ->check(zero_or_more_or_inf());
  app.add_option("--max-edge-length", hull.core.max_edge_length,
                 "Longest edge of a triangle of the shape; inf: no limit")
      ->check(zero_or_more_or_inf());
  app.add_option("--max-perimeter", hull.core.max_perimeter,
                 "Largest perimeter of a triangle of the shape; inf: no limit")
      ->check(zero_or_more_or_inf());
  CLI::Option* const detail =
      app.add_option(
             "--detail", hull.core.detail,
             "How much detail the outline has, where no limit is given: 2 keeps holes and notches half "
             "as wide, 0.5 smooths")
          ->check(above_zero())
          ->capture_default_str();
  for (const char* limit : {"--alpha", "--max-edge-length", "--max-perimeter"}) {
    detail->excludes(app.get_option(limit));
  }
  app.add_flag("--one", hull.wanted.one, "Make one polygon: widen the limit just enough to join all parts");
  CLI::Option* const cover = app.add_flag(
      "--cover", hull.wanted.cover, "Leave no point outside: widen the limit just enough to cover them all");
  app.add_option("--max-parts", hull.max_parts, "Keep only this many polygons, the largest by area")
      ->check(whole_number_from(1));
  app.add_option("--min-area", hull.min_area,
                 "Fill holes smaller than this area, then drop polygons smaller than it")
      ->check(zero_or_more());
  app.add_option("--min-triangles", hull.min_triangles,
                 "Drop polygons made of fewer Delaunay triangles than this")
      ->check(whole_number_from(0));
  app.add_option("--simplify", hull.simplify,
                 "Simplify the outline: leave out vertices that are at most this far from the new one")
      ->check(zero_or_more());
  // Each of these may leave a point outside.
  for (const char* cleaning : {"--max-parts", "--min-area", "--min-triangles", "--simplify"}) {
    cover->excludes(app.get_option(cleaning));
  }
  app.get_option("--one")->excludes(app.get_option("--min-triangles"));  // the one polygon stays
  app.add_option("--input", choice.input_format, "The input's format")
      ->check(CLI::IsMember({"auto", "csv", "xyz", "geojson", "wkt", "npy", "raw", "ply", "las", "gdal"}))
      ->capture_default_str();
  app.add_option(
      "--columns", choice.columns,
      "The columns of x and y in a text file: names, such as lon,lat, or numbers from 1, such as 2,3");
  app.add_option("--returns", choice.returns,
                 "Use all returns of a LAS file, or only the first or the last ones")
      ->check(CLI::IsMember({"all", "first", "last"}))
      ->capture_default_str();
  app.add_option("--classes", choice.classes,
                 "Use only the points of a LAS file with these classifications, such as 2,6");
  app.add_option("--window", choice.window, "Only points in this box: xmin,ymin,xmax,ymax");
  app.add_option(
      "--crs", choice.crs,
      "The coordinate system, such as EPSG:25832, in place of the file's; none: ignore the file's, "
      "and treat degrees as plane coordinates");
  app.add_option("--layer", choice.layer, "Which layer to read, of an input with several that GDAL reads");
  add_output_options(app, choice);
}

void add_memory_option(CLI::App& app, ShapeChoice& choice, const std::string& when) {
  app.add_option("--memory", choice.memory, when + " for points, in MiB, instead of half of what is free")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 30U));
}

void add_output_options(CLI::App& app, ShapeChoice& choice) {
  app.add_option("--threads", choice.threads, "Number of threads, instead of one for each processor")
      ->check(CLI::Range(1U, 1024U));
  app.add_option(
      "-o,--out", choice.out,
      "Write the result into this file instead of standard output; with GDAL also into a database (PG:)");
  app.add_option("--out-layer", choice.out_layer,
                 "Name of the layer that GDAL writes, instead of the file's name");
}

void add_format_option(CLI::App& app, ShapeChoice& choice, Formats formats) {
  std::string listed = "auto";
  for (const std::string_view format : formats) listed += "," + std::string(format);
  const auto check = [formats, listed](const std::string& text) {
    const bool is_known = text == "auto" || std::find(formats.begin(), formats.end(), text) != formats.end();
    return is_known || text.starts_with("gdal:") ? ""
                                                 : "'" + text + "' is none of " + listed + ",gdal:DRIVER";
  };
  app.add_option(
         "--format", choice.format,
         "The output's format; auto: by the ending of --out, else geojson; gdal:DRIVER: a format of GDAL, "
         "such as gdal:GPKG")
      ->check(CLI::Validator(check, "{" + listed + "} or gdal:DRIVER"))
      ->capture_default_str();
}

PointFileOptions point_options(const ShapeChoice& choice, const Surroundings& surroundings) {
  PointFileOptions options;
  options.vector_formats = surroundings.vector_formats;
  options.format = point_format_of(choice.input_format).value_or(PointFormat::kAuto);
  options.columns = choice.columns;
  options.layer = choice.layer;
  if (choice.returns == "first") options.returns = Returns::kFirst;
  if (choice.returns == "last") options.returns = Returns::kLast;
  if (!choice.classes.empty()) {
    options.classes.emplace();
    const std::vector<unsigned> classes = numbers_of<unsigned>(choice.classes);
    const bool fit = std::all_of(classes.begin(), classes.end(), [](unsigned c) { return c < 256; });
    if (classes.empty() || !fit) {
      throw ConfigurationError("--classes '" + choice.classes +
                               "' is no list of numbers from 0 to 255; give it as in 2,6");
    }
    for (const unsigned c : classes) options.classes->set(c);
  }
  if (!choice.window.empty()) {
    const std::vector<double> box = numbers_of<double>(choice.window);
    const bool fits = box.size() == 4 && box[0] <= box[2] && box[1] <= box[3];
    if (!fits || !std::all_of(box.begin(), box.end(), [](double value) { return std::isfinite(value); })) {
      throw ConfigurationError("--window '" + choice.window +
                               "' is no box; give it as xmin,ymin,xmax,ymax, as in 0,0,1000,500");
    }
    options.window = Box{{box[0], box[1]}, {box[2], box[3]}};
  }
  return options;
}

unsigned thread_count(const ShapeChoice& choice) {
  return choice.threads > 0 ? choice.threads : std::max(1U, std::thread::hardware_concurrency());
}

std::uint64_t memory_for_points(const ShapeChoice& choice) {
  constexpr std::uint64_t kMebibyte = std::uint64_t{1} << 20U;
  constexpr std::uint64_t kGuessed = 1024 * kMebibyte;  // free, where the system does not say
  return choice.memory > 0 ? choice.memory * kMebibyte : free_memory().value_or(kGuessed) / 2;
}

double most_map_bytes(const ShapeChoice& choice) {
  const double half = static_cast<double>(memory_for_points(choice)) / 2;
  return choice.memory > 0 ? half : std::max(half, StreamOptions().most_map_bytes);
}

std::uint64_t most_points_in_memory(const ShapeChoice& choice) {
  return memory_for_points(choice) / kBytesOfPoint;
}

std::string reading(std::uint64_t bytes, std::optional<std::uint64_t> size) {
  const auto mebibytes = [](std::uint64_t count) { return std::to_string(count >> 20U); };
  return "reading: " + mebibytes(bytes) + (size ? " of " + mebibytes(*size) : "") + " MiB";
}

std::string passing(const StreamProgress& progress, std::optional<std::uint64_t> all) {
  return "pass " + std::to_string(progress.pass) + " of " + std::to_string(progress.passes) + ": " +
         std::to_string(progress.points) + (all ? " of " + std::to_string(*all) : "") + " points";
}

Crs chosen_crs(const ShapeChoice& choice, const Crs& of_file) {
  if (choice.crs.empty()) return of_file;
  if (choice.crs == "none") return {};
  const std::vector<int> number = numbers_of<int>(choice.crs);
  const std::optional<Crs> named =
      number.size() == 1 && number[0] > 0 ? crs_of_epsg(number[0]) : crs_of_name(choice.crs);
  if (named) return *named;
  throw ConfigurationError("--crs '" + choice.crs +
                           "' names no coordinate system; give it as EPSG:25832, or none");
}

std::string unknown_crs_note(const ShapeChoice& choice, const Crs& crs, const Box& box, bool has_crs) {
  const bool is_empty = box.min.x > box.max.x;
  if (!choice.crs.empty() || crs.is_given || is_empty) return "";
  if (look_like_degrees(box)) return "if the points are longitudes and latitudes, give --crs EPSG:4326";
  if (!has_crs || could_be_degrees(box)) return "";
  return "the points name no coordinate system, and most programs take a result without one for longitude "
         "and latitude; --crs gives it, as in --crs EPSG:25832, and --crs none says that there is none";
}

void check_magnitude(std::span<const Point> points) {
  const auto fits = [](double coordinate) {
    const double magnitude = std::abs(coordinate);
    return magnitude == 0 || (magnitude >= 0x1p-116 && magnitude <= 0x1p150);
  };
  if (std::all_of(points.begin(), points.end(), [&](const Point& p) { return fits(p.x) && fits(p.y); }))
    return;
  throw std::invalid_argument(
      "coordinates as large or as small as these do not go with --simplify and --keep-outliers; scale them");
}

void check_degrees(const Crs& crs, const Box& box) {
  const bool is_empty = box.min.x > box.max.x;
  if (!crs.is_geographic || is_empty) return;
  if (crs.is_not_in_degrees) {
    throw ConfigurationError(
        "the coordinate system is longitude and latitude in grads, or in another unit than degrees; "
        "transform the points into degrees, or give --crs none to take them as plane coordinates");
  }
  if (could_be_degrees(box)) return;
  throw ConfigurationError(
      "the coordinate system is longitude and latitude, but x is from " + shortest(box.min.x) + " to " +
      shortest(box.max.x) + " and y from " + shortest(box.min.y) + " to " + shortest(box.max.y) +
      "; leave out points that are none with --window -180,-90,180,90, or say with --crs what they are");
}

bool spans_date_line(const Box& box) {
  return box.max.x - box.min.x > 180;
}

LocatedHulls locate_hulls(const PointFile& file, const ShapeChoice& choice, bool is_grouped, unsigned threads,
                          const OnStep& on_step) {
  HullOptions options = choice.hull;
  if (options.simplify > 0) check_magnitude(file.points);
  LocatedHulls hulls;
  const Crs crs = chosen_crs(choice, file.crs);
  check_degrees(crs, bounding_box(file.points));
  hulls.latitude = middle_latitude(crs, file.points);
  if (hulls.latitude) hulls.metres = to_metres(file.points, *hulls.latitude);
  if (is_grouped && file.points.empty()) return hulls;
  options.latitude = hulls.latitude;
  hulls.groups = group_hulls(hulls.latitude ? hulls.metres : file.points, file.groups, file.labels.size(),
                             options, threads, on_step);
  return hulls;
}

bool chooses_points(const ShapeChoice& choice) {
  return !choice.window.empty() || !choice.classes.empty() || choice.returns != "all";
}

std::string no_points(const ShapeChoice& choice, const std::string& file) {
  return file + (chooses_points(choice)
                     ? ": no point is left by --window, --classes and --returns, so there is no shape"
                     : ": it has no points, so there is no shape");
}

std::string limit_in_words(const std::optional<ChosenSizes>& sizes, bool by_outlines, const Wanted& wanted) {
  const std::string by_hand(kByHand);
  if (by_outlines) return std::string(kOnlyOutlines) + by_hand;
  if (!sizes) return "";
  std::string range = four_digits(sizes->least);
  if (sizes->most > sizes->least) range += " (where points are densest) to " + four_digits(sizes->most);
  const std::string limit = "triangles of size " + range + " at most, chosen from the points";
  if (!wanted.one && !wanted.cover) return limit + "; --detail scales it, " + by_hand;
  const std::string widened_by = wanted.one && wanted.cover ? "--one and --cover"
                                 : wanted.one               ? "--one"
                                                            : "--cover";
  return limit + " and widened as far as " + widened_by + (wanted.one && wanted.cover ? " need" : " needs") +
         "; " + by_hand;
}

void add_limits(const Options& limits, const std::optional<ChosenSizes>& sizes, bool by_outlines,
                Properties& properties) {
  if (limits.alpha) properties.add("alpha", *limits.alpha);
  if (limits.max_edge_length) properties.add("max_edge_length", *limits.max_edge_length);
  if (limits.max_perimeter) properties.add("max_perimeter", *limits.max_perimeter);
  if (!sizes || by_outlines) return;
  properties.add("least_size", sizes->least);
  properties.add("median_size", sizes->median);
  properties.add("most_size", sizes->most);
}

void add_extent(std::size_t parts, std::size_t holes, double area, Properties& properties) {
  properties.add("parts", parts);
  properties.add("holes", holes);
  properties.add("area", area);
}

void add_shape_properties(const GroupHull& hull, Properties& properties) {
  add_limits(hull.limits, hull.sizes, hull.by_outlines, properties);
  add_extent(hull.shape.size(), hole_count(hull.shape), hull.area, properties);
}

}  // namespace polylidar::tool
