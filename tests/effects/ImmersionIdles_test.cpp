// SPDX-License-Identifier: Zlib
// When an immersed cloth costs nothing, and that it begins to soak in the very step in which it gets wet.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "bullet_wetcloth/effects/Immersion.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/ExactPace.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Materials.h"
#include "tests/support/Patches.h"

namespace wetcloth_test::immersion_idles_test {

namespace {

using wetcloth::Immersion;
using wetcloth::WaterSurface;

WaterSurface levelAt(double level) {
  WaterSurface surface;
  surface.offset = -level;
  return surface;
}

bool isAnyBelow(const btSoftBody& body, double level) {
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    if (double(body.m_nodes[i].m_x.y()) < level) return true;
  }
  return false;
}

struct Pool {
  Pool(WorldKind kind, const wetcloth::ClothPatch& patch, double level, const btVector3& gravity = kEarthGravity)
      : scene(kind, patch, gravity), wet(scene.world()), cloth(exactly(wet.add(scene.body(), fabricOf(1, 0.01)))) {
    scene.body().setActivationState(DISABLE_DEACTIVATION);
    scene.addBulletSprings(20, 0.1, SpringDamping::everyDirection);
    effect = &cloth.add<Immersion>({levelAt(level)});
  }
  BodyScene scene;
  wetcloth::WetClothWorld wet;
  wetcloth::WetCloth& cloth;
  Immersion* effect = nullptr;
};

// From rest right above, where the step's own motion is larger than the way; from above, after it has settled; and
// from high up, where a step is a large part of the way.
TEST_IN_EVERY_WORLD(ImmersionInWorld, AFallingClothSoaksInTheVeryStepThatItsFirstNodeIsBelow) {
  for (const double height : {0.002, 0.1, 5.0}) {
    Pool pool(GetParam(), hangingPatch(4), -height, btVector3(0, 0, 0));
    pool.scene.bullet().step(100);
    const long long settled = pool.effect->nodesVisited();
    pool.scene.bullet().step(10);
    EXPECT_EQ(pool.effect->nodesVisited(), settled) << "at rest above, " << height;
    for (int i = 12; i < 16; ++i) pool.scene.body().m_nodes[i].m_im = pool.scene.body().m_nodes[0].m_im;  // let go
    for (int i = 0; i < 16; ++i) {
      pool.scene.body().m_nodes[i].m_v = pool.scene.body().m_nodes[i].m_vn = btVector3(0, -2, 0);
    }
    bool wasBelow = false;
    for (int step = 0; step < 1000 && !wasBelow; ++step) {
      wasBelow = isAnyBelow(pool.scene.body(), -height);  // as the step begins, which is when water arrives
      pool.scene.bullet().step(1);
      EXPECT_EQ(pool.cloth.ledger().held > 0, wasBelow) << height << " m, step " << step;
    }
    EXPECT_TRUE(wasBelow) << height;
  }
}

// One corner alone is drawn down within five steps, as if by hand, while all else rests: SteadyState, which looks at a
// 32nd of the nodes in a step, would see most of these too late.
TEST_IN_EVERY_WORLD(ImmersionInWorld, OneNodeThatIsDrawnUnderIsNoticed) {
  for (const int phase : {0, 7, 14, 21, 28}) {
    Pool pool(GetParam(), hangingPatch(8), -0.05, btVector3(0, 0, 0));
    pool.scene.bullet().step(100 + phase);
    ASSERT_EQ(pool.cloth.ledger().held, 0);
    btSoftBody::Node& corner = pool.scene.body().m_nodes[0];
    corner.m_im = 0;
    bool wasBelow = false;
    for (int step = 0; step < 10 && !wasBelow; ++step) {
      corner.m_x.setY(corner.m_x.y() - btScalar(0.0125));
      wasBelow = isAnyBelow(pool.scene.body(), -0.05);
      pool.scene.bullet().step(1);
      EXPECT_EQ(pool.cloth.saturation(0) > 0, wasBelow) << "phase " << phase << ", step " << step;
    }
    EXPECT_TRUE(wasBelow);
  }
}

TEST_IN_EVERY_WORLD(ImmersionInWorld, SoaksWhatHangsInTheWaterAndThenIdles) {
  Pool pool(GetParam(), hangingPatch(5), 0.4, btVector3(0, 0, 0));
  pool.scene.bullet().step(240);                                                          // 100 time constants
  for (int i = 0; i < 25; ++i) EXPECT_EQ(pool.cloth.saturation(i), i < 10 ? 1 : 0) << i;  // rows at 0 and 0.25
  const long long visited = pool.effect->nodesVisited();
  const long long commits = pool.cloth.masses().commits();
  pool.scene.bullet().step(50);
  EXPECT_EQ(pool.effect->nodesVisited(), visited);
  EXPECT_EQ(pool.cloth.masses().commits(), commits);

  pool.cloth.setSaturation(0.5);
  pool.scene.bullet().step(240);
  EXPECT_EQ(pool.cloth.saturation(3), 1) << "water set by hand";
  EXPECT_EQ(pool.cloth.saturation(20), 0.5);
}

TEST_IN_EVERY_WORLD(ImmersionInWorld, AClothThatIsFullCostsNothingThoughItMoves) {
  Pool pool(GetParam(), squarePatch(4), 10);
  pool.cloth.setSaturation(1);
  pool.scene.bullet().step(1);
  const long long visited = pool.effect->nodesVisited();
  pool.scene.bullet().step(50);  // it falls
  EXPECT_EQ(pool.effect->nodesVisited(), visited);
}

TEST_IN_EVERY_WORLD(ImmersionInWorld, AClothThatIsLiftedOutTakesNoMore) {
  Pool pool(GetParam(), hangingPatch(4), 2, btVector3(0, 0, 0));
  pool.scene.bullet().step(1);
  const double held = pool.cloth.ledger().held;
  ASSERT_GT(held, 0);
  for (int i = 0; i < 16; ++i) pool.scene.body().m_nodes[i].m_x += btVector3(0, 5, 0);
  pool.scene.bullet().step(100);
  EXPECT_EQ(pool.cloth.ledger().held, held);
}

TEST_IN_EVERY_WORLD(ImmersionInWorld, APinnedNodeSoaksAndStaysPinned) {
  Pool pool(GetParam(), hangingPatch(4), 2);
  pool.scene.bullet().step(240);
  EXPECT_EQ(pool.cloth.saturation(15), 1);
  EXPECT_EQ(pool.scene.body().m_nodes[15].m_im, 0);
  EXPECT_EQ(pool.scene.body().m_nodes[15].m_x.y(), 1);
}

TEST_IN_EVERY_WORLD(ImmersionInWorld, GoesOnWhenTheBodyIsCutEvenIfThereIsNoWaterAtThatMoment) {
  BodyScene scene(GetParam(), hangingPatch(5));
  scene.bullet().info().water_normal = btVector3(0, 1, 0);
  scene.bullet().info().water_offset = -2;
  wetcloth::WetClothWorld wet(scene.world());
  wet.setLog([](const std::string&) {});
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body(), fabricOf(1, 0.5)));
  cloth.add<Immersion>();
  scene.bullet().step(10);
  const double held = cloth.ledger().held;
  scene.bullet().info().water_normal = btVector3(0, 0, 0);
  ASSERT_TRUE(scene.body().cutLink(scene.body().m_faces[0].m_n[0], scene.body().m_faces[0].m_n[1], btScalar(0.5)));
  scene.bullet().step(1);
  EXPECT_NEAR(cloth.ledger().held, held, 1e-12 * held);
  scene.bullet().info().water_normal = btVector3(0, 1, 0);
  scene.bullet().step(10);
  ASSERT_EQ(cloth.nodeCount(), 27);
  for (int i = 0; i < 27; ++i) EXPECT_GT(cloth.saturation(i), 0.01) << i;
  EXPECT_LE(std::fabs(cloth.ledger().imbalance()), 1e-12 * held);
}

}  // namespace
}  // namespace wetcloth_test::immersion_idles_test
