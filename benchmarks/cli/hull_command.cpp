// `hullbench hull FILE`: from anybody's points to polygons.
#include <algorithm>
#include <cmath>
#include <csignal>
#include <iostream>
#include <new>
#include <stdexcept>
#include <thread>
#include <vector>

#include "adapters/wkb.hpp"
#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/base/interrupt.hpp"
#include "benchmarks/base/status_line.hpp"
#include "benchmarks/cli/options.hpp"
#include "benchmarks/cli/result_output.hpp"
#include "benchmarks/cli/terminal.hpp"
#include "benchmarks/hull/point_files/point_file.hpp"
#include "benchmarks/hull/polygon_writers.hpp"
#include "benchmarks/hull/simplify.hpp"
#include "polylidar/concave_hull.hpp"

namespace hullbench::cli {
namespace {

using hull::HullFacts;
using polylidar::Extractor;
using polylidar::MultiPolygon;
using polylidar::Point;
using polylidar::Polygon;
using polylidar::Ring;

/// Lengths are in the unit of the points.
struct HullCommand {
  std::string input;                      ///< a path, or "-" for standard input
  std::optional<double> alpha;            ///< >= 0; the three limits are those of polylidar::Options
  std::optional<double> max_edge_length;  ///< >= 0
  std::optional<double> max_perimeter;    ///< >= 0
  double detail = 1;                      ///< > 0; of the limit that is chosen
  std::string input_format = "auto";      ///< a name that point_format_of() knows
  std::string columns;                    ///< see PointFileOptions
  std::string format = "geojson";         ///< "geojson", "wkt", "wkb" or "svg"
  double min_area = 0;            ///< squared units; smaller holes are filled, smaller polygons dropped
  std::size_t min_triangles = 0;  ///< polygons of fewer Delaunay triangles are dropped
  double simplify = 0;            ///< how far the outline may move; 0: not at all
  unsigned threads = 0;           ///< 0: as many as there are processors
  std::string out;                ///< a file; empty: standard output
};

std::string mebibytes(std::uint64_t bytes) {
  return std::to_string(bytes >> 20U);
}

std::vector<Point> read(const HullCommand& command, StatusLine& status) {
  hull::PointFileOptions options;
  options.format = hull::point_format_of(command.input_format).value_or(hull::PointFormat::kAuto);
  options.columns = command.columns;
  options.on_progress = [&](std::uint64_t bytes, std::optional<std::uint64_t> size) {
    throw_if_interrupted();
    if (is_terminal())
      status.show("reading: " + mebibytes(bytes) + (size ? " of " + mebibytes(*size) : "") + " MiB");
  };
  try {
    return hull::read_points(command.input, options);
  } catch (const hull::PointFileError& error) {
    throw ConfigurationError(error.what());
  }
}

unsigned thread_count(const HullCommand& command, std::size_t points) {
  // Below this a thread's start costs more than it gives (polylidar::Options).
  constexpr std::size_t kWorthThreads = 10000;
  if (points < kWorthThreads) return 1;
  return command.threads > 0 ? command.threads : std::max(1U, std::thread::hardware_concurrency());
}

/// Notes the limits that the shape was extracted with, and says on standard error what was chosen.
void note_limits(const HullCommand& command, const Extractor& extractor, HullFacts& facts) {
  facts.alpha = command.alpha;
  facts.max_edge_length = command.max_edge_length;
  facts.max_perimeter = command.max_perimeter;
  facts.sizes = extractor.chosen_sizes();
  if (!facts.sizes) return;
  std::cerr << "hullbench: triangles of size " << hull::shortest(facts.sizes->least);
  if (facts.sizes->most > facts.sizes->least) {
    std::cerr << " (where points are densest) to " << hull::shortest(facts.sizes->most);
  }
  std::cerr << " at most, chosen from the points; --detail scales it, --alpha, --max-edge-length or "
               "--max-perimeter sets a limit\n";
}

void explain_emptiness(const Extractor& extractor) {
  std::cerr
      << (!extractor.has_triangles()
              ? "hullbench: there are no three distinct points off a line, so the shape is empty\n"
              : "hullbench: no triangle of the points is within the limits, so the shape is empty; larger "
                "ones give more\n");
}

void drop_polygons_of_few_triangles(MultiPolygon& shape, const std::vector<std::size_t>& triangles,
                                    std::size_t least) {
  std::size_t kept = 0;
  for (std::size_t p = 0; p < shape.size(); ++p) {
    if (triangles[p] < least) continue;
    if (kept != p) shape[kept] = std::move(shape[p]);
    ++kept;
  }
  shape.resize(kept);
}

/// Fills holes and drops polygons below `least`. What lies inside a hole is smaller than it, so that nothing
/// that stays is covered by a filled one.
void drop_small_areas(MultiPolygon& shape, double least) {
  for (Polygon& polygon : shape) {
    std::erase_if(polygon.holes, [&](const Ring& hole) { return -polylidar::signed_area(hole) < least; });
  }
  std::erase_if(shape, [&](const Polygon& polygon) {
    double area = polylidar::signed_area(polygon.shell);
    for (const Ring& hole : polygon.holes) area += polylidar::signed_area(hole);
    return area < least;
  });
}

MultiPolygon compute(const HullCommand& command, const std::vector<Point>& points, StatusLine& status,
                     HullFacts& facts) {
  Extractor extractor;
  const polylidar::Options options = {.alpha = command.alpha,
                                      .max_edge_length = command.max_edge_length,
                                      .max_perimeter = command.max_perimeter,
                                      .detail = command.detail,
                                      .threads = thread_count(command, points.size())};
  // Fewer take less than a blink.
  constexpr std::size_t kMany = 500000;
  if (is_terminal() && points.size() >= kMany)
    status.show("triangulating " + std::to_string(points.size()) + " points");
  const polylidar::IndexedMultiPolygon& indexed = extractor.extract(points, options);
  status.clear();
  throw_if_interrupted();
  note_limits(command, extractor, facts);
  if (indexed.polygon_count() == 0) explain_emptiness(extractor);
  MultiPolygon shape = to_coordinates(indexed, points);
  if (command.min_triangles > 1) {
    drop_polygons_of_few_triangles(shape, extractor.count_triangles(), command.min_triangles);
  }
  return shape;
}

std::string format(const HullCommand& command, const MultiPolygon& shape, const std::vector<Point>& points,
                   const HullFacts& facts) {
  if (command.format == "wkt") return hull::to_wkt(shape);
  if (command.format == "svg") return hull::to_svg(shape, points);
  if (command.format == "geojson") return hull::to_geojson(shape, facts);
  const std::vector<std::uint8_t> bytes = to_wkb(shape);
  return {bytes.begin(), bytes.end()};
}

std::string name_of(const HullCommand& command) {
  return command.input == "-" ? "standard input" : command.input;
}

ExitCode run(const HullCommand& command) {
  check_output_place(command.out);
  StatusLine status(std::cerr, is_terminal());
  const std::vector<Point> points = read(command, status);
  HullFacts facts;
  facts.points = points.size();
  MultiPolygon shape = compute(command, points, status, facts);
  if (command.min_area > 0) drop_small_areas(shape, command.min_area);
  if (command.simplify > 0 && !shape.empty()) shape = hull::simplify(shape, command.simplify);
  throw_if_interrupted();
  write_result(command.out, format(command, shape, points, facts));
  return kExitOk;
}

/// The limit that was chosen, notes and, on a terminal, progress go to standard error.
ExitCode make_hull(const HullCommand& command) {
  // A closed pipe is then an error of writing, which is told like others.
  (void)::signal(SIGPIPE, SIG_IGN);
  try {
    return run(command);
  } catch (const std::invalid_argument& error) {
    throw ConfigurationError(name_of(command) + ": " + error.what());
  } catch (const std::bad_alloc&) {
    throw std::runtime_error("there is not enough memory for the points of " + name_of(command) +
                             "; give fewer of them, or use a machine with more");
  }
}

CLI::Validator zero_or_more() {
  return {[](const std::string& text) {
            double value = 0;
            const bool fits = CLI::detail::lexical_cast(text, value) && std::isfinite(value) && value >= 0;
            return fits ? std::string() : "'" + text + "' is not a number of 0 or more";
          },
          ">=0"};
}

}  // namespace

void add_hull(CLI::App& app, Action& action) {
  const auto command = std::make_shared<HullCommand>();
  CLI::App& options = add_command(app, "hull", "Turn a file of points into polygons",
                                  "hullbench hull points.csv --columns lon,lat --format svg --out hull.svg");
  options.footer(
      "Without --alpha, --max-edge-length and --max-perimeter a limit for the size of triangles is chosen "
      "from "
      "the\n"
      "points, place by place, so that it follows their density. Its range is printed to standard error. The "
      "size of\n"
      "an equilateral triangle is its edge. The shape may be empty.\n"
      "The input's format is known by the ending of its name (.csv .tsv .txt .xyz .pts .asc .geojson .json "
      ".wkt\n"
      ".npy .ply), else by its content. Lengths are in the unit of the points.\n" +
      options.get_footer());
  options.add_option("FILE", command->input, "The points; - for standard input")->required();
  options.add_option("--alpha", command->alpha, "Largest circumradius of a triangle of the shape")
      ->check(zero_or_more());
  options
      .add_option("--max-edge-length", command->max_edge_length, "Longest edge of a triangle of the shape")
      ->check(zero_or_more());
  options
      .add_option("--max-perimeter", command->max_perimeter, "Largest perimeter of a triangle of the shape")
      ->check(zero_or_more());
  options
      .add_option("--detail", command->detail,
                  "Detail of the outline where the limit is chosen: twice the detail, half the size")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  options.add_option("--input", command->input_format, "The input's format")
      ->check(CLI::IsMember({"auto", "csv", "xyz", "geojson", "wkt", "npy", "ply"}))
      ->capture_default_str();
  options.add_option(
      "--columns", command->columns,
      "The columns of x and y in a text file: names, such as lon,lat, or numbers from 1, such as 2,3");
  options.add_option("--format", command->format, "The output's format")
      ->check(CLI::IsMember({"geojson", "wkt", "wkb", "svg"}))
      ->capture_default_str();
  options
      .add_option("--min-area", command->min_area,
                  "Fill holes smaller than this area, then drop polygons smaller than it")
      ->check(zero_or_more());
  options.add_option("--min-triangles", command->min_triangles,
                     "Drop polygons of fewer Delaunay triangles than this");
  options
      .add_option("--simplify", command->simplify,
                  "Simplify: leave out vertices that are no farther than this from the new outline")
      ->check(zero_or_more());
  options.add_option("--threads", command->threads, "Number of threads, instead of one for each processor")
      ->check(CLI::Range(1U, 1024U));
  options.add_option("--out", command->out, "Write the result into this file instead of standard output");
  set_action(options, action, command, &make_hull);
}

}  // namespace hullbench::cli
