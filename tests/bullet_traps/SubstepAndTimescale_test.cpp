// SPDX-License-Identifier: Zlib
// The pre-tick callback runs once per substep with the substep's dt; what the body sees of it is another matter:
// m_cfg.timescale scales the step in two of Bullet's worlds and not in the deformable one.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/CallEffect.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Materials.h"
#include "tests/support/Measures.h"
#include "tests/support/Patches.h"

namespace wetcloth_test::substep_and_timescale_test {

namespace {

struct Ticks {
  std::vector<btScalar> dts;
  static void record(btDynamicsWorld* world, btScalar dt) {
    static_cast<Ticks*>(world->getWorldUserInfo())->dts.push_back(dt);
  }
};

// The fact.
TEST_IN_EVERY_WORLD(SubstepAndTimescale, InPlainBulletThePreTickRunsOncePerSubstep) {
  BodyScene scene(GetParam());
  Ticks ticks;
  scene.world().setInternalTickCallback(Ticks::record, &ticks, true);
  scene.world().stepSimulation(btScalar(0.0170), 10, btScalar(0.004));
  EXPECT_EQ(ticks.dts, std::vector<btScalar>(4, btScalar(0.004)));
}

TEST_IN_EVERY_WORLD(SubstepAndTimescale, EffectsRunOncePerSubstepWithItsDt) {
  BodyScene scene(GetParam());
  wetcloth::WetClothWorld wet(scene.world());
  std::vector<double> dts;
  std::vector<double> times;
  addCall(wet.add(scene.body()), [&](wetcloth::WetCloth&, const wetcloth::Step& step) {
    dts.push_back(step.dt);
    times.push_back(step.time);
  });
  scene.world().stepSimulation(btScalar(0.0170), 10, btScalar(0.004));
  ASSERT_EQ(dts.size(), 4u);
  for (std::size_t i = 0; i < dts.size(); ++i) {
    EXPECT_NEAR(dts[i], 0.004, 1e-9);  // a float of 0.004
    EXPECT_NEAR(times[i], 0.004 * double(i), 1e-8);
  }
  EXPECT_NEAR(wet.time(), 0.016, 1e-8);
}

// Distance that Bullet itself moves a body of 1 m/s in one second of world time.
double distanceInOneSecond(WorldKind kind, double timescale) {
  BodyScene scene(kind, squarePatch(3), btVector3(0, 0, 0));
  scene.body().m_cfg.timescale = btScalar(timescale);
  for (int i = 0; i < scene.body().m_nodes.size(); ++i) {
    scene.body().m_nodes[i].m_v = btVector3(0, 1, 0);
    scene.body().m_nodes[i].m_vn = btVector3(0, 1, 0);
  }
  scene.bullet().step(100, btScalar(0.01));
  return meanPosition(scene.body()).y();
}

// The fact.
TEST_IN_EVERY_WORLD(SubstepAndTimescale, InPlainBulletTheDeformableWorldIgnoresTheTimescale) {
  const bool deformable = BulletWorld(GetParam()).isDeformable();
  EXPECT_NEAR(distanceInOneSecond(GetParam(), 1.0), 1.0, 1e-4);
  EXPECT_NEAR(distanceInOneSecond(GetParam(), 0.5), deformable ? 1.0 : 0.5, 1e-4);
}

// Whatever the world does with it, the step that effects see is the time that the body lives through.
TEST_IN_EVERY_WORLD(SubstepAndTimescale, EffectsSeeTheTimeThatTheBodyLivesThrough) {
  for (const double timescale : {0.5, 1.0, 2.0}) {
    const double lived = distanceInOneSecond(GetParam(), timescale);  // at 1 m/s
    BodyScene scene(GetParam(), squarePatch(3));
    scene.body().m_cfg.timescale = btScalar(timescale);
    wetcloth::WetClothWorld wet(scene.world());
    wetcloth::WetCloth& cloth = wet.add(scene.body(), fabricOf(0.84, 2.0));
    cloth.add<wetcloth::Absorption>();
    double told = 0;
    addCall(cloth, [&told](wetcloth::WetCloth&, const wetcloth::Step& step) { told += step.dt; });
    scene.bullet().step(100, btScalar(0.01));
    EXPECT_NEAR(told, lived, 1e-4) << timescale;
    EXPECT_NEAR(cloth.meanSaturation(), 1 - std::exp(-lived / 2.0), 1e-4) << timescale;
  }
}

// A body in falling air, with its timescale: gravity in Step is what Bullet adds.
TEST_IN_EVERY_WORLD(SubstepAndTimescale, GravityToldIsTheOneThatBulletAdds) {
  for (const double timescale : {0.5, 1.0}) {
    BodyScene scene(GetParam(), squarePatch(3));
    scene.body().m_cfg.timescale = btScalar(timescale);
    wetcloth::WetClothWorld wet(scene.world());
    btVector3 told(0, 0, 0);
    addCall(wet.add(scene.body()),
            [&told](wetcloth::WetCloth&, const wetcloth::Step& step) { told += step.gravity * btScalar(step.dt); });
    scene.bullet().step(20);
    EXPECT_NEAR(told.y(), meanVelocity(scene.body()).y(), 1e-3 * std::fabs(told.y())) << timescale;
  }
}

}  // namespace
}  // namespace wetcloth_test::substep_and_timescale_test
