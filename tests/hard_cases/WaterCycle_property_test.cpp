// SPDX-License-Identifier: Zlib
// The whole water cycle at once: rapidcheck makes up meshes, effects, parameters and steps. Whatever it makes, no
// number stops being finite, no node holds less than nothing or more than it can, and the ledger closes.

#include "tests/support/BodyScene.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/Materials.h"
#include "tests/support/Patches.h"
#include "tests/support/RigidBody.h"
#include "tests/support/WaterCycle.h"

#include <gtest/gtest.h>

#include <rapidcheck.h>

#include <sstream>

namespace wetcloth_test::water_cycle_property_test {

namespace {

// With a seed of its own each time the suite would not be the same twice.
template <class Property>
void expectHolds(std::uint64_t seed, int cases, const Property& property) {
  rc::detail::TestParams params;
  params.seed = seed;
  params.maxSuccess = cases;
  const auto result = rc::detail::checkTestable(property, rc::detail::TestMetadata(), params);
  std::ostringstream text;
  rc::detail::printResultMessage(result, text);
  EXPECT_TRUE(result.template is<rc::detail::SuccessResult>()) << text.str();
}

double anyBetween(double low, double high) { return low + (high - low) * *rc::gen::inRange(0, 1000001) / 1e6; }

// Evenly over the orders of magnitude.
double anyMagnitude(double low, double high) { return low * std::pow(high / low, anyBetween(0, 1)); }

btVector3 anyVector(double size) {
  return btVector3(btScalar(anyBetween(-size, size)), btScalar(anyBetween(-size, size)),
                   btScalar(anyBetween(-size, size)));
}

// A patch, flat or crumpled, of a size from a handkerchief's to a sail's.
std::unique_ptr<btSoftBody> anyPatch(btSoftBodyWorldInfo& info) {
  wetcloth::ClothPatch patch;
  patch.columns = *rc::gen::inRange(2, 7);
  patch.rows = *rc::gen::inRange(2, 7);
  const btScalar size = btScalar(anyMagnitude(0.05, 20));
  patch.edgeU = btVector3(size, 0, 0);
  patch.edgeV = btVector3(0, size * btScalar(anyBetween(0.1, 1)), size * btScalar(anyBetween(0.1, 1)));
  patch.arealDensity = anyMagnitude(0.01, 1);
  for (const auto edge : {wetcloth::ClothPatch::Edge::top, wetcloth::ClothPatch::Edge::left}) {
    if (*rc::gen::inRange(0, 3) == 0) patch.pinnedEdges.push_back(edge);
  }
  auto body = patch.build(info);
  const double crumple = anyBetween(0, 0.3) * double(size) / patch.columns;
  for (int i = 0; i < body->m_nodes.size(); ++i) body->m_nodes[i].m_x += anyVector(crumple);
  return body;
}

// Triangles between any nodes: needles, faces without area, duplicates, edges with three faces, lone nodes.
std::unique_ptr<btSoftBody> anySoup(btSoftBodyWorldInfo& info) {
  const int nodes = *rc::gen::inRange(3, 12);
  std::vector<btVector3> positions;
  std::vector<btScalar> masses;
  for (int i = 0; i < nodes; ++i) {
    const bool isCopy = i > 0 && *rc::gen::inRange(0, 5) == 0;
    positions.push_back(isCopy ? positions.back() : anyVector(1));
    masses.push_back(btScalar(anyMagnitude(1e-5, 1)));
  }
  auto body = std::make_unique<btSoftBody>(&info, nodes, positions.data(), masses.data());
  const int faces = *rc::gen::inRange(1, 16);
  for (int f = 0; f < faces; ++f) {
    const int a = *rc::gen::inRange(0, nodes);
    const int b = *rc::gen::inRange(0, nodes);
    const int c = *rc::gen::inRange(0, nodes);
    if (a == b || b == c || c == a) continue;
    body->appendFace(a, b, c);
    for (const auto& link : {std::make_pair(a, b), std::make_pair(b, c), std::make_pair(c, a)}) {
      body->appendLink(link.first, link.second, nullptr, true);
    }
  }
  if (body->m_faces.size() == 0) body->appendFace(0, 1, 2);
  if (body->m_links.size() == 0) body->appendLink(0, 1, nullptr, true);
  body->updateConstants();
  return body;
}

water_cycle::Choice anyEffects() {
  water_cycle::Choice choice;
  for (const std::string& name : water_cycle::names()) {
    if (*rc::gen::inRange(0, 2) == 0) choice.names.push_back(name);
  }
  choice.number = [](double low, double high) { return anyMagnitude(low, high); };
  choice.fraction = [] { return anyBetween(0, 1); };
  choice.vector = [](double size) { return anyVector(size); };
  return choice;
}

std::vector<double> anyWater(const wetcloth::WetCloth& cloth) {
  std::vector<double> held;
  for (int i = 0; i < cloth.nodeCount(); ++i) {
    const int kind = *rc::gen::inRange(0, 3);
    held.push_back(cloth.capacity(i) * (kind == 0 ? 0 : kind == 1 ? 1 : anyBetween(0, 1)));
  }
  return held;
}

// Our own part of the step, with steps from a microsecond to a quarter of an hour, one after the other.
TEST(WaterCycleProperty, AnyMeshAnyEffectsAnyStep) {
  expectHolds(kIsDouble ? 64 : 32, 300, [] {
    const WorldKind kind = *rc::gen::element(WorldKind::softRigid, WorldKind::deformable);
    const bool isPatch = *rc::gen::inRange(0, 2) == 0;
    BodyScene scene(kind, [&](btSoftBodyWorldInfo& info) { return isPatch ? anyPatch(info) : anySoup(info); });
    water_cycle::giveWater(scene.bullet().info(), btScalar(anyBetween(-0.5, 0.5)));
    water_cycle::letTouch(scene.bullet(), scene.body());
    wetcloth::WetClothWorld wet(scene.world(), wetcloth::Hook::manual);
    wet.setLog({});
    wetcloth::WetCloth& cloth = wet.add(scene.body(), fabricOf(anyMagnitude(0.05, 100), anyMagnitude(0.01, 1000)));
    cloth.setHeld(anyWater(cloth));
    water_cycle::add(cloth, anyEffects());
    for (int i = 0; i < scene.body().m_nodes.size(); ++i) {
      btSoftBody::Node& node = scene.body().m_nodes[i];
      if (node.m_im > 0) node.m_v = node.m_vn = anyVector(3);
    }
    for (int step = 0; step < 12; ++step) {
      wet.preTick(btScalar(anyMagnitude(1e-6, 1e3)));
      const std::string fault = water_cycle::faultOf(cloth);
      if (!fault.empty()) RC_FAIL("step " + std::to_string(step) + ": " + fault);
    }
  });
}

// Cloth and all water that comes move alike: whatever arrives, spreads, runs off, drips or dries, momentum as it should
// be means that no node's velocity changes.
TEST(WaterCycleProperty, WaterThatMovesWithTheClothChangesNoVelocity) {
  expectHolds(kIsDouble ? 6400 : 3200, 200, [] {
    const bool isPatch = *rc::gen::inRange(0, 2) == 0;
    BodyScene scene(WorldKind::softRigid,
                    [&](btSoftBodyWorldInfo& info) { return isPatch ? anyPatch(info) : anySoup(info); });
    wetcloth::WetClothWorld wet(scene.world(), wetcloth::Hook::manual);
    wetcloth::WetCloth& cloth = wet.add(scene.body(), fabricOf(anyMagnitude(0.05, 100), anyMagnitude(0.01, 1000)));
    cloth.setHeld(anyWater(cloth));
    const btVector3 velocity = water_cycle::nonZero(anyVector(5));
    for (int i = 0; i < scene.body().m_nodes.size(); ++i) scene.body().m_nodes[i].m_v = velocity;
    wetcloth::Absorption::Parameters absorption;
    absorption.exposure = anyBetween(0, 1);
    absorption.waterVelocity = velocity;
    cloth.add<wetcloth::Absorption>(absorption);
    cloth.add<wetcloth::Rain>({velocity, anyMagnitude(1e-4, 100), double(velocity.length())});
    cloth.add<wetcloth::Splash>({wetcloth::Splash::Sphere{btVector3(0, 0, 0), 1}, velocity, anyMagnitude(1e-4, 100)});
    water_cycle::Choice choice = anyEffects();
    choice.names = {"diffusion", "seepage", "dripping", "drying"};
    water_cycle::add(cloth, choice);
    for (int step = 0; step < 12; ++step) wet.preTick(btScalar(anyMagnitude(1e-6, 1e3)));
    for (int i = 0; i < scene.body().m_nodes.size(); ++i) {
      // The rain's direction is rounded, and a node may take its mass many times over in a step: some ten roundings.
      const double change = double((scene.body().m_nodes[i].m_v - velocity).length());
      RC_ASSERT(change <= (kIsDouble ? 1e-13 : 1e-5) * double(velocity.length()));
    }
  });
}

// With Bullet, in each of its worlds, and steps that Bullet bears.
TEST(WaterCycleProperty, AnyEffectsInAnyWorld) {
  expectHolds(kIsDouble ? 640 : 320, 60, [] {
    const WorldKind kind = *rc::gen::element(WorldKind::softRigid, WorldKind::softMultiBody, WorldKind::deformable,
                                             WorldKind::deformableImplicit);
    BodyScene scene(kind, hangingPatch(*rc::gen::inRange(3, 7)));
    RigidBody box(scene.bullet(), std::make_unique<btBoxShape>(btVector3(2, btScalar(0.2), 2)), 0, btVector3(0, -1, 0));
    water_cycle::giveWater(scene.bullet().info(), btScalar(anyBetween(-0.5, 0.5)));
    water_cycle::letTouch(scene.bullet(), scene.body());
    wetcloth::WetClothWorld wet(scene.world());
    wet.setLog({});
    wetcloth::WetCloth& cloth = wet.add(scene.body(), fabricOf(anyMagnitude(0.3, 5), anyMagnitude(0.1, 10)));
    cloth.setHeld(anyWater(cloth));
    water_cycle::Choice choice = anyEffects();
    choice.names.push_back("hooke_springs");  // the deformable world has no other
    water_cycle::add(cloth, choice);
    const btScalar dt = btScalar(anyMagnitude(1e-3, 1.0 / 60));
    for (int step = 0; step < 40; ++step) {
      scene.bullet().step(1, dt);
      const std::string fault = water_cycle::faultOf(cloth);
      if (!fault.empty()) RC_FAIL("step " + std::to_string(step) + ": " + fault);
    }
  });
}

}  // namespace
}  // namespace wetcloth_test::water_cycle_property_test
