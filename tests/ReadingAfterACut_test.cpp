// SPDX-License-Identifier: Zlib
// An application's loop is: step, change the body, draw. What it reads right after a cut fits the body that it draws.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BodyState.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Materials.h"
#include "tests/support/Patches.h"

#include <gtest/gtest.h>

namespace wetcloth_test::reading_after_a_cut_test {

namespace {

class Plane : public btSoftBody::ImplicitFn {
 public:
  btScalar Eval(const btVector3& x) override { return x.x() - btScalar(0.37); }
};

void refine(btSoftBody& body) {
  Plane plane;
  body.refine(&plane, btScalar(0.001), true);
}

class ReadingAfterACut {
 protected:
  ReadingAfterACut() { wet.setLog({}); }

  BodyScene scene{GetParam(), hangingPatch(6)};
  wetcloth::WetClothWorld wet{scene.world()};
  wetcloth::WetCloth& cloth = wet.add(scene.body(), fabricOf(1, 1));
};

TEST_F_IN_EVERY_WORLD(ReadingAfterACut, IsOfAllNodesAtOnce) {
  cloth.add<wetcloth::Absorption>();
  scene.bullet().step(20);
  const double held = cloth.ledger().held;
  refine(scene.body());
  const int last = scene.body().m_nodes.size() - 1;
  ASSERT_GT(last, 35);
  EXPECT_NO_THROW(cloth.saturation(last));
  EXPECT_EQ(cloth.nodeCount(), last + 1);
  double sum = 0;
  for (int i = 0; i <= last; ++i) {
    sum += cloth.held(i);
    EXPECT_NO_THROW(cloth.colour(i));
    EXPECT_LE(cloth.saturation(i), 1 + 1e-5);
  }
  EXPECT_NEAR(sum, held, 1e-12 * held);
  scene.bullet().step(5);
  EXPECT_TRUE(isFinite(scene.body()));
}

TEST_F_IN_EVERY_WORLD(ReadingAfterACut, FillsAVertexBuffer) {
  cloth.setSaturation(0.5);
  refine(scene.body());
  std::vector<float> vertices(10 * std::size_t(cloth.nodeCount()));
  EXPECT_NO_THROW(
      wetcloth::fillVertexBuffer(cloth, {vertices.data(), cloth.nodeCount(), {0, 10}, {3, 10}, {6, 10}, {9, 10}}));
  EXPECT_EQ(vertices.size(), 10 * std::size_t(scene.body().m_nodes.size()));
}

TEST_F_IN_EVERY_WORLD(ReadingAfterACut, WorksOnAClothWithoutEffects) {
  refine(scene.body());
  scene.bullet().step(3);
  EXPECT_EQ(cloth.nodeCount(), scene.body().m_nodes.size());
  EXPECT_EQ(cloth.held(cloth.nodeCount() - 1), 0);
}

// Nothing is written into a cloth that is dry and has no effects, cut or not.
TEST_F_IN_EVERY_WORLD(ReadingAfterACut, LeavesADryClothWithoutEffectsAlone) {
  BodyScene plain(GetParam(), hangingPatch(6));
  plain.bullet().step(3);
  scene.bullet().step(3);
  refine(plain.body());
  refine(scene.body());
  EXPECT_EQ(cloth.nodeCount(), plain.body().m_nodes.size());
  plain.bullet().step(20);
  scene.bullet().step(20);
  EXPECT_TRUE(sameBits(stateOf(plain.body()), stateOf(scene.body())));
}

// The messages of the log may read, too.
TEST_F_IN_EVERY_WORLD(ReadingAfterACut, MayBeDoneInTheLog) {
  int nodes = 0;
  wet.setLog([&](const std::string&) { nodes = cloth.nodeCount(); });
  refine(scene.body());
  scene.bullet().step(1);
  EXPECT_EQ(nodes, scene.body().m_nodes.size());
}

// Of a body that is gone, what was known last is still there to read.
TEST_F_IN_EVERY_WORLD(ReadingAfterACut, DoesNotLookAtABodyThatIsGone) {
  cloth.setSaturation(0.5);
  scene.deleteBody();
  EXPECT_EQ(cloth.nodeCount(), 36);
  EXPECT_NEAR(cloth.saturation(7), 0.5, 1e-12);
}

}  // namespace
}  // namespace wetcloth_test::reading_after_a_cut_test
