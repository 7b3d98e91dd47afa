#include "benchmarks/hull/hull_command.hpp"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <iostream>
#include <new>
#include <stdexcept>
#include <thread>
#include <vector>

#include "adapters/wkb.hpp"
#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/base/interrupt.hpp"
#include "benchmarks/hull/point_files/point_file.hpp"
#include "benchmarks/hull/polygon_writers.hpp"
#include "benchmarks/hull/result_output.hpp"
#include "benchmarks/hull/simplify.hpp"
#include "polylidar/concave_hull.hpp"

namespace hullbench::hull {
namespace {

using namespace std::chrono_literals;
using polylidar::Extractor;
using polylidar::MultiPolygon;
using polylidar::Point;
using polylidar::Polygon;
using polylidar::Ring;

/// One line on a terminal that is rewritten and is gone in the end; nothing elsewhere.
class ProgressLine {
 public:
  ProgressLine() = default;
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void reading(std::uint64_t bytes, std::optional<std::uint64_t> size) {
    const auto now = Clock::now();
    if (!terminal_ || now - shown_ < kInterval) return;
    shown_ = now;
    show("reading: " + mebibytes(bytes) + (size ? " of " + mebibytes(*size) : "") + " MiB");
  }

  void triangulating(std::size_t points) {
    // Fewer take less than a blink.
    constexpr std::size_t kMany = 500000;
    if (terminal_ && points >= kMany) show("triangulating " + std::to_string(points) + " points");
  }

  void clear() {
    if (drawn_) std::cerr << "\r\033[K" << std::flush;
    drawn_ = false;
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr auto kInterval = 300ms;

  static std::string mebibytes(std::uint64_t bytes) { return std::to_string(bytes >> 20U); }

  void show(const std::string& text) {
    std::cerr << "\r\033[K" << text << std::flush;
    drawn_ = true;
  }

  bool terminal_ = ::isatty(STDERR_FILENO) == 1;
  bool drawn_ = false;
  Clock::time_point shown_ = Clock::now();
};

std::vector<Point> read(const HullCommand& command, ProgressLine& progress) {
  PointFileOptions options;
  options.format = point_format_of(command.input_format).value_or(PointFormat::kAuto);
  options.columns = command.columns;
  options.on_progress = [&](std::uint64_t bytes, std::optional<std::uint64_t> size) {
    throw_if_interrupted();
    progress.reading(bytes, size);
  };
  try {
    return read_points(command.input, options);
  } catch (const PointFileError& error) {
    throw ConfigurationError(error.what());
  }
}

unsigned thread_count(const HullCommand& command, std::size_t points) {
  // Below this a thread's start costs more than it gives (polylidar::Options).
  constexpr std::size_t kWorthThreads = 10000;
  if (points < kWorthThreads) return 1;
  return command.threads > 0 ? command.threads : std::max(1U, std::thread::hardware_concurrency());
}

/// Notes the limits that the shape was extracted with, and says on standard error which one was chosen.
void note_limits(const HullCommand& command, const Extractor& extractor, HullFacts& facts) {
  facts.alpha = command.alpha;
  facts.max_edge_length = command.max_edge_length;
  facts.max_perimeter = command.max_perimeter;
  if (facts.alpha || facts.max_edge_length || facts.max_perimeter || !extractor.has_triangles()) return;
  facts.max_perimeter = extractor.limits().max_perimeter;
  std::cerr << "hullbench: max perimeter " << shortest(*facts.max_perimeter)
            << ", chosen from the points; --max-perimeter sets another, --alpha or --max-edge-length limits "
               "something else\n";
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

MultiPolygon compute(const HullCommand& command, const std::vector<Point>& points, ProgressLine& progress,
                     HullFacts& facts) {
  Extractor extractor;
  const polylidar::Options options = {.alpha = command.alpha,
                                      .max_edge_length = command.max_edge_length,
                                      .max_perimeter = command.max_perimeter,
                                      .threads = thread_count(command, points.size())};
  progress.triangulating(points.size());
  extractor.triangulate(points, options.threads);
  progress.clear();
  throw_if_interrupted();
  extractor.extract_regions(options);
  note_limits(command, extractor, facts);
  const polylidar::IndexedMultiPolygon& indexed = extractor.extract_polygons();
  throw_if_interrupted();
  if (indexed.polygon_count() == 0) explain_emptiness(extractor);
  MultiPolygon shape = to_coordinates(indexed, points);
  if (command.min_triangles > 1) {
    drop_polygons_of_few_triangles(shape, extractor.count_triangles(), command.min_triangles);
  }
  return shape;
}

std::string format(const HullCommand& command, const MultiPolygon& shape, const std::vector<Point>& points,
                   const HullFacts& facts) {
  if (command.format == "wkt") return to_wkt(shape);
  if (command.format == "svg") return to_svg(shape, points);
  if (command.format == "geojson") return to_geojson(shape, facts);
  const std::vector<std::uint8_t> bytes = to_wkb(shape);
  return {bytes.begin(), bytes.end()};
}

std::string name_of(const HullCommand& command) {
  return command.input == "-" ? "standard input" : command.input;
}

int run(const HullCommand& command) {
  check_output_place(command.out);
  ProgressLine progress;
  const std::vector<Point> points = read(command, progress);
  HullFacts facts;
  facts.points = points.size();
  MultiPolygon shape = compute(command, points, progress, facts);
  if (command.min_area > 0) drop_small_areas(shape, command.min_area);
  if (command.simplify > 0 && !shape.empty()) shape = simplify(shape, command.simplify);
  throw_if_interrupted();
  write_result(command.out, format(command, shape, points, facts));
  return 0;
}

}  // namespace

int hull_command(const HullCommand& command) {
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

}  // namespace hullbench::hull
