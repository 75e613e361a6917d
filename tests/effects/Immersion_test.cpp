// SPDX-License-Identifier: Zlib
// Nodes below a water surface soak by the fabric's own law; the waterline moves with the cloth and with the water.

#include "bullet_wetcloth/effects/Immersion.h"
#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/ClothScene.h"
#include "tests/support/Measures.h"
#include "tests/support/Patches.h"
#include "tests/support/Rejection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace wetcloth_test::immersion_test {
namespace {

using wetcloth::Fabric;
using wetcloth::Hook;
using wetcloth::Immersion;
using wetcloth::WaterSurface;

constexpr double kTheta = 8.844;  // cotton [s]
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double soaked(double time) { return -std::expm1(-time / kTheta); }

/// Below y = level.
WaterSurface levelAt(double level) {
  WaterSurface surface;
  surface.offset = -level;
  return surface;
}

/// Below x = 0.
WaterSurface wall() {
  WaterSurface surface;
  surface.normal = btVector3(1, 0, 0);
  return surface;
}

/// 5 x 5 nodes, columns at x = -0.5, -0.25, 0, 0.25, 0.5; only our part of the step, without gravity.
struct Bath {
  explicit Bath(const Immersion::Parameters& parameters)
      : scene(WorldKind::softRigid, btVector3(0, 0, 0), levelPatch(5, 1), Fabric::cotton(), Hook::manual),
        effect(scene.cloth().add<Immersion>(parameters)) {}
  double saturation(int node) { return scene.cloth().saturation(node); }
  ClothScene scene;
  Immersion& effect;
};

TEST(ImmersionShare, IsTheExponentialBelowTheSurfaceAndNothingAbove) {
  EXPECT_NEAR(wetcloth::immersionShare(0.1, 2, 4), 1 - std::exp(-0.5), 1e-15);  // rounding of a number of about 1
  EXPECT_EQ(wetcloth::immersionShare(1e-9, 2, 4), wetcloth::immersionShare(100, 2, 4)) << "depth does not matter";
  EXPECT_EQ(wetcloth::immersionShare(0, 2, 4), 0);
  EXPECT_EQ(wetcloth::immersionShare(-1, 2, 4), 0);
  EXPECT_EQ(wetcloth::immersionShare(kNaN, 2, 4), 0);
  EXPECT_EQ(wetcloth::immersionShare(1, 1e6, 4), 1);
}

TEST(ImmersionLaw, WetsTheColumnsThatAreBelow) {
  Bath bath({wall()});
  bath.scene.preTick(2);
  for (int node = 0; node < 25; ++node) {
    EXPECT_NEAR(bath.saturation(node), node % 5 < 2 ? soaked(2) : 0, 1e-14) << node;
  }
}

TEST(ImmersionLaw, IsExactForAnyStep) {
  for (const double dt : {1e-6, 1e-3, 1.0 / 60, 1.0, 30.0, 1e3}) {
    Bath bath({wall()});
    const int steps = dt < 1e-4 ? 1000 : 50;
    for (int i = 0; i < steps; ++i) bath.scene.preTick(dt);
    // 1e-12: the promise of Absorption, whose carry it shares; the float32 build is told a rounded dt.
    EXPECT_NEAR(bath.saturation(0) / soaked(double(btScalar(dt)) * steps), 1, 1e-12) << dt;
    EXPECT_LE(bath.saturation(0), 1 + 1e-15) << dt;
    EXPECT_EQ(bath.saturation(2), 0) << dt;
  }
}

TEST(ImmersionLaw, DoesNotSettleBeforeASlowExponentialIsAtItsEnd) {
  Bath bath({wall()});
  // Each step moves 1e-10 of the capacity, which SteadyState alone would take for rest.
  for (int i = 0; i < 1000; ++i) bath.scene.preTick(1e-9);
  EXPECT_NEAR(bath.saturation(0) / soaked(1000 * double(btScalar(1e-9))), 1, 1e-9);
}

TEST(ImmersionLaw, TheSurfaceMayBeTiltedAndItsNormalOfAnyLength) {
  WaterSurface surface;
  surface.normal = btVector3(3, 0, 4);
  surface.offset = 5 * 0.06;  // 0.6 x + 0.8 z + 0.06 < 0
  Bath bath({surface});
  bath.scene.preTick(1);
  for (int node = 0; node < 25; ++node) {
    const btVector3& x = bath.scene.node(node).m_x;
    const bool isBelow = 0.6 * double(x.x()) + 0.8 * double(x.z()) + 0.06 < 0;
    EXPECT_NEAR(bath.saturation(node), isBelow ? soaked(1) : 0, 1e-14) << node;
  }
}

TEST(ImmersionLaw, LeavesAnOverfullNodeAlone) {
  Bath bath({levelAt(1)});
  std::vector<double> held(25, 0.0);
  held[7] = 3 * bath.scene.cloth().capacity(7);
  bath.scene.cloth().setHeld(held);
  bath.scene.preTick(1e3);
  EXPECT_DOUBLE_EQ(bath.saturation(7), 3);
  EXPECT_DOUBLE_EQ(bath.saturation(8), 1);
}

TEST(ImmersionLaw, ClosesTheLedger) {
  Bath bath({wall()});
  for (int i = 0; i < 10000; ++i) bath.scene.preTick(0.001);
  const wetcloth::Ledger ledger = bath.scene.cloth().ledger();
  EXPECT_GT(ledger.absorbed, 0);
  EXPECT_LE(std::fabs(ledger.imbalance()), 1e-12 * ledger.held);
}

TEST(ImmersionMomentum, WaterArrivesWithItsOwnVelocity) {
  WaterSurface river = levelAt(1);
  river.velocity = btVector3(2, 0, btScalar(-0.5));
  Bath bath({river});
  setVelocity(bath.scene.body(), btVector3(0, 1, 0));
  const auto before = momentum(bath.scene.body());
  for (int i = 0; i < 20; ++i) bath.scene.preTick(1);
  const double absorbed = bath.scene.cloth().ledger().absorbed;
  const auto after = momentum(bath.scene.body());
  for (int k = 0; k < 3; ++k) {
    const auto c = std::size_t(k);
    // The brief's bounds; 20 roundings of 25 velocities stay well below.
    EXPECT_NEAR(after[c], before[c] + absorbed * double(river.velocity[k]), absorbed * (kIsDouble ? 1e-12 : 1e-5)) << k;
  }
}

TEST(ImmersionSurface, IsBulletsOwnUnlessItIsGiven) {
  ClothScene scene(WorldKind::softRigid, btVector3(0, 0, 0), levelPatch(5, 1), Fabric::cotton(), Hook::manual);
  scene.bullet().info().water_normal = btVector3(2, 0, 0);  // below x = 0
  scene.cloth().add<Immersion>();
  scene.preTick(1);
  for (int node = 0; node < 25; ++node) {
    EXPECT_NEAR(scene.cloth().saturation(node), node % 5 < 2 ? soaked(1) : 0, 1e-14) << node;
  }
}

// While it idles, too: each change is one of Bullet's own fields, which nobody tells us about.
TEST(ImmersionSurface, OfBulletMayChangeAtAnyTime) {
  ClothScene scene(WorldKind::softRigid, btVector3(0, 0, 0), levelPatch(5, 1), Fabric::cotton(), Hook::manual);
  btSoftBodyWorldInfo& info = scene.bullet().info();
  info.water_normal = btVector3(0, 1, 0);
  info.water_offset = 1;  // below y = -1: the cloth is above
  Immersion& effect = scene.cloth().add<Immersion>();
  for (int i = 0; i < 100; ++i) scene.preTick(1);
  ASSERT_EQ(scene.cloth().ledger().held, 0);
  const long long visited = effect.nodesVisited();

  info.water_offset = -1;
  scene.preTick(1);
  EXPECT_EQ(effect.nodesVisited(), visited + 25);
  EXPECT_NEAR(scene.cloth().saturation(7), soaked(1), 1e-14);

  info.water_normal = btVector3(0, 0, 0);  // let out
  scene.preTick(1);
  EXPECT_EQ(effect.nodesVisited(), visited + 25);
  EXPECT_NEAR(scene.cloth().saturation(7), soaked(1), 1e-14);

  info.water_normal = btVector3(0, btScalar(kNaN), 0);
  scene.preTick(1);
  info.water_normal = btVector3(0, 1, 0);
  info.water_offset = btScalar(kNaN);
  scene.preTick(1);
  EXPECT_NEAR(scene.cloth().saturation(7), soaked(1), 1e-14) << "what is no number is no water";

  info.water_offset = -1;
  scene.preTick(1);
  EXPECT_NEAR(scene.cloth().saturation(7), soaked(2), 1e-14);
}

TEST(ImmersionSurface, MayBeSetAndGivenUp) {
  Bath bath({levelAt(-1)});
  for (int i = 0; i < 100; ++i) bath.scene.preTick(1);
  adjust(bath.effect, [&](auto& p) { p.surface = levelAt(1); });
  bath.scene.preTick(1);
  EXPECT_NEAR(bath.saturation(0), soaked(1), 1e-14);
  adjust(bath.effect, [](auto& p) { p.surface = std::nullopt; });  // and Bullet has none
  bath.scene.preTick(1);
  EXPECT_NEAR(bath.saturation(0), soaked(1), 1e-14);
}

// The squares of these lengths are no float any more.
TEST(ImmersionInWater, WhoseNormalIsOfAnyLength) {
  for (const double length : {1e-30, 1e25}) {
    WaterSurface surface = levelAt(1);
    surface.normal = btVector3(0, btScalar(length), 0);
    surface.offset *= length;
    Bath bath({surface});
    bath.scene.preTick(1);
    EXPECT_NEAR(bath.saturation(0), soaked(1), 1e-14) << length;
  }
}

TEST(ImmersionBadInput, WithoutWaterIsRefusedAndTheClothIsAsItWas) {
  ClothScene scene(WorldKind::softRigid, btVector3(0, 0, 0), levelPatch(5, 1), Fabric::cotton(), Hook::manual);
  const std::string message = rejection([&] { scene.cloth().add<Immersion>(); });
  EXPECT_NE(message.find("Immersion.surface"), std::string::npos) << message;
  EXPECT_NE(message.find("water_normal"), std::string::npos) << message;
  EXPECT_TRUE(scene.cloth().effects().empty());
}

TEST(ImmersionBadInput, NamesTheFieldAndChangesNothing) {
  Bath bath({levelAt(1)});
  const auto refused = [&](const WaterSurface& surface, const char* field) {
    EXPECT_NE(rejection([&] { Immersion{{surface}}; }).find(field), std::string::npos) << field;
    EXPECT_NE(rejection([&] { adjust(bath.effect, [&](auto& p) { p.surface = surface; }); }).find(field),
              std::string::npos)
        << field;
  };
  for (const double bad : {kNaN, kInfinity, -kInfinity}) {
    WaterSurface surface;
    surface.normal = btVector3(0, btScalar(bad), 0);
    refused(surface, "Immersion.surface.normal.y");
    surface = WaterSurface();
    surface.offset = bad;
    refused(surface, "Immersion.surface.offset");
    surface = WaterSurface();
    surface.velocity = btVector3(0, 0, btScalar(bad));
    refused(surface, "Immersion.surface.velocity.z");
    surface = WaterSurface();
    surface.density = bad;
    refused(surface, "Immersion.surface.density");
  }
  WaterSurface flat;
  flat.normal = btVector3(0, 0, 0);
  refused(flat, "Immersion.surface.normal");
  bath.scene.preTick(1);
  EXPECT_NEAR(bath.saturation(0), soaked(1), 1e-14);
}

}  // namespace
}  // namespace wetcloth_test::immersion_test
