// SPDX-License-Identifier: Zlib
// A wet cloth on surfaces: how much it holds, how it lets go, and what it does to rigid bodies.

#include "bullet_wetcloth/bullet/Contacts.h"
#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/CallEffect.h"
#include "tests/support/ClothScene.h"
#include "tests/support/ContactScene.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Measures.h"
#include "tests/support/RigidBody.h"
#include "tests/support/SoftBodies.h"

#include <algorithm>

namespace wetcloth_test::cling_test {
namespace {

using wetcloth::Cling;

constexpr double kGravity = 9.81;

// --- under a ceiling, on a wall
// ---------------------------------------------------------------------------------------

/// A cloth that touches one side of a large box: above it (a ceiling) or beside it (gravity along x).
class Stuck {
 public:
  enum Place { ceiling, wall };
  Stuck(WorldKind kind, Place place, double saturation = 0.5)
      : scene(kind, place == ceiling ? kEarthGravity : btVector3(btScalar(-kGravity), 0, 0), below(kind)),
        slab(scene.bullet(), box(5, 0.5, 5), 0, {0, 0.5, 0}) {
    slab.body().setFriction(0);
    scene.addBulletSpringsForStep();
    scene.cloth().setSaturation(saturation);
  }

  static BodyBuilder below(WorldKind kind) {
    Lying lying;
    lying.height = -0.99 * kMargin;
    return lying.builder(kind);
  }
  /// Weight of the wet cloth per area [Pa].
  double weight() { return scene.cloth().totalMass() / (0.3 * 0.3) * kGravity; }
  std::array<double, 3> centre() { return centreOfMass(scene.body()); }

  ClothScene scene;
  RigidBody slab;
};

Cling::Parameters stress(double adhesion, double shearStrength = 1000) {
  Cling::Parameters parameters;
  parameters.adhesion = adhesion;
  parameters.shearStrength = shearStrength;
  return parameters;
}

TEST_IN_EVERY_WORLD(ClingInWorld, HangsUnderACeilingIfTheAdhesionBearsItsWeight) {
  for (const double share : {1.03, 0.97}) {
    Stuck cloth(GetParam(), Stuck::ceiling);
    Cling& cling = cloth.scene.cloth().add<Cling>(stress(4 * cloth.weight()));
    cloth.scene.step(60);  // by when what it had fallen before the first contact is made good
    const double before = cloth.centre()[1];
    cling.setParameters(stress(share * cloth.weight()));
    cloth.scene.step(240);
    const double fallen = before - cloth.centre()[1];
    if (share > 1) {
      EXPECT_EQ(cling.bonds(), 16);
      EXPECT_LT(std::fabs(fallen), 0.001);
      // A step's fall: the implicit world's solver leaves gravity out of some steps and makes good for it in others.
      EXPECT_LT(largestSpeed(cloth.scene.body()), 1.1 * kGravity * kSubstep);
    } else {
      // Free fall: half a substep of first-order integration.
      EXPECT_EQ(cling.bonds(), 0);
      EXPECT_NEAR(fallen, kGravity / 2, kGravity * kSubstep);
    }
  }
}

TEST_IN_EVERY_WORLD(ClingInWorld, StaysOnAWallIfTheShearStrengthBearsItsWeight) {
  for (const double share : {1.03, 0.97}) {
    Stuck cloth(GetParam(), Stuck::wall);
    Cling& cling = cloth.scene.cloth().add<Cling>(stress(1000));
    cloth.scene.step(60);
    const double before = cloth.centre()[0];
    cling.setParameters(stress(1000, share * cloth.weight()));
    cloth.scene.step(240);
    const double slid = before - cloth.centre()[0];
    if (share > 1) {
      EXPECT_LT(std::fabs(slid), 0.001);
    } else {
      // Held back by 0.97 of its weight.
      EXPECT_NEAR(slid, 0.03 * kGravity / 2, 0.1 * 0.03 * kGravity / 2);
    }
  }
}

TEST_IN_EVERY_WORLD(ClingInWorld, DryItIsAsIfItWereNotThere) {
  for (const double saturation : {0.0, 0.09}) {
    Stuck with(GetParam(), Stuck::ceiling, saturation);
    Stuck without(GetParam(), Stuck::ceiling, saturation);
    Cling& cling = with.scene.cloth().add<Cling>();
    with.scene.step(30);
    without.scene.step(30);
    EXPECT_TRUE(sameBits(stateOf(with.scene.body()), stateOf(without.scene.body())));
    EXPECT_EQ(cling.nodesVisited(), 0);
  }
}

TEST_IN_EVERY_WORLD(ClingInWorld, OnAFloorItPressesNowhere) {
  ClothScene scene(GetParam(), kEarthGravity, Lying().builder(GetParam()));
  RigidBody floor(scene.bullet(), box(5, 0.5, 5), 0, {0, -0.5, 0});
  scene.addBulletSpringsForStep();
  scene.cloth().setSaturation(0.5);
  scene.cloth().add<Cling>();
  scene.step(240);
  EXPECT_NEAR(centreOfMass(scene.body())[1], kMargin, 0.1 * kMargin);
  EXPECT_LT(largestSpeed(scene.body()), 0.02);
}

TEST_IN_EVERY_WORLD(ClingInWorld, DryingLetsItGo) {
  Stuck cloth(GetParam(), Stuck::ceiling);
  Cling& cling = cloth.scene.cloth().add<Cling>();
  cloth.scene.step(60);
  ASSERT_EQ(cling.bonds(), 16);
  cloth.scene.cloth().setSaturation(0.05);
  cloth.scene.step(120);
  EXPECT_EQ(cling.bonds(), 0);
  EXPECT_NEAR(-cloth.centre()[1], kGravity / 8, 0.1);
}

// Pulled off with a force per area that grows by 10 Pa a second; weight counts.
TEST_IN_EVERY_WORLD(ClingInWorld, ComesOffASphereAtItsAdhesion) {
  Lying lying;
  lying.n = 2;
  lying.side = 0.04;
  lying.height = 1 + kMargin * 0.95;
  ClothScene scene(GetParam(), kEarthGravity, lying.builder(GetParam()));
  RigidBody sphere(scene.bullet(), std::make_unique<btSphereShape>(btScalar(1)), 0, {0, 0, 0});
  scene.addBulletSpringsForStep();
  scene.cloth().setSaturation(0.5);
  const double area = 0.04 * 0.04;
  double pulled = 0;
  addCall(scene.cloth(), [&](wetcloth::WetCloth& cloth, const wetcloth::Step& step) {
    pulled = 20 * std::max(0.0, step.time - 0.25);
    const double acceleration = pulled * area / cloth.totalMass();
    for (int i = 0; i < 4; ++i) {
      cloth.push(cloth.body().m_nodes[i], btVector3(0, btScalar(acceleration * step.dt), 0));
    }
  });
  Cling& cling = scene.cloth().add<Cling>(stress(15));
  scene.step(60);
  ASSERT_EQ(cling.bonds(), 4);
  const double weight = scene.cloth().totalMass() * kGravity / area;
  while (cling.bonds() > 0 && pulled < 100) scene.step(1);
  // A step late, and the corners of the patch look 2 degrees aside.
  EXPECT_NEAR(pulled, 15 + weight, 0.05 * (15 + weight));
  // Let go, it moves by what pulls it and no more: no node is faster than a few steps of it.
  const double net = (pulled - weight) * area / scene.cloth().totalMass();
  EXPECT_LT(largestSpeed(scene.body()), 5 * net * kSubstep);
}

TEST_IN_EVERY_WORLD(ClingInWorld, ABondThatLetsGoAddsNoEnergy) {
  Stuck cloth(GetParam(), Stuck::ceiling);
  Cling& cling = cloth.scene.cloth().add<Cling>(stress(4 * cloth.weight()));
  cloth.scene.step(120);
  ASSERT_EQ(cling.bonds(), 16);
  cling.setParameters(stress(0.5 * cloth.weight()));
  const double height = cloth.centre()[1];
  double fastest = 0;
  for (int i = 1; i <= 60; ++i) {
    cloth.scene.step(1);
    fastest = std::max(fastest, largestSpeed(cloth.scene.body()) - i * kGravity * kSubstep);
  }
  EXPECT_EQ(cling.bonds(), 0);
  // What the bonds had given to bring nodes back to their places, 1e-4 m in a step.
  EXPECT_LT(fastest, 0.025);
  EXPECT_LT(cloth.centre()[1], height);
}

// --- rigid bodies that move
// -------------------------------------------------------------------------------------------

// No gravity; the cloth is thrown along a floating box that it clings to.
TEST_IN_EVERY_WORLD(ClingInWorld, TheBodyGetsWhatTheClothLoses) {
  ClothScene scene(GetParam(), {0, 0, 0}, Stuck::below(GetParam()));
  RigidBody slab(scene.bullet(), box(0.5, 0.1, 0.5), 0.5, {0, btScalar(0.1), 0});
  slab.body().setFriction(0);
  slab.body().setSleepingThresholds(0, 0);
  scene.addBulletSpringsForStep();
  scene.cloth().setSaturation(0.5);
  Cling& cling = scene.cloth().add<Cling>(stress(1000, 2));
  scene.step(30);
  ASSERT_EQ(cling.bonds(), 16);
  for (int i = 0; i < scene.body().m_nodes.size(); ++i) {
    scene.node(i).m_v += btVector3(btScalar(0.3), 0, 0);
    scene.node(i).m_vn += btVector3(btScalar(0.3), 0, 0);
  }
  const auto total = [&](int axis) {
    return momentum(scene.body())[std::size_t(axis)] + 0.5 * double(slab.body().getLinearVelocity()[axis]);
  };
  const double before = total(0);
  scene.step(10);
  EXPECT_GT(double(slab.body().getLinearVelocity().x()), 1e-3);
  // Bullet's solver takes positions for velocities: a last digit of 1e-8 m is 2e-6 m/s, in each step and node. The
  // implicit world's solve is no closer than 1e-5.
  const double tolerance = kIsDouble ? 2e-6 : 1e-4;
  EXPECT_NEAR(total(0), before, std::max(tolerance, 1e-4 * before));
  scene.step(200);
  const double common = before / (freeMass(scene.body()) + 0.5);
  EXPECT_NEAR(double(slab.body().getLinearVelocity().x()), common, 0.05 * common) << "in the end both move alike";
}

TEST_IN_EVERY_WORLD(ClingInWorld, GoesWithAKinematicBody) {
  Stuck cloth(GetParam(), Stuck::ceiling);
  Cling& cling = cloth.scene.cloth().add<Cling>(stress(200, 200));
  btRigidBody& slab = cloth.slab.body();
  slab.setCollisionFlags(slab.getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
  slab.setActivationState(DISABLE_DEACTIVATION);
  cloth.scene.step(30);
  for (int i = 0; i < 240; ++i) {
    btTransform frame = slab.getWorldTransform();
    frame.getOrigin() += btVector3(btScalar(0.2 * kSubstep), btScalar(0.1 * kSubstep), 0);
    slab.setWorldTransform(frame);
    cloth.scene.step(1);
  }
  EXPECT_EQ(cling.bonds(), 16);
  EXPECT_NEAR(cloth.centre()[0], 0.2, 0.005);
  EXPECT_NEAR(cloth.centre()[1], 0.1 - kMargin, 0.005);
}

TEST_IN_EVERY_WORLD(ClingInWorld, LetsGoOfABodyThatLeavesTheWorld) {
  Lying lying;
  lying.height = -0.99 * kMargin;
  ClothScene scene(GetParam(), kEarthGravity, lying.builder(GetParam()));
  scene.addBulletSpringsForStep();
  scene.cloth().setSaturation(0.5);
  Cling& cling = scene.cloth().add<Cling>();
  {
    RigidBody slab(scene.bullet(), box(5, 0.5, 5), 0, {0, 0.5, 0});
    scene.step(60);
    ASSERT_EQ(cling.bonds(), 16);
  }
  scene.step(1);  // the sanitizers see to it that nobody looks at the slab
  EXPECT_EQ(cling.bonds(), 0);
}

TEST_IN_EVERY_WORLD(ClingInWorld, HoldsOnThroughACut) {
  Stuck cloth(GetParam(), Stuck::ceiling);
  cloth.scene.wet().setLog({});
  Cling& cling = cloth.scene.cloth().add<Cling>(stress(2000));
  cloth.scene.step(30);
  btSoftBody& body = cloth.scene.body();
  ASSERT_TRUE(body.cutLink(body.m_faces[0].m_n[0], body.m_faces[0].m_n[1], btScalar(0.5)));
  cloth.scene.step(60);
  EXPECT_GE(cling.bonds(), 14) << "the two nodes at the cut hang from new ones, of 1 kg each";
  EXPECT_TRUE(isFinite(body));
}

TEST_IN_EVERY_WORLD(ClingInWorld, IsFiniteForAnyStep) {
  for (const double dt : {1e-6, 1e-2, 1.0, 1e3}) {
    Stuck cloth(GetParam(), Stuck::ceiling);
    cloth.scene.cloth().add<Cling>();
    cloth.scene.step(3);
    for (int i = 0; i < 3; ++i) cloth.scene.preTick(dt);
    EXPECT_TRUE(isFinite(cloth.scene.body())) << dt;
  }
}

// A cloth that fell asleep under a ceiling falls when the ceiling is taken away.
TEST(ClingAsleep, WakesWhenItsHoldGoes) {
  for (const bool moves : {true, false}) {
    Lying lying;
    lying.height = -0.99 * kMargin;
    ClothScene scene(WorldKind::deformable, kEarthGravity, lying.builder(WorldKind::deformable));
    scene.body().forceActivationState(ACTIVE_TAG);
    auto slab = std::make_unique<RigidBody>(scene.bullet(), box(5, 0.5, 5), 0, btVector3(0, 0.5, 0));
    scene.cloth().setSaturation(0.5);
    Cling& cling = scene.cloth().add<Cling>();
    scene.step(1500);
    ASSERT_EQ(cling.bonds(), 16);
    ASSERT_FALSE(scene.body().isActive());
    if (moves) {
      slab->body().getWorldTransform().setOrigin({0, 5, 0});
    } else {
      slab.reset();
    }
    scene.step(120);
    EXPECT_LT(centreOfMass(scene.body())[1], -0.5) << moves;
  }
}

}  // namespace
}  // namespace wetcloth_test::cling_test
