// SPDX-License-Identifier: Zlib
#pragma once

#include "command/cli/Precision.h"

#include <functional>

namespace CLI {
class App;
}

namespace command {

/// One command of the program, such as `wetcloth run`.
struct Command {
  CLI::App* options;                              ///< its word, its options and their help
  std::function<void()> run;                      ///< does it, once its options are read; they belong to this function
  std::function<PrecisionWish()> precision = {};  ///< asked before; empty: any precision does
};

/// Adds a command to the command line.
using AddCommand = Command (*)(CLI::App& line);

}  // namespace command
