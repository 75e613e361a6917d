// SPDX-License-Identifier: Zlib
// What wet layers of cloth do to each other where the guard of ClothSolver keeps them apart: water passes, friction
// follows the wetness, and they cling.
#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/solver/GuardScene.h"
#include "tests/support/InEveryWorld.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace wetcloth_test::wet_layers_test {
namespace {

using Flags = btSoftBody::fCollision;

constexpr double kThickness = 0.004;
constexpr double kSaturation = 0.5;
constexpr double kGravity = 9.81;

Guard guardOf(double friction) {
  Guard guard;
  guard.thickness = kThickness;
  guard.friction = friction;
  return guard;
}

// A sheet of n x n nodes that may be fixed all over.
BodyBuilder sheet(int n, double side, double height, bool isFixed) {
  return [=](btSoftBodyWorldInfo& info) {
    std::unique_ptr<btSoftBody> body = levelSheet(n, side, btVector3(0, btScalar(height), 0)).build(info);
    body->m_cfg.collisions = Flags::SDF_RS | Flags::VF_SS;
    for (int k = 0; isFixed && k < body->m_nodes.size(); ++k) body->setMass(k, 0);
    return body;
  };
}

BodyBuilder largeSheet() { return sheet(13, 0.36, 0, true); }
BodyBuilder smallSheet(double height = 0, bool isFixed = true) { return sheet(6, 0.14, height, isFixed); }

// A sheet that is fixed, and a small one above or below it, at a distance.
struct Layers {
  Layers(WorldKind kind, double distance, double friction = 0.3, const btVector3& gravity = kEarthGravity,
         const BodyBuilder& fixedSheet = largeSheet())
      : scene(guardOf(friction), kind, gravity),
        fixed(scene.add(fixedSheet)),
        loose(scene.add(smallSheet(distance, false))),
        world(scene.scene().bullet().world()),
        fixedCloth(world.add(fixed)),
        looseCloth(world.add(loose)) {
    world.setLog({});
    loose.m_cfg.kDP = 0;
  }
  btVector3 middle() const {
    btVector3 sum(0, 0, 0);
    for (int k = 0; k < loose.m_nodes.size(); ++k) sum += loose.m_nodes[k].m_x;
    return sum / btScalar(loose.m_nodes.size());
  }
  double held() const {
    double sum = 0;
    for (int k = 0; k < fixed.m_nodes.size(); ++k) sum += fixedCloth.held(k);
    for (int k = 0; k < loose.m_nodes.size(); ++k) sum += looseCloth.held(k);
    return sum;
  }

  GuardScene scene;
  btSoftBody& fixed;
  btSoftBody& loose;
  wetcloth::WetClothWorld world;
  wetcloth::WetCloth& fixedCloth;
  wetcloth::WetCloth& looseCloth;
};

// --- numbers that are none -----------------------------------------------------------------------------------------

TEST_IN_POSITION_BASED_WORLDS(WetLayers, NumbersThatAreNoneCountForNothing) {
  const std::vector<btScalar> bad{std::numeric_limits<btScalar>::quiet_NaN(), -1,
                                  std::numeric_limits<btScalar>::infinity()};
  const auto places = [&](bool isTold) {
    Layers layers(GetParam(), kThickness, 0.3, btVector3(1, btScalar(-kGravity), 0));
    wetcloth::ClothSolver& solver = layers.scene.scene().solver();
    std::vector<btScalar> values;
    for (int k = 0; k < layers.loose.m_nodes.size(); ++k) values.push_back(bad[std::size_t(k) % bad.size()]);
    for (int step = 0; step < 10; ++step) {
      if (isTold) {
        solver.setLayerFriction(layers.loose, values);
        solver.setLayerCling(layers.loose, values, values);
        solver.setLayerFriction(layers.fixed, {1, 2, 3});  // of three nodes; it has 169
      }
      layers.scene.step(1);
    }
    return layers.middle();
  };
  EXPECT_EQ(places(true), places(false));
}

// --- water ----------------------------------------------------------------------------------------------------------

wetcloth::ContactWetting::Parameters betweenCloths() {
  wetcloth::ContactWetting::Parameters parameters;
  parameters.cloths = true;
  return parameters;
}

TEST_IN_POSITION_BASED_WORLDS(WetLayers, PassWaterWhereTheyTouch) {
  Layers layers(GetParam(), kThickness);
  layers.looseCloth.add<wetcloth::ContactWetting>(betweenCloths());
  layers.looseCloth.setSaturation(1);
  const double before = layers.held();
  layers.scene.step(60);
  EXPECT_NEAR(layers.held(), before, 1e-9 * before);
  int wet = 0;
  for (int k = 0; k < layers.fixed.m_nodes.size(); ++k) {
    const btVector3& x = layers.fixed.m_nodes[k].m_x;
    const double off = std::max(std::fabs(double(x.x())), std::fabs(double(x.z())));
    if (off < 0.065) {
      EXPECT_GT(layers.fixedCloth.saturation(k), 0.01) << k;
      ++wet;
    }
    if (off > 0.07 + 0.031) {
      EXPECT_EQ(layers.fixedCloth.saturation(k), 0) << k;
    }
  }
  EXPECT_EQ(wet, 25);
  EXPECT_LT(layers.looseCloth.meanSaturation(), 0.95);
}

TEST_IN_POSITION_BASED_WORLDS(WetLayers, PassNoWaterWhereTheyAreApart) {
  Layers layers(GetParam(), 1.2 * kThickness, 0.3, kNoGravity);
  layers.looseCloth.add<wetcloth::ContactWetting>(betweenCloths());
  layers.looseCloth.setSaturation(1);
  layers.scene.step(60);
  EXPECT_EQ(layers.fixedCloth.meanSaturation(), 0);
}

// Its right half is folded under its left half, and wet.
TEST_IN_POSITION_BASED_WORLDS(WetLayers, OfOneClothPassWaterToo) {
  constexpr int kNodes = 11;
  GuardScene scene(guardOf(0.3), GetParam());
  btSoftBody& body = scene.add([&](btSoftBodyWorldInfo& info) {
    std::unique_ptr<btSoftBody> folded = sheet(kNodes, 0.3, 0, false)(info);
    for (int k = 0; k < folded->m_nodes.size(); ++k) {
      btVector3& x = folded->m_nodes[k].m_x;
      if (x.x() > btScalar(0.001)) {
        x += btVector3(-2 * x.x(), btScalar(-1.05 * kThickness), 0);
        folded->setMass(k, 0);
      }
      folded->m_nodes[k].m_q = x;
    }
    return folded;
  });
  wetcloth::WetClothWorld world(scene.scene().bullet().world());
  wetcloth::WetCloth& cloth = world.add(body);
  cloth.add<wetcloth::ContactWetting>(betweenCloths());
  std::vector<double> held(std::size_t(body.m_nodes.size()));
  for (int k = 0; k < body.m_nodes.size(); ++k) held[std::size_t(k)] = k % kNodes > 5 ? cloth.capacity(k) : 0;
  cloth.setHeld(held);
  const double before = cloth.ledger().held;
  scene.step(60);
  EXPECT_NEAR(cloth.ledger().held, before, 1e-9 * before);
  for (int k = 0; k < body.m_nodes.size(); ++k) {
    if (k % kNodes < 4) {  // the fold itself is round
      EXPECT_GT(cloth.saturation(k), 0.002) << k;
    }
  }
}

// --- friction -------------------------------------------------------------------------------------------------------

// How far a sheet slides in this time on a slope of this tangent.
double slideOn(WorldKind kind, double slope, double friction, double saturation, double time) {
  const double length = std::hypot(1.0, slope);
  const btVector3 gravity(btScalar(kGravity * slope / length), btScalar(-kGravity / length), 0);
  Layers layers(kind, kThickness * 0.99, friction, gravity);
  layers.looseCloth.add<wetcloth::WetFriction>();
  layers.looseCloth.setSaturation(saturation);
  const double before = double(layers.middle().x());
  layers.scene.step(int(std::lround(60 * time)));
  EXPECT_GT(double(layers.middle().y()), 0.5 * kThickness);
  return double(layers.middle().x()) - before;
}

// From rest, with the difference of both accelerations.
double slideExpected(double slope, double friction, double time) {
  return kGravity / std::hypot(1.0, slope) * (slope - friction) * time * time / 2;
}

// Fast meshes are held by their edges, too, that slide over each other.
TEST_IN_POSITION_BASED_WORLDS(WetLayers, StayOrSlideByTheTangentOfTheSlope) {
  const double mu = 0.3;
  EXPECT_LT(slideOn(GetParam(), 0.9 * mu, mu, 0, 0.4), 0.001);
  const double slides = slideExpected(0.5, mu, 0.1);
  EXPECT_NEAR(slideOn(GetParam(), 0.5, mu, 0, 0.1), slides, 0.1 * slides);
}

TEST_IN_POSITION_BASED_WORLDS(WetLayers, HaveTheFrictionOfTheirWetness) {
  const double mu = 0.3;
  const double wet = mu * wetcloth::WetFriction::Parameters().wetFactor;
  EXPECT_LT(slideOn(GetParam(), 0.9 * wet, mu, kSaturation, 0.4), 0.001);
  const double slides = slideExpected(1.3 * wet, wet, 0.1);
  EXPECT_NEAR(slideOn(GetParam(), 1.3 * wet, mu, kSaturation, 0.1), slides, 0.1 * slides);
}

TEST_IN_POSITION_BASED_WORLDS(WetLayers, AreAsDryAgainWithoutTheEffect) {
  const double mu = 0.3;
  Layers layers(GetParam(), kThickness, mu, btVector3(btScalar(0.5 * kGravity), btScalar(-kGravity), 0));
  wetcloth::WetFriction& effect = layers.looseCloth.add<wetcloth::WetFriction>();
  layers.looseCloth.setSaturation(kSaturation);
  layers.scene.step(20);
  const double before = double(layers.middle().x());
  EXPECT_LT(std::fabs(before), 0.001);
  layers.looseCloth.remove(effect);
  layers.scene.step(20);
  EXPECT_GT(double(layers.middle().x()), before + 0.03);
}

// --- cling ----------------------------------------------------------------------------------------------------------

struct Clinging {
  static constexpr double kAdhesion = 20;
  static constexpr double kShearStrength = 12;

  Clinging(WorldKind kind, double saturation, bool bothCling = true)
      : layers(kind, -kThickness, 0.3, kNoGravity, smallSheet()) {
    wetcloth::Cling::Parameters parameters;
    parameters.adhesion = kAdhesion;
    parameters.shearStrength = kShearStrength;
    layers.looseCloth.add<wetcloth::Cling>(parameters);
    if (bothCling) layers.fixedCloth.add<wetcloth::Cling>(parameters);
    layers.looseCloth.setSaturation(saturation);
    layers.fixedCloth.setSaturation(saturation);
  }
  // Returns how far the sheet goes under a stress [Pa] in 1/2 s.
  btVector3 pull(const btVector3& stress) {
    const btVector3 before = layers.middle();
    for (int step = 0; step < 30; ++step) {
      for (int k = 0; k < layers.loose.m_nodes.size(); ++k) {
        const double area = layers.looseCloth.dryMass(k) / layers.looseCloth.fabric().arealDensity;
        layers.loose.addForce(stress * btScalar(area), k);
      }
      layers.scene.step(1);
    }
    return layers.middle() - before;
  }

  Layers layers;
};

TEST_IN_POSITION_BASED_WORLDS(WetLayers, HoldEachOtherUpToTheAdhesion) {
  const btVector3 down(0, btScalar(-Clinging::kAdhesion), 0);
  EXPECT_LT(double(Clinging(GetParam(), kSaturation).pull(down * btScalar(0.95)).length()), 1e-4);
  EXPECT_GT(double(Clinging(GetParam(), kSaturation).pull(down * btScalar(1.05)).length()), 0.1);
  EXPECT_GT(double(Clinging(GetParam(), 0.05).pull(down * btScalar(0.1)).length()), 0.1);  // too dry
}

TEST_IN_POSITION_BASED_WORLDS(WetLayers, HoldEachOtherAlongTheLayerUpToTheShearStrength) {
  const btVector3 aside(btScalar(Clinging::kShearStrength), 0, 0);
  EXPECT_LT(double(Clinging(GetParam(), kSaturation).pull(aside * btScalar(0.95)).length()), 1e-4);
  EXPECT_GT(double(Clinging(GetParam(), kSaturation).pull(aside * btScalar(1.4)).length()), 0.02);
}

TEST_IN_POSITION_BASED_WORLDS(WetLayers, HoldEachOtherWithTheMeanOfBoth) {
  const btVector3 down(0, btScalar(-Clinging::kAdhesion / 2), 0);
  EXPECT_LT(double(Clinging(GetParam(), kSaturation, false).pull(down * btScalar(0.95)).length()), 1e-4);
  EXPECT_GT(double(Clinging(GetParam(), kSaturation, false).pull(down * btScalar(1.05)).length()), 0.1);
}

// A stack that hangs: the upper side of a layer bears what hangs on its lower side, too.
TEST_IN_POSITION_BASED_WORLDS(WetLayers, HangBelowEachOther) {
  for (const double strength : {2.2, 1.8}) {
    Layers layers(GetParam(), -kThickness, 0.3, kEarthGravity, smallSheet());
    btSoftBody& third = layers.scene.add(smallSheet(-2 * kThickness, false));
    wetcloth::WetCloth& thirdCloth = layers.world.add(third);
    const wetcloth::Fabric& fabric = thirdCloth.fabric();
    wetcloth::Cling::Parameters parameters;
    parameters.adhesion = strength * fabric.arealDensity * (1 + kSaturation * fabric.capacity) * kGravity;
    for (wetcloth::WetCloth* const cloth : {&layers.fixedCloth, &layers.looseCloth, &thirdCloth}) {
      cloth->add<wetcloth::Cling>(parameters);
      cloth->setSaturation(kSaturation);
    }
    layers.scene.step(60);
    const double fallen = -kThickness - double(layers.middle().y());
    if (strength > 2) {
      EXPECT_LT(fallen, 0.0005);
      EXPECT_LT(-2 * kThickness - double(third.m_nodes[0].m_x.y()), 0.0005);
    } else {
      EXPECT_GT(fallen, 0.5);
    }
  }
}

// --- save and restore -----------------------------------------------------------------------------------------------

struct Everything {
  explicit Everything(WorldKind kind) : layers(kind, kThickness) {
    for (wetcloth::WetCloth* const cloth : {&layers.looseCloth, &layers.fixedCloth}) {
      cloth->add<wetcloth::ContactWetting>(betweenCloths());
      cloth->add<wetcloth::WetFriction>();
      cloth->add<wetcloth::Cling>();
    }
    layers.looseCloth.setSaturation(0.8);
  }
  std::string state() const {
    std::ostringstream stream;
    layers.world.save(stream);
    return stream.str();
  }

  Layers layers;
};

TEST_IN_POSITION_BASED_WORLDS(WetLayers, ARestoredRunGoesOnBitForBit) {
  Everything first(GetParam());
  first.layers.scene.step(33);
  ASSERT_GT(first.layers.loose.m_scontacts.size(), 0);
  const std::string saved = first.state();
  first.layers.scene.step(33);
  Everything second(GetParam());
  std::istringstream stream(saved);
  second.layers.world.restore(stream);
  EXPECT_EQ(second.state(), saved);
  second.layers.scene.step(33);
  EXPECT_TRUE(sameBits(stateOf(first.layers.loose), stateOf(second.layers.loose)));
  EXPECT_EQ(first.state(), second.state());
  EXPECT_EQ(first.layers.held(), second.layers.held());
}

}  // namespace
}  // namespace wetcloth_test::wet_layers_test
