// A cloth that dries: the closed form for one step or many, climate, wind, exposure, idling, bad input.

#include "bullet_wetcloth/effects/Drying.h"

#include "tests/support/ClothScene.h"
#include "tests/support/CoreScene.h"

#include <cmath>
#include <limits>
#include <vector>

namespace wetcloth_test {
namespace {

using wetcloth::Drying;
using wetcloth::dryingStep;
using wetcloth::dryingTime;
using wetcloth::evaporationRate;
using wetcloth::Exposure;
using wetcloth::Fabric;
using wetcloth::Hook;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A saturated 3 x 3 cloth of 1 m^2; only our part of the step runs. Node 4, in the middle, has a quarter of its area.
struct Line {
  explicit Line(Drying::Parameters parameters = {})
      : scene(WorldKind::softRigid, kEarthGravity, levelPatch(3, 1), Fabric::cotton(), Hook::manual),
        effect(scene.cloth().add<Drying>(std::move(parameters))) {
    scene.cloth().setSaturation(1);
  }
  double held(int node = 4) { return scene.cloth().held(node); }
  double capacity(int node = 4) { return scene.cloth().capacity(node); }
  ClothScene scene;
  Drying& effect;
};

constexpr double kArea = 0.25;  // [m^2] of node 4

/// 2 sides at 20 degrees, 50 % [kg/s].
double rate(double airSpeed = 0, double humidity = 0.5, double temperature = 20) {
  return 2 * kArea * evaporationRate(temperature, humidity, airSpeed);
}

// The patch's area and mass are sums of btScalar lengths and masses.
constexpr double kGeometry = kIsDouble ? 1e-12 : 1e-6;

// --- the closed form --------------------------------------------------------------------------------------------

// Cotton holds 126 g/m^2: 1240 s at the constant rate down to 0.3, then exponential with 531 s.
TEST(Drying, FollowsTheClosedFormWhateverTheStep) {
  for (const double time : {1000.0, 1280.0, 2000.0, 5000.0}) {
    for (const int steps : {1, 7, 100, 10000}) {
      Line line;
      const double dt = double(btScalar(time / steps));  // what the float32 build is really told
      for (int i = 0; i < steps; ++i) line.scene.preTick(dt);
      const double expected = line.capacity() - dryingStep(line.capacity(), 0.3 * line.capacity(), rate(), steps * dt);
      EXPECT_NEAR(line.held() / expected, 1, 10 * kGeometry) << time << " s in " << steps;
    }
  }
}

TEST(Drying, TakesTheDryingTimeOfTheClosedForm) {
  Line line;
  const double dt = 0.5;
  double time = 0;
  while (line.held() > 0.05 * line.capacity() && time < 1e4) {
    line.scene.preTick(dt);
    time += dt;
  }
  EXPECT_NEAR(time, dryingTime(line.capacity(), 0.05 * line.capacity(), 0.3 * line.capacity(), rate()), dt);
}

// Equal portions of a constant rate are rounded the same way each time: the carry keeps a million of them exact.
TEST(Drying, ManyEqualPortionsAreNotLostToRounding) {
  Line line;
  const double dt = 1.0 / 4096;
  for (int i = 0; i < 1 << 18; ++i) line.scene.preTick(dt);  // 64 s
  const double dried = line.scene.cloth().ledger().evaporated / (2 * evaporationRate(20, 0.5, 0));
  EXPECT_NEAR(dried / 64, 1, kGeometry);
  Line once;
  once.scene.preTick(64);
  EXPECT_NEAR(line.held() / once.held(), 1, 1e-14) << "the same to the last digits, in one step or 262144";
}

TEST(Drying, StaysWithinBoundsForAnyStep) {
  for (const double dt : {1e-6, 1.0 / 240, 1.0, 600.0, 1e6}) {
    Line line;
    double before = line.held();
    for (int i = 0; i < 100; ++i) {
      line.scene.preTick(dt);
      ASSERT_GE(line.held(), 0) << dt;
      ASSERT_LE(line.held(), before) << dt;
      before = line.held();
    }
    const wetcloth::Ledger ledger = line.scene.cloth().ledger();
    EXPECT_GT(ledger.evaporated, 0) << dt;
    EXPECT_LE(std::fabs(ledger.imbalance()), 1e-12 * ledger.initial) << dt;
  }
}

TEST(Drying, OfAnOverfullNodeIsTheSameLaw) {
  Line line;
  line.scene.cloth().setHeld(std::vector<double>(9, 2 * line.capacity()));
  line.scene.preTick(3600);
  const double expected = 2 * line.capacity() - dryingStep(2 * line.capacity(), 0.3 * line.capacity(), rate(), 3600);
  EXPECT_NEAR(line.held() / expected, 1, 10 * kGeometry);
}

// The whole cloth loses what its whole area gives, though a corner has less area than an inner node.
TEST(Drying, IsByArea) {
  Line line;
  line.scene.preTick(100);
  EXPECT_NEAR(line.scene.cloth().ledger().evaporated / (200 * evaporationRate(20, 0.5, 0)), 1, kGeometry);
}

// --- climate, wind, exposure ------------------------------------------------------------------------------------

double driedIn100Seconds(Line& line) {
  const double before = line.held();
  line.scene.preTick(100);
  return before - line.held();
}

TEST(Drying, FollowsTheClimate) {
  Line line;
  line.effect.setClimate(35, 0.25);
  EXPECT_NEAR(driedIn100Seconds(line) / (100 * rate(0, 0.25, 35)), 1, kGeometry);
  line.effect.setClimate(20, 1);
  EXPECT_EQ(driedIn100Seconds(line), 0);
}

TEST(Drying, InWindIsFasterAsTheFormulaSays) {
  Line line;
  line.effect.setAir(btVector3(3, 0, 4));
  EXPECT_NEAR(driedIn100Seconds(line) / (100 * rate(5)), 1, kGeometry);
  line.effect.setAir([](const btVector3&, double time) { return btVector3(btScalar(time / 50), 0, 0); });
  EXPECT_NEAR(driedIn100Seconds(line) / (100 * rate(2)), 1, kGeometry) << "at the start of the step, 100 s";
}

TEST(Drying, CountsTheAirsSpeedRelativeToTheCloth) {
  Line line;
  line.effect.setAir(btVector3(3, 0, 0));
  setVelocity(line.scene.body(), btVector3(3, 0, 0));
  EXPECT_NEAR(driedIn100Seconds(line) / (100 * rate(0)), 1, kGeometry);
  setVelocity(line.scene.body(), btVector3(-1, 0, 0));
  EXPECT_NEAR(driedIn100Seconds(line) / (100 * rate(4)), 1, kGeometry);
}

TEST(Drying, OfOneSideIsHalfAsFast) {
  Drying::Parameters parameters;
  parameters.sides = 1;
  Line line(parameters);
  EXPECT_NEAR(driedIn100Seconds(line) / (50 * rate()), 1, kGeometry);
}

TEST(Drying, FollowsTheExposure) {
  Line line;
  line.effect.setExposure(0.25);
  EXPECT_NEAR(driedIn100Seconds(line) / (25 * rate()), 1, kGeometry);
  std::vector<double> perNode(9, 0.0);
  perNode[4] = 0.5;
  line.effect.setExposure(perNode);
  const double other = line.held(0);
  EXPECT_NEAR(driedIn100Seconds(line) / (50 * rate()), 1, kGeometry);
  EXPECT_EQ(line.held(0), other);
  line.effect.setExposure([](const btVector3&, const btVector3& normal) { return std::fabs(double(normal.y())); });
  EXPECT_NEAR(driedIn100Seconds(line) / (100 * rate()), 1, 1e-5);  // a normal is of length 1 to some 1e-6 in float32
}

TEST(Drying, LeavesTheVelocities) {
  Line line;
  const btVector3 velocity(2, -1, btScalar(0.5));
  setVelocity(line.scene.body(), velocity);
  line.scene.preTick(600);
  for (int i = 0; i < 9; ++i) EXPECT_EQ(line.scene.node(i).m_v, velocity);
  EXPECT_NEAR(double(line.scene.node(4).m_im) * line.scene.cloth().water().totalMass(4), 1, kGeometry);
}

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
  under.effect.setExposure(1.0);
  under.scene.preTick(1);
  EXPECT_GT(under.scene.cloth().ledger().evaporated, 0);
}

// --- in Bullet's worlds -----------------------------------------------------------------------------------------

class DryingInWorld : public InEveryWorld {};

TEST_P(DryingInWorld, OfAPinnedClothFollowsTheClosedForm) {
  wetcloth::ClothPatch patch = levelPatch(3, 1);
  patch.pinnedNodes = {0, 1, 2, 3, 4, 5, 6, 7, 8};
  Drying::Parameters parameters;
  parameters.air = btVector3(5, 0, 0);
  ClothScene scene(GetParam(), kEarthGravity, patch);
  scene.cloth().add<Drying>(parameters);
  scene.cloth().setSaturation(1);
  scene.step(512, kExactSubstep);
  const double capacity = scene.cloth().capacity(4);
  const double dried = dryingStep(capacity, 0.3 * capacity, rate(5), 2);
  EXPECT_NEAR((capacity - scene.cloth().held(4)) / dried, 1, kGeometry);
}

TEST_P(DryingInWorld, GoesOnWhenTheClothIsCut) {
  ClothScene scene(GetParam(), kEarthGravity, core::hangingPatch(5));
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
  EXPECT_TRUE(core::isFinite(body));
}

WETCLOTH_IN_EVERY_WORLD(DryingInWorld);

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
  EXPECT_EQ(rejection([&] { line.effect.setClimate(99, 0.1); }).find("Drying.temperature = 99"), 0u);
  EXPECT_EQ(rejection([&] { line.effect.setClimate(30, 7); }).find("Drying.relativeHumidity = 7"), 0u);
  EXPECT_EQ(rejection([&] { line.effect.setAir(btVector3(0, 0, btScalar(kInfinity))); }).find("Drying.air.z"), 0u);
  EXPECT_EQ(rejection([&] { line.effect.setExposure(-1.0); }).find("Drying.exposure = -1"), 0u);
  EXPECT_NE(rejection([&] { line.effect.setExposure(std::vector<double>(8, 1.0)); }).find("Drying.exposure.size() = 8"),
            std::string::npos);
  EXPECT_NEAR(driedIn100Seconds(line) / (100 * rate()), 1, kGeometry);
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
}  // namespace wetcloth_test
