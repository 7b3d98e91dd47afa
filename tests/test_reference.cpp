// The committed reference run: complete, small enough, and with a reason for each large difference from the
// paper.
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "benchmarks/league/league_report.hpp"
#include "benchmarks/record/validate.hpp"
#include "benchmarks/report/documents.hpp"
#include "benchmarks/report/paper_comparison.hpp"
#include "benchmarks/report/readme.hpp"
#include "benchmarks/report/report.hpp"
#include "benchmarks/table/writers.hpp"
#include "tests/program.hpp"
#include "tests/temporary_folder.hpp"

namespace hullbench::testing {
namespace {

const fs::path kReference = fs::path(HULLBENCH_SOURCE_DIRECTORY) / "results" / "reference";

const std::vector<json>& reports() {
  static const std::vector<json> result = report::suite_reports(kReference);
  return result;
}

TEST(Reference, IsAWholeBench) {
  std::map<std::string, std::size_t> runs;
  for (const json& report : reports()) {
    runs[report.at("plan").at("name").get<std::string>()] = report.at("runs").size();
    EXPECT_FALSE(report.at("tool").at("dirty").get<bool>());
  }
  const std::map<std::string, std::size_t> expected = {{"rgbd", 570},     {"states", 900}, {"alphabet", 1014},
                                                       {"random", 41200}, {"steps", 9},    {"zoo", 1846},
                                                       {"real", 806},     {"towns", 910}};
  EXPECT_EQ(runs, expected);
}

TEST(Reference, NoneOfThePapersMethodsFails) {
  const std::set<std::string> papers = {"polylidar",  "polylidar_steps",  "cgal_alpha_shape",
                                        "spatialite", "spatialite_steps", "postgis_legacy",
                                        "postgis",    "postgis_steps"};
  // The zoo is of inputs that broke somebody, and real points have no truth that the paper's rule needs.
  const std::set<std::string> others = {"zoo", "real"};
  std::set<std::string> seen;
  for (const json& report : reports()) {
    if (others.contains(report.at("plan").at("name").get<std::string>())) continue;
    for (const json& row : report.at("runs")) {
      if (!papers.contains(row.at("method").get<std::string>())) continue;
      seen.insert(row.at("method").get<std::string>());
      EXPECT_TRUE(row.at("status") == "ok") << row.at("name");
    }
  }
  EXPECT_EQ(seen, papers);
}

TEST(Reference, EveryMethodWasInstalled) {
  for (const json& report : reports()) {
    for (const json& row : report.at("runs"))
      EXPECT_FALSE(row.at("status") == "not_installed") << row.at("name");
  }
}

// Also those that were thinned; a few rows of each, as they were all thinned in one way.
TEST(Reference, ItsReportsFollowTheSchema) {
  constexpr std::size_t kLookedAt = 40;
  for (const json& whole : reports()) {
    json report = json::object();
    for (const auto& [key, value] : whole.items()) {
      if (key != "runs") report[key] = value;
    }
    json some = json::array();
    const json& runs = whole.at("runs");
    for (std::size_t i = 0; i < runs.size(); i += runs.size() / kLookedAt + 1) some.push_back(runs[i]);
    report["runs"] = some;
    const std::vector<std::string> faults = record::validate_report(report);
    EXPECT_TRUE(faults.empty()) << report.at("plan").at("name") << ": " << faults.front();
  }
}

// After a wanted change of the tables: build/hullbench tables results/reference --write, and make reference's
// last line.
TEST(Reference, ItsTablesAreThoseOfItsRecords) {
  const TemporaryFolder folder;
  table::write_tables(folder.path(), report::make_documents(reports()));
  if (fs::exists(kReference / league::kLeagueFile)) {
    fs::copy(kReference / league::kLeagueFile, folder.path());
    league::write_league_tables(folder.path());
  }
  std::size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder.path())) {
    if (!entry.is_regular_file()) continue;
    const fs::path kept = kReference / fs::relative(entry.path(), folder.path());
    EXPECT_EQ(read_text(entry.path()), read_text(kept)) << kept;
    ++files;
  }
  EXPECT_GT(files, 50U);
}

TEST(Reference, TheLeaguesRowsHaveTablesWithoutTimes) {
  const auto documents = report::make_documents(report::suite_reports(kReference / "league"));
  EXPECT_GT(documents.size(), 3U);
  EXPECT_NE(table::to_json(documents).find("the records were kept without them"), std::string::npos);
}

// As 'hullbench readme results/reference README.md --check' says it, which also writes it anew.
TEST(Reference, IsInTheReadme) {
  const std::string folder = "results/" + fs::read_symlink(kReference).string();
  std::string results = report::readme_results(reports(), folder);
  if (const json league = league::load_league(kReference); !league.is_null())
    results += league::league_results(league, folder);
  const std::string readme = read_text(fs::path(HULLBENCH_SOURCE_DIRECTORY) / "README.md");
  EXPECT_EQ(report::with_results(readme, results), readme);
}

TEST(Reference, StaysBelowNineMebibytes) {
  const fs::path folder = fs::canonical(kReference);
  std::uintmax_t all = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    all += entry.is_regular_file() ? entry.file_size() : 0;
  EXPECT_LT(all, std::uintmax_t{9} << 20);
  for (const char* file : {"report.html.gz", "figures/summary.png", "random/runs.jsonl.xz"})
    EXPECT_GT(fs::file_size(folder / file), 0U) << file;
}

TEST(Reference, EveryTableOfThePaperIsComparedAndEveryLargeDifferenceHasAReason) {
  std::set<std::string> tables;
  for (const json& report : reports()) {
    for (const report::Comparison& comparison : report::compare_with_paper(report)) {
      tables.insert(comparison.where);
      EXPECT_TRUE(!comparison.is_large() || report::reason_of(comparison))
          << comparison.where << " " << comparison.row << " " << comparison.method << " "
          << comparison.quantity << ": " << comparison.ratio();
    }
  }
  EXPECT_EQ(tables, (std::set<std::string>{"Table III", "Table IV", "Table V", "Table VI"}));
}

}  // namespace
}  // namespace hullbench::testing
