// Man pages and completion of an invented program, and what those of polylidar rest on.
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "packaging/manual/manual.hpp"
#include "tests/complaint.hpp"
#include "tests/program.hpp"
#include "tests/temporary_folder.hpp"

namespace packaging {
namespace {

namespace fs = std::filesystem;
using hullbench::testing::contains;
using hullbench::testing::expect_refusal;
using hullbench::testing::expect_says;
using hullbench::testing::joined;
using hullbench::testing::read_text;
using hullbench::testing::run_program;
using hullbench::testing::succeeded;
using hullbench::testing::TemporaryFolder;
using hullbench::testing::write_text;

using Words = std::vector<std::string>;

class ManualTest : public ::testing::Test {
 protected:
  ManualTest() {
    app_.footer(
        "Knives are sharp, and 'this'\n.5 mm wide~.\nForks\nare not.\nExample: cut bread 'a loaf'\n"
        "Exit codes:\n    0  it is cut\n  130  it is\nEnd.");
    CLI::App* bread = app_.add_subcommand("bread", "Cut bread, never C:\\bread.");
    bread->add_option("FILE", file_, "What to cut")->required();
    bread->add_option("MORE", more_, "What else to cut");
    bread->add_option("-w,--width", width_, "Width in mm")
        ->check(CLI::IsMember({"thin", "thick"}))
        ->capture_default_str();
    bread->add_option("--form", form_, "Its form")
        ->check(CLI::Validator([](const std::string&) { return ""; }, "{round,raw} or art:STYLE"));
    CLI::Option* count = bread->add_option("--count", count_, "How many.")->check(CLI::Range(1U, 8U));
    bread->add_flag("--crust", crust_, "Leave the crust")->excludes(count);
    bread->add_option("--secret", form_, "Nobody's business")->group("");
    bread->add_subcommand("toast", "Toast it");
    app_.add_subcommand("hidden", "Nobody's business")->group("");
  }

  CLI::App app_{"Cuts things.", "cut"};
  std::string file_;
  Words more_;
  std::string width_ = "thin";
  std::string form_;
  unsigned count_ = 0;
  bool crust_ = false;
};

TEST_F(ManualTest, HasAPageForEveryCommandThatIsNotHidden) {
  const auto pages = man_pages(app_, "cut 1.2");
  ASSERT_EQ(pages.size(), 3u);
  for (const std::string name : {"cut.1", "cut-bread.1", "cut-bread-toast.1"}) {
    ASSERT_TRUE(pages.contains(name)) << name;
    EXPECT_FALSE(contains(pages.at(name), "Nobody")) << pages.at(name);
    expect_says(pages.at(name), "\"cut 1.2\"");
  }
  expect_says(pages.at("cut-bread-toast.1"), "cut\\-bread\\-toast \\- Toast it\n");
  expect_says(pages.at("cut-bread-toast.1"), ".SH SEE ALSO\n\\fBcut\\-bread\\fR(1)\n");
}

TEST_F(ManualTest, SaysWhatTheHelpSaysInWords) {
  const std::string page = man_pages(app_, "cut 1.2").at("cut-bread.1");
  expect_says(page,
              ".SH SYNOPSIS\n\\fBcut bread\\fR [\\fIOPTIONS\\fR] \\fIFILE\\fR [\\fIMORE\\fR...] "
              "\\fISUBCOMMAND\\fR\n");
  expect_says(page, ".TP\n\\fIFILE\\fR\nWhat to cut\n.TP\n\\fIMORE\\fR...\nWhat else to cut\n");
  expect_says(page,
              ".TP\n\\fB\\-w\\fR, \\fB\\-\\-width\\fR \\fITEXT\\fR\n"
              "Width in mm. Values: thin, thick. Default: thin.\n");
  expect_says(page, "\nIts form. Values: round, raw or art:STYLE.\n");
  expect_says(page, "\nHow many. Values: 1 to 8.");
  expect_says(page, ".TP\n\\fB\\-\\-crust\\fR\nLeave the crust. Not with \\-\\-count.\n");
  EXPECT_FALSE(contains(page, "REQUIRED")) << page;
}

TEST_F(ManualTest, GivesEachPartOfTheFooterItsSection) {
  const std::string page = man_pages(app_, "cut 1.2").at("cut.1");
  expect_says(page, ".SH NAME\ncut \\- Cuts things\n");
  expect_says(page,
              ".SH EXIT STATUS\n.TP\n\\fB0\\fR\nit is cut\n.TP\n\\fB130\\fR\nit is\n"
              ".SH NOTES\n");
  expect_says(page, "\nForks are not.\n.PP\nEnd.\n.SH EXAMPLES\n");  // lines are filled anew
  EXPECT_FALSE(contains(page, ".nf")) << page;
  expect_says(page, "\\fBcut bread \\(aqa loaf\\(aq\\fR\n");
}

TEST_F(ManualTest, EscapesWhatTroffWouldObey) {
  const auto pages = man_pages(app_, "cut 1.2");
  expect_says(pages.at("cut-bread.1"), "never C:\\ebread\n");
  expect_says(pages.at("cut.1"), ".SH NOTES\nKnives are sharp, and \\(aqthis\\(aq .5 mm wide\\(ti.\n");
  app_.footer(".5 slices");
  expect_says(man_pages(app_, "").at("cut.1"), "\n\\&.5 slices\n");
}

/// What a shell offers for the last of the words.
class CompletionTest : public ManualTest {
 protected:
  /// `words` as bash has them, which takes a word apart at = and :.
  Words in_bash(const Words& words) {
    return completed(
        {"bash", "--norc", "-c",
         R"(source "$0"; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _cut; printf '%s\n' "${COMPREPLY[@]}")"},
        bash_completion(app_, kMore_), words);
  }

  /// The builtins of zsh that work in its editor only are replaced; what is offered is not yet compared with
  /// the word.
  Words in_zsh(const Words& words) {
    return completed({"zsh", "-f", "-c",
                      R"(compset() { :; }; compadd() { shift; print -rl -- "$@"; }; _files() { print files; };
                         words=("$@"); CURRENT=$#; source $0)"},
                     zsh_completion(app_, kMore_), words);
  }

  const MoreWords kMore_ = {{"art:STYLE", {"art:new", "art:nice"}}};

 private:
  Words completed(const Words& command, const std::string& script, const Words& words) {
    const fs::path file = folder_.path() / "script";
    write_text(file, script);
    std::istringstream lines(succeeded(run_program(joined(joined(command, {file}), words))).out);
    Words found;
    for (std::string line; std::getline(lines, line);) {
      if (!line.empty()) found.push_back(line);
    }
    return found;
  }

  TemporaryFolder folder_;
};

TEST_F(CompletionTest, OfBashOffersCommandsOptionsAndTheirWords) {
  EXPECT_EQ(in_bash({"cut", ""}), (Words{"bread", "-h", "--help"}));
  EXPECT_EQ(in_bash({"cut", "bread", ""}),
            (Words{"toast", "-h", "--help", "-w", "--width", "--form", "--count", "--crust"}));
  EXPECT_EQ(in_bash({"cut", "bread", "a", "--c"}), (Words{"--count", "--crust"}));
  EXPECT_EQ(in_bash({"cut", "bread", "-w", "thi"}), (Words{"thin", "thick"}));
  EXPECT_EQ(in_bash({"cut", "bread", "--crust", "--w"}), Words{"--width"}) << "a flag takes no word";
  EXPECT_EQ(in_bash({"cut", "bread", "--count", ""}), Words{}) << "bash then completes names of files";
  EXPECT_EQ(in_bash({"cut", "bread", "toast", "--w"}), Words{});
}

TEST_F(CompletionTest, OfBashKnowsAWordThatBashTakesApart) {
  EXPECT_EQ(in_bash({"cut", "bread", "--width", "=", "thic"}), Words{"thick"});
  EXPECT_EQ(in_bash({"cut", "bread", "--width", "="}), (Words{"thin", "thick"}));
  EXPECT_EQ(in_bash({"cut", "bread", "--form", "r"}), (Words{"round", "raw"}));
  EXPECT_EQ(in_bash({"cut", "bread", "--form", "a"}), (Words{"art:new", "art:nice"}));
  EXPECT_EQ(in_bash({"cut", "bread", "--form", "art", ":", "n"}), (Words{"new", "nice"}));
  EXPECT_EQ(in_bash({"cut", "bread", "--form", "=", "art", ":", "ni"}), Words{"nice"});
  EXPECT_EQ(in_bash({"cut", "bread", "--crust", "="}), Words{}) << "a flag takes no word";
}

TEST_F(CompletionTest, OfZshOffersTheSame) {
  if (const std::string what = hullbench::testing::missing({"zsh"}); !what.empty()) GTEST_SKIP() << what;
  EXPECT_EQ(in_zsh({"cut", ""}), (Words{"bread", "-h", "--help"}));
  EXPECT_EQ(in_zsh({"cut", "bread", "a", "--c"}),
            (Words{"toast", "-h", "--help", "-w", "--width", "--form", "--count", "--crust"}));
  EXPECT_EQ(in_zsh({"cut", "bread", "-w", ""}), (Words{"thin", "thick"}));
  EXPECT_EQ(in_zsh({"cut", "bread", "--width=thic"}), (Words{"thin", "thick"}));
  EXPECT_EQ(in_zsh({"cut", "bread", "--form=art:n"}), (Words{"round", "raw", "art:new", "art:nice"}));
  EXPECT_EQ(in_zsh({"cut", "bread", "--count", ""}), Words{"files"});
  EXPECT_EQ(in_zsh({"cut", "bread", "--crust="}), Words{"files"});
}

TEST_F(CompletionTest, LeavesOutWhatTheProgramDoesNotHave) {
  EXPECT_FALSE(contains(bash_completion(app_), "art:"));
  for (const std::string& script : {bash_completion(app_, kMore_), zsh_completion(app_, kMore_)}) {
    EXPECT_FALSE(contains(script, "hidden")) << script;
    EXPECT_FALSE(contains(script, "secret")) << script;
  }
}

TEST_F(ManualTest, IsWrittenByAnOptionThatNoHelpShows) {
  add_manual(app_, "cut 1.2");
  EXPECT_FALSE(contains(app_.help(), "write-manual"));
  const TemporaryFolder folder;
  const fs::path made = folder.path() / "not" / "yet";
  EXPECT_THROW(app_.parse("--write-manual " + made.string()), CLI::Success);
  EXPECT_EQ(read_text(made / "cut"), bash_completion(app_));
  EXPECT_EQ(read_text(made / "_cut"), zsh_completion(app_));
  EXPECT_EQ(read_text(made / "cut-bread.1"), man_pages(app_, "cut 1.2").at("cut-bread.1"));
}

TEST(PolylidarManualTest, SaysWhyItCannotBeWritten) {
  expect_refusal(run_program({POLYLIDAR, "--write-manual"}), 2, "--write-manual needs the name of a folder");
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "file";
  write_text(file, "");
  expect_refusal(run_program({POLYLIDAR, "--write-manual", file}), 1, file.string() + ": Not a directory");
  fs::create_directories(folder.path() / "taken" / "polylidar.1");
  expect_refusal(run_program({POLYLIDAR, "--write-manual", folder.path() / "taken"}), 1,
                 "taken/polylidar.1: Is a directory");
}

TEST(PolylidarManualTest, SaysWhichNumbersAnOptionTakes) {
  const TemporaryFolder folder;
  succeeded(run_program({POLYLIDAR, "--write-manual", folder.path()}));
  const std::string page = read_text(folder.path() / "polylidar-hull.1");
  expect_says(page, "\nLongest edge of a triangle of the shape; inf: no limit. Values: 0 or more, or inf.");
  expect_says(page, " Values: 0 or more.");
  EXPECT_FALSE(contains(page, "inf or more")) << page;
}

TEST(PolylidarManualTest, CompletesDriversOfGdalWhereThereIsGdal) {
  const auto completion_of = [](const std::string& program) {
    const TemporaryFolder folder;
    succeeded(run_program({program, "--write-manual", folder.path()}));
    return read_text(folder.path() / "polylidar");
  };
  EXPECT_EQ(contains(completion_of(POLYLIDAR), "gdal:GPKG"), HAS_GDAL);
#ifdef POLYLIDAR_WITH_GDAL
  expect_says(completion_of(POLYLIDAR_WITH_GDAL),
              R"("polylidar hull --format") choices="auto geojson wkt wkb svg gdal:GPKG )");
#endif
}

}  // namespace
}  // namespace packaging
