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
#include <cstdint>
#include <vector>
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

#ifdef _WIN32

void setGuard() { _putenv_s(guard, "1"); }

/// Windows hands a program one line, which its C library takes apart: a backslash is only special before a quote.
std::string quoted(const std::string& word) {
  std::string text = "\"";
  std::string backslashes;
  for (const char character : word) {
    if (character == '"') text += backslashes + '\\';
    text += character;
    backslashes = character == '\\' ? backslashes + character : "";
  }
  return text + backslashes + '"';
}

/// Comes back only where it cannot be started.
void goOnAs(const std::string& program, char** arguments) {
  std::vector<std::string> words;
  for (; *arguments != nullptr; ++arguments) words.push_back(quoted(*arguments));
  std::vector<const char*> pointers;
  for (const std::string& word : words) pointers.push_back(word.c_str());
  pointers.push_back(nullptr);
  const std::intptr_t status = _spawnv(_P_WAIT, program.c_str(), pointers.data());
  if (status != -1) std::exit(static_cast<int>(status));
}

#else

void setGuard() { setenv(guard, "1", 1); }

/// Comes back only where it cannot be started.
void goOnAs(const std::string& program, char** arguments) { execv(program.c_str(), arguments); }

#endif

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
    goOnAs(program, arguments);
  }
  throw InputError(wish.wantedBy + " = \"" + nameOf(wish.precision) + "\": must be \"" + nameOf(ownPrecision) +
                   "\" here, for there is no " + pathOf(wish.precision).string() + " that computes in " +
                   nameOf(wish.precision));
}

}  // namespace command
