// SPDX-License-Identifier: Zlib
// A bond ends where the body's surface ends, and when the body or the cloth is put elsewhere.

#include "bullet_wetcloth/bullet/ShapeReach.h"
#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/Bodies.h"
#include "tests/support/BodyState.h"
#include "tests/support/CallEffect.h"
#include "tests/support/InEveryWorld.h"

#include <gtest/gtest.h>

#include <set>

namespace wetcloth_test::cling_on_bodies_test {
namespace {

using wetcloth::Cling;

constexpr double kGravity = 9.81;
const btVector3 kUpwards(0, btScalar(kGravity), 0);

Cling::Parameters stress(double adhesion, double shearStrength) {
  Cling::Parameters parameters;
  parameters.adhesion = adhesion;
  parameters.shearStrength = shearStrength;
  return parameters;
}

Cling& clings(OnBody& cloth, double adhesion, double shearStrength) {
  cloth.scene.cloth().setSaturation(0.5);
  return cloth.scene.cloth().add<Cling>(stress(adhesion, shearStrength));
}

/// Weight of a cloth of saturation 0.5 per area [Pa].
constexpr double kWeight = (0.150 + 0.5 * 0.84 * 0.150) * kGravity;

btVector3 velocityOf(OnBody& cloth) {
  const auto sum = momentum(cloth.scene.body());
  const double mass = freeMass(cloth.scene.body());
  return {btScalar(sum[0] / mass), btScalar(sum[1] / mass), btScalar(sum[2] / mass)};
}

void expectFreeFall(OnBody& cloth, const btVector3& gravity) {
  const btVector3 before = velocityOf(cloth);
  cloth.scene.step(48);
  const btVector3 gained = (velocityOf(cloth) - before) / btScalar(48 * kSubstep);
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(double(gained[axis]), double(gravity[axis]), 0.02 * kGravity);
}

/// Bonds of nodes farther than any contact reaches from the body as it is now.
int heldInTheAir(OnBody& cloth, const Cling& cling) {
  if (!cloth.body.isThere()) return cling.bonds();
  const btRigidBody& body = cloth.body.body();
  int count = 0;
  for (int i = 0; i < cloth.scene.body().m_nodes.size(); ++i) {
    const btVector3 local = body.getWorldTransform().invXform(cloth.scene.node(i).m_x);
    const bool isOn = wetcloth::isWithinReach(*body.getCollisionShape(), local, btScalar(2 * kMargin));
    count += cling.isBonded(i) && !isOn ? 1 : 0;
  }
  return count;
}

/// Presses the cloth to the body, then pulls it off with its weight; gravity aside.
class Handled {
 public:
  explicit Handled(OnBody& cloth) {
    addCall(cloth.scene.cloth(), [this](wetcloth::WetCloth& wet, const wetcloth::Step& step) {
      const btVector3 change(0, btScalar((m_lifts ? 2 : -2) * kGravity * step.dt), 0);
      for (int i = 0; i < wet.body().m_nodes.size(); ++i) wet.push(wet.body().m_nodes[i], change);
    });
  }
  void lift() { m_lifts = true; }

 private:
  bool m_lifts = false;
};

// It slides over the edge with 0.28 of its weight, and then falls with all of it.
TEST_IN_EVERY_WORLD(ClingOnBodies, AtAnEdgeItIsLetGoNodeByNode) {
  const btVector3 gravity(btScalar(-kGravity), -3, 0);
  OwnedShape wall;
  wall.shape = box(0.3, 0.05, 1);
  wall.top = 0.05;
  OnBody cloth(GetParam(), std::move(wall), BodyMotion::stays, gravity);
  cloth.scene.body().m_cfg.kDF = 0;
  Cling& cling = clings(cloth, 50, 0.72 * kWeight);
  int inTheAir = 0;
  addCall(
      cloth.scene.cloth(), [&](auto&, auto&) { inTheAir += heldInTheAir(cloth, cling); }, wetcloth::Stage::elasticity);
  std::set<int> counts;
  for (int i = 0; i < 360; ++i) {
    cloth.scene.step(1);
    counts.insert(cling.bonds());
  }
  EXPECT_EQ(inTheAir, 0);
  EXPECT_EQ(*counts.rbegin(), 16);
  EXPECT_GE(counts.size(), 4U) << "row by row";
  EXPECT_EQ(cling.bonds(), 0);
  expectFreeFall(cloth, gravity);
}

TEST_IN_EVERY_WORLD(ClingOnBodies, AClothThatIsPutElsewhereFalls) {
  OnBody cloth(GetParam(), BodyShape::box);
  Cling& cling = clings(cloth, 50, 20);
  cloth.scene.step(60);
  ASSERT_EQ(cling.bonds(), 16);
  cloth.scene.body().translate(btVector3(0, 5, 0));
  expectFreeFall(cloth, kEarthGravity);
  EXPECT_EQ(cling.bonds(), 0);
}

TEST_IN_EVERY_WORLD(ClingOnBodies, HangsFromEveryShapeByTheNodesThatTouchIt) {
  for (const BodyShape shape : kBodyShapes) {
    for (const BodyMotion motion : kBodyMotions) {
      if (!canBe(shape, motion)) continue;
      SCOPED_TRACE(std::string(nameOf(shape)) + ", " + nameOf(motion));
      OnBody cloth(GetParam(), shape, motion);
      Handled hand(cloth);
      const Cling& cling = clings(cloth, 20 * kWeight, 20 * kWeight);
      cloth.scene.step(120);
      const int pressed = cling.bonds();
      const double before = centreOfMass(cloth.scene.body())[1];
      EXPECT_GE(pressed, shape == BodyShape::cone ? 4 : shape == BodyShape::fineMesh ? 0 : 12);
      hand.lift();
      cloth.scene.step(120);
      EXPECT_EQ(cling.bonds(), pressed);
      if (pressed == 0) continue;
      EXPECT_NEAR(centreOfMass(cloth.scene.body())[1], before, 0.02);
    }
  }
}

TEST_IN_EVERY_WORLD(ClingOnBodies, NothingHoldsWhereTheBodyNoLongerIs) {
  for (const BodyShape shape : kBodyShapes) {
    for (const BodyMotion motion : kBodyMotions) {
      for (const BodyEvent event : kBodyEvents) {
        if (!canBe(shape, motion)) continue;
        OnBody cloth(GetParam(), shape, motion);
        Handled hand(cloth);
        Cling& cling = clings(cloth, 5 * kWeight, 5 * kWeight);
        int inTheAir = 0;
        addCall(
            cloth.scene.cloth(), [&](auto&, auto&) { inTheAir += heldInTheAir(cloth, cling); },
            wetcloth::Stage::elasticity);
        cloth.scene.step(60);
        hand.lift();
        inTheAir = 0;
        cloth.body.undergo(event);
        cloth.scene.step(5);
        if (event == BodyEvent::turned && motion == BodyMotion::dynamic)
          inTheAir = 0;  // it threw out what it was turned into
        cloth.scene.step(5);
        EXPECT_EQ(inTheAir, 0) << nameOf(shape) << ' ' << nameOf(motion) << ' ' << nameOf(event);
        EXPECT_TRUE(isFinite(cloth.scene.body())) << nameOf(shape);
      }
    }
  }
}

TEST_IN_EVERY_WORLD(ClingOnBodies, LetsGoOfABoxThatChanged) {
  for (const BodyEvent event : {BodyEvent::moved, BodyEvent::scaled, BodyEvent::swapped, BodyEvent::removed}) {
    OnBody cloth(GetParam(), BodyShape::box, BodyMotion::stays, kUpwards);
    Cling& cling = clings(cloth, 20 * kWeight, 20 * kWeight);
    cloth.scene.step(60);
    ASSERT_EQ(cling.bonds(), 16);
    cloth.body.undergo(event);
    expectFreeFall(cloth, kUpwards);
    EXPECT_EQ(cling.bonds(), 0) << nameOf(event);
  }
}

TEST(ClingOnBodiesAsleep, WakesWhenTheShapeIsExchanged) {
  for (const BodyEvent event : {BodyEvent::moved, BodyEvent::scaled, BodyEvent::swapped}) {
    OnBody cloth(WorldKind::deformable, BodyShape::box, BodyMotion::stays, kUpwards);
    cloth.scene.body().forceActivationState(ACTIVE_TAG);
    Cling& cling = clings(cloth, 50, 20);
    cloth.scene.step(1500);
    ASSERT_EQ(cling.bonds(), 16);
    ASSERT_FALSE(cloth.scene.body().isActive());
    cloth.body.undergo(event);
    cloth.scene.step(120);
    EXPECT_GT(centreOfMass(cloth.scene.body())[1], 0.5) << nameOf(event);
  }
}

}  // namespace
}  // namespace wetcloth_test::cling_on_bodies_test
