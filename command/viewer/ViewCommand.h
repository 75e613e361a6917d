// SPDX-License-Identifier: Zlib
#pragma once

#include "command/cli/Command.h"

namespace viewer {

/// `wetcloth view`: a scene in a window, to play with.
command::Command addViewCommand(CLI::App& line);

}  // namespace viewer
