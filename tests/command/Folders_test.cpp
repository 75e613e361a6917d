// SPDX-License-Identifier: Zlib
// Includes among the command's folders run one way.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace wetcloth_test::folders_test {
namespace {

namespace fs = std::filesystem;

/// From the lowest: each includes itself and those before it. main.cpp is above all of them.
const std::vector<std::string>& folders() {
  static const std::vector<std::string> all{"cli",    "timing",   "measured",  "pictures", "pictures/gl", "scene",
                                            "ccd",    "fall",     "plot",      "run",      "cost",        "render",
                                            "viewer", "accuracy", "stability", "fit",      "reality"};
  return all;
}

std::ptrdiff_t rankOf(const std::string& folder) {
  return std::find(folders().begin(), folders().end(), folder) - folders().begin();
}

/// The folders of the command that a file includes.
std::vector<std::string> includedBy(const fs::path& file) {
  const std::string start = "#include \"command/";
  std::vector<std::string> included;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    if (line.rfind(start, 0) != 0) continue;
    const std::size_t slash = line.rfind('/');
    if (slash >= start.size()) included.push_back(line.substr(start.size(), slash - start.size()));
  }
  return included;
}

TEST(CommandFolders, IncludeOnlyThoseBelow) {
  const fs::path root = fs::path(WETCLOTH_SOURCE_DIR) / "command";
  int files = 0, includes = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root)) {
    const fs::path& file = entry.path();
    if (file.extension() != ".h" && file.extension() != ".cpp") continue;
    ++files;
    const std::string folder = file.parent_path().lexically_relative(root).generic_string();
    if (folder == ".") continue;
    EXPECT_LT(rankOf(folder), rankOf("")) << folder << " has no place in the order";
    for (const std::string& included : includedBy(file)) {
      ++includes;
      EXPECT_LE(rankOf(included), rankOf(folder)) << file << " includes " << included;
    }
  }
  EXPECT_GT(files, 100);
  EXPECT_GT(includes, 100);
}

}  // namespace
}  // namespace wetcloth_test::folders_test
