#include "benchmarks/record/record.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "benchmarks/base/files.hpp"

namespace hullbench::record {
namespace {

/// By status.
constexpr std::array kStatusNames = {"ok",    "timeout",        "memory",      "crash",
                                     "error", "invalid_output", "unsupported", "not_installed"};
static_assert(kStatusNames.size() == kAllStatuses.size());

/// Calls `visit(key, member)` for the members that every record has and that are in JSON as they are here.
template <typename Record, typename Visit>
void for_each_required(Record& record, const Visit& visit) {
  visit("name", record.name);
  visit("method", record.method);
  visit("method_version", record.method_version);
  visit("dataset", record.dataset);
  visit("dataset_sha256", record.dataset_sha256);
  visit("n", record.n);
  visit("holes", record.holes);
  visit("seed", record.seed);
  visit("protocol", record.protocol);
  visit("detail", record.detail);
  visit("time_ns", record.time_ns);
  visit("phases_ns", record.phases_ns);
  visit("output_sha256", record.output_sha256);
}

/// The same of those that are left out where they are empty.
template <typename Record, typename Visit>
void for_each_optional(Record& record, const Visit& visit) {
  visit("base_shape", record.base_shape);
  visit("levels", record.levels);
  visit("rounds", record.rounds);
  visit("passes", record.passes);
  visit("canary_ns", record.canary_ns);
  visit("program", record.program);
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

std::string to_string(Status status) {
  return kStatusNames.at(static_cast<std::size_t>(status));
}

Status status_from_string(const std::string& name) {
  for (const Status status : kAllStatuses) {
    if (name == to_string(status)) return status;
  }
  throw std::invalid_argument("Unknown status \"" + name + "\" in a record.");
}

void to_json(json& result, const RunRecord& record) {
  result = {{"schema_version", kSchemaVersion},
            {"id", record.id},
            {"parameters", parameters_to_json(record.parameters)},
            {"status", to_string(record.status)},
            {"metrics", without_non_finite(record.metrics)},
            {"machine", record.machine},
            {"flags", record.flags}};
  for_each_required(record, [&](const char* key, const auto& member) { result[key] = member; });
  for_each_optional(record, [&](const char* key, const auto& member) {
    if (!member.empty()) result[key] = member;
  });
  if (record.cold_time_ns) result["cold_time_ns"] = *record.cold_time_ns;
}

void from_json(const json& source, RunRecord& record) {
  if (const int version = source.at("schema_version").get<int>(); version != kSchemaVersion) {
    throw std::invalid_argument("it has schema version " + std::to_string(version) +
                                ", and this program reads " + std::to_string(kSchemaVersion));
  }
  record = {};
  for_each_required(record, [&](const char* key, auto& member) { source.at(key).get_to(member); });
  record.parameters = parameters_from_json(source.at("parameters"));
  record.status = status_from_string(source.at("status").get<std::string>());
  record.metrics = source.at("metrics");
  if (!record.metrics.is_object()) throw std::invalid_argument("\"metrics\" of a record must be an object.");
  const auto read_if_there = [&](const char* key, auto& member) {
    if (source.contains(key)) source[key].get_to(member);
  };
  for_each_optional(record, read_if_there);
  // Older records have neither.
  read_if_there("machine", record.machine);
  read_if_there("flags", record.flags);
  if (source.contains("cold_time_ns")) record.cold_time_ns = source["cold_time_ns"].get<std::int64_t>();
  record.id = source.contains("id") ? source["id"].get<std::string>() : run_identity(record);
}

bool is_worse_than_convex_hull(const json& metrics) {
  constexpr double kRounding = 1e-9;
  const auto error = metrics.find("l2");
  const auto of_hull = metrics.find("l2_convex_hull");
  if (error == metrics.end() || of_hull == metrics.end() || !error->is_number() || !of_hull->is_number())
    return false;
  return error->get<double>() > of_hull->get<double>() * (1 + kRounding);
}

std::string run_identity(const RunRecord& record) {
  json identity = {{"method", record.method},
                   {"method_version", record.method_version},
                   {"parameters", parameters_to_json(record.parameters)},
                   {"dataset", record.dataset},
                   {"dataset_sha256", record.dataset_sha256},
                   {"n", record.n},
                   {"holes", record.holes},
                   {"seed", record.seed},
                   {"protocol", record.protocol}};
  if (!record.program.empty()) identity["program"] = record.program;
  return sha256_hex(dump_text(identity, -1));
}

}  // namespace hullbench::record
