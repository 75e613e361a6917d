// SPDX-License-Identifier: Zlib
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

namespace wetcloth_test {

/// What docs/FILE has between the lines "<!-- NAME -->" and "<!-- end of NAME -->" must be this table. With
/// WETCLOTH_WRITE_DOCS set, the table is written there instead.
inline void expectDocumented(const std::string& file, const std::string& name, const std::string& table) {
  const std::string path = WETCLOTH_SOURCE_DIR "/docs/" + file;
  const std::string first = "<!-- " + name + " -->\n";
  std::ostringstream read;
  read << std::ifstream(path).rdbuf();
  const std::string text = read.str();
  ASSERT_NE(text.find(first), std::string::npos) << path;
  const std::size_t begin = text.find(first) + first.size();
  const std::size_t end = text.find("<!-- end of " + name + " -->\n");
  ASSERT_NE(end, std::string::npos) << path;
  if (std::getenv("WETCLOTH_WRITE_DOCS") != nullptr) {
    std::ofstream(path) << text.substr(0, begin) << table << text.substr(end);
    return;
  }
  EXPECT_EQ(text.substr(begin, end - begin), table) << "WETCLOTH_WRITE_DOCS=1 with this test writes it anew";
}

}  // namespace wetcloth_test
