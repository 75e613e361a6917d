// SPDX-License-Identifier: Zlib
#pragma once

#include "tests/effects/ParameterSample.h"
#include "tests/support/Test.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <tuple>
#include <variant>

// Parameters of each effect that the library has.

namespace wetcloth_test::parameters {

/// Of an effect: parameters `before`, under which it collects no history of its own, others in every field `after`, and
/// the values of all fields. Both are written into the defaults.
template <class E>
struct Trial;

template <class E>
struct TrialOf {
  using P = typename E::Parameters;
  static void before(P&, const Sample&) {}
};

template <class E>
typename E::Parameters before(const Sample& sample) {
  typename E::Parameters parameters;
  Trial<E>::before(parameters, sample);
  return parameters;
}

template <class E>
typename E::Parameters after(const Sample& sample) {
  typename E::Parameters parameters;
  Trial<E>::after(parameters, sample);
  return parameters;
}

template <class E>
auto values(const typename E::Parameters& parameters) {
  return Trial<E>::values(parameters);
}

inline auto valuesOf(const btVector3& v) { return std::make_tuple(v.x(), v.y(), v.z()); }
inline auto valuesOf(const std::optional<WaterSurface>& s) {
  const WaterSurface surface = s.value_or(WaterSurface());
  return std::make_tuple(s.has_value(), valuesOf(surface.normal), surface.offset, surface.density,
                         valuesOf(surface.velocity));
}
inline double valueOf(const Exposure& exposure) { return exposure.at(3, btVector3(0, 0, 0), btVector3(0, 1, 0), 0); }

template <>
struct Trial<Absorption> : TrialOf<Absorption> {
  static void before(P& p, const Sample&) { p.exposure = 0.0; }
  static void after(P& p, const Sample&) {
    p.exposure = 0.7;
    p.law = Absorption::Law::ramp;
    p.waterVelocity = btVector3(0, -1, 0);
    p.conservesMomentum = true;
    p.rampDuration = 3;
  }
  static auto values(const P& p) {
    return std::make_tuple(valueOf(p.exposure), p.law, valuesOf(p.waterVelocity), p.conservesMomentum, p.rampDuration);
  }
};

template <>
struct Trial<Immersion> : TrialOf<Immersion> {
  static void before(P& p, const Sample&) { p.surface = waterUpTo(-5); }
  static void after(P& p, const Sample&) { p.surface = waterUpTo(0.03); }
  static auto values(const P& p) { return valuesOf(p.surface); }
};

template <>
struct Trial<Rain> : TrialOf<Rain> {
  static void before(P& p, const Sample&) { p.flux = 0; }
  static void after(P& p, const Sample&) {
    p.direction = btVector3(1, -1, 0);
    p.flux = 0.05;
    p.speed = 3;
    p.selfShelter = true;
  }
  static auto values(const P& p) { return std::make_tuple(valuesOf(p.direction), p.flux, p.speed, p.selfShelter); }
};

template <>
struct Trial<Splash> : TrialOf<Splash> {
  static void before(P& p, const Sample&) { p.flux = 0; }
  static void after(P& p, const Sample&) {
    p.region = Splash::Sphere{btVector3(0, 0, 0), 0.2};
    p.velocity = btVector3(1, -3, 0);
    p.flux = 0.5;
  }
  static auto values(const P& p) {
    const auto& sphere = std::get<Splash::Sphere>(p.region);
    return std::make_tuple(valuesOf(sphere.centre), sphere.radius, valuesOf(p.velocity), p.flux);
  }
};

template <>
struct Trial<ContactWetting> : TrialOf<ContactWetting> {
  static void before(P& p, const Sample& sample) {
    p.wetBodies = {{&sample.floor(), 1}};
    p.rate = 0;
  }
  static void after(P& p, const Sample& sample) {
    p.wetBodies = {{&sample.floor(), 0.5}};
    p.rate = 0.3;
  }
  static auto values(const P& p) {
    return std::make_tuple(p.wetBodies[0].body, p.wetBodies[0].water, p.cloths, p.rate);
  }
};

template <>
struct Trial<Diffusion> : TrialOf<Diffusion> {
  static void after(P& p, const Sample&) {
    p.warpDiffusivity = 4e-5;
    p.weftDiffusivity = 1e-6;
    p.exponent = 1;
    p.warp = btVector3(1, 0, 1);
    p.method = Diffusion::Method::conjugateGradients;
    p.tolerance = 1e-6;
  }
  static auto values(const P& p) {
    return std::make_tuple(p.warpDiffusivity, p.weftDiffusivity, p.exponent, valuesOf(p.warp), p.method, p.tolerance);
  }
};

template <>
struct Trial<Seepage> : TrialOf<Seepage> {
  static void after(P& p, const Sample&) {
    p.speed = 5e-3;
    p.exponent = 2;
  }
  static auto values(const P& p) { return std::make_tuple(p.speed, p.exponent); }
};

template <>
struct Trial<Dripping> : TrialOf<Dripping> {
  static void before(P& p, const Sample&) { p.holdingSaturation = 1; }
  static void after(P& p, const Sample&) {
    p.holdingSaturation = 0.1;
    p.timeConstant = 0.5;
    p.dropMass = 1e-7;
    p.slopeTolerance = 0.5;
    p.squeeze = 0.5;
    p.onDrip = [](const Drip&) {};
  }
  static auto values(const P& p) {
    return std::make_tuple(p.holdingSaturation, p.timeConstant, p.dropMass, p.slopeTolerance, p.squeeze,
                           p.onDrip != nullptr);
  }
};

template <>
struct Trial<Drying> : TrialOf<Drying> {
  static void before(P& p, const Sample&) { p.relativeHumidity = 1; }
  static void after(P& p, const Sample&) {
    p.temperature = 40;
    p.relativeHumidity = 0.1;
    p.air = btVector3(2, 0, 0);
    p.criticalSaturation = 0.9;
    p.sides = 1;
    p.selfCooling = 0.8;
    p.exposure = 0.5;
  }
  static auto values(const P& p) {
    return std::make_tuple(p.temperature, p.relativeHumidity, valuesOf(p.air.constant()), p.criticalSaturation, p.sides,
                           p.selfCooling, valueOf(p.exposure));
  }
};

template <>
struct Trial<WetStiffness> : TrialOf<WetStiffness> {
  static void after(P& p, const Sample&) {
    p.wetStretch = 0.3;
    p.wetBending = 0.2;
    p.dryDamping = 1;
    p.wetDamping = 5;
  }
  static auto values(const P& p) { return std::make_tuple(p.wetStretch, p.wetBending, p.dryDamping, p.wetDamping); }
};

template <>
struct Trial<Swelling> : TrialOf<Swelling> {
  static void after(P& p, const Sample&) { p.saturatedStrain = 0.1; }
  static auto values(const P& p) { return p.saturatedStrain; }
};

template <>
struct Trial<Wind> : TrialOf<Wind> {
  static void after(P& p, const Sample&) {
    p.velocity = btVector3(3, 0, 1);
    p.law = Wind::Law::linear;
    p.airDensity = 2;
    p.dragCoefficient = 3;
    p.skinFriction = 0.1;
    p.linearDrag = 0.5;
    p.paperForce = 1;
    p.integration = Wind::Integration::explicitEuler;
  }
  static auto values(const P& p) {
    return std::make_tuple(valuesOf(p.velocity.constant()), p.law, p.airDensity, p.dragCoefficient, p.skinFriction,
                           p.linearDrag, p.paperForce, p.integration);
  }
};

template <>
struct Trial<WaterDrag> : TrialOf<WaterDrag> {
  static void before(P& p, const Sample&) { p.surface = waterUpTo(-5); }
  static void after(P& p, const Sample&) {
    p.surface = waterUpTo(0.03);
    p.dragCoefficient = 2;
    p.skinFriction = 0.5;
    p.fibreDensity = 1200;
  }
  static auto values(const P& p) {
    return std::make_tuple(valuesOf(p.surface), p.dragCoefficient, p.skinFriction, p.fibreDensity);
  }
};

template <>
struct Trial<Cling> : TrialOf<Cling> {
  static void before(P& p, const Sample&) {
    p.minimumSaturation = 0.98;
    p.peakSaturation = 0.99;
  }
  static void after(P& p, const Sample&) {
    p.adhesion = 500;
    p.shearStrength = 200;
    p.minimumSaturation = 0.05;
    p.peakSaturation = 0.3;
    p.floodedShare = 0.9;
  }
  static auto values(const P& p) {
    return std::make_tuple(p.adhesion, p.shearStrength, p.minimumSaturation, p.peakSaturation, p.floodedShare);
  }
};

template <>
struct Trial<WetFriction> : TrialOf<WetFriction> {
  static void after(P& p, const Sample&) {
    p.wetFactor = 4;
    p.peakSaturation = 0.3;
    p.floodedFactor = 0;
  }
  static auto values(const P& p) { return std::make_tuple(p.wetFactor, p.peakSaturation, p.floodedFactor); }
};

template <>
struct Trial<HookeSprings> : TrialOf<HookeSprings> {
  static void after(P& p, const Sample&) {
    p.stiffness = 300;
    p.bendingStiffness = 30;
    p.iterations = 2;
  }
  static auto values(const P& p) { return std::make_tuple(p.stiffness, p.bendingStiffness, p.perLink, p.iterations); }
};

template <>
struct Trial<CollisionAudit> : TrialOf<CollisionAudit> {
  static void before(P& p, const Sample&) { p.others = false; }
  static void after(P& p, const Sample&) {
    p.self = false;
    p.tier = collision::Tier::conservative;
    p.mostPairsPerFace = 10;
    p.onPassage = [](const Passage&) {};
  }
  static auto values(const P& p) {
    return std::make_tuple(p.self, p.others, p.tier, p.mostPairsPerFace, p.onPassage != nullptr);
  }
};

/// Asked for at each start of the program, whichever tests it runs: one sample does for all.
inline const Sample& sampleForNames() {
  static const Sample sample;
  return sample;
}

template <class E>
std::string nameOfEffect() {
  return std::string(E(before<E>(sampleForNames())).name());
}

template <class... E>
struct Effects {
  /// Adds the test `Of<E>::test()` for each effect: suite/effect.name
  template <template <class> class Of>
  static bool add(const std::string& suite, const char* name, const char* file, int line) {
    return (addTest((suite + "/" + nameOfEffect<E>()).c_str(), name, file, line, Of<E>::test) && ...);
  }
};

using AllEffects = Effects<Absorption, Immersion, Rain, Splash, ContactWetting, Diffusion, Seepage, Dripping, Drying,
                           WetStiffness, Swelling, Wind, WaterDrag, Cling, WetFriction, HookeSprings, CollisionAudit>;

}  // namespace wetcloth_test::parameters

// As GoogleTest's TYPED_TEST, which makes 25 functions of a test and a type: its body knows the effect as TypeParam.
#define TEST_OF_EVERY_EFFECT(suite, name)                                                              \
  template <class TypeParam>                                                                           \
  struct suite##_##name {                                                                              \
    static void test();                                                                                \
  };                                                                                                   \
  [[maybe_unused]] static const bool suite##_##name##_added =                                          \
      ::wetcloth_test::parameters::AllEffects::add<suite##_##name>(#suite, #name, __FILE__, __LINE__); \
  template <class TypeParam>                                                                           \
  void suite##_##name<TypeParam>::test()
