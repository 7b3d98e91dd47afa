// `polylidar footprint FILE...`: an index of files, each with the shape of its points, or the shape of all.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <mutex>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

#include "tool/commands/commands.hpp"
#include "tool/commands/file_work.hpp"
#include "tool/commands/run_command.hpp"
#include "tool/commands/shape_choice.hpp"
#include "tool/commands/shape_output.hpp"
#include "tool/hull/degrees.hpp"
#include "tool/hull/streamed_shape.hpp"
#include "tool/points/point_sources.hpp"
#include "tool/program/configuration_error.hpp"
#include "tool/program/interrupt.hpp"
#include "tool/program/status_line.hpp"

namespace polylidar::tool {
namespace {

namespace fs = std::filesystem;

/// Smaller files are read into memory.
constexpr std::uint64_t kWorthStreaming = std::uint64_t{1} << 23U;

using Classes = std::array<std::uint64_t, 256>;

/// What is said of points that are not kept.
struct Facts {
  std::uint64_t points = 0;
  Box bounds = bounding_box({});
  Classes classes{};  ///< of LAS: classification -> points

  void add(std::span<const Point> more) {
    points += more.size();
    bounds = joined(bounds, bounding_box(more));
  }
  void add(const StreamedHull& hull) {
    points += hull.points;
    bounds = joined(bounds, hull.box);
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

/// The group that all points of a stream are.
GroupHull cleaned(IndexShape shape, std::span<const Point> points, const StreamedHull& hull,
                  const HullOptions& options) {
  if (options.simplify > 0) check_magnitude(points);
  GroupHull all;
  all.shape = std::move(shape);
  clean(all.shape, points, options);
  all.area = area(all.shape, points, options.latitude);
  all.limits = options.core;
  all.sizes = hull.chosen_sizes;
  all.by_outlines = hull.by_outlines;
  return all;
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

/// --out may end with the name of another format.
void check_has_properties(const ShapeOutput& output) {
  if (output.has_features()) return;
  throw ConfigurationError("a footprint has properties, which " + output.text_format() +
                           " has no place for; name the file .geojson, or say --format geojson");
}

/// "2 of these have an empty shape, such as a.las", of the files that are marked.
void say_which(const Surroundings& surroundings, const std::vector<std::string>& files,
               const std::vector<bool>& marked, const std::string& what) {
  const auto count = std::count(marked.begin(), marked.end(), true);
  if (count == 0) return;
  const auto first = static_cast<std::size_t>(std::find(marked.begin(), marked.end(), true) - marked.begin());
  surroundings.err << surroundings.program << ": "
                   << (count == 1 ? files[first] + " has "
                                  : std::to_string(count) + " of these, such as " + files[first] + ", have ")
                   << what << "\n";
}

/// What files without points are said to have.
std::string no_points_in_words(const ShapeChoice& shape) {
  return chooses_points(shape) ? "no points left by --window, --classes and --returns" : "no points";
}

/// What is to be told of each file.
void say_notes(const Surroundings& surroundings, const std::vector<std::string>& files,
               const std::vector<std::string>& notes) {
  for (std::size_t file = 0; file < files.size(); ++file) {
    if (!notes[file].empty())
      surroundings.err << surroundings.program << ": " << files[file] << ": " << notes[file] << "\n";
  }
}

/// One run for the index.
class IndexRun {
 public:
  IndexRun(const FootprintCommand& command, const Surroundings& surroundings)
      : command_(command),
        surroundings_(surroundings),
        status_(surroundings.err, surroundings.terminal, quiet_time(surroundings.terminal)),
        output_(command.shape, surroundings, kFormatsWithProperties),
        options_(interruptible(point_options(command.shape, surroundings))),
        files_(command.inputs, surroundings, status_),
        features_(command.inputs.size()),
        notes_(command.inputs.size()),
        lacks_points_(command.inputs.size()),
        is_empty_(command.inputs.size()) {}

  ExitCode run() {
    chosen_crs(command_.shape, {});
    check_has_properties(output_);
    output_.check_against(command_.inputs);
    files_.run(
        thread_count(command_.shape), memory_for_points(command_.shape),
        [&](std::size_t file, unsigned threads, MemoryShare& memory) { return make(file, threads, memory); });
    std::vector<std::string> features;
    for (std::string& feature : features_) {
      if (!feature.empty()) features.push_back(std::move(feature));
    }
    const std::optional<Crs> crs = files_.common_crs();
    output_.write(geojson_collection(features, geojson_crs(crs.value_or(Crs()))), crs.value_or(Crs()),
                  status_);
    const ExitCode code = files_.summary("the index");
    say_notes(surroundings_, command_.inputs, notes_);
    say_which(surroundings_, command_.inputs, lacks_points_, no_points_in_words(command_.shape));
    say_which(surroundings_, command_.inputs, is_empty_, "an empty shape");
    const std::string note =
        crs ? crs_note(command_.shape, *crs, box_, output_)
            : "the files have different coordinate systems: " + files_.systems() +
                  "; programs that read the index take them for one, so make an index for each, or choose by "
                  "the property crs";
    if (!note.empty()) surroundings_.err << surroundings_.program << ": " << note << "\n";
    return code;
  }

 private:
  /// What is said of a file.
  struct Footprint {
    Facts facts;
    Crs crs;
    std::string note;  ///< what is said of the file beside its shape
    GroupHull hull;    ///< of `points`
    std::vector<Point> points;
  };

  Crs make(std::size_t place, unsigned threads, MemoryShare& memory) {
    const std::string& path = command_.inputs[place];
    check_is_file(path);
    std::optional<Footprint> streamed;
    if (is_worth_streaming(path)) {
      memory.take(memory_to_stream(path));
      streamed = by_stream(place, threads);
    }
    if (!streamed) memory.take(memory_to_triangulate(path));
    const Footprint made = streamed ? *std::move(streamed) : in_memory(place, threads);
    Properties properties;
    properties.add("name", std::string_view(fs::path(path).filename().native()));
    properties.add("path", std::string_view(path));
    add_properties(made.facts, made.hull, made.crs, properties);
    features_[place] = geojson_feature(properties, to_coordinates(made.hull.shape, made.points));
    notes_[place] = made.note;
    const std::lock_guard lock(mutex_);
    lacks_points_[place] = made.facts.points == 0;
    is_empty_[place] = made.hull.shape.empty() && made.facts.points > 0;
    box_ = joined(box_, made.facts.bounds);
    return made.crs;
  }

  Footprint in_memory(std::size_t place, unsigned threads) {
    PointFileOptions options = options_;
    options.on_progress = [&](std::uint64_t bytes, std::optional<std::uint64_t> size) {
      files_.show(place, reading(bytes, size));
    };
    PointFile file = read_point_file(command_.inputs[place], options);
    Footprint made;
    made.crs = chosen_crs(command_.shape, file.crs);
    made.note = file.note;
    LocatedHulls hulls = locate_hulls(file, command_.shape, false, threads,
                                      [&](const std::string& doing) { files_.show(place, doing); });
    made.hull = std::move(hulls.groups[0]);
    made.facts.add(file.points);
    if (hulls.latitude && spans_date_line(made.facts.bounds)) {
      made.note += (made.note.empty() ? "" : "; ") + std::string(kSpansDateLine);
    }
    made.facts.add(file.classes);
    made.points = std::move(file.points);
    return made;
  }

  bool is_worth_streaming(const std::string& path) const {
    const HullOptions& hull = command_.shape.hull;
    if (hull.wanted.one || hull.wanted.cover || hull.min_triangles > 0)
      return false;  // these need all triangles
    std::error_code error;
    const std::uintmax_t size = fs::file_size(path, error);
    return !error && size >= kWorthStreaming && is_read_in_parts(path, options_);
  }

  /// The same without the points in memory, which is faster. Nothing of degrees, which must be known before
  /// they are read, and where a stream cannot tell.
  std::optional<Footprint> by_stream(std::size_t place, unsigned threads) {
    const std::string& path = command_.inputs[place];
    Footprint made;
    std::vector<PointFile> parts(parts_for(threads));  // of each what it says beside its points
    const auto on_read = [&](std::size_t part, const PointFile& file) {
      if (part == 0 && chosen_crs(command_.shape, file.crs).is_geographic) {
        throw std::invalid_argument("degrees are no plane");
      }
      parts[part] = file;
    };
    const HullOptions& options = command_.shape.hull;
    Options core = options.core;
    core.threads = threads;
    StreamOptions stream_options;
    stream_options.reads_at_once = true;
    stream_options.expected = expected_points(path, options_);
    stream_options.most_map_bytes = static_cast<double>(map_bytes_to_stream(path));
    stream_options.progress = [&](const StreamProgress& progress) {
      if (status_.is_due()) files_.show(place, passing(progress));
    };
    StreamedHull hull;
    try {
      hull = concave_hull_of_stream(point_sources(path, options_, parts.size(), kMostKeptBytes, on_read),
                                    core, stream_options);
    } catch (const std::invalid_argument&) {
      return {};
    }
    made.crs = chosen_crs(command_.shape, parts[0].crs);
    made.note = parts[0].note;
    made.facts.add(hull);
    for (const PointFile& part : parts) made.facts.add(part.classes);
    StreamedShape shape = streamed_shape(hull);
    made.points = std::move(shape.points);
    made.hull = cleaned(std::move(shape.shape), made.points, hull, options);
    return made;
  }

  const FootprintCommand& command_;
  const Surroundings& surroundings_;
  StatusLine status_;
  ShapeOutput output_;
  PointFileOptions options_;
  FileWork files_;
  std::vector<std::string> features_;  ///< one a file, GeoJSON; empty where it could not be read
  std::vector<std::string> notes_;     ///< one a file, mostly empty
  std::mutex mutex_;                   ///< of the next three
  std::vector<bool> lacks_points_;     ///< one a file
  std::vector<bool> is_empty_;         ///< one a file: whether its shape is, although it has points
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
        status_(surroundings.err, surroundings.terminal, quiet_time(surroundings.terminal)),
        output_(command.shape, surroundings, kFormatsWithProperties),
        options_(interruptible(point_options(command.shape, surroundings))),
        core_(command.shape.hull.core),
        files_(command.inputs, surroundings, status_),
        facts_(command.inputs.size()),
        notes_(command.inputs.size()) {
    options_.whole_if_needed = true;
    core_.threads = thread_count(command.shape);
  }

  ExitCode run() {
    check_options();
    files_.run(core_.threads, memory_for_points(command_.shape),
               [&](std::size_t file, unsigned, MemoryShare& memory) { return look_at(file, memory); });
    add_up();
    find_plane();
    const StreamedHull hull = stream_by_some_limit();
    say(limit_in_words(hull.chosen_sizes, hull.by_outlines, {}));
    output_.write(geojson_collection(std::vector{feature(hull)}, geojson_crs(crs_)), crs_, status_);
    const ExitCode code = files_.summary("the union");
    say_notes(surroundings_, command_.inputs, notes_);
    std::vector<bool> lacks_points;
    for (std::size_t file = 0; file < facts_.size(); ++file) {
      lacks_points.push_back(files_.is_done(file) && facts_[file].points == 0);
    }
    say_which(surroundings_, command_.inputs, lacks_points, no_points_in_words(command_.shape));
    say(crs_note(command_.shape, crs_, all_.bounds, output_));
    return code;
  }

 private:
  void check_options() const {
    const ShapeChoice& shape = command_.shape;
    chosen_crs(shape, {});
    check_has_properties(output_);
    output_.check_against(command_.inputs);
    check_readable_again(command_.inputs, "--union");
    if (shape.hull.wanted.one || shape.hull.wanted.cover || shape.hull.min_triangles > 0) {
      throw ConfigurationError(
          "--union does not go with --one, --cover and --min-triangles, which need all triangles; leave one "
          "of them out");
    }
  }

  /// Nothing if the text is empty.
  void say(const std::string& text) {
    if (!text.empty()) status_.say(surroundings_.program + ": " + text);
  }

  /// Reads a file to its end.
  Crs look_at(std::size_t place, MemoryShare& memory) {
    const std::string& path = command_.inputs[place];
    check_is_file(path);
    // Others may be read whole.
    memory.take(is_read_in_parts(path, options_) ? 0 : unpacked_size(path));
    Facts& facts = facts_[place];
    PointFileOptions options = options_;
    options.take_points = [&](std::span<const Point> block) { facts.add(block); };
    options.on_progress = [&](std::uint64_t bytes, std::optional<std::uint64_t> size) {
      files_.show(place, reading(bytes, size));
    };
    const PointFile file = read_point_file(path, options);
    facts.add(file.classes);
    notes_[place] = file.note;
    Crs crs = chosen_crs(command_.shape, file.crs);
    check_degrees(crs, facts.bounds);
    return crs;
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
    if (latitude_ && spans_date_line(all_.bounds)) say(std::string(kSpansDateLine));
  }

  /// The sizes that are chosen for all points. Where that needs more memory than there is: one limit for all,
  /// chosen from the files one by one.
  StreamedHull stream_by_some_limit() {
    try {
      return stream();
    } catch (const NeedsAllPoints&) {
      choose_limit();
      return stream();
    }
  }

  /// One limit for all: a circumradius. Files that choose a larger size than most, such as one with a few
  /// points far apart, do not decide.
  void choose_limit() {
    constexpr double kShareOfPoints = 0.99;
    std::vector<std::pair<double, std::uint64_t>> sizes;  // with the points of the file
    double points = 0;
    for (std::size_t file = 0; file < facts_.size(); ++file) {
      if (!files_.is_done(file)) continue;
      if (facts_[file].points > most_points_in_memory(command_.shape)) {
        throw ConfigurationError(command_.inputs[file] + " has " + std::to_string(facts_[file].points) +
                                 " points, too many for a limit to be chosen; give " +
                                 std::string(kLimitOrMemory));
      }
      files_.show(file, "choosing a limit");
      const LocatedHulls hulls = locate_hulls(read_point_file(command_.inputs[file], options_),
                                              command_.shape, false, core_.threads, {});
      if (!hulls.groups[0].sizes) continue;
      sizes.emplace_back(hulls.groups[0].sizes->most, facts_[file].points);
      points += static_cast<double>(facts_[file].points);
    }
    if (sizes.empty()) {
      throw ConfigurationError("no file has a triangle of its own to choose a limit from; give " +
                               std::string(kLimitOrMemory));
    }
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
    const std::string least = four_digits(sizes.front().first);
    const std::string most = four_digits(sizes.back().first);
    say("triangles with a circumradius of " + four_digits(*core_.alpha) +
        " at most, chosen from the points (each file alone would get triangles of size " + least +
        (least == most ? "" : " to " + most) + "); --detail scales it, " + std::string(kByHand));
  }

  /// The files that could be read, in metres where asked for and they are in degrees.
  std::vector<PointSource> sources(bool in_metres) {
    std::vector<std::string> paths;
    for (std::size_t file = 0; file < command_.inputs.size(); ++file) {
      if (files_.is_done(file)) paths.push_back(command_.inputs[file]);
    }
    const std::vector<std::uint64_t> kept = kept_bytes(paths, options_);
    const std::size_t parts = count_ == 1 ? parts_for(core_.threads) : 1;
    const auto nothing = [](std::size_t, const PointFile&) {};
    std::vector<PointSource> sources;
    for (std::size_t file = 0; file < paths.size(); ++file) {
      for (PointSource& part : point_sources(paths[file], options_, parts, kept[file], nothing)) {
        if (!in_metres || !latitude_) {
          sources.push_back(std::move(part));
          continue;
        }
        sources.emplace_back([this, read = std::move(part)](const TakePoints& take) {
          read([&](std::span<const Point> block) { take(to_metres(block, *latitude_)); });
        });
      }
    }
    return sources;
  }

  StreamedHull stream() {
    StreamOptions options;
    options.most_map_bytes = most_map_bytes(command_.shape);
    options.progress = [&](const StreamProgress& progress) {
      throw_if_interrupted();
      if (status_.is_due()) status_.show(passing(progress, all_.points));
    };
    options.most_points_in_memory = most_points_in_memory(command_.shape);
    options.reads_at_once = true;
    if (!latitude_) options.expected = {all_.points, all_.bounds};  // as look_at() has found
    return concave_hull_of_stream(sources(true), core_, options);
  }

  /// Not where there is nothing else.
  void drop_what_chance_makes(IndexShape& shape, std::span<const Point> points) const {
    if (least_area_ == 0) return;
    const bool any = std::any_of(shape.begin(), shape.end(), [&](const IndexPolygon& polygon) {
      return area(polygon, points) >= least_area_;
    });
    if (any) drop_small_areas(shape, points, least_area_);
  }

  std::string feature(const StreamedHull& hull) {
    StreamedShape streamed = streamed_shape(hull);
    drop_what_chance_makes(streamed.shape, streamed.points);
    HullOptions options = command_.shape.hull;
    options.core = core_;
    options.latitude = latitude_;
    const GroupHull united = cleaned(std::move(streamed.shape), streamed.points, hull, options);
    Properties properties;
    properties.add("files", count_);
    add_properties(all_, united, crs_, properties);
    status_.show("making the result");
    // The coordinates of the files, bit by bit.
    const std::vector<Point> vertices =
        latitude_ ? points_of_numbers(sources(false), streamed.numbers) : std::move(streamed.points);
    return geojson_feature(properties, to_coordinates(united.shape, vertices));
  }

  const FootprintCommand& command_;
  const Surroundings& surroundings_;
  StatusLine status_;
  ShapeOutput output_;
  PointFileOptions options_;
  Options core_;
  FileWork files_;
  std::vector<Facts> facts_;        ///< one a file
  std::vector<std::string> notes_;  ///< likewise
  Facts all_;                       ///< of the files that could be read
  std::size_t count_ = 0;           ///< these files
  double least_area_ = 0;           ///< smaller holes and parts are by chance, where the limit was chosen
  Crs crs_;
  std::optional<double> latitude_;  ///< where the files are in degrees, the middle one of all
};

}  // namespace

ExitCode make_footprints(const FootprintCommand& command, const Surroundings& surroundings) {
  if (!command.is_union)
    return run_command("the index", [&] { return IndexRun(command, surroundings).run(); });
  return run_command("the union", [&] { return UnionRun(command, surroundings).run(); });
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
      "become one part, without a seam. The property 'files' is the number of files. They are read several "
      "times, and\n"
      "need not fit into memory. If no limit is given, the sizes of triangles are chosen from all points. If "
      "the density\n"
      "varies by much, that needs all of them in memory. If they do not fit, a limit is chosen for each "
      "file. "
      "The largest\n"
      "is used for all, but the files with the largest limits that together hold 1 % of the points do not "
      "count.\n" +
      std::string(kGdalHelp));
  app.add_option("FILE", command.inputs, "The files of points")->required();
  app.add_flag(
      "--union", command.is_union,
      "Make one shape of all files together, instead of one for each file; not with --one, --cover and "
      "--min-triangles");
  add_format_option(app, command.shape, kFormatsWithProperties);
  add_shape_options(app, command.shape);
  add_memory_option(app, command.shape, "The most memory");
}

}  // namespace polylidar::tool
