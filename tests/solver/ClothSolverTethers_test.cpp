// SPDX-License-Identifier: Zlib
// Tethers: what is pinned holds what hangs from it, however few the small steps are.
#include "bullet_wetcloth/solver/ClothSolver.h"

#include "tests/solver/SolverScene.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace wetcloth_test::cloth_solver_tethers_test {
namespace {

// Largest distance of a node from the pinned row above it, over what the cloth has at rest.
double reach(const btSoftBody& body, int n) {
  double longest = 0;
  for (int k = 0; k < n; ++k) {
    const btVector3 away = body.m_nodes[k].m_x - body.m_nodes[n * (n - 1) + k].m_x;
    longest = std::max(longest, double(away.length()));
  }
  return longest;
}

TEST(ClothSolverTethers, HoldAFineClothAtFewSmallSteps) {
  constexpr int kSide = 24;
  const auto reachWith = [](int tethers, double scale) {
    wetcloth::ClothSolver::Parameters parameters = smallSteps(2);
    parameters.tethers = tethers;
    parameters.tetherScale = scale;
    SolverScene scene(WorldKind::softRigid, kEarthGravity, parameters);
    btSoftBody& body = scene.add(hangingPatch(kSide));
    scene.step(60);
    return reach(body, kSide);
  };
  EXPECT_GT(reachWith(0, 1), 1.03);
  EXPECT_LT(reachWith(1, 1), 1 + 1e-5);
  EXPECT_LT(reachWith(1, 1.02), 1.02 + 1e-4);
  EXPECT_GT(reachWith(1, 1.02), 1.01);
}

TEST(ClothSolverTethers, FollowWhatIsPinned) {
  wetcloth::ClothSolver::Parameters parameters = smallSteps(4);
  parameters.tethers = 2;
  SolverScene scene(WorldKind::softRigid, kEarthGravity, parameters);
  btSoftBody& body = scene.add(hangingPatch(8));
  scene.step(5);
  for (int k = 0; k < body.m_nodes.size(); ++k) body.m_nodes[k].m_im = 100;  // all free: it falls
  scene.step(60);
  EXPECT_LT(double(body.m_nodes[63].m_x.y()), -3);
}

}  // namespace
}  // namespace wetcloth_test::cloth_solver_tethers_test
