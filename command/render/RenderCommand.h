// SPDX-License-Identifier: Zlib
#pragma once

#include "command/cli/Command.h"

namespace command {

/// `wetcloth render`: pictures, films and pages of a scene, without a display.
Command addRenderCommand(CLI::App& line);

}  // namespace command
