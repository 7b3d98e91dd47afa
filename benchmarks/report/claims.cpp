#include "benchmarks/report/claims.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>

#include "benchmarks/record/embedded.hpp"
#include "benchmarks/report/ratios.hpp"
#include "benchmarks/statistics/statistics.hpp"

namespace hullbench::report {
namespace {

using nlohmann::json;

/// The value of a run without a result, in time and error alike.
constexpr double kFailed = std::numeric_limits<double>::infinity();

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

/// One median a run: of the time within `boundary`, of the error as the paper divides it, or of a step's
/// time.
std::optional<double> value_of_run(const record::RunRecord& run, const std::string& quantity,
                                   Boundary boundary) {
  if (!is_measured(run)) return std::nullopt;
  if (quantity == "error") return metric(run, "l2_paper");
  const std::vector<std::int64_t> values =
      quantity == "time" ? times(run, boundary) : times_of_step(run, quantity);
  if (values.empty()) return std::nullopt;
  return statistics::median(values);
}

/// How a ratio is judged. One-sided, where the paper gives no number or a bound: {"at_least" | "more_than" |
/// "less_than": number}. Two-sided, where it gives a number: {"about": number, "within": factor}, from
/// about / within to about * within, or {"between": [number, number]}.
class Threshold {
 public:
  explicit Threshold(const json& check) {
    if (check.contains("at_least")) at_least_ = check["at_least"].get<double>();
    if (check.contains("more_than")) more_than_ = check["more_than"].get<double>();
    if (check.contains("less_than")) less_than_ = check["less_than"].get<double>();
    if (check.contains("between")) {
      at_least_ = check["between"].at(0).get<double>();
      at_most_ = check["between"].at(1).get<double>();
    }
    if (check.contains("about")) {
      const auto about = check["about"].get<double>();
      const auto within = check.at("within").get<double>();
      at_least_ = about / within;
      at_most_ = about * within;
    }
  }

  bool passes(double ratio) const {
    return (!at_least_ || ratio >= *at_least_) && (!more_than_ || ratio > *more_than_) &&
           (!less_than_ || ratio < *less_than_) && (!at_most_ || ratio <= *at_most_);
  }

  /// Of two ratios the one that speaks more against the claim.
  double worse(double a, double b) const {
    if (less_than_) return std::max(a, b);
    if (at_most_) return distance(a) > distance(b) ? a : b;
    return std::min(a, b);
  }

  /// "confirmed", or of a number of the paper's "larger" or "smaller" than it, or "refuted".
  std::string verdict(double ratio) const {
    if (passes(ratio)) return "confirmed";
    if (!at_most_) return "refuted";
    return ratio > *at_most_ ? "larger" : "smaller";
  }

 private:
  /// By which factor, as a logarithm, a ratio is off the middle of what is confirmed.
  double distance(double ratio) const {
    return std::abs(std::log(ratio) - std::log(*at_least_ * *at_most_) / 2);
  }

  std::optional<double> at_least_;
  std::optional<double> more_than_;
  std::optional<double> less_than_;
  std::optional<double> at_most_;
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

  /// One ratio a case, of several the one that speaks most against the claim.
  std::vector<double> by_case(Boundary boundary) const {
    std::map<Case, double> worst;
    for (const Case& which : measurements_.cases()) {
      if (!concerns(which)) continue;
      for (const double ratio : ratios(which, boundary)) {
        const auto [place, is_new] = worst.emplace(which, ratio);
        if (!is_new) place->second = threshold_.worse(place->second, ratio);
      }
    }
    std::vector<double> result;
    result.reserve(worst.size());
    for (const auto& [which, ratio] : worst) result.push_back(ratio);
    return result;
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
    return measurements_.find(method, paper().at("protocol").get<std::string>(), which);
  }

  /// Of how many of the claim's cases `is` holds.
  std::size_t count(const std::string& method, bool (*is)(const Runs&)) const {
    const std::vector<Case>& cases = measurements_.cases();
    return static_cast<std::size_t>(std::count_if(cases.begin(), cases.end(), [&](const Case& which) {
      return concerns(which) && is(runs_of(method, which));
    }));
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

  /// kFailed where the method failed, if it solves another case; none where it was not run or has no value.
  std::optional<double> value(const std::string& method, const Case& which, Boundary boundary) const {
    const Runs runs = runs_of(method, which);
    if (has_failed(runs) && solves_any(method)) return kFailed;
    if (!is_solved(runs)) return std::nullopt;
    std::vector<double> values;
    for (const record::RunRecord* run : runs) {
      if (const auto value = value_of_run(*run, quantity_, boundary)) values.push_back(*value);
    }
    if (values.empty()) return std::nullopt;
    return statistics::median(values);
  }

  std::vector<double> ratios(const Case& which, Boundary boundary) const {
    std::vector<double> result;
    const auto add = [&](std::optional<double> over, std::optional<double> under) {
      if (!over || !under || *over <= 0 || *under <= 0 || (*over == kFailed && *under == kFailed)) return;
      result.push_back(*over / *under);
    };
    for (const json& over : check_.value("over", json::array())) {
      for (const json& under : check_.at("under")) {
        add(value(over.get<std::string>(), which, boundary),
            value(under.get<std::string>(), which, boundary));
      }
    }
    if (!which.holes) return result;
    const Case without{which.dataset, false, which.n};
    for (const json& method : check_.value("with_holes", json::array())) {
      const std::string name = method.get<std::string>();
      add(value(name, which, boundary), value(name, without, boundary));
    }
    return result;
  }

  /// Why `method` has no value in any of its cases; empty when it has one.
  std::string why_missing(const std::string& method) const {
    const bool has_value =
        std::any_of(measurements_.cases().begin(), measurements_.cases().end(), [&](const Case& which) {
          return concerns(which) && is_solved(runs_of(method, which)) &&
                 value(method, which, Boundary::kPaper);
        });
    if (has_value) return "";
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
};

Verdict judge(const std::vector<double>& ratios, const Threshold& threshold, bool every_case) {
  if (!every_case) {
    const double middle = statistics::median(ratios);
    return {table::Number(middle).text(), middle, threshold.verdict(middle)};
  }
  const auto passed =
      std::count_if(ratios.begin(), ratios.end(), [&](double r) { return threshold.passes(r); });
  double worst = ratios.front();
  for (const double ratio : ratios) worst = threshold.worse(worst, ratio);
  return {std::to_string(passed) + " of " + std::to_string(ratios.size()), worst, threshold.verdict(worst)};
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
  const std::vector<double> values = ratios.by_case(Boundary::kPaper);
  if (values.empty()) {
    result["detail"] =
        missing.empty() ? "No case was measured for both sides of the comparison." : missing + ".";
    return result;
  }
  const bool every_case = check.at("of") == "every_case";
  const Verdict verdict = judge(values, ratios.threshold(), every_case);
  result["ours"] = verdict.text;
  if (std::isfinite(verdict.value)) result["value"] = verdict.value;
  result["verdict"] = verdict.verdict;
  if (check.at("quantity") == "time") {
    result["equal_work"] = judge(ratios.by_case(Boundary::kEqualWork), ratios.threshold(), every_case).text;
  }
  result["detail"] = claim.at("reading").get<std::string>() + " (" + std::to_string(values.size()) +
                     (values.size() == 1 ? " case" : " cases") + ")" +
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
