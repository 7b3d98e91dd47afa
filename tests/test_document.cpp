// Documents: the same tables as Markdown, CSV and LaTeX, and the files that hold them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/table/document.hpp"
#include "temporary_folder.hpp"
#include "tests/program.hpp"

namespace hullbench {
namespace {

namespace fs = std::filesystem;
using testing::read_text;

/// A table whose header and rows are these.
table::TextTable table_of(const std::vector<std::vector<std::string>>& rows) {
  table::TextTable table(rows.front());
  for (std::size_t row = 1; row < rows.size(); ++row) table.add_row(rows[row]);
  return table;
}

/// A table of one cell.
table::TableSection section_of(const std::string& id, std::vector<std::string> remarks = {}) {
  return {id, "Caption of " + id, table_of({{"Name", "x"}, {"first", "1"}}), std::move(remarks)};
}

std::string markdown(const std::vector<table::Document>& documents) {
  std::ostringstream out;
  table::print_markdown(documents, out);
  return out.str();
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Csv, QuotesCommasAndQuotes) {
  EXPECT_EQ(table::to_csv(table_of({{"Name", "a, b"}, {"say \"hello\"", "plain"}, {"\"", ","}})),
            "Name,\"a, b\"\n\"say \"\"hello\"\"\",plain\n\"\"\"\",\",\"\n");
}

TEST(Csv, LeavesOtherCharactersAsTheyAre) {
  EXPECT_EQ(table::to_csv(table_of({{"n", "√(A/n) ≥ 1"}, {"a; b", "it's – ±"}})),
            "n,√(A/n) ≥ 1\na; b,it's – ±\n");
}

TEST(Csv, AValueAndItsSpreadAreTwoColumns) {
  EXPECT_EQ(table::to_csv(
                table_of({{"Method", "2000", "4000"}, {"a", "1.36 ±0.01", "2"}, {"b", "13.6 ±0.1", "3"}})),
            "Method,2000,2000 ±,4000\na,1.36,0.01,2\nb,13.6,0.1,3\n");
}

TEST(Csv, TwoValuesAreTwoColumns) {
  EXPECT_EQ(table::to_csv(table_of({{"Method", "L2, %"}, {"a", "3.87 (3.99)"}})),
            "Method,\"L2, %\",\"L2, % in brackets\"\na,3.87,3.99\n");
}

TEST(Csv, WhatHasNotTheColumnsFormStandsInItsFirstField) {
  EXPECT_EQ(table::to_csv(
                table_of({{"Method", "t"}, {"a", "1.36 ±0.01"}, {"b", "timeout"}, {"c", "–"}, {"d", ""}})),
            "Method,t,t ±\na,1.36,0.01\nb,timeout,\nc,–,\nd,,\n");
  EXPECT_EQ(table::to_csv(table_of({{"Shape", "L2"}, {"a", "10.0 (13.6)"}, {"b", "10.0"}, {"c", "invalid"}})),
            "Shape,L2,L2 in brackets\na,10.0,13.6\nb,10.0,\nc,invalid,\n");
}

TEST(Csv, EveryLineHasTheSameNumberOfFields) {
  // The first column too may have a form, and an empty cell.
  EXPECT_EQ(table::to_csv(table_of({{"t", "n"}, {"1.5 ±0.5", "1"}, {"", "2"}})), "t,t ±,n\n1.5,0.5,1\n,,2\n");
}

TEST(Csv, AColumnWithoutAnyFormStaysOne) {
  EXPECT_EQ(table::to_csv(table_of({{"Method", "t"}, {"a", "timeout"}, {"b", "about ±1"}})),
            "Method,t\na,timeout\nb,about ±1\n");
}

TEST(Csv, MarksOfNotesAreDropped) {
  EXPECT_EQ(
      table::to_csv(table_of({{"Method", "n"}, {"SpatiaLite (paper) [1] [13]", "2"}, {"b [sic]", "[1]"}})),
      "Method,n\nSpatiaLite (paper),2\nb [sic],[1]\n");
  // In tables by convexity the method is the second column.
  EXPECT_EQ(table::to_csv(table_of({{"Convexity", "Method"}, {"high", "SpatiaLite (paper) [2]"}})),
            "Convexity,Method\nhigh,SpatiaLite (paper)\n");
}

TEST(Csv, ASignBehindAValueIsDropped) {
  EXPECT_EQ(table::to_csv(
                table_of({{"Method", "L2"}, {"a", "10.0 (13.6) †"}, {"b", "113.7 †"}, {"c", "1.0 (2.0)"}})),
            "Method,L2,L2 in brackets\na,10.0,13.6\nb,113.7,\nc,1.0,2.0\n");
}

TEST(Latex, EscapesEverySpecialCharacter) {
  const std::vector<std::pair<std::string, std::string>> cases = {{"\\", "\\textbackslash{}"},
                                                                  {"~", "\\textasciitilde{}"},
                                                                  {"^", "\\textasciicircum{}"},
                                                                  {"<", "\\textless{}"},
                                                                  {">", "\\textgreater{}"},
                                                                  {"&", "\\&"},
                                                                  {"%", "\\%"},
                                                                  {"$", "\\$"},
                                                                  {"#", "\\#"},
                                                                  {"_", "\\_"},
                                                                  {"{", "\\{"},
                                                                  {"}", "\\}"},
                                                                  {"±", "$\\pm$"},
                                                                  {"–", "--"},
                                                                  {"√", "$\\surd$"},
                                                                  {"≥", "$\\ge$"},
                                                                  {"≤", "$\\le$"},
                                                                  {"²", "$^2$"}};
  for (const auto& [from, to] : cases) {
    const table::TableSection section = {
        "t", "In x" + from + "y", table_of({{"h" + from}, {"1" + from + "2"}}), {}};
    const std::string text = table::to_latex(section);
    EXPECT_TRUE(contains(text, "\\caption{In x" + to + "y}")) << from << ": " << text;
    EXPECT_TRUE(contains(text, "    h" + to + " \\\\\n")) << from << ": " << text;
    EXPECT_TRUE(contains(text, "    1" + to + "2 \\\\\n")) << from << ": " << text;
  }
}

TEST(Latex, IsATableWithRulesOfBooktabs) {
  const table::TableSection section = {
      "states_time",
      "Time",
      table_of({{"Method", "2000", "4000"}, {"a [1] [3]", "1.36 ±0.01", "2"}}),
      {"A remark."}};
  EXPECT_EQ(table::to_latex(section),
            "% needs \\usepackage{booktabs}\n"
            "\\begin{table}\n"
            "  \\centering\n"
            "  \\caption{Time}\n"
            "  \\label{tab:states_time}\n"
            "  \\begin{tabular}{lrr}\n"
            "    \\toprule\n"
            "    Method & 2000 & 4000 \\\\\n"
            "    \\midrule\n"
            "    a & 1.36 $\\pm$0.01 & 2 \\\\\n"
            "    \\bottomrule\n"
            "  \\end{tabular}\n"
            "\\end{table}\n");
}

TEST(Latex, MarksOfNotesAreDroppedInEveryColumn) {
  const std::string text = table::to_latex(
      {"t", "Time", table_of({{"Convexity", "Method"}, {"high", "SpatiaLite (paper) [2]"}}), {}});
  EXPECT_TRUE(contains(text, "high & SpatiaLite (paper) \\\\\n")) << text;
}

TEST(Markdown, IsTitleTablesRemarksAndNotes) {
  const table::Document document = {
      "States", {section_of("a", {"A remark."}), section_of("b")}, {"Own."}, {"Common."}};
  EXPECT_EQ(markdown({document}),
            "## States\n\n"
            "### Caption of a\n\n"
            "| Name  |   x |\n|-------|----:|\n| first |   1 |\n\n"
            "- A remark.\n\n"
            "### Caption of b\n\n"
            "| Name  |   x |\n|-------|----:|\n| first |   1 |\n\n"
            "### Notes\n\n"
            "- Own.\n- Common.\n");
}

// Documents with and without tables, remarks and notes, in every order of two.
TEST(Markdown, SeveralDocumentsAreSetApartByOneBlankLine) {
  const std::array<table::Document, 5> kinds = {{{"One", {section_of("a")}, {}, {}},
                                                 {"Two", {section_of("b", {"Remark."})}, {"Note."}, {}},
                                                 {"Three", {section_of("c")}, {}, {"Common."}},
                                                 {"Four", {}, {"Note."}, {}},
                                                 {"Five", {}, {}, {}}}};
  for (const table::Document& first : kinds) {
    for (const table::Document& second : kinds) {
      const std::string text = markdown({first, second});
      EXPECT_FALSE(contains(text, "\n\n\n")) << text;
      EXPECT_TRUE(contains(text, "\n\n## " + second.title + "\n\n")) << text;
    }
  }
}

TEST(Markdown, TablesHaveABlankLineBeforeAndBehind) {
  const std::string text = markdown({{"One", {section_of("a"), section_of("b", {"Remark."})}, {}, {}},
                                     {"Two", {section_of("c")}, {"Note."}, {}}});
  std::istringstream lines(text);
  bool was_table = false;
  std::string before;
  for (std::string line; std::getline(lines, line); before = line) {
    const bool is_table = line.starts_with("|");
    EXPECT_TRUE(is_table == was_table || (is_table ? before : line).empty()) << text;
    was_table = is_table;
  }
}

class WrittenTables : public ::testing::Test {
 protected:
  fs::path folder() const { return folder_.path(); }

  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder() / "tables"))
      names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
  }

  std::string complaint() const {
    try {
      table::write_tables(folder(), {{"One", {section_of("a")}, {}, {}}});
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "nothing";
  }

 private:
  testing::TemporaryFolder folder_;
};

TEST_F(WrittenTables, AreMarkdownAndTwoFilesATable) {
  const std::vector<table::Document> documents = {{"One", {section_of("a"), section_of("b")}, {"Note."}, {}},
                                                  {"Two", {section_of("c")}, {}, {}}};
  table::write_tables(folder(), documents);
  EXPECT_EQ(files(), (std::vector<std::string>{"a.csv", "a.tex", "b.csv", "b.tex", "c.csv", "c.tex"}));
  EXPECT_EQ(read_text(folder() / "tables.md"), markdown(documents));
  EXPECT_EQ(read_text(folder() / "tables" / "c.csv"), table::to_csv(section_of("c").table));
  EXPECT_EQ(read_text(folder() / "tables" / "c.tex"), table::to_latex(section_of("c")));
}

TEST_F(WrittenTables, OfAnEarlierCallAreGone) {
  table::write_tables(folder(), {{"One", {section_of("a"), section_of("b")}, {}, {}}});
  const std::vector<table::Document> later = {{"Two", {section_of("c")}, {}, {}}};
  table::write_tables(folder(), later);
  EXPECT_EQ(files(), (std::vector<std::string>{"c.csv", "c.tex"}));
  EXPECT_EQ(read_text(folder() / "tables.md"), markdown(later));
}

TEST_F(WrittenTables, ThatCannotBeWrittenAreASentenceWithTheFile) {
  fs::create_directory(folder() / "tables.md");
  EXPECT_EQ(complaint(), "cannot write " + (folder() / "tables.md").string() + "; is the disk full?");
  fs::remove(folder() / "tables.md");
  EXPECT_EQ(complaint(), "nothing");
}

TEST(WrittenTablesElsewhere, AFolderThatIsNotThereIsASentence) {
  try {
    table::write_tables("/proc/hullbench", {{"One", {section_of("a")}, {}, {}}});
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "cannot write /proc/hullbench/tables: No such file or directory");
  }
}

}  // namespace
}  // namespace hullbench
