// SPDX-License-Identifier: Zlib
#pragma once

#include <string>

namespace command {

/// Lets gnuplot run a script file. False when there is no gnuplot in PATH. Throws RunError with what it complained of
/// when it fails.
bool runGnuplot(const std::string& script);

}  // namespace command
