#include "benchmarks/tune/fit_score.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "benchmarks/statistics/statistics.hpp"
#include "benchmarks/tune/search.hpp"

namespace hullbench::tune {

double fit_score(const std::vector<std::string>& shapes, const std::vector<double>& errors) {
  std::map<std::string, std::vector<double>> logarithms;
  for (std::size_t i = 0; i < errors.size(); ++i)
    logarithms[shapes[i]].push_back(std::log(std::clamp(errors[i], kLeastError, kMostError)));
  if (logarithms.empty()) return 0;
  double sum = 0;
  for (const auto& [shape, values] : logarithms) sum += statistics::mean(values);
  return std::exp(sum / static_cast<double>(logarithms.size()));
}

std::vector<CandidateScore> score_curve(const ErrorTable& table) {
  std::vector<CandidateScore> curve;
  for (std::size_t k = 0; k < table.candidates.size(); ++k) {
    std::vector<double> errors;
    errors.reserve(table.errors.size());
    for (const std::vector<double>& of_case : table.errors) errors.push_back(of_case[k]);
    CandidateScore one = {.candidate = table.candidates[k], .score = fit_score(table.shapes, errors)};
    one.failures = static_cast<std::size_t>(std::ranges::count_if(errors, &is_infinitely_bad));
    if (!errors.empty()) one.median = statistics::median(errors);
    curve.push_back(one);
  }
  return curve;
}

const CandidateScore& best_of(const std::vector<CandidateScore>& curve) {
  return *std::ranges::min_element(curve, [](const auto& a, const auto& b) { return a.score < b.score; });
}

std::size_t best_for_all(const std::vector<std::vector<CandidateScore>>& curves) {
  std::vector<double> products(curves.at(0).size(), 1.0);
  for (const std::vector<CandidateScore>& curve : curves) {
    for (std::size_t k = 0; k < products.size(); ++k) products[k] *= curve.at(k).score;
  }
  return static_cast<std::size_t>(std::ranges::min_element(products) - products.begin());
}

}  // namespace hullbench::tune
