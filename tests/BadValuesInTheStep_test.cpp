// SPDX-License-Identifier: Zlib
// What goes wrong inside a step cannot be refused: an application's function returns NaN, a triangle has no area, a
// step has no length. Nothing that is not finite may reach Bullet.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BodyState.h"
#include "tests/support/CallEffect.h"
#include "tests/support/ExactPace.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Materials.h"
#include "tests/support/Measures.h"
#include "tests/support/Patches.h"

#include <limits>

namespace wetcloth_test::bad_values_in_the_step_test {

namespace {

const double kNaN = std::numeric_limits<double>::quiet_NaN();
const btScalar kScalarNaN = std::numeric_limits<btScalar>::quiet_NaN();
const btScalar kScalarInfinity = std::numeric_limits<btScalar>::infinity();

TEST_IN_EVERY_WORLD(BadValuesInTheStep, AnExposureFunctionIsClamped) {
  struct Case {
    double value;
    double effective;
  };
  for (const Case& each : {Case{kNaN, 0}, Case{7, 1}, Case{-3, 0}, Case{HUGE_VAL, 1}, Case{-HUGE_VAL, 0}}) {
    BodyScene scene(GetParam(), hangingPatch(4));
    wetcloth::WetClothWorld wet(scene.world());
    wetcloth::WetCloth& cloth = exactly(wet.add(scene.body(), fabricOf(1, 1)));
    cloth.add<wetcloth::Absorption>({[&each](const btVector3&, const btVector3&) { return each.value; }});
    scene.bullet().step(240);
    EXPECT_NEAR(cloth.meanSaturation(), 1 - std::exp(-each.effective), 1e-5) << each.value;
    EXPECT_TRUE(isFinite(scene.body()));
  }
}

TEST_IN_EVERY_WORLD(BadValuesInTheStep, AWindFunctionThatIsNotFiniteIsNoWind) {
  for (const btScalar bad : {kScalarNaN, kScalarInfinity, -kScalarInfinity}) {
    BodyScene scene(GetParam(), sailPatch(4), btVector3(0, 0, 0));
    wetcloth::WetClothWorld wet(scene.world());
    exactly(wet.add(scene.body())).add<wetcloth::Wind>({[bad](const btVector3&, double) {
      return btVector3(0, 0, bad);
    }});
    scene.bullet().step(60);
    EXPECT_TRUE(isFinite(scene.body()));
    // At rest in still air; the links' rounding moves nodes by micrometres per second.
    EXPECT_LT(largestSpeed(scene.body()), 1e-4) << bad;
  }
}

// An application's function that throws is a failing effect like any other.
TEST_IN_EVERY_WORLD(BadValuesInTheStep, AFunctionThatThrowsTakesItsEffectAway) {
  BodyScene scene(GetParam(), hangingPatch(4));
  wetcloth::WetClothWorld wet(scene.world());
  int messages = 0;
  wet.setLog([&messages](const std::string&) { ++messages; });
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body()));
  cloth.add<wetcloth::Wind>({[](const btVector3&, double) -> btVector3 { throw std::runtime_error("no forecast"); }});
  cloth.add<wetcloth::Absorption>();
  EXPECT_NO_THROW(scene.bullet().step(10));
  EXPECT_EQ(messages, 1);
  EXPECT_EQ(cloth.effects().size(), 1u);
  EXPECT_GT(cloth.ledger().held, 0);
}

// One sound triangle; the second has all its corners on a line, the third two corners in one place.
std::unique_ptr<btSoftBody> degenerate(btSoftBodyWorldInfo& info) {
  const btVector3 x[6] = {btVector3(0, 0, 0), btVector3(1, 0, 0), btVector3(0, 1, 0),
                          btVector3(2, 0, 0), btVector3(5, 5, 0), btVector3(5, 5, 0)};
  const btScalar m[6] = {btScalar(0.1), btScalar(0.1), btScalar(0.1), btScalar(0.1), btScalar(0.1), btScalar(0.1)};
  auto body = std::make_unique<btSoftBody>(&info, 6, x, m);
  body->appendLink(0, 1);
  body->appendLink(1, 2);
  body->appendLink(2, 0);
  body->appendFace(0, 1, 2);
  body->appendFace(0, 1, 3);
  body->appendFace(3, 4, 5);
  return body;
}

TEST_IN_EVERY_WORLD(BadValuesInTheStep, ATriangleWithoutAreaFeelsNothing) {
  for (const auto law : {wetcloth::Wind::Law::quadratic, wetcloth::Wind::Law::linear, wetcloth::Wind::Law::paper}) {
    BodyScene scene(GetParam(), degenerate, btVector3(0, 0, 0));
    wetcloth::WetClothWorld wet(scene.world());
    wetcloth::WetCloth& cloth = exactly(wet.add(scene.body()));
    wetcloth::Wind::Parameters wind;
    wind.velocity = btVector3(1, 1, 3);
    wind.law = law;
    wind.skinFriction = 0.1;
    wind.paperForce = 1;
    cloth.add<wetcloth::Wind>(wind);
    cloth.add<wetcloth::Absorption>({[](const btVector3&, const btVector3& normal) {
      return std::isfinite(double(normal.length2())) ? 1.0 : 0.0;
    }});
    scene.bullet().step(1);  // later the wind will have moved two corners out of line
    EXPECT_GT(scene.body().m_nodes[2].m_v.z(), 0.001) << "the sound triangle feels the wind";
    for (const int i : {3, 4, 5}) EXPECT_EQ(scene.body().m_nodes[i].m_v.length(), 0) << i;
    EXPECT_GT(cloth.saturation(5), 0) << "its normal is finite too";
    scene.bullet().step(30);
    EXPECT_TRUE(isFinite(scene.body()));
  }
}

TEST_IN_EVERY_WORLD(BadValuesInTheStep, AStepWithoutLengthIsIgnored) {
  BodyScene scene(GetParam(), hangingPatch(4));
  wetcloth::WetClothWorld wet(scene.world(), wetcloth::Hook::manual);
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body(), fabricOf(1, 1)));
  cloth.add<wetcloth::Absorption>();
  cloth.add<wetcloth::Wind>({btVector3(0, 0, 3)});
  cloth.add<wetcloth::HookeSprings>(springsOf(100, 1));
  int calls = 0;
  addCall(cloth, [&calls](wetcloth::WetCloth&, const wetcloth::Step&) { ++calls; });
  const std::vector<btScalar> before = stateOf(scene.body());
  for (const btScalar dt : {btScalar(0), btScalar(-1), kScalarNaN, kScalarInfinity, -kScalarInfinity}) {
    EXPECT_NO_THROW(wet.preTick(dt));
  }
  EXPECT_EQ(calls, 0);
  EXPECT_EQ(wet.time(), 0);
  EXPECT_EQ(cloth.ledger().held, 0);
  EXPECT_TRUE(sameBits(stateOf(scene.body()), before));
}

// Through Bullet, which steps backwards when asked to: no water leaves or comes, and nothing breaks.
TEST_IN_EVERY_WORLD(BadValuesInTheStep, ThroughBulletTooAStepBackwardsAddsNoWater) {
  BodyScene scene(GetParam(), squarePatch(4));
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body(), fabricOf(1, 1)));
  cloth.add<wetcloth::Absorption>();
  scene.bullet().step(1);
  const double before = cloth.ledger().held;
  scene.bullet().step(1, btScalar(-1) / 240);
  scene.bullet().step(1, 0);
  EXPECT_EQ(cloth.ledger().held, before);
  scene.bullet().step(1);
  EXPECT_GT(cloth.ledger().held, before);
  EXPECT_TRUE(isFinite(scene.body()));
}

}  // namespace
}  // namespace wetcloth_test::bad_values_in_the_step_test
