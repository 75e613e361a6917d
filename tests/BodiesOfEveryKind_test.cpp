// SPDX-License-Identifier: Zlib
// Anchors and tetrahedra: a body that got wet runs like one that was built with the wet masses.
// (Clusters, poses and the deformable world's anchors are among the traps.)

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Materials.h"
#include "tests/support/Measures.h"
#include "tests/support/Patches.h"
#include "tests/support/RigidBody.h"
#include "tests/support/UnevenWater.h"

#include <BulletSoftBody/btDeformableNeoHookeanForce.h>
#include <BulletSoftBody/btSoftBodyHelpers.h>

namespace wetcloth_test::bodies_of_every_kind_test {

namespace {

std::unique_ptr<btSoftBody> cloth(btSoftBodyWorldInfo& info, bool heavy) {
  std::unique_ptr<btSoftBody> body = squarePatch(5).build(info);
  if (heavy) makeUnevenlyHeavy(*body);
  return body;
}

// Two nodes of a falling cloth are anchored to a light box that flies off.
struct Anchored {
  Anchored(WorldKind kind, bool heavy)
      : scene(kind, [heavy](btSoftBodyWorldInfo& info) { return cloth(info, heavy); }),
        box(scene.bullet(), std::make_unique<btBoxShape>(btVector3(btScalar(0.1), btScalar(0.1), btScalar(0.1))),
            btScalar(0.05), btVector3(btScalar(-0.3), 0, btScalar(0.5))) {
    scene.body().appendAnchor(5, &box.body(), true);
    scene.body().appendAnchor(11, &box.body(), true);
    box.body().setLinearVelocity(btVector3(-2, 1, 0));
  }
  BodyScene scene;
  RigidBody box;
};

TEST_IN_POSITION_BASED_WORLDS(BodiesOfEveryKind, AnAnchoredClothRunsLikeOneBuiltHeavy) {
  Anchored wetted(GetParam(), false);
  Anchored fresh(GetParam(), true);
  Anchored dry(GetParam(), false);
  wetcloth::WetClothWorld wet(wetted.scene.world());
  wetcloth::WetCloth& wetCloth = wet.add(wetted.scene.body());
  wetCloth.setHeld(unevenWater(wetCloth));
  for (Anchored* each : {&wetted, &fresh, &dry}) each->scene.bullet().step(60);
  const std::vector<btScalar> expected = stateOf(fresh.scene.body());
  // Inverse masses round twice in one of them; 60 steps amplify that.
  const double tolerance = kIsDouble ? 1e-8 : 1e-2;
  EXPECT_LT(largestDifference(stateOf(wetted.scene.body()), expected), tolerance);
  EXPECT_LT(double((wetted.box.body().getLinearVelocity() - fresh.box.body().getLinearVelocity()).length()), tolerance);
  EXPECT_GT(largestDifference(stateOf(dry.scene.body()), expected), 10 * tolerance) << "masses matter here";
}

// Five tetrahedra in a cube, in TetGen's format.
const char* const kNodes =
    "8 3 0 0\n"
    "0 0 0 0\n1 1 0 0\n2 1 1 0\n3 0 1 0\n"
    "4 0 0 1\n5 1 0 1\n6 1 1 1\n7 0 1 1\n";
const char* const kElements =
    "5 4 0\n"
    "0 0 1 3 4\n1 1 2 3 6\n2 4 6 5 1\n3 4 7 6 3\n4 1 6 3 4\n";

std::unique_ptr<btSoftBody> cube(btSoftBodyWorldInfo& info, bool heavy) {
  std::unique_ptr<btSoftBody> body(
      btSoftBodyHelpers::CreateFromTetGenData(info, kElements, nullptr, kNodes, true, true, false));
  body->setTotalMass(1);
  if (heavy) makeUnevenlyHeavy(*body);
  btSoftBodyHelpers::generateBoundaryFaces(body.get());
  return body;
}

TEST_IN_EVERY_WORLD(Tetrahedra, RunLikeABodyBuiltHeavy) {
  const auto make = [](bool heavy) { return [heavy](btSoftBodyWorldInfo& info) { return cube(info, heavy); }; };
  BodyScene wetted(GetParam(), make(false));
  BodyScene fresh(GetParam(), make(true));
  BodyScene dry(GetParam(), make(false));
  ASSERT_EQ(wetted.body().m_tetras.size(), 5);
  wetcloth::WetClothWorld wet(wetted.world());
  wetcloth::WetCloth& wetCloth = wet.add(wetted.body());
  wetCloth.setHeld(unevenWater(wetCloth));
  for (BodyScene* each : {&wetted, &fresh, &dry}) {
    if (each->bullet().isDeformable()) {
      each->bullet().addForce(each->body(), std::make_unique<btDeformableNeoHookeanForce>(btScalar(20), btScalar(40)));
    }
    each->bullet().step(1);  // the first step takes the rest lengths
    // It is squeezed and let go.
    for (int i = 0; i < 8; ++i) each->body().m_nodes[i].m_x *= btVector3(btScalar(0.8), 1, 1);
    each->bullet().step(60);
  }
  const std::vector<btScalar> expected = stateOf(fresh.body());
  // The deformable world's solver stops at a residual of its own.
  const double tolerance = wetted.bullet().isDeformable() ? 1e-3 : (kIsDouble ? 1e-8 : 1e-2);
  EXPECT_LT(largestDifference(stateOf(wetted.body()), expected), tolerance);
  EXPECT_GT(largestDifference(stateOf(dry.body()), expected), 10 * tolerance) << "masses matter here";
}

TEST_IN_EVERY_WORLD(Tetrahedra, CanAbsorbAndFeelWind) {
  BodyScene scene(GetParam(), [](btSoftBodyWorldInfo& info) { return cube(info, false); });
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& wetCloth = wet.add(scene.body(), fabricOf(1, 1));
  wetCloth.add<wetcloth::Absorption>();
  if (scene.body().m_faces.size() > 0) wetCloth.add<wetcloth::Wind>({btVector3(0, 0, 5)});
  scene.bullet().step(120);
  EXPECT_TRUE(isFinite(scene.body()));
  EXPECT_NEAR(wetCloth.meanSaturation(), 1 - std::exp(-0.5), 1e-5);
  if (scene.body().m_faces.size() > 0) {
    EXPECT_GT(meanVelocity(scene.body()).z(), 0.1);
  }
}

}  // namespace
}  // namespace wetcloth_test::bodies_of_every_kind_test
