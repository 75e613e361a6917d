// SPDX-License-Identifier: Zlib
// The plain Bullet that `run`, `render`, `view` and `cost` compare a scene with.

#include "command/cost/CostWorld.h"
#include "command/scene/SceneReader.h"
#include "command/scene/SceneWorld.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace wetcloth_test::plain_twin_test {
namespace {

using command::CostWorld;
using command::Scene;
using command::SceneWorld;

constexpr double duration = 0.6;      // [s]
constexpr double length = 1.6;        // of the curtain [m]
constexpr double lowestAtRest = 0.3;  // [m]
// Bullet's own springs are as soft as its explicit world needs them in this scene's substeps; without any the curtain
// is on the floor in 0.3 s and far below it in 1 s.
constexpr double mostSag = 0.2 * length;

/// Its cloth is held by the effect hooke_springs.
Scene curtain() {
  return command::readScene(std::string(WETCLOTH_SOURCE_DIR) + "/examples/scenes/curtain_deformable.json");
}

/// Bullet's steps one by one, as `wetcloth cost` takes them.
Scene inBulletsSteps() {
  Scene scene = curtain();
  scene.step /= scene.substeps;
  scene.substeps = 1;
  return scene;
}

double lowestOf(const SceneWorld& world) {
  const btSoftBody& body = *world.bodies()[0];
  double lowest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    lowest = std::min(lowest, static_cast<double>(body.m_nodes[i].m_x.y()));
  }
  return lowest;
}

int stepsOf(const Scene& scene) { return static_cast<int>(std::lround(duration / scene.step)); }

void expectHangs(const SceneWorld& world) {
  EXPECT_TRUE(world.isFinite());
  EXPECT_EQ(world.blowUp().value_or(""), "");
  EXPECT_NEAR(lowestOf(world), lowestAtRest, mostSag);
}

TEST(PlainTwin, OfAClothThatHookeSpringsHoldHangsInBulletsOwn) {
  const Scene scene = curtain();
  SceneWorld plain(scene, SceneWorld::Kind::plainBullet);
  for (int i = 0; i < stepsOf(scene); ++i) plain.step();
  expectHangs(plain);
}

TEST(PlainTwin, HasTheSpringsOfTheSceneWithoutHookeSprings) {
  const Scene held = curtain();
  Scene bare = held;
  bare.cloths[0].effects.clear();
  SceneWorld twin(held, SceneWorld::Kind::plainBullet);
  SceneWorld same(bare, SceneWorld::Kind::plainBullet);
  ASSERT_TRUE(twin.springs()[0] && same.springs()[0]);
  EXPECT_EQ(twin.springs()[0]->stiffness, same.springs()[0]->stiffness);
  for (int i = 0; i < 20; ++i) {
    twin.step();
    same.step();
  }
  EXPECT_EQ(lowestOf(twin), lowestOf(same));
}

TEST(PlainTwin, OfAWetClothIsNotHeldTwice) {
  const Scene scene = curtain();
  EXPECT_FALSE(SceneWorld(scene).springs()[0]);
}

TEST(CostWorld, WithoutHookeSpringsAClothHangsInBulletsOwn) {
  const Scene scene = inBulletsSteps();
  CostWorld idle = CostWorld::idle(scene);
  CostWorld without = CostWorld::timed(scene, "hooke_springs");
  for (int i = 0; i < stepsOf(scene); ++i) {
    idle.step();
    without.step();
  }
  expectHangs(idle.world());
  EXPECT_TRUE(without.world().isFinite());
  EXPECT_EQ(without.world().blowUp().value_or(""), "");
}

}  // namespace
}  // namespace wetcloth_test::plain_twin_test
