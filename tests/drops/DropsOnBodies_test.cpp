// SPDX-License-Identifier: Zlib
// Drops that land on rigid bodies, and the films that they leave there.

#include "tests/drops/DropsScene.h"
#include "tests/support/ContactScene.h"
#include "tests/support/RigidBody.h"

#include <gtest/gtest.h>

#include <cmath>

namespace wetcloth_test::drops_on_bodies_test {
namespace {

using namespace drops_scene;
using wetcloth::Drops;
using wetcloth::Landing;
using wetcloth::Pour;

/// What lands, told one by one, beside a cloth that is far away.
struct Watched {
  explicit Watched(const btVector3& gravity = kNoGravity) : scene({}, pinned(2, 0.1), gravity) {
    Drops::Parameters parameters;
    parameters.air = vacuum();
    parameters.onLanding = [this](const Landing& landing) { landings.push_back(landing); };
    scene.drops.setParameters(parameters);
  }
  RigidBody add(std::unique_ptr<btCollisionShape> shape, const btVector3& position, btScalar mass = 0) {
    return RigidBody(scene.scene().bullet(), std::move(shape), mass, position);
  }
  DropsScene scene;
  std::vector<Landing> landings;
};

// A ray against a sphere, a box and a plane, in closed form.
TEST(DropsOnBodies, LandWhereTheirWayMeetsTheBody) {
  Watched watched;
  RigidBody sphere = watched.add(std::make_unique<btSphereShape>(btScalar(0.5)), btVector3(3, 0, 0));
  RigidBody block = watched.add(box(0.5, 0.5, 0.5), btVector3(6, 0, 0));
  RigidBody floor =
      watched.add(std::make_unique<btStaticPlaneShape>(btVector3(0, 1, 0), btScalar(-2)), btVector3(0, 0, 0));
  watched.scene.drops.add(oneDrop(btVector3(btScalar(3.3), 1, 0), btVector3(0, -3, 0)));
  watched.scene.drops.add(oneDrop(btVector3(btScalar(6.3), 1, 0), btVector3(0, -3, 0)));
  watched.scene.drops.add(oneDrop(btVector3(9, 1, 0), btVector3(0, -3, 0)));
  watched.scene.step(300);
  ASSERT_EQ(watched.landings.size(), 3u);
  EXPECT_EQ(watched.landings[0].body, &block.body());
  EXPECT_EQ(watched.landings[1].body, &sphere.body());
  EXPECT_EQ(watched.landings[2].body, &floor.body());
  // Bullet casts rays at convex shapes to a tolerance of 1e-4 times the way.
  EXPECT_NEAR(double(watched.landings[0].position.y()), 0.5, 1e-3);
  EXPECT_NEAR(double(watched.landings[1].position.y()), 0.4, 1e-3);
  EXPECT_NEAR(double(watched.landings[2].position.y()), -2, 1e-6);
  EXPECT_EQ(watched.scene.drops.size(), 0u);
  EXPECT_NEAR(watched.scene.drops.ledger().films, watched.scene.drops.ledger().brought, 1e-18);
}

TEST(DropsOnBodies, NoDropIsInsideAfterIt) {
  Watched watched(kEarthGravity);
  RigidBody sphere = watched.add(std::make_unique<btSphereShape>(btScalar(0.3)), btVector3(3, 0, 0));
  Pour pour;
  pour.position = btVector3(3, 1, 0);
  pour.velocity = btVector3(0, -5, 0);
  pour.mouthRadius = 0.4;
  pour.flow = 0.05;
  pour.dropDiameter = 2e-3;
  watched.scene.drops.add(pour);
  for (int i = 0; i < 240; ++i) {
    watched.scene.step(1);
    for (std::size_t k = 0; k < watched.scene.drops.size(); ++k) {
      const double distance = double((watched.scene.drops[k].position - btVector3(3, 0, 0)).length());
      ASSERT_GT(distance, 0.3 - 1e-3) << i;
    }
  }
  EXPECT_GT(watched.landings.size(), 1000u);
}

// A kinematic box that rises faster than drops fall.
TEST(DropsOnBodies, AMovingBodyMeetsThem) {
  Watched watched;
  RigidBody block = watched.add(box(0.5, 0.05, 0.5), btVector3(3, -1, 0));
  block.body().setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
  watched.scene.drops.add(oneDrop(btVector3(3, 0, 0), btVector3(0, 0, 0)));
  for (int i = 0; i < 60 && watched.landings.empty(); ++i) {
    btTransform place = block.body().getWorldTransform();
    place.getOrigin().setY(btScalar(-1 + 0.2 * i));  // 48 m/s: four times its thickness in a substep
    block.body().setWorldTransform(place);
    watched.scene.step(1);
  }
  ASSERT_EQ(watched.landings.size(), 1u);
  EXPECT_EQ(watched.landings[0].body, &block.body());
}

TEST(DropsOnBodies, GiveTheirMomentumToABodyThatIsFree) {
  Watched watched;
  RigidBody ball = watched.add(std::make_unique<btSphereShape>(btScalar(0.5)), btVector3(3, 0, 0), 2);
  watched.scene.drops.add(oneDrop(btVector3(3, 1, 0), btVector3(0, -3, 0)));
  watched.scene.step(120);
  ASSERT_EQ(watched.landings.size(), 1u);
  EXPECT_NEAR(2 * double(ball.body().getLinearVelocity().y()), -3 * watched.landings[0].mass, 1e-3 * 3 * 3.4e-5);
}

TEST(DropsOnBodies, WhatNobodyCollidesWithIsPassed) {
  Watched watched;
  RigidBody ghost = watched.add(box(0.5, 0.5, 0.5), btVector3(3, 0, 0));
  ghost.body().setCollisionFlags(ghost.body().getCollisionFlags() | btCollisionObject::CF_NO_CONTACT_RESPONSE);
  watched.scene.drops.add(oneDrop(btVector3(3, 1, 0), btVector3(0, -3, 0)));
  watched.scene.step(240);
  EXPECT_TRUE(watched.landings.empty());
}

TEST(DropsOnBodies, AFilmHasItsMostAndTheRestRunsOn) {
  Drops::Parameters parameters;
  parameters.filmDensity = 0.1;
  parameters.filmCell = 0.1;  // 1 g at most
  DropsScene scene(parameters, pinned(2, 0.1));
  RigidBody block(scene.scene().bullet(), box(0.2, 0.5, 0.2), 0, btVector3(3, 0, 0));
  RigidBody floor(scene.scene().bullet(), std::make_unique<btStaticPlaneShape>(btVector3(0, 1, 0), btScalar(-1)), 0,
                  btVector3(0, 0, 0));
  Pour pour;
  pour.position = btVector3(3, 1, 0);
  pour.flow = 0.05;
  pour.stop = 1;
  scene.drops.add(pour);
  scene.step(240 * 3);
  // The top, 16 g, is wet in the end, in five rows of cells at most that reach over it; the rest is on the floor.
  EXPECT_GT(scene.drops.filmOn(block.body()), 0.01);
  EXPECT_LT(scene.drops.filmOn(block.body()), 0.025 + 1e-12);
  EXPECT_GT(scene.drops.filmOn(floor.body()), 0.01);
  const wetcloth::WorldLedger ledger = scene.drops.ledger();
  EXPECT_NEAR(ledger.imbalance(), 0, kLedger * ledger.brought);
}

TEST(DropsOnBodies, AFilmGoesWithItsBody) {
  DropsScene scene({}, pinned(2, 0.1));
  auto block = std::make_unique<RigidBody>(scene.scene().bullet(), box(0.5, 0.5, 0.5), btScalar(0), btVector3(3, 0, 0));
  scene.drops.add(oneDrop(btVector3(3, 1, 0), btVector3(0, -3, 0)));
  scene.step(120);
  EXPECT_GT(scene.drops.ledger().films, 0);
  block.reset();
  scene.drops.add(oneDrop(btVector3(6, 1, 0), btVector3(0, -3, 0)));
  Pour pour;
  pour.position = btVector3(6, 1, 0);
  scene.drops.add(pour);
  scene.step(2);
  const wetcloth::WorldLedger ledger = scene.drops.ledger();
  EXPECT_EQ(ledger.films, 0);
  EXPECT_GT(ledger.left, 0);
  EXPECT_NEAR(ledger.imbalance(), 0, kLedger * ledger.brought);
}

TEST(DropsOnBodies, EndInWater) {
  Drops::Parameters parameters;
  parameters.surface = wetcloth::WaterSurface{btVector3(0, 2, 0), -1, 1000, btVector3(0, 0, 0)};  // at 0.5
  DropsScene scene(parameters, pinned(2, 0.1));
  scene.drops.add(oneDrop(btVector3(3, 1, 0), btVector3(0, -3, 0)));
  scene.step(20);
  EXPECT_EQ(scene.drops.size(), 1u);
  scene.step(40);
  EXPECT_EQ(scene.drops.size(), 0u);
  EXPECT_EQ(scene.drops.ledger().left, scene.drops.ledger().brought);
}

// A cloth lies on a box, drops strike the box beside it; then the cloth is laid there and takes the film up.
TEST_IN_EVERY_WORLD(DropsOnBodies, ContactWettingTakesTheFilmUp) {
  ClothScene scene(GetParam(), kEarthGravity, Lying{7, 0.3}.builder(GetParam()));
  scene.addBulletSpringsForStep();
  RigidBody table(scene.bullet(), box(2, 0.5, 2), 0, btVector3(0, btScalar(-0.5), 0));
  Drops drops(scene.wet());
  scene.cloth().add<wetcloth::ContactWetting>();
  Pour pour;
  pour.position = btVector3(1, btScalar(0.2), 0);
  pour.mouthRadius = 0.1;
  pour.flow = 0.02;
  pour.stop = 0.1;
  drops.add(pour);
  scene.step(60);
  ASSERT_GT(drops.ledger().films, 1e-3);
  EXPECT_EQ(scene.cloth().ledger().held, 0);
  const double film = drops.ledger().films;
  for (int i = 0; i < scene.body().m_nodes.size(); ++i) {
    scene.body().m_nodes[i].m_x += btVector3(1, 0, 0);
    scene.body().m_nodes[i].m_q += btVector3(1, 0, 0);
  }
  scene.step(480);
  const wetcloth::WorldLedger ledger = drops.ledger();
  EXPECT_GT(ledger.held, 0.5 * film);
  EXPECT_NEAR(ledger.held + ledger.films, film, kLedger * film);
  EXPECT_NEAR(ledger.absorbed, 0, kLedger * film);
  EXPECT_NEAR(ledger.imbalance(), 0, kLedger * film);
}

}  // namespace
}  // namespace wetcloth_test::drops_on_bodies_test
