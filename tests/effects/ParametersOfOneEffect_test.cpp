// SPDX-License-Identifier: Zlib
// What single effects have to look after when their parameters are set.

#include "tests/effects/ParameterSample.h"
#include "tests/support/Rejection.h"

#include <gtest/gtest.h>

#include <string>

namespace wetcloth_test::parameters_of_one_effect_test {
namespace {

using namespace parameters;

TEST(Adjust, LeavesTheOtherParametersAsTheyAre) {
  Wind::Parameters parameters;
  parameters.dragCoefficient = 0.7;
  Wind wind(parameters);
  adjust(wind, [](auto& p) { p.velocity = btVector3(0, 0, 2); });
  EXPECT_EQ(wind.parameters().velocity.constant(), btVector3(0, 0, 2));
  EXPECT_EQ(wind.parameters().dragCoefficient, 0.7);
}

// One value per node, or as many as there were: what was right before a cut can be handed back after it.
TEST(ParametersAfterACut, MayBeHandedBack) {
  Sample sample;
  auto& soak = sample.cloth().add<Absorption>({std::vector<double>(25, 0.5)});
  sample.scene.body().appendNode(btVector3(0, 1, 0), btScalar(0.001));
  sample.scene.step(1);
  adjust(soak, [](auto& p) { p.rampDuration = 5; });
  EXPECT_EQ(soak.parameters().rampDuration, 5);
  adjust(soak, [](auto& p) { p.exposure = std::vector<double>(26, 0.5); });
  EXPECT_NE(rejection([&] { adjust(soak, [](auto& p) { p.exposure = std::vector<double>(25, 0.5); }); }), "");
}

TEST(DiffusionParameters, KeepTheWarpOfWhenTheEffectWasAdded) {
  const auto run = [](bool changes) {
    Sample sample;
    Diffusion::Parameters parameters;
    parameters.warpDiffusivity = changes ? 1e-6 : 4e-5;
    auto& effect = sample.cloth().add<Diffusion>(parameters);
    const btQuaternion quarter(btVector3(0, 1, 0), SIMD_HALF_PI);
    sample.scene.body().transform(btTransform(quarter, btVector3(0, 1, 0)));
    adjust(effect, [](auto& p) { p.warpDiffusivity = 4e-5; });
    sample.scene.step(kSteps);
    std::vector<double> held;
    for (int i = 0; i < sample.cloth().nodeCount(); ++i) held.push_back(sample.cloth().held(i));
    return held;
  };
  EXPECT_EQ(run(true), run(false));
}

TEST(WetStiffnessParameters, OfFactorsOneGiveTheLinksTheirConstantsBack) {
  Sample sample;
  const std::vector<double> before = sample.state();
  auto& effect = sample.cloth().add<WetStiffness>();
  sample.scene.preTick(kSubstep);
  EXPECT_NE(sample.state(), before);
  adjust(effect, [](auto& p) { p.wetStretch = p.wetBending = 1; });
  EXPECT_EQ(sample.state(), before);
}

TEST(WetStiffnessParameters, ThatTheDeformableWorldCannotReadAreRefusedThere) {
  Sample sample(WorldKind::deformable);
  WetStiffness::Parameters parameters;
  parameters.wetStretch = parameters.wetBending = 1;
  auto& effect = sample.cloth().add<WetStiffness>(parameters);
  const auto soften = [&] { adjust(effect, [](auto& p) { p.wetStretch = 0.5; }); };
  EXPECT_NE(rejection(soften).find("HookeSprings"), std::string::npos);
  EXPECT_EQ(effect.parameters().wetStretch, 1);
  sample.cloth().add<HookeSprings>();
  EXPECT_EQ(rejection(soften), "");
}

TEST(WindParameters, WakeAClothThatFeelsThem) {
  Sample sample(WorldKind::deformable);
  auto& wind = sample.cloth().add<Wind>({btVector3(3, 0, 0)});
  sample.scene.step(1);
  const Step step = {kSubstep, kSubstep, kEarthGravity};
  wind.setParameters(Wind::Parameters(wind.parameters()));
  EXPECT_FALSE(wind.wakes(sample.cloth(), step));
  adjust(wind, [](auto& p) { p.dragCoefficient = 2; });
  EXPECT_TRUE(wind.wakes(sample.cloth(), step));
}

TEST(WaterDragParameters, WakeAClothInTheWater) {
  Sample sample(WorldKind::deformable);
  auto& water = sample.cloth().add<WaterDrag>({waterUpTo(1)});
  sample.scene.step(1);
  const Step step = {kSubstep, kSubstep, kEarthGravity};
  water.setParameters(WaterDrag::Parameters(water.parameters()));
  EXPECT_FALSE(water.wakes(sample.cloth(), step));
  adjust(water, [](auto& p) { p.fibreDensity = 1000; });
  EXPECT_TRUE(water.wakes(sample.cloth(), step));
}

TEST(ContactWettingFilms, AreGivenAsTheyAreNow) {
  Sample sample;
  ContactWetting::Parameters parameters;
  parameters.wetBodies = {{&sample.floor(), 0.5}};
  parameters.rate = 0.3;
  auto& wetting = sample.cloth().add<ContactWetting>(parameters);
  sample.scene.step(2 * kSteps);
  const double left = wetting.film(sample.floor());
  EXPECT_LT(left, 0.5);
  adjust(wetting, [](auto& p) { p.rate = 0.01; });
  EXPECT_EQ(wetting.film(sample.floor()), left);
}

TEST(CollisionAuditParameters, KeepTheTotalsWhenTheTierChanges) {
  Sample sample;
  auto& audit = sample.cloth().add<CollisionAudit>();
  sample.scene.step(kSteps);
  const AuditTotals before = audit.totals();
  ASSERT_GT(before.candidatePairs, 0);
  adjust(audit, [](auto& p) { p.tier = collision::Tier::conservative; });
  EXPECT_EQ(audit.totals().candidatePairs, before.candidatePairs);
  sample.scene.step(kSteps);
  EXPECT_GT(audit.totals().candidatePairs, before.candidatePairs);
  EXPECT_GT(audit.totals().substeps, before.substeps);
}

}  // namespace
}  // namespace wetcloth_test::parameters_of_one_effect_test
