// The folder of a run: run.json (what is measured, with what, where), repetitions.jsonl (every timed
// repetition as it happens), runs.jsonl (a line a finished run), and in the end report.json and tables.md. A
// run that was interrupted goes on in its folder.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "benchmarks/record/json_lines.hpp"
#include "benchmarks/record/record.hpp"
#include "benchmarks/run/row_store.hpp"

namespace hullbench::run {

/// One timed repetition: a line of repetitions.jsonl.
struct Repetition {
  std::int64_t time_ns = 0;
  record::PhaseTimes phases_ns;
  std::string output_sha256;
  std::int64_t round = 0;                        ///< as in RunRecord
  std::int64_t pass = 1;                         ///< as in RunRecord
  std::optional<record::CanaryTimes> canary_ns;  ///< of its round; none when there was no canary
  bool remeasured = false;  ///< its round was measured again, and this is of the last time
  bool unsteady = false;    ///< its round's canary was off
};

/// The folder of one run, locked against a second harness for the life of the object: its rows, found by
/// name, and beside them its header and its repetitions.
class RunDirectory : public RowStore {
 public:
  /// `path` must be there; `lock` is its descriptor with the lock, closed with this object. Reads what an
  /// earlier start left, and cuts off torn last lines. Throws std::runtime_error naming the file when one is
  /// damaged otherwise.
  RunDirectory(const fs::path& path, int lock);

  /// run.json of the earlier start; null when there was none.
  const json& header() const { return header_; }
  bool resumed() const { return header_.is_object(); }

  /// Writes run.json, whole or not at all.
  void write_header(const json& header);

  /// The repetitions of a run that are already measured, in order.
  const std::vector<Repetition>& repetitions(const std::string& id) const;
  void append_repetition(const std::string& id, std::size_t index, const Repetition& repetition);

 private:
  void read_repetitions();

  json header_;
  std::map<std::string, std::vector<Repetition>> repetitions_;  ///< by id
  std::optional<record::JsonLinesWriter> repetition_writer_;
};

/// Where a run is to go.
struct RunPlace {
  std::optional<fs::path> out;  ///< the user's choice; none: a folder of its own in `results`/runs
  bool force = false;           ///< never go on with an earlier run
  fs::path results = "results";
};

/// The folder for a run that run.json will describe as `header` (plan, filter, tool, environment, created).
/// An earlier run with the same plan, filter, shard, binary and machine is gone on with: the newest one in
/// `results`/runs if it is not finished (has no report.json), or the one in `out`, finished or not. Throws
/// ConfigurationError when the folder cannot be written, is in use by another harness, or `out` holds
/// something else and `force` is not set; with `force` the files of an earlier run in `out` are removed, and
/// a suite.json, whose runs would be read instead of this one.
std::unique_ptr<RunDirectory> open_run_directory(const json& header, const RunPlace& place);

/// The newest of the folders in `runs` (their names begin with the time) that `is_same`; none when it is
/// finished, which its file `mark` says.
std::optional<fs::path> find_unfinished(const fs::path& runs,
                                        const std::function<bool(const fs::path&)>& is_same,
                                        const char* mark);

/// Removes the temporary files of all runs in `results`/runs, those in suites too, that a harness left which
/// was killed. Those of runs that somebody is at stay.
void remove_stale_scratch(const fs::path& results);

/// Whether `folder` holds a run that `header` describes, and it is finished (has a report.json).
bool is_finished_run(const fs::path& folder, const json& header);

/// The folder `results`/runs/<time>-<machine>-<commit>, made new, with the words of `header` (created, tool,
/// environment). Throws ConfigurationError when it cannot be made.
fs::path make_run_folder(const json& header, const fs::path& results);

/// What must be the same for a run to go on: plan, manifests of its methods, filter, shard, binary and
/// machine of its header, and that it is not merged of others, or merged of the same.
json run_continuity(const json& header);

/// Lets the link `results`/latest point to the run in `run_directory`, a folder in `results`/runs. Throws
/// std::runtime_error when it cannot.
void point_latest_to(const fs::path& run_directory, const fs::path& results);

}  // namespace hullbench::run
