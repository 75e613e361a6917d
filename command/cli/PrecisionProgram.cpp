// SPDX-License-Identifier: Zlib
#include "command/cli/PrecisionProgram.h"

#include "command/cli/Errors.h"
#include "command/cli/ProgramFolder.h"

#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

#ifdef _WIN32
#include <process.h>
#else
#include <unistd.h>
#endif

namespace command {
namespace {

std::filesystem::path pathOf(Precision precision) {
  std::string name = precision == Precision::float64 ? "wetcloth-float64" : "wetcloth";
#ifdef _WIN32
  name += ".exe";
#endif
  return programFolder() / name;
}

/// Two programs of the same precision under both names must not start each other for ever.
constexpr const char* guard = "WETCLOTH_STARTED_FOR_PRECISION";

void setGuard() {
#ifdef _WIN32
  _putenv_s(guard, "1");
#else
  setenv(guard, "1", 1);
#endif
}

}  // namespace

std::string programOf(Precision precision) {
  std::error_code ignored;
  const std::filesystem::path program = pathOf(precision);
  return std::filesystem::exists(program, ignored) ? program.string() : "";
}

void continueIn(const PrecisionWish& wish, char** arguments) {
  if (wish.precision == ownPrecision) return;
  const std::string program = programOf(wish.precision);
  if (std::getenv(guard) == nullptr && !program.empty()) {
    setGuard();
#ifdef _WIN32
    std::exit(static_cast<int>(_spawnv(_P_WAIT, program.c_str(), arguments)));
#else
    execv(program.c_str(), arguments);
#endif
  }
  throw InputError(wish.wantedBy + " = \"" + nameOf(wish.precision) + "\": must be \"" + nameOf(ownPrecision) +
                   "\" here, for there is no " + pathOf(wish.precision).string() + " that computes in " +
                   nameOf(wish.precision));
}

}  // namespace command
