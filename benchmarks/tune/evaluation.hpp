// Evaluations: one parameter set of one method on one case, scored and not timed. A line each of sweep.jsonl;
// results/sweep.schema.json describes it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "adapters/adapter.hpp"
#include "benchmarks/record/json_lines.hpp"
#include "benchmarks/record/record.hpp"

namespace hullbench::tune {

struct Evaluation {
  std::string id;         ///< see evaluation_identity
  std::string case_name;  ///< "ca/n:2000/holes:1"
  std::string method;
  std::string method_version;
  std::string program;  ///< SHA-256 of this program, or of the method's manifest and files
  std::string dataset;
  std::string dataset_sha256;  ///< of the points
  std::int64_t n = 0;          ///< number of points
  bool holes = false;
  std::uint64_t seed = 0;  ///< of the points
  Parameters parameters;   ///< complete
  record::Status status = record::Status::kOk;
  std::string detail;        ///< why the status is not ok; empty when it is
  std::optional<double> l2;  ///< area of the symmetric difference / ground truth's; none when not ok

  /// l2, or kInfinitelyBad (search.hpp) without one.
  double error() const;
};

/// SHA-256 of the canonical JSON of all that a result depends on: method, version, program, data set, points,
/// holes and parameters.
std::string evaluation_identity(const Evaluation& evaluation);

/// As a line, with `kind` "evaluation". Infinity among the parameters is null.
nlohmann::json evaluation_to_json(const Evaluation& evaluation);
/// Throws nlohmann::json::exception or std::invalid_argument when it is none.
Evaluation evaluation_from_json(const nlohmann::json& source);

/// The evaluations in a folder: those in any of its sweep*.jsonl are known, and new ones are appended to one
/// of them as they happen. For use from several threads.
class EvaluationStore {
 public:
  /// Reads `folder`, which must be there, and opens its `file`. Throws ConfigurationError when another
  /// process writes to the file, std::runtime_error when it cannot be written or a line is no evaluation.
  EvaluationStore(const std::filesystem::path& folder, const std::string& file);
  ~EvaluationStore();
  EvaluationStore(const EvaluationStore&) = delete;
  EvaluationStore& operator=(const EvaluationStore&) = delete;

  /// How many were there when it was opened.
  std::size_t found() const { return found_; }
  /// The one with that identity, if it is known.
  std::optional<Evaluation> find(const std::string& id) const;
  /// All that are known, by id.
  std::vector<Evaluation> all() const;
  /// Appends it; it is in the file when this returns.
  void append(const Evaluation& evaluation);

 private:
  mutable std::mutex mutex_;
  int lock_ = -1;
  std::map<std::string, Evaluation> known_;  ///< by id
  std::size_t found_ = 0;
  std::optional<record::JsonLinesWriter> writer_;
};

}  // namespace hullbench::tune
