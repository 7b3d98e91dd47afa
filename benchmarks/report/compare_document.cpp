#include "benchmarks/report/compare_document.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "benchmarks/base/number_format.hpp"
#include "benchmarks/base/words.hpp"
#include "benchmarks/report/labels.hpp"
#include "benchmarks/report/measurements.hpp"
#include "benchmarks/report/table_context.hpp"
#include "benchmarks/statistics/statistics.hpp"

namespace hullbench::report {
namespace {

using nlohmann::ordered_json;
using Words = std::set<std::string>;

/// More names than this are counted, not written out.
constexpr std::size_t kMostNames = 20;

constexpr const char* kWithinRunsOnly =
    "Faster and slower are of these two runs: the intervals and the test know the spread of the repetitions "
    "within them only. What differs from one run to the next of the very same program (the moment, the "
    "memory's layout, neighbours on the machine) is not in them, and can by itself make most pairs differ. "
    "Compare A with a second run of A to see how much it is; to judge a change of the code, measure both in "
    "turns.";

/// A ratio with three digits, but at least two after the point: 1.00 and 0.99 must not look alike.
table::Number ratio_number(double ratio) {
  return {ratio, std::max(2, decimals_of(ratio))};
}

table::Cell ratio_cell(const std::optional<double>& ratio) {
  return ratio ? ratio_number(*ratio) : table::Cell();
}

table::Cell time_cell(const record::RunRecord& run) {
  if (is_measured(run) && run.time_ns.empty()) return {};
  return is_measured(run) ? milliseconds(statistics::median(run.time_ns)) : table::Cell(failure_name(run));
}

table::Cell percent_cell(const std::optional<double>& fraction) {
  return fraction ? table::Number(100 * *fraction, 2) : table::Cell();
}

/// "+0.12": of the errors, in points of a per cent.
table::Cell difference_cell(const std::optional<double>& a, const std::optional<double>& b) {
  if (!a || !b) return {};
  if (*a == *b) return 0;
  const double difference = 100 * (*b - *a);
  return std::abs(difference) < 0.005 ? "<0.01" : table::Cell(table::Number(difference, 2, true));
}

table::Table changes_table(const RunsCompared& compared, const ComparedSide& a) {
  table::Table table{"compare_methods",
                     "Time of equal work by method, B / A",
                     {table::words("Method"), "Pairs", "Median of B / A", "95 %", "B faster", "B slower"}};
  for (const MethodChange& method : compared.methods) {
    table.add_row({method_label(a.reports, method.method, method.protocol), method.pairs,
                   ratio_cell(method.ratio), table::range_cell(method.interval, ratio_number), method.faster,
                   method.slower});
  }
  table.remarks.emplace_back(
      "Below 1, B is faster. The interval is a bootstrap of whole shapes (a data set, with or without "
      "holes); a single shape has none.");
  table.remarks.emplace_back(kWithinRunsOnly);
  return table;
}

bool is_changed(const RunPair& pair) {
  return pair.change != Change::kNotApart && pair.change != Change::kNotJudged &&
         pair.change != Change::kFailsInBoth;
}

std::string pairs_remark(const RunsCompared& compared) {
  const auto not_judged = static_cast<std::size_t>(std::ranges::count_if(
      compared.pairs, [](const RunPair& pair) { return pair.change == Change::kNotJudged; }));
  std::string text =
      "Times are medians in ms. B / A is the median of all ratios of a time of B to one of A (Hodges and "
      "Lehmann 1963), its interval that of Moses (1965). A pair is called faster or slower when the rank "
      "test of Mann and Whitney (1947) says so at 5 % after Holm's correction (1979) over the " +
      std::to_string(compared.judged) +
      " pairs tested: if nothing but the spread of the repetitions lay between the two runs, 1 of 20 such "
      "comparisons would make a wrong call or more. So a pair whose interval leaves out 1 may still be \"not "
      "told apart\".";
  if (not_judged > 0) {
    text += " Not judged, with too few repetitions (four on both sides are enough for a single pair): " +
            std::to_string(not_judged) + ".";
  }
  return text;
}

table::Table pairs_table(const RunsCompared& compared, bool every_pair) {
  table::Table table{"compare_runs",
                     "Run by run: time of equal work, and error L2 in % of the ground truth's area",
                     {table::words("Run"),
                      table::with_unit("A", "ms"),
                      table::with_unit("B", "ms"),
                      "B / A",
                      "95 %",
                      table::words("B is"),
                      table::Column("L2 of A", "%"),
                      table::Column("L2 of B", "%"),
                      {"B - A", "%"}}};
  std::size_t left_out = 0;
  for (const RunPair& pair : compared.pairs) {
    if (!every_pair && compared.pairs.size() > kMostPairsShown && !is_changed(pair)) {
      ++left_out;
      continue;
    }
    const auto error_a = metric(pair.a, "l2");
    const auto error_b = metric(pair.b, "l2");
    table.add_row({pair.a.name, time_cell(pair.a), time_cell(pair.b),
                   pair.time ? ratio_number(pair.time->ratio) : table::Cell(),
                   pair.time ? table::range_cell(pair.time->interval, ratio_number) : table::Cell(),
                   to_string(pair.change), percent_cell(error_a), percent_cell(error_b),
                   difference_cell(error_a, error_b)});
  }
  table.remarks.push_back(pairs_remark(compared));
  if (left_out > 0) {
    table.remarks.push_back("Left out, because nothing was shown to have changed: " +
                            std::to_string(left_out) + " pairs; --format csv has them all.");
  }
  return table;
}

std::string recorded(const Words& words) {
  return words.empty() ? "not recorded" : joined(words, ", ");
}

/// Where the rows of a side were taken, those without times too.
Words machines_of_side(const ComparedSide& side) {
  Words result;
  for (const json& report : side.reports) result.merge(machines_of(report, false));
  return result;
}

/// What the reports of a side hold at `place`, as text.
Words values_at(const ComparedSide& side, const char* place) {
  Words result;
  for (const json& report : side.reports) {
    const json value = report.value(json::json_pointer(place), json());
    if (!value.is_null()) result.insert(value.is_string() ? value.get<std::string>() : value.dump());
  }
  return result;
}

void add_difference(const std::string& what, const Words& a, const Words& b,
                    std::vector<std::string>& notes) {
  if (a != b) notes.push_back(what + ": A " + recorded(a) + "; B " + recorded(b) + ".");
}

void add_machines(const ComparedSide& a, const ComparedSide& b, std::vector<std::string>& notes) {
  const Words of_a = machines_of_side(a);
  const Words of_b = machines_of_side(b);
  if (of_a == of_b && of_a.size() == 1) return;
  notes.push_back(
      (of_a.empty() || of_b.empty() ? "WHERE THE TIMES WERE TAKEN IS NOT KNOWN (A: "
                                    : "THE MACHINES DIFFER (A: ") +
      recorded(of_a) + "; B: " + recorded(of_b) +
      "): a ratio of times across machines compares the machines, not the methods. Errors can be compared.");
}

/// The pairs of which `is_same` is false, as a note.
template <typename IsSame>
void add_pairs_that_differ(const RunsCompared& compared, const std::string& what, const IsSame& is_same,
                           std::vector<std::string>& notes) {
  std::size_t count = 0;
  Words methods;
  for (const RunPair& pair : compared.pairs) {
    if (is_same(pair)) continue;
    ++count;
    methods.insert(pair.a.method);
  }
  if (count > 0) {
    notes.push_back(what + " in " + std::to_string(count) + " of " + std::to_string(compared.pairs.size()) +
                    " pairs (" + recorded(methods) + ").");
  }
}

void add_versions(const RunsCompared& compared, std::vector<std::string>& notes) {
  std::map<std::string, std::pair<Words, Words>> versions;  // of A and B by method, where they differ
  for (const RunPair& pair : compared.pairs) {
    // What is not installed has no version.
    if (pair.same_version() || pair.a.method_version.empty() || pair.b.method_version.empty()) continue;
    versions[pair.a.method].first.insert(pair.a.method_version);
    versions[pair.a.method].second.insert(pair.b.method_version);
  }
  for (const auto& [method, both] : versions)
    add_difference("Other versions of " + method, both.first, both.second, notes);
}

void add_unpaired(const std::string& side, const std::vector<std::string>& names,
                  std::vector<std::string>& notes) {
  if (names.empty()) return;
  std::string text = "Only in " + side + ", " + std::to_string(names.size()) + ": ";
  for (std::size_t place = 0; place < std::min(names.size(), kMostNames); ++place)
    text += (place == 0 ? "" : ", ") + names[place];
  if (names.size() > kMostNames)
    text += " and " + std::to_string(names.size() - kMostNames) + " more (--format json names them all)";
  notes.push_back(text + ".");
}

std::vector<std::string> comparison_notes(const RunsCompared& compared, const ComparedSide& a,
                                          const ComparedSide& b) {
  std::vector<std::string> notes;
  add_machines(a, b, notes);
  notes.push_back("A: " + a.name + ", begun " + recorded(values_at(a, "/created")) + ". B: " + b.name +
                  ", begun " + recorded(values_at(b, "/created")) + ".");
  add_pairs_that_differ(
      compared, "OTHER POINTS", [](const RunPair& pair) { return pair.same_points(); }, notes);
  add_pairs_that_differ(
      compared, "Other parameters", [](const RunPair& pair) { return pair.same_parameters(); }, notes);
  add_versions(compared, notes);
  const std::pair<const char*, const char*> places[] = {{"Other commits", "/tool/commit"},
                                                        {"Other compilers", "/environment/compiler/version"},
                                                        {"Other flags", "/environment/compiler/flags"},
                                                        {"Other kernels", "/environment/kernel"}};
  for (const auto& [what, place] : places)
    add_difference(what, values_at(a, place), values_at(b, place), notes);
  add_unpaired("A", compared.only_a, notes);
  add_unpaired("B", compared.only_b, notes);
  return notes;
}

ordered_json number_or_null(const std::optional<double>& value) {
  return value ? ordered_json(*value) : ordered_json(nullptr);
}

void add_interval(ordered_json& entry, const std::optional<statistics::Interval>& interval) {
  entry["ratio_low"] = interval ? ordered_json(interval->low) : ordered_json(nullptr);
  entry["ratio_high"] = interval ? ordered_json(interval->high) : ordered_json(nullptr);
}

ordered_json method_json(const MethodChange& method) {
  ordered_json entry = {{"method", method.method},
                        {"protocol", method.protocol},
                        {"pairs", method.pairs},
                        {"ratio", number_or_null(method.ratio)}};
  add_interval(entry, method.interval);
  entry["faster"] = method.faster;
  entry["slower"] = method.slower;
  return entry;
}

ordered_json median_or_null(const record::RunRecord& run) {
  return is_measured(run) && !run.time_ns.empty() ? ordered_json(statistics::median(run.time_ns))
                                                  : ordered_json(nullptr);
}

ordered_json pair_json(const RunPair& pair) {
  ordered_json entry = {{"name", pair.a.name},
                        {"status_a", to_string(pair.a.status)},
                        {"status_b", to_string(pair.b.status)},
                        {"median_a_ns", median_or_null(pair.a)},
                        {"median_b_ns", median_or_null(pair.b)},
                        {"ratio", pair.time ? ordered_json(pair.time->ratio) : ordered_json(nullptr)}};
  const bool judged = pair.time && pair.time->interval;
  add_interval(entry, pair.time ? pair.time->interval : std::nullopt);
  entry["p_value"] = judged ? ordered_json(pair.time->p_value) : ordered_json(nullptr);
  entry["adjusted_p_value"] = judged ? ordered_json(pair.adjusted_p_value) : ordered_json(nullptr);
  entry["change"] = to_string(pair.change);
  entry["l2_a"] = number_or_null(metric(pair.a, "l2"));
  entry["l2_b"] = number_or_null(metric(pair.b, "l2"));
  entry["same_points"] = pair.same_points();
  entry["same_parameters"] = pair.same_parameters();
  entry["same_version"] = pair.same_version();
  return entry;
}

}  // namespace

table::Document comparison_document(const RunsCompared& compared, const ComparedSide& a,
                                    const ComparedSide& b, bool every_pair) {
  table::Document document = {
      "A " + a.name + " and B " + b.name, {changes_table(compared, a)}, comparison_notes(compared, a, b)};
  table::Table pairs = pairs_table(compared, every_pair);
  if (pairs.rows.empty()) {
    document.notes.insert(document.notes.end(), pairs.remarks.begin(), pairs.remarks.end());
  } else {
    document.tables.push_back(std::move(pairs));
  }
  return document;
}

ordered_json comparison_json(const RunsCompared& compared, const ComparedSide& a, const ComparedSide& b) {
  ordered_json result = {{"a", a.name},
                         {"b", b.name},
                         {"methods", ordered_json::array()},
                         {"pairs", ordered_json::array()},
                         {"only_a", compared.only_a},
                         {"only_b", compared.only_b},
                         {"notes", comparison_notes(compared, a, b)}};
  result["notes"].push_back(kWithinRunsOnly);
  for (const MethodChange& method : compared.methods) result["methods"].push_back(method_json(method));
  for (const RunPair& pair : compared.pairs) result["pairs"].push_back(pair_json(pair));
  return result;
}

}  // namespace hullbench::report
