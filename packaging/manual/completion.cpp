#include <sstream>
#include <vector>

#include "packaging/manual/manual.hpp"
#include "packaging/manual/program_table.hpp"

namespace packaging {
namespace {

/// The words that can follow the option; empty where the help does not list them.
std::vector<std::string> known_values(const CLI::Option& option, const MoreWords& more) {
  const ValueHelp help = value_help(option);
  std::vector<std::string> words = help.listed;
  const auto beside = more.find(help.beside);
  if (beside != more.end()) words.insert(words.end(), beside->second.begin(), beside->second.end());
  return words;
}

void write_case(std::ostream& out, const std::string& pattern, const std::vector<std::string>& words) {
  out << "  \"" << pattern << "\") choices=\"" << joined(words, " ") << "\" ;;\n";
}

/// The cases of this command and those below it: after which option which words. Where none are listed, the
/// empty answer makes the shell complete the names of files.
void write_values(std::ostream& out, const CLI::App& app, const MoreWords& more) {
  for (const CLI::Option* option : visible_options(app)) {
    if (!takes_value(*option)) continue;
    for (const std::string& name : names_of(*option))
      write_case(out, full_name(app, " ") + " " + name, known_values(*option, more));
  }
  for (const CLI::App* command : visible_commands(app)) write_values(out, *command, more);
}

/// The cases of what can follow this command, and those below it.
void write_followers(std::ostream& out, const CLI::App& app) {
  std::vector<std::string> words;
  for (const CLI::App* command : visible_commands(app)) words.push_back(command->get_name());
  for (const CLI::Option* option : visible_options(app)) {
    for (const std::string& name : names_of(*option)) words.push_back(name);
  }
  write_case(out, full_name(app, " "), words);
  for (const CLI::App* command : visible_commands(app)) write_followers(out, *command);
}

void add_paths(std::vector<std::string>& paths, const CLI::App& app) {
  for (const CLI::App* command : visible_commands(app)) {
    paths.push_back('"' + full_name(*command, " ") + '"');
    add_paths(paths, *command);
  }
}

/// What both shells share. They set `command` to the program, `before` to the option in front of the word or
/// up to its '=', `is_joined` if it is the latter, and have a loop with the words between the program and the
/// word in `part`.
struct Cases {
  std::string longer_command;  ///< of `part`: whether it is a subcommand of `command`
  std::string choices;         ///< sets `choices`
};

Cases cases_of(const CLI::App& program, const MoreWords& more) {
  Cases cases;
  std::vector<std::string> paths;
  add_paths(paths, program);
  if (paths.empty()) {
    cases.longer_command = ":";
  } else {
    cases.longer_command =
        "case \"$command $part\" in " + joined(paths, " | ") + ") command+=\" $part\" ;; esac";
  }
  std::ostringstream values;
  std::ostringstream followers;
  write_values(values, program, more);
  write_followers(followers, program);
  cases.choices = "  case \"$command $before\" in\n" + values.str() +
                  "  *) [[ -n $is_joined ]] || case \"$command\" in\n" + followers.str() +
                  "  esac ;;\n  esac\n";
  return cases;
}

}  // namespace

std::string bash_completion(const CLI::App& program, const MoreWords& more) {
  const std::string& name = program.get_name();
  const Cases cases = cases_of(program, more);
  std::ostringstream script;
  script << "# Completion of " << name << " for bash.\n"
         << '_' << name << "() {\n"
         << "  local command=" << name << " choices= is_joined= at=$COMP_CWORD part\n"
         << "  local word=${COMP_WORDS[at]}\n"
         << "  # Bash takes --option=a:b apart.\n"
         << "  while ((at > 1)) && [[ ${COMP_WORDS[at]} == [=:]* || ${COMP_WORDS[at - 1]} == [=:]* ]]; do\n"
         << "    word=${COMP_WORDS[--at]}$word\n"
         << "  done\n"
         << "  local before=${COMP_WORDS[at - 1]} value=$word\n"
         << "  if [[ $word == --*=* ]]; then is_joined=1 before=${word%%=*} value=${word#*=}; fi\n"
         << "  for part in \"${COMP_WORDS[@]:1:at - 1}\"; do\n"
         << "    " << cases.longer_command << '\n'
         << "  done\n"
         << cases.choices << "  mapfile -t COMPREPLY < <(compgen -W \"$choices\" -- \"$value\")\n"
         << "  # It replaces the last part only.\n"
         << "  if [[ $value == *:* && $COMP_WORDBREAKS == *:* ]]; then\n"
         << "    COMPREPLY=(\"${COMPREPLY[@]#\"${value%\"${value##*:}\"}\"}\")\n"
         << "  elif [[ -n $is_joined && $COMP_WORDBREAKS != *=* ]]; then\n"
         << "    COMPREPLY=(\"${COMPREPLY[@]/#/$before=}\")\n"
         << "  fi\n"
         << "}\n"
         << "complete -o default -F _" << name << ' ' << name << '\n';
  return script.str();
}

std::string zsh_completion(const CLI::App& program, const MoreWords& more) {
  const std::string& name = program.get_name();
  const Cases cases = cases_of(program, more);
  std::ostringstream script;
  script << "#compdef " << name << '\n'
         << "# Completion of " << name << " for zsh.\n"
         << '_' << name << "() {\n"
         << "  local command=" << name << " choices= is_joined= part before=${words[CURRENT-1]}\n"
         << "  for part in \"${(@)words[2,CURRENT-1]}\"; do\n"
         << "    " << cases.longer_command << '\n'
         << "  done\n"
         << "  if [[ ${words[CURRENT]} == --*=* ]] && compset -P 1 '*='; then\n"
         << "    is_joined=1 before=${${words[CURRENT]}%%=*}\n"
         << "  fi\n"
         << cases.choices << "  [[ -n $choices ]] && compadd -- ${=choices} || _files\n"
         << "}\n"
         << '_' << name << " \"$@\"\n";
  return script.str();
}

}  // namespace packaging
