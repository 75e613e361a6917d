// SPDX-License-Identifier: Zlib
#pragma once

#include "command/cli/Command.h"

namespace command {

/// `wetcloth ccd`: what a collision check gets wrong, and how long it takes.
Command addCcdCommand(CLI::App& line);

}  // namespace command
