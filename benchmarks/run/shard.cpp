#include "benchmarks/run/shard.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <optional>
#include <string_view>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/run/runner.hpp"

namespace hullbench::run {
namespace {

constexpr std::size_t kMostShards = 10'000;

std::optional<std::size_t> parse_count(std::string_view text) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// The runs of one case.
struct CaseRuns {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::int64_t work = 0;  ///< points times runs
};

std::vector<CaseRuns> cases_of(const plan::Plan& plan, const std::vector<plan::PlannedRun>& runs) {
  std::vector<CaseRuns> cases;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (i == 0 || runs[i].case_index != runs[i - 1].case_index) cases.push_back({i, i, 0});
    cases.back().end = i + 1;
    cases.back().work += estimated_points(plan.expanded_cases[runs[i].case_index]);
  }
  return cases;
}

/// For each of `cases` the shard, counted from 0, that it belongs to.
std::vector<std::size_t> distribute(const std::vector<CaseRuns>& cases, std::size_t count) {
  std::vector<std::size_t> order(cases.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order,
                           [&](std::size_t a, std::size_t b) { return cases[a].work > cases[b].work; });
  std::vector<std::int64_t> loads(count, 0);
  std::vector<std::size_t> shards(cases.size());
  for (const std::size_t which : order) {
    const auto least = std::ranges::min_element(loads);
    *least += cases[which].work;
    shards[which] = static_cast<std::size_t>(least - loads.begin());
  }
  return shards;
}

}  // namespace

Shard parse_shard(const std::string& text) {
  const std::size_t slash = text.find('/');
  if (slash != std::string::npos) {
    const auto number = parse_count(std::string_view(text).substr(0, slash));
    const auto count = parse_count(std::string_view(text).substr(slash + 1));
    if (number && count && *number >= 1 && *number <= *count && *count <= kMostShards)
      return {*number, *count};
  }
  throw ConfigurationError("'" + text +
                           "' is no shard; give the shard's number and how many there are (at most " +
                           std::to_string(kMostShards) + "), such as --shard 1/3");
}

std::string to_string(const Shard& shard) {
  return std::to_string(shard.number) + "/" + std::to_string(shard.count);
}

std::vector<plan::PlannedRun> runs_of_shard(const plan::Plan& plan, const std::vector<plan::PlannedRun>& runs,
                                            const Shard& shard) {
  const std::vector<CaseRuns> cases = cases_of(plan, runs);
  const std::vector<std::size_t> shards = distribute(cases, shard.count);
  std::vector<plan::PlannedRun> result;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (shards[i] + 1 != shard.number) continue;
    std::copy(runs.begin() + static_cast<std::ptrdiff_t>(cases[i].begin),
              runs.begin() + static_cast<std::ptrdiff_t>(cases[i].end), std::back_inserter(result));
  }
  return result;
}

}  // namespace hullbench::run
