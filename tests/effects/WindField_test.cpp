// SPDX-License-Identifier: Zlib
// Wind that varies in space and time, and what the effect refuses.

#include "tests/support/BulletWorld.h"
#include "tests/support/ClothScene.h"
#include "tests/support/Patches.h"
#include "tests/support/Rejection.h"
#include "tests/support/SoftBodies.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace wetcloth_test::wind_field_test {
namespace {

using wetcloth::Fabric;
using wetcloth::Hook;
using wetcloth::Wind;
using Law = wetcloth::Wind::Law;

Wind::Parameters wind(const btVector3& velocity, Law law = Law::quadratic) {
  Wind::Parameters parameters;
  parameters.velocity = velocity;
  parameters.law = law;
  return parameters;
}

TEST(WindField, IsToldPositionAndTime) {
  std::vector<double> times;
  double lowest = 1;
  double highest = -1;
  ClothScene scene(WorldKind::softRigid, kNoGravity, levelPatch(9, 1), Fabric::cotton(), Hook::manual);
  Wind::Parameters parameters;
  parameters.velocity = [&](const btVector3& position, double time) {
    if (times.empty() || times.back() != time) times.push_back(time);
    lowest = std::min(lowest, double(position.x()));
    highest = std::max(highest, double(position.x()));
    return btVector3(0, position.x() < 0 ? btScalar(0) : btScalar(2), 0);
  };
  scene.cloth().add<Wind>(parameters);
  for (int i = 0; i < 3; ++i) scene.preTick(0.25);
  ASSERT_EQ(times.size(), 3u);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(times[std::size_t(i)], 0.25 * i);
  EXPECT_LT(lowest, -0.4);  // asked on the triangles or on the nodes of a patch from -0.5 to 0.5
  EXPECT_GT(highest, 0.4);
  EXPECT_GE(lowest, -0.5);
  EXPECT_LE(highest, 0.5);
  for (int j = 0; j < 9; ++j) {
    EXPECT_EQ(scene.node(9 * j).m_v.y(), 0) << j;
    EXPECT_GT(scene.node(9 * j + 8).m_v.y(), 0.1) << j;
  }
}

TEST(WindField, GustPushesOnlyWhileItBlows) {
  ClothScene scene(WorldKind::softRigid, kNoGravity, levelPatch(9, 1, 1e4), Fabric::cotton(), Hook::manual);
  Wind::Parameters parameters;
  parameters.velocity = [](const btVector3&, double time) {
    return btVector3(0, time >= 0.5 && time < 1 ? btScalar(6) : btScalar(0), 0);
  };
  Wind& effect = scene.cloth().add<Wind>(parameters);
  double impulse = 0;
  for (int i = 0; i < 128; ++i) {
    scene.preTick(1.0 / 64);
    impulse += double(effect.totalForce().y()) / 64;
  }
  EXPECT_NEAR(impulse / (0.5 * 1.225 * 1.2 * 36 * 0.5), 1, 1e-3);  // the heavy cloth moves with 1 mm/s at the end
}

TEST(WindField, ValueThatIsNotFiniteOrFasterThanAnyIsNoWind) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  ClothScene scene(WorldKind::softRigid, kNoGravity, levelPatch(5, 1), Fabric::cotton(), Hook::manual);
  Wind::Parameters parameters;
  for (const double wild : {nan, 1e7, 1e30}) {
    parameters.velocity = [=](const btVector3&, double) { return btVector3(0, btScalar(wild), 0); };
    scene.cloth().add<Wind>(parameters);
    scene.preTick(kSubstep);
    for (int i = 0; i < 25; ++i) EXPECT_EQ(scene.node(i).m_v, kNoGravity) << wild;
  }
}

TEST(WindField, SetVelocityBlowsFromTheNextStep) {
  ClothScene scene(WorldKind::softRigid, kNoGravity, levelPatch(5, 1, 1e4), Fabric::cotton(), Hook::manual);
  Wind& effect = scene.cloth().add<Wind>(wind(btVector3(0, 1, 0)));
  scene.preTick(1e-4);
  const double before = effect.totalForce().y();
  adjust(effect, [](auto& p) { p.velocity = btVector3(0, 2, 0); });
  scene.preTick(1e-4);
  EXPECT_NEAR(effect.totalForce().y() / before, 4, 1e-3);
}

// --- bad input ---

TEST(WindInput, BadParametersAreNamed) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  const auto refused = [](const char* field, double Wind::Parameters::*member, double value) {
    Wind::Parameters parameters;
    parameters.*member = value;
    const std::string message = rejection([&] { Wind{parameters}; });
    EXPECT_NE(message.find(field), std::string::npos) << field << " " << value << ": " << message;
  };
  for (double bad : {nan, infinite, -1.0}) {
    refused("airDensity", &Wind::Parameters::airDensity, bad);
    refused("dragCoefficient", &Wind::Parameters::dragCoefficient, bad);
    refused("skinFriction", &Wind::Parameters::skinFriction, bad);
    refused("linearDrag", &Wind::Parameters::linearDrag, bad);
    refused("paperForce", &Wind::Parameters::paperForce, bad);
  }
  for (double bad : {nan, infinite, 1.1e6, 1e30}) {
    const std::string message = rejection([&] { Wind{wind(btVector3(0, btScalar(bad), 0))}; });
    EXPECT_NE(message.find("velocity"), std::string::npos) << message;
  }
}

TEST(WindInput, BadVelocityIsRefusedAndTheOldOneStays) {
  ClothScene scene(WorldKind::softRigid, kNoGravity, levelPatch(5, 1, 1e4), Fabric::cotton(), Hook::manual);
  Wind& effect = scene.cloth().add<Wind>(wind(btVector3(0, 1, 0)));
  const btScalar nan = std::numeric_limits<btScalar>::quiet_NaN();
  EXPECT_NE(rejection([&] { adjust(effect, [&](auto& p) { p.velocity = btVector3(nan, 0, 0); }); }).find("velocity"),
            std::string::npos);
  scene.preTick(1e-4);
  EXPECT_NEAR(effect.totalForce().y() / (0.5 * 1.225 * 1.2), 1, 1e-4);
}

TEST(WindInput, BodyWithoutFacesIsRefused) {
  ClothScene scene(WorldKind::softRigid, kNoGravity, hangingRope(3, 0.1, 0.01), Fabric::cotton(), Hook::manual);
  EXPECT_NE(rejection([&] { scene.cloth().add<Wind>(); }).find("face"), std::string::npos);
  EXPECT_TRUE(scene.cloth().effects().empty());
}

TEST(WindInput, TrianglesWithoutAreaDoNoHarm) {
  const std::vector<btVector3> corners = {btVector3(0, 0, 0), btVector3(1, 0, 0), btVector3(0, 0, 1),
                                          btVector3(2, 0, 0)};
  for (Law law : {Law::quadratic, Law::linear, Law::paper}) {
    ClothScene scene(WorldKind::softRigid, kNoGravity, triangles(corners, {1, 1, 1, 1}, {{0, 1, 2}, {0, 1, 3}}),
                     Fabric::cotton(), Hook::manual);
    Wind& effect = scene.cloth().add<Wind>(wind(btVector3(1, 4, 0), law));
    scene.preTick(kSubstep);
    for (int i = 0; i < 3; ++i) EXPECT_GT(scene.node(i).m_v.y(), 0) << i;
    EXPECT_GT(effect.totalForce().y(), 0);
    for (int i = 0; i < 4; ++i) EXPECT_TRUE(std::isfinite(double(scene.node(i).m_v.length()))) << i;
    EXPECT_EQ(scene.node(3).m_v, kNoGravity);  // it belongs to the triangle without area only
  }
}

}  // namespace
}  // namespace wetcloth_test::wind_field_test
