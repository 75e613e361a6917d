// SPDX-License-Identifier: Zlib
#pragma once

#include "command/cli/Command.h"

namespace command {

/// `wetcloth run`: runs a scene and tells what came of it.
Command addRunCommand(CLI::App& line);

}  // namespace command
