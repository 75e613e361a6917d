// SPDX-License-Identifier: Zlib
// Different worlds may run in different threads at once: each comes to what it comes to alone, and ThreadSanitizer
// (./dev tsan) finds nothing that two of them share.

#include "tests/state/StateScene.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace wetcloth_test::worlds_at_once_test {
namespace {

using namespace state_scene;

// Two of each, so that equal worlds meet in the same places of the code. Not two cloths in the deformable world: no two
// runs of that are alike (docs/bullet_notes.md).
std::vector<Case> cases() {
  std::vector<Case> all;
  for (const Story story : {Story::hanging, Story::onRigid}) {
    for (const WorldKind kind :
         {WorldKind::softRigid, WorldKind::softMultiBody, WorldKind::deformable, WorldKind::deformableImplicit}) {
      all.insert(all.end(), 2, {kind, story});
    }
  }
  all.push_back({WorldKind::softRigid, Story::clothOnCloth});
  return all;
}

// Made, run, saved, restored and destroyed: all that a thread may do with a world of its own.
std::vector<double> run(const Case& what) {
  StateScene scene(what);
  scene.step(15);
  const std::string state = scene.saved();
  scene.step(15);
  scene.restore(state);
  scene.step(30);
  return scene.look();
}

TEST(WorldsAtOnce, ComeToWhatTheyComeToAlone) {
  const std::vector<Case> all = cases();
  std::vector<std::vector<double>> alone(all.size());
  std::vector<std::vector<double>> together(all.size());
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < all.size(); ++i) {
    threads.emplace_back([&, i] { together[i] = run(all[i]); });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < all.size(); ++i) {
    alone[i] = run(all[i]);
    EXPECT_TRUE(sameNumbers(alone[i], together[i])) << all[i].kind << ", " << all[i].story;
  }
}

}  // namespace
}  // namespace wetcloth_test::worlds_at_once_test
