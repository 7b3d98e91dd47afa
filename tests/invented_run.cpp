#include "invented_run.hpp"

#include <cmath>
#include <limits>

#include "benchmarks/base/files.hpp"
#include "benchmarks/record/json_lines.hpp"

namespace hullbench::testing {
namespace {

json dataset(const std::string& name, const std::string& title, double area, const json& holes_area) {
  return {{"name", name},
          {"title", title},
          {"source", "invented"},
          {"licence", "CC0-1.0"},
          {"sha256", sha256_hex(name)},
          {"area", area},
          {"holes_area", holes_area}};
}

json method(const std::string& name, const std::string& title, const std::string& version) {
  const json alpha = {{"name", "alpha"},
                      {"unit", "length"},
                      {"description", "Circumradius."},
                      {"minimum", 0},
                      {"maximum", nullptr}};
  return {{"name", name},
          {"title", title},
          {"version", version},
          {"licence", "MIT"},
          {"citation", "nowhere"},
          {"native_output", "polygons"},
          {"capabilities", {{"holes", true}, {"several_polygons", true}}},
          {"parameters", json::array({alpha})},
          {"installed", true},
          {"detail", ""},
          {"remedy", ""}};
}

json missing_method() {
  json result = method("postgis_legacy", "PostGIS 2.5", "");
  result["installed"] = false;
  result["detail"] = "the server has PostGIS 3.3, which is another method";
  result["remedy"] = "docker-compose up -d postgis25";
  return result;
}

json environment() {
  const json flags = {{"polylidar_core", "-ffp-contract=off"}};
  return {{"machine_id", "0123abcd"},
          {"cpu",
           {{"model", "Invented CPU 3000"},
            {"architecture", "x86_64"},
            {"logical_cores", 2},
            {"allowed_cores", 2},
            {"governors", {"performance"}},
            {"boost", false},
            {"virtualised", true}}},
          {"memory_bytes", 8589934592},
          {"load_average", {0.5, 0.25, 0.125}},
          {"aslr", 2},
          {"huge_pages", {{"kernel", "madvise"}, {"malloc", "glibc.malloc.hugetlb=1"}}},
          {"kernel", "Linux 6.1.0"},
          {"os", "Debian GNU/Linux 12 (bookworm)"},
          {"compiler",
           {{"id", "GNU"},
            {"version", "12.2.0"},
            {"build_type", "Release"},
            {"native", false},
            {"flags", "-O3 -DNDEBUG -std=c++20"},
            {"flags_by_target", flags},
            {"statement", "Everything is built with the same compiler and flags, without exception."}}},
          {"libraries", {{"geos", "3.11.1"}}}};
}

/// What distinguishes the invented methods: times in microseconds per 1000 points, errors relative to
/// Polylidar's.
struct Character {
  const char* method;
  const char* protocol;
  std::int64_t run_time;
  std::int64_t extract_time;
  double error;
};

constexpr Character kPolylidar = {"polylidar", "paper", 250, 10, 1.0};
constexpr Character kCgal = {"cgal_alpha_shape", "paper", 1250, 300, 1.0};
constexpr Character kSpatialite = {"spatialite", "paper", 18000, 500, 0.8};
constexpr Character kLegacy = {"postgis_legacy", "paper", 0, 0, 0};
constexpr Character kPostgis = {"postgis", "auto", 2500, 200, 1.5};

void add_steps(record::PhaseTimes& phases, const std::string& method) {
  if (method == "spatialite" || method == "postgis") return;
  phases["run.triangulation"] = phases["run"] / 2;
  phases["run.shape"] = phases["run"] - phases["run"] / 2;
  phases["extract.polygon"] = phases["extract"];
}

void add_times(record::RunRecord& record, const Character& character) {
  constexpr std::int64_t kMicrosecond = 1000;
  for (const std::int64_t wobble : {0, 2, 1}) {
    record::PhaseTimes phases;
    phases["load"] = 5 * record.n;
    phases["run"] = character.run_time * kMicrosecond * record.n / 1000 * (100 + wobble) / 100;
    phases["extract"] = character.extract_time * kMicrosecond * record.n / 1000;
    add_steps(phases, record.method);
    record.time_ns.push_back(phases["run"] + phases["extract"]);
    record.phases_ns.push_back(phases);
  }
}

void add_metrics(record::RunRecord& record, double relative_error, bool valid) {
  const double l2 = relative_error * 3.5 / std::sqrt(static_cast<double>(record.n));
  record.metrics = {{"valid", valid},
                    {"invalid_reason", valid ? "" : "Self-intersection[1 2]"},
                    {"area", 13900.0},
                    {"ground_truth_area", 14000.0},
                    {"symmetric_difference_area", nullptr},
                    {"l2", nullptr},
                    {"l2_paper", nullptr},
                    {"iou", nullptr},
                    {"polygons", 1},
                    {"holes", record.holes ? 10 : 0},
                    {"vertices", 400}};
  if (!valid) return;
  record.metrics["symmetric_difference_area"] = l2 * 14000.0;
  record.metrics["l2"] = l2;
  record.metrics["l2_paper"] = l2 * 1.02;
  record.metrics["iou"] = 1 - l2;
}

record::RunRecord make_record(const Character& character, const std::string& dataset_name, bool holes,
                              std::int64_t n) {
  record::RunRecord record;
  record.method = character.method;
  record.method_version = "1.0";
  record.dataset = dataset_name;
  record.n = n;
  record.holes = holes;
  record.dataset_sha256 = sha256_hex(dataset_name + std::to_string(n) + (holes ? "h" : ""));
  record.seed = 1;
  record.protocol = character.protocol;
  record.parameters = {{"alpha", 2 * std::sqrt(14000.0 / static_cast<double>(n))},
                       {"max_edge_length", std::numeric_limits<double>::infinity()}};
  record.name = run_name(record);
  return record;
}

record::RunRecord failed(record::RunRecord record, record::Status status, const std::string& detail) {
  record.status = status;
  record.detail = detail;
  if (status == record::Status::kNotInstalled) record.method_version.clear();
  record.id = record::run_identity(record);
  return record;
}

record::RunRecord succeeded(record::RunRecord record, const Character& character) {
  add_times(record, character);
  add_metrics(record, character.error, true);
  record.output_sha256 = sha256_hex(record.name);
  record.id = record::run_identity(record);
  return record;
}

record::RunRecord invalid(record::RunRecord record, const Character& character) {
  add_times(record, character);
  add_metrics(record, character.error, false);
  record.output_sha256 = sha256_hex(record.name);
  return failed(record, record::Status::kInvalidOutput, "the result is not valid: Self-intersection[1 2]");
}

}  // namespace

std::string run_name(const record::RunRecord& record) {
  return record.method + "/" + record.dataset + "/n:" + std::to_string(record.n) +
         "/holes:" + (record.holes ? "1" : "0") + "/protocol:" + record.protocol;
}

json invented_run() {
  return {{"schema_version", record::kSchemaVersion},
          {"created", "2026-01-02T03:04:05Z"},
          {"tool",
           {{"name", "hullbench"},
            {"version", "0.1.0"},
            {"commit", "0123456789abcdef0123456789abcdef01234567"},
            {"dirty", false},
            {"binary_sha256", sha256_hex("binary")}}},
          {"environment", environment()},
          {"plan", {{"name", "invented"}, {"title", "Invented numbers"}, {"notes", {"A note of the plan."}}}},
          {"seed", 1},
          {"filter", ""},
          {"repetitions", 3},
          {"datasets",
           json::array({dataset("ca", "California", 14000, 13200), dataset("hi", "Hawaii", 1800, nullptr)})},
          {"methods", json::array({method("polylidar", "Polylidar", "1.0"),
                                   method("cgal_alpha_shape", "CGAL alpha shape", "1.0"),
                                   method("spatialite", "SpatiaLite", "1.0"),
                                   method("postgis", "PostGIS", "1.0"), missing_method()})}};
}

record::RunRecord invented_record() {
  return succeeded(make_record(kPolylidar, "ca", true, 2000), kPolylidar);
}

std::vector<record::RunRecord> invented_records(const std::vector<std::int64_t>& sizes) {
  std::vector<record::RunRecord> result;
  for (const auto& [name, holes] : {std::pair("ca", false), std::pair("ca", true), std::pair("hi", false)}) {
    const bool is_hawaii = std::string(name) == "hi";
    for (const std::int64_t n : sizes) {
      for (const Character& character : {kPolylidar, kCgal}) {
        result.push_back(succeeded(make_record(character, name, holes, n), character));
      }
      const record::RunRecord spatialite = make_record(kSpatialite, name, holes, n);
      result.push_back(is_hawaii && n == sizes.back()
                           ? failed(spatialite, record::Status::kTimeout, "no answer within 120 s")
                           : succeeded(spatialite, kSpatialite));
      const record::RunRecord postgis = make_record(kPostgis, name, holes, n);
      result.push_back(is_hawaii ? invalid(postgis, kPostgis) : succeeded(postgis, kPostgis));
      if (is_hawaii) continue;
      result.push_back(failed(make_record(kLegacy, name, holes, n), record::Status::kNotInstalled,
                              "the server has PostGIS 3.3, which is another method"));
    }
  }
  return result;
}

void write_invented_run(const fs::path& directory, const std::vector<std::int64_t>& sizes) {
  fs::create_directories(directory);
  write_json_file(directory / "run.json", invented_run());
  fs::remove(directory / "runs.jsonl");
  record::JsonLinesWriter lines(directory / "runs.jsonl");
  for (const record::RunRecord& record : invented_records(sizes)) lines.append(record);
}

}  // namespace hullbench::testing
