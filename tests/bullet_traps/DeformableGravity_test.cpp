// SPDX-License-Identifier: Zlib
// An implicit step of the deformable world takes gravity from the last btDeformableGravityForce; without one it takes a
// variable that it never set.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
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

// Its nodes follow its modes: an effect would do nothing, and nobody would know.
TEST(ReducedDeformableBody, IsRefused) {
  BodyScene scene(WorldKind::deformable);
  scene.body().m_reducedModel = true;
  wetcloth::WetClothWorld wet(scene.world());
  EXPECT_THROW(wet.add(scene.body()), std::invalid_argument);
  scene.body().m_reducedModel = false;
  EXPECT_NO_THROW(wet.add(scene.body()));
}

}  // namespace
}  // namespace wetcloth_test::deformable_gravity_test
