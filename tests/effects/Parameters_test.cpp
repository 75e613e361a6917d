// SPDX-License-Identifier: Zlib
// What all effects promise of their parameters: parameters() gives back what was given, and setParameters() changes a
// running effect into one that was made with them.

#include "tests/effects/ParameterTrials.h"

#include <type_traits>

namespace wetcloth_test::parameters_test {
namespace {

using namespace parameters;

TEST_OF_EVERY_EFFECT(ParametersOf, TheEffectAreThoseThatItWasGiven) {
  Sample sample;
  auto& effect = sample.cloth().template add<TypeParam>(before<TypeParam>(sample));
  EXPECT_EQ(values<TypeParam>(effect.parameters()), values<TypeParam>(before<TypeParam>(sample)));
  effect.setParameters(after<TypeParam>(sample));
  EXPECT_EQ(values<TypeParam>(effect.parameters()), values<TypeParam>(after<TypeParam>(sample)));
}

TEST_OF_EVERY_EFFECT(ParametersOf, ARunningEffectMakeItOneThatWasMadeWithThem) {
  Sample changed;
  Sample replaced;
  auto& effect = changed.cloth().template add<TypeParam>(before<TypeParam>(changed));
  auto& old = replaced.cloth().template add<TypeParam>(before<TypeParam>(replaced));
  for (Sample* sample : {&changed, &replaced}) sample->scene.step(kSteps);
  ASSERT_EQ(changed.state(), replaced.state());

  effect.setParameters(after<TypeParam>(changed));
  replaced.cloth().remove(old);
  replaced.cloth().template add<TypeParam>(after<TypeParam>(replaced));
  for (Sample* sample : {&changed, &replaced}) sample->scene.step(kSteps);
  EXPECT_EQ(changed.state(), replaced.state());
}

TEST_OF_EVERY_EFFECT(ParametersOf, ARunningEffectShowInTheNextStep) {
  Sample changed;
  Sample left;
  auto& effect = changed.cloth().template add<TypeParam>(before<TypeParam>(changed));
  left.cloth().template add<TypeParam>(before<TypeParam>(left));
  effect.setParameters(after<TypeParam>(changed));
  for (Sample* sample : {&changed, &left}) sample->scene.step(kSteps);
  const bool onlyLooks = std::is_same_v<TypeParam, CollisionAudit>;
  EXPECT_EQ(changed.state() == left.state(), onlyLooks);
}

TEST_OF_EVERY_EFFECT(ParametersOf, ARunningEffectMayBeSetToWhatTheyAre) {
  Sample set;
  Sample left;
  auto& effect = set.cloth().template add<TypeParam>(after<TypeParam>(set));
  left.cloth().template add<TypeParam>(after<TypeParam>(left));
  for (int i = 0; i < kSteps; ++i) {
    effect.setParameters(typename TypeParam::Parameters(effect.parameters()));
    for (Sample* sample : {&set, &left}) sample->scene.step(1);
  }
  EXPECT_EQ(set.state(), left.state());
}

}  // namespace
}  // namespace wetcloth_test::parameters_test
