// SPDX-License-Identifier: Zlib
#include "command/cli/Sibling.h"

#include "command/cli/Errors.h"

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

std::filesystem::path ownDirectory(const char* argument0) {
  std::error_code failed;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", failed);
  if (!failed) return self.parent_path();
  return std::filesystem::absolute(argument0, failed).parent_path();
}

/// Two programs of the same precision under both names must not start each other for ever.
constexpr const char* guard = "WETCLOTH_STARTED_BY_SIBLING";

void setGuard() {
#ifdef _WIN32
  _putenv_s(guard, "1");
#else
  setenv(guard, "1", 1);
#endif
}

}  // namespace

std::string programOf(Precision precision, char** arguments) {
  std::error_code ignored;
  const char* const name = precision == Precision::float64 ? "wetcloth-float64" : "wetcloth";
  const std::filesystem::path program = ownDirectory(arguments[0]) / name;
  return std::filesystem::exists(program, ignored) ? program.string() : "";
}

void continueInPrecision(Precision wanted, const std::string& wantedBy, char** arguments) {
  if (wanted == ownPrecision) return;
  const char* const name = wanted == Precision::float64 ? "wetcloth-float64" : "wetcloth";
  const std::filesystem::path sibling = ownDirectory(arguments[0]) / name;
  std::error_code ignored;
  if (std::getenv(guard) == nullptr && std::filesystem::exists(sibling, ignored)) {
    setGuard();
    const std::string path = sibling.string();
#ifdef _WIN32
    std::exit(static_cast<int>(_spawnv(_P_WAIT, path.c_str(), arguments)));
#else
    execv(path.c_str(), arguments);
#endif
  }
  throw InputError(wantedBy + " = \"" + nameOf(wanted) + "\": must be \"" + nameOf(ownPrecision) +
                   "\" here, for there is no " + sibling.string() + " that computes in " + nameOf(wanted));
}

}  // namespace command
