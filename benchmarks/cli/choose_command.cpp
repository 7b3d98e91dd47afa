// `hullbench choose FILE`: all methods on somebody's own points, side by side, for somebody's own eyes.
#include <algorithm>
#include <array>
#include <cctype>
#include <iostream>
#include <stdexcept>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/base/cores.hpp"
#include "benchmarks/base/interrupt.hpp"
#include "benchmarks/base/words.hpp"
#include "benchmarks/choose/candidates.hpp"
#include "benchmarks/choose/choice_page.hpp"
#include "benchmarks/cli/options.hpp"
#include "benchmarks/cli/terminal.hpp"
#include "benchmarks/run/point_parts.hpp"
#include "benchmarks/table/writers.hpp"
#include "benchmarks/worker/stray_processes.hpp"
#include "tool/commands/shape_choice.hpp"
#include "tool/commands/shape_output.hpp"
#include "tool/hull/degrees.hpp"
#include "tool/points/point_file.hpp"
#include "tool/program/result_output.hpp"
#include "tool/shapes/index_shape.hpp"
#include "tool/shapes/polygon_writers.hpp"

namespace hullbench::cli {
namespace {

using polylidar::tool::shortest;
using Words = std::vector<std::string>;

struct ChooseCommand {
  std::string file;
  std::string columns;           ///< as of `hullbench hull`
  Words only;                    ///< METHOD or METHOD/PROTOCOL; empty: all
  std::optional<std::size_t> n;  ///< points that are taken at most; none: kMostPoints for a page, else all
  std::uint64_t seed = 1;        ///< of their sample, and of the halves
  double timeout_s = 10;
  std::optional<int> draws;        ///< of halves, instead of the plan's
  std::string out;                 ///< the page; empty: the file's name with an ending
  std::string write;               ///< a file for the polygons of one method, instead of a page
  std::vector<fs::path> adapters;  ///< more folders with manifests
};

/// Methods with a quadratic step are still done within the time limit.
constexpr std::size_t kMostPoints = 20000;
/// What a method gets for all points of a larger file, in seconds.
constexpr double kTimeoutForAll = 600;

/// The points of a file, and those that the methods get.
struct OwnPoints {
  polylidar::tool::PointFile file;
  std::optional<double> latitude;  ///< of the metres that degrees became; none: the plane is the file's
  std::vector<Point> plane;        ///< all points in it
  std::vector<Point> taken;        ///< of these

  bool is_sample() const { return taken.size() < plane.size(); }
};

OwnPoints read_points(const ChooseCommand& command) {
  if (command.file == "-") {
    throw ConfigurationError(
        "standard input cannot be read again by the commands on the page; give the name of a file");
  }
  polylidar::tool::PointFileOptions options;
  options.columns = command.columns;
  options.on_progress = [](std::uint64_t, std::optional<std::uint64_t>) { throw_if_interrupted(); };
  OwnPoints own;
  try {
    own.file = polylidar::tool::read_point_file(command.file, options);
  } catch (const polylidar::tool::PointFileError& error) {
    throw ConfigurationError(error.what());
  }
  const std::vector<Point>& points = own.file.points;
  if (points.size() < 3) {
    throw ConfigurationError(command.file + " has " + std::to_string(points.size()) +
                             (points.size() == 1 ? " point" : " points") + "; a hull needs at least 3");
  }
  if (!own.file.note.empty()) std::cerr << "hullbench: " << own.file.note << "\n";
  polylidar::tool::check_degrees(own.file.crs, polylidar::bounding_box(points));
  own.latitude = polylidar::tool::middle_latitude(own.file.crs, points);
  own.plane = own.latitude ? polylidar::tool::to_metres(points, *own.latitude) : points;
  const std::size_t most = command.n.value_or(command.write.empty() ? kMostPoints : points.size());
  own.taken = run::draw_sample(own.plane, most, command.seed);
  return own;
}

/// A word as a shell takes it.
std::string quoted(const std::string& word) {
  const auto is_plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string("-_./,:=+@%").find(c) != std::string::npos;
  };
  if (!word.empty() && std::ranges::all_of(word, is_plain)) return word;
  std::string result = "'";
  for (const char c : word) result += c == '\'' ? "'\\''" : std::string(1, c);
  return result + "'";
}

std::string shell_line(const Words& words) {
  return joined(words, " ", quoted);
}

/// `file` so that no program takes it for an option.
std::string as_operand(const std::string& file) {
  return file.starts_with("-") && file != "-" ? "./" + file : file;
}

/// The commands that make a candidate's polygons.
class Paster {
 public:
  Paster(const ChooseCommand& command, const OwnPoints& own) : command_(command), own_(own) {}

  std::vector<choose::PasteCommand> commands_for(const choose::Candidate& candidate) const {
    if (!candidate.succeeded()) return {};
    if (!has_sample(candidate)) return {{"These polygons as a file:", line_for_all(candidate)}};
    const Words sample = {"--n", std::to_string(own_.taken.size()), "--seed", std::to_string(command_.seed)};
    return {
        {"These polygons as a file:", shell_line(own_words(candidate, command_.timeout_s, sample))},
        {"Those of all " + std::to_string(own_.file.points.size()) + " points:", line_for_all(candidate)}};
  }

 private:
  bool has_sample(const choose::Candidate& candidate) const { return candidate.points < own_.plane.size(); }

  /// By `hullbench hull` where that has the method. Parameters that a rule computed from the sample do not
  /// apply to all points.
  std::string line_for_all(const choose::Candidate& candidate) const {
    if (candidate.record.method != "polylidar" || (has_sample(candidate) && !candidate.given.empty())) {
      const double timeout_s = std::max(command_.timeout_s, own_.is_sample() ? kTimeoutForAll : 0);
      return shell_line(own_words(candidate, timeout_s, {}));
    }
    Words words = {"hullbench", "hull", as_operand(command_.file)};
    if (!command_.columns.empty()) words.insert(words.end(), {"--columns", command_.columns});
    for (const auto& [name, value] : candidate.given) {
      std::string option = "--" + name;
      std::replace(option.begin(), option.end(), '_', '-');
      words.insert(words.end(), {option, shortest(value)});
    }
    words.insert(words.end(), {"--out", file_for(candidate)});
    return shell_line(words);
  }

  /// Of this command, with what was given to it.
  Words own_words(const choose::Candidate& candidate, double timeout_s, const Words& sample) const {
    Words words = {"hullbench", "choose", as_operand(command_.file)};
    if (!command_.columns.empty()) words.insert(words.end(), {"--columns", command_.columns});
    words.insert(words.end(), sample.begin(), sample.end());
    if (timeout_s != ChooseCommand().timeout_s) words.insert(words.end(), {"--timeout", shortest(timeout_s)});
    for (const fs::path& folder : command_.adapters)
      words.insert(words.end(), {"--adapters", folder.string()});
    words.insert(words.end(), {"--only", candidate.record.method + "/" + candidate.record.protocol, "--write",
                               file_for(candidate)});
    return words;
  }

  std::string file_for(const choose::Candidate& candidate) const {
    return as_operand(fs::path(command_.file).filename().string() + "." + candidate.record.method + "-" +
                      candidate.record.protocol + ".geojson");
  }

  const ChooseCommand& command_;
  const OwnPoints& own_;
};

choose::Question make_question(const ChooseCommand& command, const run::MethodCatalog& catalog) {
  choose::Question question = choose::ask(catalog, command.only);
  plan::Plan& plan = question.plan;
  plan.seed = command.seed;
  plan.timeout_s = command.timeout_s;
  plan.draws = command.write.empty() ? command.draws.value_or(plan.draws) : 0;
  Words names;
  for (plan::PlanMethod& entry : plan.methods) {
    entry.timeout_s.reset();
    names.push_back(entry.method + "/" + entry.protocol);
  }
  if (!command.write.empty() && names.size() != 1)
    throw ConfigurationError("--write takes the polygons of one method; add --only and one of " +
                             join_words(names));
  return question;
}

std::string geojson(const choose::Candidate& candidate, const OwnPoints& own) {
  const record::RunRecord& record = candidate.record;
  const MultiPolygon shape =
      own.latitude ? polylidar::tool::to_degrees(*candidate.result, own.file.points, *own.latitude)
                   : *candidate.result;
  polylidar::tool::Properties properties;
  properties.add("method", record.method);
  properties.add("protocol", record.protocol);
  properties.add("version", record.method_version);
  properties.add_json("parameters", json(record.parameters).dump());
  properties.add("points", candidate.points);
  properties.add("parts", shape.size());
  for (const char* name : {"holes", "area"}) properties.add_json(name, record.metrics.at(name).dump());
  return polylidar::tool::geojson_feature(properties, shape, polylidar::tool::geojson_crs(own.file.crs)) +
         "\n";
}

choose::Candidates compare(const ChooseCommand& command, const choose::Question& question,
                           const run::MethodCatalog& catalog, const OwnPoints& own, bool all_where_fast) {
  try {
    return choose::compare(question, own.taken, all_where_fast ? own.plane : own.taken, catalog,
                           reserve_worker_core(), &make_progress);
  } catch (const std::invalid_argument& error) {
    throw ConfigurationError(command.file + ": " + error.what());
  }
}

/// The areas of the runs are those on the plane in which the methods worked; these are those of `polylidar
/// hull`.
void measure_areas(choose::Candidates& candidates, const OwnPoints& own) {
  for (choose::Candidate& candidate : candidates.all) {
    if (!candidate.succeeded()) continue;
    candidate.record.metrics["area"] = polylidar::tool::area(*candidate.result, own.latitude);
  }
}

ExitCode choose_method(const ChooseCommand& command) {
  const std::string name = fs::path(command.file).filename().string();
  const std::string page = command.out.empty() ? name + ".choice.html" : command.out;
  const std::string& place = command.write.empty() ? page : command.write;
  const run::MethodCatalog catalog(run::manifest_folders(command.adapters));
  const choose::Question question = make_question(command, catalog);
  const OwnPoints own = read_points(command);
  const std::array inputs = {command.file};
  polylidar::tool::check_is_none_of(place, inputs);
  polylidar::tool::check_output_place(place);
  const bool all_where_fast = own.is_sample() && !command.n;
  const choose::PointSource source = {.name = name,
                                      .total = own.plane.size(),
                                      .taken = own.taken.size(),
                                      .all_where_fast = all_where_fast,
                                      .seed = command.seed,
                                      .box = polylidar::bounding_box(own.plane),
                                      .in_metres = own.latitude.has_value(),
                                      .draws = question.plan.draws};
  if (own.is_sample())
    std::cerr << "hullbench: " << told_of(source) << " --n takes more or fewer for all methods\n";
  worker::end_strays_of_dead_harnesses();
  choose::Candidates candidates = compare(command, question, catalog, own, all_where_fast);
  measure_areas(candidates, own);
  const ExitCode code = run::exit_code(candidates.outcome);
  if (candidates.all.empty()) return code;
  if (!command.write.empty()) {
    if (!candidates.all.front().succeeded()) return code;
    polylidar::tool::write_result(place, geojson(candidates.all.front(), own));
  } else {
    const Paster paster(command, own);
    for (choose::Candidate& candidate : candidates.all) candidate.commands = paster.commands_for(candidate);
    polylidar::tool::write_result(place, choice_page(candidates, own.taken, source));
    table::print_markdown(choice_table(candidates, source), std::cout);
  }
  std::cerr << "hullbench: wrote " << place << "\n";
  return code;
}

}  // namespace

void add_choose(CLI::App& app, Action& action) {
  const auto command = std::make_shared<ChooseCommand>();
  CLI::App& options =
      add_command(app, "choose", "Show what all methods make of your points, to choose one by eye",
                  "hullbench choose points.csv --columns lon,lat --only polylidar --only convex_hull");
  options.footer(
      "Every installed method chooses its parameters by itself, as in the plan 'real'. The page shows for "
      "each result\n"
      "a picture, its numbers and the command that makes it again. It needs no network. If a method fails or "
      "runs out\n"
      "of time, its card says how. The true shape is not known, so agreement and stability are only "
      "hints.\n" +
      options.get_footer());
  options.add_option("FILE", command->file, "The points, in any format that 'hullbench hull' reads")
      ->required();
  options.add_option(
      "--columns", command->columns,
      "The columns of x and y in a text file: names, such as lon,lat, or numbers from 1, such as 2,3");
  options
      .add_option("--only", command->only,
                  "Only this method, or METHOD/PROTOCOL, such as cgal_alpha_shape/auto; may be repeated")
      ->allow_extra_args(false);
  options
      .add_option("--n", command->n,
                  "Give all methods this many points at random if the file has more; the default is " +
                      std::to_string(kMostPoints) + " for slow methods, and all points with --write")
      ->check(CLI::Range(std::size_t{3}, std::size_t{1} << 32U));
  options.add_option("--seed", command->seed, "Seed of the random choice of points and of halves")
      ->check(seed_range())
      ->capture_default_str();
  options.add_option("--timeout", command->timeout_s, "Time limit of one run in seconds")
      ->check(timeout_range())
      ->capture_default_str();
  options
      .add_option("--draws", command->draws,
                  "How often to draw random halves for the stability, instead of as the plan says; 0: never")
      ->check(CLI::Range(0, 100));
  CLI::Option* const out = options.add_option(
      "-o,--out", command->out, "The page, instead of the file's name with .choice.html in this folder");
  options
      .add_option("--write", command->write,
                  "Write the polygons of the one method that --only names into this file, as GeoJSON, "
                  "instead of a page")
      ->excludes(out);
  add_adapters(options, command->adapters);
  set_action(options, action, command, &choose_method);
}

}  // namespace hullbench::cli
