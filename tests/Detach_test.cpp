// SPDX-License-Identifier: Zlib
// Who goes first: the world, its bodies, or we. A WetClothWorld that was detached, or has no cloths left, touches
// nothing when it goes. Memory checkers watch these.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BodyState.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Materials.h"
#include "tests/support/Patches.h"

#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace wetcloth_test::detach_test {

namespace {

// All of it on the heap, to be deleted in any order.
struct Parts {
  explicit Parts(WorldKind kind)
      : bullet(std::make_unique<BulletWorld>(kind)), body(hangingPatch(4).build(bullet->info())) {
    bullet->add(*body);
    wet = std::make_unique<wetcloth::WetClothWorld>(bullet->world());
    wet->setLog([this](const std::string& message) { messages.push_back(message); });
    cloth = &wet->add(*body);
    cloth->add<wetcloth::Absorption>();
    if (!bullet->isDeformable()) cloth->add<wetcloth::WetFriction>();  // takes the tick callback
    cloth->add<wetcloth::HookeSprings>(springsOf(200, 5));
    bullet->step(5);
  }
  ~Parts() {
    wet.reset();
    if (bullet && body) bullet->remove(*body);
  }
  void deleteWorld() {
    bullet->deleteWorld();
    bullet.reset();
  }
  bool hasItsOwnMaterials() const { return body->m_links[0].m_material == body->m_materials[0]; }
  void deleteBody() {
    if (bullet) bullet->remove(*body);
    body.reset();
  }

  std::vector<std::string> messages;
  std::unique_ptr<BulletWorld> bullet;
  std::unique_ptr<btSoftBody> body;
  std::unique_ptr<wetcloth::WetClothWorld> wet;
  wetcloth::WetCloth* cloth = nullptr;
};

TEST_IN_EVERY_WORLD(Detach, GivesBackWhatEffectsChanged) {
  Parts parts(GetParam());
  EXPECT_NE(parts.body->m_links[0].m_material, parts.body->m_materials[0]);
  parts.wet->detach();
  EXPECT_EQ(parts.body->m_links[0].m_material, parts.body->m_materials[0]);
  EXPECT_TRUE(parts.wet->cloths().empty());
  EXPECT_FALSE(parts.wet->isHooked());
  EXPECT_FALSE(parts.wet->isTickHooked());
  parts.bullet->step(3);
  EXPECT_TRUE(isFinite(*parts.body));
}

TEST_IN_EVERY_WORLD(Detach, AfterwardsTheObjectDoesNothing) {
  Parts parts(GetParam());
  parts.wet->detach();
  const double time = parts.wet->time();
  parts.wet->detach();
  parts.wet->preTick(btScalar(0.01));
  parts.wet->tick(btScalar(0.01));
  EXPECT_EQ(parts.wet->time(), time);
  EXPECT_EQ(parts.wet->find(*parts.body), nullptr);
  EXPECT_THROW(parts.wet->add(*parts.body), std::invalid_argument);
  EXPECT_THROW(parts.wet->remove(*parts.body), std::invalid_argument);
  std::stringstream stream;
  EXPECT_THROW(parts.wet->save(stream), std::invalid_argument);
  EXPECT_THROW(parts.wet->restore(stream), std::invalid_argument);
}

TEST_IN_EVERY_WORLD(Detach, ThenTheWorldMayHaveAnother) {
  Parts parts(GetParam());
  parts.wet->detach();
  wetcloth::WetClothWorld another(parts.bullet->world());
  EXPECT_TRUE(another.isHooked());
  parts.wet.reset();
  EXPECT_TRUE(another.isHooked());
}

// exitPhysics() of Bullet's demos deletes the bodies and the world; members go later.
TEST_IN_EVERY_WORLD(Detach, ThenWorldAndBodiesGoInAnyOrder) {
  for (const bool bodyFirst : {true, false}) {
    Parts parts(GetParam());
    parts.wet->detach();
    if (bodyFirst) parts.deleteBody();
    parts.deleteWorld();
    if (!bodyFirst) parts.deleteBody();
    parts.wet.reset();
  }
}

TEST_IN_EVERY_WORLD(Detach, IsNotNeededWithoutCloths) {
  for (const bool bodyFirst : {true, false}) {
    Parts parts(GetParam());
    parts.wet->remove(*parts.body);
    if (bodyFirst) parts.deleteBody();
    parts.deleteWorld();
    if (!bodyFirst) parts.deleteBody();
    parts.wet.reset();
  }
}

// --- the world went first, and a body that is there is handed over --------------------------------------------------

TEST_IN_EVERY_WORLD(Detach, AfterTheWorldWasDeletedRemoveGivesTheBodyBackWhatWasIts) {
  Parts parts(GetParam());
  ASSERT_FALSE(parts.hasItsOwnMaterials());
  parts.deleteWorld();
  parts.wet->remove(*parts.body);
  EXPECT_TRUE(parts.hasItsOwnMaterials());
  EXPECT_TRUE(parts.wet->cloths().empty());
  parts.body.reset();
  parts.wet.reset();
  ASSERT_EQ(parts.messages.size(), 1u);
  EXPECT_NE(parts.messages[0].find("the world was deleted before its WetClothWorld"), std::string::npos);
}

// add() is told of the deletion as remove() is; from then on nothing touches the world, or another body.
TEST_IN_EVERY_WORLD(Detach, AfterTheWorldWasSeenToBeDeletedReadingGoesOnAndChangingThrows) {
  for (const bool byDetach : {true, false}) {
    Parts parts(GetParam());
    const double saturation = parts.cloth->saturation(3);
    parts.deleteWorld();
    EXPECT_THROW(parts.wet->add(*parts.body), std::invalid_argument);
    EXPECT_EQ(parts.cloth->saturation(3), saturation);
    EXPECT_EQ(parts.cloth->nodeCount(), 16);
    EXPECT_EQ(parts.wet->find(*parts.body), parts.cloth);
    EXPECT_FALSE(parts.wet->isInWorld(*parts.body));
    EXPECT_FALSE(parts.wet->isHooked());
    EXPECT_FALSE(parts.wet->isTickHooked());
    parts.wet->preTick(btScalar(0.01));
    parts.wet->tick(btScalar(0.01));
    EXPECT_THROW(parts.cloth->setSaturation(1), std::invalid_argument);
    EXPECT_THROW(parts.cloth->add<wetcloth::Wind>(), std::invalid_argument);
    EXPECT_THROW(parts.wet->add(*parts.body), std::invalid_argument);
    std::stringstream stream;
    EXPECT_THROW(parts.wet->save(stream), std::invalid_argument);
    EXPECT_THROW(parts.wet->restore(stream), std::invalid_argument);
    parts.cloth->remove(*parts.cloth->find<wetcloth::HookeSprings>());
    EXPECT_TRUE(parts.hasItsOwnMaterials());
    parts.body.reset();
    byDetach ? parts.wet->detach() : parts.wet.reset();
    EXPECT_EQ(parts.messages.size(), 1u);
  }
}

int applicationCalls = 0;
void onPreTick(btDynamicsWorld*, btScalar) { ++applicationCalls; }

// We cannot know that the world is there, so the slot is given back when it calls.
TEST_IN_EVERY_WORLD(Detach, WithoutClothsTheApplicationsCallbackGoesOn) {
  BulletWorld bullet(GetParam());
  applicationCalls = 0;
  bullet.world().setInternalTickCallback(onPreTick, nullptr, true);
  { wetcloth::WetClothWorld wet(bullet.world()); }
  bullet.step(3);
  EXPECT_EQ(applicationCalls, 3);
  bullet.world().setInternalTickCallback(nullptr, nullptr, true);
  bullet.step(1);
  EXPECT_EQ(applicationCalls, 3);
}

}  // namespace
}  // namespace wetcloth_test::detach_test
