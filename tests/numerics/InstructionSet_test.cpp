// SPDX-License-Identifier: Zlib
// Which instructions a processor has changes how fast a cloth steps, and not one bit of where it goes.

#include "bullet_wetcloth/numerics/InstructionSet.h"

#include "tests/support/ClothScene.h"
#include "tests/support/Patches.h"

#include <gtest/gtest.h>

#include <vector>

namespace wetcloth_test::instruction_set_test {
namespace {

using wetcloth::InstructionSet;

std::vector<btVector3> flown(InstructionSet set, bool isFunction) {
  wetcloth::forceInstructionSet(set);
  ClothScene scene(WorldKind::softRigid, btVector3(0, -10, 0), hangingPatch(13));
  wetcloth::Wind::Parameters wind;
  wind.velocity = btVector3(3, 1, 2);
  if (isFunction) {
    wind.velocity = [](const btVector3& x, double time) { return btVector3(3 + x.y(), btScalar(time), 2 * x.x()); };
  }
  scene.cloth().add<wetcloth::Wind>(wind);
  scene.step(50);
  wetcloth::forceInstructionSet(InstructionSet::avx2);
  std::vector<btVector3> state;
  for (int i = 0; i < scene.body().m_nodes.size(); ++i) {
    state.push_back(scene.body().m_nodes[i].m_x);
    state.push_back(scene.body().m_nodes[i].m_v);
  }
  return state;
}

TEST(InstructionSet, ChangesNoBitOfACloth) {
  for (const bool isFunction : {false, true}) {
    EXPECT_EQ(flown(InstructionSet::baseline, isFunction), flown(InstructionSet::avx2, isFunction)) << isFunction;
  }
}

TEST(InstructionSet, CanBeForcedAndIsNeverOneThatTheProcessorLacks) {
  const InstructionSet best = wetcloth::instructionSet();
  wetcloth::forceInstructionSet(InstructionSet::baseline);
  EXPECT_EQ(wetcloth::instructionSet(), InstructionSet::baseline);
  wetcloth::forceInstructionSet(InstructionSet::avx2);
  EXPECT_EQ(wetcloth::instructionSet(), best);
}

}  // namespace
}  // namespace wetcloth_test::instruction_set_test
