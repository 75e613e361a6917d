// SPDX-License-Identifier: Zlib
// A world that is deleted takes the broadphase's handle from each body that is in it, and leaves it the number in the
// world's list, which goes when a body is taken out of a world: so a body tells that its world is gone.

#include "tests/support/BodyScene.h"
#include "tests/support/InEveryWorld.h"

namespace wetcloth_test::deleted_world_test {

namespace {

class DeletedWorld {
 protected:
  BulletWorld bullet{GetParam()};
  std::unique_ptr<btSoftBody> body = squarePatch(4).build(bullet.info());
};

TEST_F_IN_EVERY_WORLD(DeletedWorld, InPlainBulletIsToldByItsBodies) {
  EXPECT_EQ(body->getWorldArrayIndex(), -1);
  bullet.add(*body);
  bullet.step(3);
  EXPECT_NE(body->getBroadphaseHandle(), nullptr);
  EXPECT_GE(body->getWorldArrayIndex(), 0);
  bullet.deleteWorld();
  EXPECT_EQ(body->getBroadphaseHandle(), nullptr);
  EXPECT_GE(body->getWorldArrayIndex(), 0);
}

TEST_F_IN_EVERY_WORLD(DeletedWorld, InPlainBulletIsNotABodyThatWasTakenOut) {
  bullet.add(*body);
  bullet.step(3);
  bullet.remove(*body);
  EXPECT_EQ(body->getBroadphaseHandle(), nullptr);
  EXPECT_EQ(body->getWorldArrayIndex(), -1);
}

}  // namespace
}  // namespace wetcloth_test::deleted_world_test
