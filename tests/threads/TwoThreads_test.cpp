// SPDX-License-Identifier: Zlib
#include "tests/support/TwoThreads.h"
#include "tests/solver/SolverScene.h"
#include "tests/support/BodyState.h"

#include <gtest/gtest.h>

namespace wetcloth_test::two_threads_test {
namespace {

// Large enough for several tiles, and for several stretches of nodes and faces.
std::vector<btScalar> stateAfterSteps(btITaskScheduler* scheduler) {
  btSetTaskScheduler(scheduler);
  SolverScene scene;
  wetcloth::ClothPatch patch = hangingPatch(150);
  btSoftBody& body = scene.add(patch);
  scene.step(4);
  btSetTaskScheduler(nullptr);
  return stateOf(body);
}

TEST(TwoThreads, GiveTheSameBits) {
  TwoThreads scheduler;
  const std::vector<btScalar> byTwo = stateAfterSteps(&scheduler);
  EXPECT_GT(scheduler.calls(), 0);
  EXPECT_TRUE(sameBits(byTwo, stateAfterSteps(nullptr)));
}

TEST(TwoThreads, AreNotAskedForASmallCloth) {
  TwoThreads scheduler;
  btSetTaskScheduler(&scheduler);
  SolverScene scene;
  scene.add(hangingPatch(64));
  scene.step(2);
  btSetTaskScheduler(nullptr);
  EXPECT_EQ(scheduler.calls(), 0);
}

}  // namespace
}  // namespace wetcloth_test::two_threads_test
