// SPDX-License-Identifier: Zlib
#pragma once

#include "command/cli/Command.h"

namespace stability {

/// `wetcloth stability`: hard cases against the bounds of physics.
command::Command addStabilityCommand(CLI::App& line);

}  // namespace stability
