#include "packaging/manual/manual.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace packaging {
namespace {

std::vector<const CLI::App*> visible_commands(const CLI::App& app) {
  std::vector<const CLI::App*> commands =
      app.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
  return commands;
}

std::vector<const CLI::Option*> visible_options(const CLI::App& app, bool positional) {
  return app.get_options([positional](const CLI::Option* option) {
    return !option->get_group().empty() && option->get_positional() == positional;
  });
}

/// The names from the program on, "hullbench adapter new", with `between` between them.
std::string full_name(const CLI::App& app, const std::string& between) {
  return app.get_parent() == nullptr ? app.get_name()
                                     : full_name(*app.get_parent(), between) + between + app.get_name();
}

/// Text that troff prints as it is.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    // A dot or an apostrophe at the begin of a line would be a request.
    const bool begins = result.empty() || result.back() == '\n';
    if (begins && (c == '.' || c == '\'')) result += "\\&";
    if (c == '\\') {
      result += "\\e";
    } else if (c == '-') {
      result += "\\-";
    } else {
      result += c;
    }
  }
  return result;
}

std::string in_capitals(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

/// " TEXT:{a,b} REQUIRED" and the like, as the help has it.
std::string option_value(const CLI::Option& option) {
  return CLI::Formatter().make_option_opts(&option);
}

void write_options(std::ostream& page, const std::string& title,
                   const std::vector<const CLI::Option*>& options) {
  if (options.empty()) return;
  page << ".SH " << title << '\n';
  for (const CLI::Option* option : options) {
    const std::string name =
        option->get_positional() ? option->get_name(true) : option->get_name(false, true);
    page << ".TP\n\\fB" << escaped(name) << "\\fR" << escaped(option_value(*option)) << '\n'
         << escaped(option->get_description()) << '\n';
  }
}

std::string man_page(const CLI::App& app, const std::string& version) {
  std::ostringstream page;
  const std::string name = full_name(app, "-");
  page << R"(.TH ")" << in_capitals(name) << R"(" 1 "" ")" << version << "\"\n"
       << ".SH NAME\n"
       << escaped(name) << " \\- " << escaped(app.get_description()) << '\n'
       << ".SH SYNOPSIS\n\\fB" << escaped(full_name(app, " ")) << "\\fR";
  if (!visible_options(app, false).empty()) page << " [\\fIOPTIONS\\fR]";
  for (const CLI::Option* option : visible_options(app, true)) {
    const std::string word = "\\fI" + escaped(option->get_name(true)) + "\\fR" +
                             (option->get_items_expected_max() > 1 ? "..." : "");
    page << ' ' << (option->get_required() ? word : "[" + word + "]");
  }
  const std::vector<const CLI::App*> commands = visible_commands(app);
  if (!commands.empty()) page << " \\fISUBCOMMAND\\fR";
  page << '\n';
  write_options(page, "ARGUMENTS", visible_options(app, true));
  write_options(page, "OPTIONS", visible_options(app, false));
  if (!commands.empty()) page << ".SH SUBCOMMANDS\n";
  for (const CLI::App* command : commands) {
    page << ".TP\n\\fB" << escaped(full_name(*command, "-")) << "\\fR(1)\n"
         << escaped(command->get_description()) << '\n';
  }
  if (!app.get_footer().empty()) page << ".SH NOTES\n.nf\n" << escaped(app.get_footer()) << "\n.fi\n";
  if (app.get_parent() != nullptr) {
    page << ".SH SEE ALSO\n\\fB" << escaped(full_name(*app.get_parent(), "-")) << "\\fR(1)\n";
  }
  return page.str();
}

void add_man_pages(const CLI::App& app, const std::string& version,
                   std::map<std::string, std::string>& pages) {
  pages[full_name(app, "-") + ".1"] = man_page(app, version);
  for (const CLI::App* command : visible_commands(app)) add_man_pages(*command, version, pages);
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

/// The words that the option takes, "{a,b,c}" in the help; empty where they are not listed.
std::string listed_words(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t begin = type.find('{');
  const std::size_t end = type.find('}', begin);
  if (begin == std::string::npos || end == std::string::npos) return "";
  std::string words = type.substr(begin + 1, end - begin - 1);
  std::replace(words.begin(), words.end(), ',', ' ');
  return words;
}

/// The cases of this command and those below it: what can follow, and after which option which words.
void write_cases(std::ostream& follows, std::ostream& values, const CLI::App& app) {
  std::vector<std::string> words;
  const std::string path = full_name(app, " ");
  for (const CLI::App* command : visible_commands(app)) words.push_back(command->get_name());
  for (const CLI::Option* option : visible_options(app, false)) {
    std::vector<std::string> names;
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    words.insert(words.end(), names.begin(), names.end());
    if (option->get_items_expected_max() == 0) continue;
    // Where nothing is listed, the empty answer makes bash complete the names of files.
    for (const std::string& name : names) {
      values << "    \"" << path << ' ' << name << "\") words=\"" << listed_words(*option) << "\" ;;\n";
    }
  }
  follows << "    \"" << path << "\") words=\"" << joined(words) << "\" ;;\n";
  for (const CLI::App* command : visible_commands(app)) write_cases(follows, values, *command);
}

void write_paths(std::ostream& out, const CLI::App& app) {
  for (const CLI::App* command : visible_commands(app)) {
    out << (app.get_parent() == nullptr && command == visible_commands(app).front() ? "" : " | ") << '"'
        << full_name(*command, " ") << '"';
    write_paths(out, *command);
  }
}

void write_file(const std::filesystem::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text << std::flush;
  if (!out.good()) throw std::runtime_error("cannot write " + file.string());
}

}  // namespace

std::map<std::string, std::string> man_pages(const CLI::App& program, const std::string& version) {
  std::map<std::string, std::string> pages;
  add_man_pages(program, version, pages);
  return pages;
}

std::string bash_completion(const CLI::App& program) {
  std::ostringstream follows;
  std::ostringstream values;
  std::ostringstream paths;
  write_cases(follows, values, program);
  write_paths(paths, program);
  const std::string& name = program.get_name();
  std::ostringstream script;
  script << "# Completion of " << name << " for bash.\n"
         << '_' << name << "() {\n"
         << "  local path=" << name << " words= i\n"
         << "  COMPREPLY=()\n";
  if (!paths.str().empty()) {
    script << "  for ((i = 1; i < COMP_CWORD; i++)); do\n"
           << "    case \"$path ${COMP_WORDS[i]}\" in\n"
           << "    " << paths.str() << ") path+=\" ${COMP_WORDS[i]}\" ;;\n"
           << "    esac\n"
           << "  done\n";
  }
  script << "  case \"$path ${COMP_WORDS[COMP_CWORD - 1]}\" in\n"
         << values.str() << "    *)\n"
         << "    case \"$path\" in\n"
         << follows.str() << "    esac\n"
         << "    ;;\n"
         << "  esac\n"
         << "  mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"${COMP_WORDS[COMP_CWORD]}\")\n"
         << "}\n"
         << "complete -o default -F _" << name << ' ' << name << '\n';
  return script.str();
}

void add_manual(CLI::App& program, const std::string& version) {
  program
      .add_option_function<std::string>(
          "--write-manual",
          [&program, version](const std::string& folder) {
            for (const auto& [name, text] : man_pages(program, version))
              write_file(std::filesystem::path(folder) / name, text);
            write_file(std::filesystem::path(folder) / program.get_name(), bash_completion(program));
            throw CLI::Success();
          },
          "Write the man pages and the completion for bash into this folder")
      ->group("");
}

}  // namespace packaging
