// SPDX-License-Identifier: Zlib
// A cloth that asks for nothing costs nothing and changes nothing: with no effects, the step's result is Bullet's own,
// bit for bit.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Patches.h"
#include "tests/support/RigidBody.h"

#include <algorithm>

namespace wetcloth_test::no_effects_no_change_test {

namespace {

constexpr int kSteps = 300;

enum class Use { plainBullet, clothWithoutEffects, worldWithoutCloths, attachedAndDetached, manual };

// A cloth that falls on a static sphere, slides off and lands on a box.
std::vector<btScalar> run(WorldKind kind, Use use) {
  wetcloth::ClothPatch patch = squarePatch(12);
  patch.origin = btVector3(0, btScalar(0.3), 0);
  BodyScene scene(kind, patch);
  // Bullet takes one kind or the other: with both set, nothing collides at all.
  scene.body().m_cfg.collisions = scene.bullet().isDeformable()
                                      ? btSoftBody::fCollision::SDF_RD | btSoftBody::fCollision::SDF_RDN
                                      : btSoftBody::fCollision::SDF_RS;
  scene.body().m_cfg.piterations = 3;
  scene.body().m_cfg.kDF = btScalar(0.4);
  scene.body().getCollisionShape()->setMargin(btScalar(0.02));
  scene.addBulletSprings(30, 0.1, SpringDamping::everyDirection);
  RigidBody sphere(scene.bullet(), std::make_unique<btSphereShape>(btScalar(0.25)), 0,
                   btVector3(btScalar(0.55), 0, btScalar(0.5)));
  RigidBody floor(scene.bullet(), std::make_unique<btBoxShape>(btVector3(5, btScalar(0.5), 5)), 0,
                  btVector3(0, btScalar(-1), 0));

  std::unique_ptr<wetcloth::WetClothWorld> wet;
  if (use == Use::manual) wet = std::make_unique<wetcloth::WetClothWorld>(scene.world(), wetcloth::Hook::manual);
  if (use != Use::plainBullet && use != Use::manual) wet = std::make_unique<wetcloth::WetClothWorld>(scene.world());
  if (use == Use::clothWithoutEffects || use == Use::attachedAndDetached || use == Use::manual) wet->add(scene.body());
  for (int step = 0; step < kSteps; ++step) {
    if (use == Use::attachedAndDetached && step == kSteps / 2) wet.reset();
    if (use == Use::manual) wet->preTick(btScalar(1) / 240);
    scene.bullet().step(1);
  }
  return stateOf(scene.body());
}

TEST_IN_EVERY_WORLD(NoEffectsNoChange, BitForBit) {
  const std::vector<btScalar> expected = run(GetParam(), Use::plainBullet);
  EXPECT_TRUE(sameBits(run(GetParam(), Use::clothWithoutEffects), expected));
  EXPECT_TRUE(sameBits(run(GetParam(), Use::worldWithoutCloths), expected));
  EXPECT_TRUE(sameBits(run(GetParam(), Use::attachedAndDetached), expected));
  EXPECT_TRUE(sameBits(run(GetParam(), Use::manual), expected));
}

// The scene is worth comparing: the cloth has met something on its way down.
TEST_IN_EVERY_WORLD(NoEffectsNoChange, InASceneWithCollisions) {
  const std::vector<btScalar> state = run(GetParam(), Use::plainBullet);
  double lowest = HUGE_VAL;
  for (std::size_t i = 2; i < state.size(); i += 6) lowest = std::min(lowest, double(state[i]));
  EXPECT_GT(lowest, -2) << "free fall for 1.25 s would be 7.7 m";
}

// Nothing on the body itself is changed by coming and going, its masses included.
TEST_IN_EVERY_WORLD(NoEffectsNoChange, OnTheBodyItself) {
  BodyScene scene(GetParam(), hangingPatch(5));
  scene.bullet().step(5);
  const int links = scene.body().m_links.size();
  const int materials = scene.body().m_materials.size();
  std::vector<btScalar> masses;
  for (int i = 0; i < scene.body().m_nodes.size(); ++i) masses.push_back(scene.body().m_nodes[i].m_im);
  {
    wetcloth::WetClothWorld wet(scene.world());
    wet.add(scene.body());
    scene.bullet().step(5);
    wet.remove(scene.body());
  }
  for (int i = 0; i < scene.body().m_nodes.size(); ++i) {
    EXPECT_EQ(scene.body().m_nodes[i].m_im, masses[std::size_t(i)]);
  }
  EXPECT_EQ(scene.body().m_links.size(), links);
  EXPECT_EQ(scene.body().m_materials.size(), materials);
  EXPECT_FALSE(scene.body().m_bUpdateRtCst);
}

}  // namespace
}  // namespace wetcloth_test::no_effects_no_change_test
