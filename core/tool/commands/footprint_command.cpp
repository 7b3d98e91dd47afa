// `polylidar footprint FILE...`: an index of files, each with the shape of its points.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <condition_variable>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <new>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "tool/commands/commands.hpp"
#include "tool/commands/shape_choice.hpp"
#include "tool/program/configuration_error.hpp"
#include "tool/program/interrupt.hpp"
#include "tool/program/result_output.hpp"
#include "tool/program/status_line.hpp"

namespace polylidar::tool {
namespace {

namespace fs = std::filesystem;

/// Bytes of memory that are free or can be freed; a guess where the system does not say.
std::uint64_t available_memory() {
  std::ifstream lines("/proc/meminfo");
  std::string name;
  std::uint64_t kibibytes = 0;
  std::string unit;
  while (lines >> name >> kibibytes && std::getline(lines, unit)) {
    if (name == "MemAvailable:") return kibibytes << 10U;
  }
  return std::uint64_t{1} << 30U;
}

/// Lets work begin while what all of it may take is within a budget, and one at a time whatever it takes.
class MemoryGate {
 public:
  explicit MemoryGate(std::uint64_t budget) : budget_(budget) {}

  void enter(std::uint64_t bytes) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return taken_ == 0 || taken_ + bytes <= budget_; });
    taken_ += bytes;
  }
  void leave(std::uint64_t bytes) {
    {
      const std::lock_guard lock(mutex_);
      taken_ -= bytes;
    }
    changed_.notify_all();
  }

 private:
  std::uint64_t budget_;
  std::uint64_t taken_ = 0;
  std::mutex mutex_;
  std::condition_variable changed_;
};

/// What became of a file.
struct Footprint {
  std::string feature;  ///< GeoJSON; empty when it could not be read
  std::string failure;  ///< why
  Crs crs;
};

std::string bounds_json(std::span<const Point> points) {
  if (points.empty()) return "null";
  const Box box = bounding_box(points);
  return "[" + shortest(box.min.x) + "," + shortest(box.min.y) + "," + shortest(box.max.x) + "," +
         shortest(box.max.y) + "]";
}

/// {"2":1000,"6":50}: how many points are of each classification.
std::string classes_json(const PointFile& file) {
  Properties classes;
  for (std::size_t c = 0; c < file.classes.size(); ++c) {
    if (file.classes[c] > 0) classes.add(std::to_string(c), static_cast<std::size_t>(file.classes[c]));
  }
  return classes.json();
}

std::string feature_of(const std::string& path, const PointFile& file, const Crs& crs,
                       const LocatedHulls& hulls) {
  const GroupHull& hull = hulls.groups[0];
  Properties properties;
  properties.add("name", std::string_view(fs::path(path).filename().native()));
  properties.add("path", std::string_view(path));
  properties.add("points", hull.points);
  if (hull.area > 0) {
    properties.add("density", static_cast<double>(hull.points) / hull.area);
  } else {
    properties.add_json("density", "null");
  }
  add_shape_properties(hull, properties);
  properties.add_json("bounds", bounds_json(file.points));
  properties.add_json("classes", classes_json(file));
  if (crs.name().empty()) {
    properties.add_json("crs", "null");
  } else {
    properties.add("crs", std::string_view(crs.name()));
  }
  return geojson_feature(properties, to_coordinates(hull.shape, file.points));
}

class FootprintRun {
 public:
  FootprintRun(const FootprintCommand& command, const Surroundings& surroundings)
      : command_(command),
        surroundings_(surroundings),
        status_(surroundings.err, surroundings.terminal),
        options_(point_options(command.shape)),
        gate_(available_memory() / 2),
        footprints_(command.inputs.size()) {
    options_.on_progress = [](std::uint64_t, std::optional<std::uint64_t>) { throw_if_interrupted(); };
  }

  ExitCode run() {
    chosen_crs(command_.shape, {});
    check_output_place(command_.shape.out);
    work_through();
    status_.clear();
    throw_if_interrupted();
    write_result(command_.shape.out, index());
    return summary();
  }

 private:
  /// The files one after the other, each taken by the next thread that is free.
  void work_through() {
    const unsigned threads = thread_count(command_.shape);
    const auto count = static_cast<unsigned>(std::min<std::size_t>(threads, footprints_.size()));
    std::size_t next = 0;
    const auto work = [&] {
      for (;;) {
        std::size_t k = 0;
        {
          const std::lock_guard lock(mutex_);
          if (next == footprints_.size() || interrupted()) return;
          k = next++;
        }
        // Threads that no other file can use.
        make(command_.inputs[k], footprints_[k], std::max(1U, threads / count));
        const std::lock_guard lock(mutex_);
        ++done_;
        if (surroundings_.terminal) {
          status_.show(std::to_string(done_) + " of " + std::to_string(footprints_.size()) + " files");
        }
      }
    };
    std::vector<std::jthread> helpers;
    for (unsigned t = 1; t < count; ++t) helpers.emplace_back(work);
    work();
  }

  /// What a file may take: its points, and the triangles of those. Of LAS, whose points have 20 bytes at
  /// least, a point takes some 150 bytes.
  static std::uint64_t memory_of(const std::string& path) {
    constexpr std::uint64_t kBytesAByte = 8;
    std::error_code error;
    const std::uintmax_t size = fs::file_size(path, error);
    return error ? 0 : kBytesAByte * size;
  }

  void make(const std::string& path, Footprint& footprint, unsigned threads) {
    const std::uint64_t memory = memory_of(path);
    gate_.enter(memory);
    try {
      const PointFile file = read_point_file(path, options_);
      footprint.crs = chosen_crs(command_.shape, file.crs);
      const LocatedHulls hulls = locate_hulls(file, command_.shape, false, threads, {});
      footprint.feature = feature_of(path, file, footprint.crs, hulls);
    } catch (const Interrupted&) {
      // The flag is set, and everybody sees it.
    } catch (const PointFileError& error) {
      footprint.failure = error.what();
    } catch (const std::bad_alloc&) {
      footprint.failure = path + ": there is not enough memory for its points";
    } catch (const std::exception& error) {
      footprint.failure = path + ": " + error.what();
    }
    gate_.leave(memory);
  }

  /// The coordinate system of all features, if it is one.
  Crs common_crs() const {
    std::optional<Crs> common;
    for (const Footprint& footprint : footprints_) {
      if (footprint.feature.empty()) continue;
      if (common && *common != footprint.crs) return {};
      common = footprint.crs;
    }
    return common.value_or(Crs());
  }

  std::string index() {
    std::vector<std::string> features;
    for (const Footprint& footprint : footprints_) {
      if (!footprint.feature.empty()) features.push_back(footprint.feature);
    }
    return geojson_collection(features, geojson_crs(common_crs()));
  }

  /// A line for each file that failed, and one for all.
  ExitCode summary() const {
    std::size_t failed = 0;
    bool differ = false;
    bool nameless = false;
    const Footprint* first = nullptr;
    for (const Footprint& footprint : footprints_) {
      if (!footprint.failure.empty()) {
        ++failed;
        surroundings_.err << surroundings_.program << ": " << footprint.failure << "\n";
        continue;
      }
      differ |= first != nullptr && first->crs != footprint.crs;
      nameless |= footprint.crs.is_given && footprint.crs.epsg == 0;
      if (first == nullptr) first = &footprint;
    }
    const std::size_t count = footprints_.size();
    surroundings_.err << surroundings_.program << ": " << count - failed << " of " << count
                      << (count == 1 ? " file is" : " files are") << " in the index"
                      << (failed > 0 ? ", " + std::to_string(failed) + " could not be read" : std::string())
                      << "\n";
    if (nameless) surroundings_.err << surroundings_.program << ": " << kNamelessCrs << "\n";
    if (differ) {
      surroundings_.err
          << surroundings_.program
          << ": the files have different coordinate systems, which each footprint names; programs "
             "that read the index take them as one\n";
    }
    return failed > 0 ? kExitFailures : kExitOk;
  }

  const FootprintCommand& command_;
  const Surroundings& surroundings_;
  StatusLine status_;
  PointFileOptions options_;
  MemoryGate gate_;
  std::mutex mutex_;  ///< of the files that are taken and done, and of the status line
  std::size_t done_ = 0;
  std::vector<Footprint> footprints_;  ///< one a file, in their order
};

}  // namespace

ExitCode make_footprints(const FootprintCommand& command, const Surroundings& surroundings) {
  // A closed pipe is then an error of writing, which is told like others.
  (void)::signal(SIGPIPE, SIG_IGN);
  return FootprintRun(command, surroundings).run();
}

void add_footprint_options(CLI::App& app, FootprintCommand& command) {
  app.description("Make a GeoJSON index of files, each with the shape of its points");
  app.footer(
      "The index has a feature for each file: name, path, points, density, parts, holes, area, bounds, the "
      "points of\n"
      "each classification, crs. Files are read by several threads, as many at a time as fit into half of "
      "the free\n"
      "memory. A file that cannot be read is told on standard error and left out. The formats are those of "
      "'polylidar\nhull'.");
  app.add_option("FILE", command.inputs, "The files of points")->required();
  add_shape_options(app, command.shape);
}

}  // namespace polylidar::tool
