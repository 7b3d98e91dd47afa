// The command line of a program whose subcommands leave their work as a function.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <functional>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tool/program/configuration_error.hpp"
#include "tool/program/exit_code.hpp"

namespace polylidar::tool {

/// How many letters are put in, left out or changed between two words.
inline std::size_t letters_between(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);  // place in b -> letters between what was read of a and that
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t before = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t changed = before + (a[i] == b[j] ? 0U : 1U);
      before = row[j + 1];
      row[j + 1] = std::min({changed, row[j] + 1, before + 1});
    }
  }
  return row.back();
}

/// " (did you mean --detail?)", of the words that begin with `word` or are it but for a third of its letters;
/// empty where none does.
inline std::string meant_by(const std::string& word, const std::vector<std::string>& known) {
  std::string hint;
  for (const std::string& name : known) {
    if (!name.starts_with(word) && 3 * letters_between(word, name) > word.size()) continue;
    hint += (hint.empty() ? " (did you mean " : " or ") + name;
  }
  return hint.empty() ? hint : hint + "?)";
}

/// What is wrong with what `app` was given, where CLI11's own words do not say it: a word that is none of its
/// commands or options. Empty: they do.
inline std::string unknown_word(const CLI::App& app) {
  const std::vector<std::string> words = app.remaining();
  if (words.empty()) return {};
  const std::string word = words[0].substr(0, words[0].find('='));
  std::vector<std::string> known;
  if (word.starts_with('-')) {
    for (const CLI::Option* option : app.get_options()) {
      if (option->get_group().empty()) continue;  // help does not show it either
      for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    }
    return "there is no option " + word + meant_by(word, known);
  }
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    known.push_back(command->get_name());
  }
  return known.empty() ? "'" + words[0] + "' is one argument too many"
                       : "there is no command '" + word + "'" + meant_by(word, known);
}

/// Throws ConfigurationError for an option of `app` or of its commands that was given no value, as by a
/// variable of the shell that is not set: it would be as if it were not there.
inline void check_no_value_is_empty(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options()) {
    const std::vector<std::string>& values = option->results();
    if (std::find(values.begin(), values.end(), "") == values.end()) continue;
    throw ConfigurationError(option->get_name() + " is empty; give it a value, or leave it out");
  }
  for (const CLI::App* command : app.get_subcommands()) check_no_value_is_empty(*command);
}

/// Parses with `app`, whose subcommands set `action`, and gives that; nothing to do when help was asked for.
/// Throws ConfigurationError when the command line is wrong.
inline std::function<ExitCode()> parsed_action(CLI::App& app, const std::function<ExitCode()>& action,
                                               int argc, char** argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& request) {
    app.exit(request);
    return [] { return kExitOk; };
  } catch (const CLI::ParseError& error) {
    const CLI::App* command = &app;
    std::string name = app.get_name();
    while (!command->get_subcommands().empty()) {
      command = command->get_subcommands()[0];
      name += " " + command->get_name();
    }
    const bool is_about_words = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr ||
                                dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
    const std::string unknown = is_about_words ? unknown_word(*command) : std::string();
    throw ConfigurationError((unknown.empty() ? std::string(error.what()) : unknown) + "; '" + name +
                             " --help' shows what there is");
  }
  check_no_value_is_empty(app);
  return action;
}

}  // namespace polylidar::tool
