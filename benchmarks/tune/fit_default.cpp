// build/fit_default: fits the numbers of the core's automatic limit on the training side of the split, prints
// them beside those in the code, and says what the rule gives on the test side. Accuracy only: nothing is
// timed, and the result does not depend on the machine.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/base/cores.hpp"
#include "benchmarks/base/exit_code.hpp"
#include "benchmarks/base/files.hpp"
#include "benchmarks/base/names.hpp"
#include "benchmarks/base/number_format.hpp"
#include "benchmarks/base/parallel.hpp"
#include "benchmarks/statistics/statistics.hpp"
#include "benchmarks/table/writers.hpp"
#include "benchmarks/tune/limit_fit.hpp"
#include "benchmarks/tune/split.hpp"
#include "datasets/datasets.hpp"
#include "datasets/random.hpp"
#include "polylidar/concave_hull.hpp"
#include "tool/program/command_line.hpp"

namespace hullbench::tune {
namespace {

std::string digits(const LimitKnob& knob, const AutomaticConstants& constants) {
  std::ostringstream text;
  text << knob.value(constants);
  return text.str();
}

void print(const std::string& title, const table::Table& table) {
  std::cout << "\n## " << title << "\n\n";
  table::print_markdown(table, std::cout);
}

/// Whether the searches gain on ways to sample that they did not see, by more than the standard error over
/// these.
bool print_held_out(std::vector<MadeLimitCase>& cases, int tries, std::uint64_t seed) {
  const std::vector<HeldOutWay> ways = cross_validate_limit(cases, tries, seed, allowed_cores());
  table::Table table{
      "held_out", "Held out", {table::words("way left out"), "score, code", "score, found without it"}};
  std::vector<double> gains;
  for (const HeldOutWay& way : ways) {
    table.add_row({way.sampling, table::Number(way.score_of_code, 4), table::Number(way.score_of_found, 4)});
    gains.push_back(way.score_of_code - way.score_of_found);
  }
  print("Ways to sample that a search did not see", table);
  const double mean = statistics::mean(gains);
  const double deviation = statistics::standard_deviation(gains).value_or(0);
  const double standard_error = deviation / std::sqrt(static_cast<double>(gains.size()));
  std::cout << "\nMean gain " << fixed(mean, 4) << ", standard error " << fixed(standard_error, 4) << ".\n";
  return mean > standard_error;
}

void print_fit(std::vector<MadeLimitCase>& cases, int tries, std::uint64_t seed) {
  const std::vector<LimitClimb> climbs = fit_limit(cases, tries, seed, allowed_cores());
  table::Table table{"starts", "Searches", {table::words("start"), "its score", "score found"}};
  for (const LimitKnob& knob : limit_knobs()) table.columns.emplace_back(knob.name);
  for (const LimitClimb& climb : climbs) {
    std::vector<table::Cell> row = {climb.start, table::Number(climb.score_from, 4),
                                    table::Number(climb.score_to, 4)};
    for (const LimitKnob& knob : limit_knobs()) row.emplace_back(digits(knob, climb.to));
    table.add_row(row);
  }
  print("Searches, with the constants that each found", table);
  const bool gains = print_held_out(cases, tries, seed);
  const LimitClimb& best =
      *std::ranges::min_element(climbs, [](const auto& a, const auto& b) { return a.score_to < b.score_to; });
  std::cout
      << (gains ? "\nThe constants to take are the best found, as searches gain on what they did not see"
                : "\nThe constants to take are those in the code, as searches gain nothing on what they did "
                  "not see")
      << " (core/src/automatic_constants.hpp):\n\n";
  const AutomaticConstants taken = gains ? best.to : AutomaticConstants{};
  for (const LimitKnob& knob : limit_knobs()) {
    std::cout << "    " << knob.name << " = " << digits(knob, taken) << ";  // in the code "
              << digits(knob, {}) << "\n";
  }
}

void print_variants(std::vector<MadeLimitCase>& training, std::vector<MadeLimitCase>& test) {
  const std::vector<int> cores = allowed_cores();
  const auto score = [&](std::vector<MadeLimitCase>& cases, const AutomaticConstants& constants) {
    return table::Number(limit_score(cases, constants, cores), 3);
  };
  table::Table parts{"ablation", "Parts", {table::words("rule"), "score, training", "score, test"}};
  for (const LimitVariant& one : limit_ablations())
    parts.add_row({one.name, score(training, one.constants), score(test, one.constants)});
  print("Without parts of the rule", parts);
  table::Table table{"sensitivity",
                     "Constants",
                     {table::words("constant"), "in the code", "x 0.8, training", "x 1.25, training",
                      "x 0.8, test", "x 1.25, test"}};
  const std::vector<LimitVariant> smaller = limit_sensitivities(0.8);
  const std::vector<LimitVariant> larger = limit_sensitivities(1.25);
  for (std::size_t k = 0; k < smaller.size(); ++k) {
    table.add_row({smaller[k].name, digits(limit_knobs()[k], {}), score(training, smaller[k].constants),
                   score(training, larger[k].constants), score(test, smaller[k].constants),
                   score(test, larger[k].constants)});
  }
  print("With one constant changed", table);
}

/// What one way to sample gave, in percent.
struct Errors {
  std::vector<double> rule, one_limit, former, vertex_spacing;
};

table::Cell median_and_mean(const std::vector<double>& errors) {
  table::Cell cell = table::Number(100 * statistics::median(errors), 2);
  cell.other = table::Number(100 * statistics::mean(errors), 2);
  return cell;
}

void print_test(std::vector<MadeLimitCase>& cases) {
  const std::vector<double> rule = limit_errors(cases, {}, allowed_cores());
  std::vector<std::string> order;
  std::set<std::string> unseen;
  std::map<std::string, std::map<std::size_t, Errors>> errors;  // way to sample -> number of points
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const std::string sampling =
        sampling_of(cases[i].name.dataset) + (cases[i].name.holes ? ", states with holes" : "");
    if (!errors.contains(sampling)) order.push_back(sampling);
    if (has_unseen_sampler(cases[i].name.dataset)) unseen.insert(sampling);
    Errors& into = errors[sampling][cases[i].name.n];
    into.rule.push_back(rule[i]);
    into.one_limit.push_back(cases[i].best_of_one_limit);
    into.former.push_back(cases[i].triangles->error_of_former_default());
    into.vertex_spacing.push_back(cases[i].triangles->error_of_vertex_spacing());
  }
  table::Table table{"test", "Test side", {table::words("points"), table::words("unseen")}};
  for (const auto& [n, unused] : errors.at("uniform")) {
    for (const char* what : {"rule", "one limit", "former"})
      table.columns.emplace_back(std::string(what) + ", " + std::to_string(n));
  }
  for (const std::string& sampling : order) {
    std::vector<table::Cell> row = {sampling, unseen.contains(sampling) ? "x" : ""};
    for (const auto& [n, of_n] : errors[sampling]) {
      for (const auto* values : {&of_n.rule, &of_n.one_limit, &of_n.former})
        row.push_back(median_and_mean(*values));
    }
    table.add_row(row);
  }
  print("Test shapes: L2 in %, median and in brackets mean over 18 shapes, 2 with holes", table);
  std::cout
      << "\nOne limit: the largest perimeter that is best for the very case, found with the truth in "
         "hand.\nFormer: the default of earlier versions, one largest perimeter chosen from the points.\n"
         "Unseen: no training case is sampled so.\n";

  table::Table beside{"vertices", "Vertices", {table::words("points")}};
  for (const auto& [n, unused] : errors.at("uniform")) {
    for (const char* what : {"rule", "by vertices"})
      beside.columns.emplace_back(std::string(what) + ", " + std::to_string(n));
    beside.columns.push_back(table::with_unit("difference, " + std::to_string(n), "%"));
  }
  for (const std::string& sampling : order) {
    std::vector<table::Cell> row = {sampling};
    for (const auto& [n, of_n] : errors[sampling]) {
      row.push_back(median_and_mean(of_n.rule));
      row.push_back(median_and_mean(of_n.vertex_spacing));
      const double ratio = statistics::median(of_n.rule) / statistics::median(of_n.vertex_spacing);
      row.emplace_back(table::Number(100 * (ratio - 1), 1));
    }
    beside.add_row(row);
  }
  print("Beside a spacing for each vertex (vertex_spacing.hpp): L2 in %, and the difference of the medians",
        beside);
}

/// Of so many points that places have sizes of their own, what these give beside blocks.
void print_places(std::size_t n) {
  struct Both {
    std::vector<double> places, blocks;
  };
  const std::vector<LimitCaseName> names = large_limit_cases(n);
  std::vector<std::optional<std::pair<double, double>>> errors(names.size());
  for_each_in_parallel(names.size(), allowed_cores(), [&](std::size_t i) {
    const PointSet set = make_point_set(names[i].dataset, names[i].holes, names[i].n, 1);
    LimitCase one(set.points, set.ground_truth);
    const double error = one.error({});
    if (one.sizes_by() == polylidar::detail::SizesBy::kPlaces) errors[i] = {error, one.error_by_blocks({})};
  });
  table::Table table{
      "places", "Places", {table::words("points"), "shapes with places", "by places", "by blocks"}};
  for (auto begin = names.begin(); begin != names.end();) {
    const std::string sampling = sampling_of(begin->dataset);
    Both both;
    auto end = begin;
    for (; end != names.end() && sampling_of(end->dataset) == sampling; ++end) {
      const auto& error = errors[static_cast<std::size_t>(end - names.begin())];
      if (!error) continue;
      both.places.push_back(error->first);
      both.blocks.push_back(error->second);
    }
    std::vector<table::Cell> row = {sampling, both.places.size()};
    for (const auto* values : {&both.places, &both.blocks}) {
      row.push_back(values->empty() ? table::Cell() : median_and_mean(*values));
    }
    table.add_row(std::move(row));
    begin = end;
  }
  print("Places and blocks, " + std::to_string(n) +
            " points: L2 in %, median and in brackets mean over the shapes where places are used",
        table);
}

/// Of points without a shape every hole is a void that chance made, and every part but one, too.
void print_voids() {
  constexpr std::size_t kSets = 20;
  table::Table table{
      "voids", "Chance", {table::words("points"), "number", "holes a set", "sets without", "parts a set"}};
  for (const bool is_normal : {false, true}) {
    for (const std::size_t n : {2000U, 8000U, 100000U}) {
      std::vector<double> holes(kSets);
      std::vector<double> parts(kSets);
      for_each_in_parallel(kSets, allowed_cores(), [&](std::size_t k) {
        Random random(derive_seed(k, "voids"));
        std::vector<Point> points(n);
        for (Point& p : points) {
          p.x = is_normal ? random.normal() : random.uniform();
          p.y = is_normal ? random.normal() : random.uniform();
        }
        const polylidar::IndexedMultiPolygon hull = polylidar::concave_hull(points);
        parts[k] = static_cast<double>(hull.polygon_count());
        holes[k] = static_cast<double>(hull.ring_ends.size()) - parts[k];
      });
      table.add_row({is_normal ? "normal" : "uniform in a square", n,
                     table::Number(statistics::mean(holes), 2), std::ranges::count(holes, 0),
                     table::Number(statistics::mean(parts), 2)});
    }
  }
  print("Chance: 20 sets of points without a shape", table);
}

json to_json(const MultiPolygon& shape) {
  json rings = json::array();
  const auto add = [&](const Ring& ring) {
    json& points = rings.emplace_back(json::array());
    for (const Point& p : ring) points.push_back({p.x, p.y});
  };
  for (const Polygon& polygon : shape) {
    add(polygon.shell);
    for (const Ring& hole : polygon.holes) add(hole);
  }
  return rings;
}

/// Points of a shape under each way to sample, with the rule's hull and that of the former default:
/// plots/make_default_pictures.py draws them.
void write_pictures(const fs::path& file) {
  json pictures = json::array();
  for (const LimitCaseName& name : test_limit_cases(2000)) {
    if (!name.dataset.starts_with("letter_b") || name.holes) continue;
    const PointSet set = make_point_set(name.dataset, false, name.n, 1);
    LimitCase one(set.points, set.ground_truth);
    const auto hull = [&](const polylidar::Options& options) {
      return to_json(polylidar::to_coordinates(polylidar::concave_hull(set.points, options), set.points));
    };
    json points = json::array();
    for (const Point& p : set.points) points.push_back({p.x, p.y});
    pictures.push_back(
        {{"sampling", sampling_of(name.dataset)},
         {"points", points},
         {"former", hull({.max_perimeter = one.former_limit(), .fill_single_triangles = true})},
         {"former_l2", one.error_of_former_default()},
         {"rule", hull({})},
         {"rule_l2", one.error({})}});
  }
  write_text_file(file, pictures.dump());
}

ExitCode fit(int tries, std::uint64_t seed, bool with_ablation) {
  std::vector<MadeLimitCase> training = make_limit_cases(training_limit_cases(), allowed_cores());
  std::cout << "# The core's automatic limit, fitted on " << training.size() << " training cases\n\n";
  table::print_item(
      "Score: the mean over ways to sample (uniform counts 1.5) of the mean of log(error / error "
      "of the best single perimeter limit with the truth in hand), each from -1.5 to 1.5.",
      std::cout);
  table::print_item(
      "Of the constants in the code: " + fixed(limit_score(training, {}, allowed_cores()), 4) + ".",
      std::cout);
  if (tries > 0) print_fit(training, tries, seed);
  std::vector<MadeLimitCase> few = make_limit_cases(test_limit_cases(500), allowed_cores());
  print_test(few);
  std::vector<LimitCaseName> names = test_limit_cases(2000);
  for (const LimitCaseName& name : test_limit_cases(8000)) names.push_back(name);
  std::vector<MadeLimitCase> test = make_limit_cases(names, allowed_cores());
  print_test(test);
  print_places(300'000);
  print_voids();
  if (with_ablation) print_variants(training, test);
  return kExitOk;
}

}  // namespace
}  // namespace hullbench::tune

int main(int argc, char** argv) {
  CLI::App app("Fits the numbers of the core's automatic limit, and says what it gives on the test side",
               "fit_default");
  int tries = 400;
  std::uint64_t seed = 1;
  bool with_ablation = false;
  std::filesystem::path pictures;
  app.add_option("--tries", tries, "Of each search; 0: none, the tables alone")
      ->check(CLI::Range(0, 1000000))
      ->capture_default_str();
  app.add_option("--seed", seed, "Of the searches")->capture_default_str();
  app.add_flag("--ablation", with_ablation,
               "Also the rule without each of its parts, and with each constant changed");
  app.add_option("--pictures", pictures, "Only write points and hulls into this file (JSON), for a figure");
  app.footer(hullbench::kExitCodesHelp);
  const auto fit = [&] {
    if (pictures.empty()) return hullbench::tune::fit(tries, seed, with_ablation);
    hullbench::tune::write_pictures(pictures);
    return hullbench::kExitOk;
  };
  return hullbench::exit_code_of("fit_default", std::cerr,
                                 [&] { return polylidar::tool::parsed_action(app, fit, argc, argv)(); });
}
