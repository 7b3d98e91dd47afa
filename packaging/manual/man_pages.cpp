#include <algorithm>
#include <cctype>
#include <map>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "packaging/manual/manual.hpp"
#include "packaging/manual/program_table.hpp"

namespace packaging {
namespace {

/// Text that troff prints as it is.
std::string escaped(const std::string& text) {
  // What people copy into a shell must not become a typographer's sign.
  static const std::map<char, const char*> signs = {{'\\', "\\e"},  {'-', "\\-"},   {'\'', "\\(aq"},
                                                    {'`', "\\(ga"}, {'^', "\\(ha"}, {'~', "\\(ti"}};
  std::string result;
  for (const char c : text) {
    // A dot at the begin of a line would be a request.
    if (c == '.' && (result.empty() || result.back() == '\n')) result += "\\&";
    const auto sign = signs.find(c);
    result += sign == signs.end() ? std::string(1, c) : sign->second;
  }
  return result;
}

std::string bold(const std::string& text) {
  return "\\fB" + escaped(text) + "\\fR";
}

std::string italic(const std::string& text) {
  return "\\fI" + escaped(text) + "\\fR";
}

std::string in_capitals(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

std::string without_full_stop(std::string text) {
  if (text.ends_with('.')) text.pop_back();
  return text;
}

/// What the footer of a help says, in the parts that manual.hpp names.
struct Footer {
  std::vector<std::string> paragraphs;
  std::vector<std::string> examples;                            ///< commands
  std::vector<std::pair<std::string, std::string>> exit_codes;  ///< and what each means
};

Footer parts_of(const std::string& footer) {
  constexpr std::string_view kExample = "Example: ";
  Footer parts;
  bool are_codes = false;
  bool begins = true;
  std::istringstream lines(footer);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t first = line.find_first_not_of(' ');
    are_codes = line == "Exit codes:" || (are_codes && first != 0);
    if (first == std::string::npos || are_codes || line.starts_with(kExample)) begins = true;
    if (first == std::string::npos) continue;
    if (are_codes) {
      if (first == 0) continue;
      const std::size_t end = line.find(' ', first);
      const std::size_t meaning = line.find_first_not_of(' ', end);
      if (meaning != std::string::npos)
        parts.exit_codes.emplace_back(line.substr(first, end - first), line.substr(meaning));
    } else if (line.starts_with(kExample)) {
      parts.examples.push_back(line.substr(kExample.size()));
    } else {
      if (begins) parts.paragraphs.emplace_back();
      parts.paragraphs.back() += (begins ? "" : " ") + line;
      begins = line.ends_with('.');
    }
  }
  return parts;
}

/// "1 to 8" and the like, of a check in the help; empty where it says nothing more.
std::string allowed_values(const ValueHelp& help) {
  if (!help.listed.empty())
    return joined(help.listed, ", ") + (help.beside.empty() ? "" : " or " + help.beside);
  const std::size_t begin = help.check.find("in [");
  const std::size_t between = help.check.find(" - ", begin);
  if (begin != std::string::npos && between != std::string::npos && help.check.ends_with(']')) {
    return help.check.substr(begin + 4, between - begin - 4) + " to " +
           help.check.substr(between + 3, help.check.size() - between - 4);
  }
  if (help.check.starts_with(">=")) {
    const std::size_t beside = std::min(help.check.find(" or "), help.check.size());
    const std::string more = help.check.substr(2, beside - 2) + " or more";
    return beside == help.check.size() ? more : more + "," + help.check.substr(beside);
  }
  if (help.check.starts_with('>')) return "above " + help.check.substr(1);
  return help.check;
}

/// The description, and after it in sentences what the help has in signs before it.
std::string description_of(const CLI::Option& option) {
  std::vector<std::string> sentences;
  const std::string values = allowed_values(value_help(option));
  if (!values.empty()) sentences.push_back("Values: " + values + ".");
  if (!option.get_default_str().empty()) sentences.push_back("Default: " + option.get_default_str() + ".");
  if (!option.get_positional() && option.get_required()) sentences.emplace_back("Required.");
  for (const CLI::Option* other : option.get_excludes())
    sentences.push_back("Not with " + other->get_name() + ".");
  const std::string& description = option.get_description();
  if (sentences.empty()) return description;
  return without_full_stop(description) + (description.empty() ? "" : ". ") + joined(sentences, " ");
}

/// "-o, --out TEXT" of an option, "FILE..." of an argument.
std::string heading_of(const CLI::Option& option) {
  const std::string many = takes_many(option) ? "..." : "";
  if (option.get_positional()) return italic(option.get_name(true)) + many;
  std::vector<std::string> names;
  for (const std::string& name : names_of(option)) names.push_back(bold(name));
  return joined(names, ", ") + (takes_value(option) ? " " + italic(value_help(option).type) + many : "");
}

void write_options(std::ostream& page, const std::string& title,
                   const std::vector<const CLI::Option*>& options) {
  if (options.empty()) return;
  page << ".SH " << title << '\n';
  for (const CLI::Option* option : options) {
    page << ".TP\n" << heading_of(*option) << '\n' << escaped(description_of(*option)) << '\n';
  }
}

void write_synopsis(std::ostream& page, const CLI::App& app) {
  page << ".SH SYNOPSIS\n" << bold(full_name(app, " "));
  if (!visible_options(app).empty()) page << " [" << italic("OPTIONS") << ']';
  for (const CLI::Option* argument : visible_arguments(app)) {
    const std::string word = heading_of(*argument);
    page << ' ' << (argument->get_required() ? word : "[" + word + "]");
  }
  if (!visible_commands(app).empty()) page << ' ' << italic("SUBCOMMAND");
  page << '\n';
}

void write_exit_status(std::ostream& page, const Footer& footer) {
  if (footer.exit_codes.empty()) return;
  page << ".SH EXIT STATUS\n";
  for (const auto& [code, meaning] : footer.exit_codes) {
    page << ".TP\n" << bold(code) << '\n' << escaped(meaning) << '\n';
  }
}

/// `form` makes text of troff's of each.
void write_paragraphs(std::ostream& page, const std::string& title, const std::vector<std::string>& texts,
                      std::string (*form)(const std::string&)) {
  if (texts.empty()) return;
  page << ".SH " << title << '\n';
  for (std::size_t i = 0; i < texts.size(); ++i) {
    page << (i == 0 ? "" : ".PP\n") << form(texts[i]) << '\n';
  }
}

std::string man_page(const CLI::App& app, const std::string& version) {
  std::ostringstream page;
  const std::string name = full_name(app, "-");
  const std::vector<const CLI::App*> commands = visible_commands(app);
  const Footer footer = parts_of(app.get_footer());
  page << R"(.TH ")" << in_capitals(name) << R"(" 1 "" ")" << version
       << "\"\n"
       // Names and commands are neither hyphenated nor stretched to the margin.
       << ".nh\n.ad l\n"
       << ".SH NAME\n"
       << escaped(name) << " \\- " << escaped(without_full_stop(app.get_description())) << '\n';
  write_synopsis(page, app);
  write_options(page, "ARGUMENTS", visible_arguments(app));
  write_options(page, "OPTIONS", visible_options(app));
  if (!commands.empty()) page << ".SH SUBCOMMANDS\n";
  for (const CLI::App* command : commands) {
    page << ".TP\n"
         << bold(full_name(*command, "-")) << "(1)\n"
         << escaped(command->get_description()) << '\n';
  }
  write_exit_status(page, footer);
  write_paragraphs(page, "NOTES", footer.paragraphs, escaped);
  write_paragraphs(page, "EXAMPLES", footer.examples, bold);
  if (app.get_parent() != nullptr) {
    page << ".SH SEE ALSO\n" << bold(full_name(*app.get_parent(), "-")) << "(1)\n";
  }
  return page.str();
}

void add_man_pages(const CLI::App& app, const std::string& version,
                   std::map<std::string, std::string>& pages) {
  pages[full_name(app, "-") + ".1"] = man_page(app, version);
  for (const CLI::App* command : visible_commands(app)) add_man_pages(*command, version, pages);
}

}  // namespace

std::map<std::string, std::string> man_pages(const CLI::App& program, const std::string& version) {
  std::map<std::string, std::string> pages;
  add_man_pages(program, version, pages);
  return pages;
}

}  // namespace packaging
