// SPDX-License-Identifier: Zlib
#include "command/cli/CommandLine.h"

#include "bullet_wetcloth/Version.h"
#include "command/cli/Errors.h"
#include "command/cli/NearestWord.h"

#include <CLI/CLI.hpp>

#include <algorithm>

namespace command {
namespace {

/// CLI11 calls an unknown subcommand an extra argument.
void requireKnownCommand(const std::vector<Command>& commands, int count, char** arguments) {
  std::vector<std::string> names;
  for (const Command& command : commands) names.push_back(command.options->get_name());
  if (count < 2) throw InputError("wetcloth: needs a command: " + joined(names) + "; see wetcloth --help");
  const std::string word = arguments[1];
  if (word[0] == '-' || std::find(names.begin(), names.end(), word) != names.end()) return;
  throw InputError("wetcloth: unknown command \"" + word + "\"; " + didYouMean(word, names) + "must be one of " +
                   joined(names));
}

[[noreturn]] void rejectEmpty(int number, const std::string& word, const std::string& before) {
  const std::string place = before.empty() ? "" : ", after " + before;
  throw InputError("wetcloth: argument " + std::to_string(number) + " = \"" + word + "\"" + place + ": is empty");
}

/// Most often a variable of a shell that was never set: as if nothing had been said would be a surprise.
void requireNoneEmpty(int count, char** arguments) {
  for (int i = 1; i < count; ++i) {
    const std::string word = arguments[i];
    const bool isOption = word.rfind("--", 0) == 0;
    if (!word.empty() && !(isOption && word.back() == '=')) continue;
    rejectEmpty(i, word, i > 1 && word.empty() ? arguments[i - 1] : "");
  }
}

/// CLI11 names what it does not know, but not what was meant.
void requireKnownOptions(const CLI::App& command, int count, char** arguments) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  for (int i = 2; i < count; ++i) {
    const std::string word = std::string(arguments[i]).substr(0, std::string(arguments[i]).find('='));
    if (word == "--") return;
    if (word.rfind("--", 0) != 0 || std::find(names.begin(), names.end(), word) != names.end()) continue;
    throw InputError("wetcloth: unknown option \"" + word + "\"; " + didYouMean(word, names) + "must be one of " +
                     joined(names));
  }
}

}  // namespace

CommandLine::CommandLine(const std::vector<AddCommand>& commands, const std::string& examples)
    : m_app(std::make_unique<CLI::App>(
          "Runs scenes with cloth that gets wet, in Bullet, and compares them with Bullet as it is.", "wetcloth")) {
  m_app->footer(examples);
  m_app->set_version_flag("--version", "wetcloth " WETCLOTH_VERSION_STRING);
  m_app->require_subcommand(1);
  m_app->allow_windows_style_options(false);  // a path may begin with a slash there, too
  for (const AddCommand add : commands) m_commands.push_back(add(*m_app));
}

CommandLine::~CommandLine() = default;

const Command* CommandLine::read(int count, char** arguments) {
  requireNoneEmpty(count, arguments);
  requireKnownCommand(m_commands, count, arguments);
  try {
    if (arguments[1][0] != '-') requireKnownOptions(*m_app->get_subcommand(arguments[1]), count, arguments);
    m_app->parse(count, arguments);
  } catch (const CLI::Success& help) {
    m_app->exit(help);
    return nullptr;
  } catch (const CLI::ParseError& error) {
    throw InputError("wetcloth: " + onOneLine(error.what()));
  }
  return &*std::find_if(m_commands.begin(), m_commands.end(),
                        [](const Command& command) { return command.options->parsed(); });
}

}  // namespace command
