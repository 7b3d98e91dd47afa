#include "benchmarks/report/headline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "benchmarks/report/claims.hpp"
#include "benchmarks/report/ratios.hpp"

namespace hullbench::report {
namespace {

using nlohmann::json;

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
  return std::all_of(kCounts.begin(), kCounts.end(),
                     [&](const char* name) { return agree(name, std::equal_to<>()); }) &&
         std::all_of(kAreas.begin(), kAreas.end(), [&](const char* name) { return agree(name, is_close); });
}

/// The lines that have a result, in the order of the records.
std::vector<Line> lines_with_results(const Measurements& measurements) {
  std::vector<Line> lines;
  for (const record::RunRecord& run : measurements.runs()) {
    const Line line = {run.method, run.protocol};
    if (is_measured(run) && std::find(lines.begin(), lines.end(), line) == lines.end()) lines.push_back(line);
  }
  return lines;
}

json finite_or_null(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? json(*value) : json(nullptr);
}

json rival_to_json(const Line& line, bool same, const Ratios& ratios) {
  const auto& interval = ratios.interval;
  return {{"method", line.method},
          {"protocol", line.protocol},
          {"same_polygons", same},
          {"cases", ratios.cases},
          {"failures", ratios.failures},
          {"median", finite_or_null(ratios.median)},
          {"low", interval ? finite_or_null(interval->low) : json(nullptr)},
          {"high", interval ? finite_or_null(interval->high) : json(nullptr)},
          {"least", finite_or_null(ratios.least)},
          {"most", finite_or_null(ratios.most)}};
}

}  // namespace

bool same_polygons(const Measurements& measurements, const Line& one, const Line& other) {
  bool compared = false;
  for (const Case& which : measurements.cases()) {
    const auto others = measurements.find(other.method, other.protocol, which);
    for (const record::RunRecord* run : measurements.find(one.method, one.protocol, which)) {
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
  if (!measurements.has_times() || std::find(lines.begin(), lines.end(), reference) == lines.end())
    return nullptr;
  const std::vector<Case>& cases = measurements.cases();
  json fastest;
  json papers;
  for (const Line& line : lines) {
    if (teller_of(line.method) == teller_of(reference.method)) continue;
    const bool is_papers =
        paper().at("rival").at("method") == line.method && line.protocol == reference.protocol;
    const bool same = same_polygons(measurements, line, reference);
    if (!same && !is_papers) continue;
    const Ratios ratios = time_ratios(measurements, line, reference, cases);
    if (ratios.cases == 0) continue;
    json rival = rival_to_json(line, same, ratios);
    if (is_papers) rival["does_more"] = paper().at("rival").at("does_more");
    if (same && std::isfinite(*ratios.median) &&
        (fastest.is_null() || *ratios.median < fastest.at("median").get<double>())) {
      fastest = rival;
    }
    if (is_papers) papers = std::move(rival);
  }
  json rivals = json::array();
  if (!fastest.is_null()) rivals.push_back(fastest);
  if (!papers.is_null() && papers != fastest) rivals.push_back(papers);
  if (rivals.empty()) return nullptr;
  return {{"reference", {{"method", reference.method}, {"protocol", reference.protocol}}},
          {"rivals", std::move(rivals)}};
}

}  // namespace hullbench::report
