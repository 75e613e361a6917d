// SPDX-License-Identifier: Zlib
// What an application's btIDebugDraw is given: triangles by saturation, and the wind on them.

#include "tests/support/BodyState.h"
#include "tests/support/ClothScene.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Patches.h"
#include "tests/support/Rejection.h"

#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>
#include <LinearMath/btIDebugDraw.h>

#include <limits>

namespace wetcloth_test::debug_draw_test {
namespace {

using wetcloth::saturationColour;
using wetcloth::Wind;

/// Remembers what it is asked to draw.
class RecordingDrawer : public btIDebugDraw {
 public:
  struct Line {
    btVector3 from, to, colour;
  };
  struct Triangle {
    btVector3 corners[3];
    btVector3 colour;
  };
  std::vector<Line> lines;
  std::vector<Triangle> triangles;

  using btIDebugDraw::drawLine;
  using btIDebugDraw::drawTriangle;
  void drawLine(const btVector3& from, const btVector3& to, const btVector3& colour) override {
    lines.push_back({from, to, colour});
  }
  void drawTriangle(const btVector3& a, const btVector3& b, const btVector3& c, const btVector3& colour,
                    btScalar) override {
    triangles.push_back({{a, b, c}, colour});
  }
  void drawContactPoint(const btVector3&, const btVector3&, btScalar, int, const btVector3&) override {}
  void reportErrorWarning(const char*) override {}
  void draw3dText(const btVector3&, const char*) override {}
  void setDebugMode(int) override {}
  int getDebugMode() const override { return DBG_NoDebug; }
};

RecordingDrawer drawn(ClothScene& scene, double metresPerPascal = 0.01) {
  RecordingDrawer drawer;
  wetcloth::debugDraw(scene.wet(), drawer, metresPerPascal);
  return drawer;
}

void expectNear(const btVector3& value, const btVector3& expected, double tolerance) {
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(double(value[axis]), double(expected[axis]), tolerance) << axis;
}

btVector3 vectorOf(const wetcloth::Colour& colour) {
  return btVector3(btScalar(colour.r), btScalar(colour.g), btScalar(colour.b));
}

/// Rests at the origin, level: no gravity, no air.
class DebugDraw {
 protected:
  ClothScene scene{GetParam(), btVector3(0, 0, 0), levelPatch(5, 1)};
  const std::size_t faces = std::size_t(2) * 4 * 4;
};

TEST_F_IN_EVERY_WORLD(DebugDraw, DrawsEachTriangleOnceAndNothingElseWithoutWind) {
  const RecordingDrawer drawer = drawn(scene);
  ASSERT_EQ(drawer.triangles.size(), faces);
  EXPECT_TRUE(drawer.lines.empty());
  double area = 0;
  for (const auto& [corners, colour] : drawer.triangles) {
    area += double((corners[1] - corners[0]).cross(corners[2] - corners[0]).length()) / 2;
    expectNear(colour, vectorOf(saturationColour(0)), 1e-6);
  }
  EXPECT_NEAR(area, 1, 1e-6);
}

TEST_F_IN_EVERY_WORLD(DebugDraw, ColoursChangeWithTheSaturation) {
  for (const double saturation : {0.0, 0.3, 0.5, 1.0}) {
    scene.cloth().setSaturation(saturation);
    for (const auto& triangle : drawn(scene).triangles) {
      expectNear(triangle.colour, vectorOf(saturationColour(saturation)), 1e-6);
    }
  }
}

TEST_F_IN_EVERY_WORLD(DebugDraw, ATriangleHasTheMeanOfItsCorners) {
  std::vector<double> held(std::size_t(scene.cloth().nodeCount()), 0.0);
  held[12] = scene.cloth().capacity(12);  // the middle one
  scene.cloth().setHeld(held);
  std::size_t touched = 0;
  for (const auto& triangle : drawn(scene).triangles) {
    bool touches = false;
    for (const btVector3& corner : triangle.corners) touches = touches || corner.length() < 1e-6;
    expectNear(triangle.colour, vectorOf(saturationColour(touches ? 1.0 / 3 : 0)), 1e-6);
    touched += touches ? 1 : 0;
  }
  EXPECT_GE(touched, 4u);
}

TEST_F_IN_EVERY_WORLD(DebugDraw, TheWindIsALineDownwindFromEachTrianglesCentre) {
  scene.cloth().add<Wind>({btVector3(0, -4, 3)});
  // The level cloth feels the part across it alone: 1/2 rho C_d u^2 = 0.5 x 1.225 x 1.2 x 16 Pa.
  const double pressure = 0.5 * 1.225 * 1.2 * 16;
  for (const double scale : {0.01, 0.05}) {
    const RecordingDrawer drawer = drawn(scene, scale);
    ASSERT_EQ(drawer.lines.size(), faces);
    for (std::size_t f = 0; f < faces; ++f) {
      const auto& corners = drawer.triangles[f].corners;
      expectNear(drawer.lines[f].from, (corners[0] + corners[1] + corners[2]) / 3, 1e-6);
      expectNear(drawer.lines[f].to - drawer.lines[f].from, btVector3(0, btScalar(-scale * pressure), 0),
                 1e-5 * scale * pressure + 1e-7);
      EXPECT_NE(drawer.lines[f].colour, drawer.triangles[f].colour);
    }
  }
  EXPECT_TRUE(drawn(scene, 0).lines.empty());
  EXPECT_EQ(drawn(scene, 0).triangles.size(), faces);
}

TEST_F_IN_EVERY_WORLD(DebugDraw, AClothThatMovesWithTheWindFeelsNone) {
  scene.cloth().add<Wind>({btVector3(0, -4, 0)});
  setVelocity(scene.body(), btVector3(0, -4, 0));
  EXPECT_TRUE(drawn(scene).lines.empty());
  setVelocity(scene.body(), btVector3(0, -6, 0));  // and one that is faster is held back
  for (const auto& line : drawn(scene).lines) EXPECT_GT(line.to.y(), line.from.y());
}

TEST_F_IN_EVERY_WORLD(DebugDraw, TheFunctionOfAGustIsAskedForNowAndThere) {
  scene.step(10, kExactSubstep);
  double asked = -1;
  scene.cloth().add<Wind>({[&](const btVector3& position, double time) {
    asked = time;
    return btVector3(0, position.x() > 0 ? btScalar(2) : btScalar(0), 0);
  }});
  const RecordingDrawer drawer = drawn(scene);
  EXPECT_NEAR(asked, 10 * kExactSubstep, 1e-12);
  EXPECT_EQ(drawer.lines.size(), faces / 2);
  for (const auto& line : drawer.lines) EXPECT_GT(line.from.x(), 0);
}

TEST_F_IN_EVERY_WORLD(DebugDraw, ThePapersWindIsThreeCornersForcesOverTheArea) {
  Wind::Parameters paper;
  paper.law = Wind::Law::paper;
  paper.velocity = btVector3(0, -1.5, 0);
  const Wind& wind = scene.cloth().add<Wind>(paper);
  const double area = 1.0 / double(faces);
  expectNear(wind.traction(scene.body().m_faces[0], 0), btVector3(0, btScalar(-3 * 1e-3 * 1.5 / area), 0), 1e-5);
}

TEST_F_IN_EVERY_WORLD(DebugDraw, LinearDragAndSkinFrictionAreInIt) {
  Wind::Parameters linear;
  linear.law = Wind::Law::linear;
  linear.linearDrag = 0.3;
  linear.velocity = btVector3(5, 2, 0);
  expectNear(scene.cloth().add<Wind>(linear).traction(scene.body().m_faces[3], 0), btVector3(0, btScalar(0.6), 0),
             1e-6);
  Wind::Parameters friction;
  friction.skinFriction = 0.1;
  friction.velocity = btVector3(5, 0, 0);
  expectNear(scene.cloth().add<Wind>(friction).traction(scene.body().m_faces[3], 0),
             btVector3(btScalar(0.5 * 1.225 * 0.1 * 25), 0, 0), 1e-5);
}

TEST_F_IN_EVERY_WORLD(DebugDraw, ATriangleWithoutAreaFeelsNothing) {
  scene.cloth().add<Wind>({btVector3(0, -4, 3)});
  for (int i = 0; i < scene.cloth().nodeCount(); ++i) scene.node(i).m_x.setZero();
  EXPECT_TRUE(drawn(scene).lines.empty());
}

TEST_F_IN_EVERY_WORLD(DebugDraw, ChangesNothing) {
  ClothScene other(GetParam(), btVector3(0, 0, 0), levelPatch(5, 1));
  for (ClothScene* each : {&scene, &other}) {
    each->cloth().add<Wind>({btVector3(1, -4, 0)});
    each->cloth().add<wetcloth::Absorption>();
  }
  for (int step = 0; step < 60; ++step) {
    drawn(scene);
    scene.step(1);
    other.step(1);
  }
  for (int i = 0; i < scene.cloth().nodeCount(); ++i) {
    ASSERT_EQ(scene.node(i).m_x, other.node(i).m_x);
    ASSERT_EQ(scene.cloth().held(i), other.cloth().held(i));
  }
}

TEST_F_IN_EVERY_WORLD(DebugDraw, LeavesOutABodyThatIsNotInTheWorld) {
  scene.bullet().remove(scene.body());
  EXPECT_TRUE(drawn(scene).triangles.empty());
  scene.bullet().add(scene.body());
  EXPECT_EQ(drawn(scene).triangles.size(), faces);
}

TEST_F_IN_EVERY_WORLD(DebugDraw, NodesThatACutHasJustMadeAreDry) {
  scene.cloth().setSaturation(1);
  scene.body().appendNode(btVector3(0, 1, 0), 1);
  scene.body().appendFace(0, 1, scene.body().m_nodes.size() - 1);
  const RecordingDrawer drawer = drawn(scene);
  ASSERT_EQ(drawer.triangles.size(), faces + 1);
  expectNear(drawer.triangles.back().colour, vectorOf(saturationColour(2.0 / 3)), 1e-6);
}

TEST_F_IN_EVERY_WORLD(DebugDraw, AScaleThatIsNotFiniteIsRefused) {
  for (const double bad : {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_NE(rejection([&] { drawn(scene, bad); }).find("metresPerPascal"), std::string::npos);
  }
}

TEST(SaturationColour, DarkensSteadilyAndEndsAtItsEnds) {
  const auto brightness = [](const wetcloth::Colour& c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; };
  double before = 2;
  for (int i = 0; i <= 20; ++i) {
    const double now = brightness(saturationColour(i / 20.0));
    EXPECT_LT(now, before);
    before = now;
  }
  EXPECT_EQ(saturationColour(-1).r, saturationColour(0).r);
  EXPECT_EQ(saturationColour(7).b, saturationColour(1).b);
  EXPECT_EQ(saturationColour(std::numeric_limits<double>::quiet_NaN()).r, saturationColour(0).r);
}

TEST(DebugDraw, RefusesALengthThatIsNone) {
  ClothScene scene(WorldKind::softRigid, btVector3(0, 0, 0), levelPatch(5, 1));
  RecordingDrawer drawer;
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(wetcloth::debugDraw(scene.wet(), drawer, bad), std::invalid_argument);
    EXPECT_THROW(wetcloth::drawWind(scene.cloth(), drawer, 0, bad), std::invalid_argument);
  }
}

}  // namespace
}  // namespace wetcloth_test::debug_draw_test
