// SPDX-License-Identifier: Zlib
// initializeClusters() caches node masses, the cluster's mass, its centre and its inertia. Calling it again on a
// running body is no way out: it takes the deformed shape for the rest shape.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Patches.h"
#include "tests/support/UnevenWater.h"

namespace wetcloth_test::cluster_masses_are_cached_test {

namespace {

constexpr int kClusters = 6;
// Sums over some 40 nodes, and the inverse of a 3 x 3 matrix.
constexpr double kTolerance = kIsDouble ? 1e-10 : 2e-4;

// A bowl, so that the inertia of no cluster is singular.
std::unique_ptr<btSoftBody> bowl(btSoftBodyWorldInfo& info) {
  std::unique_ptr<btSoftBody> body = squarePatch(8).build(info);
  for (int i = 0; i < body->m_nodes.size(); ++i) {
    btVector3& x = body->m_nodes[i].m_x;
    x.setY(2 * (x.x() - btScalar(0.5)) * (x.x() - btScalar(0.5)) + (x.z() - btScalar(0.4)) * (x.z() - btScalar(0.4)));
    body->m_nodes[i].m_q = x;
  }
  return body;
}

std::unique_ptr<btSoftBody> dryWithClusters(btSoftBodyWorldInfo& info) {
  std::unique_ptr<btSoftBody> body = bowl(info);
  body->generateClusters(kClusters);
  return body;
}

std::unique_ptr<btSoftBody> heavyWithClusters(btSoftBodyWorldInfo& info) {
  std::unique_ptr<btSoftBody> body = bowl(info);
  makeUnevenlyHeavy(*body);
  body->generateClusters(kClusters);
  return body;
}

void expectNear(const btVector3& a, const btVector3& b, double tolerance, const char* what) {
  EXPECT_LT((a - b).length(), tolerance) << what;
}

void expectSameCaches(const btSoftBody& wet, const btSoftBody& fresh) {
  ASSERT_EQ(wet.m_clusters.size(), fresh.m_clusters.size());
  for (int c = 0; c < wet.m_clusters.size(); ++c) {
    const btSoftBody::Cluster& a = *wet.m_clusters[c];
    const btSoftBody::Cluster& b = *fresh.m_clusters[c];
    ASSERT_EQ(a.m_masses.size(), b.m_masses.size());
    for (int i = 0; i < a.m_masses.size(); ++i) EXPECT_NEAR(a.m_masses[i], b.m_masses[i], kTolerance * b.m_masses[i]);
    EXPECT_NEAR(a.m_imass, b.m_imass, kTolerance * b.m_imass);
    for (int i = 0; i < a.m_framerefs.size(); ++i) {
      expectNear(a.m_framerefs[i], b.m_framerefs[i], kTolerance, "place in the cluster's frame");
    }
    const double size = b.m_locii[0].length() + b.m_locii[1].length() + b.m_locii[2].length();
    for (int row = 0; row < 3; ++row) expectNear(a.m_locii[row], b.m_locii[row], kTolerance * size, "inertia");
  }
}

// The fact.
TEST_IN_EVERY_WORLD(ClusterMassesAreCached, InPlainBulletTheyDoNotFollowTheNodes) {
  BodyScene scene(GetParam(), dryWithClusters);
  const btScalar before = scene.body().m_clusters[0]->m_imass;
  makeUnevenlyHeavy(scene.body());
  scene.bullet().step(10);
  EXPECT_EQ(scene.body().m_clusters[0]->m_imass, before);
}

TEST_IN_EVERY_WORLD(ClusterMassesAreCached, WetClothHasThoseOfABodyBuiltHeavy) {
  BodyScene scene(GetParam(), dryWithClusters);
  BodyScene fresh(GetParam(), heavyWithClusters);
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = wet.add(scene.body());
  cloth.setHeld(unevenWater(cloth));
  expectSameCaches(scene.body(), fresh.body());
}

TEST_IN_EVERY_WORLD(ClusterMassesAreCached, ShapeAtRestIsThatOfTheDryClothNotTheDeformedOne) {
  BodyScene scene(GetParam(), dryWithClusters);
  BodyScene fresh(GetParam(), heavyWithClusters);
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = wet.add(scene.body());
  for (int i = 0; i < scene.body().m_nodes.size(); ++i) scene.body().m_nodes[i].m_x *= btVector3(2, 1, btScalar(0.5));
  cloth.setHeld(unevenWater(cloth));
  expectSameCaches(scene.body(), fresh.body());
}

// Damping pulls each node towards the velocity of its cluster, which is a mean by mass. Only the two position-based
// worlds do that.
TEST_IN_EVERY_WORLD(ClusterMassesAreCached, RunsLikeABodyBuiltHeavy) {
  BodyScene scene(GetParam(), dryWithClusters);
  BodyScene fresh(GetParam(), heavyWithClusters);
  BodyScene dry(GetParam(), dryWithClusters);
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = wet.add(scene.body());
  cloth.setHeld(unevenWater(cloth));
  for (BodyScene* each : {&scene, &fresh, &dry}) {
    for (int c = 0; c < each->body().m_clusters.size(); ++c) each->body().m_clusters[c]->m_ndamping = btScalar(0.1);
    for (int i = 0; i < each->body().m_nodes.size(); i += 3) each->body().addVelocity(btVector3(0, 0, 1), i);
    each->bullet().step(20);
  }
  const std::vector<btScalar> expected = stateOf(fresh.body());
  // 20 steps amplify the rounding of the caches.
  const double tolerance = kIsDouble ? 1e-9 : 2e-3;
  EXPECT_LT(largestDifference(stateOf(scene.body()), expected), tolerance);
  if (!scene.bullet().isDeformable()) {
    EXPECT_GT(largestDifference(stateOf(dry.body()), expected), 10 * tolerance) << "masses matter here";
  }
}

}  // namespace
}  // namespace wetcloth_test::cluster_masses_are_cached_test
