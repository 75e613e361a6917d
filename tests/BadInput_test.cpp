// SPDX-License-Identifier: Zlib
// Bad input is refused where it is given, with the field's name and the value, and leaves everything as it was.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BodyState.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Materials.h"
#include "tests/support/Patches.h"

#include <limits>
#include <stdexcept>

namespace wetcloth_test::bad_input_test {

namespace {

const double kNaN = std::numeric_limits<double>::quiet_NaN();
const double kInfinity = std::numeric_limits<double>::infinity();
const btScalar kScalarNaN = std::numeric_limits<btScalar>::quiet_NaN();

// The message of the std::invalid_argument that `action` throws; empty when it throws nothing.
template <class Action>
std::string refusalOf(Action action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

// A cloth with one effect of each kind, and what must not change when something is refused.
class BadInput {
 protected:
  BadInput() : scene(GetParam(), hangingPatch(4)), wet(scene.world()), cloth(wet.add(scene.body())) {
    wet.setLog({});
    cloth.setSaturation(0.25);
  }

  template <class Action>
  void expectRefused(Action action, const std::string& field, const std::string& value) {
    const std::vector<btScalar> state = stateOf(scene.body());
    const double held = cloth.ledger().held;
    const std::size_t effects = cloth.effects().size();
    const std::string message = refusalOf(action);
    EXPECT_NE(message.find(field), std::string::npos) << "names " << field << ": '" << message << "'";
    EXPECT_NE(message.find(value), std::string::npos) << "shows " << value << ": '" << message << "'";
    EXPECT_EQ(message.find('\n'), std::string::npos) << "one line";
    EXPECT_TRUE(sameBits(stateOf(scene.body()), state));
    EXPECT_EQ(cloth.ledger().held, held);
    EXPECT_EQ(cloth.effects().size(), effects);
    scene.bullet().step(1);
    EXPECT_TRUE(isFinite(scene.body()));
  }

  template <class E>
  void expectParametersRefused(const typename E::Parameters& parameters, const std::string& field,
                               const std::string& value) {
    expectRefused([&] { cloth.add<E>(parameters); }, field, value);
  }

  BodyScene scene;
  wetcloth::WetClothWorld wet;
  wetcloth::WetCloth& cloth;
};

TEST_F_IN_EVERY_WORLD(BadInput, Exposure) {
  using wetcloth::Absorption;
  expectParametersRefused<Absorption>({kNaN}, "exposure", "nan");
  expectParametersRefused<Absorption>({kInfinity}, "exposure", "inf");
  expectParametersRefused<Absorption>({-0.25}, "exposure", "-0.25");
  expectParametersRefused<Absorption>({1.5}, "exposure", "1.5");
  std::vector<double> values(16, 0.5);
  values[9] = 7.25;
  expectParametersRefused<Absorption>({values}, "exposure", "7.25");
  values[9] = kNaN;
  expectParametersRefused<Absorption>({values}, "exposure", "nan");
  expectParametersRefused<Absorption>({std::vector<double>(15, 0.5)}, "exposure", "15");
}

TEST_F_IN_EVERY_WORLD(BadInput, ExposureChangedLater) {
  wetcloth::Absorption& soak = cloth.add<wetcloth::Absorption>({std::vector<double>(16, 0.5)});
  expectRefused([&] { adjust(soak, [](auto& p) { p.exposure = 2.5; }); }, "exposure", "2.5");
  expectRefused([&] { adjust(soak, [](auto& p) { p.exposure = std::vector<double>(17, 0.5); }); }, "exposure", "17");
  EXPECT_EQ(soak.parameters().exposure.at(3, btVector3(0, 0, 0), btVector3(0, 1, 0), 0), 0.5) << "still the old one";
}

TEST_F_IN_EVERY_WORLD(BadInput, OtherParametersOfAbsorption) {
  wetcloth::Absorption::Parameters parameters;
  parameters.rampDuration = -2.5;
  expectParametersRefused<wetcloth::Absorption>(parameters, "rampDuration", "-2.5");
  parameters.rampDuration = 0;
  expectParametersRefused<wetcloth::Absorption>(parameters, "rampDuration", "0");
  parameters.rampDuration = kNaN;
  expectParametersRefused<wetcloth::Absorption>(parameters, "rampDuration", "nan");
  parameters.rampDuration = 10;
  parameters.waterVelocity = btVector3(0, kScalarNaN, 0);
  expectParametersRefused<wetcloth::Absorption>(parameters, "waterVelocity", "nan");
}

TEST_F_IN_EVERY_WORLD(BadInput, WindVelocity) {
  expectParametersRefused<wetcloth::Wind>({btVector3(kScalarNaN, 0, 0)}, "velocity", "nan");
  expectParametersRefused<wetcloth::Wind>({btVector3(0, 0, btScalar(-kInfinity))}, "velocity", "-inf");
  wetcloth::Wind& wind = cloth.add<wetcloth::Wind>({btVector3(1, 2, 3)});
  expectRefused([&] { adjust(wind, [](auto& p) { p.velocity = btVector3(0, kScalarNaN, 0); }); }, "velocity", "nan");
  EXPECT_TRUE(wind.parameters().velocity.constant() == btVector3(1, 2, 3)) << "still the old one";
}

TEST_F_IN_EVERY_WORLD(BadInput, OtherParametersOfWind) {
  const auto refused = [this](double wetcloth::Wind::Parameters::*field, const std::string& name) {
    for (const auto& [value, text] :
         {std::pair<double, std::string>{-1.5, "-1.5"}, {kNaN, "nan"}, {kInfinity, "inf"}}) {
      wetcloth::Wind::Parameters parameters;
      parameters.*field = value;
      expectParametersRefused<wetcloth::Wind>(parameters, name, text);
    }
  };
  refused(&wetcloth::Wind::Parameters::airDensity, "airDensity");
  refused(&wetcloth::Wind::Parameters::dragCoefficient, "dragCoefficient");
  refused(&wetcloth::Wind::Parameters::skinFriction, "skinFriction");
  refused(&wetcloth::Wind::Parameters::linearDrag, "linearDrag");
  refused(&wetcloth::Wind::Parameters::paperForce, "paperForce");
}

TEST_F_IN_EVERY_WORLD(BadInput, Springs) {
  using wetcloth::HookeSprings;
  expectParametersRefused<HookeSprings>(springsOf(-5.5), "stiffness", "-5.5");
  expectParametersRefused<HookeSprings>(springsOf(0), "stiffness", "0");
  expectParametersRefused<HookeSprings>(springsOf(kNaN), "stiffness", "nan");
  expectParametersRefused<HookeSprings>(springsOf(kInfinity), "stiffness", "inf");
  expectParametersRefused<HookeSprings>(springsOf(10, -5.5), "bendingStiffness", "-5.5");
  HookeSprings::Parameters springs;
  springs.iterations = 0;
  expectParametersRefused<HookeSprings>(springs, "iterations", "0");
  springs.iterations = -3;
  expectParametersRefused<HookeSprings>(springs, "iterations", "-3");
  springs.iterations = 4;
  springs.perLink = {1, 2, 3};
  expectParametersRefused<HookeSprings>(springs, "perLink", "3");
  std::vector<double> perLink(std::size_t(scene.body().m_links.size()), 100);
  perLink[4] = kNaN;
  springs.perLink = perLink;
  expectParametersRefused<HookeSprings>(springs, "perLink", "nan");
}

TEST_F_IN_EVERY_WORLD(BadInput, WaterSetByHand) {
  expectRefused([&] { cloth.setSaturation(1.5); }, "saturation", "1.5");
  expectRefused([&] { cloth.setSaturation(-0.5); }, "saturation", "-0.5");
  expectRefused([&] { cloth.setSaturation(kNaN); }, "saturation", "nan");
  expectRefused([&] { cloth.setHeld(std::vector<double>(15, 0.001)); }, "held", "15");
  std::vector<double> held(16, 0.001);
  held[11] = -0.75;
  expectRefused([&] { cloth.setHeld(held); }, "11", "-0.75");
  held[11] = kInfinity;
  expectRefused([&] { cloth.setHeld(held); }, "11", "inf");
}

TEST_F_IN_EVERY_WORLD(BadInput, NodesThatAreNotThere) {
  for (const int node : {-1, 16, std::numeric_limits<int>::max(), std::numeric_limits<int>::min()}) {
    EXPECT_THROW(cloth.saturation(node), std::out_of_range) << node;
    EXPECT_THROW(cloth.held(node), std::out_of_range) << node;
    EXPECT_THROW(cloth.dryMass(node), std::out_of_range) << node;
    EXPECT_THROW(cloth.capacity(node), std::out_of_range) << node;
    EXPECT_THROW(cloth.colour(node), std::out_of_range) << node;
    EXPECT_THROW(cloth.roughness(node), std::out_of_range) << node;
  }
}

TEST_F_IN_EVERY_WORLD(BadInput, Bodies) {
  EXPECT_NE(refusalOf([&] { wet.add(nullptr); }), "");
  EXPECT_NE(refusalOf([&] { wet.add(scene.body()); }), "") << "added twice";
  const std::unique_ptr<btSoftBody> stranger = squarePatch(3).build(scene.bullet().info());
  EXPECT_NE(refusalOf([&] { wet.add(*stranger); }), "") << "not in the world";
  EXPECT_NE(refusalOf([&] { wet.remove(*stranger); }), "");
  EXPECT_EQ(wet.find(*stranger), nullptr);
  EXPECT_EQ(wet.cloths().size(), 1u);
  BodyScene elsewhere(GetParam(), squarePatch(3));
  EXPECT_NE(refusalOf([&] { wet.add(elsewhere.body()); }), "") << "in another world";
  EXPECT_EQ(wet.cloths().size(), 1u);
  scene.bullet().step(1);
  EXPECT_EQ(wet.find(scene.body()), &cloth);
}

TEST_F_IN_EVERY_WORLD(BadInput, MassesThatAreNotFinite) {
  for (const btScalar bad : {kScalarNaN, std::numeric_limits<btScalar>::infinity(), btScalar(-2)}) {
    BodyScene other(GetParam(), squarePatch(3));
    other.body().m_nodes[4].m_im = bad;
    wetcloth::WetClothWorld otherWet(other.world());
    const std::string message = refusalOf([&] { otherWet.add(other.body()); });
    EXPECT_NE(message.find("4"), std::string::npos) << bad << " names the node: '" << message << "'";
    EXPECT_TRUE(otherWet.cloths().empty());
  }
}

TEST_F_IN_EVERY_WORLD(BadInput, FabricFields) {
  const auto refused = [](double wetcloth::Fabric::*field, const std::string& name, bool zeroIsBad) {
    std::vector<std::pair<double, std::string>> values = {{-1.5, "-1.5"}, {kNaN, "nan"}, {kInfinity, "inf"}};
    if (zeroIsBad) values.push_back({0, "0"});
    for (const auto& [value, text] : values) {
      BodyScene other(GetParam(), squarePatch(3));
      wetcloth::WetClothWorld otherWet(other.world());
      wetcloth::Fabric fabric;
      fabric.*field = value;
      const std::string message = refusalOf([&] { otherWet.add(other.body(), fabric); });
      EXPECT_NE(message.find(name), std::string::npos) << message;
      EXPECT_NE(message.find(text), std::string::npos) << message;
      EXPECT_TRUE(otherWet.cloths().empty());
      other.bullet().step(1);
    }
  };
  refused(&wetcloth::Fabric::capacity, "capacity", true);
  refused(&wetcloth::Fabric::timeConstant, "timeConstant", true);
  refused(&wetcloth::Fabric::arealDensity, "arealDensity", true);
  refused(&wetcloth::Fabric::dryRoughness, "dryRoughness", false);
}

}  // namespace
}  // namespace wetcloth_test::bad_input_test
