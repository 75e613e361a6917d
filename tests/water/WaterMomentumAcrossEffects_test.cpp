// SPDX-License-Identifier: Zlib
// Effects that follow each other in one step keep the momentum together, however much water arrived in it, is passed on
// and leaves again.

#include "bullet_wetcloth/bullet/Contacts.h"
#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/CallEffect.h"
#include "tests/support/ContactScene.h"
#include "tests/support/ExactPace.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Materials.h"
#include "tests/support/Measures.h"
#include "tests/support/Patches.h"

namespace wetcloth_test::water_momentum_across_effects_test {
namespace {

using Vector = std::array<double, 3>;

// Some thirty velocities of a few m/s, each rounded to Bullet's scalar a few times.
constexpr double kTolerance = kIsDouble ? 1e-12 : 1e-5;

Vector plus(const Vector& a, const Vector& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

Vector times(const btVector3& v, double mass) {
  return {mass * double(v.x()), mass * double(v.y()), mass * double(v.z())};
}

void scatterVelocities(btSoftBody& body, unsigned turn = 0) {
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    const int k = i + int(turn);
    body.m_nodes[i].m_v = btVector3(btScalar(0.3 * (k % 5)), btScalar(-1 + 0.2 * (k % 7)), btScalar(0.1 * (k % 11)));
    body.m_nodes[i].m_vn = body.m_nodes[i].m_v;
  }
}

/// Momentum of all nodes; what arrived and is not committed yet would be missing.
Vector momentumOf(const wetcloth::WetCloth& cloth) {
  Vector sum = {0, 0, 0};
  for (int i = 0; i < cloth.nodeCount(); ++i) {
    sum = plus(sum, times(cloth.body().m_nodes[i].m_v, cloth.dryMass(i) + cloth.held(i)));
  }
  return sum;
}

void expectNear(const Vector& actual, const Vector& expected, double scale) {
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(actual[k], expected[k], kTolerance * scale) << k;
}

/// A level cloth of 4 x 4 nodes; only our part of the step.
class OneCloth {
 public:
  explicit OneCloth(WorldKind kind)
      : m_scene(kind, squarePatch(4)),
        m_wet(m_scene.world(), wetcloth::Hook::manual),
        cloth(exactly(m_wet.add(m_scene.body(), fabricOf(200, 1)))) {
    scatterVelocities(m_scene.body());
  }
  /// Water of 100 times a node's dry mass falls on node 5, at 9 m/s, and a little on its neighbour.
  void pour() {
    arrived = plus(times(btVector3(0, -9, 0), 100 * cloth.dryMass(5)), times(btVector3(3, 0, 0), cloth.dryMass(6)));
    addCall(
        cloth,
        [](wetcloth::WetCloth& c, const wetcloth::Step&) {
          c.water().absorb(5, 100 * c.water().dryMass(5), 0, -9, 0);
          c.water().absorb(6, c.water().dryMass(6), 3, 0, 0);
        },
        wetcloth::Stage::sources);
  }
  void wetUnevenly() {
    std::vector<double> held;
    for (int i = 0; i < cloth.nodeCount(); ++i) held.push_back(cloth.capacity(i) * (i % 4) / 4);
    cloth.setHeld(held);
  }
  void step(double dt) { m_wet.preTick(btScalar(dt)); }
  double scale() const { return 10 * cloth.totalMass(); }

 private:
  BodyScene m_scene;
  wetcloth::WetClothWorld m_wet;

 public:
  wetcloth::WetCloth& cloth;
  Vector arrived = {0, 0, 0};
};

wetcloth::Diffusion::Parameters fast() {
  wetcloth::Diffusion::Parameters parameters;
  parameters.warpDiffusivity = parameters.weftDiffusivity = 1;
  parameters.exponent = 0;
  return parameters;
}

TEST_IN_EVERY_WORLD(WaterMomentumAcrossEffects, WhatArrivesAndWicksOnAtOnce) {
  OneCloth one(GetParam());
  one.pour();
  one.cloth.add<wetcloth::Diffusion>(fast());
  const Vector before = momentumOf(one.cloth);
  one.step(1e3);
  ASSERT_LT(one.cloth.held(5), 50 * one.cloth.dryMass(5)) << "most of it has been passed on";
  expectNear(momentumOf(one.cloth), plus(before, one.arrived), one.scale());
  EXPECT_LE(largestSpeed(one.cloth.body()), 9.5) << "no faster than what struck it";
}

TEST_IN_EVERY_WORLD(WaterMomentumAcrossEffects, RunOffThatMeetsWaterOnTheMove) {
  OneCloth one(GetParam());
  one.wetUnevenly();
  const double off = 20 * one.cloth.dryMass(3);
  addCall(
      one.cloth, [&](wetcloth::WetCloth& c, const wetcloth::Step&) { c.water().runOff(3, off, 0, -9, 0); },
      wetcloth::Stage::sources);
  // What ran off left with the velocity that the node had then: it is gone before the water spreads.
  btVector3 atImpact(0, 0, 0);
  {
    const btVector3 v = one.cloth.body().m_nodes[3].m_v;
    const double mass = one.cloth.dryMass(3) + one.cloth.held(3);
    atImpact = v + (btVector3(0, -9, 0) - v) * btScalar(off / (off + mass));
  }
  one.cloth.add<wetcloth::Diffusion>(fast());
  const Vector before = plus(momentumOf(one.cloth), times(btVector3(0, -9, 0), off));
  one.step(1e3);
  expectNear(plus(momentumOf(one.cloth), times(atImpact, off)), before, one.scale());
}

TEST_IN_EVERY_WORLD(WaterMomentumAcrossEffects, DampedLinksAmongWaterOnTheMove) {
  OneCloth one(GetParam());
  one.wetUnevenly();
  one.pour();
  one.cloth.add<wetcloth::Diffusion>(fast());
  one.cloth.add<wetcloth::WetStiffness>({1, 1, 50, 50});
  const Vector before = momentumOf(one.cloth);
  one.step(0.02);
  expectNear(momentumOf(one.cloth), plus(before, one.arrived), one.scale());
}

// A drop takes the velocity that its node has got by what fell on it in the same step.
TEST_IN_EVERY_WORLD(WaterMomentumAcrossEffects, DropsTakeTheVelocityOfTheNodeThatTheyLeave) {
  OneCloth one(GetParam());
  one.pour();
  Vector dripped = {0, 0, 0};
  wetcloth::Dripping::Parameters parameters;
  parameters.dropMass = 0;
  parameters.holdingSaturation = 0;
  parameters.onDrip = [&](const wetcloth::Drip& drip) { dripped = plus(dripped, times(drip.velocity, drip.mass)); };
  one.cloth.add<wetcloth::Dripping>(parameters);
  const Vector before = momentumOf(one.cloth);
  one.step(1);
  ASSERT_GT(one.cloth.ledger().dripped, 0);
  expectNear(plus(momentumOf(one.cloth), dripped), plus(before, one.arrived), one.scale());
}

/// Two cloths over each other, whose contacts are written by hand: a ring, in which nodes give and take in one step.
class TwoCloths {
 public:
  explicit TwoCloths(WorldKind kind) : m_scene(kind, squarePatch(4)), m_wet(m_scene.world(), wetcloth::Hook::manual) {
    m_scene.body().m_cfg.collisions = contactFlags(kind);
    m_other = squarePatch(4).build(m_scene.bullet().info());
    m_other->m_cfg.collisions = contactFlags(kind);
    m_scene.bullet().add(*m_other);
    first = &exactly(m_wet.add(m_scene.body(), fabricOf(200, 1)));
    second = &exactly(m_wet.add(*m_other, fabricOf(200, 1)));
    scatterVelocities(first->body(), 2);
    scatterVelocities(second->body(), 5);
    touch(first->body(), second->body());
    touch(second->body(), first->body());
  }
  ~TwoCloths() { m_scene.bullet().remove(*m_other); }
  TwoCloths(const TwoCloths&) = delete;
  TwoCloths& operator=(const TwoCloths&) = delete;

  void step(double dt) { m_wet.preTick(btScalar(dt)); }
  wetcloth::WetClothWorld& wet() { return m_wet; }
  double scale() const { return 10 * (first->totalMass() + second->totalMass()); }
  Vector momentum() const { return plus(momentumOf(*first), momentumOf(*second)); }

  wetcloth::WetCloth* first = nullptr;
  wetcloth::WetCloth* second = nullptr;

 private:
  void touch(btSoftBody& nodesOf, btSoftBody& facesOf) {
    for (int i = 0; i < nodesOf.m_nodes.size(); ++i) {
      btSoftBody::Face& face = facesOf.m_faces[(5 * i) % facesOf.m_faces.size()];
      if (m_scene.bullet().isDeformable()) {
        btSoftBody::DeformableFaceNodeContact contact = {};
        contact.m_node = &nodesOf.m_nodes[i];
        contact.m_face = &face;
        contact.m_bary = btVector3(btScalar(0.5), btScalar(0.3), btScalar(0.2));
        contact.m_normal = btVector3(0, 1, 0);
        nodesOf.m_faceNodeContacts.push_back(contact);
      } else {
        btSoftBody::SContact contact = {};
        contact.m_node = &nodesOf.m_nodes[i];
        contact.m_face = &face;
        contact.m_weights = btVector3(btScalar(0.5), btScalar(0.3), btScalar(0.2));
        contact.m_normal = btVector3(0, 1, 0);
        nodesOf.m_scontacts.push_back(contact);
      }
    }
  }

  BodyScene m_scene;
  std::unique_ptr<btSoftBody> m_other;
  wetcloth::WetClothWorld m_wet;
};

wetcloth::ContactWetting::Parameters betweenCloths(double rate) {
  wetcloth::ContactWetting::Parameters parameters;
  parameters.cloths = true;
  parameters.rate = rate;
  return parameters;
}

TEST_IN_WORLDS_WITH_FACE_CONTACTS(WaterMomentumBetweenCloths, GivenAndTakenInTheStepInWhichItArrives) {
  for (const bool hasFirst : {true, false}) {
    TwoCloths two(GetParam());
    Vector arrived = {0, 0, 0};
    for (wetcloth::WetCloth* cloth : {two.first, two.second}) {
      arrived = plus(arrived, times(btVector3(0, -9, 0), 100 * cloth->dryMass(5)));
      addCall(
          *cloth,
          [](wetcloth::WetCloth& c, const wetcloth::Step&) {
            c.water().absorb(5, 100 * c.water().dryMass(5), 0, -9, 0);
          },
          wetcloth::Stage::sources);
      cloth->add<wetcloth::Diffusion>(fast());
      cloth->add<wetcloth::WetStiffness>({1, 1, 50, 50});
    }
    (hasFirst ? two.first : two.second)->add<wetcloth::ContactWetting>(betweenCloths(1));
    const Vector before = two.momentum();
    two.step(0.05);
    ASSERT_GT(two.first->ledger().dripped, 0);
    ASSERT_GT(two.second->ledger().dripped, 0);
    expectNear(two.momentum(), plus(before, arrived), two.scale());
  }
}

// All that moves water or shares momentum inside of the cloths and between them; nothing leaves them.
TEST_IN_WORLDS_WITH_FACE_CONTACTS(WaterMomentumBetweenCloths, StepsOfAnyLength) {
  TwoCloths two(GetParam());
  const btVector3 rain(1, -9, 2);
  for (wetcloth::WetCloth* cloth : {two.first, two.second}) {
    wetcloth::Absorption::Parameters soak;
    std::vector<double> exposure;
    for (int i = 0; i < cloth->nodeCount(); ++i) exposure.push_back((i % 4) / 30.0);
    soak.exposure = exposure;
    soak.waterVelocity = rain;
    cloth->add<wetcloth::Absorption>(soak);
    cloth->add<wetcloth::Diffusion>(fast());
    cloth->add<wetcloth::Seepage>({0.1});
    cloth->add<wetcloth::WetStiffness>({1, 1, 5, 50});
  }
  two.first->add<wetcloth::ContactWetting>(betweenCloths(0.5));
  for (const double dt : {1e-6, 1e-3, 0.1, 1e-2, 10.0, 1e3}) {
    scatterVelocities(two.first->body(), 1);
    scatterVelocities(two.second->body(), 8);
    const Vector before = two.momentum();
    const double mass = two.first->totalMass() + two.second->totalMass();
    two.step(dt);
    const double arrived = two.first->totalMass() + two.second->totalMass() - mass;
    expectNear(two.momentum(), plus(before, times(rain, arrived)), two.scale());
  }
}

// What came after a cloth's turn is committed in the same step, so that nothing is left to be lost when it is cut.
TEST_IN_WORLDS_WITH_FACE_CONTACTS(WaterMomentumBetweenCloths, ACutAfterTheStepFindsNothingPending) {
  TwoCloths two(GetParam());
  two.wet().setLog({});
  two.second->setSaturation(0.5);
  two.second->add<wetcloth::ContactWetting>(betweenCloths(1));
  two.step(0.05);
  ASSERT_GT(two.first->ledger().held, 0);
  btSoftBody& body = two.first->body();
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    EXPECT_NEAR(1 / double(body.m_nodes[i].m_im), two.first->dryMass(i) + two.first->held(i),
                1e-6 * two.first->totalMass());
  }
  const double mass = two.first->totalMass();
  const double held = two.first->ledger().held;
  two.second->remove(two.second->effects().front());
  ASSERT_TRUE(body.cutLink(body.m_faces[0].m_n[0], body.m_faces[0].m_n[1], btScalar(0.5)));
  two.step(1e-3);
  // btSoftBody::cutLink() adds two nodes of 1 kg each, whatever the cloth weighs; the water stays what it was.
  EXPECT_NEAR(two.first->totalMass(), mass + 2, 1e-5 * mass);
  EXPECT_NEAR(two.first->ledger().held, held, 1e-12 * held);
}

}  // namespace
}  // namespace wetcloth_test::water_momentum_across_effects_test
