// SPDX-License-Identifier: Zlib
// Seepage: the momentum it carries in every world, what it refuses, how much work it does.

#include "tests/support/BulletWorld.h"
#include "tests/support/ClothScene.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Measures.h"
#include "tests/support/Patches.h"
#include "tests/support/Rejection.h"
#include "tests/support/SoftBodies.h"
#include "tests/support/TransportScene.h"

#include <limits>

namespace wetcloth_test::seepage_upkeep_test {

using namespace transport;

namespace {

using wetcloth::Seepage;

const btVector3 kDown(0, btScalar(-9.81), 0);

TEST_IN_EVERY_WORLD(SeepageMomentum, IsKept) {
  wetcloth::ClothPatch patch = levelPatch(6, 0.1);
  patch.edgeV = btVector3(0, btScalar(0.1), 0);
  ClothScene scene(GetParam(), kDown, patch, wetcloth::Fabric::highAbsorption(), wetcloth::Hook::manual);
  scene.cloth().setSaturation(0.6);
  for (int i = 0; i < 36; ++i) {
    scene.node(i).m_v = scene.node(i).m_vn = btVector3(btScalar(std::sin(i)), btScalar(i % 5), btScalar(2 - i % 4));
  }
  const auto before = momentum(scene.body());
  scene.cloth().add<Seepage>({1e-3, 3});
  for (int n = 0; n < 10; ++n) scene.preTick(10);
  EXPECT_LT(scene.cloth().saturation(35), 0.5);
  const auto after = momentum(scene.body());
  // 36 velocities of up to 4 m/s, rounded ten times.
  const double tolerance = (kIsDouble ? 1e-14 : 1e-6) * 4 * freeMass(scene.body());
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(after[k], before[k], tolerance);
}

// The whole step, Bullet's part included, on a cloth that hangs from its upper edge.
TEST_IN_EVERY_WORLD(SeepageMomentum, AHangingClothDrainsDownwards) {
  wetcloth::ClothPatch patch = levelPatch(8, 0.2);
  patch.edgeV = btVector3(0, btScalar(0.2), 0);
  patch.pinnedEdges = {wetcloth::ClothPatch::Edge::top};
  ClothScene scene(GetParam(), kDown, patch);
  scene.addBulletSpringsForStep();
  scene.cloth().setSaturation(0.6);
  scene.cloth().add<Seepage>({0.05, 1});
  const double before = scene.cloth().ledger().held;
  scene.step(480);
  EXPECT_LT(scene.cloth().saturation(60), 0.1);
  EXPECT_GT(scene.cloth().saturation(4), 0.9);
  EXPECT_NEAR(scene.cloth().ledger().held, before, 1e-13 * before);
}

TEST(SeepageUpkeep, RefusesBadParametersByName) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  TransportScene scene(grid(3, 3, 1, 1));
  for (const double bad : {-1e-3, nan, inf}) {
    const std::string text = rejection([&] { scene.cloth().add<Seepage>({bad, 3}); });
    EXPECT_EQ(text.rfind("Seepage.speed = ", 0), 0u) << text;
  }
  for (const double bad : {0.0, 0.99, -3.0, 101.0, nan, inf}) {
    const std::string text = rejection([&] { scene.cloth().add<Seepage>({1e-3, bad}); });
    EXPECT_EQ(text.rfind("Seepage.exponent = ", 0), 0u) << text;
  }
  EXPECT_TRUE(scene.cloth().effects().empty());
  ClothScene rope(WorldKind::softRigid, btVector3(0, 0, 0), hangingRope(5, 0.1, 0.01));
  EXPECT_EQ(rejection([&] { rope.cloth().add<Seepage>(); }),
            "Seepage: body.m_faces.size() = 0: must be at least 1: it works on triangles, and a rope has none");
}

TEST(SeepageUpkeep, IdlesWhenDrainedAndGoesOnWhenTheClothTurns) {
  TransportScene scene(grid(4, 6, 0.1, 0.1), kDown);
  scene.wet([](double, double) { return 0.5; });
  Seepage& seepage = scene.cloth().add<Seepage>({0.1, 1});
  scene.run(2000, 0.05);
  const long long visited = seepage.nodesVisited();
  EXPECT_LT(visited, 2000 * 24);
  scene.run(50, 0.05);
  EXPECT_EQ(seepage.nodesVisited(), visited);
  for (int i = 0; i < scene.count(); ++i) scene.node(i).m_x.setY(-scene.node(i).m_x.y());
  // A 32nd of the nodes is looked at in each step.
  scene.run(40, 0.05);
  EXPECT_GT(seepage.nodesVisited(), visited);
}

TEST(SeepageUpkeep, MakesAsManySubstepsAsItsFastestWaveAsksFor) {
  TransportScene scene(grid(3, 11, 0.1, 1), kDown);
  scene.wet([](double, double) { return 0.5; });
  // n v dt / h = 3 x 0.1 x 1 / 0.1, and 1.5 times that in the corner of one triangle: h^2 / 6, with half a width.
  Seepage& seepage = scene.cloth().add<Seepage>({0.1, 3});
  scene.preTick(1);
  EXPECT_GE(seepage.substeps(), 3);
  EXPECT_LE(seepage.substeps(), 10);
  scene.preTick(1e6);
  EXPECT_LE(seepage.substeps(), 74) << "64 at most";
}

}  // namespace
}  // namespace wetcloth_test::seepage_upkeep_test
