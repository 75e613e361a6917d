// SPDX-License-Identifier: Zlib
// A cloth where no water moves does not touch masses, and a settled effect idles until its input changes.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/CallEffect.h"
#include "tests/support/ExactPace.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Materials.h"
#include "tests/support/Patches.h"

namespace wetcloth_test::only_the_work_asked_for_test {

namespace {

// 1 s is 100 time constants: what is missing then is below the rounding of a double.
struct Soaked {
  explicit Soaked(WorldKind kind, wetcloth::Absorption::Law law = wetcloth::Absorption::Law::exponential)
      : scene(kind, hangingPatch(5)), wet(scene.world()), cloth(exactly(wet.add(scene.body(), fabricOf(1, 0.01)))) {
    wetcloth::Absorption::Parameters parameters;
    parameters.law = law;
    parameters.rampDuration = 0.5;
    soak = &cloth.add<wetcloth::Absorption>(parameters);
    scene.bullet().step(240);
  }
  BodyScene scene;
  wetcloth::WetClothWorld wet;
  wetcloth::WetCloth& cloth;
  wetcloth::Absorption* soak = nullptr;
};

TEST_IN_EVERY_WORLD(OnlyTheWorkAskedFor, IsNoneAfterSaturation) {
  for (const auto law : {wetcloth::Absorption::Law::exponential, wetcloth::Absorption::Law::forwardEuler,
                         wetcloth::Absorption::Law::ramp}) {
    Soaked soaked(GetParam(), law);
    EXPECT_NEAR(soaked.cloth.meanSaturation(), 1, 1e-12);
    const long long visited = soaked.soak->nodesVisited();
    const long long commits = soaked.cloth.masses().commits();
    const long long refreshes = soaked.cloth.linkConstants().refreshes();
    EXPECT_GT(visited, 0);
    soaked.scene.bullet().step(50);
    EXPECT_EQ(soaked.soak->nodesVisited(), visited);
    EXPECT_EQ(soaked.cloth.masses().commits(), commits);
    EXPECT_EQ(soaked.cloth.linkConstants().refreshes(), refreshes);
  }
}

TEST_IN_EVERY_WORLD(OnlyTheWorkAskedFor, BeginsAgainWhenWaterLeft) {
  Soaked soaked(GetParam());
  soaked.scene.bullet().step(10);
  bool once = true;
  addCall(
      soaked.cloth,
      [&once](wetcloth::WetCloth& cloth, const wetcloth::Step&) {
        if (once) cloth.water().drip(7, 0.5 * cloth.water().held(7));
        once = false;
      },
      wetcloth::Stage::losses);
  soaked.scene.bullet().step(1);
  EXPECT_NEAR(soaked.cloth.saturation(7), 0.5, 1e-6);
  soaked.scene.bullet().step(100);
  EXPECT_NEAR(soaked.cloth.saturation(7), 1, 1e-12);
}

TEST_IN_EVERY_WORLD(OnlyTheWorkAskedFor, BeginsAgainWhenWaterWasSetByHand) {
  Soaked soaked(GetParam());
  soaked.scene.bullet().step(10);
  soaked.cloth.setSaturation(0.25);
  soaked.scene.bullet().step(240);
  EXPECT_NEAR(soaked.cloth.meanSaturation(), 1, 1e-12);
}

TEST_IN_EVERY_WORLD(OnlyTheWorkAskedFor, BeginsAgainWhenTheExposureChanged) {
  BodyScene scene(GetParam(), hangingPatch(5));
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body(), fabricOf(1, 0.01)));
  wetcloth::Absorption& soak = cloth.add<wetcloth::Absorption>({0.0});
  scene.bullet().step(10);
  EXPECT_EQ(cloth.ledger().held, 0);
  adjust(soak, [](auto& p) { p.exposure = 1.0; });
  scene.bullet().step(240);
  EXPECT_NEAR(cloth.meanSaturation(), 1, 1e-12);
}

TEST_IN_EVERY_WORLD(OnlyTheWorkAskedFor, BeginsAgainWhenTheApplicationMadeANodeHeavier) {
  Soaked soaked(GetParam());
  soaked.scene.bullet().step(10);
  soaked.scene.body().setMass(3, btScalar(0.5));
  soaked.cloth.setSaturation(1);  // any commit takes the mass over
  EXPECT_NEAR(soaked.cloth.dryMass(3), 0.5, 1e-6);
  soaked.scene.bullet().step(240);
  EXPECT_NEAR(soaked.cloth.saturation(3), 1, 1e-12);
}

// Wind writes velocities only.
TEST_IN_EVERY_WORLD(OnlyTheWorkAskedFor, WindTouchesNoMasses) {
  BodyScene scene(GetParam(), hangingPatch(5));
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body()));
  cloth.add<wetcloth::Wind>({btVector3(0, 0, 3)});
  const long long commits = cloth.masses().commits();
  const btScalar before = scene.body().m_nodes[2].m_im;
  scene.bullet().step(20);
  EXPECT_EQ(cloth.masses().commits(), commits);
  EXPECT_EQ(scene.body().m_nodes[2].m_im, before);
}

// What is set by hand is there at once, without a step.
TEST_IN_EVERY_WORLD(OnlyTheWorkAskedFor, IsDoneAtOnceWhenWaterIsSetByHand) {
  BodyScene scene(GetParam(), hangingPatch(5));
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body(), fabricOf(3, 1)));
  scene.bullet().step(1);
  const std::vector<btScalar> before = stateOf(scene.body());
  const double dry = cloth.dryMass(7);
  cloth.setSaturation(1);
  EXPECT_NEAR(1 / double(scene.body().m_nodes[7].m_im), 4 * dry, 1e-6 * dry);
  cloth.setHeld(std::vector<double>(25, dry));
  EXPECT_NEAR(1 / double(scene.body().m_nodes[7].m_im), 2 * dry, 1e-6 * dry);
  EXPECT_TRUE(sameBits(stateOf(scene.body()), before)) << "velocities and places stay";
  EXPECT_FALSE(scene.body().m_bUpdateRtCst);
}

}  // namespace
}  // namespace wetcloth_test::only_the_work_asked_for_test
