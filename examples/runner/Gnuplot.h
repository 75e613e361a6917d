#pragma once

#include <string>

namespace runner {

/// Lets gnuplot run a script file. False when there is no gnuplot in PATH. Throws RunError with what it complained of
/// when it fails.
/// @param log  a file for its complaints, which is overwritten
bool runGnuplot(const std::string& script, const std::string& log);

}  // namespace runner
