// SPDX-License-Identifier: Zlib
#include "tests/command/Command.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

// What the window does is in tests/command/viewer.

namespace wetcloth_test::view_test {
namespace {

using namespace cli;

std::string smallSceneIn(const TemporaryDirectory& directory) {
  return directory.write("scene.json", smallScene().dump());
}

TEST(View, HelpEndsWithStatusZero) {
  const Outcome outcome = runWetcloth({"view", "--help"});
  EXPECT_EQ(outcome.status, 0);
  for (const char* option :
       {"--size", "--paused", "--compare", "--quality", "--precision", "--frames", "--screenshot"}) {
    EXPECT_NE(outcome.out.find(option), std::string::npos) << option;
  }
}

TEST(View, RefusesBadInputBeforeAnyWindowOpens) {
  const TemporaryDirectory directory;
  const std::string scene = smallSceneIn(directory);
  const auto refuse = [&](const std::string& option, const std::string& value, const std::string& allowed) {
    expectRefusal(runWetcloth({"view", scene, option, value, "--precision", testedPrecision()}),
                  {option, value, allowed});
  };
  for (const char* size : {"0x0", "1280", "1280x", "x720", "-1280x720", "1280x720x2", "99999x720", "wide"}) {
    refuse("--size", size, "from 320 to 8192");
  }
  for (const char* frames : {"0", "-3", "1000001"}) refuse("--frames", frames, "1 to 1000000");
  refuse("--screenshot", directory.path("picture.jpg"), ".png");
  refuse("--screenshot", ".png", ".png");
  refuse("--screenshot", directory.path("no/such/picture.png"), "picture.png");
  refuse("--quality", "best", "realtime");
  refuse("--precision", "float16", "float32");
  expectRefusal(runWetcloth({"view", directory.path("missing.json")}), {"missing.json", "no such file"});
  expectRefusal(runWetcloth({"view", scene, "--fullscreen"}), {"--fullscreen"});
}

TEST(View, ARefusalLeavesNoFile) {
  const TemporaryDirectory directory;
  const std::string scene = smallSceneIn(directory);
  expectRefusal(runWetcloth({"view", scene, "--screenshot", directory.path("picture.png"), "--size", "1x1", "--json",
                             directory.path("state.json"), "--precision", testedPrecision()}),
                {"--size"});
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(scene).parent_path())) {
    static_cast<void>(entry);
    ++files;
  }
  EXPECT_EQ(files, 1);
}

}  // namespace
}  // namespace wetcloth_test::view_test
