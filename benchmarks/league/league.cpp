#include "benchmarks/league/league.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <tuple>

#include "benchmarks/record/pictures.hpp"
#include "benchmarks/record/protocols.hpp"
#include "benchmarks/statistics/statistics.hpp"
#include "benchmarks/statistics/weighted.hpp"
#include "benchmarks/tune/search.hpp"
#include "benchmarks/tune/split.hpp"
#include "benchmarks/tune/strata.hpp"

namespace hullbench::league {
namespace {

/// Errors of the same polygons differ by rounding, and those of rows that were kept have nine digits. This
/// part of an error is neither.
constexpr double kSameError = 1e-7;
/// Finer than tables show: medians that are the same in this unit are in the order of the methods' names.
constexpr double kShownError = 1e-6;
/// The rows of one method and protocol, by case.
using RowsByCase = std::map<std::string, const json*>;
using Entrant = std::pair<std::string, std::string>;  ///< method, protocol

bool is_ok(const json& row) {
  return row.at("status") == "ok";
}

std::optional<double> metric(const json& row, const char* name) {
  const json& metrics = row.at("metrics");
  const auto found = metrics.find(name);
  if (found == metrics.end() || !found->is_number()) return std::nullopt;
  return found->get<double>();
}

std::string shape_of(const json& row) {
  const std::string dataset = row.at("dataset").get<std::string>();
  return row.value("base_shape", dataset);
}

/// What the rows of all methods say of a case.
struct CaseFacts {
  std::string shape;
  std::string dataset;
  bool scored = false;     ///< its errors count
  std::size_t parts = 1;   ///< of the ground truth
  std::size_t holes = 0;   ///< of all its parts
  double weight = 0;       ///< of a scored case
  bool has_skill = false;  ///< some method's skill is defined there
  /// Statuses that the case's plan accepts; none of a plan whose results have errors.
  std::set<std::string> accepted;

  std::string kind() const { return tune::kind_of_shape(parts, holes); }
  std::string sampler() const { return tune::sampler_of(dataset); }
  std::string stratum() const { return sampler() + ", " + kind(); }
};

/// How many polygons or holes the ground truth has, of a row that has a result.
std::optional<std::size_t> count_in_truth(const json& row, const std::string& what) {
  const auto found = metric(row, what.c_str());
  const auto error = metric(row, (what + "_error").c_str());
  if (!found || !error) return std::nullopt;
  return static_cast<std::size_t>(std::llround(*found - *error));
}

/// Where a plan accepts failures, how a run ends is all that counts: an error of a million per cent on points
/// that are 1e8 apart says nothing about shapes.
void learn(CaseFacts& facts, const json& row, const std::set<std::string>& accepted) {
  facts.shape = shape_of(row);
  facts.dataset = row.at("dataset").get<std::string>();
  facts.accepted.insert(accepted.begin(), accepted.end());
  if (!accepted.empty()) return;
  if (const auto area = metric(row, "ground_truth_area"); area && *area > 0) facts.scored = true;
  if (metric(row, "skill")) facts.has_skill = true;
  facts.parts = count_in_truth(row, "polygons").value_or(facts.parts);
  facts.holes = count_in_truth(row, "holes").value_or(facts.holes);
}

/// What a method can answer with.
struct Capabilities {
  bool holes = true;
  bool several_polygons = true;

  bool can_have(const CaseFacts& facts) const {
    return (holes || facts.holes == 0) && (several_polygons || facts.parts == 1);
  }
};

/// Nothing of a method that did not start there.
void learn(std::map<std::string, Capabilities>& capabilities, const json& method) {
  const json said = method.value("capabilities", json::object());
  if (!said.contains("holes")) return;
  capabilities[method.at("name").get<std::string>()] = {said.at("holes").get<bool>(),
                                                        said.at("several_polygons").get<bool>()};
}

/// All rows, sorted.
struct Field {
  std::map<Entrant, RowsByCase> rows;
  std::map<std::string, CaseFacts> cases;
  std::map<std::string, Capabilities> capabilities;  ///< by method, of those that say so
  std::vector<std::string> not_installed;
};

void weigh(std::map<std::string, CaseFacts>& cases) {
  std::vector<CaseFacts*> scored;
  std::vector<tune::Membership> members;
  for (auto& [name, facts] : cases) {
    if (!facts.scored) continue;
    scored.push_back(&facts);
    members.push_back({facts.stratum(), facts.shape});
  }
  if (scored.empty()) return;
  const std::vector<double> weights = tune::case_weights(members);
  for (std::size_t i = 0; i < scored.size(); ++i) scored[i]->weight = weights[i];
}

Field sort_rows(const std::vector<json>& reports, bool test_only) {
  Field field;
  std::set<std::string> installed;
  std::set<std::string> missing;
  for (const json& report : reports) {
    const auto accepted = report.at("plan").value("accepted", std::set<std::string>());
    for (const json& method : report.at("methods")) learn(field.capabilities, method);
    for (const json& row : report.at("runs")) {
      const bool is_test = tune::side_of(row.at("dataset").get<std::string>()) == tune::Side::kTest;
      if (test_only && accepted.empty() && !is_test) continue;
      const std::string method = row.at("method").get<std::string>();
      if (row.at("status") == "not_installed") {
        missing.insert(method);
        continue;
      }
      installed.insert(method);
      const std::string name =
          record::case_of_run(row.at("name").get<std::string>()) + "/seed:" + row.at("seed").dump();
      field.rows[{method, row.at("protocol").get<std::string>()}].emplace(name, &row);
      learn(field.cases[name], row, accepted);
    }
  }
  std::set_difference(missing.begin(), missing.end(), installed.begin(), installed.end(),
                      std::back_inserter(field.not_installed));
  weigh(field.cases);
  return field;
}

/// Infinity for what stands for it in medians and intervals, which need numbers.
double from_finite(double value) {
  if (tune::is_infinitely_bad(value)) return kInfinity;
  return tune::is_infinitely_bad(-value) ? -kInfinity : value;
}

/// l2 of a row; kInfinitelyBad for a failure.
double error_of(const json& row) {
  return is_ok(row) ? metric(row, "l2").value_or(tune::kInfinitelyBad) : tune::kInfinitelyBad;
}

/// Values of an entry on some of the cases, which are weighed among themselves.
class Samples {
 public:
  void add(const CaseFacts& facts, std::optional<double> value) {
    if (value) values_.add({facts.stratum(), facts.shape}, *value);
  }
  double median() const { return from_finite(values_.median()); }
  /// None without a value.
  std::optional<MedianScore> median_score() const {
    if (values_.empty()) return std::nullopt;
    MedianScore score = {values_.size(), median(), values_.median_interval()};
    if (score.interval)
      score.interval =
          statistics::Interval{from_finite(score.interval->low), from_finite(score.interval->high)};
    return score;
  }
  /// Of values from 0 to 1, beyond which a normal interval can reach.
  std::optional<MeanScore> mean_score() const {
    if (values_.empty()) return std::nullopt;
    MeanScore score = {statistics::weighted_mean(values_.all()),
                       statistics::weighted_mean_interval(values_.by_shape())};
    if (score.interval) {
      score.interval = statistics::Interval{std::clamp(score.interval->low, 0.0, 1.0),
                                            std::clamp(score.interval->high, 0.0, 1.0)};
    }
    return score;
  }

 private:
  tune::WeighedValues values_;
};

/// Errors on some of the cases.
struct PartSamples {
  Samples l2;
  std::size_t cases = 0;
  std::size_t failures = 0;

  void add(const CaseFacts& facts, double error) {
    l2.add(facts, error);
    ++cases;
    if (error >= tune::kInfinitelyBad) ++failures;
  }
};

std::map<std::string, PartScore> part_scores(const std::map<std::string, PartSamples>& parts) {
  std::map<std::string, PartScore> scores;
  for (const auto& [name, part] : parts) scores[name] = {part.cases, part.failures, part.l2.median()};
  return scores;
}

std::optional<double> skill_of(const json& row, bool ok, const CaseFacts& facts) {
  if (!facts.has_skill) return std::nullopt;
  return ok ? metric(row, "skill") : std::optional(-tune::kInfinitelyBad);
}

std::optional<double> hole_f1_of(const json& row, bool ok, const CaseFacts& facts) {
  if (facts.holes == 0) return std::nullopt;
  return ok ? metric(row, "hole_f1").value_or(0) : 0;
}

std::optional<double> regret_of(double error, const std::string& name, const RowsByCase* oracle) {
  if (oracle == nullptr) return std::nullopt;
  const auto best = oracle->find(name);
  if (best == oracle->end() || error_of(*best->second) >= tune::kInfinitelyBad) return std::nullopt;
  return error >= tune::kInfinitelyBad ? tune::kInfinitelyBad : error - error_of(*best->second);
}

LeagueEntry make_entry(const Field& field, const Entrant& entrant, const RowsByCase& rows) {
  LeagueEntry entry;
  entry.method = entrant.first;
  entry.protocol = entrant.second;
  const auto oracle = field.rows.find({entrant.first, "oracle"});
  const auto known = field.capabilities.find(entrant.first);
  const Capabilities able = known == field.capabilities.end() ? Capabilities() : known->second;
  Samples l2;
  Samples l2_where_able;
  std::map<std::string, PartSamples> kinds;
  std::map<std::string, PartSamples> samplers;
  Samples skill;
  Samples hole_f1;
  Samples regret;
  for (const auto& [name, row] : rows) {
    const CaseFacts& facts = field.cases.at(name);
    const std::string status = row->at("status").get<std::string>();
    const double error = error_of(*row);
    const bool ok = error < tune::kInfinitelyBad;
    if (!facts.scored) {
      ++entry.unscored_cases;
      if (status != "ok" && !facts.accepted.contains(status)) ++entry.unscored_failures;
      continue;
    }
    ++entry.cases;
    if (!ok) {
      ++entry.failures;
      ++entry.failures_by_status[status];
    }
    l2.add(facts, error);
    if (able.can_have(facts)) l2_where_able.add(facts, error);
    kinds[facts.kind()].add(facts, error);
    samplers[facts.sampler()].add(facts, error);
    skill.add(facts, skill_of(*row, ok, facts));
    hole_f1.add(facts, hole_f1_of(*row, ok, facts));
    regret.add(facts, regret_of(error, name, oracle == field.rows.end() ? nullptr : &oracle->second));
  }
  entry.l2 = l2.median_score();
  entry.l2_where_able = l2_where_able.median_score();
  entry.kinds = part_scores(kinds);
  entry.samplers = part_scores(samplers);
  entry.skill = skill.median_score();
  entry.hole_f1 = hole_f1.median_score();
  entry.hole_f1_mean = hole_f1.mean_score();
  entry.regret = regret.median_score();
  return entry;
}

/// From points in memory to valid polygons in memory; kept leagues have no times.
std::optional<double> seconds_of(const json& row) {
  const auto times = row.value("time_ns", std::vector<std::int64_t>());
  if (times.empty() || !is_ok(row)) return std::nullopt;
  return statistics::median(times) / 1e9;
}

std::vector<LeagueResult> make_results(const Field& field) {
  std::vector<LeagueResult> results;
  for (const auto& [entrant, rows] : field.rows) {
    for (const auto& [name, row] : rows) {
      const CaseFacts& facts = field.cases.at(name);
      if (!facts.scored) continue;
      results.push_back({entrant.first, entrant.second,
                         record::case_of_run(row->at("name").get<std::string>()), row->at("seed").dump(),
                         row->value("n", std::size_t{0}), row->at("status").get<std::string>(),
                         from_finite(error_of(*row)), seconds_of(*row), facts.shape, facts.kind(),
                         facts.sampler(), facts.weight});
    }
  }
  return results;
}

/// The names of the scored cases that all of `entrants` have.
std::vector<std::string> common_cases(const Field& field, const std::vector<Entrant>& entrants) {
  std::vector<std::string> result;
  for (const auto& [name, facts] : field.cases) {
    const std::string& key = name;
    const bool common = std::ranges::all_of(
        entrants, [&](const Entrant& entrant) { return field.rows.at(entrant).contains(key); });
    if (facts.scored && common) result.push_back(name);
  }
  return result;
}

std::size_t scored_cases(const Field& field, const Entrant& entrant) {
  const RowsByCase& rows = field.rows.at(entrant);
  return static_cast<std::size_t>(
      std::ranges::count_if(rows, [&](const auto& row) { return field.cases.at(row.first).scored; }));
}

LeagueProfile make_profile(const Field& field, const std::string& group, const std::vector<Entrant>& all) {
  LeagueProfile profile;
  profile.group = group;
  std::size_t most = 0;
  for (const Entrant& entrant : all) most = std::max(most, scored_cases(field, entrant));
  std::vector<Entrant> entrants;
  for (const Entrant& entrant : all)
    (2 * scored_cases(field, entrant) < most ? profile.left_out : entrants).push_back(entrant);
  for (const auto& [method, protocol] : entrants)
    profile.curves.push_back({method, protocol, std::vector<double>(league_taus().size(), 0.0)});
  double weight = 0;
  for (const std::string& name : common_cases(field, entrants)) {
    std::vector<double> errors;
    errors.reserve(entrants.size());
    for (const Entrant& entrant : entrants) errors.push_back(error_of(*field.rows.at(entrant).at(name)));
    const double best = *std::ranges::min_element(errors);
    if (best >= tune::kInfinitelyBad) continue;
    ++profile.cases;
    const double case_weight = field.cases.at(name).weight;
    weight += case_weight;
    for (std::size_t i = 0; i < errors.size(); ++i) {
      for (std::size_t k = 0; k < league_taus().size(); ++k) {
        if (errors[i] < tune::kInfinitelyBad && errors[i] <= league_taus()[k] * best * (1 + kSameError))
          profile.curves[i].shares[k] += case_weight;
      }
    }
  }
  for (LeagueProfile::Curve& curve : profile.curves) {
    // A share that is 1 but for rounding is 1.
    for (double& share : curve.shares) share = weight > 0 ? std::min(1.0, share / weight) : 0;
  }
  return profile;
}

std::vector<LeagueProfile> make_profiles(const Field& field) {
  std::vector<LeagueProfile> profiles;
  for (const record::ProtocolGroup& group : record::protocol_groups()) {
    std::vector<Entrant> members;
    for (const auto& [entrant, rows] : field.rows) {
      if (std::ranges::count(group.protocols, entrant.second) > 0) members.push_back(entrant);
    }
    if (!members.empty()) profiles.push_back(make_profile(field, group.name, members));
  }
  return profiles;
}

void add_parts(League& league, const Field& field) {
  std::map<std::string, LeaguePart> kinds;
  std::map<std::string, LeaguePart> samplers;
  for (const auto& [name, facts] : field.cases) {
    if (!facts.scored) continue;
    for (LeaguePart* part : {&kinds[facts.kind()], &samplers[facts.sampler()]}) ++part->cases;
    if (tune::has_unseen_sampler(facts.dataset)) samplers[facts.sampler()].seen = false;
  }
  const auto add = [](std::vector<LeaguePart>& to, const std::map<std::string, LeaguePart>& from,
                      const std::string& name) {
    if (const auto found = from.find(name); found != from.end())
      to.push_back({name, found->second.cases, found->second.seen});
  };
  for (const std::string& kind : tune::shape_kinds()) add(league.kinds, kinds, kind);
  constexpr const char* kSeveral = "several";
  for (const tune::SplitRow& row : tune::sampler_split()) add(league.samplers, samplers, row.name);
  // Those that the split does not know: no shape is sampled as towns are.
  for (const auto& [name, part] : samplers) {
    if (name != kSeveral &&
        std::ranges::find(league.samplers, name, &LeaguePart::name) == league.samplers.end())
      add(league.samplers, samplers, name);
  }
  add(league.samplers, samplers, kSeveral);
}

}  // namespace

const std::vector<double>& league_taus() {
  static const std::vector<double> taus = {1, 1.05, 1.1, 1.2, 1.35, 1.5, 1.75, 2, 2.5, 3, 4, 5, 7, 10};
  return taus;
}

League make_league(const std::vector<json>& reports, bool test_only) {
  const Field field = sort_rows(reports, test_only);
  if (field.rows.empty())
    throw std::runtime_error(test_only ? "no run is of a test shape; measure more shapes, or take all cases"
                                       : "there is no run of an installed method");
  League league;
  league.test_only = test_only;
  league.not_installed = field.not_installed;
  std::set<std::string> shapes;
  for (const auto& [name, facts] : field.cases) {
    if (!facts.scored) continue;
    ++league.cases;
    shapes.insert(facts.shape);
  }
  league.shapes = shapes.size();
  add_parts(league, field);
  for (const auto& [entrant, rows] : field.rows) league.entries.push_back(make_entry(field, entrant, rows));
  std::map<std::string, std::size_t> most;  // cases of an entry of the protocol
  for (const LeagueEntry& entry : league.entries)
    most[entry.protocol] = std::max(most[entry.protocol], entry.cases);
  // A median of few cases is not better than one of all.
  const std::vector<std::string> order = record::protocols_by_group();
  const auto key = [&](const LeagueEntry& entry) {
    return std::make_tuple(std::ranges::find(order, entry.protocol),
                           2 * entry.cases < most.at(entry.protocol),
                           entry.l2 ? std::round(entry.l2->median / kShownError) : kInfinity, entry.method);
  };
  std::ranges::sort(league.entries,
                    [&](const LeagueEntry& a, const LeagueEntry& b) { return key(a) < key(b); });
  league.profiles = make_profiles(field);
  league.results = make_results(field);
  return league;
}

}  // namespace hullbench::league
