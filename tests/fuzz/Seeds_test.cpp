// SPDX-License-Identifier: Zlib
// The inputs that fuzzing begins from, and those that it once found something with: each is taken or refused.

#include "tests/fuzz/Targets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <tuple>
#include <vector>

namespace wetcloth_test::seeds_test {
namespace {

using MovedBy = fuzz::SmallWorld::MovedBy;

std::string withoutEnvelope(const std::string& stream) { return stream.substr(48); }

void store(const std::string& file, const std::string& bytes) { std::ofstream(file, std::ios::binary) << bytes; }

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
TEST(FuzzSeeds, OfMotions) { runSeeds("motion", fuzz::motion); }
TEST(FuzzSeeds, OfCheckpoints) { runSeeds("checkpoint", fuzz::checkpoint); }
TEST(FuzzSeeds, OfStates) { runSeeds("state", fuzz::state); }

// The fuzzer gets nowhere from seeds of another format. Renew them when it changes, with WETCLOTH_STORE_SEEDS=1 in the
// environment.
TEST(FuzzSeeds, OfStatesAreOfTodaysFormat) {
  if (wetcloth_test::kIsDouble || btGetVersion() != 324) GTEST_SKIP() << "they are of Bullet 3.24 in float32";
  const std::string folder = std::string(WETCLOTH_SOURCE_DIR) + "/tests/fuzz/seeds/state/";
  for (const auto& [name, mover, solverBit] :
       {std::tuple("", MovedBy::bullet, 0), std::tuple("guarded_", MovedBy::guardedSolver, 2)}) {
    fuzz::SmallWorld world(mover);
    if (std::getenv("WETCLOTH_STORE_SEEDS") != nullptr) {
      const std::string stream = char(1 + solverBit) + world.start();
      const std::string state = char(solverBit) + withoutEnvelope(world.start());
      store(folder + name + "stream", stream);
      store(folder + name + "state", state);
      store(folder + name + "cut_stream", stream.substr(0, stream.size() / 4));
      store(folder + name + "cut_state", state.substr(0, 2 * state.size() / 3));
    }
    EXPECT_NO_THROW(world.restore(bytesOf(folder + name + "stream").substr(1)));
    EXPECT_NO_THROW(world.restore(world.wrapped(bytesOf(folder + name + "state").substr(1))));
  }
}

// What the fuzzer begins from is the state as it is saved today; kept seeds are refused when the format has changed.
TEST(FuzzSeeds, OfTheStateAsItIs) {
  // A guarded world takes longer to be restored.
  for (const auto& [mover, solverBit, stride] :
       {std::tuple(MovedBy::bullet, 0, 37), std::tuple(MovedBy::guardedSolver, 2, 211)}) {
    const std::string stream = fuzz::SmallWorld(mover).start();
    EXPECT_NO_THROW(fuzz::state(char(1 + solverBit) + stream));
    const std::string state = withoutEnvelope(stream);
    for (std::size_t place = 0; place < state.size(); place += std::size_t(stride)) {
      for (const char value : {'\0', '\1', '\x7f', '\xff'}) {
        std::string changed = state;
        changed[place] = value;
        EXPECT_NO_THROW(fuzz::state(char(solverBit) + changed)) << place;
      }
    }
    for (std::size_t length = 0; length < state.size(); length += 3 * std::size_t(stride)) {
      EXPECT_NO_THROW(fuzz::state(char(solverBit) + state.substr(0, length))) << length;
    }
  }
}

}  // namespace
}  // namespace wetcloth_test::seeds_test
