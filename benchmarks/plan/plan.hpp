// Plans: what a run measures. A plan is a JSON file; benchmarks/plans/ has the ready ones, and their schema
// says what each key means, with examples (plan.schema.json).
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "benchmarks/plan/parameter_rules.hpp"
#include "datasets/datasets.hpp"

namespace hullbench::plan {

/// The most passes that a plan can ask for, as its schema says.
inline constexpr int kMaxPasses = 100;

/// What the curves of a plan's results are drawn against.
struct PlanAxis {
  /// "n": the number of points. "sampling": the stress, with its level, as words and not as a number. Else
  /// one of the names of levels_of (datasets.hpp), which every case must have.
  std::string of;
  std::string title;  ///< as tables and figures print it
  std::string unit;   ///< "h", "%"; empty: a plain number
};

/// One shape at one size.
struct PlanCase {
  std::string dataset;
  bool holes = false;
  std::int64_t n = 0;  ///< number of points; 0: the data set's own

  /// "ca" or "ca/holes": the key of parameters that are given case by case.
  std::string shape() const { return holes ? dataset + "/holes" : dataset; }

  /// "n:2000", or "n:all" for a data set's own points.
  std::string size() const { return n == 0 ? "n:all" : "n:" + std::to_string(n); }

  /// "ca/holes/n:2000", or "floor-1/n:all": the key that is this case's alone.
  std::string key() const { return shape() + "/" + size(); }

  /// "ca/n:2000/holes:1", as the names of runs have it.
  std::string name() const { return dataset + "/" + size() + "/holes:" + (holes ? "1" : "0"); }
};

/// {"rule": NAME}
struct RuleChoice {
  std::string rule;
};
/// {"scaled": FACTOR, "power": POWER}: (FACTOR * mean_spacing) ^ POWER
struct ScaledChoice {
  double factor = 0;
  int power = 1;  ///< 1, or 2 for a parameter that is a squared length
};
/// {"cases": {SHAPE or SHAPE/n:N: VALUE}}
struct CaseChoice {
  std::map<std::string, double> values;
};
using ParameterChoice = std::variant<double, RuleChoice, ScaledChoice, CaseChoice>;

/// One method with one way of choosing its parameters.
struct PlanMethod {
  std::string method;
  std::string protocol;  ///< who chose the parameters: "paper", "default", "auto", "tuned", "oracle"
  std::vector<std::string> datasets;  ///< only these (or these families'); empty: all
  std::map<std::string, ParameterChoice> parameters;
  std::optional<int> repetitions;             ///< its own instead of the plan's, for slow methods
  std::optional<double> timeout_s;            ///< its own instead of the plan's
  std::optional<std::int64_t> mem_limit_mib;  ///< its own instead of the plan's
  bool search = true;                         ///< whether `hullbench tune` searches its parameter
  std::string note;                           ///< for readers of the tables
};

struct Plan {
  std::string name;
  std::string title;
  std::string paper;  ///< which of the paper's figures and tables it stands for
  std::vector<std::string> notes;
  int repetitions = 10;  ///< timed runs a method and case, over all passes
  /// How often the plan is gone through from the first case to the last, so that each method's repetitions
  /// are spread over the whole time.
  int passes = 1;
  /// Untimed runs before them, in each pass; the first one has one at least. With 0, methods that compile
  /// while they run are warmed up once a process instead of for each row. The first run of all is scored, and
  /// every other one must give its result.
  int warmup = 1;
  double timeout_s = 120;             ///< wall-clock seconds for one request to a worker
  std::int64_t mem_limit_mib = 4096;  ///< address space of a worker, in MiB
  std::uint64_t seed = 1;             ///< of point samples and of the order of runs
  std::optional<PlanAxis> axis;       ///< none: the results make no curves
  /// Statuses that are a good answer here as ok is, such as "error" where there is nothing to make a hull of.
  std::vector<std::string> accepted;
  /// How often a method is run on random parts of the points of each case without a ground truth, untimed, to
  /// see whether its result stays; see run/point_parts.hpp.
  int draws = 0;
  std::string filter;  ///< of the runs' names, for who asks for none; empty: all runs
  json cases;          ///< as written, for records
  std::vector<PlanCase> expanded_cases;
  std::vector<PlanMethod> methods;
};

/// One line of runs.jsonl to be.
struct PlannedRun {
  std::size_t case_index = 0;    ///< into Plan::expanded_cases
  std::size_t method_index = 0;  ///< into Plan::methods
  /// "polylidar/ca/n:64000/holes:1/protocol:paper", in Google Benchmark's manner. For people: two runs that
  /// differ in seed or parameters share it.
  std::string name;
};

/// The plan in `text`. `source` is how messages call it. Throws ConfigurationError.
Plan parse_plan(const std::string& text, const std::string& source);

/// The JSON in `text`. Throws ConfigurationError, with the place of the fault, when it is none.
json parse_json(const std::string& text, const std::string& source);

/// The plan that `name_or_path` names: NAME.json in `folder`, or a file (anything with a slash or the ending
/// .json). Throws ConfigurationError.
Plan load_plan(const std::string& name_or_path, const fs::path& folder);

/// Entries for `method` as in a plan's "methods", but without the key "method": `source` and `path` say in
/// messages where they stand. Throws ConfigurationError.
std::vector<PlanMethod> parse_plan_methods(const json& entries, const std::string& method,
                                           const std::string& source, const std::string& path);

/// Adds `methods` to the plan. Throws ConfigurationError when it has one of them with the same protocol.
void add_methods(Plan& plan, const std::vector<PlanMethod>& methods);

/// The plan as JSON, complete: parsing it gives the same plan.
json plan_to_json(const Plan& plan);

/// Whether an entry of `method` is measured on the case: it keeps to no other data sets.
bool applies(const PlanMethod& method, const PlanCase& plan_case);

/// Throws ConfigurationError for a method or data set that is not among the known ones, for a case without a
/// place on the plan's axis, for holes in a data set that has no variant with holes, for a number of points
/// where the data set brings its own or none where it does not, and for a case without a value for a
/// parameter that is given case by case.
void check_plan(const Plan& plan, const std::vector<std::string>& methods,
                const std::vector<DatasetInfo>& datasets);

/// Puts `count` recorded floors ("recorded-1", ...) in the place of the plan's simulated ones, the low ones
/// too; to the cases of a plan of real points it adds the recordings without their truth ("real-recorded-1",
/// ...). Throws ConfigurationError when it has neither.
void use_recordings(Plan& plan, std::size_t count);

/// How often a method is timed on every case, over all passes.
int repetitions_of(const Plan& plan, const PlanMethod& method);

/// How many of `repetitions` fall in `pass` (1 to `passes`): as many in each as go evenly, and one of the
/// rest in each of the first passes. 10 in 3 passes are 4, 3 and 3; 1 is 1, 0 and 0.
int share_of_pass(int repetitions, int passes, int pass);

/// The runs of `plan` whose name has a match of `filter` (an ECMAScript regular expression; empty: all), case
/// by case in the order of the plan. Throws ConfigurationError when `filter` is not a regular expression.
std::vector<PlannedRun> planned_runs(const Plan& plan, const std::string& filter);

/// The parameters that `method` asks for on a case; its plan must have passed check_plan (std::out_of_range
/// else).
std::map<std::string, double> choose_parameters(const PlanMethod& method, const PlanCase& plan_case,
                                                const RuleInput& input);

}  // namespace hullbench::plan
