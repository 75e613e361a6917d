// SPDX-License-Identifier: Zlib
#include "command/cli/DistinctFiles.h"

#include "command/cli/Errors.h"

#include <cstddef>
#include <filesystem>
#include <system_error>

namespace command {
namespace {

namespace fs = std::filesystem;

bool isFile(const std::string& path) {
  std::error_code ignored;
  return !path.empty() && path != "-" && !fs::is_directory(path, ignored);
}

// One that is not there yet has no identity but its path. A device may be written to by all.
bool areSame(const std::string& a, const std::string& b) {
  std::error_code ignored;
  if (fs::exists(a, ignored) && fs::exists(b, ignored)) {
    return fs::is_regular_file(a, ignored) && fs::equivalent(a, b, ignored);
  }
  return fs::weakly_canonical(fs::absolute(a, ignored), ignored) ==
         fs::weakly_canonical(fs::absolute(b, ignored), ignored);
}

}  // namespace

void requireDistinctFiles(const std::vector<std::pair<std::string, std::string>>& files) {
  for (std::size_t i = 0; i < files.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (!isFile(files[i].second) || !isFile(files[k].second) || !areSame(files[i].second, files[k].second)) continue;
      throw InputError("wetcloth: " + files[i].first + " = \"" + files[i].second + "\": must be another file than " +
                       files[k].first);
    }
  }
}

}  // namespace command
