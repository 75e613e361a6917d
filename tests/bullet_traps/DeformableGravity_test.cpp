// SPDX-License-Identifier: Zlib
// An implicit step of the deformable world takes gravity from the last btDeformableGravityForce; without one it takes a
// variable that it never set.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/Patches.h"

#include <gtest/gtest.h>

namespace wetcloth_test::deformable_gravity_test {

namespace {

TEST(DeformableGravity, ThatIsMissingIsSaidWhenABodyIsAdded) {
  for (const WorldKind kind : {WorldKind::deformable, WorldKind::deformableImplicit}) {
    BulletWorld bullet(kind);
    const std::unique_ptr<btSoftBody> body = squarePatch(4).build(bullet.info());
    bullet.deformable().addSoftBody(body.get());
    {
      wetcloth::WetClothWorld wet(bullet.world());
      std::vector<std::string> messages;
      wet.setLog([&](const std::string& message) { messages.push_back(message); });
      wet.add(*body);
      ASSERT_EQ(messages.size(), 1u);
      EXPECT_NE(messages[0].find("btDeformableGravityForce"), std::string::npos);
      wet.remove(*body);
      bullet.addForce(*body, std::make_unique<btDeformableGravityForce>(btVector3(0, 0, 0)));
      messages.clear();
      wet.add(*body);
      EXPECT_TRUE(messages.empty());
    }
    bullet.remove(*body);
  }
}

}  // namespace
}  // namespace wetcloth_test::deformable_gravity_test
