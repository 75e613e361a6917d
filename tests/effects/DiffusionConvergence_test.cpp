// SPDX-License-Identifier: Zlib
// Diffusion: order in the spacing on good and bad meshes, in the step when D depends on the saturation, and that the
// three methods and mirrored meshes agree.

#include "tests/support/BulletWorld.h"
#include "tests/support/ClothScene.h"
#include "tests/support/Patches.h"
#include "tests/support/TransportScene.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace wetcloth_test::diffusion_convergence_test {

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

// What the two stages make of a mode that decays at 1 / s in one step.
double decayOfAStep(double dt) {
  const double gamma = 1 + std::sqrt(0.5);
  const double smoothed = 1 / (1 + gamma * dt);
  return ((1 - gamma) * smoothed + 2 * gamma - 1) * smoothed / gamma;
}

// Of a mode cos(pi x) cos(pi y) in a closed square, beside the step's own error; root of the mean square.
double errorOf(const Mesh& mesh) {
  const double dt = 0.02;
  const int steps = 5;
  TransportScene scene(mesh);
  scene.wet([](double x, double y) { return 0.5 + 0.4 * std::cos(kPi * x) * std::cos(kPi * y); });
  scene.cloth().add<Diffusion>(with(1));
  scene.run(steps, dt);
  const double decay = std::pow(decayOfAStep(2 * kPi * kPi * dt), steps);
  double sum = 0;
  double mass = 0;
  for (int i = 0; i < scene.count(); ++i) {
    const double exact = 0.5 + 0.4 * decay * std::cos(kPi * scene.x(i)) * std::cos(kPi * scene.y(i));
    sum += scene.cloth().dryMass(i) * (scene.s(i) - exact) * (scene.s(i) - exact);
    mass += scene.cloth().dryMass(i);
  }
  return std::sqrt(sum / mass);
}

// Each triangle reaches two columns further in the next row: angles of up to 153 degrees, all over.
Mesh obtuse(int n, double jitter) {
  Mesh mesh = grid(n, n, 1, 1, jitter, 5);
  mesh.faces.clear();
  for (int j = 0; j + 1 < n; ++j) {
    const int below = j * n;
    const int above = below + n;
    for (int i = 0; i + 3 < n; ++i) {
      mesh.faces.push_back({below + i, below + i + 1, above + i + 3});
      mesh.faces.push_back({below + i, above + i + 3, above + i + 2});
    }
    for (int i = 0; i < 2; ++i) {
      mesh.faces.push_back({below, above + i + 1, above + i});
      mesh.faces.push_back({below + n - 3 + i, below + n - 2 + i, above + n - 1});
    }
  }
  return mesh;
}

void expectSecondOrder(const std::function<Mesh(int)>& meshOf, const char* name) {
  const double coarse = errorOf(meshOf(9));
  const double medium = errorOf(meshOf(17));
  const double fine = errorOf(meshOf(33));
  // 4 in the limit.
  EXPECT_GT(coarse / medium, 3.5) << name;
  EXPECT_GT(medium / fine, 3.5) << name;
  EXPECT_LT(fine, 1e-3) << name;
}

TEST(DiffusionConvergence, IsOfSecondOrderInTheSpacing) {
  expectSecondOrder([](int n) { return grid(n, n, 1, 1); }, "grid");
  expectSecondOrder([](int n) { return grid(n, n, 1, 1, 0.33, 5); }, "irregular");
  expectSecondOrder([](int n) { return obtuse(n, 0); }, "obtuse");
  expectSecondOrder([](int n) { return obtuse(n, 0.2); }, "obtuse and irregular");
}

std::vector<double> saturationsAfter(const Mesh& mesh, const Diffusion::Parameters& parameters, int steps, double dt) {
  TransportScene scene(mesh);
  scene.wet([](double x, double y) { return 0.5 + 0.4 * std::cos(kPi * x) * std::cos(kPi * y); });
  scene.cloth().add<Diffusion>(parameters);
  scene.run(steps, dt);
  std::vector<double> saturations;
  for (int i = 0; i < scene.count(); ++i) saturations.push_back(scene.s(i));
  return saturations;
}

double largestDifference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::fabs(a[i] - b[i]));
  return largest;
}

TEST(DiffusionConvergence, IsOfSecondOrderInTheStepWithAnyExponent) {
  for (const double exponent : {0.0, 1.0, 2.0, 2.5}) {
    const Mesh mesh = grid(13, 13, 1, 1, 0.2, 5);
    // The steeper Phi, the shorter the step from which on its order shows.
    const double dt = exponent == 0 ? 1e-3 : 3.2e-5;
    const int steps = static_cast<int>(std::lround(0.04 / dt));
    const auto coarse = saturationsAfter(mesh, with(1, exponent), steps, dt);
    const auto medium = saturationsAfter(mesh, with(1, exponent), 2 * steps, dt / 2);
    const auto fine = saturationsAfter(mesh, with(1, exponent), 4 * steps, dt / 4);
    EXPECT_NEAR(largestDifference(coarse, medium) / largestDifference(medium, fine), 4, 0.6) << exponent;
  }
}

// Steps that jitter by a sixth, under one factor.
TEST(DiffusionConvergence, IsOfSecondOrderWithAFactorOfALongerStep) {
  const Mesh mesh = grid(13, 13, 1, 1, 0.2, 5);
  const auto jittered = [&](int pairs) {
    TransportScene scene(mesh);
    scene.wet([](double x, double y) { return 0.5 + 0.4 * std::cos(kPi * x) * std::cos(kPi * y); });
    Diffusion& diffusion = scene.cloth().add<Diffusion>(with(1));
    for (int n = 0; n < pairs; ++n) {
      scene.preTick(0.04 / pairs * 6 / 11);
      scene.preTick(0.04 / pairs * 5 / 11);
    }
    EXPECT_EQ(diffusion.factorizations(), 1);
    std::vector<double> saturations;
    for (int i = 0; i < scene.count(); ++i) saturations.push_back(scene.s(i));
    return saturations;
  };
  const auto coarse = jittered(20);
  const auto medium = jittered(40);
  EXPECT_NEAR(largestDifference(coarse, medium) / largestDifference(medium, jittered(80)), 4, 0.3);
}

TEST(DiffusionConvergence, TheThreeMethodsAgree) {
  for (const double exponent : {0.0, 2.0}) {
    const Mesh mesh = grid(13, 13, 1, 1, 0.3, 5);
    const auto factored = saturationsAfter(mesh, with(0.01, exponent), 40, 0.05);
    const auto iterative = saturationsAfter(mesh, with(0.01, exponent, Method::conjugateGradients), 40, 0.05);
    // 40 steps, each with a residual of 1e-8.
    EXPECT_LT(largestDifference(factored, iterative), 4e-7) << exponent;
    const auto explicitly = saturationsAfter(mesh, with(0.01, exponent, Method::explicitSubsteps), 40, 0.05);
    // Both are of first order: dt / 2 of the second derivative in time, from either side.
    EXPECT_LT(largestDifference(factored, explicitly), 5e-3) << exponent;
    EXPECT_GT(largestDifference(factored, explicitly), 1e-6) << exponent;
  }
}

TEST(DiffusionConvergence, AMirroredClothIsWetTheSameWay) {
  const auto saturations = [](bool isMirrored) {
    Mesh mesh = grid(9, 9, 1, 1, 0.33, 5);
    for (btVector3& p : mesh.points) p.setX(isMirrored ? -p.x() : p.x());
    Diffusion::Parameters parameters = with(2e-3, 1);
    parameters.weftDiffusivity = 1e-3;
    parameters.warp = btVector3(isMirrored ? -1 : 1, 1, 0);
    TransportScene scene(mesh);
    scene.wetAtRandom(8);
    scene.cloth().add<Diffusion>(parameters);
    scene.run(50, 0.1);
    std::vector<double> result;
    for (int i = 0; i < scene.count(); ++i) result.push_back(scene.s(i));
    return result;
  };
  EXPECT_LT(largestDifference(saturations(false), saturations(true)), 1e-13) << "rounding of the solver's sums";
}

// In the plane y = 0, bent into an arch after it was made: what counts is the fabric.
TEST(DiffusionConvergence, ABentClothWicksLikeAFlatOne) {
  const auto saturations = [](bool isBent) {
    ClothScene scene(WorldKind::softRigid, btVector3(0, 0, 0), levelPatch(9, 1), wetcloth::Fabric::cotton(),
                     wetcloth::Hook::manual);
    std::vector<double> held(81, 0);
    held[30] = scene.cloth().capacity(30);
    scene.cloth().setHeld(held);
    for (int i = 0; isBent && i < 81; ++i) {
      const btScalar x = scene.node(i).m_x.x();
      scene.node(i).m_x = btVector3(std::sin(3 * x) / 3, std::cos(3 * x) / 3, scene.node(i).m_x.z());
    }
    scene.cloth().add<Diffusion>(with(1e-3));
    for (int n = 0; n < 20; ++n) scene.preTick(0.5);
    std::vector<double> result;
    for (int i = 0; i < 81; ++i) result.push_back(scene.cloth().saturation(i));
    return result;
  };
  EXPECT_LT(largestDifference(saturations(false), saturations(true)), 1e-15);
}

}  // namespace
}  // namespace wetcloth_test::diffusion_convergence_test
