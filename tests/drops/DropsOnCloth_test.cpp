// SPDX-License-Identifier: Zlib
// Where drops land on cloth, and what it does with them.

#include "tests/drops/DropsScene.h"
#include "tests/support/BodyState.h"
#include "tests/support/PassageCheck.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace wetcloth_test::drops_on_cloth_test {
namespace {

using namespace drops_scene;
using wetcloth::Drops;
using wetcloth::Landing;
using wetcloth::Pour;

constexpr double kPi = 3.14159265358979323846;

Pour shower(double radius, double flow, double diameter = 2e-3) {
  Pour pour;
  pour.position = btVector3(0, btScalar(0.5), 0);
  pour.velocity = btVector3(0, -4, 0);
  pour.mouthRadius = radius;
  pour.flow = flow;
  pour.dropDiameter = diameter;
  return pour;
}

TEST(DropsOnCloth, TheShareOfAShowerIsThatOfTheArea) {
  Drops::Parameters parameters;
  parameters.air = vacuum();
  parameters.longestFlight = 0.5;
  DropsScene scene(parameters, pinned(9, 0.5));
  Pour pour = shower(0.8, 0.05);
  pour.stop = 2;
  scene.drops.add(pour);
  scene.step(240 * 4);
  const double share = double(scene.drops.landedOnCloth()) / double(scene.drops.born());
  ASSERT_GT(scene.drops.born(), 20000);
  ASSERT_EQ(scene.drops.merged(), 0);
  // Evenly spread points: the error is that of those near the edges, a few in 23,000.
  EXPECT_NEAR(share, 0.25 / (kPi * 0.64), 1e-3);
}

TEST(DropsOnCloth, ADropIsTakenWhereItHits) {
  DropsScene scene;
  std::vector<Landing> landings;
  Drops::Parameters parameters = scene.drops.parameters();
  parameters.onLanding = [&](const Landing& landing) { landings.push_back(landing); };
  scene.drops.setParameters(parameters);
  // Into a triangle of the patch: all of it goes to three nodes, whose mean by weight is where it hit.
  scene.drops.add(oneDrop(btVector3(btScalar(0.13), btScalar(0.3), btScalar(-0.21)), btVector3(0, 0, 0)));
  scene.step(120);
  ASSERT_EQ(landings.size(), 1u);
  EXPECT_EQ(landings[0].cloth, &scene.cloth());
  EXPECT_EQ(landings[0].body, nullptr);
  EXPECT_EQ(landings[0].kept, landings[0].mass);
  double held = 0, x = 0, z = 0;
  int wet = 0;
  for (int i = 0; i < scene.cloth().nodeCount(); ++i) {
    const double here = scene.cloth().held(i);
    wet += here > 0 ? 1 : 0;
    held += here;
    x += here * double(scene.cloth().body().m_nodes[i].m_x.x());
    z += here * double(scene.cloth().body().m_nodes[i].m_x.z());
  }
  EXPECT_EQ(wet, 3);
  EXPECT_NEAR(held, landings[0].mass, 1e-18);
  // The check looks for the contact as closely as 1e-6 of the motion; across it nothing moves.
  EXPECT_NEAR(x / held, 0.13, 1e-6);
  EXPECT_NEAR(z / held, -0.21, 1e-6);
  EXPECT_NEAR(double(landings[0].position.y()), 0, 1e-6);
  // After a fall of 0.3 m, in which air takes some per cent.
  EXPECT_NEAR(double(landings[0].velocity.y()), -std::sqrt(2 * 9.81 * 0.3), 0.1);
}

TEST_IN_EVERY_WORLD(DropsOnCloth, BringTheirMomentum) {
  ClothScene scene(GetParam(), kNoGravity, levelPatch(7, 0.5));
  scene.addBulletSpringsForStep();
  Drops::Parameters parameters;
  parameters.air = vacuum();
  Drops drops(scene.wet(), parameters);
  Pour pour = shower(0.1, 0.01);  // which the cloth has room for
  pour.velocity = btVector3(1, -4, btScalar(0.5));
  pour.stop = 0.1;
  drops.add(pour);
  scene.step(60);
  ASSERT_EQ(drops.size(), 0u);
  const double water = drops.ledger().brought;
  const std::array<double, 3> p = momentum(scene.body());
  // Bullet's solvers, the deformable one iterative, keep the momentum to some of float's digits.
  EXPECT_NEAR(p[1], -4 * water, 1e-4 * 4 * water);
  EXPECT_NEAR(p[0], 1 * water, 1e-4 * 4 * water);
  EXPECT_NEAR(scene.cloth().ledger().held, water, kLedger * water);
}

TEST(DropsOnCloth, WhatHasNoRoomRunsOnAlongIt) {
  DropsScene scene;
  scene.cloth().setSaturation(1);
  const double full = scene.cloth().ledger().held;
  Pour pour = shower(0.2, 0.05, 3e-3);
  pour.stop = 0.2;
  scene.drops.add(pour);
  for (int i = 0; i < 480; ++i) {
    scene.step(1);
    for (std::size_t k = 0; k < scene.drops.size(); ++k) {
      const wetcloth::Drop drop = scene.drops[k];
      const double beside = std::max(std::fabs(double(drop.position.x())), std::fabs(double(drop.position.z())));
      // On the side that it came from until it is over the edge.
      if (beside < 0.499 && drop.velocity.y() > -1) {
        ASSERT_GT(double(drop.position.y()), 0) << i;
      }
    }
    const wetcloth::WorldLedger ledger = scene.drops.ledger();
    ASSERT_NEAR(ledger.imbalance(), 0, kLedger * (ledger.initial + ledger.brought)) << i;
  }
  EXPECT_NEAR(scene.cloth().ledger().held, full, 1e-12 * full);
  EXPECT_NEAR(scene.drops.ledger().brought, 0.01, 1e-4);
  int below = 0;
  for (std::size_t i = 0; i < scene.drops.size(); ++i) below += scene.drops[i].position.y() < 0 ? 1 : 0;
  EXPECT_GT(below, 100);  // over the edge
}

// A drop on a free, full cloth in a vacuum: what it loses, the cloth has.
TEST_IN_EVERY_WORLD(DropsOnCloth, WhatRunsOnKeepsItsShareOfTheMomentum) {
  ClothScene scene(GetParam(), kNoGravity, levelPatch(5, 0.2));
  scene.addBulletSpringsForStep();
  scene.cloth().setSaturation(1);
  Drops::Parameters parameters;
  parameters.air = vacuum();
  Drops drops(scene.wet(), parameters);
  drops.add(oneDrop(btVector3(btScalar(0.03), btScalar(0.05), btScalar(0.02)), btVector3(btScalar(0.5), -2, 0)));
  scene.step(2);
  ASSERT_EQ(drops.size(), 1u);
  const double mass = drops[0].mass;
  scene.step(8);
  ASSERT_EQ(drops.landedOnCloth(), 1);
  ASSERT_EQ(drops.size(), 1u);
  const std::array<double, 3> p = momentum(scene.body());
  // In the rounding of Bullet's scalar, beside a cloth of 9 g.
  EXPECT_NEAR(p[1] + mass * double(drops[0].velocity.y()), -2 * mass, 1e-3 * mass);
  EXPECT_NEAR(p[0] + mass * double(drops[0].velocity.x()), 0.5 * mass, 1e-3 * mass);
  EXPECT_GT(double(drops[0].velocity.y()), 0);
}

// A free cloth in the air, struck hard, with every drop known by its mass: the way of each that flies on, in a substep,
// meets no face of the cloth on its way.
TEST_IN_EVERY_WORLD(DropsOnCloth, NoDropPassesThroughAMovingCloth) {
  ClothScene scene(GetParam(), kEarthGravity, hangingPatch(9));
  scene.addBulletSpringsForStep();
  Drops drops(scene.wet());
  for (int k = 0; k < 150; ++k) {
    Pour pour = oneDrop(btVector3(btScalar(0.02 + 0.0064 * k), btScalar(0.2 + 0.005 * (k * 37 % 150)), btScalar(1.0)),
                        btVector3(0, 1, -9), 2e-3 + 1e-6 * k);
    pour.start = 0.004 * (k * 61 % 150);
    pour.stop = pour.start + 1e-9;
    drops.add(pour);
  }
  wetcloth::Wind::Parameters wind;
  wind.velocity = btVector3(0, 0, 5);
  scene.cloth().add<wetcloth::Wind>(wind);

  PassageMesh mesh;
  const auto places = [&] {
    std::vector<Place> all;
    for (int i = 0; i < scene.body().m_nodes.size(); ++i) {
      const btVector3& x = scene.body().m_nodes[i].m_x;
      all.push_back({double(x[0]), double(x[1]), double(x[2])});
    }
    return all;
  };
  for (int f = 0; f < scene.body().m_faces.size(); ++f) {
    std::array<int, 3> face;
    for (int c = 0; c < 3; ++c) face[std::size_t(c)] = numberOf(scene.body(), scene.body().m_faces[f].m_n[c]);
    mesh.faces.push_back(face);
  }
  const auto flying = [&] {
    std::map<double, Place> all;
    for (std::size_t i = 0; i < drops.size(); ++i) {
      const btVector3 x = drops[i].position;
      all[drops[i].mass] = {double(x[0]), double(x[1]), double(x[2])};
    }
    return all;
  };
  int passages = 0;
  std::vector<Place> clothBefore = places();
  std::map<double, Place> dropsBefore;
  for (int i = 0; i < 240; ++i) {
    const std::vector<Place> clothNow = places();  // what drops meet in this step's turn
    scene.step(1);
    const std::map<double, Place> dropsNow = flying();
    std::vector<Place> from = clothBefore;
    std::vector<Place> to = clothNow;
    mesh.vertices.clear();
    for (const auto& drop : dropsNow) {
      const auto before = dropsBefore.find(drop.first);
      if (before == dropsBefore.end()) continue;
      mesh.vertices.push_back(int(from.size()));
      from.push_back(before->second);
      to.push_back(drop.second);
    }
    passages += countPassages(
        mesh, from, to, [](const PassagePair& pair) { return pair.kind == wetcloth::collision::Pair::vertexFace; });
    clothBefore = clothNow;
    dropsBefore = dropsNow;
  }
  EXPECT_EQ(passages, 0);
  EXPECT_EQ(drops.born(), 150);
  EXPECT_GT(drops.landedOnCloth(), 60);
  EXPECT_NEAR(drops.ledger().imbalance(), 0, kLedger * drops.ledger().brought);
}

// A point source in a plane: the mean square distance from it grows by 4 D in a second, whatever it was before.
TEST(DropsOnCloth, TheWetDiskOfAPourGrowsByWicking) {
  DropsScene scene({}, pinned(41, 0.4));
  wetcloth::Diffusion::Parameters wicking;
  wicking.exponent = 0;
  wicking.warpDiffusivity = wicking.weftDiffusivity = 1e-4;
  scene.cloth().add<wetcloth::Diffusion>(wicking);
  Pour pour = shower(0, 2e-5, 1e-3);  // 10 mg in all: as much as one node has room for
  pour.stop = 0.5;
  scene.drops.add(pour);
  scene.step(240);
  ASSERT_EQ(scene.drops.size(), 0u);
  ASSERT_GT(scene.drops.landedOnCloth(), 15);
  const auto meanSquare = [&] {
    double sum = 0;
    double held = 0;
    for (int i = 0; i < scene.cloth().nodeCount(); ++i) {
      sum += scene.cloth().held(i) * double(scene.cloth().body().m_nodes[i].m_x.length2());
      held += scene.cloth().held(i);
    }
    return sum / held;
  };
  const double before = meanSquare();
  scene.step(240 * 2);
  // Finite volumes on squares keep the second moment exactly until the border is wet, which is 10 sigma away.
  EXPECT_NEAR(meanSquare() - before, 4 * 1e-4 * 2, 1e-2 * 4 * 1e-4 * 2);
}

TEST(DropsOnCloth, DripsLandOnTheClothBelow) {
  BulletWorld bullet(WorldKind::softRigid);
  wetcloth::ClothPatch upper = pinned(5, 0.3);
  upper.origin += btVector3(0, 1, 0);
  auto wetBody = upper.build(bullet.info());
  auto dryBody = pinned(9, 1).build(bullet.info());
  bullet.add(*wetBody);
  bullet.add(*dryBody);
  {
    wetcloth::WetClothWorld wet(bullet.world(), wetcloth::Hook::manual);
    Drops drops(wet);
    wetcloth::WetCloth& above = wet.add(*wetBody);
    wetcloth::WetCloth& below = wet.add(*dryBody);
    above.setSaturation(1);
    above.add<wetcloth::Dripping>();
    for (int i = 0; i < 240 * 3; ++i) {
      wet.preTick(btScalar(kSubstep));
      const wetcloth::WorldLedger ledger = drops.ledger();
      ASSERT_NEAR(ledger.imbalance(), 0, kLedger * ledger.initial) << i;
    }
    const double dripped = above.ledger().dripped;
    EXPECT_GT(dripped, 1e-3);
    EXPECT_NEAR(below.ledger().held + drops.ledger().inFlight, dripped, 1e-12 * dripped);
    EXPECT_GT(below.ledger().held, 0.5 * dripped);
    EXPECT_EQ(drops.ledger().brought, 0);
  }
  bullet.remove(*wetBody);
  bullet.remove(*dryBody);
}

TEST(DropsOnCloth, RainThatRunsOffGoesOnAsDrops) {
  DropsScene scene;
  scene.cloth().setSaturation(1);
  scene.cloth().add<wetcloth::Rain>({btVector3(0, -1, 0), 0.05, 6.5, false});
  scene.step(240);
  const wetcloth::WorldLedger ledger = scene.drops.ledger();
  // On one square metre, whose nodes' areas Bullet's scalar rounds.
  EXPECT_NEAR(ledger.brought, 0.05, 1e-6);
  EXPECT_NEAR(ledger.inFlight + ledger.left, ledger.brought, kLedger * ledger.initial);
  EXPECT_GT(scene.drops.size(), 500u);
  EXPECT_NEAR(ledger.imbalance(), 0, kLedger * ledger.initial);
}

TEST(DropsOnCloth, WithNothingToDoNothingIsDone) {
  DropsScene scene;
  scene.cloth().setSaturation(0.5);
  scene.step(10);
  EXPECT_EQ(scene.drops.candidates(), 0);
  EXPECT_EQ(scene.drops.born(), 0);
}

}  // namespace
}  // namespace wetcloth_test::drops_on_cloth_test
