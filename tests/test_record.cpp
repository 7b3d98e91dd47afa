// Records: to JSON and back, what makes a run's identity, and JSON lines files.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "benchmarks/record/json_lines.hpp"
#include "benchmarks/record/record.hpp"
#include "invented_run.hpp"
#include "program.hpp"
#include "temporary_folder.hpp"
#include "tests/complaint.hpp"
#include "tests/infinity.hpp"

namespace hullbench::testing {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(Record, RoundTripThroughTextKeepsEveryField) {
  record::RunRecord record = invented_record();
  record.seed = std::numeric_limits<std::uint64_t>::max();
  record.parameters["third"] = 1.0 / 3.0;
  record.machine = "0123abcd";
  record.flags = {record::kFasterThanFloor};
  record.rounds = {0, 4, 7};
  record.passes = {1, 2, 3};
  record.canary_ns = {{5'000'000, 4'000'000}, {5'100'000, 4'100'000}, {5'200'000, 4'200'000}};
  record.cold_time_ns = 36'000'000;
  record.program = std::string(64, 'a');
  const record::RunRecord back = json::parse(json(record).dump()).get<record::RunRecord>();
  EXPECT_EQ(back, record);
  EXPECT_EQ(json(back), json(record));
}

TEST(Record, WhatAnOlderRecordDoesNotTellIsLeftOut) {
  const record::RunRecord record = invented_record();
  const json written = record;
  record::RunRecord read_over;
  read_over.rounds = read_over.passes = {1};
  read_over.canary_ns = {{1, 2}};
  read_over.cold_time_ns = 3;
  from_json(written, read_over);
  for (const char* key : {"rounds", "passes", "canary_ns", "cold_time_ns"})
    EXPECT_FALSE(written.contains(key)) << key;
  EXPECT_TRUE(read_over.rounds.empty());
  EXPECT_TRUE(read_over.passes.empty());
  EXPECT_TRUE(read_over.canary_ns.empty());
  EXPECT_FALSE(read_over.cold_time_ns);
}

TEST(Record, WhenAndHowARepetitionWasMeasuredIsNoPartOfTheIdentity) {
  record::RunRecord record = invented_record();
  const std::string id = record::run_identity(record);
  record.rounds = record.passes = {1};
  record.canary_ns = {{1, 2}};
  record.cold_time_ns = 3;
  EXPECT_EQ(record::run_identity(record), id);
}

TEST(Record, ACanaryThatTellsOnlyHalfIsRefused) {
  json written = invented_record();
  written["canary_ns"] = json::array({{{"memory", 5}}});
  EXPECT_THROW(written.get<record::RunRecord>(), json::exception);
}

TEST(Record, InfiniteParameterIsNullAndComesBack) {
  record::RunRecord record = invented_record();
  record.parameters = {{"limit", kInfinity}};
  const json written = record;
  EXPECT_TRUE(written["parameters"]["limit"].is_null());
  EXPECT_EQ(written.get<record::RunRecord>().parameters.at("limit"), kInfinity);
}

TEST(Record, ParameterThatNoMethodTakesIsRefused) {
  for (const double value : {kNaN, -kInfinity}) {
    record::RunRecord record = invented_record();
    record.parameters["alpha"] = value;
    EXPECT_THROW(json{record}, std::invalid_argument);
    EXPECT_THROW(record::run_identity(record), std::invalid_argument);
  }
}

TEST(Record, MetricsThatAreNotFiniteBecomeNull) {
  record::RunRecord record = invented_record();
  record.metrics["l2"] = kNaN;
  record.metrics["iou"] = kInfinity;
  const json written = record;
  EXPECT_TRUE(written["metrics"]["l2"].is_null());
  EXPECT_TRUE(written["metrics"]["iou"].is_null());
  EXPECT_EQ(written.dump().find("nan"), std::string::npos);
}

TEST(Record, EveryStatusHasANameOfItsOwn) {
  std::set<std::string> names;
  for (const record::Status status : record::kAllStatuses) {
    names.insert(to_string(status));
    EXPECT_EQ(record::status_from_string(to_string(status)), status);
  }
  const std::set<std::string> expected = {"ok",    "timeout",        "memory",      "crash",
                                          "error", "invalid_output", "unsupported", "not_installed"};
  EXPECT_EQ(names, expected);
  EXPECT_THROW(record::status_from_string("OK"), std::invalid_argument);
}

TEST(Record, EveryFieldIsRequired) {
  const json whole = invented_record();
  for (const auto& [key, value] : whole.items()) {
    json without = whole;
    without.erase(key);
    if (key == "machine" || key == "flags" || key == "id") continue;  // see below
    EXPECT_ANY_THROW(without.get<record::RunRecord>()) << key;
  }
}

TEST(Record, AnIdentityThatIsLeftOutIsWorkedOut) {
  json without = invented_record();
  without.erase("id");
  const auto record = without.get<record::RunRecord>();
  EXPECT_EQ(record.id, record::run_identity(record));
  without["n"] = without["n"].get<std::size_t>() + 1;
  EXPECT_NE(without.get<record::RunRecord>().id, record.id);
}

TEST(Record, OlderOnesHaveNeitherMachineNorFlags) {
  json older = invented_record();
  older.erase("machine");
  older.erase("flags");
  const auto record = older.get<record::RunRecord>();
  EXPECT_EQ(record.machine, "");
  EXPECT_TRUE(record.flags.empty());
}

TEST(Record, OtherSchemaVersionIsRefused) {
  json record = invented_record();
  record["schema_version"] = record::kSchemaVersion + 1;
  EXPECT_THROW(record.get<record::RunRecord>(), std::invalid_argument);
}

TEST(Identity, IsTheHashOfTheCanonicalJson) {
  record::RunRecord record;
  record.method = "m";
  record.method_version = "1";
  record.dataset = "d";
  record.dataset_sha256 = "ab";
  record.n = 3;
  record.holes = true;
  record.seed = 7;
  record.protocol = "auto";
  record.parameters = {{"b", kInfinity}, {"a", 0.5}, {"c", 2}};
  // printf '%s' '{"dataset":"d","dataset_sha256":"ab","holes":true,"method":"m","method_version":"1","n":3,
  // "parameters":{"a":0.5,"b":null,"c":2.0},"protocol":"auto","seed":7}' (without the line break) | sha256sum
  EXPECT_EQ(record::run_identity(record), "e3f1e2393893e26085bee0469c2f128eaa71ae6a660a80886b52112e42ecbde8");
}

TEST(Identity, ChangesWithEveryFieldThatSaysWhatIsRun) {
  const std::vector<std::pair<const char*, std::function<void(record::RunRecord&)>>> changes = {
      {"method", [](record::RunRecord& record) { record.method = "other"; }},
      {"method_version", [](record::RunRecord& record) { record.method_version = "2.0"; }},
      {"dataset", [](record::RunRecord& record) { record.dataset = "hi"; }},
      {"dataset_sha256", [](record::RunRecord& record) { record.dataset_sha256[0] ^= 1; }},
      {"n", [](record::RunRecord& record) { ++record.n; }},
      {"holes", [](record::RunRecord& record) { record.holes = !record.holes; }},
      {"seed", [](record::RunRecord& record) { ++record.seed; }},
      {"protocol", [](record::RunRecord& record) { record.protocol = "auto"; }},
      {"program", [](record::RunRecord& record) { record.program = "ab"; }},
      {"parameter's value",
       [](record::RunRecord& record) {
         record.parameters["alpha"] = std::nextafter(record.parameters["alpha"], kInfinity);
       }},
      {"parameter more", [](record::RunRecord& record) { record.parameters["more"] = 0; }},
      {"parameter less", [](record::RunRecord& record) { record.parameters.erase("alpha"); }}};
  std::set<std::string> ids = {record::run_identity(invented_record())};
  for (const auto& [what, change] : changes) {
    record::RunRecord record = invented_record();
    change(record);
    EXPECT_TRUE(ids.insert(record::run_identity(record)).second) << what;
  }
}

TEST(Identity, DoesNotChangeWithWhatARunLeaves) {
  record::RunRecord record = invented_record();
  const std::string id = record::run_identity(record);
  record.id = "";
  record.name = "";
  record.status = record::Status::kCrash;
  record.detail = "SIGSEGV";
  record.time_ns.clear();
  record.phases_ns.clear();
  record.metrics = json::object();
  record.output_sha256.clear();
  EXPECT_EQ(record::run_identity(record), id);
}

TEST(Identity, SurvivesTheRoundTrip) {
  const record::RunRecord record = invented_record();
  EXPECT_EQ(record::run_identity(json::parse(json(record).dump()).get<record::RunRecord>()), record.id);
}

TEST(JsonLines, AppendedLinesComeBackInOrder) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "lines.jsonl";
  record::JsonLinesWriter(path).append({{"a", 1}});
  record::JsonLinesWriter(path).append({{"b", "ü\n"}});
  const record::JsonLines lines = record::load_json_lines(path);
  EXPECT_EQ(lines.lines, (std::vector<json>{{{"a", 1}}, {{"b", "ü\n"}}}));
  EXPECT_TRUE(lines.torn.empty());
  EXPECT_EQ(lines.complete_bytes, fs::file_size(path));
}

TEST(JsonLines, LineIsOnDiskAsSoonAsItIsAppended) {
  const TemporaryFolder folder;
  record::JsonLinesWriter writer(folder.path() / "lines.jsonl");
  writer.append(1);
  EXPECT_EQ(read_text(folder.path() / "lines.jsonl"), "1\n");
}

TEST(JsonLines, MissingFileAndEmptyFileHaveNoLines) {
  const TemporaryFolder folder;
  EXPECT_TRUE(record::load_json_lines(folder.path() / "none.jsonl").lines.empty());
  write_text(folder.path() / "empty.jsonl", "");
  EXPECT_TRUE(record::load_json_lines(folder.path() / "empty.jsonl").lines.empty());
}

TEST(JsonLines, TornLastLineIsReportedAndCutOffBeforeTheNext) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "lines.jsonl";
  write_text(path, "{\"a\":1}\n{\"b\":");
  const record::JsonLines torn = record::load_json_lines(path);
  EXPECT_EQ(torn.lines.size(), 1U);
  EXPECT_EQ(torn.torn, "{\"b\":");
  record::JsonLinesWriter writer(path);
  writer.append(2);
  EXPECT_EQ(read_text(path), "{\"a\":1}\n2\n");
}

TEST(JsonLines, LastLineWithoutLineFeedIsTornEvenIfItIsJson) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "lines.jsonl";
  write_text(path, "1\n12");  // cut from 123
  EXPECT_EQ(record::load_json_lines(path).lines, std::vector<json>{1});
  EXPECT_EQ(record::load_json_lines(path).torn, "12");
}

TEST(JsonLines, BrokenLineInTheMiddleIsAnErrorThatNamesIt) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "lines.jsonl";
  write_text(path, "1\n{]\n3\n");
  expect_complaint([&] { record::load_json_lines(path); },
                   "line 2 of " + path.string() + " is not JSON; delete the line");
}

TEST(JsonLines, FileThatCannotBeWrittenIsNamed) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "no" / "such" / "folder.jsonl";
  expect_complaint([&] { record::JsonLinesWriter writer(path); }, path.string());
}

TEST(JsonLines, NaNIsNeverWritten) {
  const TemporaryFolder folder;
  record::JsonLinesWriter writer(folder.path() / "lines.jsonl");
  writer.append({kNaN, kInfinity, -kInfinity});
  EXPECT_EQ(read_text(folder.path() / "lines.jsonl"), "[null,null,null]\n");
}

TEST(JsonLines, BytesThatAreNotUtf8DoNotLoseTheLine) {
  const TemporaryFolder folder;
  record::JsonLinesWriter(folder.path() / "lines.jsonl").append({{"detail", "bad \xff byte"}});
  EXPECT_EQ(record::load_json_lines(folder.path() / "lines.jsonl").lines.front()["detail"],
            "bad \xef\xbf\xbd byte");
}

}  // namespace
}  // namespace hullbench::testing
