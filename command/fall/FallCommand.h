// SPDX-License-Identifier: Zlib
#pragma once

#include "command/cli/Command.h"

namespace command {

/// `wetcloth fall`: dry and wet cloth fall, beside plain Bullet.
Command addFallCommand(CLI::App& line);

}  // namespace command
