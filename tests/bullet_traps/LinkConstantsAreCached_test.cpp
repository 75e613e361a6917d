// SPDX-License-Identifier: Zlib
// Link::m_c0 caches (inverse mass a + inverse mass b) / stiffness. Left alone when masses grow, it makes every
// correction too small, which looks like a sag under the weight of the water.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Measures.h"
#include "tests/support/Patches.h"
#include "tests/support/UnevenWater.h"

namespace wetcloth_test::link_constants_are_cached_test {

namespace {

constexpr double kTimesAsHeavy = 6;

// Stretch of a hanging strip whose masses are multiplied after it was built.
double stretchWhenHeavy(bool refreshLinks) {
  BodyScene scene(WorldKind::softRigid, hangingPatch(10));
  scene.bullet().step(1);
  for (int i = 0; i < scene.body().m_nodes.size(); ++i) scene.body().m_nodes[i].m_im /= btScalar(kTimesAsHeavy);
  if (refreshLinks) scene.body().updateLinkConstants();
  scene.bullet().step(480);
  return totalLength(scene.body()) / totalRestLength(scene.body()) - 1;
}

// The fact.
TEST(LinkConstantsAreCached, InPlainBulletTheyFakeASag) {
  const double fresh = stretchWhenHeavy(true);
  const double stale = stretchWhenHeavy(false);
  EXPECT_GT(stale, 2 * fresh) << "fresh " << fresh;
}

class LinkConstants {
 protected:
  // What is cached against what Bullet itself would compute from the present masses.
  static void expectFresh(btSoftBody& body) {
    for (int i = 0; i < body.m_links.size(); ++i) {
      const btSoftBody::Link& link = body.m_links[i];
      const btScalar expected = (link.m_n[0]->m_im + link.m_n[1]->m_im) / link.m_material->m_kLST;
      // The same formula: one rounding apart at most.
      ASSERT_NEAR(link.m_c0, expected, 2 * SIMD_EPSILON * expected) << "link " << i;
    }
  }
};

TEST_F_IN_EVERY_WORLD(LinkConstants, FollowAbsorption) {
  wetcloth::ClothPatch patch = hangingPatch(6);
  patch.shearStiffness = 0.5;
  patch.flexionStiffness = 0.1;
  BodyScene scene(GetParam(), patch);
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = wet.add(scene.body());
  cloth.add<wetcloth::Absorption>({[](const btVector3& x, const btVector3&) { return double(x.x()); }});
  for (int step = 0; step < 20; ++step) {
    scene.bullet().step(1);
    expectFresh(scene.body());
  }
  EXPECT_GT(cloth.linkConstants().refreshes(), 0);
}

TEST_F_IN_EVERY_WORLD(LinkConstants, FollowWaterSetByHand) {
  BodyScene scene(GetParam(), hangingPatch(6));
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = wet.add(scene.body());
  scene.bullet().step(1);
  cloth.setHeld(unevenWater(cloth));
  expectFresh(scene.body());
  cloth.setSaturation(0.5);
  expectFresh(scene.body());
}

// The other half of the trap: refreshing costs a pass over all links, so it happens only when a mass changed.
TEST_F_IN_EVERY_WORLD(LinkConstants, AreLeftAloneWhenNoMassChanged) {
  BodyScene scene(GetParam(), hangingPatch(6));
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = wet.add(scene.body());
  cloth.add<wetcloth::Absorption>({0.0});  // exposed nowhere
  cloth.add<wetcloth::Wind>({btVector3(1, 0, 2)});
  const long long before = cloth.linkConstants().refreshes();
  scene.bullet().step(20);
  EXPECT_EQ(cloth.linkConstants().refreshes(), before);
}

}  // namespace
}  // namespace wetcloth_test::link_constants_are_cached_test
