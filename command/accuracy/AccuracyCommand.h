// SPDX-License-Identifier: Zlib
#pragma once

#include "command/cli/Command.h"

namespace accuracy {

/// `wetcloth accuracy`: how wrong each way to compute is, and what it takes.
command::Command addAccuracyCommand(CLI::App& line);

}  // namespace accuracy
