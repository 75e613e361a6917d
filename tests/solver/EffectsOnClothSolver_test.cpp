// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/solver/SolverScene.h"
#include "tests/support/CallEffect.h"
#include "tests/support/Measures.h"

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace wetcloth_test::effects_on_cloth_solver_test {
namespace {

// A sail in still space, in a world of its own, with effects on it.
struct Sail {
  explicit Sail(bool isOnSolver, wetcloth::Hook hook = wetcloth::Hook::preTick, double away = 0)
      : bullet(WorldKind::softRigid, kNoGravity, isOnSolver ? &solver : nullptr) {
    wetcloth::ClothPatch patch = sailPatch(12);
    patch.origin.setX(btScalar(away));
    body = patch.build(bullet.info());
    bullet.add(*body);
    wet = std::make_unique<wetcloth::WetClothWorld>(bullet.world(), hook);
    cloth = &wet->add(*body);
  }
  ~Sail() { bullet.remove(*body); }

  wetcloth::ClothSolver solver;
  BulletWorld bullet;
  std::unique_ptr<btSoftBody> body;
  std::unique_ptr<wetcloth::WetClothWorld> wet;
  wetcloth::WetCloth* cloth = nullptr;
};

void addWind(Sail& sail) {
  wetcloth::Wind::Parameters gusts;
  gusts.velocity = [](const btVector3& place, double) {
    return btVector3(0, 0, btScalar(2) + btFabs(btScalar(4) * (place.y() - btScalar(0.5))));
  };
  sail.cloth->add<wetcloth::Wind>(gusts);
}

// What the air gives is what the cloth has: nothing is lost between our arrays and Bullet's nodes.
void expectMomentumOfForce(Sail& sail, const btVector3& force, double before) {
  const double dt = 1.0 / 60;
  EXPECT_GT(double(force.z()), 1e-3);
  EXPECT_NEAR(momentum(*sail.body)[2] - before, double(force.z()) * dt, 1e-4 * double(force.z()) * dt + 1e-7);
}

TEST(EffectsOnClothSolver, WindGivesTheMomentumThatItSays) {
  for (const double away : {0.0, 500.0}) {
    Sail sail(true, wetcloth::Hook::preTick, away);
    addWind(sail);
    for (int step = 0; step < 5; ++step) {
      const double before = momentum(*sail.body)[2];
      sail.bullet.step(1, btScalar(1) / 60);
      expectMomentumOfForce(sail, sail.cloth->find<wetcloth::Wind>()->totalForce(), before);
    }
  }
}

TEST(EffectsOnClothSolver, TheirForcesAreThoseOnBulletsSolver) {
  Sail ours(true);
  Sail bullets(false);
  for (Sail* const sail : {&ours, &bullets}) {
    addWind(*sail);
    wetcloth::WaterDrag::Parameters pool;
    wetcloth::WaterSurface surface;
    surface.offset = -0.4;
    surface.velocity = btVector3(0, 0, 1);
    pool.surface = surface;
    sail->cloth->add<wetcloth::WaterDrag>(pool);
    sail->bullet.step(1, btScalar(1) / 60);
  }
  const auto air = [](Sail& sail) { return sail.cloth->find<wetcloth::Wind>()->totalForce(); };
  const auto water = [](Sail& sail) { return sail.cloth->find<wetcloth::WaterDrag>()->totalForce(); };
  // The first step is the same but for the order of sums.
  EXPECT_LT(double((air(ours) - air(bullets)).length()), 1e-4 * double(air(bullets).length()));
  EXPECT_LT(double((water(ours) - water(bullets)).length()), 1e-4 * double(water(bullets).length()));
  EXPECT_GT(double(water(bullets).length()), 1e-3);
}

TEST(EffectsOnClothSolver, EffectsThatPushNodesAndEffectsThatPushArraysAddUp) {
  Sail sail(true);
  addWind(sail);
  const auto kick = [](wetcloth::WetCloth& cloth, const wetcloth::Step&) {
    for (int k = 0; k < cloth.nodeCount(); ++k) cloth.push(cloth.body().m_nodes[k], btVector3(0, 0, 1));
  };
  addCall(*sail.cloth, kick);
  addWind(sail);
  sail.bullet.step(1, btScalar(1) / 60);
  double given = freeMass(*sail.body);
  sail.cloth->forEach<wetcloth::Wind>([&](wetcloth::Wind& wind) { given += double(wind.totalForce().z()) / 60; });
  EXPECT_NEAR(momentum(*sail.body)[2], given, 1e-4 * given);
}

TEST(EffectsOnClothSolver, NothingIsLostWhereTheApplicationCallsUs) {
  Sail sail(true, wetcloth::Hook::manual);
  addWind(sail);
  const double before = momentum(*sail.body)[2];
  sail.wet->preTick(btScalar(1) / 60);
  const btVector3 force = sail.cloth->find<wetcloth::Wind>()->totalForce();
  expectMomentumOfForce(sail, force, before);  // the nodes know at once
  sail.bullet.step(1, btScalar(1) / 60);
  expectMomentumOfForce(sail, force, before);
}

TEST(EffectsOnClothSolver, ADirectPushAfterTheStepOfTheEffectsCounts) {
  Sail sail(true);
  addWind(sail);
  // Another cloth's effect pushes this one, after it has had its turn.
  std::unique_ptr<btSoftBody> other = squarePatch(3).build(sail.bullet.info());
  sail.bullet.add(*other);
  wetcloth::WetCloth& pusher = sail.wet->add(*other);
  const auto kick = [&](wetcloth::WetCloth&, const wetcloth::Step&) {
    for (int k = 0; k < sail.cloth->nodeCount(); ++k) sail.cloth->push(sail.body->m_nodes[k], btVector3(0, 0, 1));
  };
  addCall(pusher, kick);
  sail.bullet.step(1, btScalar(1) / 60);
  const double given = freeMass(*sail.body) + double(sail.cloth->find<wetcloth::Wind>()->totalForce().z()) / 60;
  EXPECT_NEAR(momentum(*sail.body)[2], given, 1e-4 * given);
  sail.bullet.remove(*other);
}

// How far the lower corner of a hanging cloth, whose links are springs of this stiffness [N/m], is below its place
// after 5 s, with this much water and these effects [m].
double dropOf(double stiffness, double saturation, const std::function<void(wetcloth::WetCloth&)>& addEffects) {
  SolverScene scene(WorldKind::softRigid, kEarthGravity, smallSteps(20, stiffness));
  btSoftBody& body = scene.add(hangingPatch(8));
  body.m_cfg.kDP = btScalar(0.05);
  wetcloth::WetClothWorld wet(scene.bullet().world());
  wetcloth::WetCloth& cloth = wet.add(body);
  cloth.setSaturation(saturation);
  addEffects(cloth);
  scene.step(300);
  return -double(body.m_nodes[0].m_x.y());
}

TEST(EffectsOnClothSolver, WetWeightStretchesAHangingCloth) {
  const auto none = [](wetcloth::WetCloth&) {};
  const double dry = dropOf(20, 0, none);
  const double soaked = dropOf(20, 1, none);
  const double massRatio = 1 + wetcloth::Fabric::cotton().capacity;
  EXPECT_GT(dry, 0.004);
  EXPECT_NEAR(soaked / dry, massRatio, 0.1 * massRatio);
}

TEST(EffectsOnClothSolver, WetStiffnessSoftensItsLinks) {
  const auto soakedDrop = [](double factor) {
    return dropOf(200, 1, [=](wetcloth::WetCloth& cloth) {
      cloth.add<wetcloth::WetStiffness>({factor, factor, 1, 1});
    });
  };
  const double stiff = soakedDrop(1);
  EXPECT_NEAR(soakedDrop(0.5) / stiff, 2, 0.15);
}

// One node of a long rope is wet, so that two links of 80 change: each by half of the strain, as its mean saturation is
// a half. All links are looked at within 64 steps; it takes some more until nothing moves any longer.
TEST(EffectsOnClothSolver, LinksFollowTheLengthsOfSwelling) {
  constexpr int kLinks = 80;
  constexpr int kWet = 41;
  constexpr double kStrain = -0.2;
  SolverScene scene(WorldKind::softRigid, kNoGravity);
  btSoftBody& rope = scene.add(hangingRope(kLinks, 0.05, 0.002, false));
  rope.m_cfg.kDP = btScalar(0.2);
  wetcloth::WetClothWorld wet(scene.bullet().world());
  wetcloth::WetCloth& cloth = wet.add(rope);
  wetcloth::Swelling::Parameters parameters;
  parameters.saturatedStrain = kStrain;
  cloth.add<wetcloth::Swelling>(parameters);
  scene.step(5);
  std::vector<double> held(kLinks + 1, 0);
  held[kWet] = cloth.capacity(kWet);
  cloth.setHeld(held);
  const auto lengthOver = [&](int first, int last) {
    return double((rope.m_nodes[first].m_x - rope.m_nodes[last].m_x).length());
  };
  scene.step(64);
  EXPECT_LT(lengthOver(kWet - 1, kWet + 1), 0.1 * (1 + 0.9 * kStrain / 2));
  scene.step(240);
  for (int k = 0; k < kLinks; ++k) {
    const double strain = k == kWet - 1 || k == kWet ? kStrain / 2 : 0;
    EXPECT_NEAR(lengthOver(k, k + 1), 0.05 * (1 + strain), 1e-4 * 0.05) << k;
  }
  cloth.setSaturation(0);
  scene.step(64 + 240);
  EXPECT_NEAR(lengthOver(kWet - 1, kWet + 1), 0.1, 1e-5);
}

}  // namespace
}  // namespace wetcloth_test::effects_on_cloth_solver_test
