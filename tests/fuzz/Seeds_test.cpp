// SPDX-License-Identifier: Zlib
// The inputs that fuzzing begins from, and those that it once found something with: each is taken or refused.

#include "tests/fuzz/Targets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace wetcloth_test::seeds_test {
namespace {

std::vector<std::string> seedsOf(const std::string& target) {
  const auto folder = std::filesystem::path(WETCLOTH_SOURCE_DIR) / "tests/fuzz/seeds" / target;
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

std::string bytesOf(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  return std::string((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
}

void runSeeds(const std::string& target, void (*run)(const std::string&)) {
  const std::vector<std::string> files = seedsOf(target);
  EXPECT_GE(files.size(), 3u);
  for (const std::string& file : files) {
    SCOPED_TRACE(file);
    EXPECT_NO_THROW(run(bytesOf(file)));
  }
}

TEST(FuzzSeeds, OfScenes) { runSeeds("scene", fuzz::scene); }
TEST(FuzzSeeds, OfMeshes) { runSeeds("obj", fuzz::obj); }
TEST(FuzzSeeds, OfCollisionQueries) { runSeeds("ccd", fuzz::ccd); }
TEST(FuzzSeeds, OfMeasurements) { runSeeds("measured", fuzz::measured); }
TEST(FuzzSeeds, OfStates) { runSeeds("state", fuzz::state); }

// The fuzzer gets nowhere from seeds of another format. Renew them when it changes: `stream` is '\1' and what
// SmallWorld::start() gives, `state` is '\0' and the same without the 48 bytes of the envelope, and the other two are
// the first 701 and 3001 bytes of these.
TEST(FuzzSeeds, OfStatesAreOfTodaysFormat) {
  if (wetcloth_test::kIsDouble || btGetVersion() != 324) GTEST_SKIP() << "they are of Bullet 3.24 in float32";
  fuzz::SmallWorld world;
  const std::string folder = std::string(WETCLOTH_SOURCE_DIR) + "/tests/fuzz/seeds/state/";
  EXPECT_NO_THROW(world.restore(bytesOf(folder + "stream").substr(1)));
  EXPECT_NO_THROW(world.restore(world.wrapped(bytesOf(folder + "state").substr(1))));
}

// What the fuzzer begins from is the state as it is saved today; kept seeds are refused when the format has changed.
TEST(FuzzSeeds, OfTheStateAsItIs) {
  fuzz::SmallWorld world;
  const std::string& stream = world.start();
  EXPECT_NO_THROW(fuzz::state('\1' + stream));
  const std::string state = stream.substr(48);  // without the envelope
  for (std::size_t place = 0; place < state.size(); place += 37) {
    for (const char value : {'\0', '\1', '\x7f', '\xff'}) {
      std::string changed = state;
      changed[place] = value;
      EXPECT_NO_THROW(fuzz::state('\0' + changed)) << place;
    }
  }
  for (std::size_t length = 0; length < state.size(); length += 97) {
    EXPECT_NO_THROW(fuzz::state('\0' + state.substr(0, length))) << length;
  }
}

}  // namespace
}  // namespace wetcloth_test::seeds_test
