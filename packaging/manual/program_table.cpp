#include "packaging/manual/program_table.hpp"

#include <sstream>

namespace packaging {
namespace {

std::vector<const CLI::Option*> visible(const CLI::App& app, bool positional) {
  return app.get_options([positional](const CLI::Option* option) {
    return !option->get_group().empty() && option->get_positional() == positional;
  });
}

}  // namespace

std::vector<const CLI::App*> visible_commands(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

std::vector<const CLI::Option*> visible_options(const CLI::App& app) {
  return visible(app, false);
}

std::vector<const CLI::Option*> visible_arguments(const CLI::App& app) {
  return visible(app, true);
}

std::string full_name(const CLI::App& app, const std::string& between) {
  return app.get_parent() == nullptr ? app.get_name()
                                     : full_name(*app.get_parent(), between) + between + app.get_name();
}

std::vector<std::string> names_of(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

bool takes_value(const CLI::Option& option) {
  return option.get_items_expected_max() > 0;
}

bool takes_many(const CLI::Option& option) {
  return option.get_items_expected_max() > 1;
}

ValueHelp value_help(const CLI::Option& option) {
  const std::string text = option.get_type_name();
  const std::size_t colon = text.find(':');
  ValueHelp help;
  help.type = text.substr(0, colon);
  if (colon == std::string::npos) return help;
  help.check = text.substr(colon + 1);
  const std::size_t begin = help.check.find('{');
  const std::size_t end = help.check.find('}', begin);
  if (begin == std::string::npos || end == std::string::npos) return help;
  std::istringstream words(help.check.substr(begin + 1, end - begin - 1));
  for (std::string word; std::getline(words, word, ',');) help.listed.push_back(word);
  const std::string after = help.check.substr(end + 1);
  const std::string either = " or ";
  if (after.starts_with(either)) help.beside = after.substr(either.size());
  return help;
}

std::string joined(const std::vector<std::string>& words, const std::string& between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

}  // namespace packaging
