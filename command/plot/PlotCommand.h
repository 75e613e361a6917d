// SPDX-License-Identifier: Zlib
#pragma once

#include "command/cli/Command.h"

namespace command {

/// `wetcloth plot`: the paper's numbers beside ours.
Command addPlotCommand(CLI::App& line);

}  // namespace command
