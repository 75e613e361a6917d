// SPDX-License-Identifier: Zlib
// Equal states, equal bytes: two processes that run one scene write the same files, but for what they say of time.

#include "tests/command/Command.h"
#include "tests/command/RenderCheck.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

namespace wetcloth_test::same_bytes_test {
namespace {

using namespace cli;
namespace fs = std::filesystem;

using Files = std::map<std::string, std::string>;

/// All files below a directory, by their names from there.
Files filesIn(const std::string& directory) {
  Files files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(directory)) {
    if (!entry.is_regular_file()) continue;
    std::ifstream stream(entry.path(), std::ios::binary);
    files[fs::relative(entry.path(), directory).string()] = {std::istreambuf_iterator<char>(stream), {}};
  }
  return files;
}

/// What two processes with these arguments write must be the same; returns the files. Words that begin with "out" are
/// their names.
Files writtenTwice(const std::vector<std::string>& arguments) {
  Files first;
  for (const bool isFirst : {true, false}) {
    const TemporaryDirectory directory;
    std::vector<std::string> words = arguments;
    for (std::string& word : words) {
      if (word.rfind("out", 0) == 0) word = directory.path(word);
    }
    const Outcome outcome = runWetcloth(words);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    Files files = filesIn(directory.path(""));
    if (isFirst) {
      first = std::move(files);
      continue;
    }
    EXPECT_EQ(files.size(), first.size());
    for (const auto& [name, bytes] : files) EXPECT_TRUE(bytes == first[name]) << name;
  }
  EXPECT_FALSE(first.empty());
  return first;
}

// In each of the worlds that scenes use, with all that a checkpoint has.
TEST(SameBytes, CheckpointsAndFrames) {
  for (const char* name : {"hanging_towel", "towel_under_hose", "curtain_deformable"}) {
    SCOPED_TRACE(name);
    const Files files = writtenTwice({"run", sceneFile(name), "--duration", "0.2", "--no-comparison", "--checkpoint",
                                      "out.state", "--every", "10", "--frames", "out.frames", "--frame-count", "3"});
    EXPECT_EQ(files.size(), 1u + 3);
  }
}

TEST(SameBytes, ReportsButForTheirTimes) {
  Json reports[2];
  for (Json& report : reports) {
    report = runCompared(sceneFile("towel_under_hose"), {"--duration", "0.3"});
    for (const char* time : {"wall_ms_per_step", "bullet_ms_per_step"}) EXPECT_EQ(report.erase(time), 1u);
  }
  EXPECT_EQ(reports[0].dump(), reports[1].dump());
}

TEST(SameBytes, Exports) {
  for (const char* format : {"ply", "obj_pc2", "vtk", "usda", "html"}) {
    const std::string kind = format;
    const std::string out = kind == "usda" || kind == "html" ? "out." + kind : "out";
    writtenTwice({"export", sceneFile("towel_under_hose"), "--duration", "0.1", "--format", format, "--out", out});
  }
}

TEST(SameBytes, PicturesFilmsAndPages) {
  const std::string missing = whyNothingCanBeDrawn();
  if (!missing.empty()) GTEST_SKIP() << missing;
  std::vector<std::string> suffixes = {"png", "html"};
  if (runProgram({"ffmpeg", "-version"}).status == 0) suffixes.insert(suffixes.end(), {"mp4", "webm", "gif"});
  for (const std::string& suffix : suffixes) {
    std::vector<std::string> words = {"render",       sceneFile("hanging_towel"), "--duration", "0.1", "--out",
                                      "out." + suffix};
    if (suffix != "html") words.insert(words.end(), {"--size", "80x60"});
    writtenTwice(words);
  }
}

}  // namespace
}  // namespace wetcloth_test::same_bytes_test
