// SPDX-License-Identifier: Zlib
#pragma once

#include "command/cli/Command.h"

#include <memory>
#include <string>
#include <vector>

namespace command {

/// What can be said to the program, and what it is told.
class CommandLine {
 public:
  /// @param commands  in the order in which the help shows them
  /// @param examples  at the end of the help
  CommandLine(const std::vector<AddCommand>& commands, const std::string& examples);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  /// The command that was given, its options read; null where help or the version was wanted, which then has been
  /// shown. Throws InputError for bad usage. @param arguments  of main()
  const Command* read(int count, char** arguments);

 private:
  std::unique_ptr<CLI::App> m_app;
  std::vector<Command> m_commands;
};

}  // namespace command
