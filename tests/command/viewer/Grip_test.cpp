// SPDX-License-Identifier: Zlib
#include "tests/command/viewer/ViewerScene.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace wetcloth_test::grip_test {
namespace {

using namespace viewer_scene;
using viewer::Grip;
using viewer::LiveScene;
using viewer::Side;

using GripIn = InEachWorld;
INSTANTIATE_TEST_SUITE_P(EachWorld, GripIn, allWorlds, worldName);

/// Of motion and height [J].
double energyOf(const LiveScene& live) {
  const btSoftBody& body = *live.world().bodies()[0];
  double energy = 0;
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    const btSoftBody::Node& node = body.m_nodes[i];
    if (node.m_im == 0) continue;
    energy += (0.5 * static_cast<double>(node.m_v.length2()) + 9.81 * static_cast<double>(node.m_x.y())) /
              static_cast<double>(node.m_im);
  }
  return energy;
}

double fastestOf(const btSoftBody& body) {
  btScalar fastest = 0;
  for (int i = 0; i < body.m_nodes.size(); ++i) fastest = std::max(fastest, body.m_nodes[i].m_v.length());
  return static_cast<double>(fastest);
}

std::vector<btScalar> inverseMasses(const btSoftBody& body) {
  std::vector<btScalar> masses;
  for (int i = 0; i < body.m_nodes.size(); ++i) masses.push_back(body.m_nodes[i].m_im);
  return masses;
}

TEST_P(GripIn, TheHeldNodeFollowsTheHandAndThePinsStay) {
  LiveScene live(hangingTowel(GetParam()));
  run(live, 5);
  ASSERT_TRUE(live.grab(rayAt(0.5, 1.05)));
  const btVector3 start = live.grip()->node().m_x;
  const btVector3 goal = start + btVector3(0, btScalar(0.3), btScalar(0.5));
  live.dragTo(goal);
  run(live, 60);
  EXPECT_LT((live.grip()->node().m_x - goal).length(), 0.1);
  EXPECT_EQ(live.world().bodies()[0]->m_nodes[0].m_x, btVector3(0, 2, 0));
}

TEST_P(GripIn, WhatIsLetGoKeepsNothingOfTheHand) {
  LiveScene live(hangingTowel(GetParam()));
  const std::vector<btScalar> masses = inverseMasses(*live.world().bodies()[0]);
  ASSERT_TRUE(live.grab(rayAt(0.5, 1.05)));
  live.dragTo(btVector3(btScalar(0.5), 2, 40));  // as far as it goes, and further
  run(live, 60);
  live.release();
  EXPECT_EQ(live.grip(), nullptr);
  const double atRelease = energyOf(live);
  double most = atRelease;
  for (int i = 0; i < 120; ++i) {
    live.step();
    most = std::max(most, energyOf(live));
    EXPECT_LE(fastestOf(*live.world().bodies()[0]), 2 * Grip::fastest + 9.81 * i * live.scene().step);
  }
  EXPECT_EQ(inverseMasses(*live.world().bodies()[0]), masses);
  std::printf("energy: %g at release, at most %g, %g at the end\n", atRelease, most, energyOf(live));
  EXPECT_LE(energyOf(live), atRelease);
}

TEST_P(GripIn, GrabAndReleaseAloneChangesNothing) {
  LiveScene touched(soakingTowel(GetParam()));
  LiveScene alone(soakingTowel(GetParam()));
  run(touched, 5);
  run(alone, 5);
  ASSERT_TRUE(touched.grab(rayAt(0.5, 1.4)));
  touched.release();
  run(touched, 20);
  run(alone, 20);
  EXPECT_EQ(touched.frame(Side::wet).cloths[0].positions, alone.frame(Side::wet).cloths[0].positions);
}

TEST_P(GripIn, PlainBulletIsDraggedToo) {
  LiveScene live(soakingTowel(GetParam()));
  LiveScene alone(soakingTowel(GetParam()));
  live.setCompared(true);
  ASSERT_TRUE(live.grab(rayAt(0.5, 1.05), Side::plainBullet));
  const btVector3 goal = live.grip()->node().m_x + btVector3(0, btScalar(0.3), btScalar(0.5));
  live.dragTo(goal);
  run(live, 60);
  run(alone, 60);
  EXPECT_LT((live.grip()->node().m_x - goal).length(), 0.1);
  EXPECT_EQ(live.frame(Side::wet).cloths[0].positions, alone.frame(Side::wet).cloths[0].positions);
  live.setCompared(false);
  EXPECT_EQ(live.grip(), nullptr);
}

TEST(Grip, WhatIsNotFiniteIsIgnored) {
  LiveScene live(hangingTowel());
  live.dragTo(btVector3(0, 0, 0));  // nothing is held
  ASSERT_TRUE(live.grab(rayAt(0.5, 1.5)));
  const btVector3 goal = live.grip()->goal();
  live.dragTo(btVector3(0, btScalar(std::nan("")), 0));
  EXPECT_EQ(live.grip()->goal(), goal);
}

TEST(Picking, TakesTheNearestNodeOfTheFirstCloth) {
  command::Scene scene = hangingTowel();
  command::ClothScene front = scene.cloths[0];
  std::get<wetcloth::ClothPatch>(front.shape).origin += btVector3(0, 0, 1);
  scene.cloths.push_back(front);
  LiveScene live(scene);
  const auto hit = viewer::pickCloth(rayAt(0.51, 1.49), live.scenery(), live.cloths(), live.frame(Side::wet));
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->cloth, 1);
  EXPECT_EQ(hit->node, 4 * 9 + 4);
  EXPECT_NEAR(hit->distance, 4, 1e-5);
}

TEST(Picking, NothingBesideTheClothNorBehindABall) {
  command::Scene scene = hangingTowel();
  scene.colliders = {command::Sphere{btVector3(btScalar(0.5), btScalar(1.5), 2), 0.2}};
  LiveScene live(scene);
  EXPECT_FALSE(live.grab(rayAt(1.2, 1.5)));
  EXPECT_FALSE(live.grab(rayAt(0.5, 1.5)));
  EXPECT_EQ(live.grip(), nullptr);
  EXPECT_TRUE(live.grab(rayAt(0.1, 1.5)));
  EXPECT_FALSE(live.grab(rayAt(0.1, 1.5), Side::plainBullet));  // there is none
}

}  // namespace
}  // namespace wetcloth_test::grip_test
