// Records: what a run leaves behind. One JSON line a run in runs.jsonl; report.json is made from them.
// The schemas are results/run.schema.json and results/report.schema.json.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "datasets/sha256.hpp"

namespace hullbench::record {

inline constexpr int kSchemaVersion = 1;

/// How a run ended. The names in JSON are the enumerators without the k, in snake_case.
enum class Status { kOk, kTimeout, kMemory, kCrash, kError, kInvalidOutput, kUnsupported, kNotInstalled };

inline constexpr std::array kAllStatuses = {
    Status::kOk,    Status::kTimeout,       Status::kMemory,      Status::kCrash,
    Status::kError, Status::kInvalidOutput, Status::kUnsupported, Status::kNotInstalled};

/// "ok", "timeout", "memory", "crash", "error", "invalid_output", "unsupported", "not_installed".
std::string to_string(Status status);
/// Throws std::invalid_argument for an unknown name.
Status status_from_string(const std::string& name);

/// Nanoseconds by phase of one repetition: "load", "run", "extract", and the inner steps a method names as
/// "run.triangulation", "extract.polygon" and so on. run + extract is the headline time; run is what the
/// paper timed.
using PhaseTimes = std::map<std::string, std::int64_t>;

/// How long two fixed pieces of work of the harness took after a round, or up to a second before: what they
/// tell is the machine's, not a method's.
struct CanaryTimes {
  std::int64_t memory = 0;   ///< bound by memory
  std::int64_t compute = 0;  ///< bound by arithmetic
  bool operator==(const CanaryTimes&) const = default;
  NLOHMANN_DEFINE_TYPE_INTRUSIVE(CanaryTimes, memory, compute)
};

/// One method with one parameter set on one point set: a line of runs.jsonl.
struct RunRecord {
  std::string id;    ///< SHA-256 of the identity (see run_identity), lower-case hex
  std::string name;  ///< "polylidar/ca/n:64000/holes:1/protocol:paper"
  std::string method;
  std::string method_version;            ///< empty only when not installed
  std::string dataset;                   ///< "ca", "ca~noise:0.5"
  std::string base_shape;                ///< that it is a variant of, as in datasets.hpp; empty: its own
  std::map<std::string, double> levels;  ///< what a curve can be drawn against, as levels_of in datasets.hpp
  std::string dataset_sha256;            ///< of the little-endian float64 bytes of the points
  std::int64_t n = 0;                    ///< number of points
  bool holes = false;                    ///< whether the ground truth has its holes cut out
  std::uint64_t seed = 0;                ///< of the point sample
  std::string protocol;                  ///< "paper", "default", "auto", "tuned", "oracle"
  std::map<std::string, double>
      parameters;  ///< complete: defaults filled in; infinity (no limit) is null in JSON
  Status status = Status::kOk;
  std::string detail;                 ///< why the status is not ok; empty when it is; signal by its name
  std::vector<std::int64_t> time_ns;  ///< run + extract of every repetition, in order
  std::vector<PhaseTimes> phases_ns;  ///< one object a repetition
  /// The round that each repetition was measured in: methods with the same number were measured right after
  /// one another. Counted over all passes; empty in older records, whose repetitions went round by round from
  /// 0.
  std::vector<std::int64_t> rounds;
  std::vector<std::int64_t>
      passes;  ///< the pass of each repetition, from 1; empty in older records: one pass
  std::vector<CanaryTimes> canary_ns;  ///< after each repetition's round; empty in older records
  /// run + extract of the first call in a fresh process; none where the method has no compiler to warm.
  std::optional<std::int64_t> cold_time_ns;
  json metrics = json::object();  ///< see metrics.hpp; null for what is undefined
  std::string output_sha256;      ///< of the WKB of the result; empty when there is none
  std::string machine;            ///< on which the times were taken (machine_id); empty: run.json's machine
  /// SHA-256 of what ran it, a program or a manifest and its files: of rows of a search (sweep.jsonl), where
  /// several programs may have added to one file and nobody is timed. Their protocol is empty, as several may
  /// have chosen the same parameters, and `l2` is their only metric. Empty in rows of a run.
  std::string program;
  std::vector<std::string> flags;  ///< reasons to doubt the row, such as kFasterThanFloor; mostly empty

  bool operator==(const RunRecord&) const = default;
};

/// A row's flag: a round was measured again, as a canary was off the run's median.
inline constexpr const char* kRemeasuredRound = "remeasured_round";
/// A row's flag: a canary was still off after the last try, so the times are of a machine in another state.
inline constexpr const char* kUnsteadyMachine = "unsteady_machine";
/// A row's flag: the result's l2 is above that of the points' convex hull.
inline constexpr const char* kWorseThanConvexHull = "worse_than_convex_hull";
/// Whether the error in a row's metrics is above that of the points' convex hull. The same polygon from
/// another vertex on differs in the last digits of its areas, of which there are 15.
bool is_worse_than_convex_hull(const json& metrics);
/// A row's flag: a repetition took less than kFloorNsPerPoint a point.
inline constexpr const char* kFasterThanFloor = "faster_than_floor";
/// No method can be this fast: in a nanosecond a core reads a point or two from memory, and every method has
/// to look at each point several times. A time below it is of something else than the method's work.
inline constexpr double kFloorNsPerPoint = 1;

/// {name: value}. JSON has no infinity: a parameter that is +infinity ("no limit") is written as null and
/// read back as +infinity. A NaN or -infinity throws std::invalid_argument, because no method takes it.
json parameters_to_json(const std::map<std::string, double>& parameters);
/// Throws json::exception or std::invalid_argument when it is no object of numbers and nulls.
std::map<std::string, double> parameters_from_json(const json& parameters);

/// A number in `metrics` that is not finite becomes null; the parameters are as parameters_to_json writes
/// them.
void to_json(json& result, const RunRecord& record);
/// Throws json::exception or std::invalid_argument when a field is missing or of the wrong type.
void from_json(const json& source, RunRecord& record);

/// The id: SHA-256 of the canonical JSON (keys sorted, no white space, shortest round-trip numbers) of
/// method, method version, parameters, dataset and its hash, n, holes, seed and protocol, and of the program
/// where the record names it.
std::string run_identity(const RunRecord& record);

}  // namespace hullbench::record
