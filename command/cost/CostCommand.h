// SPDX-License-Identifier: Zlib
#pragma once

#include "command/cli/Command.h"

namespace command {

/// `wetcloth cost`: what each effect takes, beside Bullet's own step.
Command addCostCommand(CLI::App& line);

}  // namespace command
