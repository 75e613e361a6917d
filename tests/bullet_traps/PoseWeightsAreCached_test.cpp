// SPDX-License-Identifier: Zlib
// setPose() caches each node's share of the mass, which shape matching uses for the centre and the rotation; calling it
// again on a running body would take the deformed shape for the pose.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Patches.h"
#include "tests/support/UnevenWater.h"

namespace wetcloth_test::pose_weights_are_cached_test {

namespace {

constexpr double kTolerance = kIsDouble ? 1e-11 : 1e-4;

wetcloth::ClothPatch patch(bool pinned) {
  wetcloth::ClothPatch result = squarePatch(6);
  if (pinned) result.pinnedCorners = {wetcloth::ClothPatch::Corner::topLeft};
  return result;
}

std::unique_ptr<btSoftBody> posed(btSoftBodyWorldInfo& info, bool pinned, bool heavy) {
  std::unique_ptr<btSoftBody> body = patch(pinned).build(info);
  // Not flat, so that the pose's matrix can be inverted.
  for (int i = 0; i < body->m_nodes.size(); ++i) {
    btVector3& x = body->m_nodes[i].m_x;
    x.setY(x.x() * x.x() + btScalar(0.5) * x.z() * x.z());
    body->m_nodes[i].m_q = x;
  }
  if (heavy) makeUnevenlyHeavy(*body);
  body->setPose(false, true);
  body->m_cfg.kMT = btScalar(0.3);
  return body;
}

auto maker(bool pinned, bool heavy) {
  return [pinned, heavy](btSoftBodyWorldInfo& info) { return posed(info, pinned, heavy); };
}

void expectSamePose(const btSoftBody& wet, const btSoftBody& fresh) {
  const btSoftBody::Pose& a = wet.m_pose;
  const btSoftBody::Pose& b = fresh.m_pose;
  for (int i = 0; i < b.m_wgh.size(); ++i) {
    EXPECT_NEAR(a.m_wgh[i], b.m_wgh[i], kTolerance * b.m_wgh[i]) << "weight of node " << i;
    EXPECT_LT((a.m_pos[i] - b.m_pos[i]).length(), kTolerance) << "place of node " << i << " in the pose";
  }
  const double size = b.m_aqq[0].length() + b.m_aqq[1].length() + b.m_aqq[2].length();
  for (int row = 0; row < 3; ++row) EXPECT_LT((a.m_aqq[row] - b.m_aqq[row]).length(), kTolerance * size) << row;
}

// The fact.
TEST_IN_EVERY_WORLD(PoseWeightsAreCached, InPlainBulletTheyDoNotFollowTheNodes) {
  BodyScene scene(GetParam(), maker(false, false));
  const btScalar before = scene.body().m_pose.m_wgh[0];
  makeUnevenlyHeavy(scene.body());
  scene.bullet().step(10);
  EXPECT_EQ(scene.body().m_pose.m_wgh[0], before);
}

TEST_IN_EVERY_WORLD(PoseWeightsAreCached, WetClothHasThoseOfABodyBuiltHeavy) {
  for (const bool pinned : {false, true}) {
    BodyScene scene(GetParam(), maker(pinned, false));
    BodyScene fresh(GetParam(), maker(pinned, true));
    wetcloth::WetClothWorld wet(scene.world());
    wetcloth::WetCloth& cloth = wet.add(scene.body());
    cloth.setHeld(unevenWater(cloth));
    expectSamePose(scene.body(), fresh.body());
  }
}

TEST_IN_EVERY_WORLD(PoseWeightsAreCached, ThePoseIsThatOfTheDryClothNotTheDeformedOne) {
  BodyScene scene(GetParam(), maker(false, false));
  BodyScene fresh(GetParam(), maker(false, true));
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = wet.add(scene.body());
  for (int i = 0; i < scene.body().m_nodes.size(); ++i) scene.body().m_nodes[i].m_x *= btVector3(2, 1, btScalar(0.5));
  cloth.setHeld(unevenWater(cloth));
  expectSamePose(scene.body(), fresh.body());
}

TEST_IN_EVERY_WORLD(PoseWeightsAreCached, RunsLikeABodyBuiltHeavy) {
  for (const bool pinned : {false, true}) {
    BodyScene scene(GetParam(), maker(pinned, false));
    BodyScene fresh(GetParam(), maker(pinned, true));
    wetcloth::WetClothWorld wet(scene.world());
    wetcloth::WetCloth& cloth = wet.add(scene.body());
    cloth.setHeld(unevenWater(cloth));
    for (BodyScene* each : {&scene, &fresh}) {
      for (int i = 0; i < each->body().m_nodes.size(); i += 3) each->body().addVelocity(btVector3(0, 2, 0), i);
      each->bullet().step(40);
    }
    // 40 steps amplify the rounding of the weights.
    EXPECT_LT(largestDifference(stateOf(scene.body()), stateOf(fresh.body())), kIsDouble ? 1e-8 : 2e-2) << pinned;
  }
}

}  // namespace
}  // namespace wetcloth_test::pose_weights_are_cached_test
