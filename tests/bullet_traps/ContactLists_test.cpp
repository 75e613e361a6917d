// SPDX-License-Identifier: Zlib
// When Bullet's lists of contacts are filled, which collision flags fill them, and which it forgets to empty.

#include "bullet_wetcloth/bullet/Contacts.h"
#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyState.h"
#include "tests/support/BulletSprings.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/ContactScene.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/RigidBody.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace wetcloth_test::contact_lists_test {
namespace {

using Flags = btSoftBody::fCollision;

/// Two sheets on a floor, without anything of ours.
class Sheets {
 public:
  Sheets(WorldKind kind, int flags)
      : bullet(kind), m_floor(bullet, box(5, 0.5, 5), 0, {0, -0.5, 0}), lower(make(0.9 * kMargin, flags)) {
    upper = make(2.8 * kMargin, flags);
  }
  ~Sheets() {
    for (btSoftBody* body : {lower.get(), upper.get()}) bullet.remove(*body);
  }
  Sheets(const Sheets&) = delete;
  Sheets& operator=(const Sheets&) = delete;

  BulletWorld bullet;

 private:
  RigidBody m_floor;
  std::unique_ptr<btSoftBody> make(double height, int flags) {
    Lying lying;
    lying.height = height;
    auto body = lying.builder(bullet.kind())(bullet.info());
    body->m_cfg.collisions = flags;
    bullet.add(*body);
    if (bullet.isDeformable()) {
      bullet.addForce(*body, bulletSprings(5));
    }
    return body;
  }

 public:
  std::unique_ptr<btSoftBody> lower;
  std::unique_ptr<btSoftBody> upper;
};

/// Most entries that a body's lists ever had when a callback came: before Bullet predicts, and between its detection
/// and its solve.
struct Watch {
  btSoftBody* body = nullptr;
  int rigidBefore = 0, rigidAt = 0, softBefore = 0, softAt = 0;

  explicit Watch(Sheets& sheets) : body(sheets.lower.get()) {
    sheets.bullet.world().setInternalTickCallback(preTick, this, true);
    sheets.bullet.world().setInternalTickCallback(tick, this, false);
  }
  int rigid() const {
    return body->m_rcontacts.size() + body->m_nodeRigidContacts.size() + body->m_faceRigidContacts.size();
  }
  int soft() const { return body->m_scontacts.size() + body->m_faceNodeContacts.size(); }
  static Watch& of(btDynamicsWorld* world) { return *static_cast<Watch*>(world->getWorldUserInfo()); }
  static void preTick(btDynamicsWorld* world, btScalar) {
    Watch& watch = of(world);
    watch.rigidBefore = std::max(watch.rigidBefore, watch.rigid());
    watch.softBefore = std::max(watch.softBefore, watch.soft());
  }
  static void tick(btDynamicsWorld* world, btScalar) {
    Watch& watch = of(world);
    watch.rigidAt = std::max(watch.rigidAt, watch.rigid());
    watch.softAt = std::max(watch.softAt, watch.soft());
  }
};

TEST_IN_EVERY_WORLD(ContactLists, OfRigidBodiesAreFullInTheTickAndStillInTheNextPreTick) {
  Sheets sheets(GetParam(), contactFlags(GetParam()));
  const Watch watch(sheets);
  sheets.bullet.step(1);
  EXPECT_EQ(watch.rigidBefore, 0);
  EXPECT_EQ(watch.rigidAt, 16);
  sheets.bullet.step(1);
  EXPECT_EQ(watch.rigidBefore, 16);
}

// The deformable world looks for contacts of two soft bodies after its solve, and applies them at once.
TEST_IN_WORLDS_WITH_FACE_CONTACTS(ContactLists, OfSoftBodiesAreEmptyInTheTickOfTheDeformableWorld) {
  Sheets sheets(GetParam(), contactFlags(GetParam()));
  const Watch watch(sheets);
  sheets.bullet.step(240);
  EXPECT_GT(watch.softBefore, 0);
  EXPECT_EQ(watch.softAt > 0, !sheets.bullet.isDeformable());
}

// What another world would solve is listed all the same, never solved, and never emptied: it grows step by step.
TEST_IN_EVERY_WORLD(ContactLists, GrowWithoutEndWithAnotherWorldsFlags) {
  const bool isDeformable = Sheets(GetParam(), 0).bullet.isDeformable();
  Sheets sheets(GetParam(), contactFlags(isDeformable ? WorldKind::softRigid : WorldKind::deformable));
  const Watch watch(sheets);
  sheets.bullet.step(10);
  EXPECT_GT(watch.rigid(), 100);
  sheets.bullet.step(240);
  EXPECT_LT(double(sheets.lower->m_nodes[0].m_x.y()), -1) << "and the cloth falls through the floor";
}

TEST(ContactListsOfTheDeformableWorld, NeedAFlagForNodesOrTriangles) {
  for (const int more : {0, int(Flags::SDF_RDN), int(Flags::SDF_RDF)}) {
    Sheets sheets(WorldKind::deformable, Flags::SDF_RD | more);
    sheets.bullet.step(240);
    EXPECT_EQ(double(sheets.lower->m_nodes[0].m_x.y()) < -1, more == 0) << more;
  }
}

// Contacts of two soft bodies are worked off in the order of a random number that is never set back.
TEST(ContactListsOfTheDeformableWorld, OfSoftBodiesMakeNoTwoRunsAlike) {
  Sheets once(WorldKind::deformable, contactFlags(WorldKind::deformable));
  Sheets again(WorldKind::deformable, contactFlags(WorldKind::deformable));
  once.bullet.step(240);
  again.bullet.step(240);
  EXPECT_FALSE(sameBits(stateOf(*once.upper), stateOf(*again.upper)));
}

// So an effect that looks at them before the prediction sees contacts of the day when the body fell asleep.
TEST(ContactListsOfTheDeformableWorld, OfASleeperStay) {
  Sheets sheets(WorldKind::deformable, Flags::SDF_RD | Flags::SDF_RDN);
  sheets.bullet.step(2000);
  ASSERT_FALSE(sheets.lower->isActive());
  EXPECT_EQ(sheets.lower->m_nodeRigidContacts.size(), 16);
}

}  // namespace
}  // namespace wetcloth_test::contact_lists_test
