// Cells, the same tables as Markdown, CSV, LaTeX and JSON, and the files that hold them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "benchmarks/record/validate.hpp"
#include "benchmarks/table/writers.hpp"
#include "temporary_folder.hpp"
#include "tests/complaint.hpp"
#include "tests/infinity.hpp"
#include "tests/program.hpp"

namespace hullbench::testing {
namespace {

table::Cell with_spread(double value, double spread) {
  table::Cell cell = table::Number(value);
  cell.spread = {spread, 2};
  return cell;
}

table::Cell with_other(double value, double other) {
  table::Cell cell = table::Number(value);
  cell.other = {other, 2};
  return cell;
}

table::Cell with_notes(table::Cell cell, std::vector<std::size_t> notes) {
  cell.notes = std::move(notes);
  return cell;
}

/// A table of these rows, of numbers but for its first column.
table::Table table_of(const std::vector<std::string>& titles, std::vector<std::vector<table::Cell>> rows) {
  table::Table table{"t", "Time", {table::words(titles.front())}};
  table.columns.insert(table.columns.end(), titles.begin() + 1, titles.end());
  for (auto& row : rows) table.add_row(std::move(row));
  return table;
}

/// A table of one row.
table::Table small_table(const std::string& id, std::vector<std::string> remarks = {}) {
  table::Table table = table_of({"Name", "x"}, {{"first", 1}});
  table.id = id;
  table.caption = "Caption of " + id;
  table.remarks = std::move(remarks);
  return table;
}

std::string markdown(const std::vector<table::Document>& documents) {
  std::ostringstream out;
  table::print_markdown(documents, out);
  return out.str();
}

TEST(Cell, ShowsItsValueAndWhatBelongsToIt) {
  EXPECT_EQ(table::Cell().text(), "–");
  EXPECT_EQ(table::Cell("timeout").text(), "timeout");
  EXPECT_EQ(table::Cell(12).text(), "12");
  EXPECT_EQ(table::Cell(table::Number(1.2345)).text(), "1.23");
  EXPECT_EQ(table::Cell(table::Number(kInfinity)).text(), "∞");
  EXPECT_EQ(with_spread(1.2345, 0.01).text(), "1.23 ±0.01");
  EXPECT_EQ(with_other(3.87, 3.99).text(), "3.87 (3.99)");
  table::Cell cell = 5;
  cell.of = {6, 0};
  EXPECT_EQ(cell.text(), "5 of 6");
  cell.sign = table::kSign;
  EXPECT_EQ(cell.text(), "5 of 6 †");
  EXPECT_EQ(with_notes(cell, {2, 13}).text(), "5 of 6 †");
  EXPECT_EQ(with_notes(cell, {2, 13}).marks(), "[2] [13]");
}

TEST(Cell, ShowsAValueBesideWhatIsMissing) {
  table::Cell cell;
  cell.other = {3.99, 2};
  EXPECT_EQ(cell.text(), "– (3.99)");
}

TEST(Cell, ShowsARangeByItsEnds) {
  const auto range = [](double low, double high) {
    return table::Range{table::Number(low), table::Number(high)};
  };
  EXPECT_EQ(table::Cell(range(1.2, 1.312)).text(), "1.20–1.31");
  EXPECT_EQ(table::Cell(range(1.2, kInfinity)).text(), "> 1.20");
  EXPECT_EQ(table::Cell(range(kInfinity, kInfinity)).text(), "∞");
  table::Cell cell = table::Number(1.25);
  cell.range = range(1.2, 1.312);
  EXPECT_EQ(cell.text(), "1.25 (1.20 to 1.31)");
}

TEST(Cell, ShowsASignWhereANumberIsAChange) {
  EXPECT_EQ(table::Number(1.234, 2, true).text(), "+1.23");
  EXPECT_EQ(table::Number(-1.234, 2, true).text(), "-1.23");
  EXPECT_EQ((table::Range{{-1.2, 2, true}, {3.4, 2, true}}.text()), "-1.20 to +3.40");
}

TEST(Notes, TheSameTextHasTheSameNumber) {
  table::Notes notes;
  EXPECT_EQ(notes.number("first"), 1U);
  EXPECT_EQ(notes.number("second"), 2U);
  EXPECT_EQ(notes.number("first"), 1U);
  EXPECT_EQ(notes.marked(), (std::vector<std::string>{"[1] first", "[2] second"}));
}

TEST(Table, ARowHasACellAColumn) {
  table::Table table = small_table("a");
  EXPECT_THROW(table.add_row({"too few"}), std::invalid_argument);
  EXPECT_EQ(table.rows.size(), 1U);
}

TEST(Csv, QuotesCommasQuotesAndLineBreaks) {
  EXPECT_EQ(
      table::to_csv(table_of({"Name", "a, b"}, {{"say \"hello\"", "plain"}, {"\"", ","}, {"x\ny", ""}})),
      "Name,\"a, b\"\n\"say \"\"hello\"\"\",plain\n\"\"\"\",\",\"\n\"x\ny\",\n");
}

TEST(Csv, LeavesOtherCharactersAsTheyAre) {
  EXPECT_EQ(table::to_csv(table_of({"n", "√(A/n) ≥ 1"}, {{"a; b", "it's – ±"}})),
            "n,√(A/n) ≥ 1\na; b,it's – ±\n");
}

TEST(Csv, AValueAndItsSpreadAreTwoColumns) {
  EXPECT_EQ(table::to_csv(table_of({"Method", "2000", "4000"},
                                   {{"a", with_spread(1.36, 0.01), 2}, {"b", with_spread(13.6, 0.1), 3}})),
            "Method,2000,2000 ±,4000\na,1.36,0.01,2\nb,13.6,0.10,3\n");
}

TEST(Csv, TwoValuesAreTwoColumns) {
  EXPECT_EQ(table::to_csv(table_of({"Method", "L2, %"}, {{"a", with_other(3.87, 3.99)}})),
            "Method,\"L2, %\",\"L2, % in brackets\"\na,3.87,3.99\n");
}

TEST(Csv, ARangeThatAValueLiesInIsTwoColumnsMore) {
  const table::Range range = {table::Number(3.1), table::Number(4.4)};
  table::Cell cell = table::Number(3.87);
  cell.range = range;
  EXPECT_EQ(table::to_csv(table_of({"Method", "L2", "95 %"}, {{"a", cell, range}})),
            "Method,L2,L2 from,L2 to,95 %\na,3.87,3.10,4.40,3.10–4.40\n");
}

TEST(Csv, WordsStandInTheFirstOfSuchColumns) {
  EXPECT_EQ(table::to_csv(table_of({"Method", "t"},
                                   {{"a", with_spread(1.36, 0.01)}, {"b", "timeout"}, {"c", {}}, {"d", ""}})),
            "Method,t,t ±\na,1.36,0.01\nb,timeout,\nc,–,\nd,,\n");
}

TEST(Csv, AColumnOfWordsStaysOne) {
  EXPECT_EQ(table::to_csv(table_of({"Method", "t"}, {{"a", "1.36 ±0.01"}, {"b", "3.87 (3.99)"}})),
            "Method,t\na,1.36 ±0.01\nb,3.87 (3.99)\n");
}

TEST(Csv, NotesAreLeftOutUnlessTheyStandAlone) {
  EXPECT_EQ(table::to_csv(table_of({"Method", "n", "why"}, {{with_notes("b [sic]", {1, 13}),
                                                             with_notes(2, {1}), with_notes("", {3})}})),
            "Method,n,why\nb [sic],2,[3]\n");
}

TEST(Csv, ASignBehindAValueIsLeftOut) {
  table::Cell cell = with_other(10, 13.6);
  cell.sign = table::kSign;
  EXPECT_EQ(table::to_csv(table_of({"Method", "L2"}, {{"a", cell}})),
            "Method,L2,L2 in brackets\na,10.0,13.60\n");
}

TEST(Latex, EscapesEverySpecialCharacter) {
  std::vector<std::pair<std::string, std::string>> cases = {{"\\", "\\textbackslash{}"},
                                                            {"~", "\\textasciitilde{}"},
                                                            {"^", "\\textasciicircum{}"},
                                                            {"<", "\\textless{}"},
                                                            {">", "\\textgreater{}"},
                                                            {"±", "$\\pm$"},
                                                            {"–", "--"},
                                                            {"√", "$\\surd$"},
                                                            {"≥", "$\\ge$"},
                                                            {"≤", "$\\le$"},
                                                            {"²", "$^2$"}};
  for (const char c : std::string("&%$#_{}")) cases.emplace_back(std::string(1, c), std::string("\\") + c);
  for (const auto& [from, to] : cases) {
    table::Table table = table_of({"h" + from}, {{"1" + from + "2"}});
    table.caption = "In x" + from + "y";
    const std::string text = table::to_latex(table);
    EXPECT_TRUE(contains(text, "\\caption{In x" + to + "y}")) << from << ": " << text;
    EXPECT_TRUE(contains(text, "    h" + to + " \\\\\n")) << from << ": " << text;
    EXPECT_TRUE(contains(text, "    1" + to + "2 \\\\\n")) << from << ": " << text;
  }
}

TEST(Latex, IsATableWithRulesOfBooktabsWithoutNotes) {
  EXPECT_EQ(
      table::to_latex(table_of({"Method", "2000", "4000"},
                               {{with_notes("a", {1, 3}), with_spread(1.36, 0.01), with_notes(2, {4})}})),
      "% needs \\usepackage{booktabs}\n"
      "\\begin{table}\n"
      "  \\centering\n"
      "  \\caption{Time}\n"
      "  \\label{tab:t}\n"
      "  \\begin{tabular}{lrr}\n"
      "    \\toprule\n"
      "    Method & 2000 & 4000 \\\\\n"
      "    \\midrule\n"
      "    a & 1.36 $\\pm$0.01 & 2 \\\\\n"
      "    \\bottomrule\n"
      "  \\end{tabular}\n"
      "\\end{table}\n");
}

TEST(Json, HasEveryValueWithTheDigitsThatAreShown) {
  table::Cell share = 5;
  share.of = {6, 0};
  table::Cell infinite = table::Number(kInfinity);
  infinite.range = {table::Number(2), table::Number(kInfinity)};
  table::Table table =
      table_of({"Method", "t", "L2", "Solved", "Ratio"},
               {{with_notes("\"a\"", {2}), with_spread(1.2345, 0.1), with_other(3, 4), share, infinite}});
  table.columns[1].unit = "ms";
  table.remarks = {"A remark."};
  const std::string text = table::to_json({{"One", {table}, {"[1] Own."}, {"Common."}}, {"Two"}});
  EXPECT_TRUE(contains(text, "\"value\":1.23,\"spread\":0.10}")) << text;
  const json parsed = json::parse(text);
  EXPECT_EQ(record::validate_by_kind(parsed), std::vector<std::string>());
  const json& first = parsed.at("documents").at(0);
  EXPECT_EQ(first.at("notes"), json::array({"[1] Own.", "Common."}));
  const json& made = first.at("tables").at(0);
  EXPECT_EQ(made.at("remarks"), json::array({"A remark."}));
  EXPECT_EQ(made.at("columns").at(0), json({{"title", "Method"}, {"kind", "words"}}));
  EXPECT_EQ(made.at("columns").at(1), json({{"title", "t"}, {"kind", "number"}, {"unit", "ms"}}));
  const json expected = {{{"text", "\"a\""}, {"notes", {2}}},
                         {{"text", "1.23 ±0.10"}, {"value", 1.23}, {"spread", 0.1}},
                         {{"text", "3.00 (4.00)"}, {"value", 3}, {"other", 4}},
                         {{"text", "5 of 6"}, {"value", 5}, {"of", 6}},
                         {{"text", "∞ (2.00 to ∞)"}, {"value", nullptr}, {"low", 2}, {"high", nullptr}}};
  EXPECT_EQ(made.at("rows").at(0), expected);
  EXPECT_EQ(parsed.at("documents").at(1),
            json({{"title", "Two"}, {"tables", json::array()}, {"notes", json::array()}}));
}

TEST(Json, OfAnotherFormIsNotWhatTheSchemaSays) {
  const json good = json::parse(table::to_json({{"One", {small_table("a")}}}));
  for (const char* place : {"/documents/0/title", "/documents/0/tables/0/columns/0/kind",
                            "/documents/0/tables/0/rows/0/0/text", "/documents/0/tables/0/rows/0/1/value"}) {
    json wrong = good;
    wrong.at(json::json_pointer(place)) = json::array();
    EXPECT_NE(record::validate_by_kind(wrong), std::vector<std::string>()) << place;
  }
}

TEST(Markdown, ColumnsLineUpAndBarsAreEscaped) {
  std::ostringstream out;
  table::print_markdown(
      table_of({"name", "a|b"}, {{"±é", 1}, {"x\ny", with_notes("12345", {2})}, {"z", with_notes("", {3})}}),
      out);
  EXPECT_EQ(out.str(),
            "| name |      a\\|b |\n"
            "|------|----------:|\n"
            "| ±é   |         1 |\n"
            "| x y  | 12345 [2] |\n"
            "| z    |       [3] |\n");
}

TEST(Markdown, LongItemsAreBrokenBetweenWords) {
  std::ostringstream out;
  table::print_item(std::string(115, 'a') + " bb " + std::string(130, 'c') + " d", out);
  EXPECT_EQ(out.str(), "- " + std::string(115, 'a') + "\n  bb\n  " + std::string(130, 'c') + "\n  d\n");
}

TEST(Markdown, IsTitleTablesRemarksAndNotes) {
  const table::Document document = {
      "States", {small_table("a", {"A remark."}), small_table("b")}, {"Own."}, {"Common."}};
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
  const std::array<table::Document, 5> kinds = {{{"One", {small_table("a")}, {}, {}},
                                                 {"Two", {small_table("b", {"Remark."})}, {"Note."}, {}},
                                                 {"Three", {small_table("c")}, {}, {"Common."}},
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

class WrittenTables : public ::testing::Test {
 protected:
  fs::path folder() const { return folder_.path(); }

  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder() / "tables"))
      names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    return names;
  }

  std::string complaint() const {
    return complaint_of([&] { table::write_tables(folder(), {{"One", {small_table("a")}, {}, {}}}); });
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(WrittenTables, AreMarkdownAndJsonAndTwoFilesATable) {
  const std::vector<table::Document> documents = {
      {"One", {small_table("a"), small_table("b")}, {"Note."}, {}}, {"Two", {small_table("c")}, {}, {}}};
  table::write_tables(folder(), documents);
  EXPECT_EQ(files(),
            (std::vector<std::string>{"a.csv", "a.tex", "b.csv", "b.tex", "c.csv", "c.tex", "tables.json"}));
  EXPECT_EQ(read_text(folder() / "tables.md"), markdown(documents));
  EXPECT_EQ(read_text(folder() / "tables" / "c.csv"), table::to_csv(small_table("c")));
  EXPECT_EQ(read_text(folder() / "tables" / "c.tex"), table::to_latex(small_table("c")));
  EXPECT_EQ(read_text(folder() / "tables" / "tables.json"), table::to_json(documents));
}

TEST_F(WrittenTables, OfAnEarlierCallAreGone) {
  table::write_tables(folder(), {{"One", {small_table("a"), small_table("b")}, {}, {}}});
  const std::vector<table::Document> later = {{"Two", {small_table("c")}, {}, {}}};
  table::write_tables(folder(), later);
  EXPECT_EQ(files(), (std::vector<std::string>{"c.csv", "c.tex", "tables.json"}));
  EXPECT_EQ(read_text(folder() / "tables.md"), markdown(later));
}

TEST_F(WrittenTables, ThatCannotBeWrittenAreASentenceWithTheFile) {
  fs::create_directory(folder() / "tables.md");
  EXPECT_EQ(complaint(), "cannot write " + (folder() / "tables.md").string() + ": Is a directory");
  fs::remove(folder() / "tables.md");
  EXPECT_EQ(complaint(), kNoComplaint);
}

TEST(WrittenTablesElsewhere, AFolderThatIsNotThereIsASentence) {
  EXPECT_EQ(complaint_of([&] {
              table::write_tables("/proc/hullbench", {{"One", {small_table("a")}, {}, {}}});
            }),
            "cannot write /proc/hullbench/tables: No such file or directory");
}

}  // namespace
}  // namespace hullbench::testing
