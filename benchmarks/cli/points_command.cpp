// `hullbench points DATASET`: the points of any data set, or of all shapes of a family, as a file.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <iostream>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/base/interrupt.hpp"
#include "benchmarks/base/status_line.hpp"
#include "benchmarks/cli/options.hpp"
#include "benchmarks/cli/terminal.hpp"
#include "datasets/datasets.hpp"
#include "tool/points/point_writer.hpp"
#include "tool/program/free_memory.hpp"
#include "tool/program/result_output.hpp"

namespace hullbench::cli {
namespace {

using polylidar::Box;
using polylidar::tool::check_output_place;
using polylidar::tool::free_memory;
using polylidar::tool::PointOutput;
using polylidar::tool::ResultOutput;

struct PointsCommand {
  std::string dataset;
  std::size_t count = 0;  ///< 0: the data set's own points
  std::uint64_t seed = 1;
  bool holes = false;
  std::string format = "auto";  ///< or a name that point_output_of() knows
  std::string out;              ///< a file; empty or "-": standard output
};

/// What sampling takes at most for a point: a grown vector of them, the ones that are kept, and an image.
constexpr std::size_t kBytesAPoint = 80;

/// Points between two looks at the clock and at interruptions, and in one write.
constexpr std::size_t kBlock = std::size_t{1} << 16U;

std::string gibibytes(double bytes) {
  return std::to_string(static_cast<std::uint64_t>(bytes / (1U << 30U)) + 1) + " GiB";
}

[[noreturn]] void refuse_for_memory(const PointsCommand& command, const std::string& what) {
  throw std::runtime_error(
      what + " for " + std::to_string(command.count) + " points of '" + command.dataset +
      "', which are drawn all at once; ask for fewer of them, or for uniform ones, which "
      "are written as they are drawn");
}

/// What is written one after the other: a data set, or each member of a family, whose label is its number.
struct Part {
  std::string dataset;
  std::uint32_t label = 0;
};

std::vector<Part> parts_of(const std::string& name) {
  const std::size_t end = std::min(name.find('~'), name.size());
  const std::string stresses = name.substr(end);
  for (const DatasetInfo& info : datasets()) {
    if (info.members == 0 || info.name != name.substr(0, end)) continue;
    std::vector<Part> parts;
    for (std::uint32_t member = 1; member <= info.members; ++member)
      parts.push_back({info.name + "-" + std::to_string(member) + stresses, member});
    return parts;
  }
  return {{name, 0}};
}

/// Better now than when the system has begun to end programs.
void check_memory(const PointsCommand& command, std::size_t parts) {
  if (is_streamed(command.dataset)) return;
  const auto available = free_memory();
  if (!available || command.count <= *available / kBytesAPoint / parts) return;
  refuse_for_memory(command,
                    "the free memory, " + gibibytes(static_cast<double>(*available)) + ", may be too small");
}

/// What the work is at, from its first second on.
class PointsProgress {
 public:
  void show(const char* doing, std::size_t done, std::size_t points) {
    throw_if_interrupted();
    using namespace std::chrono_literals;
    if (std::chrono::steady_clock::now() - start_ < 1s) return;
    status_.show(std::string(doing) + ": " + std::to_string(done) + " of " + std::to_string(points) +
                 " points");
  }
  /// The samplers do not say how far they are.
  void show_drawing(std::size_t points) {
    constexpr std::size_t kAboutASecond = 300'000;
    if (points >= kAboutASecond) status_.show("drawing " + std::to_string(points) + " points");
  }

 private:
  StatusLine status_{std::cerr, is_terminal()};
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

PointOutput output_format(const PointsCommand& command) {
  if (const auto named = polylidar::tool::point_output_of(command.format)) return *named;
  if (command.out.empty()) return PointOutput::kCsv;
  if (const auto known = polylidar::tool::point_output_of_ending(command.out)) return *known;
  throw ConfigurationError("the ending of '" + command.out +
                           "' names no format; give .csv, .xyz, .txt, .npy or .las, or --format");
}

/// All points of the parts, each with its label. A copy goes on from where its original is.
class LabelledStream {
 public:
  LabelledStream(const std::vector<Part>& parts, const PointsCommand& command) {
    for (const Part& part : parts) {
      streams_.push_back(stream_points(part.dataset, command.holes, command.count, command.seed));
      labels_.push_back(part.label);
      size_ += streams_.back().size();
    }
  }

  std::size_t size() const { return size_; }

  /// There are size() of them.
  std::pair<Point, std::uint32_t> next() {
    while (given_ == streams_[part_].size()) {
      ++part_;
      given_ = 0;
    }
    ++given_;
    return {streams_[part_].next(), labels_[part_]};
  }

 private:
  std::vector<PointStream> streams_;
  std::vector<std::uint32_t> labels_;
  std::size_t size_ = 0;
  std::size_t part_ = 0;
  std::size_t given_ = 0;  ///< of this part
};

/// Takes its own copy of the stream, so that the points can be written after it.
Box bounds_of(LabelledStream points, PointsProgress& progress) {
  if (points.size() == 0) return {{0, 0}, {0, 0}};
  const Point first = points.next().first;
  Box box{first, first};
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (i % kBlock == 0) progress.show("measuring", i, points.size());
    const Point point = points.next().first;
    box = joined(box, {point, point});
  }
  return box;
}

ExitCode write_points(const PointsCommand& command) {
  const PointOutput format = output_format(command);
  const std::vector<Part> parts = parts_of(command.dataset);
  polylidar::tool::check_point_count(format, command.count * parts.size());
  check_output_place(command.out);
  check_memory(command, parts.size());
  PointsProgress progress;
  if (!is_streamed(command.dataset)) progress.show_drawing(command.count * parts.size());
  LabelledStream points(parts, command);
  polylidar::tool::PointFileFacts facts{
      .count = points.size(), .has_labels = parts.front().label > 0, .bounds = {}};
  // LAS says in front how far the points reach.
  if (format == PointOutput::kLas) facts.bounds = bounds_of(points, progress);
  const polylidar::tool::PointEncoder encoder(format, facts);
  ResultOutput output(command.out);
  std::string bytes = encoder.header();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i % kBlock == 0) {
      progress.show("writing", i, points.size());
      output.write(bytes);
      bytes.clear();
    }
    const auto [point, label] = points.next();
    encoder.append(point, label, bytes);
  }
  output.write(bytes);
  output.finish();
  return kExitOk;
}

ExitCode make_points(const PointsCommand& asked) {
  // A closed pipe is then an error of writing, which is told like others; so is a file beyond the limit.
  (void)::signal(SIGPIPE, SIG_IGN);
  (void)::signal(SIGXFSZ, SIG_IGN);
  PointsCommand command = asked;
  if (command.out == "-") command.out.clear();
  try {
    return write_points(command);
  } catch (const std::invalid_argument& error) {
    throw ConfigurationError(error.what());
  } catch (const std::bad_alloc&) {
    refuse_for_memory(command, "the memory is too small");
  }
}

}  // namespace

void add_points(CLI::App& app, Action& action) {
  const auto command = std::make_shared<PointsCommand>();
  CLI::App& options = add_command(app, "points", "Write the points of a data set into a file",
                                  "hullbench points 'ca~gradient:16~noise:0.5' --n 100000 --out points.npy");
  options.footer(
      "The points are those that a run draws for the same data set, number and seed, on every machine.\n"
      "'hullbench list' shows the data sets and what can follow their names. Uniform points, also with "
      "water,\n"
      "outliers, noise and quantised, are written as they are drawn, so there may be more than memory "
      "holds.\n"
      "Others are drawn all at once. The name of a family, such as 'cell~transcripts:5', gives N points of "
      "each\n"
      "of its shapes and the shape's number in a column label; 'polylidar hull --by label' then makes one "
      "hull\n"
      "for each shape. LAS is 1.2 with point format 0, which rounds coordinates to a power of ten below a\n"
      "400,000,000th of the larger side.\n" +
      options.get_footer());
  options
      .add_option("DATASET", command->dataset,
                  "The name of a data set or of a family, as 'hullbench list' shows it")
      ->required();
  options
      .add_option(
          "--n", command->count,
          "Number of points of each shape; not for data sets that come with their points, such as floor-1")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1'000'000'000'000'000}));
  options.add_option("--seed", command->seed, "Seed of the random numbers")
      ->check(seed_range())
      ->capture_default_str();
  options.add_flag("--holes", command->holes, "Take the variant with holes");
  options
      .add_option("--format", command->format,
                  "The file's format; auto: by its ending, .csv, .xyz, .txt, .npy or .las")
      ->check(CLI::IsMember({"auto", "csv", "xyz", "npy", "las"}))
      ->capture_default_str();
  options.add_option("--out", command->out,
                     "File for the points; without it they go to standard output, as csv");
  set_action(options, action, command, &make_points);
}

}  // namespace hullbench::cli
