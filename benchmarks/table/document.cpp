#include "benchmarks/table/document.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "benchmarks/base/files.hpp"
#include "benchmarks/record/stored_run.hpp"

namespace hullbench::table {
namespace {

constexpr std::size_t kLineWidth = 118;

std::string replace_all(std::string text, std::string_view from, std::string_view to) {
  for (std::size_t place = text.find(from); place != std::string::npos;
       place = text.find(from, place + to.size())) {
    text.replace(place, from.size(), to);
  }
  return text;
}

/// How a column's cells hold two values, if they do.
struct CellForm {
  std::regex pattern;
  const char* second_header;
};

const std::array<CellForm, 2>& cell_forms() {
  static const std::array<CellForm, 2> forms = {{{std::regex("([0-9.]+) ±([0-9.]+)"), " ±"},
                                                 {std::regex("([0-9.]+) \\(([0-9.]+)\\)"), " in brackets"}}};
  return forms;
}

std::string without_sign(const std::string& cell) {
  const std::string sign = std::string(" ") + kSign;
  return cell.ends_with(sign) ? cell.substr(0, cell.size() - sign.size()) : cell;
}

const CellForm* form_of_column(const std::vector<std::vector<std::string>>& rows, std::size_t column) {
  for (const CellForm& form : cell_forms()) {
    const auto has_form = [&](const auto& row) {
      return std::regex_match(without_sign(row[column]), form.pattern);
    };
    if (std::any_of(rows.begin() + 1, rows.end(), has_form)) return &form;
  }
  return nullptr;
}

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  return '"' + replace_all(text, "\"", "\"\"") + '"';
}

/// The fields of a cell: one, or two when its column has a form.
std::vector<std::string> csv_fields(const std::string& cell, const CellForm* form, bool is_header) {
  if (form == nullptr) return {cell};
  if (is_header) return {cell, cell + form->second_header};
  std::smatch parts;
  if (!std::regex_match(cell, parts, form->pattern)) return {cell, ""};
  return {parts[1], parts[2]};
}

std::string latex_text(std::string_view text) {
  static const std::array<std::pair<const char*, const char*>, 8> symbols = {{{"†", "$\\dagger$"},
                                                                              {"∞", "$\\infty$"},
                                                                              {"±", "$\\pm$"},
                                                                              {"–", "--"},
                                                                              {"≥", "$\\ge$"},
                                                                              {"≤", "$\\le$"},
                                                                              {"√", "$\\surd$"},
                                                                              {"²", "$^2$"}}};
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '\\':
        result += "\\textbackslash{}";
        break;
      case '~':
        result += "\\textasciitilde{}";
        break;
      case '^':
        result += "\\textasciicircum{}";
        break;
      case '<':
        result += "\\textless{}";
        break;
      case '>':
        result += "\\textgreater{}";
        break;
      case '&':
      case '%':
      case '$':
      case '#':
      case '_':
      case '{':
      case '}':
        result += '\\';
        [[fallthrough]];
      default:
        result += c;
    }
  }
  for (const auto& [from, to] : symbols) result = replace_all(result, from, to);
  return result;
}

}  // namespace

void print_markdown(const TextTable& table, std::ostream& out) {
  std::vector<std::vector<std::string>> rows = table.rows();
  for (auto& row : rows) {
    for (std::string& cell : row) cell = replace_all(cell, "|", "\\|");
  }
  const std::size_t columns = rows.front().size();
  std::vector<std::size_t> widths(columns, 3);
  for (const auto& row : rows) {
    for (std::size_t column = 0; column < columns; ++column) {
      widths[column] = std::max(widths[column], display_width(row[column]));
    }
  }
  for (std::size_t row = 0; row < rows.size(); ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      const std::string& cell = rows[row][column];
      const std::string padding(widths[column] - display_width(cell), ' ');
      out << "| " << (table.is_left(column) ? cell + padding : padding + cell) << ' ';
    }
    out << "|\n";
    if (row != 0) continue;
    for (std::size_t column = 0; column < columns; ++column) {
      out << '|' << std::string(widths[column] + 1, '-') << (table.is_left(column) ? '-' : ':');
    }
    out << "|\n";
  }
}

void print_markdown(const Document& document, std::ostream& out) {
  out << "## " << document.title << "\n\n";
  for (const TableSection& section : document.tables) {
    out << "### " << section.caption << "\n\n";
    print_markdown(section.table, out);
    out << '\n';
    for (const std::string& remark : section.remarks) print_item(remark, out);
    if (!section.remarks.empty()) out << '\n';
  }
  if (document.notes.empty() && document.common_notes.empty()) return;
  out << "### Notes\n\n";
  for (const std::string& note : document.notes) print_item(note, out);
  for (const std::string& note : document.common_notes) print_item(note, out);
}

void print_markdown(const std::vector<Document>& documents, std::ostream& out) {
  for (const Document& document : documents) {
    print_markdown(document, out);
    const bool ends_with_notes = !document.notes.empty() || !document.common_notes.empty();
    if (ends_with_notes && &document != &documents.back()) out << '\n';
  }
}

void print_item(std::string_view text, std::ostream& out) {
  std::istringstream words{std::string(text)};
  std::string line = "-";
  for (std::string word; words >> word;) {
    if (display_width(line) + 1 + display_width(word) > kLineWidth) {
      out << line << '\n';
      line = " ";
    }
    line += ' ' + word;
  }
  out << line << '\n';
}

std::string to_csv(const TextTable& table) {
  const auto& rows = table.rows();
  std::string text;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    std::string line;
    for (std::size_t column = 0; column < rows[row].size(); ++column) {
      const std::string cell = without_sign(without_marks(rows[row][column]));
      for (const std::string& field : csv_fields(cell, form_of_column(rows, column), row == 0)) {
        line += csv_field(field) + ',';
      }
    }
    line.back() = '\n';
    text += line;
  }
  return text;
}

std::string to_latex(const TableSection& section) {
  const auto& rows = section.table.rows();
  std::string alignment;
  for (std::size_t column = 0; column < rows.front().size(); ++column) {
    alignment += section.table.is_left(column) ? 'l' : 'r';
  }
  std::string text = "% needs \\usepackage{booktabs}\n\\begin{table}\n  \\centering\n  \\caption{" +
                     latex_text(section.caption) + "}\n  \\label{tab:" + section.id +
                     "}\n  \\begin{tabular}{" + alignment + "}\n    \\toprule\n";
  for (std::size_t row = 0; row < rows.size(); ++row) {
    std::string line;
    for (std::size_t column = 0; column < rows[row].size(); ++column) {
      line += (column == 0 ? "" : " & ") + latex_text(without_marks(rows[row][column]));
    }
    text += "    " + line + " \\\\\n";
    if (row == 0) text += "    \\midrule\n";
  }
  return text + "    \\bottomrule\n  \\end{tabular}\n\\end{table}\n";
}

void write_tables(const std::filesystem::path& folder, const std::vector<Document>& documents) {
  const std::filesystem::path tables = folder / record::kTablesFolder;
  std::error_code error;
  std::filesystem::remove_all(tables, error);
  std::filesystem::create_directory(tables, error);
  if (error) throw std::runtime_error("cannot write " + tables.string() + ": " + error.message());
  std::ostringstream markdown;
  print_markdown(documents, markdown);
  for (const Document& document : documents) {
    for (const TableSection& section : document.tables) {
      write_text_file(tables / (section.id + ".csv"), to_csv(section.table));
      write_text_file(tables / (section.id + ".tex"), to_latex(section));
    }
  }
  write_text_file(folder / record::kTablesFile, markdown.str());
}

}  // namespace hullbench::table
