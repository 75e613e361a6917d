// SPDX-License-Identifier: Zlib
#pragma once

namespace command {

/// Reads the command line and does what it says. Returns the exit status of help and success, 0; throws InputError
/// for bad usage or input and another exception when a run failed.
int runCommandLine(int count, char** arguments);

}  // namespace command
