#include "benchmarks/report/compare.hpp"

#include <map>
#include <utility>

#include "benchmarks/report/measurements.hpp"
#include "benchmarks/statistics/judge.hpp"
#include "benchmarks/statistics/statistics.hpp"
#include "datasets/datasets.hpp"

namespace hullbench::report {
namespace {

constexpr double kLevel = 1 - statistics::kConfidence;

struct PlannedRecord {
  std::string plan;
  record::RunRecord run;
  bool is_paired = false;
};

std::vector<PlannedRecord> records_of(const std::vector<json>& reports) {
  std::vector<PlannedRecord> result;
  for (const json& report : reports) {
    const std::string plan = report.value("plan", json::object()).value("name", std::string());
    for (const json& line : report.at("runs")) result.push_back({plan, line.get<record::RunRecord>()});
  }
  return result;
}

/// Pairs, by place in `a` and in `b`, what is not paired yet and has the same key.
template <typename Key>
void pair_by(const Key& key, std::vector<PlannedRecord>& a, std::vector<PlannedRecord>& b,
             std::map<std::size_t, std::size_t>& pairs) {
  std::map<std::string, std::vector<std::size_t>> waiting;  // places in b by key, the last one first
  for (std::size_t place = b.size(); place-- > 0;) {
    if (!b[place].is_paired) waiting[key(b[place])].push_back(place);
  }
  for (std::size_t place = 0; place < a.size(); ++place) {
    if (a[place].is_paired) continue;
    const auto found = waiting.find(key(a[place]));
    if (found == waiting.end() || found->second.empty()) continue;
    pairs[place] = found->second.back();
    a[place].is_paired = b[found->second.back()].is_paired = true;
    found->second.pop_back();
  }
}

Change change_of_status(const record::RunRecord& a, const record::RunRecord& b) {
  if (is_measured(a)) return Change::kNowFails;
  return is_measured(b) ? Change::kNowWorks : Change::kFailsInBoth;
}

RunPair make_pair(record::RunRecord a, record::RunRecord b) {
  RunPair pair{std::move(a), std::move(b), std::nullopt, 1, Change::kNotJudged};
  if (is_measured(pair.a) && is_measured(pair.b)) {
    // Kept rows may have no times.
    if (!pair.a.time_ns.empty() && !pair.b.time_ns.empty())
      pair.time = statistics::ratio_of_times(pair.a.time_ns, pair.b.time_ns);
  } else {
    pair.change = change_of_status(pair.a, pair.b);
  }
  return pair;
}

bool can_be_judged(const RunPair& pair) {
  return pair.time && pair.time->interval;
}

/// Calls the differences that remain when the tests of all pairs are looked at together.
void judge(RunsCompared& compared) {
  std::vector<statistics::Evidence> evidence;
  for (const RunPair& pair : compared.pairs) {
    if (can_be_judged(pair)) evidence.push_back({*pair.time->interval, pair.time->p_value});
  }
  const std::vector<statistics::Judgement> judgements = statistics::judge(evidence, 1, kLevel);
  compared.judged = judgements.size();
  auto next = judgements.begin();
  for (RunPair& pair : compared.pairs) {
    if (!can_be_judged(pair)) continue;
    pair.adjusted_p_value = next->p_value;
    pair.change = next->side == statistics::Side::kBelow   ? Change::kFaster
                  : next->side == statistics::Side::kAbove ? Change::kSlower
                                                           : Change::kNotApart;
    ++next;
  }
}

MethodChange method_change(const std::string& method, const std::string& protocol,
                           const std::vector<const RunPair*>& pairs) {
  MethodChange result{method, protocol, 0, std::nullopt, std::nullopt, 0, 0};
  std::map<std::string, std::vector<double>> by_shape;
  std::vector<double> ratios;
  for (const RunPair* pair : pairs) {
    if (pair->change == Change::kFaster) ++result.faster;
    if (pair->change == Change::kSlower) ++result.slower;
    if (!pair->time) continue;
    ratios.push_back(pair->time->ratio);
    by_shape[base_shape(pair->a.dataset)].push_back(pair->time->ratio);
  }
  result.pairs = ratios.size();
  if (ratios.empty()) return result;
  result.ratio = statistics::median(ratios);
  std::vector<std::vector<double>> clusters;
  clusters.reserve(by_shape.size());
  for (auto& [shape, values] : by_shape) clusters.push_back(std::move(values));
  result.interval = statistics::clustered_median_interval(clusters);
  return result;
}

std::vector<MethodChange> method_changes(const std::vector<RunPair>& pairs) {
  std::vector<std::pair<std::string, std::string>> order;
  std::map<std::pair<std::string, std::string>, std::vector<const RunPair*>> groups;
  for (const RunPair& pair : pairs) {
    auto& group = groups[{pair.a.method, pair.a.protocol}];
    if (group.empty()) order.emplace_back(pair.a.method, pair.a.protocol);
    group.push_back(&pair);
  }
  std::vector<MethodChange> result;
  result.reserve(order.size());
  for (const auto& key : order) result.push_back(method_change(key.first, key.second, groups.at(key)));
  return result;
}

std::vector<std::string> names_of_unpaired(const std::vector<PlannedRecord>& records) {
  std::vector<std::string> result;
  for (const PlannedRecord& record : records) {
    if (!record.is_paired) result.push_back(record.run.name);
  }
  return result;
}

}  // namespace

std::string to_string(Change change) {
  switch (change) {
    case Change::kFaster:
      return "faster";
    case Change::kSlower:
      return "slower";
    case Change::kNotApart:
      return "not told apart";
    case Change::kNotJudged:
      return "not judged";
    case Change::kNowFails:
      return "now fails";
    case Change::kNowWorks:
      return "now works";
    case Change::kFailsInBoth:
      return "fails in both";
  }
  return "";
}

RunsCompared compare_runs(const std::vector<json>& a_reports, const std::vector<json>& b_reports) {
  std::vector<PlannedRecord> a = records_of(a_reports);
  std::vector<PlannedRecord> b = records_of(b_reports);
  std::map<std::size_t, std::size_t> places;
  pair_by([](const PlannedRecord& record) { return record.plan + "\n" + record.run.name; }, a, b, places);
  pair_by([](const PlannedRecord& record) { return record.run.name; }, a, b, places);
  RunsCompared compared;
  compared.only_a = names_of_unpaired(a);
  compared.only_b = names_of_unpaired(b);
  for (const auto& [in_a, in_b] : places)
    compared.pairs.push_back(make_pair(std::move(a[in_a].run), std::move(b[in_b].run)));
  judge(compared);
  compared.methods = method_changes(compared.pairs);
  return compared;
}

}  // namespace hullbench::report
