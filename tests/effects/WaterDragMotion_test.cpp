// SPDX-License-Identifier: Zlib
// How a cloth moves in water: sinking and rising against closed forms, currents, stability at any speed and step,
// sleep.

#include "bullet_wetcloth/effects/WaterDrag.h"

#include "tests/support/BodyScene.h"
#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/ClothScene.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Measures.h"
#include "tests/support/Patches.h"

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace wetcloth_test::water_drag_motion_test {
namespace {

using wetcloth::Fabric;
using wetcloth::Hook;
using wetcloth::sinkingSpeed;
using wetcloth::WaterDrag;
using wetcloth::WaterSurface;

constexpr double kGravity = 9.81;

WaterDrag::Parameters deepWater(const btVector3& current = kNoGravity) {
  WaterSurface surface;
  surface.offset = -1000;
  surface.velocity = current;
  WaterDrag::Parameters parameters;
  parameters.surface = surface;
  return parameters;
}

double meanSpeed(ClothScene& scene, std::size_t axis = 1) {
  return momentum(scene.body())[axis] / freeMass(scene.body());
}

// --- sinking and rising -----------------------------------------------------------------------------------------

TEST_IN_EVERY_WORLD(WaterDragMotionInWorld, WetAndDrySinkAtTheSameTerminalSpeed) {
  const double expected = sinkingSpeed(0.150, 1540, 1000, 1.2, kGravity);
  for (const double saturation : {0.0, 0.5, 1.0}) {
    ClothScene scene(GetParam(), kEarthGravity, levelPatch(9, 1));
    scene.addBulletSpringsForStep();
    scene.cloth().add<WaterDrag>(deepWater());
    scene.cloth().setSaturation(saturation);
    scene.step(240);  // 60 times v_T / (g (1 - rho / rho_f)) of the wet cloth
    // Bullet takes velocities from positions: float32 knows 0.03 m to 2e-9 m, which over a substep is 1e-6 m/s; at the
    // patch's edge, 0.5 m, 1e-5 m/s. The step's float dt is 1e-8 off.
    EXPECT_NEAR(-meanSpeed(scene) / expected, 1, kIsDouble ? 1e-6 : 2e-3) << saturation;
  }
}

TEST_IN_EVERY_WORLD(WaterDragMotionInWorld, FibreLighterThanWaterRises) {
  WaterDrag::Parameters parameters = deepWater();
  parameters.fibreDensity = 910;  // polypropylene
  ClothScene scene(GetParam(), kEarthGravity, levelPatch(9, 1));
  scene.addBulletSpringsForStep();
  scene.cloth().add<WaterDrag>(parameters);
  scene.step(480);
  EXPECT_NEAR(-meanSpeed(scene) / sinkingSpeed(0.150, 910, 1000, 1.2, kGravity), 1, kIsDouble ? 1e-5 : 5e-3);
  EXPECT_GT(meanSpeed(scene), 0.01);
}

// v = v_T tanh(t / tau), tau = v_T m / (weight in water): held water weighs nothing but has to be moved along.
TEST_IN_EVERY_WORLD(WaterDragMotionInWorld, AWetClothTakesLongerToGetToSpeed) {
  const double terminal = sinkingSpeed(0.150, 1540, 1000, 1.2, kGravity);
  for (const double saturation : {0.0, 1.0}) {
    ClothScene scene(GetParam(), kEarthGravity, levelPatch(5, 1));
    scene.addBulletSpringsForStep(1.0 / 4096);
    scene.cloth().add<WaterDrag>(deepWater());
    scene.cloth().setSaturation(saturation);
    scene.step(32, 1.0 / 4096);
    const double tau = terminal * (1 + 0.84 * saturation) / (kGravity * (1 - 1000 / 1540.0));
    const double expected = terminal * std::tanh(32.0 / 4096 / tau);
    // First order: dt / tau = 3 % and less; wet and dry differ by 35 %.
    EXPECT_NEAR(-meanSpeed(scene) / expected, 1, 0.03) << saturation;
  }
}

TEST_IN_EVERY_WORLD(WaterDragMotionInWorld, ACurrentCarriesTheClothAlongInTheEnd) {
  ClothScene scene(GetParam(), kNoGravity, levelPatch(5, 1));
  scene.addBulletSpringsForStep();
  scene.cloth().add<WaterDrag>(deepWater(btVector3(0, btScalar(0.5), 0)));
  scene.step(480);
  // u = 1 / (b t), b = rho C_d / (2 sigma) = 4000 / m: 1e-4 m/s is left after 2 s. In float32 Bullet's worlds stop
  // where a step adds less than half the last digit of a velocity taken from positions, b u^2 dt = 1e-5 m/s: u = 8e-4
  // m/s.
  EXPECT_NEAR(meanSpeed(scene), 0.5, kIsDouble ? 1.5e-4 : 2e-3);
}

// It falls from 0.2 m at 2 m/s into water that stops it within centimetres.
TEST_IN_EVERY_WORLD(WaterDragMotionInWorld, AFallingClothIsCaughtByTheWater) {
  WaterDrag::Parameters parameters = deepWater();
  parameters.surface->offset = 0.2;
  ClothScene scene(GetParam(), kEarthGravity, levelPatch(9, 1));
  scene.addBulletSpringsForStep();
  scene.cloth().add<WaterDrag>(parameters);
  scene.step(46);  // 0.192 s: 0.18 m
  EXPECT_NEAR(meanSpeed(scene), -kGravity * 46 * kSubstep, 1e-3);
  scene.step(48);
  EXPECT_GT(meanSpeed(scene), -0.05);
  EXPECT_LT(centreOfMass(scene.body())[1], -0.2);
}

// --- stability --------------------------------------------------------------------------------------------------

TEST_IN_EVERY_WORLD(WaterDragMotionInWorld, ATorrentOfTwoHundredMetresPerSecondIsStable) {
  for (const double dt : {1.0 / 240, 1.0 / 30}) {
    ClothScene scene(GetParam(), kEarthGravity, levelPatch(10, 1, 81 * 1e-5));
    scene.addBulletSpringsForStep(dt);
    scene.cloth().add<WaterDrag>(deepWater(btVector3(0, 200, 0)));
    for (int step = 0; step < 60; ++step) {
      scene.step(1, dt);
      ASSERT_TRUE(isFinite(scene.body())) << step;
      ASSERT_LE(largestSpeed(scene.body()), 200 * (1 + 1e-3)) << step;
    }
  }
}

TEST_IN_EVERY_WORLD(WaterDragMotionInWorld, AClothCutHalfInTheWaterGoesOn) {
  WaterDrag::Parameters parameters = deepWater(btVector3(0, 0, 1));
  parameters.surface->offset = -0.4;
  ClothScene scene(GetParam(), kEarthGravity, hangingPatch(6));
  scene.addBulletSpringsForStep();
  scene.wet().setLog({});
  scene.cloth().add<WaterDrag>(parameters);
  scene.cloth().setSaturation(0.5);
  scene.step(60);
  btSoftBody& body = scene.body();
  ASSERT_TRUE(body.cutLink(body.m_faces[0].m_n[0], body.m_faces[0].m_n[1], btScalar(0.5)));
  scene.step(60);
  EXPECT_EQ(scene.cloth().effects().size(), 1u);
  EXPECT_TRUE(isFinite(body));
}

/// A crumpled sheet: every triangle looks another way.
void crumple(btSoftBody& body, std::mt19937& random) {
  std::uniform_real_distribution<double> offset(-0.1, 0.1);
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    const double x = offset(random);
    const double y = offset(random);
    body.m_nodes[i].m_x += btVector3(btScalar(x), btScalar(y), btScalar(offset(random)));
    body.m_nodes[i].m_v = btVector3(btScalar(90 * y), btScalar(-70 * x), btScalar(100 * x + 50 * y));
  }
}

double kineticEnergy(const btSoftBody& body, const btVector3& frame) {
  double energy = 0;
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    energy += double((body.m_nodes[i].m_v - frame).length2()) / double(body.m_nodes[i].m_im) / 2;
  }
  return energy;
}

TEST(WaterDragStability, EnergyRelativeToTheWaterNeverGrows) {
  const btVector3 current(3, -4, 1);
  for (const double friction : {0.0, 0.01, 3.0}) {
    for (const double level : {-0.02, 0.03, 1000.0}) {
      for (const double dt : {1e-6, 1e-4, 1.0 / 240, 1.0 / 30, 1.0, 1e3}) {
        std::mt19937 random(7);
        ClothScene scene(WorldKind::softRigid, kNoGravity, levelPatch(8, 1), Fabric::cotton(), Hook::manual);
        crumple(scene.body(), random);
        WaterDrag::Parameters parameters = deepWater(current);
        parameters.surface->offset = -level;
        parameters.skinFriction = friction;
        scene.cloth().add<WaterDrag>(parameters);
        double before = kineticEnergy(scene.body(), current);
        for (int step = 0; step < 10; ++step) {
          scene.preTick(dt);
          const double after = kineticEnergy(scene.body(), current);
          ASSERT_LE(after, before * (1 + (kIsDouble ? 1e-14 : 1e-6))) << dt << " " << level << " " << friction;
          before = after;
        }
      }
    }
  }
}

/// Speed after `seconds` of a sheet that starts at 1 m/s across still water, without gravity.
double speedInStillWater(int steps, double seconds) {
  ClothScene scene(WorldKind::softRigid, kNoGravity, levelPatch(4, 1), Fabric::cotton(), Hook::manual);
  scene.cloth().add<WaterDrag>(deepWater());
  setVelocity(scene.body(), btVector3(0, 1, 0));
  for (int i = 0; i < steps; ++i) scene.preTick(seconds / steps);
  return meanSpeed(scene);
}

TEST(WaterDragStability, StepsConvergeToTheClosedForm) {
  // dv/dt = -b v^2: v = 1 / (1 + b t), b = rho C_d / (2 sigma) = 4000 / m.
  const double exact = 1 / (1 + 4000 * 0.001);
  const double coarse = std::fabs(speedInStillWater(64, 0.001) - exact);
  const double fine = std::fabs(speedInStillWater(128, 0.001) - exact);
  EXPECT_NEAR(coarse / fine, 2, 0.1) << "first order";
  EXPECT_LT(fine, 0.03 * exact);  // b v dt, the change in the first step
}

// --- sleep, which only the deformable world knows ---------------------------------------------------------------

TEST_IN_DEFORMABLE_WORLDS(WaterDragSleep, IsEndedByACurrentALevelThatChangesOrDrainedWater) {
  for (const char* change : {"current", "level", "drained"}) {
    BodyScene scene(GetParam(), sailPatch(4), kNoGravity);
    wetcloth::WetClothWorld wet(scene.world());
    WaterDrag::Parameters parameters = deepWater();
    parameters.surface->offset = -0.5;
    WaterDrag& water = wet.add(scene.body()).add<WaterDrag>(parameters);
    scene.bullet().step(5 * 240);
    ASSERT_EQ(scene.body().getActivationState(), ISLAND_SLEEPING);
    WaterSurface surface = *parameters.surface;
    adjust(water, [&](auto& p) { p.surface = surface; });
    scene.bullet().step(60);
    ASSERT_EQ(scene.body().getActivationState(), ISLAND_SLEEPING) << "nothing has changed";
    if (change == std::string("current")) surface.velocity = btVector3(0, 0, btScalar(0.1));
    if (change == std::string("level")) surface.offset = -0.6;
    if (change == std::string("drained")) surface.offset = 3;
    adjust(water, [&](auto& p) { p.surface = surface; });
    scene.bullet().step(2);
    EXPECT_TRUE(scene.body().isActive()) << change;
  }
}

TEST_IN_DEFORMABLE_WORLDS(WaterDragSleep, IsNotDisturbedByWaterFarBelow) {
  BodyScene scene(GetParam(), sailPatch(4), kNoGravity);
  wetcloth::WetClothWorld wet(scene.world());
  WaterDrag::Parameters parameters = deepWater();
  parameters.surface->offset = 3;
  WaterDrag& water = wet.add(scene.body()).add<WaterDrag>(parameters);
  scene.bullet().step(5 * 240);
  WaterSurface surface = *parameters.surface;
  surface.velocity = btVector3(5, 0, 0);
  surface.offset = 2;
  adjust(water, [&](auto& p) { p.surface = surface; });
  scene.bullet().step(10);
  EXPECT_EQ(scene.body().getActivationState(), ISLAND_SLEEPING);
  surface.offset = -0.5;
  adjust(water, [&](auto& p) { p.surface = surface; });
  scene.bullet().step(2);
  EXPECT_TRUE(scene.body().isActive()) << "the flood has reached it";
}

}  // namespace
}  // namespace wetcloth_test::water_drag_motion_test
