// Evaluates every method on every case, on all cores: nothing is timed.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "benchmarks/run/progress.hpp"
#include "benchmarks/run/row_store.hpp"
#include "benchmarks/tune/tuning.hpp"
#include "benchmarks/worker/method.hpp"
#include "datasets/datasets.hpp"

namespace hullbench::tune {

/// What is searched of a method whose entry under `auto` has numbers beside the rule.
struct Searched {
  std::string parameter;   ///< that has a rule there
  Parameters others = {};  ///< that have numbers there, but switches
};

struct TunerOptions {
  worker::MethodFinder find_method;
  std::vector<std::string> methods;             ///< to evaluate, by name
  std::map<std::string, std::string> programs;  ///< by method: SHA-256 of what runs it (RunRecord::program)
  int jobs = 1;                                 ///< threads, each with a worker of its own a method; >= 1
  std::int64_t mem_limit_mib = 4096;            ///< address space of a worker
  DataFolders folders = {};
  std::set<std::string> not_searched = {};  ///< methods that keep the parameters that the plans have for them
  std::map<std::string, Searched> searched = {};  ///< by method; of others the axis is the usual one
};

/// The cases of `plans` on either side of the split, each once: a case that several have with the same seed
/// has the entries of all, of two entries for the same method and protocol the first.
std::vector<TuningCase> tuning_cases(const std::vector<plan::Plan>& plans);

/// Chooses every method's one value for many shapes on those training cases whose truth its results can be
/// like: without holes or of one part, if the results are (halving.hpp). Then, per method and test case: that
/// value, the protocols that the plans give the method, `default` where it can do without parameters, and the
/// search over its axis (search.hpp), where holes can be switched off once with and once without them; of one
/// that is not searched only the protocols. What `store` knows by its id is not evaluated again. A failure is
/// an evaluation with its status. A case whose points have no spacing has no sweep of lengths, and one
/// without a ground truth no evaluation. `tuning.interrupted` after Ctrl-C. Throws std::runtime_error when
/// something cannot be written or a data set cannot be read.
Tuning run_tuning(std::vector<TuningCase> cases, const TunerOptions& options, run::RowStore& store,
                  run::Progress& progress);

/// What `progress` needs to know: an element a case and method and round, in the order of the work.
std::vector<run::ProgressRun> tuning_progress(const std::vector<TuningCase>& cases,
                                              const std::vector<std::string>& methods);

}  // namespace hullbench::tune
