// SPDX-License-Identifier: Zlib
#include "command/cli/ProgramFolder.h"

#include <cstdint>
#include <cstdlib>
#include <system_error>

#ifdef __APPLE__
#include <mach-o/dyld.h>
#endif

namespace command {
namespace {

std::filesystem::path ownPath() {
#if defined(_WIN32)
  return _pgmptr;
#elif defined(__APPLE__)
  char path[4096];
  std::uint32_t size = sizeof path;
  return _NSGetExecutablePath(path, &size) == 0 ? path : "";
#else
  std::error_code ignored;
  return std::filesystem::read_symlink("/proc/self/exe", ignored);
#endif
}

}  // namespace

std::filesystem::path programFolder() { return ownPath().parent_path(); }

std::string dataFile(const std::string& name) {
  return (programFolder().parent_path() / "share" / "bullet_wetcloth" / name).string();
}

}  // namespace command
