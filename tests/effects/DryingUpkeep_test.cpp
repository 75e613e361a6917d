// SPDX-License-Identifier: Zlib
// When Drying idles, that it survives cuts and bad values, and what it refuses.

#include "bullet_wetcloth/effects/Drying.h"

#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/ClothScene.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Patches.h"
#include "tests/support/Rejection.h"
#include "tests/support/SoftBodies.h"

#include <cmath>
#include <limits>
#include <vector>

namespace wetcloth_test::drying_upkeep_test {
namespace {

using wetcloth::Drying;
using wetcloth::Fabric;
using wetcloth::Hook;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A saturated 3 x 3 cloth of 1 m^2; only our part of the step runs.
struct Line {
  explicit Line(Drying::Parameters parameters = {})
      : scene(WorldKind::softRigid, kEarthGravity, levelPatch(3, 1), Fabric::cotton(), Hook::manual),
        effect(scene.cloth().add<Drying>(std::move(parameters))) {
    scene.cloth().setSaturation(1);
  }
  ClothScene scene;
  Drying& effect;
};

// --- a dry cloth costs nothing ----------------------------------------------------------------------------------

TEST(DryingIdles, WhenTheClothIsDry) {
  Line line;
  for (int i = 0; i < 1000; ++i) line.scene.preTick(60);  // 110 time constants
  EXPECT_EQ(line.scene.cloth().ledger().held, 0);
  const long long visited = line.effect.nodesVisited();
  const long long commits = line.scene.cloth().masses().commits();
  for (int i = 0; i < 100; ++i) line.scene.preTick(60);
  EXPECT_EQ(line.effect.nodesVisited(), visited);
  EXPECT_EQ(line.scene.cloth().masses().commits(), commits);
  line.scene.cloth().setSaturation(0.5);
  line.scene.preTick(60);
  EXPECT_GT(line.effect.nodesVisited(), visited);
}

TEST(DryingIdles, NotInAStormFasterThanAnyWhichIsStillAir) {
  Drying::Parameters parameters;
  parameters.air = [](const btVector3&, double time) {
    return btVector3(time < 1 ? std::numeric_limits<btScalar>::max() : btScalar(1), 0, 0);
  };
  Line line(parameters);
  Line still;
  line.scene.preTick(1);
  still.scene.preTick(1);
  EXPECT_EQ(line.scene.cloth().ledger().evaporated, still.scene.cloth().ledger().evaporated);
  line.scene.preTick(1);
  still.scene.preTick(1);
  EXPECT_GT(line.scene.cloth().ledger().evaporated, still.scene.cloth().ledger().evaporated);
}

TEST(DryingIdles, InAirThatIsSaturatedAndWithoutExposure) {
  Drying::Parameters humid;
  humid.relativeHumidity = 1;
  Line line(humid);
  for (int i = 0; i < 10; ++i) line.scene.preTick(1);
  EXPECT_EQ(line.effect.nodesVisited(), 0);
  Drying::Parameters covered;
  covered.exposure = 0.0;
  Line under(covered);
  for (int i = 0; i < 10; ++i) under.scene.preTick(1);
  EXPECT_EQ(under.effect.nodesVisited(), 9);
  adjust(under.effect, [](auto& p) { p.exposure = 1.0; });
  under.scene.preTick(1);
  EXPECT_GT(under.scene.cloth().ledger().evaporated, 0);
}

// --- what happens to the body -----------------------------------------------------------------------------------

TEST(DryingUpkeep, ANodeWithAVelocityThatIsNotFiniteKeepsItsWater) {
  for (const double bad : {kNaN, kInfinity}) {
    Line line;
    line.scene.node(4).m_v = btVector3(0, btScalar(bad), 0);
    const double before = line.scene.cloth().held(4);
    line.scene.preTick(100);
    EXPECT_EQ(line.scene.cloth().held(4), before);
    EXPECT_LT(line.scene.cloth().saturation(0), 1) << "the others dry";
  }
}

TEST_IN_EVERY_WORLD(DryingUpkeepInWorld, GoesOnWhenTheClothIsCut) {
  ClothScene scene(GetParam(), kEarthGravity, hangingPatch(5));
  scene.addBulletSpringsForStep();
  scene.wet().setLog({});
  scene.cloth().add<Drying>({30, 0.1, btVector3(4, 0, 0)});
  scene.cloth().setSaturation(1);
  scene.step(30);
  btSoftBody& body = scene.body();
  ASSERT_TRUE(body.cutLink(body.m_faces[0].m_n[0], body.m_faces[0].m_n[1], btScalar(0.5)));
  const double before = scene.cloth().ledger().evaporated;
  scene.step(30);
  ASSERT_EQ(scene.cloth().effects().size(), 1u);
  const wetcloth::Ledger ledger = scene.cloth().ledger();
  EXPECT_GT(ledger.evaporated, before);
  EXPECT_LE(std::fabs(ledger.imbalance()), 1e-12 * ledger.initial);
  EXPECT_TRUE(isFinite(body));
}

// --- bad input --------------------------------------------------------------------------------------------------

void expectRefused(double Drying::Parameters::*field, const std::string& name, const std::vector<double>& values) {
  for (const double bad : values) {
    Drying::Parameters parameters;
    parameters.*field = bad;
    const std::string message = rejection([&] { Drying{parameters}; });
    EXPECT_EQ(message.find("Drying." + name + " = "), 0u) << bad << ": " << message;
  }
}

TEST(DryingBadInput, IsNamed) {
  expectRefused(&Drying::Parameters::temperature, "temperature", {-1, 61, kNaN, kInfinity});
  expectRefused(&Drying::Parameters::relativeHumidity, "relativeHumidity", {-0.1, 1.1, kNaN, kInfinity});
  expectRefused(&Drying::Parameters::criticalSaturation, "criticalSaturation", {0, -0.1, 1.1, kNaN, kInfinity});
  expectRefused(&Drying::Parameters::equilibriumSaturation, "equilibriumSaturation", {-0.1, 0.3, 0.5, kNaN, kInfinity});
  expectRefused(&Drying::Parameters::sides, "sides", {0, -1, 2.5, kNaN, kInfinity});
  Drying::Parameters parameters;
  parameters.air = btVector3(0, btScalar(kNaN), 0);
  EXPECT_EQ(rejection([&] { Drying{parameters}; }).find("Drying.air.y = nan"), 0u);
  parameters = {};
  parameters.exposure = 1.5;
  EXPECT_EQ(rejection([&] { Drying{parameters}; }).find("Drying.exposure = 1.5"), 0u);
}

TEST(DryingBadInput, OfASetterChangesNothing) {
  Line line;
  EXPECT_EQ(rejection([&] {
              adjust(line.effect, [](auto& p) {
                p.temperature = 99;
                p.relativeHumidity = 0.1;
              });
            }).find("Drying.temperature = 99"),
            0u);
  EXPECT_EQ(rejection([&] {
              adjust(line.effect, [](auto& p) {
                p.temperature = 30;
                p.relativeHumidity = 7;
              });
            }).find("Drying.relativeHumidity = 7"),
            0u);
  EXPECT_EQ(rejection([&] {
              adjust(line.effect, [](auto& p) { p.air = btVector3(0, 0, btScalar(kInfinity)); });
            }).find("Drying.air.z"),
            0u);
  EXPECT_EQ(rejection([&] { adjust(line.effect, [](auto& p) { p.exposure = -1.0; }); }).find("Drying.exposure = -1"),
            0u);
  EXPECT_NE(rejection([&] {
              adjust(line.effect, [](auto& p) { p.exposure = std::vector<double>(8, 1.0); });
            }).find("Drying.exposure.size() = 8"),
            std::string::npos);
  line.scene.preTick(100);
  Line untouched;
  untouched.scene.preTick(100);
  EXPECT_EQ(line.scene.cloth().held(4), untouched.scene.cloth().held(4));
}

TEST(DryingBadInput, ABodyThatDoesNotFitIsRefused) {
  ClothScene rope(WorldKind::softRigid, kEarthGravity, hangingRope(3, 0.1, 0.1));
  const std::string message = rejection([&] { rope.cloth().add<Drying>(); });
  EXPECT_NE(message.find("Drying: body.m_faces.size() = 0"), std::string::npos) << message;
  ClothScene patch(WorldKind::softRigid, kEarthGravity, levelPatch(3, 1));
  Drying::Parameters parameters;
  parameters.exposure = std::vector<double>(8, 1.0);
  EXPECT_NE(rejection([&] { patch.cloth().add<Drying>(parameters); }).find("size"), std::string::npos);
  EXPECT_TRUE(patch.cloth().effects().empty());
}

}  // namespace
}  // namespace wetcloth_test::drying_upkeep_test
