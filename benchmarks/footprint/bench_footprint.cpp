// build/bench_footprint: how right and how fast `polylidar footprint` is beside a hexbin, GEOS's concave hull
// and the convex hull, on a tile of an airborne scanner whose true outline is known.
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <fstream>
#include <functional>
#include <iostream>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "adapters/adapter.hpp"
#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/base/exit_code.hpp"
#include "benchmarks/base/files.hpp"
#include "benchmarks/base/interrupt.hpp"
#include "benchmarks/base/names.hpp"
#include "benchmarks/base/number_format.hpp"
#include "benchmarks/base/utc_now.hpp"
#include "benchmarks/footprint/hexbin.hpp"
#include "benchmarks/metrics/area.hpp"
#include "benchmarks/metrics/shape_measures.hpp"
#include "benchmarks/plan/parameter_rules.hpp"
#include "benchmarks/record/environment.hpp"
#include "benchmarks/statistics/statistics.hpp"
#include "benchmarks/table/writers.hpp"
#include "datasets/datasets.hpp"
#include "tool/points/point_file.hpp"
#include "tool/program/command_line.hpp"
#include "tool/shapes/polygon_writers.hpp"

extern char** environ;

namespace hullbench::footprint {
namespace {

using Clock = std::chrono::steady_clock;
using Times = std::vector<std::int64_t>;  // nanoseconds

struct Choice {
  std::string dataset = "ca~airborne:2";
  std::size_t points = 10'000'000;
  std::uint64_t seed = 1;
  int runs = 5;
  std::size_t sample = 100'000;  ///< what GEOS gets
  std::string folder = "build/footprint";
  std::string programs = "build";  ///< the folder with hullbench and polylidar
  bool without_times = false;
};

/// The numbers of points in a hexagon that are looked at: any, and what PDAL takes by default.
constexpr std::uint32_t kOne = 1;
constexpr std::uint32_t kOfPdal = 15;

/// The circumradius that goes with a chosen size of triangles, which is about 2.2 spacings of uniform points:
/// of n of these a handful of triangles, 2 n (1 + x) / e^x with x = log n + 2, have a circle with room for x
/// points.
double circumradius_of(double size, std::size_t points) {
  const double in_circle = std::log(static_cast<double>(points)) + 2;
  return size / 2.2 * std::sqrt(in_circle / std::numbers::pi);
}

/// A way to an outline.
struct Way {
  std::string name;
  std::size_t points = 0;
  std::function<MultiPolygon()> make;
  bool is_from_disk = false;  ///< the file is not in the page cache before
  Times times = {};
  MultiPolygon shape = {};
};

/// Runs a program and drops its output. Throws std::runtime_error when it fails.
void run_program(const std::vector<std::string>& command) {
  std::vector<std::string> words = command;
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t process = -1;
  const int error = posix_spawnp(&process, words[0].c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0)
    throw std::runtime_error("cannot start " + words[0] + "; 'make build' builds what is missing");
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) throw std::runtime_error(words[0] + " failed");
}

/// Makes the next reader of a file take it from the disk. Throws std::runtime_error when that is impossible.
void drop_from_memory(const std::string& path) {
  const int file = open(path.c_str(), O_RDONLY);
  const bool is_done = file >= 0 && fsync(file) == 0 && posix_fadvise(file, 0, 0, POSIX_FADV_DONTNEED) == 0;
  if (file >= 0) close(file);
  if (!is_done) throw std::runtime_error("cannot drop " + path + " from the page cache");
}

/// The result of a method of the harness with a parameter, if it has any.
MultiPolygon result_of(const std::string& method, std::span<const Point> points,
                       const Parameters& parameters) {
  const AdapterEntry* entry = find_adapter(method);
  if (!entry) throw std::logic_error("there is no method " + method);
  const std::unique_ptr<Adapter> adapter = entry->make();
  NoSteps steps;
  adapter->load(points);
  adapter->run(parameters, steps);
  return adapter->extract(steps);
}

class Comparison {
 public:
  explicit Comparison(const Choice& choice)
      : choice_(choice), tile_(choice.folder + "/tile.las"), index_(choice.folder + "/index.geojson") {}

  void run() {
    const json environment = record::collect_environment();
    make_tile();
    const MultiPolygon truth = make_ground_truth(choice_.dataset, false);
    add_ways(truth);
    for (int r = 0; r < (choice_.without_times ? 1 : choice_.runs); ++r) {
      time_cat(cat_);
      for (Way& way : ways_) {
        if (way.is_from_disk) {
          drop_from_memory(tile_);
          time_cat(cat_from_disk_);
          drop_from_memory(tile_);
        }
        time_way(way);
      }
    }
    print(truth, environment);
  }

 private:
  void make_tile() {
    make_writable_folder(choice_.folder);
    std::cerr << "writing " << choice_.points << " points of " << choice_.dataset << " into " << tile_
              << "\n";
    run_program({choice_.programs + "/hullbench", "points", choice_.dataset, "--n",
                 std::to_string(choice_.points), "--seed", std::to_string(choice_.seed), "--out", tile_});
  }

  std::vector<Point> read() const { return polylidar::tool::read_points(tile_); }

  MultiPolygon footprint(const std::vector<std::string>& options) {
    std::vector<std::string> command = {choice_.programs + "/polylidar", "footprint", tile_, "--out", index_};
    command.insert(command.end(), options.begin(), options.end());
    run_program(command);
    std::ifstream file(index_);
    const json feature = json::parse(file)["features"][0];
    properties_ = feature["properties"];
    return parse_geojson(feature);
  }

  void add(std::string name, std::size_t points, std::function<MultiPolygon()> make) {
    ways_.push_back({std::move(name), points, std::move(make)});
  }

  void add_ways(const MultiPolygon& truth) {
    // What the others are given is what these choose.
    footprint({});
    const double size = properties_["most_size"].get<double>();
    const std::size_t all = choice_.points;
    const double alpha = circumradius_of(size, all);
    add("polylidar footprint", all, [this] { return footprint({}); });
    if (!choice_.without_times) {
      add("polylidar footprint, from the disk", all, [this] { return footprint({}); });
      ways_.back().is_from_disk = true;
    }
    // The others have one thread.
    add("polylidar footprint --threads 1", all, [this] { return footprint({"--threads", "1"}); });
    add("polylidar footprint --alpha " + three_digits(alpha), all, [this, alpha] {
      return footprint({"--alpha", polylidar::tool::shortest(alpha)});
    });
    add("polylidar footprint --union", all, [this] { return footprint({"--union"}); });
    add("hexagons " + three_digits(size) + " high with a point", all,
        [this, size] { return hexbin(read(), size, kOne); });
    const double best = best_height(size, truth);
    add("hexagons " + three_digits(best) + " high with a point, the best height", all,
        [this, best] { return hexbin(read(), best, kOne); });
    const double height = hexer_height(read(), kOfPdal);
    add("hexagons " + three_digits(height) + " high with " + std::to_string(kOfPdal) + " points", all,
        [this, height] { return hexbin(read(), height, kOfPdal); });
    const double edge = plan::auto_edge_length({.points = sample_of(read())});
    add("GEOS concave hull of a sample", std::min(choice_.sample, all), [this, edge] {
      return result_of("geos_concave_hull", sample_of(read()), {{"max_edge_length", edge}});
    });
    add("convex hull", all, [this] { return result_of("convex_hull", read(), {}); });
  }

  /// The height of hexagons with a point that has the least area error: eight heights to an octave are tried,
  /// from `size` up and down, while the error falls. Lower hexagons leave voids between the points; higher
  /// ones overshoot.
  double best_height(double size, const MultiPolygon& truth) const {
    const std::vector<Point> points = read();
    const auto error_of = [&](double height) {
      throw_if_interrupted();
      const std::optional<double> error = metrics::area_scores(hexbin(points, height, kOne), truth).l2;
      return error.value_or(std::numeric_limits<double>::infinity());
    };
    double best = size;
    double least = error_of(size);
    for (const double factor : {std::exp2(-0.125), std::exp2(0.125)}) {
      while (true) {
        const double error = error_of(best * factor);
        if (!(error < least)) break;
        least = error;
        best *= factor;
      }
    }
    return best;
  }

  /// Points evenly spread over the file.
  std::vector<Point> sample_of(const std::vector<Point>& points) const {
    std::vector<Point> sample;
    const double step =
        std::max(1.0, static_cast<double>(points.size()) / static_cast<double>(choice_.sample));
    const auto place = [&](std::size_t k) { return static_cast<std::size_t>(static_cast<double>(k) * step); };
    for (std::size_t k = 0; place(k) < points.size(); ++k) sample.push_back(points[place(k)]);
    return sample;
  }

  static std::int64_t nanoseconds_since(Clock::time_point start) {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - start).count();
  }

  void time_cat(Times& times) const {
    const Clock::time_point start = Clock::now();
    run_program({"cat", tile_});
    times.push_back(nanoseconds_since(start));
  }

  void time_way(Way& way) {
    throw_if_interrupted();
    std::cerr << way.name << "\n";
    const Clock::time_point start = Clock::now();
    way.shape = way.make();
    way.times.push_back(nanoseconds_since(start));
  }

  static table::Cell seconds(const Times& times) {
    const double median = statistics::median(times) / 1e9;
    table::Cell cell(table::Number{median});
    cell.spread = table::Number(statistics::median_absolute_deviation(times) / 1e9, decimals_of(median));
    return cell;
  }

  void print(const MultiPolygon& truth, const json& environment) const {
    std::vector<table::Column> columns = {table::words("outline"), "points"};
    if (!choice_.without_times) {
      columns.push_back(table::with_unit("time", "s"));
      columns.emplace_back("times cat's");
    }
    columns.push_back(table::with_unit("area error", "%"));
    for (const char* title : {"parts", "holes", "vertices"}) columns.emplace_back(title);
    table::Table table{"footprint",
                       "Footprints of " + std::to_string(choice_.points) + " points of " + choice_.dataset,
                       columns};
    if (!choice_.without_times) {
      for (const auto& [name, times] :
           {std::pair{"cat", &cat_}, std::pair{"cat, from the disk", &cat_from_disk_}})
        table.add_row({name, choice_.points, seconds(*times), table::Number(1, 1), {}, {}, {}, {}});
    }
    for (const Way& way : ways_) {
      std::vector<table::Cell> row = {way.name, way.points};
      if (!choice_.without_times) {
        row.push_back(seconds(way.times));
        const Times& cat = way.is_from_disk ? cat_from_disk_ : cat_;
        row.emplace_back(table::Number(statistics::median(way.times) / statistics::median(cat)));
      }
      const metrics::AreaScores scores = metrics::area_scores(way.shape, truth);
      row.push_back(scores.l2 ? table::Cell(table::Number(100 * *scores.l2)) : table::Cell("invalid"));
      row.emplace_back(way.shape.size());
      row.emplace_back(metrics::count_holes(way.shape));
      row.emplace_back(polylidar::vertex_count(way.shape));
      table.add_row(std::move(row));
    }
    table::print_markdown(table, std::cout);
    std::cout << "\n";
    for (const std::string& note : notes(environment)) table::print_item(note, std::cout);
  }

  std::vector<std::string> notes(const json& environment) const {
    const auto& cpu = environment["cpu"];
    std::vector<std::string> notes = {
        "Area error: the area in which outline and truth differ, of the truth's area.",
        "Hexagons: the union of those with that many points or more. The first are as high as the largest "
        "triangle that polylidar chose; the second have the height with the least error, found with the "
        "truth; the others are as Hexer takes them, which PDAL's filters.hexbin is made of: " +
            std::to_string(kOfPdal) + " times the mean distance of consecutive points, of the first 5000.",
        "GEOS's ConcaveHull gets " + std::to_string(std::min(choice_.sample, choice_.points)) +
            " of the points, evenly spread over the file, and the edge that the rule auto_edge_length takes "
            "from them."};
    if (choice_.without_times) return notes;
    notes.push_back("Times: medians of " + std::to_string(choice_.runs) +
                    " runs by turns, with the median absolute deviation. The file is in the page cache, "
                    "except in the rows \"from the disk\", which are compared with a cat from the disk. "
                    "polylidar is a process of its own, as cat is; of the others the time in one process, "
                    "with reading the file.");
    notes.push_back("Measured " + utc_now().substr(0, 10) + " on " + cpu["model"].get<std::string>() + ", " +
                    std::to_string(cpu["allowed_cores"].get<int>()) + " cores; load average before: " +
                    (environment["load_average"].is_null()
                         ? "not known"
                         : fixed(environment["load_average"][0].get<double>(), 2)) +
                    ".");
    return notes;
  }

  Choice choice_;
  std::string tile_;
  std::string index_;
  json properties_;  ///< of the last footprint
  Times cat_;
  Times cat_from_disk_;
  std::vector<Way> ways_;
};

}  // namespace
}  // namespace hullbench::footprint

int main(int argc, char** argv) {
  CLI::App app("Compares footprints of an airborne tile by area error and time", "bench_footprint");
  hullbench::footprint::Choice choice;
  app.add_option("--dataset", choice.dataset, "The data set that the tile is of")->capture_default_str();
  app.add_option("--n", choice.points, "Points of the tile")
      ->check(CLI::Range(std::size_t{1000}, std::size_t{200'000'000}))
      ->capture_default_str();
  app.add_option("--seed", choice.seed, "Of the random numbers")->capture_default_str();
  app.add_option("--runs", choice.runs, "How often each is timed")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--sample", choice.sample, "Points that GEOS gets")
      ->check(CLI::Range(std::size_t{100}, std::size_t{10'000'000}))
      ->capture_default_str();
  app.add_option("--folder", choice.folder, "For the tile and what is made of it")->capture_default_str();
  app.add_option("--programs", choice.programs, "The folder with hullbench and polylidar")
      ->capture_default_str();
  app.add_flag("--without-times", choice.without_times, "Errors only, as on a machine with other work");
  app.footer(std::string("Example: bench_footprint --n 1000000 --runs 3\n") + hullbench::kExitCodesHelp);
  const auto compare = [&] {
    hullbench::catch_interruptions();
    try {
      hullbench::footprint::Comparison(choice).run();
    } catch (const std::invalid_argument& error) {
      throw hullbench::ConfigurationError(error.what());
    }
    return hullbench::kExitOk;
  };
  return hullbench::exit_code_of("bench_footprint", std::cerr,
                                 [&] { return polylidar::tool::parsed_action(app, compare, argc, argv)(); });
}
