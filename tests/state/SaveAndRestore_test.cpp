// SPDX-License-Identifier: Zlib
// A run that is saved at any step and restored into a world that was built anew goes on bit for bit as the run that
// nobody touched.

#include "tests/state/FurnishedScene.h"
#include "tests/state/StateScene.h"
#include "tests/support/InEveryWorld.h"

#include <gtest/gtest.h>

#include <utility>

namespace wetcloth_test::save_and_restore_test {
namespace {

using state_scene::Case;
using state_scene::sameNumbers;
using state_scene::StateScene;
using state_scene::Story;

constexpr int kStepsAfter = 50;

using SaveAndRestore = testing::TestWithParam<Case>;

// Two cloths in the deformable world: Bullet shuffles their contacts by random numbers that go on from world to world
// within a process, so no two runs of that are alike, saved or not (docs/bullet_notes.md).
std::vector<Case> reproducibleCases() {
  std::vector<Case> cases;
  for (const Story story : {Story::hanging, Story::onRigid, Story::onPile, Story::clothOnCloth}) {
    for (const WorldKind kind :
         {WorldKind::softRigid, WorldKind::softMultiBody, WorldKind::deformable, WorldKind::deformableImplicit}) {
      const bool isDeformable = kind == WorldKind::deformable || kind == WorldKind::deformableImplicit;
      if (!(isDeformable && story == Story::clothOnCloth)) cases.push_back({kind, story});
    }
  }
  for (const WorldKind kind : {WorldKind::deformable, WorldKind::deformableImplicit}) {
    cases.push_back({kind, Story::sleeping});
  }
  return cases;
}

std::string nameOfCase(const testing::TestParamInfo<Case>& test) {
  std::ostringstream name;
  name << test.param.story << "_" << test.param.kind;
  return name.str();
}

INSTANTIATE_TEST_SUITE_P(, SaveAndRestore, testing::ValuesIn(reproducibleCases()), nameOfCase);

// Of the sleeper: before and after it falls asleep.
std::vector<int> savedSteps(const Case& what) {
  if (what.story == Story::sleeping) return {1, 150, 240, 300};
  return {0, 1, 6, 25, 60, 120};
}

TEST_P(SaveAndRestore, GoesOnBitForBit) {
  StateScene early(GetParam());
  StateScene whole(GetParam());
  int earlySteps = 0;
  int wholeSteps = 0;
  for (const int saveAt : savedSteps(GetParam())) {
    early.step(saveAt - std::exchange(earlySteps, saveAt));
    const std::string state = early.saved();

    StateScene late(GetParam());
    late.restore(state);
    EXPECT_TRUE(sameNumbers(late.look(), early.look())) << "saved after step " << saveAt;
    late.step(kStepsAfter);
    whole.step(saveAt + kStepsAfter - std::exchange(wholeSteps, saveAt + kStepsAfter));
    EXPECT_TRUE(sameNumbers(late.look(), whole.look())) << "saved after step " << saveAt;
  }
  early.step(kStepsAfter);  // saving has not touched it
  EXPECT_TRUE(sameNumbers(early.look(), whole.look()));
}

TEST_P(SaveAndRestore, OfARestoredWorldSavesTheSameBytes) {
  StateScene early(GetParam());
  early.step(40);
  const std::string state = early.saved();
  StateScene late(GetParam());
  late.restore(state);
  EXPECT_EQ(late.saved(), state);
}

TEST(SaveAndRestoreASleeper, WhichSleepsWhenItIsSaved) {
  StateScene early({WorldKind::deformable, Story::sleeping});
  early.step(240);
  EXPECT_FALSE(early.cloth().body().isActive());
  StateScene late({WorldKind::deformable, Story::sleeping});
  late.restore(early.saved());
  EXPECT_FALSE(late.cloth().body().isActive());
}

TEST_IN_EVERY_WORLD(SaveAndRestoreACloth, WithAllThatABodyMayHave) {
  for (const int saveAt : {0, 1, 20}) {
    state_scene::FurnishedScene early(GetParam());
    early.step(saveAt);
    state_scene::FurnishedScene late(GetParam());
    late.restore(early.saved());
    early.step(kStepsAfter);
    late.step(kStepsAfter);
    EXPECT_TRUE(sameBits(late.look(), early.look())) << "saved after step " << saveAt;
  }
}

// Bullet turns its trees of boxes about by their nodes' addresses, so that two worlds of the same numbers find contacts
// in different orders sooner or later: the whole state says so before a position does.
TEST(SaveAndRestoreTrees, StayTheSameToo) {
  for (const Story story : {Story::onRigid, Story::clothOnCloth}) {
    StateScene early({WorldKind::softRigid, story});
    early.step(20);
    StateScene late({WorldKind::softRigid, story});
    late.restore(early.saved());
    early.step(kStepsAfter);
    late.step(kStepsAfter);
    EXPECT_TRUE(late.saved() == early.saved()) << story;
  }
}

// Going back to an earlier state of the same world.
TEST_P(SaveAndRestore, TurnsBackTime) {
  StateScene scene(GetParam());
  scene.step(30);
  const std::string state = scene.saved();
  scene.step(kStepsAfter);
  const std::vector<double> end = scene.look();
  scene.restore(state);
  scene.step(kStepsAfter);
  EXPECT_TRUE(sameNumbers(scene.look(), end));
}

}  // namespace
}  // namespace wetcloth_test::save_and_restore_test
