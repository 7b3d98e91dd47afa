#include "benchmarks/record/record.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace hullbench::record {
namespace {

using nlohmann::json;

constexpr std::array<std::pair<Status, const char*>, 8> kStatusNames = {
    {{Status::kOk, "ok"},
     {Status::kTimeout, "timeout"},
     {Status::kMemory, "memory"},
     {Status::kCrash, "crash"},
     {Status::kError, "error"},
     {Status::kInvalidOutput, "invalid_output"},
     {Status::kUnsupported, "unsupported"},
     {Status::kNotInstalled, "not_installed"}}};

json parameters_to_json(const std::map<std::string, double>& parameters) {
  json result = json::object();
  for (const auto& [name, value] : parameters) {
    if (std::isnan(value) || value == -std::numeric_limits<double>::infinity()) {
      throw std::invalid_argument("Parameter \"" + name +
                                  "\" is NaN or negative infinity, which no record can hold.");
    }
    result[name] = std::isfinite(value) ? json(value) : json(nullptr);
  }
  return result;
}

std::map<std::string, double> parameters_from_json(const json& parameters) {
  if (!parameters.is_object()) throw std::invalid_argument("\"parameters\" of a record must be an object.");
  std::map<std::string, double> result;
  for (const auto& [name, value] : parameters.items()) {
    result[name] = value.is_null() ? std::numeric_limits<double>::infinity() : value.get<double>();
  }
  return result;
}

/// `value` with every number that is not finite replaced by null, so that a comparison in memory sees what a
/// reader of the file will see.
json without_non_finite(const json& value) {
  if (value.is_number_float() && !std::isfinite(value.get<double>())) return nullptr;
  if (!value.is_structured()) return value;
  json result = value;
  for (json& element : result) element = without_non_finite(element);
  return result;
}

}  // namespace

std::string to_string(Status status) {
  for (const auto& [value, name] : kStatusNames) {
    if (value == status) return name;
  }
  throw std::invalid_argument("A status has a value that is none of the enumerators.");
}

Status status_from_string(const std::string& name) {
  for (const auto& [value, known] : kStatusNames) {
    if (name == known) return value;
  }
  throw std::invalid_argument("Unknown status \"" + name + "\" in a record.");
}

void to_json(json& result, const CanaryTimes& canary) {
  result = {{"memory", canary.memory}, {"compute", canary.compute}};
}

void from_json(const json& source, CanaryTimes& canary) {
  source.at("memory").get_to(canary.memory);
  source.at("compute").get_to(canary.compute);
}

void to_json(json& result, const RunRecord& record) {
  result = json::object();
  result["schema_version"] = kSchemaVersion;
  result["id"] = record.id;
  result["name"] = record.name;
  result["method"] = record.method;
  result["method_version"] = record.method_version;
  result["dataset"] = record.dataset;
  result["dataset_sha256"] = record.dataset_sha256;
  result["n"] = record.n;
  result["holes"] = record.holes;
  result["seed"] = record.seed;
  result["protocol"] = record.protocol;
  result["parameters"] = parameters_to_json(record.parameters);
  result["status"] = to_string(record.status);
  result["detail"] = record.detail;
  result["time_ns"] = record.time_ns;
  result["phases_ns"] = record.phases_ns;
  if (!record.rounds.empty()) result["rounds"] = record.rounds;
  if (!record.passes.empty()) result["passes"] = record.passes;
  if (!record.canary_ns.empty()) result["canary_ns"] = record.canary_ns;
  if (record.cold_time_ns) result["cold_time_ns"] = *record.cold_time_ns;
  result["metrics"] = without_non_finite(record.metrics);
  result["output_sha256"] = record.output_sha256;
  result["machine"] = record.machine;
  result["flags"] = record.flags;
  if (!record.base_shape.empty()) result["base_shape"] = record.base_shape;
  if (!record.levels.empty()) result["levels"] = record.levels;
}

void from_json(const json& source, RunRecord& record) {
  if (const int version = source.at("schema_version").get<int>(); version != kSchemaVersion) {
    throw std::invalid_argument("A record has schema version " + std::to_string(version) +
                                ", this program reads " + std::to_string(kSchemaVersion) + ".");
  }
  source.at("name").get_to(record.name);
  source.at("method").get_to(record.method);
  source.at("method_version").get_to(record.method_version);
  source.at("dataset").get_to(record.dataset);
  source.at("dataset_sha256").get_to(record.dataset_sha256);
  source.at("n").get_to(record.n);
  source.at("holes").get_to(record.holes);
  source.at("seed").get_to(record.seed);
  source.at("protocol").get_to(record.protocol);
  record.parameters = parameters_from_json(source.at("parameters"));
  record.status = status_from_string(source.at("status").get<std::string>());
  source.at("detail").get_to(record.detail);
  source.at("time_ns").get_to(record.time_ns);
  source.at("phases_ns").get_to(record.phases_ns);
  record.rounds = source.value("rounds", std::vector<std::int64_t>());
  record.passes = source.value("passes", std::vector<std::int64_t>());
  record.canary_ns = source.value("canary_ns", std::vector<CanaryTimes>());
  record.cold_time_ns = std::nullopt;
  if (source.contains("cold_time_ns")) record.cold_time_ns = source["cold_time_ns"].get<std::int64_t>();
  record.metrics = source.at("metrics");
  if (!record.metrics.is_object()) throw std::invalid_argument("\"metrics\" of a record must be an object.");
  source.at("output_sha256").get_to(record.output_sha256);
  // Records that are older than these members have none of them.
  record.machine = source.value("machine", std::string());
  record.flags = source.value("flags", std::vector<std::string>());
  record.base_shape = source.value("base_shape", std::string());
  record.levels = source.value("levels", std::map<std::string, double>());
  record.id = source.contains("id") ? source.at("id").get<std::string>() : run_identity(record);
}

std::string run_name(const RunRecord& record) {
  return record.method + "/" + record.dataset + "/n:" + (record.n == 0 ? "all" : std::to_string(record.n)) +
         "/holes:" + (record.holes ? "1" : "0") + "/protocol:" + record.protocol;
}

std::string run_identity(const RunRecord& record) {
  const json identity = {{"method", record.method},
                         {"method_version", record.method_version},
                         {"parameters", parameters_to_json(record.parameters)},
                         {"dataset", record.dataset},
                         {"dataset_sha256", record.dataset_sha256},
                         {"n", record.n},
                         {"holes", record.holes},
                         {"seed", record.seed},
                         {"protocol", record.protocol}};
  return sha256_hex(identity.dump(-1, ' ', false, json::error_handler_t::replace));
}

}  // namespace hullbench::record
