#include "commands/command_line.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "case/complaints.hpp"
#include "case/error.hpp"
#include "case/reference.hpp"
#include "case/suggest.hpp"

namespace railwave {
namespace {

using case_file::printable;

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : commands_of(app)) names.push_back(command->get_name());
  return names;
}

const CLI::App* command_called(const CLI::App& app, const std::string& name) {
  for (const CLI::App* command : commands_of(app))
    if (command->get_name() == name) return command;
  return nullptr;
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    if (!option->get_positional()) names.push_back(option->get_name());
  return names;
}

/// "run: ", before what is said of it; nothing for the program itself, whose name stands there anyhow.
std::string before(const std::string& called) {
  const auto blank = called.find(' ');
  return blank == std::string::npos ? "" : called.substr(blank + 1) + ": ";
}

bool is_option(const std::string& word) { return word.size() > 1 && word[0] == '-'; }

/// The command that the words lead to, how it is called, and what is left of the words.
struct Reached {
  const CLI::App* app;
  std::string called = "railwave";
  std::vector<std::string> rest;
};

Reached reached(const CLI::App& app, const std::vector<std::string>& words) {
  Reached found{&app, "railwave", words};
  while (!found.rest.empty()) {
    const CLI::App* next = command_called(*found.app, found.rest.front());
    if (!next) break;
    found.app = next;
    found.called += " " + found.rest.front();
    found.rest.erase(found.rest.begin());
  }
  return found;
}

std::string no_command(const Reached& at) {
  const auto names = command_names(*at.app);
  const auto word = std::find_if_not(at.rest.begin(), at.rest.end(), is_option);
  const bool kind = at.app->get_name() == "signal";
  if (word == at.rest.end())
    return fmt::format("{}{} is missing; there are: {}", before(at.called), kind ? "a kind of analysis" : "a command",
                       joined(names));
  const auto near = nearest_name(*word, names);
  return fmt::format("{}there is no {} '{}'; {}", before(at.called), kind ? "analysis" : "command", printable(*word),
                     near.empty() ? "there are: " + joined(names) : "did you mean '" + near + "'?");
}

std::string not_expected(const Reached& at, std::vector<std::string> extras) {
  std::reverse(extras.begin(), extras.end());
  const auto option = std::find_if(extras.begin(), extras.end(), is_option);
  if (option == extras.end())
    return fmt::format("{}'{}' is one word too many; names with blanks stand in quotes", before(at.called),
                       extras.empty() ? "" : printable(extras.front()));
  const std::string name = option->substr(0, option->find('='));
  const auto near = nearest_name(name, option_names(*at.app));
  return fmt::format("{}there is no option '{}'; {}", before(at.called), printable(name),
                     near.empty() ? "options are: " + joined(option_names(*at.app)) : "did you mean '" + near + "'?");
}

}  // namespace

std::string usage_error(const CLI::App& app, const CLI::ParseError& error, const std::vector<std::string>& words) {
  const Reached at = reached(app, words);
  const std::string more = fmt::format("\n{} --help tells more", at.called);
  if (!commands_of(*at.app).empty() && dynamic_cast<const CLI::ValidationError*>(&error) == nullptr) {
    const bool stray = !at.rest.empty() && is_option(at.rest.front());
    return (stray ? not_expected(at, at.rest) : no_command(at)) + more;
  }
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) return not_expected(at, at.app->remaining(true)) + more;
  if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) {
    const std::string text = error.what();
    const bool missing_case = text.rfind("case ", 0) == 0, missing_results = text.rfind("results ", 0) == 0,
               missing_study = text.rfind("study ", 0) == 0, missing_deck = text.rfind("deck ", 0) == 0;
    return fmt::format("{}{} is missing{}{}", before(at.called),
                       missing_case      ? "a case file"
                       : missing_results ? "a results file"
                       : missing_study   ? "a study file"
                       : missing_deck    ? "a keyword deck"
                                         : text.substr(0, text.find(' ')),
                       missing_case ? fmt::format("; give one, such as {} cases/rolling.toml", at.called) : "", more);
  }
  std::string text = printable(error.what(), 400);
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr)
    text = text.substr(0, text.find(':')) +
           ": its value is missing, or it has too many: " + text.substr(std::min(text.size(), text.find(':') + 2));
  return before(at.called) + text + more;
}

std::string help_on(const CLI::App& app, const std::vector<std::string>& topic) {
  if (topic.empty()) return case_help("");
  const Reached at = reached(app, topic);
  std::string text;
  if (at.rest.empty()) text = at.app->help(at.called.substr(0, at.called.rfind(' ')));
  try {
    if (topic.size() == 1) text += (text.empty() ? "" : "\n") + case_help(topic[0]);
  } catch (const InputError& unknown) {
    const auto near = nearest_name(topic[0], command_names(app));
    const bool suggested = std::string(unknown.what()).find("did you mean") != std::string::npos;
    if (text.empty() && !near.empty() && !suggested)
      throw InputError(
          fmt::format("no command, section or key of the case file is called '{}'; did you mean the command '{}'?",
                      printable(topic[0]), near));
    if (text.empty()) throw;
  }
  if (text.empty()) throw InputError(no_command(at));
  return text;
}

}  // namespace railwave
