// `polylidar footprint FILE...`: an index of files, each with the shape of its points, or the shape of all.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <functional>
#include <mutex>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include "tool/commands/commands.hpp"
#include "tool/commands/file_work.hpp"
#include "tool/commands/shape_choice.hpp"
#include "tool/commands/shape_output.hpp"
#include "tool/hull/degrees.hpp"
#include "tool/hull/streamed_shape.hpp"
#include "tool/program/configuration_error.hpp"
#include "tool/program/free_memory.hpp"
#include "tool/program/interrupt.hpp"
#include "tool/program/status_line.hpp"

namespace polylidar::tool {
namespace {

namespace fs = std::filesystem;

/// What a file's points and their triangles take: of LAS, whose points have 20 bytes at least, some 150 bytes
/// a point.
constexpr std::uint64_t kMemoryToTriangulate = 8;

using Classes = std::array<std::uint64_t, 256>;

/// The box round two, either of which may be empty.
Box joined(const Box& a, const Box& b) {
  return {{std::min(a.min.x, b.min.x), std::min(a.min.y, b.min.y)},
          {std::max(a.max.x, b.max.x), std::max(a.max.y, b.max.y)}};
}

/// What is said of points that are not kept.
struct Facts {
  std::uint64_t points = 0;
  Box bounds = bounding_box({});
  Classes classes{};  ///< of LAS: classification -> points

  void add(std::span<const Point> more) {
    points += more.size();
    bounds = joined(bounds, bounding_box(more));
  }
  void add(const Classes& more) {
    std::transform(classes.begin(), classes.end(), more.begin(), classes.begin(), std::plus<>());
  }
  void add(const Facts& more) {
    points += more.points;
    bounds = joined(bounds, more.bounds);
    add(more.classes);
  }
};

std::string bounds_json(const Facts& facts) {
  if (facts.points == 0) return "null";
  const Box& box = facts.bounds;
  return "[" + shortest(box.min.x) + "," + shortest(box.min.y) + "," + shortest(box.max.x) + "," +
         shortest(box.max.y) + "]";
}

/// {"2":1000,"6":50}: how many points are of each classification.
std::string classes_json(const Classes& classes) {
  Properties counts;
  for (std::size_t c = 0; c < classes.size(); ++c) {
    if (classes[c] > 0) counts.add(std::to_string(c), static_cast<std::size_t>(classes[c]));
  }
  return counts.json();
}

/// What a footprint says behind what it is of.
void add_properties(const Facts& facts, const GroupHull& hull, const Crs& crs, Properties& properties) {
  properties.add("points", static_cast<std::size_t>(facts.points));
  if (hull.area > 0) {
    properties.add("density", static_cast<double>(facts.points) / hull.area);
  } else {
    properties.add_json("density", "null");
  }
  add_shape_properties(hull, properties);
  properties.add_json("bounds", bounds_json(facts));
  properties.add_json("classes", classes_json(facts.classes));
  if (crs.name().empty()) {
    properties.add_json("crs", "null");
  } else {
    properties.add("crs", std::string_view(crs.name()));
  }
}

/// How points are read that nobody waits for one by one.
PointFileOptions interruptible(PointFileOptions options) {
  options.on_progress = [](std::uint64_t, std::optional<std::uint64_t>) { throw_if_interrupted(); };
  return options;
}

void check_is_file(const std::string& path) {
  if (is_for_gdal(path) && is_database(path)) {
    throw PointFileError(path + ": footprints are of files; ask 'polylidar hull' for those of a database");
  }
}

/// One run for the index.
class IndexRun {
 public:
  IndexRun(const FootprintCommand& command, const Surroundings& surroundings)
      : command_(command),
        surroundings_(surroundings),
        output_(command.shape, surroundings.vector_formats),
        options_(interruptible(point_options(command.shape, surroundings))),
        files_(command.inputs, surroundings),
        features_(command.inputs.size()),
        is_empty_(command.inputs.size()) {}

  ExitCode run() {
    chosen_crs(command_.shape, {});
    output_.check_is_none_of(command_.inputs);
    files_.run(thread_count(command_.shape), kMemoryToTriangulate,
               [&](std::size_t file, unsigned threads) { return make(file, threads); });
    std::vector<std::string> features;
    for (std::string& feature : features_) {
      if (!feature.empty()) features.push_back(std::move(feature));
    }
    const std::optional<Crs> crs = files_.common_crs();
    output_.write(geojson_collection(features, geojson_crs(crs.value_or(Crs()))), crs.value_or(Crs()));
    const ExitCode code = files_.summary("the index");
    if (const auto empty = std::count(is_empty_.begin(), is_empty_.end(), true); empty > 0) {
      const auto first =
          static_cast<std::size_t>(std::find(is_empty_.begin(), is_empty_.end(), true) - is_empty_.begin());
      surroundings_.err << surroundings_.program << ": " << empty << " of these "
                        << (empty == 1 ? "has" : "have") << " an empty shape, such as "
                        << command_.inputs[first] << "\n";
    }
    bool nameless = false;
    for (std::size_t file = 0; file < features_.size(); ++file) {
      nameless |= files_.is_done(file) && !output_.can_tell(files_.crs(file));
    }
    if (nameless) surroundings_.err << surroundings_.program << ": " << kNamelessCrs << "\n";
    if (!crs) {
      surroundings_.err
          << surroundings_.program << ": the files have different coordinate systems: " << files_.systems()
          << "; programs that read the index take them for one, so make an index for each, or choose by the "
             "property crs\n";
    } else if (lacks_crs(command_.shape, *crs, box_)) {
      surroundings_.err << surroundings_.program << ": " << kNoCrs << "\n";
    }
    return code;
  }

 private:
  Crs make(std::size_t place, unsigned threads) {
    const std::string& path = command_.inputs[place];
    check_is_file(path);
    const PointFile file = read_point_file(path, options_);
    Crs crs = chosen_crs(command_.shape, file.crs);
    const LocatedHulls hulls = locate_hulls(file, command_.shape, false, threads, {});
    Facts facts;
    facts.add(file.points);
    facts.add(file.classes);
    Properties properties;
    properties.add("name", std::string_view(fs::path(path).filename().native()));
    properties.add("path", std::string_view(path));
    add_properties(facts, hulls.groups[0], crs, properties);
    features_[place] = geojson_feature(properties, to_coordinates(hulls.groups[0].shape, file.points));
    const std::lock_guard lock(mutex_);
    is_empty_[place] = hulls.groups[0].shape.empty();
    box_ = joined(box_, facts.bounds);
    return crs;
  }

  const FootprintCommand& command_;
  const Surroundings& surroundings_;
  ShapeOutput output_;
  PointFileOptions options_;
  FileWork files_;
  std::vector<std::string> features_;  ///< one a file, GeoJSON; empty where it could not be read
  std::mutex mutex_;                   ///< of the next two
  std::vector<bool> is_empty_;         ///< one a file: whether its shape is
  Box box_ = bounding_box({});         ///< of all points that were read
};

/// One run for the shape of all points: the hull of the files as one stream, so that there is no seam where
/// two of them meet. They are looked at first, which finds those that cannot be read; the stream has the
/// others.
class UnionRun {
 public:
  UnionRun(const FootprintCommand& command, const Surroundings& surroundings)
      : command_(command),
        surroundings_(surroundings),
        status_(surroundings.err, surroundings.terminal),
        output_(command.shape, surroundings.vector_formats),
        options_(interruptible(point_options(command.shape, surroundings))),
        core_(hull_options(command.shape).core),
        is_limit_given_(core_.alpha || core_.max_edge_length || core_.max_perimeter),
        files_(command.inputs, surroundings),
        sizes_(command.inputs.size()),
        facts_(command.inputs.size()) {
    options_.whole_if_needed = true;
    core_.threads = thread_count(command.shape);
  }

  ExitCode run() {
    check_options();
    files_.run(core_.threads, is_limit_given_ ? 1 : kMemoryToTriangulate,
               [&](std::size_t file, unsigned threads) { return look_at(file, threads); });
    add_up();
    find_plane();
    if (!is_limit_given_) choose_limit();
    const StreamedHull hull = stream();
    say(std::to_string(hull.triangulated_points) + " of " + std::to_string(hull.points) +
        " points are near the outline");
    output_.write(geojson_collection(std::vector{feature(hull)}, geojson_crs(crs_)), crs_);
    const ExitCode code = files_.summary("the union");
    if (!output_.can_tell(crs_)) say(std::string(kNamelessCrs));
    if (lacks_crs(command_.shape, crs_, all_.bounds)) say(std::string(kNoCrs));
    return code;
  }

 private:
  void check_options() const {
    const ShapeChoice& shape = command_.shape;
    chosen_crs(shape, {});
    output_.check_is_none_of(command_.inputs);
    if (shape.one || shape.cover || shape.min_triangles > 0) {
      throw ConfigurationError(
          "--union does not go with --one, --cover and --min-triangles, which need all triangles; leave one "
          "of "
          "them out");
    }
  }

  void say(const std::string& text) const {
    surroundings_.err << surroundings_.program << ": " << text << "\n";
  }

  /// Reads a file to its end, and chooses its limit where none is given.
  Crs look_at(std::size_t place, unsigned threads) {
    const std::string& path = command_.inputs[place];
    check_is_file(path);
    Facts& facts = facts_[place];
    PointFileOptions options = options_;
    if (is_limit_given_) options.take_points = [&](std::span<const Point> block) { facts.add(block); };
    const PointFile file = read_point_file(path, options);
    facts.add(file.points);
    facts.add(file.classes);
    if (!is_limit_given_) {
      const LocatedHulls hulls = locate_hulls(file, command_.shape, false, threads, {});
      if (hulls.groups[0].sizes) sizes_[place] = hulls.groups[0].sizes->most;
    }
    return chosen_crs(command_.shape, file.crs);
  }

  void add_up() {
    for (std::size_t file = 0; file < facts_.size(); ++file) {
      if (!files_.is_done(file)) continue;
      ++count_;
      all_.add(facts_[file]);
    }
  }

  void find_plane() {
    const std::optional<Crs> crs = files_.common_crs();
    if (!crs) {
      throw ConfigurationError(
          "the files have different coordinate systems: " + files_.systems() +
          "; transform them into one, leave some out, or give the one that all are in by --crs");
    }
    crs_ = *crs;
    if (all_.points == 0) return;
    const std::array<Point, 2> corners = {all_.bounds.min, all_.bounds.max};
    latitude_ = middle_latitude(crs_, corners);
  }

  /// One limit for all: a circumradius, as a stream cannot be asked for sizes. Files that choose a larger
  /// size than most, such as one with a few points far apart, do not decide.
  void choose_limit() {
    constexpr double kShareOfPoints = 0.99;
    std::vector<std::pair<double, std::uint64_t>> sizes;  // with the points of the file
    double points = 0;
    for (std::size_t file = 0; file < facts_.size(); ++file) {
      if (!files_.is_done(file) || sizes_[file] == 0) continue;
      sizes.emplace_back(sizes_[file], facts_[file].points);
      points += static_cast<double>(facts_[file].points);
    }
    if (sizes.empty()) return;
    std::sort(sizes.begin(), sizes.end());
    double had = 0;
    const auto chosen = std::find_if(sizes.begin(), sizes.end(), [&](const auto& file) {
      had += static_cast<double>(file.second);
      return had >= kShareOfPoints * points;
    });
    // Uniform points get a size of about 2.2 spacings. Of n of them 2 n (1 + x) e^-x triangles have a
    // circumcircle that would hold x or more; with x = log n + 2 that is a handful, and for the 2000 points
    // that the harness fits its rules to, a circumradius of 0.8 sizes, which fits best there
    // (parameter_rules.cpp).
    const double spacing = chosen->first / 2.2;
    const double log_n = std::log(static_cast<double>(all_.points));
    core_.alpha = spacing * std::sqrt((log_n + 2) / std::numbers::pi);
    // What that handful leaves goes: holes and parts with room for fewer than log n + 4 points.
    core_.fill_single_triangles = true;
    least_area_ = (log_n + 4) * spacing * spacing;
    say("triangles with a circumradius of " + four_digits(*core_.alpha) +
        " at most, chosen from the points (each file alone would get triangles of size " +
        four_digits(sizes.front().first) + " to " + four_digits(sizes.back().first) +
        "); --detail scales it, --alpha, --max-edge-length or --max-perimeter sets a limit");
  }

  /// All files that could be read, in metres where asked for and they are in degrees.
  PointSource source(bool in_metres) {
    return [this, in_metres](const TakePoints& take) {
      PointFileOptions options = options_;
      options.take_points = [&](std::span<const Point> block) {
        if (in_metres && latitude_) {
          take(to_metres(block, *latitude_));
        } else {
          take(block);
        }
      };
      for (place_ = 0; place_ < command_.inputs.size(); ++place_) {
        if (files_.is_done(place_)) read_point_file(command_.inputs[place_], options);
      }
    };
  }

  StreamedHull stream() {
    StreamOptions options;
    // Of two maps; the rest is for what is near the outline.
    options.most_map_bytes =
        std::max(options.most_map_bytes, static_cast<double>(free_memory().value_or(0)) / 8);
    options.progress = [&](const StreamProgress& progress) {
      throw_if_interrupted();
      if (!surroundings_.terminal) return;
      status_.show("pass " + std::to_string(progress.pass) + " of " + std::to_string(progress.passes) +
                   ": file " + std::to_string(place_ + 1) + " of " + std::to_string(command_.inputs.size()) +
                   ", " + std::to_string(progress.points) + " of " + std::to_string(all_.points) + " points");
    };
    try {
      StreamedHull hull = concave_hull_of_stream(source(true), core_, options);
      status_.clear();
      return hull;
    } catch (const std::invalid_argument& error) {
      throw ConfigurationError(std::string("the union: ") + error.what());
    }
  }

  /// Not where there is nothing else.
  void drop_what_chance_makes(IndexShape& shape, std::span<const Point> points) const {
    const bool any = std::any_of(shape.begin(), shape.end(), [&](const IndexPolygon& polygon) {
      return area(polygon, points) >= least_area_;
    });
    if (any) drop_small_areas(shape, points, least_area_);
  }

  std::string feature(const StreamedHull& hull) {
    StreamedShape streamed = streamed_shape(hull);
    GroupHull united;
    united.shape = std::move(streamed.shape);
    drop_what_chance_makes(united.shape, streamed.points);
    clean(united.shape, streamed.points, hull_options(command_.shape));
    united.area = area(united.shape, streamed.points);
    united.alpha = core_.alpha;
    united.max_edge_length = core_.max_edge_length;
    united.max_perimeter = core_.max_perimeter;
    Properties properties;
    properties.add("files", count_);
    add_properties(all_, united, crs_, properties);
    // The coordinates of the files, bit by bit.
    const std::vector<Point> vertices =
        latitude_ ? points_of_numbers(source(false), streamed.numbers) : std::move(streamed.points);
    return geojson_feature(properties, to_coordinates(united.shape, vertices));
  }

  const FootprintCommand& command_;
  const Surroundings& surroundings_;
  StatusLine status_;
  ShapeOutput output_;
  PointFileOptions options_;
  Options core_;
  bool is_limit_given_;
  FileWork files_;
  std::vector<double> sizes_;  ///< file -> the largest size that is chosen for it; 0: none
  std::vector<Facts> facts_;   ///< one a file
  Facts all_;                  ///< of the files that could be read
  std::size_t count_ = 0;      ///< these files
  std::size_t place_ = 0;      ///< of the file that is being streamed
  double least_area_ = 0;      ///< smaller holes and parts are by chance, where the limit was chosen
  Crs crs_;
  std::optional<double> latitude_;  ///< where the files are in degrees, the middle one of all
};

}  // namespace

ExitCode make_footprints(const FootprintCommand& command, const Surroundings& surroundings) {
  // A closed pipe is then an error of writing, which is told like others.
  (void)::signal(SIGPIPE, SIG_IGN);
  if (command.is_union) return UnionRun(command, surroundings).run();
  return IndexRun(command, surroundings).run();
}

void add_footprint_options(CLI::App& app, FootprintCommand& command) {
  app.description("Make an index of files, each with the shape of its points, or the shape of all of them");
  app.footer(
      "The index has one feature for each file, with name, path, points, density, parts, holes, area, "
      "bounds, the\n"
      "number of points of each classification, and crs. Files are read in parallel, as many at a time as "
      "fit into half\n"
      "of the free memory. A file that cannot be read is named on standard error and left out. The formats "
      "are those\n"
      "of 'polylidar hull'.\n"
      "With --union the result is a single feature: the shape of the points of all files together. Tiles "
      "that touch\n"
      "become one part, without a seam. Its property files is the number of files. They are read about five "
      "times and\n"
      "need not fit into memory. If no limit is given, one is chosen for each file, which must fit. The "
      "largest is used\n"
      "for all, but the files with the largest limits that together hold 1 % of the points do not count.\n" +
      std::string(kGdalHelp));
  app.add_option("FILE", command.inputs, "The files of points")->required();
  app.add_flag("--union", command.is_union,
               "Make one shape of all files together, instead of one for each file");
  add_format_option(app, command.shape, {"auto", "geojson"});
  add_shape_options(app, command.shape);
}

}  // namespace polylidar::tool
