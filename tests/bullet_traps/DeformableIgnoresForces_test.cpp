// SPDX-License-Identifier: Zlib
// The deformable world never reads Node::m_f, so a force that is only added there moves a cloth in two of Bullet's
// worlds and does nothing in the third.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/CallEffect.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Measures.h"
#include "tests/support/Patches.h"

namespace wetcloth_test::deformable_ignores_forces_test {

namespace {

void pushWithForces(btDynamicsWorld* world, btScalar) {
  btSoftBody& body = *static_cast<btSoftBody*>(world->getWorldUserInfo());
  for (int i = 0; i < body.m_nodes.size(); ++i) body.addForce(btVector3(0, 0, 1) / body.m_nodes[i].m_im, i);
}

// The fact: 1 m/s^2 for half a second.
TEST_IN_EVERY_WORLD(DeformableIgnoresForces, InPlainBullet) {
  BodyScene scene(GetParam(), sailPatch(4), kNoGravity);
  scene.world().setInternalTickCallback(pushWithForces, &scene.body(), true);
  scene.bullet().step(120);
  const double expected = scene.bullet().isDeformable() ? 0 : 0.5;
  EXPECT_NEAR(meanVelocity(scene.body()).z(), expected, 1e-3);  // Euler's first order and rounding
}

TEST_IN_EVERY_WORLD(DeformableIgnoresForces, OurPushMovesTheClothInEveryWorld) {
  BodyScene scene(GetParam(), sailPatch(4), kNoGravity);
  wetcloth::WetClothWorld wet(scene.world());
  addCall(wet.add(scene.body()), [](wetcloth::WetCloth& cloth, const wetcloth::Step& step) {
    for (int i = 0; i < cloth.nodeCount(); ++i) {
      cloth.push(cloth.body().m_nodes[i], btVector3(0, 0, btScalar(step.dt)));
    }
  });
  scene.bullet().step(120);
  EXPECT_NEAR(meanVelocity(scene.body()).z(), 0.5, 1e-3);
  // x = a t^2 / 2 and up to one step's worth more or less.
  EXPECT_NEAR(meanPosition(scene.body()).z(), 0.125, 0.5 / 240);
}

TEST_IN_EVERY_WORLD(DeformableIgnoresForces, OurWindMovesTheClothInEveryWorld) {
  BodyScene scene(GetParam(), sailPatch(4), kNoGravity);
  wetcloth::WetClothWorld wet(scene.world());
  wet.add(scene.body()).add<wetcloth::Wind>({btVector3(0, 0, 4)});
  scene.bullet().step(120);
  // A free sheet of 0.15 kg/m^2: dv/dt = k (4 - v)^2 with k = 1.2 * 1.2 / 2 / 0.15, so after 0.5 s
  // 4 - v = 4 / (1 + 4 k t); a first-order step is within a few per cent of it.
  const double k = 0.5 * 1.2 * 1.2 / 0.15;
  const double expected = 4 - 4 / (1 + 4 * k * 0.5);
  EXPECT_NEAR(meanVelocity(scene.body()).z(), expected, 0.03 * expected);
  EXPECT_GT(meanPosition(scene.body()).z(), 1);
}

}  // namespace
}  // namespace wetcloth_test::deformable_ignores_forces_test
