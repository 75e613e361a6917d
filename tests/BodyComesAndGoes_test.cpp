// SPDX-License-Identifier: Zlib
// Bodies leave a world, are deleted, and come back, whether or not the application told us.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/ContactScene.h"
#include "tests/support/ExactPace.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Materials.h"
#include "tests/support/Patches.h"

#include <sstream>

namespace wetcloth_test::body_comes_and_goes_test {

namespace {

void addEverything(wetcloth::WetCloth& cloth) {
  cloth.body().m_cfg.collisions =
      contactFlags(cloth.isInDeformableWorld() ? WorldKind::deformable : WorldKind::softRigid);
  cloth.add<wetcloth::Absorption>();
  cloth.add<wetcloth::Wind>({btVector3(1, 0, 2)});
  cloth.add<wetcloth::HookeSprings>(springsOf(200, 5));
  cloth.add<wetcloth::Rain>();
  cloth.add<wetcloth::Diffusion>();
  cloth.add<wetcloth::Seepage>();
  cloth.add<wetcloth::Dripping>();
  cloth.add<wetcloth::Drying>();
  cloth.add<wetcloth::ContactWetting>();
  cloth.add<wetcloth::Cling>();
  cloth.add<wetcloth::WetFriction>();
  cloth.add<wetcloth::WetStiffness>();
  cloth.add<wetcloth::Swelling>();
  cloth.add<wetcloth::CollisionAudit>();
}

// Memory checkers watch this one.
TEST_IN_EVERY_WORLD(BodyComesAndGoes, DeletedWhileWeKnowIt) {
  BodyScene scene(GetParam(), hangingPatch(4));
  std::vector<std::string> messages;
  wetcloth::WetClothWorld wet(scene.world());
  wet.setLog([&messages](const std::string& message) { messages.push_back(message); });
  addEverything(exactly(wet.add(scene.body())));
  scene.bullet().step(5);
  scene.deleteBody();
  scene.bullet().step(5);
  EXPECT_EQ(messages.size(), 1u);
}

TEST_IN_EVERY_WORLD(BodyComesAndGoes, DeletedAndWeLeaveWithoutAnotherStep) {
  BodyScene scene(GetParam(), hangingPatch(4));
  wetcloth::WetClothWorld wet(scene.world());
  wet.setLog({});
  addEverything(exactly(wet.add(scene.body())));
  scene.bullet().step(5);
  scene.deleteBody();
}

// Only the world can tell that a body was deleted: it is asked before the body is.
TEST_IN_EVERY_WORLD(BodyComesAndGoes, DeletedAndWeAreAskedWithoutAnotherStep) {
  for (const bool byDetach : {true, false}) {
    BodyScene scene(GetParam(), hangingPatch(4));
    wetcloth::WetClothWorld wet(scene.world());
    wet.setLog({});
    wetcloth::WetCloth& cloth = exactly(wet.add(scene.body()));
    addEverything(cloth);
    scene.bullet().step(5);
    const double held = cloth.held(2);
    scene.deleteBody();
    EXPECT_EQ(cloth.held(2), held);
    EXPECT_EQ(cloth.nodeCount(), 16);
    std::stringstream stream;
    EXPECT_NO_THROW(wet.save(stream));  // a cloth that is not there has a state, too
    EXPECT_NO_THROW(wet.restore(stream));
    cloth.find<wetcloth::CollisionAudit>()->look();
    if (byDetach) wet.detach();
  }
}

TEST_IN_EVERY_WORLD(BodyComesAndGoes, DeletedWithOthersLeftBehind) {
  BulletWorld bullet(GetParam());
  std::unique_ptr<btSoftBody> gone = hangingPatch(4).build(bullet.info());
  wetcloth::ClothPatch patch = hangingPatch(4);
  patch.origin = btVector3(50, 0, 0);
  std::unique_ptr<btSoftBody> stays = patch.build(bullet.info());
  bullet.add(*gone);
  bullet.add(*stays);
  {
    wetcloth::WetClothWorld wet(bullet.world());
    wet.setLog({});
    addEverything(exactly(wet.add(*gone)));
    addEverything(exactly(wet.add(*stays)));
    bullet.step(5);
    bullet.remove(*gone);
    gone.reset();
    const double before = wet.find(*stays)->ledger().held;
    bullet.step(5);
    EXPECT_GT(wet.find(*stays)->ledger().held, before);
    EXPECT_TRUE(isFinite(*stays));
  }
  bullet.remove(*stays);
}

TEST_IN_EVERY_WORLD(BodyComesAndGoes, RemovedAndAddedAgainItGoesOn) {
  BodyScene scene(GetParam(), hangingPatch(4));
  std::vector<std::string> messages;
  wetcloth::WetClothWorld wet(scene.world());
  wet.setLog([&messages](const std::string& message) { messages.push_back(message); });
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body(), fabricOf(1, 1)));
  cloth.add<wetcloth::Absorption>();
  scene.bullet().step(24);
  const double before = cloth.ledger().held;
  scene.bullet().remove(scene.body());
  scene.bullet().step(24);
  EXPECT_EQ(cloth.ledger().held, before) << "no time passes for a body that is not in the world";
  EXPECT_EQ(messages.size(), 1u) << "said once";
  scene.bullet().add(scene.body());
  scene.bullet().step(24);
  EXPECT_NEAR(cloth.meanSaturation(), 1 - std::exp(-0.2), 1e-5);
  EXPECT_TRUE(isFinite(scene.body()));
}

// The right order: forget the cloth, then delete the body.
TEST_IN_EVERY_WORLD(BodyComesAndGoes, ForgottenThenDeleted) {
  BodyScene scene(GetParam(), hangingPatch(4));
  int messages = 0;
  wetcloth::WetClothWorld wet(scene.world());
  wet.setLog([&messages](const std::string&) { ++messages; });
  addEverything(exactly(wet.add(scene.body())));
  scene.bullet().step(5);
  wet.remove(scene.body());
  scene.deleteBody();
  scene.bullet().step(5);
  EXPECT_TRUE(wet.cloths().empty());
  EXPECT_EQ(messages, 0);
}

}  // namespace
}  // namespace wetcloth_test::body_comes_and_goes_test
