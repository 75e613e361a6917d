// SPDX-License-Identifier: Zlib
// A cloth that shrinks moves: in every world, with Bullet's links or springs and with HookeSprings.

#include "bullet_wetcloth/effects/Swelling.h"
#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/ClothScene.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Measures.h"
#include "tests/support/SoftBodies.h"

#include <cmath>

namespace wetcloth_test::swelling_motion_test {
namespace {

using wetcloth::HookeSprings;
using wetcloth::Swelling;

/// A free strip of 1 m x 0.2 m, 11 x 3 nodes.
wetcloth::ClothPatch strip() {
  wetcloth::ClothPatch patch;
  patch.columns = 11;
  patch.rows = 3;
  patch.edgeV = btVector3(0, 0, btScalar(0.2));
  return patch;
}

void settle(ClothScene& scene, double seconds) {
  for (int i = 0; i < seconds / kSubstep; ++i) {
    scene.step(1);
    damp(scene.body(), 0.03);
  }
}

double length(ClothScene& scene) { return double((scene.node(10).m_x - scene.node(0).m_x).length()); }
double width(ClothScene& scene) { return double((scene.node(22).m_x - scene.node(0).m_x).length()); }

enum class HeldBy { bullet, hookeSprings };

using SwellingMotion = testing::TestWithParam<std::tuple<WorldKind, HeldBy>>;

// All links get shorter alike, so the shape stays and no tension is left. After 3 s what is left of the motion is
// 0.97^720 = 3e-10; iterated links approach their lengths to 1e-5 in that time. The
// position-based worlds take velocities from changes of place, which float32 rounds 720 times.
TEST_P(SwellingMotion, AFreeStripChangesItsLengthAndComesBack) {
  const auto [kind, heldBy] = GetParam();
  for (double strain : {-0.05, 0.05}) {
    ClothScene scene(kind, kNoGravity, strip());
    if (heldBy == HeldBy::bullet) {
      scene.addBulletSprings(10, 0.01);
    } else {
      HookeSprings::Parameters springs;
      springs.stiffness = springs.bendingStiffness = 20;
      scene.cloth().add<HookeSprings>(springs);
    }
    scene.cloth().add<Swelling>({strain});
    scene.step(2);
    const auto centre = centreOfMass(scene.body());
    scene.cloth().setSaturation(1);
    settle(scene, 3);
    EXPECT_NEAR(length(scene), 1 + strain, 1e-4) << strain;
    EXPECT_NEAR(width(scene), 0.2 * (1 + strain), 1e-4) << strain;
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(centreOfMass(scene.body())[k], centre[k], kIsDouble ? 1e-6 : 2e-4) << k;
    scene.cloth().setSaturation(0);
    settle(scene, 3);
    EXPECT_NEAR(length(scene), 1, 1e-4) << strain;
    EXPECT_NEAR(width(scene), 0.2, 1e-4) << strain;
  }
}

// Pinned at both ends a strip that shrinks cannot, and is taut: let go, it moves to the other end.
TEST_P(SwellingMotion, AStripThatIsPinnedAtBothEndsBecomesTaut) {
  const WorldKind kind = std::get<0>(GetParam());
  const HeldBy heldBy = std::get<1>(GetParam());
  const auto displacement = [&](double strain) {
    wetcloth::ClothPatch patch = strip();
    patch.pinnedEdges = {wetcloth::ClothPatch::Edge::left, wetcloth::ClothPatch::Edge::right};
    ClothScene scene(kind, kNoGravity, patch);
    if (heldBy == HeldBy::bullet) {
      scene.addBulletSprings(10, 0.01);
    } else {
      scene.cloth().add<HookeSprings>();
    }
    scene.cloth().add<Swelling>({strain});
    scene.cloth().setSaturation(1);
    settle(scene, 1);
    for (int j = 0; j < 3; ++j) scene.node(patch.node(10, j)).m_im = 1 / btScalar(0.01);
    scene.cloth().setSaturation(1);
    settle(scene, 3);
    return double(scene.node(10).m_x.x()) - 1;
  };
  EXPECT_NEAR(displacement(0), 0, 1e-5);
  // The left edge stays pinned at its natural width, 5 % too wide for its neighbourhood: a few of the ten columns get
  // their length only in part.
  EXPECT_NEAR(displacement(-0.05), -0.05, 0.005);
}

INSTANTIATE_TEST_SUITE_P(, SwellingMotion,
                         testing::Combine(testing::Values(WorldKind::softRigid, WorldKind::softMultiBody,
                                                          WorldKind::deformable, WorldKind::deformableImplicit),
                                          testing::Values(HeldBy::bullet, HeldBy::hookeSprings)),
                         [](const auto& test) {
                           return std::string(nameOf(std::get<0>(test.param))) +
                                  (std::get<1>(test.param) == HeldBy::bullet ? "_bullet" : "_hookeSprings");
                         });

// A chain of equal springs between two pins that shrinks by e pulls with K l0 e. The end node is made heavy and let go:
// in its first steps it gathers speed as that force says.
TEST_IN_EVERY_WORLD(SwellingTension, OfAChainBetweenPinsIsItsStiffnessTimesTheShrinkage) {
  constexpr int kLinks = 5;
  constexpr double kStiffness = 50;
  constexpr double kMass = 1;
  ClothScene scene(GetParam(), kNoGravity, hangingRope(kLinks, 0.1, 0.01));
  scene.node(kLinks).m_im = 0;
  HookeSprings::Parameters springs;
  springs.stiffness = kStiffness;
  scene.cloth().add<HookeSprings>(springs);
  scene.cloth().add<Swelling>({-0.04});
  scene.cloth().setSaturation(1);
  settle(scene, 2);
  EXPECT_NEAR(double(scene.node(kLinks).m_x.y()), -0.5, 1e-6);
  // What is set is the dry mass, to which the water comes.
  scene.node(kLinks).m_im = btScalar((1 + scene.cloth().fabric().capacity) / kMass);
  scene.cloth().setSaturation(1);
  const double dt = kSubstep;
  scene.step(12);
  // In a twentieth of a second it moves 0.25 mm, by which the last link, stretched by 4 mm, gives way at most: 6 % in
  // the end, 2 % in the mean. float32 adds 1.4e-5 m/s to the 0.01 m/s in each step, up or down.
  const double force = double(scene.node(kLinks).m_v.y()) * kMass / (12 * dt);
  EXPECT_NEAR(force / (kStiffness * 0.1 * 0.04), 1, 0.025);
}

}  // namespace
}  // namespace wetcloth_test::swelling_motion_test
