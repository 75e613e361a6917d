// SPDX-License-Identifier: Zlib
// What all effects promise of wrong parameters: setParameters() names the field and the value, and changes nothing.

#include "tests/effects/ParameterTrials.h"
#include "tests/support/Rejection.h"

#include <limits>

namespace wetcloth_test::parameter_mistakes_test {
namespace {

using namespace parameters;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// One way to spoil parameters, and what the message must name.
template <class P>
struct Mistake {
  void (*make)(P&);  // std::function of each would be most of this file to compile
  std::string field;
  std::string value;
};

template <class E>
using Mistakes = std::vector<Mistake<typename E::Parameters>>;

/// In each field that can be wrong.
template <class E>
Mistakes<E> mistakesIn();

template <>
Mistakes<Absorption> mistakesIn<Absorption>() {
  using P = Absorption::Parameters;
  return {{[](P& p) { p.exposure = -0.5; }, "Absorption.exposure", "-0.5"},
          {[](P& p) { p.exposure = std::vector<double>(3, 0.5); }, "Absorption.exposure.size()", "3"},
          {[](P& p) { p.waterVelocity.setY(btScalar(kNaN)); }, "Absorption.waterVelocity.y", "nan"},
          {[](P& p) { p.rampDuration = -2; }, "Absorption.rampDuration", "-2"}};
}

template <>
Mistakes<Immersion> mistakesIn<Immersion>() {
  using P = Immersion::Parameters;
  return {{[](P& p) { p.surface->normal.setZero(); }, "Immersion.surface.normal", "length 0"},
          {[](P& p) { p.surface->offset = kNaN; }, "Immersion.surface.offset", "nan"},
          {[](P& p) { p.surface->density = -1; }, "Immersion.surface.density", "-1"},
          {[](P& p) { p.surface->velocity.setX(btScalar(kNaN)); }, "Immersion.surface.velocity.x", "nan"}};
}

template <>
Mistakes<Rain> mistakesIn<Rain>() {
  using P = Rain::Parameters;
  return {{[](P& p) { p.direction.setZero(); }, "Rain.direction", "length 0"},
          {[](P& p) { p.flux = -1; }, "Rain.flux", "-1"},
          {[](P& p) { p.speed = kNaN; }, "Rain.speed", "nan"}};
}

template <>
Mistakes<Splash> mistakesIn<Splash>() {
  using P = Splash::Parameters;
  return {{[](P& p) {
             p.region = Splash::Sphere{btVector3(0, 0, 0), -1};
           },
           "Splash.region.radius", "-1"},
          {[](P& p) {
             p.region = Splash::Cone{btVector3(0, 0, 0), 2, 1};
           },
           "Splash.region.halfAngle", "2"},
          {[](P& p) { p.velocity.setZero(); }, "Splash.velocity", "length 0"},
          {[](P& p) { p.flux = -1; }, "Splash.flux", "-1"}};
}

template <>
Mistakes<ContactWetting> mistakesIn<ContactWetting>() {
  using P = ContactWetting::Parameters;
  return {{[](P& p) { p.wetBodies[0].body = nullptr; }, "ContactWetting.wetBodies[0].body", "null"},
          {[](P& p) { p.wetBodies[0].water = -1; }, "ContactWetting.wetBodies[0].water", "-1"},
          {[](P& p) { p.cloths = true; }, "ContactWetting.cloths", "VF_SS"},
          {[](P& p) { p.rate = -2; }, "ContactWetting.rate", "-2"}};
}

template <>
Mistakes<Diffusion> mistakesIn<Diffusion>() {
  using P = Diffusion::Parameters;
  return {{[](P& p) { p.warpDiffusivity = 0; }, "Diffusion.warpDiffusivity", "0"},
          {[](P& p) { p.weftDiffusivity = -3; }, "Diffusion.weftDiffusivity", "-3"},
          {[](P& p) { p.exponent = 101; }, "Diffusion.exponent", "101"},
          {[](P& p) { p.warp.setZero(); }, "Diffusion.warp", "length 0"},
          {[](P& p) { p.tolerance = 1; }, "Diffusion.tolerance", "1"}};
}

template <>
Mistakes<Seepage> mistakesIn<Seepage>() {
  using P = Seepage::Parameters;
  return {{[](P& p) { p.speed = -1; }, "Seepage.speed", "-1"},
          {[](P& p) { p.exponent = 0.5; }, "Seepage.exponent", "0.5"}};
}

template <>
Mistakes<Dripping> mistakesIn<Dripping>() {
  using P = Dripping::Parameters;
  return {{[](P& p) { p.holdingSaturation = 1.5; }, "Dripping.holdingSaturation", "1.5"},
          {[](P& p) { p.timeConstant = 0; }, "Dripping.timeConstant", "0"},
          {[](P& p) { p.dropMass = -1; }, "Dripping.dropMass", "-1"},
          {[](P& p) { p.slopeTolerance = 7; }, "Dripping.slopeTolerance", "7"},
          {[](P& p) { p.squeeze = -0.5; }, "Dripping.squeeze", "-0.5"}};
}

template <>
Mistakes<Drying> mistakesIn<Drying>() {
  using P = Drying::Parameters;
  return {{[](P& p) { p.temperature = 99; }, "Drying.temperature", "99"},
          {[](P& p) { p.relativeHumidity = -0.5; }, "Drying.relativeHumidity", "-0.5"},
          {[](P& p) { p.air = btVector3(0, btScalar(kNaN), 0); }, "Drying.air.y", "nan"},
          {[](P& p) { p.criticalSaturation = 0; }, "Drying.criticalSaturation", "0"},
          {[](P& p) { p.sides = 3; }, "Drying.sides", "3"},
          {[](P& p) { p.selfCooling = 0; }, "Drying.selfCooling", "0"},
          {[](P& p) { p.exposure = 2.0; }, "Drying.exposure", "2"},
          {[](P& p) { p.exposure = std::vector<double>(3, 0.5); }, "Drying.exposure.size()", "3"}};
}

template <>
Mistakes<WetStiffness> mistakesIn<WetStiffness>() {
  using P = WetStiffness::Parameters;
  return {{[](P& p) { p.wetStretch = 0; }, "WetStiffness.wetStretch", "0"},
          {[](P& p) { p.wetBending = 2000; }, "WetStiffness.wetBending", "2000"},
          {[](P& p) { p.dryDamping = -1; }, "WetStiffness.dryDamping", "-1"},
          {[](P& p) { p.wetDamping = kNaN; }, "WetStiffness.wetDamping", "nan"}};
}

template <>
Mistakes<Swelling> mistakesIn<Swelling>() {
  using P = Swelling::Parameters;
  return {{[](P& p) { p.saturatedStrain = -0.5; }, "Swelling.saturatedStrain", "-0.5"}};
}

template <>
Mistakes<Wind> mistakesIn<Wind>() {
  using P = Wind::Parameters;
  return {{[](P& p) { p.velocity = btVector3(0, 0, btScalar(kNaN)); }, "Wind.velocity.z", "nan"},
          {[](P& p) { p.airDensity = -1; }, "Wind.airDensity", "-1"},
          {[](P& p) { p.dragCoefficient = -2; }, "Wind.dragCoefficient", "-2"},
          {[](P& p) { p.skinFriction = -3; }, "Wind.skinFriction", "-3"},
          {[](P& p) { p.linearDrag = -4; }, "Wind.linearDrag", "-4"},
          {[](P& p) { p.paperForce = -5; }, "Wind.paperForce", "-5"}};
}

template <>
Mistakes<WaterDrag> mistakesIn<WaterDrag>() {
  using P = WaterDrag::Parameters;
  return {{[](P& p) { p.surface->density = -1; }, "WaterDrag.surface.density", "-1"},
          {[](P& p) { p.dragCoefficient = -2; }, "WaterDrag.dragCoefficient", "-2"},
          {[](P& p) { p.skinFriction = -3; }, "WaterDrag.skinFriction", "-3"},
          {[](P& p) { p.fibreDensity = 0; }, "WaterDrag.fibreDensity", "0"}};
}

template <>
Mistakes<Cling> mistakesIn<Cling>() {
  using P = Cling::Parameters;
  return {{[](P& p) { p.adhesion = -1; }, "Cling.adhesion", "-1"},
          {[](P& p) { p.shearStrength = kNaN; }, "Cling.shearStrength", "nan"},
          {[](P& p) { p.minimumSaturation = 1; }, "Cling.minimumSaturation", "1"},
          {[](P& p) { p.peakSaturation = 0; }, "Cling.peakSaturation", "0"},
          {[](P& p) { p.floodedShare = 1.5; }, "Cling.floodedShare", "1.5"}};
}

template <>
Mistakes<WetFriction> mistakesIn<WetFriction>() {
  using P = WetFriction::Parameters;
  return {{[](P& p) { p.wetFactor = -1; }, "WetFriction.wetFactor", "-1"},
          {[](P& p) { p.peakSaturation = 0; }, "WetFriction.peakSaturation", "0"},
          {[](P& p) { p.floodedFactor = kNaN; }, "WetFriction.floodedFactor", "nan"}};
}

template <>
Mistakes<HookeSprings> mistakesIn<HookeSprings>() {
  using P = HookeSprings::Parameters;
  return {{[](P& p) { p.stiffness = 0; }, "HookeSprings.stiffness", "0"},
          {[](P& p) { p.bendingStiffness = -1; }, "HookeSprings.bendingStiffness", "-1"},
          {[](P& p) { p.perLink = {-7}; }, "HookeSprings.perLink[0]", "-7"},
          {[](P& p) {
             p.perLink = {1, 2, 3};
           },
           "HookeSprings.perLink.size()", "3"},
          {[](P& p) { p.iterations = 0; }, "HookeSprings.iterations", "0"}};
}

template <>
Mistakes<CollisionAudit> mistakesIn<CollisionAudit>() {
  using P = CollisionAudit::Parameters;
  return {{[](P& p) { p.mostPairsPerFace = 0; }, "CollisionAudit.mostPairsPerFace", "0"}};
}

TEST_OF_EVERY_EFFECT(MistakesIn, ParametersOfARunningEffectAreRefusedAsAWhole) {
  Sample tried;
  Sample left;
  auto& effect = tried.cloth().template add<TypeParam>(before<TypeParam>(tried));
  left.cloth().template add<TypeParam>(before<TypeParam>(left));
  for (Sample* sample : {&tried, &left}) sample->scene.step(kSteps);
  for (const auto& mistake : mistakesIn<TypeParam>()) {
    auto parameters = after<TypeParam>(tried);
    mistake.make(parameters);
    const std::string message = rejection([&] { effect.setParameters(parameters); });
    EXPECT_EQ(message.find(mistake.field), 0u) << message;
    EXPECT_NE(message.find(mistake.value), std::string::npos) << message;
    EXPECT_EQ(values<TypeParam>(effect.parameters()), values<TypeParam>(before<TypeParam>(tried))) << mistake.field;
  }
  for (Sample* sample : {&tried, &left}) sample->scene.step(kSteps);
  EXPECT_EQ(tried.state(), left.state());
}

}  // namespace
}  // namespace wetcloth_test::parameter_mistakes_test
