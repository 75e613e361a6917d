// SPDX-License-Identifier: Zlib
// How much water a node holds after a time: the exponential law, forward Euler, the ramp.

#include "tests/support/BulletWorld.h"
#include "tests/support/ClothScene.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Measures.h"
#include "tests/support/Patches.h"

#include <cmath>
#include <limits>
#include <vector>

namespace wetcloth_test::absorption_law_test {
namespace {

using wetcloth::Absorption;
using wetcloth::Fabric;
using wetcloth::Hook;
using Law = wetcloth::Absorption::Law;

/// A patch that only our part of the step runs on, so that any dt can be given.
class Soaking {
 public:
  explicit Soaking(Absorption::Parameters parameters, const Fabric& fabric = Fabric::cotton())
      : m_scene(WorldKind::softRigid, btVector3(0, 0, 0), levelPatch(3, 1), fabric, Hook::manual) {
    m_scene.cloth().add<Absorption>(std::move(parameters));
  }
  ClothScene& scene() { return m_scene; }
  void step(double dt, int count = 1) {
    for (int i = 0; i < count; ++i) m_scene.preTick(dt);
    m_time += double(btScalar(dt)) * count;  // what the float32 build was really told
  }
  double time() const { return m_time; }
  double saturation(int node = 4) { return m_scene.cloth().saturation(node); }

 private:
  ClothScene m_scene;
  double m_time = 0;
};

Absorption::Parameters with(Law law, double exposure = 1) {
  Absorption::Parameters parameters;
  parameters.law = law;
  parameters.exposure = exposure;
  return parameters;
}

/// dw/dt = e (C - w) / theta from w0, in parts of C.
double closedForm(double time, double timeConstant, double exposure = 1, double initial = 0) {
  return initial - (1 - initial) * std::expm1(-exposure * time / timeConstant);
}

constexpr double kTheta = 8.844;     // cotton [s]
constexpr double kRelative = 1e-12;  // rounding of the last digit is 2e-16 per step

TEST(AbsorptionLaw, ExponentialShareIsOneMinusExpAndKeepsItsDigitsWhenSmall) {
  EXPECT_EQ(wetcloth::exponentialShare(0), 0);
  EXPECT_NEAR(wetcloth::exponentialShare(1), 1 - std::exp(-1.0), 1e-15);
  EXPECT_NEAR(wetcloth::exponentialShare(0.01), 0.01 - 0.01 * 0.01 / 2 + 1e-6 / 6 - 1e-8 / 24, 1e-12);
  EXPECT_EQ(wetcloth::exponentialShare(1e-20), 1e-20);  // 1 - exp(-1e-20) computed as written is 0
  EXPECT_EQ(wetcloth::exponentialShare(1e6), 1);
}

TEST(AbsorptionLaw, TwoExponentialSharesMakeOneOfTwiceTheTime) {
  for (double rate : {1e-9, 1e-3, 0.3, 2.0, 20.0}) {
    const double once = wetcloth::exponentialShare(rate);
    EXPECT_NEAR(1 - (1 - once) * (1 - once), wetcloth::exponentialShare(2 * rate), 1e-15) << rate;
  }
}

TEST(AbsorptionLaw, EulerShareIsTheRateAndNeverMoreThanAll) {
  EXPECT_EQ(wetcloth::eulerShare(0), 0);
  EXPECT_EQ(wetcloth::eulerShare(0.25), 0.25);
  EXPECT_EQ(wetcloth::eulerShare(1.5), 1);
}

TEST(AbsorptionLaw, OneStepOfTenSecondsLandsOnTheClosedForm) {
  Soaking soaking(with(Law::exponential));
  soaking.step(10);
  EXPECT_NEAR(soaking.saturation() / closedForm(10, kTheta), 1, kRelative);
}

TEST(AbsorptionLaw, AHundredThousandStepsLandOnTheClosedForm) {
  Soaking soaking(with(Law::exponential));
  soaking.step(1e-4, 100000);
  EXPECT_NEAR(soaking.saturation() / closedForm(soaking.time(), kTheta), 1, kRelative);
}

TEST(AbsorptionLaw, MixedStepsLandOnTheClosedForm) {
  Soaking soaking(with(Law::exponential));
  for (double dt : {1.0 / 240, 3.0, 1e-6, 0.5, 1.0 / 60, 1e-3, 2.0}) soaking.step(dt, 7);
  EXPECT_NEAR(soaking.saturation() / closedForm(soaking.time(), kTheta), 1, kRelative);
}

TEST(AbsorptionLaw, PartialExposureSlowsTheClockDown) {
  for (double exposure : {0.01, 0.25, 0.9}) {
    Soaking soaking(with(Law::exponential, exposure));
    soaking.step(0.01, 500);
    EXPECT_NEAR(soaking.saturation() / closedForm(soaking.time(), kTheta, exposure), 1, kRelative) << exposure;
  }
}

TEST(AbsorptionLaw, AClothThatStartsPartlyWetFillsWhatIsFree) {
  Soaking soaking(with(Law::exponential, 0.5));
  soaking.scene().cloth().setSaturation(0.3);
  soaking.step(0.02, 400);
  EXPECT_NEAR(soaking.saturation() / closedForm(soaking.time(), kTheta, 0.5, 0.3), 1, kRelative);
}

TEST(AbsorptionLaw, TheBodysTimescaleIsPartOfTheStep) {
  Soaking soaking(with(Law::exponential));
  soaking.scene().body().m_cfg.timescale = btScalar(0.5);
  soaking.step(4);
  EXPECT_NEAR(soaking.saturation() / closedForm(2, kTheta), 1, kRelative);
}

TEST(AbsorptionLaw, EveryNodeOfAFullyExposedClothHasTheSameSaturation) {
  Soaking soaking(with(Law::exponential));
  soaking.step(0.1, 50);
  for (int node = 0; node < 9; ++node) {
    EXPECT_NEAR(soaking.saturation(node), closedForm(soaking.time(), kTheta), kRelative) << node;
  }
}

TEST(AbsorptionLaw, MassesGrowWithTheWater) {
  Soaking soaking(with(Law::exponential));
  const double before = freeMass(soaking.scene().body());
  soaking.step(5);
  // 1e-6: float32 holds a mass to 6e-8.
  EXPECT_NEAR(freeMass(soaking.scene().body()) / before, 1 + 0.84 * closedForm(5, kTheta), kIsDouble ? 1e-12 : 1e-6);
}

TEST(AbsorptionLaw, ForwardEulerConvergesWithOrderOne) {
  const auto error = [](int steps) {
    Soaking soaking(with(Law::forwardEuler));
    soaking.step(8.0 / steps, steps);
    return soaking.saturation() - closedForm(soaking.time(), kTheta);
  };
  const double coarse = error(64);
  const double fine = error(128);
  const double finest = error(256);
  EXPECT_GT(coarse, 1e-4);  // it is not the exact law
  // The next term of the error is dt / theta = 0.014 of the first at 64 steps, so the ratio is 2 to about 1 %.
  EXPECT_NEAR(coarse / fine, 2, 0.04);
  EXPECT_NEAR(fine / finest, 2, 0.02);
}

TEST(AbsorptionLaw, ForwardEulerStepIsTheRateTimesDt) {
  Soaking soaking(with(Law::forwardEuler));
  soaking.step(0.5, 2);
  const double share = 0.5 / kTheta;
  EXPECT_NEAR(soaking.saturation(), share + (1 - share) * share, 1e-14);
}

TEST(AbsorptionLaw, ForwardEulerDoesNotOverfillWithALongStep) {
  Soaking soaking(with(Law::forwardEuler));
  soaking.step(100, 3);
  EXPECT_DOUBLE_EQ(soaking.saturation(), 1);
}

TEST(AbsorptionLaw, RampFillsInTenSecondsLinearly) {
  Soaking soaking(with(Law::ramp));
  for (int second = 1; second <= 10; ++second) {
    soaking.step(1.0 / 64, 64);
    EXPECT_NEAR(soaking.saturation(), second / 10.0, 1e-12) << second;
  }
  soaking.step(1.0 / 64, 64);
  EXPECT_NEAR(soaking.saturation(), 1, 1e-15);
}

// Equal portions are rounded the same way each time: without a carry a million of them would be 1e-10 off.
TEST(AbsorptionLaw, AMillionEqualPortionsAreNotLostToRounding) {
  Soaking soaking(with(Law::ramp));
  soaking.step(7e-6, 1000000);
  EXPECT_NEAR(soaking.saturation() / (soaking.time() / 10), 1, kRelative);
}

TEST(AbsorptionLaw, RampScalesWithExposureAndDuration) {
  Absorption::Parameters parameters = with(Law::ramp, 0.5);
  parameters.rampDuration = 4;
  Soaking soaking(parameters);
  soaking.step(0.25, 8);
  EXPECT_NEAR(soaking.saturation(), 0.25, 1e-13);
}

TEST(AbsorptionLaw, RampStopsAtCapacityWithinAStep) {
  Soaking soaking(with(Law::ramp));
  soaking.scene().cloth().setSaturation(0.95);
  soaking.step(10);
  EXPECT_DOUBLE_EQ(soaking.saturation(), 1);
}

TEST(AbsorptionLaw, SaturatedNodeTakesNoMore) {
  for (Law law : {Law::exponential, Law::forwardEuler, Law::ramp}) {
    Soaking soaking(with(law));
    soaking.scene().cloth().setSaturation(1);
    const double held = soaking.scene().cloth().ledger().held;
    soaking.step(1, 100);
    EXPECT_EQ(soaking.scene().cloth().ledger().held, held);
    EXPECT_EQ(soaking.scene().cloth().ledger().absorbed, 0);
  }
}

TEST(AbsorptionLaw, OverfilledNodeNeitherTakesNorGives) {
  for (Law law : {Law::exponential, Law::forwardEuler, Law::ramp}) {
    Soaking soaking(with(law));
    std::vector<double> held(9, 0.0);
    held[4] = 3 * soaking.scene().cloth().capacity(4);
    soaking.scene().cloth().setHeld(held);
    soaking.step(1, 10);
    EXPECT_DOUBLE_EQ(soaking.saturation(4), 3);
    EXPECT_GT(soaking.saturation(0), 0.5);
  }
}

TEST(AbsorptionLaw, LedgerClosesAfterAHundredThousandSteps) {
  Soaking soaking(with(Law::exponential, 0.7));
  soaking.step(1e-4, 100000);
  const wetcloth::Ledger ledger = soaking.scene().cloth().ledger();
  EXPECT_GT(ledger.absorbed, 0);
  EXPECT_LE(std::fabs(ledger.imbalance()), 1e-12 * ledger.held);
}

/// Table I as the paper page reads it: alpha, theta, Q(10 s) / alpha, time to 95 %.
struct TableRow {
  Fabric fabric;
  double alpha;
  double theta;
  double shareAfterTenSeconds;
  double timeTo95;
};

TEST(AbsorptionLaw, TheThreeFabricsOfTableI) {
  const TableRow rows[] = {{Fabric::cotton(), 0.84, 8.844, 0.677, 26.5},
                           {Fabric::coarseWool(), 1.24, 4.8936, 0.870, 14.7},
                           {Fabric::highAbsorption(), 2.492, 3.3803, 0.948, 10.1}};
  for (const TableRow& row : rows) {
    SCOPED_TRACE(row.fabric.name);
    EXPECT_EQ(row.fabric.capacity, row.alpha);
    EXPECT_EQ(row.fabric.timeConstant, row.theta);

    Soaking soaking(with(Law::exponential), row.fabric);
    soaking.step(10);
    EXPECT_NEAR(soaking.saturation(), row.shareAfterTenSeconds, 0.0005);  // the page's three digits
    wetcloth::WetCloth& cloth = soaking.scene().cloth();
    EXPECT_NEAR(cloth.held(4) / cloth.dryMass(4), row.alpha * closedForm(10, row.theta), 1e-12);

    Soaking slowly(with(Law::exponential), row.fabric);
    while (slowly.saturation() < 0.95 && slowly.time() < 60) slowly.step(0.01);
    EXPECT_NEAR(slowly.time(), row.timeTo95, 0.05 + 0.01);  // the page's digit and one step
  }
}

TEST_IN_EVERY_WORLD(AbsorptionInWorld, FollowsTheClosedFormWhileTheClothFalls) {
  ClothScene scene(GetParam(), kEarthGravity, levelPatch(5, 1));
  scene.cloth().add<Absorption>();
  scene.step(512, kExactSubstep);
  for (int node = 0; node < 25; ++node) {
    EXPECT_NEAR(scene.cloth().saturation(node), closedForm(2, kTheta), 1e-12) << node;
  }
  EXPECT_NEAR(freeMass(scene.body()) / 0.150, 1 + 0.84 * closedForm(2, kTheta), kIsDouble ? 1e-12 : 1e-6);
}

TEST_IN_EVERY_WORLD(AbsorptionInWorld, PinnedNodesHoldWaterAndStayPinned) {
  wetcloth::ClothPatch patch = levelPatch(5, 1);
  patch.pinnedEdges = {wetcloth::ClothPatch::Edge::top};
  ClothScene scene(GetParam(), kEarthGravity, patch);
  scene.cloth().add<Absorption>();
  scene.step(256, kExactSubstep);
  for (int node = 20; node < 25; ++node) {
    EXPECT_NEAR(scene.cloth().saturation(node), closedForm(1, kTheta), 1e-12);
    EXPECT_EQ(scene.node(node).m_im, 0);
    EXPECT_EQ(scene.node(node).m_x.y(), 0);
  }
}

}  // namespace
}  // namespace wetcloth_test::absorption_law_test
