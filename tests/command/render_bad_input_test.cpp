// SPDX-License-Identifier: Zlib
#include "tests/command/Command.h"
#include "tests/command/RenderCheck.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#ifndef _WIN32
#include <unistd.h>
#endif

// Each is refused in one line that names the option, the value and what is allowed, and leaves no file.

namespace wetcloth_test::render_bad_input_test {
namespace {

using namespace cli;

struct BadInput {
  std::vector<std::string> arguments;
  std::vector<std::string> words;
};

void expectRefused(const std::string& out, const BadInput& bad) {
  SCOPED_TRACE(out + " " + bad.arguments.front());
  const TemporaryDirectory directory;
  std::vector<std::string> words{"render", directory.write("scene.json", smallScene().dump()), "--out",
                                 directory.path(out)};
  words.insert(words.end(), bad.arguments.begin(), bad.arguments.end());
  expectRefusal(runWetcloth(words), bad.words);
  EXPECT_EQ(namesIn(directory.path("")), std::vector<std::string>{"scene.json"});
}

TEST(RenderBadInput, Sizes) {
  for (const char* size : {"0x0", "0x720", "15x720", "8193x720", "1280x99999999999", "-1280x720", "1280", "1280x720x3",
                           "1280*720", "nanx720", "1e3x720"}) {
    expectRefused("a.png", {{"--size=" + std::string(size)},
                            {"--size = \"" + std::string(size) + "\"", "WIDTHxHEIGHT", "16 to 8192"}});
  }
  expectRefused("a.mp4", {{"--size=101x64"}, {"--size = \"101x64\"", "even"}});
  expectRefused("a.webm", {{"--size=100x63"}, {"--size = \"100x63\"", "even"}});
}

TEST(RenderBadInput, Times) {
  for (const char* time : {"nan", "inf", "-1", "0.11", "1e9"}) {
    expectRefused("a.png", {{"--times=" + std::string(time)}, {"--times = ", "in [0, 0.1] s"}});
  }
  expectRefused("a.png", {{"--times=0.05,0.01"}, {"--times = 0.01", "later than the one before"}});
  expectRefused("a.png", {{"--times=0.05,0.05"}, {"--times = 0.05", "later than the one before"}});
  expectRefused("a.png", {{"--times=early"}, {"--times", "early"}});
  expectRefused("a.mp4", {{"--times=0.05"}, {"--times = 0.05", "film"}});
}

TEST(RenderBadInput, Numbers) {
  for (const char* value : {"0", "-1", "nan", "1e9"}) {
    const std::string word(value);
    expectRefused("a.mp4", {{"--fps=" + word}, {"--fps = ", "in [1, 240]"}});
    expectRefused("a.mp4", {{"--speed=" + word}, {"--speed = ", "in [0.001, 1000]"}});
    expectRefused("a.png", {{"--field-of-view=" + word}, {"--field-of-view = ", "in [1, 120]"}});
    expectRefused("a.png", {{"--duration=" + word}, {"--duration = ", "> 0", "2e9 steps"}});
  }
  expectRefused("a.png", {{"--orbit=nan"}, {"--orbit = nan", "in [-360, 360]"}});
  expectRefused("a.png", {{"--view=0,0,0"}, {"--view", "not all zero"}});
  expectRefused("a.png", {{"--view=1,nan,0"}, {"--view = nan", "finite"}});
  expectRefused("a.png", {{"--view=1,2"}, {"--view"}});
}

TEST(RenderBadInput, Words) {
  expectRefused("a.png", {{"--colouring=speeed"}, {"--colouring = \"speeed\"", "did you mean \"speed\"?", "fabric"}});
  expectRefused("a.png", {{"--quality=best"}, {"--quality = \"best\"", "draft"}});
  expectRefused("a.png", {{"--precision=float16"}, {"--precision = \"float16\"", "float32"}});
  expectRefused("a.png", {{"--sise=5x5"}, {"--sise", "did you mean \"--size\"?"}});
}

TEST(RenderBadInput, Suffixes) {
  for (const char* name : {"a.foo", "a", "a.png.txt", ".png", "a.PNG"}) {
    expectRefused(name, {{"--duration=0.1"}, {"--out = ", name, "must end in one of .png, .mp4, .webm, .gif, .html"}});
  }
}

TEST(RenderBadInput, Folders) {
  const TemporaryDirectory directory;
  const std::string scene = directory.write("scene.json", smallScene().dump());
  expectRefusal(runWetcloth({"render", scene, "--out", directory.path("none/a.png")}), {"--out", "none", "folder"});
  std::filesystem::create_directory(directory.path("a.png"));
  expectRefusal(runWetcloth({"render", scene, "--out", directory.path("a.png")}), {"--out", "not a folder"});
  EXPECT_TRUE(std::filesystem::is_directory(directory.path("a.png")));
}

#ifndef _WIN32
TEST(RenderBadInput, FolderThatCannotBeWrittenTo) {
  const TemporaryDirectory directory;
  const std::string scene = directory.write("scene.json", smallScene().dump());
  std::filesystem::create_directory(directory.path("closed"));
  std::filesystem::permissions(directory.path("closed"), std::filesystem::perms::owner_read);
  std::string picture = directory.path("closed/a.png");
  if (geteuid() == 0) {  // may write everywhere, but for the kernel's own
    if (!std::filesystem::is_directory("/proc/self")) GTEST_SKIP() << "root may write everywhere";
    picture = "/proc/a.png";
  }
  expectRefusal(runWetcloth({"render", scene, "--out", picture}), {"--out", "written to"});
}
#endif

TEST(RenderBadInput, NoOpenGlAtAll) {
  const std::string missing = whyNothingCanBeDrawn();
  if (!missing.empty()) GTEST_SKIP() << missing;
  const ChangedVariable changed("__EGL_VENDOR_LIBRARY_DIRS", "/nonexistent");
  const TemporaryDirectory directory;
  const std::string scene = directory.write("scene.json", smallScene().dump());
  const Outcome outcome = runWetcloth({"render", scene, "--out", directory.path("a.png")});
  if (outcome.status == 0) GTEST_SKIP() << "this EGL does not choose its driver by __EGL_VENDOR_LIBRARY_DIRS";
  expectRefusal(outcome, {"--out", "EGL", "apt install"});
  EXPECT_EQ(namesIn(directory.path("")), std::vector<std::string>{"scene.json"});
}

TEST(RenderBadInput, SceneThatFailsLeavesNoPicture) {
  const TemporaryDirectory directory;
  expectRefusal(runWetcloth({"render", directory.path("none.json"), "--out", directory.path("a.png")}), {"none.json"});
  EXPECT_TRUE(namesIn(directory.path("")).empty());
}

}  // namespace
}  // namespace wetcloth_test::render_bad_input_test
