#include "benchmarks/run/suite.hpp"

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/base/files.hpp"
#include "benchmarks/record/stored_run.hpp"

namespace hullbench::run {
namespace {

json describe_suite(const std::vector<json>& headers) {
  json suite = {{"schema_version", record::kSchemaVersion},
                {"created", headers.front().at("created")},
                {"plans", json::array()},
                {"continuity", json::array()}};
  for (const json& header : headers) {
    suite["plans"].push_back(header.at("plan").at("name"));
    suite["continuity"].push_back(run_continuity(header));
  }
  return suite;
}

bool holds_suite(const fs::path& folder, const json& suite) {
  const json earlier = record::read_suite(folder);
  return earlier.is_object() && earlier.value("continuity", json()) == suite.at("continuity");
}

fs::path open_chosen(const json& suite, const fs::path& folder, bool force) {
  make_writable_folder(folder);
  if (!force && !fs::is_empty(folder) && !holds_suite(folder, suite)) {
    throw ConfigurationError(
        "the output folder " + folder.string() +
        " holds something else; choose another one with --out, or overwrite it with --force");
  }
  return folder;
}

}  // namespace

fs::path open_suite(const std::vector<json>& headers, const RunPlace& place) {
  const json suite = describe_suite(headers);
  std::optional<fs::path> folder;
  if (place.out) {
    folder = open_chosen(suite, *place.out, place.force);
  } else if (!place.force) {
    const auto is_same = [&](const fs::path& other) { return holds_suite(other, suite); };
    folder = find_unfinished(place.results / "runs", is_same, record::kTablesFile);
  }
  if (!folder) folder = make_run_folder(headers.front(), place.results);
  if (place.force) fs::remove(*folder / record::kTablesFile);
  write_json_file(*folder / record::kSuiteFile, suite);
  return *folder;
}

}  // namespace hullbench::run
