// SPDX-License-Identifier: Zlib
// What all effects promise of their parameters: parameters() gives back what was given, and setParameters() changes a
// running effect into one that was made with them, or throws and changes nothing.

#include "tests/support/ClothScene.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <variant>
#include <vector>

namespace wetcloth_test::parameters_test {
namespace {

using namespace wetcloth;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr int kSteps = 12;

/// A half wet cloth that slides on a box with one edge and hangs above it with the rest. What an effect does shows in
/// its motion, its water or its links.
class Sample {
 public:
  explicit Sample(WorldKind kind = WorldKind::softRigid)
      : m_box(btVector3(2, btScalar(0.5), 2)),
        m_floor(0, nullptr, &m_box),
        scene(kind, kEarthGravity, [](btSoftBodyWorldInfo& info) { return tiltedPatch().build(info); }) {
    m_floor.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(0, btScalar(-0.5), 0)));
    scene.bullet().world().addRigidBody(&m_floor);
    std::vector<double> held;
    for (int i = 0; i < scene.body().m_nodes.size(); ++i) {
      held.push_back(scene.cloth().capacity(i) * (0.2 + 0.7 * i / scene.body().m_nodes.size()));
      scene.node(i).m_v = btVector3(btScalar(0.01 * i), btScalar(-0.1), btScalar(0.2));
    }
    scene.cloth().setHeld(held);
  }
  ~Sample() { scene.bullet().world().removeRigidBody(&m_floor); }

  const btCollisionObject& floor() const { return m_floor; }
  WetCloth& cloth() { return scene.cloth(); }

  std::vector<double> state() {
    std::vector<double> values;
    for (int i = 0; i < scene.body().m_nodes.size(); ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        values.push_back(double(scene.node(i).m_x[axis]));
        values.push_back(double(scene.node(i).m_v[axis]));
      }
      values.push_back(cloth().held(i));
    }
    for (int k = 0; k < scene.body().m_links.size(); ++k) {
      values.push_back(double(scene.body().m_links[k].m_rl));
      values.push_back(double(scene.body().m_links[k].m_c0));
    }
    return values;
  }

 private:
  static ClothPatch tiltedPatch() {
    ClothPatch patch = levelPatch(5, 0.3);
    patch.origin.setY(btScalar(0.01));
    patch.edgeU.setY(btScalar(0.05));
    return patch;
  }

  btBoxShape m_box;
  btRigidBody m_floor;

 public:
  ClothScene scene;  // goes before the floor
};

/// One way to spoil parameters, and what the message must name.
template <class P>
struct Mistake {
  std::function<void(P&)> make;
  std::string field;
  std::string value;
};

/// Of an effect: parameters `before`, under which it has collected no history of its own, others in every field
/// `after`, mistakes in each field that can be wrong, and the values of all fields.
template <class E>
struct Trial;

auto valuesOf(const btVector3& v) { return std::make_tuple(v.x(), v.y(), v.z()); }
auto valuesOf(const std::optional<WaterSurface>& s) {
  const WaterSurface surface = s.value_or(WaterSurface());
  return std::make_tuple(s.has_value(), valuesOf(surface.normal), surface.offset, surface.density,
                         valuesOf(surface.velocity));
}
double valueOf(const Exposure& exposure) { return exposure.at(3, btVector3(0, 0, 0), btVector3(0, 1, 0)); }

WaterSurface waterUpTo(double level) {
  WaterSurface surface;
  surface.offset = -level;
  return surface;
}

template <>
struct Trial<Absorption> {
  using P = Absorption::Parameters;
  static P before(const Sample&) {
    P p;
    p.exposure = 0.0;
    return p;
  }
  static P after(const Sample&) {
    P p;
    p.exposure = 0.7;
    p.law = Absorption::Law::ramp;
    p.waterVelocity = btVector3(0, -1, 0);
    p.conservesMomentum = true;
    p.rampDuration = 3;
    return p;
  }
  static auto values(const P& p) {
    return std::make_tuple(valueOf(p.exposure), p.law, valuesOf(p.waterVelocity), p.conservesMomentum, p.rampDuration);
  }
  static std::vector<Mistake<P>> mistakes() {
    return {{[](P& p) { p.exposure = -0.5; }, "Absorption.exposure", "-0.5"},
            {[](P& p) { p.exposure = std::vector<double>(3, 0.5); }, "Absorption.exposure.size()", "3"},
            {[](P& p) { p.waterVelocity.setY(btScalar(kNaN)); }, "Absorption.waterVelocity.y", "nan"},
            {[](P& p) { p.rampDuration = -2; }, "Absorption.rampDuration", "-2"}};
  }
};

template <>
struct Trial<Immersion> {
  using P = Immersion::Parameters;
  static P before(const Sample&) { return {waterUpTo(-5)}; }
  static P after(const Sample&) { return {waterUpTo(0.03)}; }
  static auto values(const P& p) { return valuesOf(p.surface); }
  static std::vector<Mistake<P>> mistakes() {
    return {{[](P& p) { p.surface->normal.setZero(); }, "Immersion.surface.normal", "length 0"},
            {[](P& p) { p.surface->offset = kNaN; }, "Immersion.surface.offset", "nan"},
            {[](P& p) { p.surface->density = -1; }, "Immersion.surface.density", "-1"},
            {[](P& p) { p.surface->velocity.setX(btScalar(kNaN)); }, "Immersion.surface.velocity.x", "nan"}};
  }
};

template <>
struct Trial<Rain> {
  using P = Rain::Parameters;
  static P before(const Sample&) {
    P p;
    p.flux = 0;
    return p;
  }
  static P after(const Sample&) {
    P p;
    p.direction = btVector3(1, -1, 0);
    p.flux = 0.05;
    p.speed = 3;
    p.selfShelter = true;
    return p;
  }
  static auto values(const P& p) { return std::make_tuple(valuesOf(p.direction), p.flux, p.speed, p.selfShelter); }
  static std::vector<Mistake<P>> mistakes() {
    return {{[](P& p) { p.direction.setZero(); }, "Rain.direction", "length 0"},
            {[](P& p) { p.flux = -1; }, "Rain.flux", "-1"},
            {[](P& p) { p.speed = kNaN; }, "Rain.speed", "nan"}};
  }
};

template <>
struct Trial<Splash> {
  using P = Splash::Parameters;
  static P before(const Sample&) {
    P p;
    p.flux = 0;
    return p;
  }
  static P after(const Sample&) {
    P p;
    p.region = Splash::Sphere{btVector3(0, 0, 0), 0.2};
    p.velocity = btVector3(1, -3, 0);
    p.flux = 0.5;
    return p;
  }
  static auto values(const P& p) {
    const auto& sphere = std::get<Splash::Sphere>(p.region);
    return std::make_tuple(valuesOf(sphere.centre), sphere.radius, valuesOf(p.velocity), p.flux);
  }
  static std::vector<Mistake<P>> mistakes() {
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
};

template <>
struct Trial<ContactWetting> {
  using P = ContactWetting::Parameters;
  static P before(const Sample& sample) {
    P p;
    p.wetBodies = {{&sample.floor(), 1}};
    p.rate = 0;
    return p;
  }
  static P after(const Sample& sample) {
    P p;
    p.wetBodies = {{&sample.floor(), 0.5}};
    p.rate = 0.3;
    return p;
  }
  static auto values(const P& p) {
    return std::make_tuple(p.wetBodies[0].body, p.wetBodies[0].water, p.cloths, p.rate);
  }
  static std::vector<Mistake<P>> mistakes() {
    return {{[](P& p) { p.wetBodies[0].body = nullptr; }, "ContactWetting.wetBodies[0].body", "null"},
            {[](P& p) { p.wetBodies[0].water = -1; }, "ContactWetting.wetBodies[0].water", "-1"},
            {[](P& p) { p.cloths = true; }, "ContactWetting.cloths", "VF_SS"},
            {[](P& p) { p.rate = -2; }, "ContactWetting.rate", "-2"}};
  }
};

template <>
struct Trial<Diffusion> {
  using P = Diffusion::Parameters;
  static P before(const Sample&) { return {}; }
  static P after(const Sample&) {
    P p;
    p.warpDiffusivity = 4e-5;
    p.weftDiffusivity = 1e-6;
    p.exponent = 1;
    p.warp = btVector3(1, 0, 1);
    p.method = Diffusion::Method::conjugateGradients;
    p.tolerance = 1e-6;
    return p;
  }
  static auto values(const P& p) {
    return std::make_tuple(p.warpDiffusivity, p.weftDiffusivity, p.exponent, valuesOf(p.warp), p.method, p.tolerance);
  }
  static std::vector<Mistake<P>> mistakes() {
    return {{[](P& p) { p.warpDiffusivity = 0; }, "Diffusion.warpDiffusivity", "0"},
            {[](P& p) { p.weftDiffusivity = -3; }, "Diffusion.weftDiffusivity", "-3"},
            {[](P& p) { p.exponent = 101; }, "Diffusion.exponent", "101"},
            {[](P& p) { p.warp.setZero(); }, "Diffusion.warp", "length 0"},
            {[](P& p) { p.tolerance = 1; }, "Diffusion.tolerance", "1"}};
  }
};

template <>
struct Trial<Seepage> {
  using P = Seepage::Parameters;
  static P before(const Sample&) { return {}; }
  static P after(const Sample&) {
    P p;
    p.speed = 5e-3;
    p.exponent = 2;
    return p;
  }
  static auto values(const P& p) { return std::make_tuple(p.speed, p.exponent); }
  static std::vector<Mistake<P>> mistakes() {
    return {{[](P& p) { p.speed = -1; }, "Seepage.speed", "-1"},
            {[](P& p) { p.exponent = 0.5; }, "Seepage.exponent", "0.5"}};
  }
};

template <>
struct Trial<Dripping> {
  using P = Dripping::Parameters;
  static P before(const Sample&) {
    P p;
    p.holdingSaturation = 1;
    return p;
  }
  static P after(const Sample&) {
    P p;
    p.holdingSaturation = 0.1;
    p.timeConstant = 0.5;
    p.dropMass = 1e-7;
    p.slopeTolerance = 0.5;
    p.onDrip = [](const Drip&) {};
    return p;
  }
  static auto values(const P& p) {
    return std::make_tuple(p.holdingSaturation, p.timeConstant, p.dropMass, p.slopeTolerance, p.onDrip != nullptr);
  }
  static std::vector<Mistake<P>> mistakes() {
    return {{[](P& p) { p.holdingSaturation = 1.5; }, "Dripping.holdingSaturation", "1.5"},
            {[](P& p) { p.timeConstant = 0; }, "Dripping.timeConstant", "0"},
            {[](P& p) { p.dropMass = -1; }, "Dripping.dropMass", "-1"},
            {[](P& p) { p.slopeTolerance = 7; }, "Dripping.slopeTolerance", "7"}};
  }
};

template <>
struct Trial<Drying> {
  using P = Drying::Parameters;
  static P before(const Sample&) {
    P p;
    p.relativeHumidity = 1;
    return p;
  }
  static P after(const Sample&) {
    P p;
    p.temperature = 40;
    p.relativeHumidity = 0.1;
    p.air = btVector3(2, 0, 0);
    p.criticalSaturation = 0.9;
    p.sides = 1;
    p.selfCooling = 0.8;
    p.exposure = 0.5;
    return p;
  }
  static auto values(const P& p) {
    return std::make_tuple(p.temperature, p.relativeHumidity, valuesOf(p.air.constant()), p.criticalSaturation, p.sides,
                           p.selfCooling, valueOf(p.exposure));
  }
  static std::vector<Mistake<P>> mistakes() {
    return {{[](P& p) { p.temperature = 99; }, "Drying.temperature", "99"},
            {[](P& p) { p.relativeHumidity = -0.5; }, "Drying.relativeHumidity", "-0.5"},
            {[](P& p) { p.air = btVector3(0, btScalar(kNaN), 0); }, "Drying.air.y", "nan"},
            {[](P& p) { p.criticalSaturation = 0; }, "Drying.criticalSaturation", "0"},
            {[](P& p) { p.sides = 3; }, "Drying.sides", "3"},
            {[](P& p) { p.selfCooling = 0; }, "Drying.selfCooling", "0"},
            {[](P& p) { p.exposure = 2.0; }, "Drying.exposure", "2"},
            {[](P& p) { p.exposure = std::vector<double>(3, 0.5); }, "Drying.exposure.size()", "3"}};
  }
};

template <>
struct Trial<WetStiffness> {
  using P = WetStiffness::Parameters;
  static P before(const Sample&) { return {}; }
  static P after(const Sample&) {
    P p;
    p.wetStretch = 0.3;
    p.wetBending = 0.2;
    p.dryDamping = 1;
    p.wetDamping = 5;
    return p;
  }
  static auto values(const P& p) { return std::make_tuple(p.wetStretch, p.wetBending, p.dryDamping, p.wetDamping); }
  static std::vector<Mistake<P>> mistakes() {
    return {{[](P& p) { p.wetStretch = 0; }, "WetStiffness.wetStretch", "0"},
            {[](P& p) { p.wetBending = 2000; }, "WetStiffness.wetBending", "2000"},
            {[](P& p) { p.dryDamping = -1; }, "WetStiffness.dryDamping", "-1"},
            {[](P& p) { p.wetDamping = kNaN; }, "WetStiffness.wetDamping", "nan"}};
  }
};

template <>
struct Trial<Swelling> {
  using P = Swelling::Parameters;
  static P before(const Sample&) { return {}; }
  static P after(const Sample&) {
    P p;
    p.saturatedStrain = 0.1;
    return p;
  }
  static auto values(const P& p) { return p.saturatedStrain; }
  static std::vector<Mistake<P>> mistakes() {
    return {{[](P& p) { p.saturatedStrain = -0.5; }, "Swelling.saturatedStrain", "-0.5"}};
  }
};

template <>
struct Trial<Wind> {
  using P = Wind::Parameters;
  static P before(const Sample&) { return {}; }
  static P after(const Sample&) {
    P p;
    p.velocity = btVector3(3, 0, 1);
    p.law = Wind::Law::linear;
    p.airDensity = 2;
    p.dragCoefficient = 3;
    p.skinFriction = 0.1;
    p.linearDrag = 0.5;
    p.paperForce = 1;
    p.integration = Wind::Integration::explicitEuler;
    return p;
  }
  static auto values(const P& p) {
    return std::make_tuple(valuesOf(p.velocity.constant()), p.law, p.airDensity, p.dragCoefficient, p.skinFriction,
                           p.linearDrag, p.paperForce, p.integration);
  }
  static std::vector<Mistake<P>> mistakes() {
    return {{[](P& p) { p.velocity = btVector3(0, 0, btScalar(kNaN)); }, "Wind.velocity.z", "nan"},
            {[](P& p) { p.airDensity = -1; }, "Wind.airDensity", "-1"},
            {[](P& p) { p.dragCoefficient = -2; }, "Wind.dragCoefficient", "-2"},
            {[](P& p) { p.skinFriction = -3; }, "Wind.skinFriction", "-3"},
            {[](P& p) { p.linearDrag = -4; }, "Wind.linearDrag", "-4"},
            {[](P& p) { p.paperForce = -5; }, "Wind.paperForce", "-5"}};
  }
};

template <>
struct Trial<WaterDrag> {
  using P = WaterDrag::Parameters;
  static P before(const Sample&) {
    P p;
    p.surface = waterUpTo(-5);
    return p;
  }
  static P after(const Sample&) {
    P p;
    p.surface = waterUpTo(0.03);
    p.dragCoefficient = 2;
    p.skinFriction = 0.5;
    p.fibreDensity = 1200;
    return p;
  }
  static auto values(const P& p) {
    return std::make_tuple(valuesOf(p.surface), p.dragCoefficient, p.skinFriction, p.fibreDensity);
  }
  static std::vector<Mistake<P>> mistakes() {
    return {{[](P& p) { p.surface->density = -1; }, "WaterDrag.surface.density", "-1"},
            {[](P& p) { p.dragCoefficient = -2; }, "WaterDrag.dragCoefficient", "-2"},
            {[](P& p) { p.skinFriction = -3; }, "WaterDrag.skinFriction", "-3"},
            {[](P& p) { p.fibreDensity = 0; }, "WaterDrag.fibreDensity", "0"}};
  }
};

template <>
struct Trial<Cling> {
  using P = Cling::Parameters;
  static P before(const Sample&) {
    P p;
    p.minimumSaturation = 0.98;
    p.peakSaturation = 0.99;
    return p;
  }
  static P after(const Sample&) {
    P p;
    p.adhesion = 500;
    p.shearStrength = 200;
    p.minimumSaturation = 0.05;
    p.peakSaturation = 0.3;
    p.floodedShare = 0.9;
    return p;
  }
  static auto values(const P& p) {
    return std::make_tuple(p.adhesion, p.shearStrength, p.minimumSaturation, p.peakSaturation, p.floodedShare);
  }
  static std::vector<Mistake<P>> mistakes() {
    return {{[](P& p) { p.adhesion = -1; }, "Cling.adhesion", "-1"},
            {[](P& p) { p.shearStrength = kNaN; }, "Cling.shearStrength", "nan"},
            {[](P& p) { p.minimumSaturation = 1; }, "Cling.minimumSaturation", "1"},
            {[](P& p) { p.peakSaturation = 0; }, "Cling.peakSaturation", "0"},
            {[](P& p) { p.floodedShare = 1.5; }, "Cling.floodedShare", "1.5"}};
  }
};

template <>
struct Trial<WetFriction> {
  using P = WetFriction::Parameters;
  static P before(const Sample&) { return {}; }
  static P after(const Sample&) {
    P p;
    p.wetFactor = 4;
    p.peakSaturation = 0.3;
    p.floodedFactor = 0;
    return p;
  }
  static auto values(const P& p) { return std::make_tuple(p.wetFactor, p.peakSaturation, p.floodedFactor); }
  static std::vector<Mistake<P>> mistakes() {
    return {{[](P& p) { p.wetFactor = -1; }, "WetFriction.wetFactor", "-1"},
            {[](P& p) { p.peakSaturation = 0; }, "WetFriction.peakSaturation", "0"},
            {[](P& p) { p.floodedFactor = kNaN; }, "WetFriction.floodedFactor", "nan"}};
  }
};

template <>
struct Trial<HookeSprings> {
  using P = HookeSprings::Parameters;
  static P before(const Sample&) { return {}; }
  static P after(const Sample&) {
    P p;
    p.stiffness = 300;
    p.bendingStiffness = 30;
    p.iterations = 2;
    return p;
  }
  static auto values(const P& p) { return std::make_tuple(p.stiffness, p.bendingStiffness, p.perLink, p.iterations); }
  static std::vector<Mistake<P>> mistakes() {
    return {{[](P& p) { p.stiffness = 0; }, "HookeSprings.stiffness", "0"},
            {[](P& p) { p.bendingStiffness = -1; }, "HookeSprings.bendingStiffness", "-1"},
            {[](P& p) { p.perLink = {-7}; }, "HookeSprings.perLink[0]", "-7"},
            {[](P& p) {
               p.perLink = {1, 2, 3};
             },
             "HookeSprings.perLink.size()", "3"},
            {[](P& p) { p.iterations = 0; }, "HookeSprings.iterations", "0"}};
  }
};

template <>
struct Trial<CollisionAudit> {
  using P = CollisionAudit::Parameters;
  static P before(const Sample&) {
    P p;
    p.others = false;
    return p;
  }
  static P after(const Sample&) {
    P p;
    p.self = false;
    p.tier = collision::Tier::conservative;
    p.mostPairsPerFace = 10;
    p.onPassage = [](const Passage&) {};
    return p;
  }
  static auto values(const P& p) {
    return std::make_tuple(p.self, p.others, p.tier, p.mostPairsPerFace, p.onPassage != nullptr);
  }
  static std::vector<Mistake<P>> mistakes() {
    return {{[](P& p) { p.mostPairsPerFace = 0; }, "CollisionAudit.mostPairsPerFace", "0"}};
  }
};

template <class E>
class ParametersOf : public testing::Test {};

using AllEffects =
    testing::Types<Absorption, Immersion, Rain, Splash, ContactWetting, Diffusion, Seepage, Dripping, Drying,
                   WetStiffness, Swelling, Wind, WaterDrag, Cling, WetFriction, HookeSprings, CollisionAudit>;

struct EffectName {
  template <class E>
  static std::string GetName(int) {
    return std::string(E(Trial<E>::before(Sample())).name());
  }
};

TYPED_TEST_SUITE(ParametersOf, AllEffects, EffectName);

TYPED_TEST(ParametersOf, TheEffectAreThoseThatItWasGiven) {
  using T = Trial<TypeParam>;
  Sample sample;
  auto& effect = sample.cloth().template add<TypeParam>(T::before(sample));
  EXPECT_EQ(T::values(effect.parameters()), T::values(T::before(sample)));
  effect.setParameters(T::after(sample));
  EXPECT_EQ(T::values(effect.parameters()), T::values(T::after(sample)));
}

TYPED_TEST(ParametersOf, ARunningEffectMakeItOneThatWasMadeWithThem) {
  using T = Trial<TypeParam>;
  Sample changed;
  Sample replaced;
  auto& effect = changed.cloth().template add<TypeParam>(T::before(changed));
  auto& old = replaced.cloth().template add<TypeParam>(T::before(replaced));
  for (Sample* sample : {&changed, &replaced}) sample->scene.step(kSteps);
  ASSERT_EQ(changed.state(), replaced.state());

  effect.setParameters(T::after(changed));
  replaced.cloth().remove(old);
  replaced.cloth().template add<TypeParam>(T::after(replaced));
  for (Sample* sample : {&changed, &replaced}) sample->scene.step(kSteps);
  EXPECT_EQ(changed.state(), replaced.state());
}

TYPED_TEST(ParametersOf, ARunningEffectShowInTheNextStep) {
  using T = Trial<TypeParam>;
  Sample changed;
  Sample left;
  auto& effect = changed.cloth().template add<TypeParam>(T::before(changed));
  left.cloth().template add<TypeParam>(T::before(left));
  effect.setParameters(T::after(changed));
  for (Sample* sample : {&changed, &left}) sample->scene.step(kSteps);
  const bool onlyLooks = std::is_same_v<TypeParam, CollisionAudit>;
  EXPECT_EQ(changed.state() == left.state(), onlyLooks);
}

TYPED_TEST(ParametersOf, ARunningEffectMayBeSetToWhatTheyAre) {
  using T = Trial<TypeParam>;
  Sample set;
  Sample left;
  auto& effect = set.cloth().template add<TypeParam>(T::after(set));
  left.cloth().template add<TypeParam>(T::after(left));
  for (int i = 0; i < kSteps; ++i) {
    effect.setParameters(typename TypeParam::Parameters(effect.parameters()));
    for (Sample* sample : {&set, &left}) sample->scene.step(1);
  }
  EXPECT_EQ(set.state(), left.state());
}

TYPED_TEST(ParametersOf, ARunningEffectAreRefusedAsAWhole) {
  using T = Trial<TypeParam>;
  Sample tried;
  Sample left;
  auto& effect = tried.cloth().template add<TypeParam>(T::before(tried));
  left.cloth().template add<TypeParam>(T::before(left));
  for (Sample* sample : {&tried, &left}) sample->scene.step(kSteps);
  for (const auto& mistake : T::mistakes()) {
    auto parameters = T::after(tried);
    mistake.make(parameters);
    const std::string message = rejection([&] { effect.setParameters(parameters); });
    EXPECT_EQ(message.find(mistake.field), 0u) << message;
    EXPECT_NE(message.find(mistake.value), std::string::npos) << message;
    EXPECT_EQ(T::values(effect.parameters()), T::values(T::before(tried))) << mistake.field;
  }
  for (Sample* sample : {&tried, &left}) sample->scene.step(kSteps);
  EXPECT_EQ(tried.state(), left.state());
}

// --- what single effects have to look after -------------------------------------------------------------------------

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
  auto& wetting = sample.cloth().add<ContactWetting>(Trial<ContactWetting>::after(sample));
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
}  // namespace wetcloth_test::parameters_test
