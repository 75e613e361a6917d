// SPDX-License-Identifier: Zlib
// A hanging chain of springs: link j stretches by (weight below it) / k, dry and wet, however Bullet is set up.

#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/ClothScene.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/RigidBody.h"
#include "tests/support/SoftBodies.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace wetcloth_test::hooke_springs_statics_test {
namespace {

using wetcloth::HookeSprings;

constexpr double kGravity = 9.81;
constexpr int kLinks = 8;
constexpr double kLength = 0.1;      // of a link [m]
constexpr double kNodeMass = 0.01;   // [kg]
constexpr double kStiffness = 50.0;  // [N/m]: the lowest node alone stretches a link by 2 mm, all of them the top by 16

HookeSprings::Parameters springs(double stiffness) {
  HookeSprings::Parameters parameters;
  parameters.stiffness = stiffness;
  return parameters;
}

double linkLength(const btSoftBody& body, int link) {
  return double((body.m_links[link].m_n[0]->m_x - body.m_links[link].m_n[1]->m_x).length());
}

/// Lets the scene come to rest: all velocities lose 3 % a step, so after `seconds` nothing of the fall is left.
void settle(ClothScene& scene, double dt, double seconds = 4) {
  for (int i = 0; i < seconds / dt; ++i) {
    scene.step(1, dt);
    damp(scene.body(), 0.03);
  }
}

/// Each link's extension against (weight of the nodes below it, plus `load` [kg]) / k, to `share` of it.
void expectHangingChain(ClothScene& scene, double stiffness, double share, double load = 0) {
  double below = load;
  for (int link = kLinks - 1; link >= 0; --link) {
    below += 1 / double(scene.node(link + 1).m_im);
    const double extension = linkLength(scene.body(), link) - kLength;
    EXPECT_NEAR(extension / (below * kGravity / stiffness), 1, share) << "link " << link;
  }
}

// At rest the answer does not depend on iterations or the step; what is left of the fall is
// exp(-0.03 x 240) = 1e-3 of it, and float32 knows a length of 0.8 m to 6e-8 m, 3e-5 of the smallest extension.
constexpr double kShare = 0.01;

TEST_IN_EVERY_WORLD(HookeSpringsStatics, HangingChainStretchesByTheWeightBelowEachLink) {
  for (int iterations : {10, 100}) {
    for (int substeps : {1, 4}) {
      for (double saturation : {0.0, 1.0}) {
        SCOPED_TRACE(testing::Message() << iterations << " iterations, " << substeps << " substeps, saturation "
                                        << saturation);
        ClothScene scene(GetParam(), kEarthGravity, hangingRope(kLinks, kLength, kNodeMass));
        scene.body().m_cfg.piterations = iterations;
        scene.cloth().add<HookeSprings>(springs(kStiffness));
        scene.cloth().setSaturation(saturation);
        settle(scene, 1.0 / 60 / substeps);
        ASSERT_NEAR(1 / double(scene.node(1).m_im), kNodeMass * (1 + 0.84 * saturation), 1e-8);
        expectHangingChain(scene, kStiffness, kShare);
      }
    }
  }
}

TEST_IN_EVERY_WORLD(HookeSpringsStatics, ChainThatSoaksWhileItHangsEndsWhereAWetOneDoes) {
  ClothScene scene(GetParam(), kEarthGravity, hangingRope(kLinks, kLength, kNodeMass));
  scene.cloth().add<HookeSprings>(springs(kStiffness));
  settle(scene, kSubstep, 2);
  const double dry = -double(scene.node(kLinks).m_x.y()) - kLinks * kLength;
  wetcloth::Absorption::Parameters ramp;
  ramp.law = wetcloth::Absorption::Law::ramp;
  ramp.rampDuration = 1;
  scene.cloth().add<wetcloth::Absorption>(ramp);
  settle(scene, kSubstep, 3);
  const double wet = -double(scene.node(kLinks).m_x.y()) - kLinks * kLength;
  EXPECT_NEAR(wet / dry, 1.84, 0.02);
  expectHangingChain(scene, kStiffness, kShare);
}

TEST_IN_EVERY_WORLD(HookeSpringsStatics, StretchGrowsWithTheWeightAndFallsWithTheStiffness) {
  const auto total = [](double stiffness, double mass) {
    ClothScene scene(GetParam(), kEarthGravity, hangingRope(kLinks, kLength, mass));
    scene.cloth().add<HookeSprings>(springs(stiffness));
    settle(scene, kSubstep);
    return -double(scene.node(kLinks).m_x.y()) - kLinks * kLength;
  };
  const double once = total(50, 0.01);
  EXPECT_NEAR(total(50, 0.02) / once, 2, 0.02);
  EXPECT_NEAR(total(200, 0.01) / once, 0.25, 0.0025);
}

// A strip of two columns, held together by its rungs; the diagonals and the flexion springs are given no stiffness,
// so that each column is a chain.
TEST_IN_EVERY_WORLD(HookeSpringsStatics, HangingStripStretchesLikeTwoChains) {
  wetcloth::ClothPatch patch;
  patch.columns = 2;
  patch.rows = 9;
  patch.origin = btVector3(0, 0, 0);
  patch.edgeU = btVector3(btScalar(0.1), 0, 0);
  patch.edgeV = btVector3(0, btScalar(-0.8), 0);
  patch.pinnedEdges = {wetcloth::ClothPatch::Edge::bottom};  // j = 0, the upper end here
  patch.arealDensity = 1;
  for (double saturation : {0.0, 1.0}) {
    ClothScene scene(GetParam(), kEarthGravity, patch);
    btSoftBody& body = scene.body();
    HookeSprings::Parameters parameters;
    for (int i = 0; i < body.m_links.size(); ++i) {
      parameters.perLink.push_back(body.m_links[i].m_material == body.m_materials[0] ? 50.0 : 1e-9);
    }
    scene.cloth().add<HookeSprings>(parameters);
    scene.cloth().setSaturation(saturation);
    settle(scene, kSubstep);
    for (int i = 0; i < 2; ++i) {
      double below = 0;
      for (int j = 7; j >= 0; --j) {
        below += 1 / double(scene.node(patch.node(i, j + 1)).m_im);
        const double length =
            double((scene.node(patch.node(i, j)).m_x - scene.node(patch.node(i, j + 1)).m_x).length());
        EXPECT_NEAR((length - 0.1) / (below * kGravity / 50), 1, 0.01) << i << " " << j;
      }
    }
  }
}

// A whole patch has no such closed form, but it is linear while it stretches little: 1.84 times the weight, 1.84 times
// the stretch.
TEST_IN_EVERY_WORLD(HookeSpringsStatics, WetPatchStretchesInProportionToItsWeight) {
  wetcloth::ClothPatch patch;
  patch.columns = 9;
  patch.rows = 9;
  patch.edgeV = btVector3(0, -1, 0);
  patch.pinnedEdges = {wetcloth::ClothPatch::Edge::bottom};
  const auto sag = [&](double saturation) {
    ClothScene scene(GetParam(), kEarthGravity, patch);
    HookeSprings::Parameters parameters = springs(500);
    parameters.bendingStiffness = 500;
    scene.cloth().add<HookeSprings>(parameters);
    scene.cloth().setSaturation(saturation);
    settle(scene, kSubstep, 3);
    return -double(scene.node(patch.node(4, 8)).m_x.y()) - 1;
  };
  const double dry = sag(0);
  EXPECT_GT(dry, 2e-4);
  EXPECT_LT(dry, 5e-3);
  EXPECT_NEAR(sag(1) / dry, 1.84, 0.04);
}

TEST_IN_EVERY_WORLD(HookeSpringsStatics, FlexionSpringsTakeTheBendingStiffness) {
  // Rope of 4 links, and two more from node to next but one, marked as bending.
  const auto sag = [](double bendingStiffness) {
    const auto rope = hangingRope(4, kLength, kNodeMass);
    ClothScene scene(GetParam(), kEarthGravity, [&](btSoftBodyWorldInfo& info) {
      auto body = rope(info);
      for (int i = 0; i + 2 <= 4; i += 2) {
        body->appendLink(i, i + 2);
        body->m_links[body->m_links.size() - 1].m_bbending = -1;  // one signed bit: set
      }
      return body;
    });
    HookeSprings::Parameters parameters = springs(50);
    parameters.bendingStiffness = bendingStiffness;
    scene.cloth().add<HookeSprings>(parameters);
    settle(scene, kSubstep);
    return -double(scene.node(4).m_x.y()) - 4 * kLength;
  };
  // Without: (4 + 3 + 2 + 1) m g / k. With K beside two springs in series (k/2): the pairs carry 3 m g + an inner
  // share each; by hand, for K = 50: upper pair: x1 + x2 with k x1 + K (x1 + x2) = 4 m g, k x2 + K (x1 + x2) = 3 m g.
  const double unit = kNodeMass * kGravity / 50;
  EXPECT_NEAR(sag(0) / (10 * unit), 1, 0.01);
  // Sum of both equations: (k + 2 K)(x1 + x2) = 7 m g for the upper pair, 3 m g for the lower.
  EXPECT_NEAR(sag(50) / (10 * unit / 3), 1, 0.01);
}

// --- a load on an anchor --------------------------------------------------------------------------------------------

TEST_IN_EVERY_WORLD(HookeSpringsLoad, RopeWithABoxStretchesByBoth) {
  for (double load : {0.02, 0.2}) {
    SCOPED_TRACE(load);
    btBoxShape shape(btVector3(btScalar(0.05), btScalar(0.05), btScalar(0.05)));
    btVector3 inertia;
    shape.calculateLocalInertia(btScalar(load), inertia);
    btRigidBody box(btRigidBody::btRigidBodyConstructionInfo(btScalar(load), nullptr, &shape, inertia));
    box.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(0, btScalar(-kLinks * kLength), 0)));
    box.setActivationState(DISABLE_DEACTIVATION);
    box.setDamping(btScalar(0.9), btScalar(0.9));

    ClothScene scene(GetParam(), kEarthGravity, hangingRope(kLinks, kLength, kNodeMass));
    scene.bullet().world().addRigidBody(&box);
    if (scene.bullet().isDeformable()) {
      scene.body().appendDeformableAnchor(kLinks, &box);
    } else {
      scene.body().appendAnchor(kLinks, &box, true);
    }
    scene.cloth().add<HookeSprings>(springs(kStiffness));
    settle(scene, kSubstep, 6);

    // 5 %: Bullet's anchors are soft constraints of their own.
    expectHangingChain(scene, kStiffness, 0.05, load);
    EXPECT_NEAR(box.getWorldTransform().getOrigin().y(), scene.node(kLinks).m_x.y(), 0.01);
    const double height = box.getWorldTransform().getOrigin().y();
    settle(scene, kSubstep, 0.5);
    EXPECT_NEAR(box.getWorldTransform().getOrigin().y(), height, 1e-3);
    scene.bullet().world().removeRigidBody(&box);
  }
}

// --- Bullet without it
// ------------------------------------------------------------------------------------------------

TEST_IN_POSITION_BASED_WORLDS(BulletsOwnLinks, DoNotStretchMoreWhenTheClothIsWet) {
  const auto sag = [](double saturation) {
    ClothScene scene(GetParam(), kEarthGravity, hangingRope(kLinks, kLength, kNodeMass));
    scene.cloth().setSaturation(saturation);
    settle(scene, kSubstep);
    return -double(scene.node(kLinks).m_x.y()) - kLinks * kLength;
  };
  // They sag a little, by an amount that comes from the number of iterations. By Hooke the wet one would be 84 % more.
  EXPECT_NEAR(sag(1), sag(0), 0.01 * std::fabs(sag(0)) + 1e-6);
}

TEST_IN_DEFORMABLE_WORLDS(BulletsOwnSprings, InTheDeformableWorldFollowTheSameClosedForm) {
  for (double saturation : {0.0, 1.0}) {
    ClothScene scene(GetParam(), kEarthGravity, hangingRope(kLinks, kLength, kNodeMass));
    scene.addBulletSprings(kStiffness, 0.01);
    scene.cloth().setSaturation(saturation);
    settle(scene, kSubstep);
    expectHangingChain(scene, kStiffness, 0.05);
  }
}

}  // namespace
}  // namespace wetcloth_test::hooke_springs_statics_test
