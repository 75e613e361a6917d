// SPDX-License-Identifier: Zlib
// No water is made or lost: initial + absorbed == held + dripped + evaporated, at every step, to rounding.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/CallEffect.h"
#include "tests/support/ExactPace.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Materials.h"
#include "tests/support/Patches.h"
#include "tests/support/UnevenWater.h"

namespace wetcloth_test::water_balance_test {

namespace {

// Relative to all the water that ever passed.
void expectClosed(const wetcloth::WetCloth& cloth) {
  const wetcloth::Ledger ledger = cloth.ledger();
  double held = 0;
  for (int i = 0; i < cloth.nodeCount(); ++i) held += cloth.held(i);
  EXPECT_NEAR(ledger.held, held, 1e-12 * held);
  const double passed = std::fabs(ledger.initial) + ledger.absorbed;
  EXPECT_LE(std::fabs(ledger.imbalance()), 1e-12 * passed);
  EXPECT_NEAR(ledger.initial + ledger.absorbed, held + ledger.dripped + ledger.evaporated, 1e-12 * passed);
}

// Losses of an application's own: some of what is held drips and some dries, more on some nodes than on others.
void leak(wetcloth::WetCloth& cloth, const wetcloth::Step& step) {
  for (std::size_t i = 0; i < cloth.water().size(); ++i) {
    cloth.water().drip(i, cloth.water().held(i) * step.dt * double(i % 3));
    cloth.water().evaporate(i, 0.3 * cloth.water().held(i) * step.dt);
  }
}

void swap(wetcloth::WetCloth& cloth, const wetcloth::Step&) {
  for (std::size_t i = 0; i + 1 < cloth.water().size(); ++i) {
    const btVector3& v = cloth.body().m_nodes[int(i)].m_v;
    cloth.water().move(i, i + 1, 0.01 * cloth.water().held(i), double(v.x()), double(v.y()), double(v.z()));
  }
}

TEST_IN_EVERY_WORLD(WaterBalance, HoldsInEveryStep) {
  BodyScene scene(GetParam(), hangingPatch(5));
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body(), fabricOf(2, 0.5)));
  cloth.setSaturation(0.3);
  cloth.add<wetcloth::Absorption>({0.7});
  addCall(cloth, leak, wetcloth::Stage::losses);
  addCall(cloth, swap, wetcloth::Stage::transport);
  for (int step = 0; step < 200; ++step) {
    scene.bullet().step(1);
    expectClosed(cloth);
  }
  EXPECT_GT(cloth.ledger().dripped, 0);
  EXPECT_GT(cloth.ledger().evaporated, 0);
  EXPECT_GT(cloth.ledger().absorbed, 0);
}

TEST_IN_EVERY_WORLD(WaterBalance, IsClosedAfterAHundredThousandSteps) {
  BodyScene scene(GetParam(), squarePatch(2), btVector3(0, 0, 0));
  wetcloth::WetClothWorld wet(scene.world(), wetcloth::Hook::manual);
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body(), fabricOf(2, 0.5)));
  cloth.add<wetcloth::Absorption>({std::vector<double>{1, 0.5, 0.1, 0}});
  addCall(cloth, leak, wetcloth::Stage::losses);
  addCall(cloth, swap, wetcloth::Stage::transport);
  for (int step = 0; step < 100000; ++step) wet.preTick(btScalar(1) / 240);
  EXPECT_GT(cloth.ledger().absorbed, 100 * cloth.ledger().held) << "much has passed through";
  expectClosed(cloth);
}

// The same with Bullet's own step in between, once.
TEST(WaterBalanceWithBulletsStep, IsClosedAfterAHundredThousandSteps) {
  BodyScene scene(WorldKind::softRigid, squarePatch(2));
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body(), fabricOf(2, 0.5)));
  cloth.add<wetcloth::Absorption>();
  addCall(cloth, leak, wetcloth::Stage::losses);
  scene.body().m_nodes[0].m_im = 0;  // so that it hangs and does not fall out of the float's range
  scene.bullet().step(100000);
  EXPECT_GT(cloth.ledger().absorbed, 100 * cloth.ledger().held);
  expectClosed(cloth);
}

TEST_IN_EVERY_WORLD(WaterBalance, HoldsWhenWaterIsSetByHand) {
  BodyScene scene(GetParam(), hangingPatch(4));
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body(), fabricOf(2, 0.5)));
  cloth.add<wetcloth::Absorption>();
  scene.bullet().step(10);
  const double absorbed = cloth.ledger().absorbed;
  cloth.setSaturation(0);
  expectClosed(cloth);
  EXPECT_EQ(cloth.ledger().held, 0);
  EXPECT_EQ(cloth.ledger().absorbed, absorbed);
  EXPECT_NEAR(cloth.ledger().initial, -absorbed, 1e-12 * absorbed) << "what was taken out by hand";
  cloth.setHeld(unevenWater(cloth));
  expectClosed(cloth);
}

// Nobody can take more than there is, and only what left is booked.
TEST_IN_EVERY_WORLD(WaterBalance, HoldsWhenAnEffectTakesTooMuch) {
  BodyScene scene(GetParam(), squarePatch(3));
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body()));
  cloth.setSaturation(0.5);
  const double before = cloth.ledger().held;
  addCall(
      cloth, [](wetcloth::WetCloth& wetCloth, const wetcloth::Step&) { wetCloth.water().drip(4, 1e6); },
      wetcloth::Stage::losses);
  scene.bullet().step(2);
  EXPECT_EQ(cloth.held(4), 0);
  EXPECT_NEAR(cloth.ledger().dripped, before - cloth.ledger().held, 1e-12 * before);
  expectClosed(cloth);
  EXPECT_TRUE(isFinite(scene.body()));
}

}  // namespace
}  // namespace wetcloth_test::water_balance_test
