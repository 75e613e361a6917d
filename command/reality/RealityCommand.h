// SPDX-License-Identifier: Zlib
#pragma once

#include "command/cli/Command.h"

namespace reality {

/// `wetcloth reality`: the models against what others have measured.
command::Command addRealityCommand(CLI::App& line);

}  // namespace reality
