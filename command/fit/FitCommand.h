// SPDX-License-Identifier: Zlib
#pragma once

#include "command/cli/Command.h"

namespace fit {

/// `wetcloth fit`: a fabric from one's own measurements.
command::Command addFitCommand(CLI::App& line);

}  // namespace fit
