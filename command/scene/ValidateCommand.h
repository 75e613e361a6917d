// SPDX-License-Identifier: Zlib
#pragma once

#include "command/cli/Command.h"

namespace command {

/// `wetcloth validate`: checks scenes without running them.
Command addValidateCommand(CLI::App& line);

}  // namespace command
