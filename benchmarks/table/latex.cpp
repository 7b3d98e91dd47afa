#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "benchmarks/table/writers.hpp"

namespace hullbench::table {
namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 20> kSymbols = {
    {{"\\", "\\textbackslash{}"},
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
     {"†", "$\\dagger$"},
     {"∞", "$\\infty$"},
     {"±", "$\\pm$"},
     {"–", "--"},
     {"≥", "$\\ge$"},
     {"≤", "$\\le$"},
     {"√", "$\\surd$"},
     {"²", "$^2$"}}};

std::string latex_text(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const auto* symbol =
        std::ranges::find_if(kSymbols, [&](const auto& entry) { return text.starts_with(entry.first); });
    const bool known = symbol != kSymbols.end();
    result += known ? symbol->second : text.substr(0, 1);
    text.remove_prefix(known ? symbol->first.size() : 1);
  }
  return result;
}

}  // namespace

std::string to_latex(const Table& table) {
  std::string alignment;
  std::string rows;
  for (const Column& column : table.columns) {
    alignment += column.kind == Kind::kWords ? 'l' : 'r';
    rows += (rows.empty() ? "" : " & ") + latex_text(column.title);
  }
  rows = "    " + rows + " \\\\\n    \\midrule\n";
  for (const auto& row : table.rows) {
    std::string line;
    for (const Cell& cell : row) {
      const std::string text = cell.text();
      line += (&cell == &row.front() ? "" : " & ") + latex_text(text.empty() ? cell.marks() : text);
    }
    rows += "    " + line + " \\\\\n";
  }
  return "% needs \\usepackage{booktabs}\n\\begin{table}\n  \\centering\n  \\caption{" +
         latex_text(table.caption) + "}\n  \\label{tab:" + table.id + "}\n  \\begin{tabular}{" + alignment +
         "}\n    \\toprule\n" + rows + "    \\bottomrule\n  \\end{tabular}\n\\end{table}\n";
}

}  // namespace hullbench::table
