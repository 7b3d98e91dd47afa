// Man pages and completion of an invented program.
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <string>

#include "packaging/manual/manual.hpp"
#include "tests/program.hpp"
#include "tests/temporary_folder.hpp"

namespace packaging {
namespace {

class ManualTest : public ::testing::Test {
 protected:
  ManualTest() {
    app_.footer("Example: cut bread\n.5 slices\n'tis all");
    CLI::App* bread = app_.add_subcommand("bread", "Cut bread, never C:\\bread");
    bread->add_option("FILE", file_, "What to cut")->required();
    bread->add_option("-w,--width", width_, "Width in mm")->check(CLI::IsMember({"thin", "thick"}));
    bread->add_flag("--crust", crust_, "Leave the crust");
    bread->add_option("--secret", width_, "Nobody's business")->group("");
    bread->add_subcommand("toast", "Toast it");
    app_.add_subcommand("hidden", "Nobody's business")->group("");
  }

  CLI::App app_{"Cuts things.", "cut"};
  std::string file_;
  std::string width_;
  bool crust_ = false;
};

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_F(ManualTest, HasAPageForEveryCommandThatIsNotHidden) {
  const auto pages = man_pages(app_, "cut 1.2");
  ASSERT_EQ(pages.size(), 3u);
  for (const std::string name : {"cut.1", "cut-bread.1", "cut-bread-toast.1"}) {
    ASSERT_TRUE(pages.contains(name)) << name;
    EXPECT_FALSE(has(pages.at(name), "Nobody")) << pages.at(name);
    EXPECT_TRUE(has(pages.at(name), "\"cut 1.2\"")) << pages.at(name);
  }
  EXPECT_TRUE(has(pages.at("cut-bread-toast.1"), "cut\\-bread\\-toast \\- Toast it\n"));
  EXPECT_TRUE(has(pages.at("cut-bread-toast.1"), ".SH SEE ALSO\n\\fBcut\\-bread\\fR(1)\n"));
}

TEST_F(ManualTest, SaysWhatTheHelpSays) {
  const std::string page = man_pages(app_, "cut 1.2").at("cut-bread.1");
  EXPECT_TRUE(
      has(page, ".SH SYNOPSIS\n\\fBcut bread\\fR [\\fIOPTIONS\\fR] \\fIFILE\\fR \\fISUBCOMMAND\\fR\n"))
      << page;
  EXPECT_TRUE(has(page, ".TP\n\\fBFILE\\fR TEXT REQUIRED\nWhat to cut\n")) << page;
  EXPECT_TRUE(has(page, ".TP\n\\fB\\-w,\\-\\-width\\fR TEXT:{thin,thick}\nWidth in mm\n")) << page;
  EXPECT_TRUE(has(page, ".TP\n\\fB\\-\\-crust\\fR\nLeave the crust\n")) << page;
}

TEST_F(ManualTest, EscapesWhatTroffWouldObey) {
  const auto pages = man_pages(app_, "cut 1.2");
  EXPECT_TRUE(has(pages.at("cut-bread.1"), "never C:\\ebread\n"));
  EXPECT_TRUE(has(pages.at("cut.1"), "\n\\&.5 slices\n\\&'tis all\n"));
}

TEST_F(ManualTest, CompletesWordsOfOptionsAndNothingHidden) {
  const std::string script = bash_completion(app_);
  EXPECT_TRUE(has(script, "\"cut bread\") words=\"toast -h --help -w --width --crust\"")) << script;
  EXPECT_TRUE(has(script, "\"cut bread -w\") words=\"thin thick\"")) << script;
  EXPECT_FALSE(has(script, "\"cut bread --crust\")")) << "a flag takes no word";
  EXPECT_FALSE(has(script, "hidden")) << script;
  EXPECT_FALSE(has(script, "secret")) << script;
}

TEST_F(ManualTest, IsWrittenByAnOptionThatNoHelpShows) {
  add_manual(app_, "cut 1.2");
  EXPECT_FALSE(has(app_.help(), "write-manual"));
  const hullbench::testing::TemporaryFolder folder;
  EXPECT_THROW(app_.parse("--write-manual " + folder.path().string()), CLI::Success);
  EXPECT_EQ(hullbench::testing::read_text(folder.path() / "cut"), bash_completion(app_));
  EXPECT_EQ(hullbench::testing::read_text(folder.path() / "cut-bread.1"),
            man_pages(app_, "cut 1.2").at("cut-bread.1"));
  EXPECT_THROW(app_.parse("--write-manual " + (folder.path() / "none").string()), std::runtime_error);
}

}  // namespace
}  // namespace packaging
