#include "benchmarks/report/headline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "benchmarks/base/number_format.hpp"
#include "benchmarks/report/claims.hpp"
#include "benchmarks/report/ratios.hpp"
#include "benchmarks/statistics/judge.hpp"

namespace hullbench::report {
namespace {

bool is_close(double one, double other) {
  return std::abs(one - other) <= kSamePolygons * std::max(std::abs(one), std::abs(other));
}

/// Of two runs on the same points that gave a result.
bool same_result(const record::RunRecord& one, const record::RunRecord& other) {
  constexpr std::array kCounts = {"polygons", "holes", "vertices"};
  constexpr std::array kAreas = {"area", "l2"};
  const auto agree = [&](const char* name, const auto& same) {
    const auto first = metric(one, name);
    const auto second = metric(other, name);
    return first.has_value() == second.has_value() && (!first || same(*first, *second));
  };
  return std::ranges::all_of(kCounts, [&](const char* name) { return agree(name, std::equal_to<>()); }) &&
         std::ranges::all_of(kAreas, [&](const char* name) { return agree(name, is_close); });
}

/// The lines that have a result, in the order of the records.
std::vector<Line> lines_with_results(const Measurements& measurements) {
  std::vector<Line> lines;
  for (const record::RunRecord& run : measurements.runs()) {
    const Line line = {run.method, run.protocol};
    if (is_measured(run) && std::ranges::find(lines, line) == lines.end()) lines.push_back(line);
  }
  return lines;
}

struct Rival {
  Line line;
  bool same = false;  ///< it gives the reference method's polygons
  bool is_papers = false;
  Ratios ratios;  ///< of its times to the reference method's
};

json rival_to_json(const Rival& rival) {
  const Ratios& ratios = rival.ratios;
  const auto& interval = ratios.interval;
  json result = {{"method", rival.line.method},
                 {"protocol", rival.line.protocol},
                 {"same_polygons", rival.same},
                 {"cases", ratios.cases},
                 {"failures", ratios.failures},
                 {"median", finite_or_null(ratios.median)},
                 {"low", interval ? finite_or_null(interval->low) : json(nullptr)},
                 {"high", interval ? finite_or_null(interval->high) : json(nullptr)},
                 {"least", finite_or_null(ratios.least)},
                 {"most", finite_or_null(ratios.most)}};
  if (rival.is_papers) result["does_more"] = paper().at("rival").at("does_more");
  return result;
}

/// Beyond doubt, over the cases that both have.
bool is_slower(const Measurements& measurements, const Line& line, const Line& than) {
  if (line == than) return false;
  const Ratios ratios = time_ratios(measurements, line, than, measurements.cases());
  return ratios.interval && statistics::side_of(*ratios.interval, 1) == statistics::Side::kAbove;
}

}  // namespace

bool same_polygons(const Measurements& measurements, const Line& one, const Line& other) {
  bool compared = false;
  for (const Case& which : measurements.cases()) {
    const auto others = measurements.find(other, which);
    for (const record::RunRecord* run : measurements.find(one, which)) {
      const record::RunRecord* beside = counterpart(*run, others);
      if (beside == nullptr || !is_measured(*run) || !is_measured(*beside)) continue;
      if (!same_result(*run, *beside)) return false;
      compared = true;
    }
  }
  return compared;
}

json make_headline(const Measurements& measurements) {
  const Line reference = reference_line();
  const std::vector<Line> lines = lines_with_results(measurements);
  if (!measurements.has_times() || std::ranges::find(lines, reference) == lines.end()) return nullptr;
  std::vector<Rival> rivals;
  for (const Line& line : lines) {
    if (teller_of(line.method) == teller_of(reference.method)) continue;
    Rival rival = {line,
                   same_polygons(measurements, line, reference),
                   paper().at("rival").at("method") == line.method && line.protocol == reference.protocol,
                   {}};
    if (!rival.same && !rival.is_papers) continue;
    rival.ratios = time_ratios(measurements, line, reference, measurements.cases());
    if (rival.ratios.cases > 0) rivals.push_back(std::move(rival));
  }
  const auto candidates = std::stable_partition(rivals.begin(), rivals.end(), [](const Rival& rival) {
    return rival.same && std::isfinite(*rival.ratios.median);
  });
  std::stable_sort(rivals.begin(), candidates,
                   [](const Rival& a, const Rival& b) { return *a.ratios.median < *b.ratios.median; });
  json told = json::array();
  for (auto rival = rivals.begin(); rival != rivals.end(); ++rival) {
    const bool is_first = rival < candidates && !is_slower(measurements, rival->line, rivals.front().line);
    if (is_first || rival->is_papers) told.push_back(rival_to_json(*rival));
  }
  if (told.empty()) return nullptr;
  return {{"reference", {{"method", reference.method}, {"protocol", reference.protocol}}},
          {"rivals", std::move(told)}};
}

}  // namespace hullbench::report
