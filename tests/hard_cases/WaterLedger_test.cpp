// SPDX-License-Identifier: Zlib
// The water ledger over a long life: every effect at once, a hundred thousand steps. Only our own part of the step
// runs, since the water is all that is asked for.

#include "tests/support/BodyScene.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Materials.h"
#include "tests/support/Patches.h"
#include "tests/support/WaterCycle.h"

#include <random>

namespace wetcloth_test::water_ledger_test {

namespace {

/// All effects with ordinary parameters: what comes in is about what goes out, and nothing settles.
water_cycle::Choice everything(std::mt19937& random) {
  water_cycle::Choice choice;
  choice.names = water_cycle::names();
  choice.number = [](double low, double high) { return std::sqrt(low * high); };
  choice.fraction = [&random] { return std::uniform_real_distribution<double>(0.1, 0.9)(random); };
  choice.vector = [&random](double size) {
    std::uniform_real_distribution<double> component(-size, size);
    return btVector3(btScalar(component(random)), btScalar(component(random)), btScalar(component(random)));
  };
  return choice;
}

// A hundred thousand steps in one world; the others, whose own step is not taken, have fewer.
TEST_IN_EVERY_WORLD(WaterLedger, ClosesAfterManyStepsOfEverything) {
  const int steps = GetParam() == WorldKind::softRigid ? 100000 : 20000;
  std::mt19937 random(5);
  BodyScene scene(GetParam(), hangingPatch(4));
  water_cycle::giveWater(scene.bullet().info(), btScalar(0.4));
  water_cycle::letTouch(scene.bullet(), scene.body());
  wetcloth::WetClothWorld wet(scene.world(), wetcloth::Hook::manual);
  wetcloth::WetCloth& cloth = wet.add(scene.body(), fabricOf(0.84, 9));
  cloth.setSaturation(0.5);
  water_cycle::add(cloth, everything(random));
  for (int step = 1; step <= steps; ++step) {
    wet.preTick(btScalar(1) / 240);
    if (step % (steps / 10) != 0) continue;
    ASSERT_EQ(water_cycle::faultOf(cloth), "") << "step " << step;
  }
  const wetcloth::Ledger ledger = cloth.ledger();
  EXPECT_GT(ledger.absorbed, steps / 10000 * cloth.water().totalCapacity()) << "much water has come";
  EXPECT_GT(ledger.dripped, 0);
  EXPECT_GT(ledger.evaporated, 0);
}

}  // namespace
}  // namespace wetcloth_test::water_ledger_test
