// SPDX-License-Identifier: Zlib
// What Diffusion refuses, how much work it does, and a body that changes while it runs.

#include "tests/support/BulletWorld.h"
#include "tests/support/ClothScene.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Patches.h"
#include "tests/support/Rejection.h"
#include "tests/support/SoftBodies.h"
#include "tests/support/TransportScene.h"

#include <algorithm>
#include <limits>

namespace wetcloth_test::diffusion_upkeep_test {

using namespace transport;

namespace {

using wetcloth::Diffusion;
using Method = Diffusion::Method;

Diffusion::Parameters with(double diffusivity, double exponent = 0, Method method = Method::factored) {
  Diffusion::Parameters parameters;
  parameters.warpDiffusivity = parameters.weftDiffusivity = diffusivity;
  parameters.exponent = exponent;
  parameters.method = method;
  return parameters;
}

TEST(DiffusionUpkeep, RefusesBadParametersByName) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  TransportScene scene(grid(3, 3, 1, 1));
  const auto textOf = [&](auto change) {
    Diffusion::Parameters parameters;
    change(parameters);
    return rejection([&] { scene.cloth().add<Diffusion>(parameters); });
  };
  for (const double bad : {0.0, -1.0, nan, inf}) {
    EXPECT_EQ(textOf([&](auto& p) { p.warpDiffusivity = bad; }).rfind("Diffusion.warpDiffusivity = ", 0), 0u) << bad;
    EXPECT_EQ(textOf([&](auto& p) { p.weftDiffusivity = bad; }).rfind("Diffusion.weftDiffusivity = ", 0), 0u) << bad;
  }
  for (const double bad : {-0.1, 101.0, nan, inf}) {
    EXPECT_EQ(textOf([&](auto& p) { p.exponent = bad; }).rfind("Diffusion.exponent = ", 0), 0u) << bad;
  }
  for (const double bad : {-0.1, 0.0, 1.0, nan, inf}) {
    EXPECT_EQ(textOf([&](auto& p) { p.tolerance = bad; }).rfind("Diffusion.tolerance = ", 0), 0u) << bad;
  }
  EXPECT_EQ(textOf([&](auto& p) { p.warp.setY(btScalar(nan)); }).rfind("Diffusion.warp.y = ", 0), 0u);
  EXPECT_EQ(textOf([](auto& p) { p.warp = btVector3(0, 0, 0); }), "Diffusion.warp: must not be of length 0");
  EXPECT_EQ(textOf([](auto& p) { p.exponent = -1; }), "Diffusion.exponent = -1: must be in [0, 100]");
  EXPECT_TRUE(scene.cloth().effects().empty());
}

TEST(DiffusionUpkeep, ARopeHasNoTrianglesToSpreadOver) {
  ClothScene scene(WorldKind::softRigid, btVector3(0, 0, 0), hangingRope(5, 0.1, 0.01));
  EXPECT_EQ(rejection([&] { scene.cloth().add<Diffusion>(); }),
            "Diffusion: body.m_faces.size() = 0: must be at least 1: it works on triangles, and a rope has none");
}

TEST(DiffusionUpkeep, FactorsOnceAndThenSolvesTwicePerStep) {
  TransportScene scene(grid(9, 9, 1, 1));
  scene.wetAtRandom(2);
  Diffusion& diffusion = scene.cloth().add<Diffusion>(with(1e-4));
  EXPECT_EQ(diffusion.factorizations(), 0) << "not before it is asked to";
  scene.run(100, 0.01);
  EXPECT_EQ(diffusion.factorizations(), 1);
  EXPECT_EQ(diffusion.solves(), 200);
  EXPECT_EQ(diffusion.nodesVisited(), 8100);
  scene.run(1, 0.1);
  EXPECT_EQ(diffusion.factorizations(), 2);
}

// The application makes a node heavier, so that it holds more: the next commit takes that over.
TEST(DiffusionUpkeep, FactorsAnewWhenCapacitiesChanged) {
  TransportScene scene(grid(9, 9, 1, 1));
  scene.wetAtRandom(2);
  Diffusion& diffusion = scene.cloth().add<Diffusion>(with(1e-4));
  scene.run(5, 0.01);
  scene.node(40).m_im /= 2;
  scene.run(5, 0.01);
  EXPECT_EQ(diffusion.factorizations(), 2);
  EXPECT_EQ(diffusion.solves(), 20);
}

TEST(DiffusionUpkeep, OtherMethodsFactorNothing) {
  for (const Method method : {Method::conjugateGradients, Method::explicitSubsteps}) {
    TransportScene scene(grid(9, 9, 1, 1));
    scene.wetAtRandom(2);
    Diffusion& diffusion = scene.cloth().add<Diffusion>(with(1, 0, method));
    scene.run(3, 0.1);
    EXPECT_EQ(diffusion.factorizations(), 0);
    // The corner with one triangle holds h^2 / 6 and conducts 1: 0.1 s are 38.4 of its steps.
    EXPECT_EQ(diffusion.substeps(), method == Method::explicitSubsteps ? 3 * 39 : 0);
    EXPECT_EQ(diffusion.iterations() > 0, method == Method::conjugateGradients);
  }
}

TEST(DiffusionUpkeep, IdlesWhenEvenAndGoesOnWhenWetted) {
  for (const Method method : {Method::factored, Method::conjugateGradients, Method::explicitSubsteps}) {
    TransportScene scene(grid(4, 4, 0.1, 0.1));
    scene.wetAtRandom(2);
    Diffusion& diffusion = scene.cloth().add<Diffusion>(with(1e-2, 0, method));
    scene.run(400, 0.01);
    const long long visited = diffusion.nodesVisited();
    const unsigned long long revision = scene.cloth().water().revision();
    EXPECT_LT(visited, 400 * 16);
    scene.run(100, 0.01);
    EXPECT_EQ(diffusion.nodesVisited(), visited);
    EXPECT_EQ(scene.cloth().water().revision(), revision);
    std::vector<double> held(16, 0.0);
    held[3] = scene.cloth().capacity(3);
    scene.cloth().setHeld(held);
    scene.run(1, 0.01);
    EXPECT_EQ(diffusion.nodesVisited(), visited + 16);
    EXPECT_GT(scene.s(2), 0);
  }
}

// A short step moves less than what counts as nothing, and the water must spread all the same.
TEST(DiffusionUpkeep, DoesNotIdleBecauseTheStepIsShort) {
  TransportScene scene(grid(5, 5, 1, 1));
  scene.wet([](double x, double) { return x < 0.5 ? 1 : 0; });
  Diffusion& diffusion = scene.cloth().add<Diffusion>(with(1e-5));
  scene.run(1000, 1e-5);
  EXPECT_EQ(diffusion.nodesVisited(), 25000);
  EXPECT_GT(scene.s(2), 0);
}

TEST(DiffusionUpkeep, ADryClothMovesNothingAndItsMassesAreNotTouched) {
  TransportScene scene(grid(5, 5, 1, 1));
  Diffusion& diffusion = scene.cloth().add<Diffusion>();
  const long long commits = scene.cloth().masses().commits();
  scene.run(200, 0.01);
  EXPECT_EQ(scene.cloth().masses().commits(), commits);
  EXPECT_LE(diffusion.nodesVisited(), 65 * 25);
}

class Plane : public btSoftBody::ImplicitFn {
 public:
  btScalar Eval(const btVector3& x) override { return x.x() - btScalar(0.07); }
};

TEST_IN_EVERY_WORLD(DiffusionInWorld, GoesOnAfterACut) {
  wetcloth::ClothPatch patch = levelPatch(6, 1);
  ClothScene scene(GetParam(), btVector3(0, 0, 0), patch);
  scene.wet().setLog([](const std::string&) {});
  scene.addBulletSpringsForStep();
  std::vector<double> held(36, 0.0);
  held[14] = scene.cloth().capacity(14);
  scene.cloth().setHeld(held);
  Diffusion::Parameters parameters = with(1e-2);
  parameters.weftDiffusivity = 1e-3;
  scene.cloth().add<Diffusion>(parameters);
  scene.step(20);
  Plane plane;
  scene.body().refine(&plane, btScalar(0.001), true);
  ASSERT_GT(scene.body().m_nodes.size(), 36);
  scene.step(1);
  // Bullet rounds the masses that it shares out: a node that the cut made may be over-full by as much.
  const auto highest = [&] {
    double value = 1;
    for (int i = 0; i < scene.cloth().nodeCount(); ++i) value = std::max(value, scene.cloth().saturation(i));
    return value;
  };
  const double before = highest();
  scene.step(60);
  EXPECT_LE(highest(), before);
  ASSERT_EQ(scene.cloth().effects().size(), 1u);
  const wetcloth::Ledger ledger = scene.cloth().ledger();
  EXPECT_NEAR(ledger.held, held[14], 1e-12 * held[14]);
  for (int i = 0; i < scene.cloth().nodeCount(); ++i) {
    EXPECT_GE(scene.cloth().held(i), 0) << i;
    EXPECT_TRUE(std::isfinite(scene.node(i).m_x.length2())) << i;
  }
}

// The squares of the first and the last length are no float any more.
TEST(DiffusionWarp, IsOfAnyLength) {
  for (const double length : {1e-30, 1.0, 1e25}) {
    TransportScene scene(grid(6, 6, 0.1, 0.1));
    Diffusion::Parameters parameters;
    parameters.warpDiffusivity = 1e-4;
    parameters.weftDiffusivity = 1e-9;
    parameters.exponent = 0;
    parameters.warp = btVector3(btScalar(length), 0, 0);
    scene.cloth().add<Diffusion>(parameters);
    scene.wet([](double x, double y) { return x == 0 && y == 0 ? 1 : 0; });
    scene.run(10, 1);
    EXPECT_GT(scene.s(1), 100 * scene.s(6)) << length;
  }
}

}  // namespace
}  // namespace wetcloth_test::diffusion_upkeep_test
