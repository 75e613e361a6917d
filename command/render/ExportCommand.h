// SPDX-License-Identifier: Zlib
#pragma once

#include "command/cli/Command.h"

namespace command {

/// `wetcloth export`: a scene's run as files for other programs.
Command addExportCommand(CLI::App& line);

}  // namespace command
