// SPDX-License-Identifier: Zlib
// The deformable world caches node masses in two more places: its mass preconditioner, refreshed only when the number
// of nodes changes, and each anchor's m_c0 and m_c2, computed once by btSoftBody::appendDeformableAnchor().

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/Patches.h"
#include "tests/support/RigidBody.h"
#include "tests/support/UnevenWater.h"

#include <gtest/gtest.h>

#include <BulletSoftBody/btDeformableBackwardEulerObjective.h>

namespace wetcloth_test::deformable_caches_masses_test {

namespace {

constexpr double kTolerance = kIsDouble ? 1e-12 : 1e-5;

class DeformableCachesMasses {
 protected:
  // Inverse masses as the preconditioner knows them: it multiplies by them.
  static std::vector<btScalar> preconditionedOnes(btSoftBody& body) {
    auto& solver = *static_cast<btDeformableBodySolver*>(body.getSoftBodySolver());
    btAlignedObjectArray<btVector3> ones;
    ones.resize(body.m_nodes.size(), btVector3(1, 1, 1));
    btAlignedObjectArray<btVector3> result;
    result.resize(body.m_nodes.size(), btVector3(0, 0, 0));
    (*solver.m_objective->m_massPreconditioner)(ones, result);
    std::vector<btScalar> inverseMass;
    for (int i = 0; i < result.size(); ++i) inverseMass.push_back(result[i].x());
    return inverseMass;
  }
};

// The fact.
TEST_F_IN_DEFORMABLE_WORLDS(DeformableCachesMasses, InPlainBulletThePreconditionerStaysBehind) {
  BodyScene scene(GetParam(), squarePatch(4));
  scene.bullet().step(1);
  const std::vector<btScalar> before = preconditionedOnes(scene.body());
  makeUnevenlyHeavy(scene.body());
  scene.bullet().step(5);
  EXPECT_TRUE(sameBits(preconditionedOnes(scene.body()), before));
}

TEST_F_IN_DEFORMABLE_WORLDS(DeformableCachesMasses, ThePreconditionerFollowsTheWater) {
  BodyScene scene(GetParam(), squarePatch(4));
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = wet.add(scene.body());
  scene.bullet().step(1);
  cloth.setHeld(unevenWater(cloth));
  scene.bullet().step(1);
  const std::vector<btScalar> known = preconditionedOnes(scene.body());
  for (int i = 0; i < scene.body().m_nodes.size(); ++i) {
    EXPECT_EQ(known[std::size_t(i)], scene.body().m_nodes[i].m_im) << "node " << i;
  }
}

TEST_F_IN_DEFORMABLE_WORLDS(DeformableCachesMasses, ThePreconditionerKeepsOtherBodiesInTheirPlaces) {
  BulletWorld bullet(GetParam());
  std::unique_ptr<btSoftBody> bodies[3];
  for (auto& body : bodies) {
    body = squarePatch(&body == &bodies[1] ? 4 : 3).build(bullet.info());
    bullet.add(*body);
  }
  {
    wetcloth::WetClothWorld wet(bullet.world());
    wetcloth::WetCloth& cloth = wet.add(*bodies[1]);
    bullet.step(1);
    cloth.setSaturation(1);
    bullet.step(1);
    auto& solver = *static_cast<btDeformableBodySolver*>(bodies[0]->getSoftBodySolver());
    btAlignedObjectArray<btVector3> ones;
    ones.resize(9 + 16 + 9, btVector3(1, 1, 1));
    btAlignedObjectArray<btVector3> result = ones;
    (*solver.m_objective->m_massPreconditioner)(ones, result);
    int row = 0;
    for (auto& body : bodies) {
      for (int i = 0; i < body->m_nodes.size(); ++i, ++row) EXPECT_EQ(result[row].x(), body->m_nodes[i].m_im) << row;
    }
  }
  for (auto& body : bodies) bullet.remove(*body);
}

// A cloth hanging from two corners on a heavy box that falls with it.
struct AnchoredScene {
  explicit AnchoredScene(WorldKind kind, bool heavy)
      : scene(kind,
              [heavy](btSoftBodyWorldInfo& info) {
                std::unique_ptr<btSoftBody> body = squarePatch(5).build(info);
                if (heavy) makeUnevenlyHeavy(*body);
                return body;
              }),
        box(scene.bullet(), std::make_unique<btBoxShape>(btVector3(btScalar(0.2), btScalar(0.2), btScalar(0.2))),
            btScalar(0.05), btVector3(btScalar(-0.2), 0, 0)) {
    scene.addBulletSprings(20, 0.1, SpringDamping::everyDirection);
    box.body().setDamping(0, 0);
    scene.body().appendDeformableAnchor(1, &box.body());
    scene.body().appendDeformableAnchor(20, &box.body());
  }
  BodyScene scene;
  RigidBody box;
};

// The fact.
TEST_F_IN_DEFORMABLE_WORLDS(DeformableCachesMasses, InPlainBulletAnchorsStayBehind) {
  AnchoredScene dry(GetParam(), false);
  const btMatrix3x3 before = dry.scene.body().m_deformableAnchors[0].m_c0;
  const btScalar inverseMass = dry.scene.body().m_deformableAnchors[0].m_c2;
  makeUnevenlyHeavy(dry.scene.body());
  dry.scene.bullet().step(5);
  EXPECT_TRUE(dry.scene.body().m_deformableAnchors[0].m_c0 == before);
  EXPECT_EQ(dry.scene.body().m_deformableAnchors[0].m_c2, inverseMass);
}

TEST_F_IN_DEFORMABLE_WORLDS(DeformableCachesMasses, AnchorsFollowTheWater) {
  AnchoredScene wetted(GetParam(), false);
  AnchoredScene fresh(GetParam(), true);
  wetcloth::WetClothWorld wet(wetted.scene.world());
  wetcloth::WetCloth& cloth = wet.add(wetted.scene.body());
  cloth.setHeld(unevenWater(cloth));
  for (int a = 0; a < 2; ++a) {
    const btSoftBody::DeformableNodeRigidAnchor& actual = wetted.scene.body().m_deformableAnchors[a];
    const btSoftBody::DeformableNodeRigidAnchor& expected = fresh.scene.body().m_deformableAnchors[a];
    EXPECT_NEAR(actual.m_c2, expected.m_c2, kTolerance * expected.m_c2);
    for (int row = 0; row < 3; ++row) {
      EXPECT_LT((actual.m_c0[row] - expected.m_c0[row]).length(), kTolerance * expected.m_c0[row].length());
    }
  }
}

TEST_F_IN_DEFORMABLE_WORLDS(DeformableCachesMasses, AnAnchoredClothRunsLikeOneBuiltHeavy) {
  AnchoredScene wetted(GetParam(), false);
  AnchoredScene fresh(GetParam(), true);
  AnchoredScene dry(GetParam(), false);
  wetcloth::WetClothWorld wet(wetted.scene.world());
  wetcloth::WetCloth& cloth = wet.add(wetted.scene.body());
  cloth.setHeld(unevenWater(cloth));
  for (AnchoredScene* each : {&wetted, &fresh, &dry}) {
    each->box.body().setLinearVelocity(btVector3(-1, 2, 0));
    each->scene.bullet().step(60);
  }
  const std::vector<btScalar> expected = stateOf(fresh.scene.body());
  // The solver stops at a residual of 1e-4 of the first one or so: that, not rounding, sets the tolerance.
  EXPECT_LT(largestDifference(stateOf(wetted.scene.body()), expected), 1e-3);
  EXPECT_GT(largestDifference(stateOf(dry.scene.body()), expected), 1e-2) << "the comparison tells masses apart";
}

}  // namespace
}  // namespace wetcloth_test::deformable_caches_masses_test
