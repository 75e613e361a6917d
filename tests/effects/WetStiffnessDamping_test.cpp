// SPDX-License-Identifier: Zlib
// Damping along links: exact for one link, never more energy, momentum and spin kept, in every world.

#include "bullet_wetcloth/effects/WetStiffness.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/ClothScene.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Measures.h"
#include "tests/support/Patches.h"
#include "tests/support/SoftBodies.h"

#include <cmath>
#include <random>
#include <vector>

namespace wetcloth_test::wet_stiffness_damping_test {
namespace {

using wetcloth::Fabric;
using wetcloth::Hook;
using wetcloth::HookeSprings;
using wetcloth::WetStiffness;

// Each link's impulse is rounded once for each of its ends: 1e-12 and 1e-5 leave room for a sum of them.
constexpr double kRounding = kIsDouble ? 1e-12 : 1e-5;

WetStiffness::Parameters damping(double dry, double wet) { return {1, 1, dry, wet}; }

/// Two nodes of 0.01 and 0.04 kg on the x axis, 1 m apart, and a link.
BodyBuilder pair() {
  return [](btSoftBodyWorldInfo& info) {
    const btVector3 positions[] = {btVector3(0, 0, 0), btVector3(1, 0, 0)};
    const btScalar masses[] = {btScalar(0.01), btScalar(0.04)};
    auto body = std::make_unique<btSoftBody>(&info, 2, positions, masses);
    body->appendLink(0, 1);
    return body;
  };
}

void setNodeVelocity(btSoftBody::Node& node, const btVector3& velocity) { node.m_v = node.m_vn = velocity; }

void setRandomVelocities(btSoftBody& body) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> speed(-1, 1);
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    const double x = speed(random);
    const double y = speed(random);
    const btVector3 velocity(btScalar(x), btScalar(y), btScalar(speed(random)));
    if (body.m_nodes[i].m_im > 0) setNodeVelocity(body.m_nodes[i], velocity);
  }
}

double energy(const btSoftBody& body) {
  double sum = 0;
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    const btSoftBody::Node& node = body.m_nodes[i];
    if (node.m_im > 0) sum += double(node.m_v.length2()) / double(node.m_im) / 2;
  }
  return sum;
}

double spin(const btSoftBody& body, int axis) {
  double sum = 0;
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    const btSoftBody::Node& node = body.m_nodes[i];
    sum += double(node.m_x.cross(node.m_v)[axis]) / double(node.m_im);
  }
  return sum;
}

TEST_IN_EVERY_WORLD(WetStiffnessDamping, OneLinkLosesItsRelativeSpeedExponentiallyWhateverTheStep) {
  for (double saturation : {0.0, 0.25, 1.0}) {
    const double rate = 1 + 2 * saturation;
    for (double dt : {1e-6, 1e-3, 0.1, 1.0, 1e3}) {
      ClothScene scene(GetParam(), kNoGravity, pair(), Fabric::cotton(), Hook::manual);
      scene.cloth().add<WetStiffness>(damping(1, 3));
      scene.cloth().setSaturation(saturation);
      setNodeVelocity(scene.node(0), btVector3(2, 1, 0));
      setNodeVelocity(scene.node(1), btVector3(-1, 5, 3));
      const auto before = momentum(scene.body());
      scene.preTick(dt);
      const btVector3 relative = scene.node(1).m_v - scene.node(0).m_v;
      // float32 cannot show a change of less than 6e-8 of a velocity.
      EXPECT_NEAR(double(relative.x()), -3 * std::exp(-rate * dt), 3 * (kIsDouble ? 1e-14 : 3e-7)) << dt;
      EXPECT_EQ(relative.y(), 4);
      EXPECT_EQ(relative.z(), 3);
      // The deformable world starts from m_vn.
      EXPECT_TRUE(!scene.bullet().isDeformable() || scene.node(0).m_v == scene.node(0).m_vn);
      for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(momentum(scene.body())[k], before[k], kRounding) << k;
    }
  }
}

// With springs too weak to be felt, so that nothing but the damping acts, the whole of Bullet's step included.
TEST_IN_EVERY_WORLD(WetStiffnessDamping, SlowsTwoNodesInARunningWorld) {
  ClothScene scene(GetParam(), kNoGravity, pair());
  HookeSprings::Parameters weak;
  weak.stiffness = 1e-9;
  scene.cloth().add<HookeSprings>(weak);
  scene.cloth().add<WetStiffness>(damping(0, 2));
  scene.step(1);
  scene.cloth().setSaturation(1);
  setNodeVelocity(scene.node(0), btVector3(-2, 0, 0));
  setNodeVelocity(scene.node(1), btVector3(btScalar(0.5), 0, 0));
  scene.step(240);
  const double left = double(scene.node(1).m_v.x() - scene.node(0).m_v.x());
  // Bullet takes the step as float, 1e-7 of it; the springs pull 1e-9 N on 0.01 kg for a second. The position-based
  // worlds take the velocity from the change of place, which float32 knows to 6e-8 m / dt = 1.4e-5 m/s.
  EXPECT_NEAR(left, 2.5 * std::exp(-2), kIsDouble ? 1e-6 : 1e-3);
  EXPECT_NEAR(momentum(scene.body())[0], 0, 0.02 * (kIsDouble ? 1e-6 : 1e-3));
}

TEST_IN_EVERY_WORLD(WetStiffnessDamping, NeverAddsEnergyAndKeepsMomentumAndSpin) {
  for (double dt : {1e-3, 0.05, 1e3}) {
    ClothScene scene(GetParam(), kNoGravity, levelPatch(6, 1), Fabric::cotton(), Hook::manual);
    scene.cloth().add<WetStiffness>(damping(5, 20));
    std::vector<double> held;
    for (int i = 0; i < 36; ++i) held.push_back(scene.cloth().capacity(i) * (i % 5) / 4.0);
    scene.cloth().setHeld(held);
    setRandomVelocities(scene.body());
    const auto before = momentum(scene.body());
    const double spinBefore[] = {spin(scene.body(), 0), spin(scene.body(), 1), spin(scene.body(), 2)};
    const double scale = scene.cloth().totalMass();
    const double first = energy(scene.body());
    double last = first;
    for (int i = 0; i < 100; ++i) {
      scene.preTick(dt);
      const double now = energy(scene.body());
      // Where nothing is left to damp, float32 may round each velocity up.
      ASSERT_LE(now, last * (1 + (kIsDouble ? 1e-14 : 1e-6))) << i;
      last = now;
    }
    EXPECT_LT(last, 0.9 * first);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(momentum(scene.body())[std::size_t(k)], before[std::size_t(k)], kRounding * scale) << dt << " " << k;
      EXPECT_NEAR(spin(scene.body(), k), spinBefore[k], 10 * kRounding * scale) << dt << " " << k;
    }
  }
}

TEST_IN_EVERY_WORLD(WetStiffnessDamping, LeavesAClothThatMovesAsOnePieceAlone) {
  ClothScene scene(GetParam(), kNoGravity, levelPatch(6, 1), Fabric::cotton(), Hook::manual);
  scene.cloth().add<WetStiffness>(damping(100, 100));
  const btVector3 turn(btScalar(0.3), -2, 1);
  for (int i = 0; i < 36; ++i) setNodeVelocity(scene.node(i), btVector3(1, 2, 3) + turn.cross(scene.node(i).m_x));
  std::vector<btVector3> before;
  for (int i = 0; i < 36; ++i) before.push_back(scene.node(i).m_v);
  for (int i = 0; i < 10; ++i) scene.preTick(1);
  // Differences of velocities near 4 m/s, rounded.
  for (int i = 0; i < 36; ++i) {
    EXPECT_LT((scene.node(i).m_v - before[std::size_t(i)]).length(), kIsDouble ? 1e-13 : 2e-5) << i;
  }
}

TEST_IN_EVERY_WORLD(WetStiffnessDamping, APinnedNodeIsAnInfiniteMass) {
  ClothScene scene(GetParam(), kNoGravity, hangingRope(1, 1, 0.01), Fabric::cotton(), Hook::manual);
  scene.cloth().add<WetStiffness>(damping(2, 2));
  setNodeVelocity(scene.node(1), btVector3(1, 4, 0));
  scene.preTick(0.5);
  EXPECT_EQ(scene.node(0).m_v, btVector3(0, 0, 0));
  EXPECT_NEAR(double(scene.node(1).m_v.y()), 4 * std::exp(-1), kRounding);
  EXPECT_EQ(scene.node(1).m_v.x(), 1);
}

TEST_IN_EVERY_WORLD(WetStiffnessDamping, DoesNoWorkWhenThereIsNone) {
  ClothScene scene(GetParam(), kNoGravity, levelPatch(5, 1), Fabric::cotton(), Hook::manual);
  WetStiffness& effect = scene.cloth().add<WetStiffness>(damping(0, 0));
  setRandomVelocities(scene.body());
  const btVector3 before = scene.node(7).m_v;
  scene.preTick(1);
  EXPECT_EQ(effect.linksVisited(), 0);
  EXPECT_EQ(scene.node(7).m_v, before);
  adjust(effect, [](auto& p) {
    p.dryDamping = 1;
    p.wetDamping = 1;
  });
  scene.preTick(1);
  EXPECT_EQ(effect.linksVisited(), scene.body().m_links.size());
  EXPECT_NE(scene.node(7).m_v, before);
  scene.body().forceActivationState(ISLAND_SLEEPING);
  scene.preTick(1);
  EXPECT_EQ(effect.linksVisited(), scene.body().m_links.size()) << "a sleeping cloth";
}

TEST_IN_EVERY_WORLD(WetStiffnessDamping, WritesNothingThatIsNotFinite) {
  ClothScene scene(GetParam(), kNoGravity, levelPatch(4, 1), Fabric::cotton(), Hook::manual);
  scene.cloth().add<WetStiffness>(damping(1, 1));
  setRandomVelocities(scene.body());
  scene.node(1).m_x = scene.node(0).m_x;  // a link without length
  scene.node(5).m_v.setX(btScalar(NAN));
  scene.preTick(1);
  for (int i = 0; i < 16; ++i) {
    EXPECT_TRUE(i == 5 || std::isfinite(double(scene.node(i).m_v.length2()))) << i;
  }
}

}  // namespace
}  // namespace wetcloth_test::wet_stiffness_damping_test
