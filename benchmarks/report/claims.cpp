#include "benchmarks/report/claims.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>

#include "benchmarks/record/embedded.hpp"
#include "benchmarks/report/ratios.hpp"
#include "benchmarks/statistics/judge.hpp"
#include "benchmarks/statistics/statistics.hpp"
#include "benchmarks/table/cell.hpp"

namespace hullbench::report {
namespace {

std::vector<PaperStep> read_steps() {
  std::vector<PaperStep> result;
  for (const json& entry : paper().at("steps").at("names")) {
    result.push_back(
        {entry.at("step").get<std::string>(), entry.at("parts").get<std::vector<std::string>>()});
  }
  return result;
}

/// The repetitions of the step that the paper calls `name`.
std::vector<std::int64_t> times_of_step(const record::RunRecord& run, const std::string& name) {
  for (const PaperStep& step : paper_steps()) {
    if (step.name == name) return step_times(run, step.parts);
  }
  throw std::logic_error("results/paper.json has a claim about \"" + name +
                         "\", which is none of its steps.");
}

/// Of `references` the run with the same seed as `run`: on the same points where the case is the same.
const record::RunRecord* of_same_seed(const record::RunRecord& run, const Runs& references) {
  const auto found = std::ranges::find_if(
      references, [&](const record::RunRecord* other) { return other->seed == run.seed; });
  return found == references.end() ? nullptr : *found;
}

/// How a ratio is judged. One-sided, where the paper gives no number or a bound: {"at_least" | "more_than" |
/// "less_than": number}. Two-sided, where it gives a number: {"about": number, "within": factor}, from
/// about / within to about * within, or {"between": [number, number]}.
class Threshold {
 public:
  explicit Threshold(const json& check) : is_number_(check.contains("between") || check.contains("about")) {
    // The judge takes a limit alone to be below it, so one that counts otherwise is moved by a rounding.
    const auto below = [](double limit) { return std::nextafter(limit, -kInfinity); };
    if (check.contains("at_least")) above_ = below(check["at_least"].get<double>());
    if (check.contains("more_than")) above_ = check["more_than"].get<double>();
    if (check.contains("less_than")) at_most_ = below(check["less_than"].get<double>());
    if (check.contains("between")) {
      above_ = below(check["between"].at(0).get<double>());
      at_most_ = check["between"].at(1).get<double>();
    }
    if (check.contains("about")) {
      const auto about = check["about"].get<double>();
      const auto within = check.at("within").get<double>();
      above_ = below(about / within);
      at_most_ = about * within;
    }
  }

  /// Of two ratios the one that speaks more against the claim.
  double worse(double a, double b) const {
    if (is_number_) return distance(a) > distance(b) ? a : b;
    return at_most_ < kInfinity ? std::max(a, b) : std::min(a, b);
  }

  /// "confirmed", or of a number of the paper's "larger" or "smaller" than it, or "refuted", if all of the
  /// interval of the ratio is so; else "undecided".
  std::string verdict(const statistics::Interval& ratio) const {
    const statistics::Side low = statistics::side_of(ratio, above_);
    const statistics::Side high = statistics::side_of(ratio, at_most_);
    if (low == statistics::Side::kBelow) return is_number_ ? "smaller" : "refuted";
    if (high == statistics::Side::kAbove) return is_number_ ? "larger" : "refuted";
    return low == statistics::Side::kAbove && high == statistics::Side::kBelow ? "confirmed" : "undecided";
  }

 private:
  /// By which factor, as a logarithm, a ratio is off the middle of what is confirmed.
  double distance(double ratio) const { return std::abs(std::log(ratio) - std::log(above_ * at_most_) / 2); }

  bool is_number_;
  double above_ = -kInfinity;   ///< a ratio that is confirmed is above this one ...
  double at_most_ = kInfinity;  ///< ... and at most this one
};

/// The ratios a claim is about, over the cases of a report.
class ClaimRatios {
 public:
  ClaimRatios(const json& report, const Measurements& measurements, const json& check)
      : report_(report),
        measurements_(measurements),
        check_(check),
        threshold_(check),
        quantity_(check.at("quantity").get<std::string>()) {}

  /// The ratios of each case, of several rivals those that speak most against the claim.
  std::vector<CaseRatios> by_case(Boundary boundary) const {
    std::vector<CaseRatios> result;
    for (const Case& which : measurements_.cases()) {
      if (!concerns(which)) continue;
      std::optional<CaseRatios> worst;
      for (CaseRatios& one : ratios(which, boundary)) {
        if (!worst || threshold_.worse(worst->middle, one.middle) != worst->middle) worst = std::move(one);
      }
      if (worst) result.push_back(std::move(*worst));
    }
    return result;
  }

  /// Where the median of the cases' ratios lies. A single error or failure is exact; a time that was taken
  /// once says nothing.
  statistics::Interval interval(std::span<const CaseRatios> cases) const {
    if (const auto interval = interval_over(cases)) return *interval;
    const double only = cases.front().middle;
    if (quantity_ == "error" || !std::isfinite(only)) return {only, only};
    return {0, kInfinity};
  }

  /// Why methods of this claim are not in it, one clause each; empty when all are.
  std::string missing() const {
    return of_each_method([&](const std::string& method) { return why_missing(method); });
  }

  /// In how many of its cases each method failed, one clause each; empty when none did.
  std::string failures() const {
    return of_each_method([&](const std::string& method) -> std::string {
      const std::size_t failed = solves_any(method) ? count(method, &has_failed) : 0;
      return failed == 0
                 ? ""
                 : title(method) + " in " + std::to_string(failed) + (failed == 1 ? " case" : " cases");
    });
  }

  const Threshold& threshold() const { return threshold_; }

 private:
  bool concerns(const Case& which) const {
    const json& datasets = paper().at("claims").at("datasets");
    if (std::find(datasets.begin(), datasets.end(), which.dataset) == datasets.end()) return false;
    if (!check_.contains("only")) return true;
    const json& only = check_["only"];
    return only.at("dataset") == which.dataset && only.at("holes") == which.holes && only.at("n") == which.n;
  }

  static bool has_failed(const Runs& runs) { return !is_missing(runs) && first_failure(runs) != nullptr; }
  static bool is_solved(const Runs& runs) { return !is_missing(runs) && first_failure(runs) == nullptr; }

  static std::string title(const std::string& method) { return paper().at("methods").value(method, method); }

  Runs runs_of(const std::string& method, const Case& which) const {
    return measurements_.find({method, paper().at("protocol").get<std::string>()}, which);
  }

  /// Of how many of the claim's cases `is` holds.
  std::size_t count(const std::string& method, bool (*is)(const Runs&)) const {
    const std::vector<Case>& cases = measurements_.cases();
    return static_cast<std::size_t>(std::ranges::count_if(
        cases, [&](const Case& which) { return concerns(which) && is(runs_of(method, which)); }));
  }

  /// A method without any result says nothing about the claim: it may not work on this machine at all.
  bool solves_any(const std::string& method) const { return count(method, &is_solved) > 0; }

  template <typename Clause>
  std::string of_each_method(const Clause& clause_of) const {
    std::string result;
    for (const char* role : {"over", "under", "with_holes"}) {
      for (const json& method : check_.value(role, json::array())) {
        const std::string clause = clause_of(method.get<std::string>());
        if (!clause.empty()) result += (result.empty() ? "" : "; ") + clause;
      }
    }
    return result;
  }

  /// Of the quantity, by round. An error has no rounds.
  statistics::Passes measured_ratios(const Runs& over, const Runs& under, Boundary boundary) const {
    if (quantity_ == "error") return metric_ratio(over, under, "l2_paper");
    return round_ratios(over, under, &of_same_seed,
                        [&](const record::RunRecord& run) { return times_of(run, boundary); });
  }

  std::vector<std::int64_t> times_of(const record::RunRecord& run, Boundary boundary) const {
    return quantity_ == "time" ? times(run, boundary) : times_of_step(run, quantity_);
  }

  bool has_value(const Runs& runs) const {
    return std::ranges::any_of(runs, [&](const record::RunRecord* run) {
      return quantity_ == "error" ? metric(*run, "l2_paper").has_value()
                                  : !times_of(*run, Boundary::kPaper).empty();
    });
  }

  /// The ratios of a case, one entry for each pair of methods. A method that failed is infinitely bad, if it
  /// solves another case.
  std::vector<CaseRatios> ratios(const Case& which, Boundary boundary) const {
    std::vector<CaseRatios> result;
    const auto add = [&](const std::string& over, const std::string& under, const Case& under_case) {
      const Runs above = runs_of(over, which);
      const Runs below = runs_of(under, under_case);
      const bool over_failed = has_failed(above) && solves_any(over);
      const bool under_failed = has_failed(below) && solves_any(under);
      if (over_failed == under_failed && !(is_solved(above) && is_solved(below))) return;
      statistics::Passes passes;
      if (over_failed) {
        if (is_solved(below) && has_value(below)) passes = {{kInfinity}};
      } else if (under_failed) {
        if (is_solved(above) && has_value(above)) passes = {{0}};
      } else {
        passes = measured_ratios(above, below, boundary);
      }
      if (!passes.empty()) result.emplace_back(which, std::move(passes));
    };
    for (const json& over : check_.value("over", json::array())) {
      for (const json& under : check_.at("under")) {
        add(over.get<std::string>(), under.get<std::string>(), which);
      }
    }
    if (!which.holes) return result;
    for (const json& method : check_.value("with_holes", json::array())) {
      const std::string name = method.get<std::string>();
      add(name, name, {which.dataset, false, which.n});
    }
    return result;
  }

  /// Why `method` has no value in any of its cases; empty when it has one.
  std::string why_missing(const std::string& method) const {
    const bool is_there =
        std::any_of(measurements_.cases().begin(), measurements_.cases().end(), [&](const Case& which) {
          const Runs runs = runs_of(method, which);
          return concerns(which) && is_solved(runs) && has_value(runs);
        });
    if (is_there) return "";
    if (solves_any(method) && quantity_ == "error") return title(method) + " has no error that is defined";
    if (solves_any(method)) return title(method) + " does not tell its step \"" + quantity_ + "\"";
    for (const json& info : report_.value("methods", json::array())) {
      if (info.value("name", "") == method && !info.value("installed", true)) {
        return info.value("title", title(method)) + " is not installed";
      }
    }
    if (!check_.contains("only")) return title(method) + " has no successful run here";
    return title(method) + " has no successful run at n = " + check_["only"].at("n").dump() + " here";
  }

  const json& report_;
  const Measurements& measurements_;
  const json& check_;
  Threshold threshold_;
  std::string quantity_;
};

struct Verdict {
  std::string text;
  double value = 0;
  std::string verdict;
  std::string detail;  ///< what the records say of the verdict; may be empty
};

/// Of the median over the cases.
Verdict judge_median(const ClaimRatios& ratios, std::span<const CaseRatios> cases) {
  std::vector<double> middles;
  middles.reserve(cases.size());
  for (const CaseRatios& one : cases) middles.push_back(one.middle);
  const double middle = statistics::median(middles);
  const statistics::Interval interval = ratios.interval(cases);
  Verdict result = {table::Number(middle).text(), middle, ratios.threshold().verdict(interval), ""};
  if (interval.low < interval.high) {
    result.detail = ", 95 % interval " + table::Number(interval.low).text() + " to " +
                    table::Number(interval.high).text();
  }
  return result;
}

/// Each case for itself: one against the claim is enough.
Verdict judge_every_case(const ClaimRatios& ratios, std::span<const CaseRatios> cases) {
  const Threshold& threshold = ratios.threshold();
  std::size_t confirmed = 0;
  std::size_t undecided = 0;
  double worst = cases.front().middle;
  std::optional<double> against;  // of the cases that decide against the claim the worst
  std::string verdict = "confirmed";
  for (const CaseRatios& one : cases) {
    worst = threshold.worse(worst, one.middle);
    const std::string word = threshold.verdict(ratios.interval({&one, 1}));
    confirmed += word == "confirmed" ? 1U : 0U;
    undecided += word == "undecided" ? 1U : 0U;
    if (word == "confirmed" || word == "undecided") continue;
    if (against && threshold.worse(*against, one.middle) == *against) continue;
    against = one.middle;
    verdict = word;
  }
  if (!against && undecided > 0) verdict = "undecided";
  return {std::to_string(confirmed) + " of " + std::to_string(cases.size()), worst, verdict,
          undecided == 0 ? "" : ", undecided: " + std::to_string(undecided)};
}

json check_claim(const json& claim, const json& report, const Measurements& measurements) {
  json result = {{"id", claim.at("id")},       {"claim", claim.at("claim")}, {"where", claim.at("where")},
                 {"paper", claim.at("paper")}, {"ours", "not measured"},     {"value", nullptr},
                 {"equal_work", nullptr},      {"verdict", nullptr}};
  const json& check = claim.at("check");
  if (is_about_time(claim) && !measurements.has_times()) {
    result["detail"] = measurements.why_no_times();
    return result;
  }
  const ClaimRatios ratios(report, measurements, check);
  const std::string missing = ratios.missing();
  const std::string failures = ratios.failures();
  const std::vector<CaseRatios> cases = ratios.by_case(Boundary::kPaper);
  if (cases.empty()) {
    result["detail"] =
        missing.empty() ? "No case was measured for both sides of the comparison." : missing + ".";
    return result;
  }
  const auto judge = check.at("of") == "every_case" ? &judge_every_case : &judge_median;
  const Verdict verdict = judge(ratios, cases);
  result["ours"] = verdict.text;
  if (std::isfinite(verdict.value)) result["value"] = verdict.value;
  result["verdict"] = verdict.verdict;
  if (check.at("quantity") == "time")
    result["equal_work"] = judge(ratios, ratios.by_case(Boundary::kEqualWork)).text;
  result["detail"] = claim.at("reading").get<std::string>() + " (" + std::to_string(cases.size()) +
                     (cases.size() == 1 ? " case" : " cases") + verdict.detail + ")" +
                     (failures.empty() ? "" : "; failed, which counts as infinitely bad: " + failures) +
                     (missing.empty() ? "" : "; left out: " + missing) + ".";
  return result;
}

}  // namespace

const json& paper() {
  static const json values = json::parse(record::kPaperJson);
  return values;
}

Line reference_line() {
  return {paper().at("reference_method").get<std::string>(), paper().at("protocol").get<std::string>()};
}

std::string teller_of(const std::string& method) {
  return paper().at("steps").at("told_by").value(method, method);
}

const std::vector<PaperStep>& paper_steps() {
  static const std::vector<PaperStep> steps = read_steps();
  return steps;
}

bool is_about_time(const json& claim) {
  return claim.at("check").at("quantity") != "error";
}

json check_claims(const json& report) {
  const Measurements measurements(report);
  json result = json::array();
  for (const json& claim : paper().at("claims").at("list")) {
    result.push_back(check_claim(claim, report, measurements));
  }
  return result;
}

}  // namespace hullbench::report
