// Evaluations: records of runs that nobody timed and of which l2 is the only metric. A line each of
// sweep.jsonl; results/sweep.schema.json describes it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "benchmarks/record/json_lines.hpp"
#include "benchmarks/record/record.hpp"

namespace hullbench::tune {

/// A record without times and without a protocol, as several may have chosen its parameters. Its name is that
/// of its case, "ca/n:2000/holes:1", and it says its program.
using Evaluation = record::RunRecord;

/// l2, or kInfinitelyBad (search.hpp) without one.
double error_of(const Evaluation& evaluation);

/// SHA-256 of the canonical JSON of all that a result depends on: method, version, program, data set, points,
/// holes and parameters.
std::string evaluation_identity(const Evaluation& evaluation);

/// As a line, with `kind` "evaluation". Infinity among the parameters is null.
nlohmann::json evaluation_to_json(const Evaluation& evaluation);
/// Throws nlohmann::json::exception or std::invalid_argument when it is none.
Evaluation evaluation_from_json(const nlohmann::json& line);

/// The evaluations in a folder: those in any of its sweep*.jsonl are known, and new ones are appended to one
/// of them as they happen. Unlike a run's folder (run_directory.hpp) it has several writers: threads, and a
/// process for each shard with a file of its own.
class EvaluationStore {
 public:
  /// Reads `folder`, which must be there, and opens its `file`. Throws ConfigurationError when another
  /// process writes to the file or it cannot be written, std::runtime_error when a line is no evaluation.
  EvaluationStore(const std::filesystem::path& folder, const std::string& file);
  ~EvaluationStore();
  EvaluationStore(const EvaluationStore&) = delete;
  EvaluationStore& operator=(const EvaluationStore&) = delete;

  /// How many were there when it was opened.
  std::size_t found() const { return found_; }
  /// The one with that identity; null when it is not known.
  const Evaluation* find(const std::string& id) const;
  /// All that are known, by id. Not while another thread appends.
  const std::map<std::string, Evaluation>& all() const { return known_; }
  /// Appends it; it is in the file when this returns.
  void append(const Evaluation& evaluation);

  /// A folder for files that live no longer than this object.
  const std::filesystem::path& scratch() const { return scratch_; }

 private:
  mutable std::mutex mutex_;
  int lock_;
  std::filesystem::path scratch_;
  std::map<std::string, Evaluation> known_;  ///< by id
  std::size_t found_ = 0;
  std::optional<record::JsonLinesWriter> writer_;
};

}  // namespace hullbench::tune
