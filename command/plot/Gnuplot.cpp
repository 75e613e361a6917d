// SPDX-License-Identifier: Zlib
#include "command/plot/Gnuplot.h"

#include "command/cli/Errors.h"

#include "command/pictures/ChildProgram.h"
#include "command/pictures/Unavailable.h"

namespace command {

bool runGnuplot(const std::string& script) {
  try {
    pictures::ChildProgram gnuplot({"gnuplot", script});
    if (gnuplot.finish()) return true;
    throw RunError("wetcloth: gnuplot failed: " + onOneLine(gnuplot.complaint()));
  } catch (const pictures::Unavailable&) {
    return false;
  }
}

}  // namespace command
