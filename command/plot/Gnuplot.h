#pragma once

#include <string>

namespace runner {

/// Lets gnuplot run a script file. False when there is no gnuplot in PATH. Throws RunError with what it complained of
/// when it fails.
bool runGnuplot(const std::string& script);

}  // namespace runner
