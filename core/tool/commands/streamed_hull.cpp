#include "tool/commands/streamed_hull.hpp"

#include <algorithm>
#include <charconv>
#include <mutex>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "tool/commands/file_work.hpp"
#include "tool/commands/shape_choice.hpp"
#include "tool/hull/shard_file.hpp"
#include "tool/points/point_sources.hpp"
#include "tool/program/configuration_error.hpp"
#include "tool/program/interrupt.hpp"
#include "tool/program/result_output.hpp"
#include "tool/program/status_line.hpp"

namespace polylidar::tool {
namespace {

constexpr std::uint32_t kMostShards = 9999;

/// The whole of "K/N" with 1 <= K <= N.
std::optional<Shard> shard_of(std::string_view text) {
  const std::size_t slash = text.find('/');
  if (slash == std::string_view::npos) return {};
  Shard shard;
  const auto parse = [&](std::string_view digits, std::uint32_t& value) {
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    return error == std::errc() && end == digits.data() + digits.size();
  };
  const bool fits = parse(text.substr(0, slash), shard.number) &&
                    parse(text.substr(slash + 1), shard.count) && shard.number >= 1 &&
                    shard.number <= shard.count && shard.count <= kMostShards;
  return fits ? std::optional(shard) : std::nullopt;
}

[[noreturn]] void refuse(const std::string& option, const std::string& what) {
  throw ConfigurationError(option + " does not go with " + what + "; leave one of them out");
}

class StreamRun {
 public:
  StreamRun(const HullCommand& command, const Surroundings& surroundings)
      : command_(command),
        surroundings_(surroundings),
        status_(surroundings.err, surroundings.terminal, quiet_time(surroundings.terminal)),
        core_(command.shape.hull.core) {
    core_.threads = thread_count(command.shape);
  }

  ExitCode run() {
    chosen_crs(command_.shape, {});
    check_options();
    return command_.shard.empty() ? make_hull() : make_part();
  }

 private:
  void check_options() const {
    const HullOptions& hull = command_.shape.hull;
    const std::vector<std::string>& inputs = command_.inputs;
    check_each_once(inputs);
    check_readable_again(inputs, "--stream");
    if (!command_.by.empty()) refuse("--stream", "--by");
    if (command_.keep_outliers) refuse("--stream", "--keep-outliers");
    if (hull.wanted.one) refuse("--stream", "--one");
    if (hull.wanted.cover) refuse("--stream", "--cover");
    if (hull.min_triangles > 0) refuse("--stream", "--min-triangles");
    if (hull.min_area > 0) refuse("--stream", "--min-area");
    if (hull.max_parts) refuse("--stream", "--max-parts");
    if (hull.simplify > 0) refuse("--stream", "--simplify");
    const bool is_limit_given = core_.alpha || core_.max_edge_length || core_.max_perimeter;
    if (!command_.shard.empty() && !is_limit_given) {
      throw ConfigurationError("--shard needs a limit; give --alpha, --max-edge-length or --max-perimeter");
    }
  }

  ExitCode make_hull() {
    const ShapeOutput output(command_.shape, surroundings_, kFormatsWithoutPoints);
    if (output.text_format() == "svg") refuse("--stream", "--format svg");
    output.check_against(command_.inputs);
    // The parts of one file, or several files, are read at the same time.
    StreamOptions options = stream_options();
    options.most_map_bytes = most_map_bytes(command_.shape);
    options.expected = expected();
    const StreamedHull hull = concave_hull_of_stream(
        sources(command_.inputs.size() == 1 ? parts_for(core_.threads) : 1), core_, options);
    const Crs crs = crs_.value_or(Crs());
    write_streamed_hull(hull, core_, crs, output, surroundings_.program, status_);
    say(crs_note(command_.shape, crs, hull.box, output));
    return kExitOk;
  }

  ExitCode make_part() {
    const ShapeChoice& shape = command_.shape;
    const std::optional<Shard> shard = shard_of(command_.shard);
    if (!shard) {
      throw ConfigurationError("--shard '" + command_.shard +
                               "' is no shard; give its number and how many there are (at most " +
                               std::to_string(kMostShards) + "), as in --shard 1/3");
    }
    if (shape.format != "auto" || !shape.out_layer.empty() || is_for_gdal(shape.out)) {
      throw ConfigurationError(
          "--shard writes a part and no polygons, so --format, --out-layer and outputs of GDAL are for "
          "'polylidar merge'; give them there");
    }
    check_output_place(shape.out);
    check_is_none_of(shape.out, command_.inputs);
    if (names_points(shape.out) || names_polygons(shape.out)) {
      throw ConfigurationError("--out " + shape.out +
                               ": --shard writes a part for 'polylidar merge', neither points nor polygons; "
                               "give it another ending, or none, as in part-1");
    }
    StreamOptions options = stream_options();
    if (shape.memory > 0) options.most_map_bytes = most_map_bytes(shape);
    const StreamShard part = part_of_stream(sources(1), core_, *shard, options);
    status_.clear();
    status_.say(surroundings_.program + ": shard " + std::to_string(shard->number) + " of " +
                std::to_string(shard->count) + ": " + std::to_string(part.points.size()) + " of " +
                std::to_string(part.source_points) + " points are near the outline and in its band");
    if (!shape.out.empty()) status_.show("writing " + shape.out);
    const Crs crs = crs_.value_or(Crs());
    write_shard_file(shape.out, {part, crs});
    // Not known any more when the shards are merged: whether somebody gave --crs none.
    say(unknown_crs_note(shape, crs, part.box, true));
    return kExitOk;
  }

  PointFileOptions file_options() const {
    PointFileOptions options = point_options(command_.shape, surroundings_);
    options.on_progress = [](std::uint64_t, std::optional<std::uint64_t>) { throw_if_interrupted(); };
    return options;
  }

  /// What the headers of all files together say of the points; nothing where one of them says nothing.
  std::optional<ExpectedPoints> expected() const {
    const PointFileOptions options = file_options();
    std::uint64_t count = 0;
    std::vector<Point> corners;
    for (const std::string& input : command_.inputs) {
      const std::optional<ExpectedPoints> of_file = expected_points(input, options);
      if (!of_file) return {};
      if (of_file->count == 0) continue;
      count += of_file->count;
      corners.insert(corners.end(), {of_file->box.min, of_file->box.max});
    }
    return ExpectedPoints{count, bounding_box(corners)};
  }

  /// Each file as up to so many sources.
  std::vector<PointSource> sources(std::size_t most_parts) {
    const PointFileOptions options = file_options();
    const std::vector<std::uint64_t> kept = kept_bytes(command_.inputs, options);
    std::vector<PointSource> sources;
    for (std::size_t i = 0; i < command_.inputs.size(); ++i) {
      const std::string& input = command_.inputs[i];
      const auto on_read = [this, &input](std::size_t part, const PointFile& file) {
        if (part > 0) return;
        check_crs(input, chosen_crs(command_.shape, file.crs));
        if (!file.note.empty()) say(input + ": " + file.note);
      };
      for (PointSource& part : point_sources(input, options, most_parts, kept[i], on_read)) {
        sources.push_back(std::move(part));
      }
    }
    return sources;
  }

  void check_crs(const std::string& input, const Crs& crs) {
    if (crs.is_geographic) {
      throw ConfigurationError(input +
                               ": its coordinates are longitudes and latitudes, and --stream takes a plane; "
                               "project them, or give --crs none to take degrees as one");
    }
    const std::lock_guard lock(mutex_);
    if (crs_ && *crs_ != crs) {
      throw ConfigurationError(
          "the files have different coordinate systems; transform them into one, or give one by --crs");
    }
    crs_ = crs;
  }

  /// Each text once, and an empty one never.
  void say(const std::string& text) {
    const std::lock_guard lock(mutex_);
    if (!text.empty() && said_.insert(text).second) status_.say(surroundings_.program + ": " + text);
  }

  StreamOptions stream_options() {
    const auto show = [this](const StreamProgress& progress) {
      throw_if_interrupted();
      if (status_.is_due()) status_.show(passing(progress));
    };
    return {.progress = show,
            .most_points_in_memory = most_points_in_memory(command_.shape),
            .reads_at_once = true};
  }

  const HullCommand& command_;
  const Surroundings& surroundings_;
  StatusLine status_;
  Options core_;
  std::mutex mutex_;            ///< of the next two
  std::optional<Crs> crs_;      ///< of the files, once one was read
  std::set<std::string> said_;  ///< each of the passes reads the same
};

std::string geojson(const StreamedHull& hull, const Options& options, const Crs& crs) {
  Properties properties;
  properties.add("points", static_cast<std::size_t>(hull.points));
  add_limits(options, hull.chosen_sizes, hull.by_outlines, properties);
  std::size_t holes = 0;
  for (const Polygon& polygon : hull.polygons) holes += polygon.holes.size();
  add_extent(hull.polygons.size(), holes, area(hull.polygons), properties);
  return geojson_feature(properties, hull.polygons, geojson_crs(crs)) + "\n";
}

}  // namespace

ExitCode stream_hull(const HullCommand& command, const Surroundings& surroundings) {
  return StreamRun(command, surroundings).run();
}

void write_streamed_hull(const StreamedHull& hull, const Options& options, const Crs& crs,
                         const ShapeOutput& output, const std::string& program, StatusLine& status) {
  status.say(program + ": " +
             (hull.points == 0 ? "there are no points, so there is no shape"
                               : std::to_string(hull.triangulated_points) + " of " +
                                     std::to_string(hull.points) + " points are near the outline"));
  const std::string limit = limit_in_words(hull.chosen_sizes, hull.by_outlines, {});
  if (!limit.empty()) status.say(program + ": " + limit);
  const std::string& format = output.text_format();
  output.write(format == "wkt"   ? to_wkt(hull.polygons)
               : format == "wkb" ? to_wkb(hull.polygons)
                                 : geojson(hull, options, crs),
               crs, status);
}

}  // namespace polylidar::tool
