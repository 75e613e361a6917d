// SPDX-License-Identifier: Zlib
// Cloths of any kind are thrown at each other and at themselves; pins stand still. Numbers are those of scenes in which
// something went wrong once.
#include "tests/solver/GuardScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace wetcloth_test::cloth_guard_tangles_test {
namespace {

BodyBuilder shuffledSheet(int n, double side, const btVector3& place, std::mt19937& random) {
  const Triangles mesh = Triangles::of(levelSheet(n, side, place));
  return mesh.shuffled(random).builder();
}

class Tangle {
 public:
  explicit Tangle(unsigned number, bool isGuarded = true) : m_number(number), m_random(number) {
    Guard guard;
    guard.thickness = between(0, 1) < 0.3 ? 0 : between(0, 0.004);
    guard.every = int(between(1, 12));
    guard.friction = between(0, 1);
    const btVector3 gravity = between(0, 1) < 0.5 ? kEarthGravity : kNoGravity;
    const bool hasFloor = between(0, 1) < 0.5;
    m_speed = std::pow(10, between(-0.5, 1.8));
    scene = std::make_unique<GuardScene>(isGuarded ? std::optional<Guard>(guard) : std::nullopt, WorldKind::softRigid,
                                         gravity);
    if (hasFloor) scene->addFloor();
    const int count = int(between(1, 4));
    for (int k = 0; k < count; ++k) addCloth(k);
  }
  std::unique_ptr<GuardScene> scene;

 private:
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(m_random); }
  btSoftBody& add(int kind, int n, double side, const btVector3& place) {
    if (kind == 0) return scene->add(wavySheet(n, side, place));
    if (kind == 1) return scene->add(levelSheet(n, side, place));
    return scene->add(shuffledSheet(n, side, place, m_random));
  }
  void addCloth(int k) {
    const int n = int(between(5, 13));
    const double side = between(0.2, 0.8);
    const double z = between(-0.1, 0.1) + 0.08 * k;
    const double y = 0.05 + 0.1 * k * between(0.4, 1.5);
    const btVector3 place(btScalar(between(-0.1, 0.1)), btScalar(y), btScalar(z));
    btSoftBody& body = add(int(between(0, 3)), n, side, place);
    if (between(0, 1) < 0.3) body.m_nodes[int(between(0, n))].m_im = 0;
    for (int i = 0; i < body.m_nodes.size(); ++i) {
      if (body.m_nodes[i].m_im > 0) body.m_nodes[i].m_v = velocityAt(body.m_nodes[i].m_x - place, k == 0);
    }
  }
  // Each comes together towards its middle, and all but the first one fly downwards.
  btVector3 velocityAt(const btVector3& x, bool isFirst) const {
    const double wave = std::sin(5 * double(x.x()) + m_number) + std::cos(7 * double(x.z()));
    const btVector3 v(btScalar(-0.5 * wave), btScalar(isFirst ? 0 : -0.5 - 0.3 * wave),
                      btScalar(0.4 * std::sin(9 * double(x.x()))));
    return (v - x * 2) * btScalar(m_speed);
  }
  unsigned m_number;
  std::mt19937 m_random;
  double m_speed = 0;
};

class ClothGuardTangles : public testing::TestWithParam<unsigned> {};
INSTANTIATE_TEST_SUITE_P(, ClothGuardTangles,
                         testing::Values(30u, 34u, 36u, 37u, 48u, 64u, 66u, 72u, 73u, 127u, 129u, 134u));

TEST_P(ClothGuardTangles, PassThroughNothing) {
  Tangle tangle(GetParam());
  GuardScene& scene = *tangle.scene;
  ASSERT_EQ(scene.watch().meetings(), 0);
  scene.step(40);
  const wetcloth::ClothSolver::GuardTotals totals = scene.totals();
  EXPECT_EQ(scene.passages(), 0);
  EXPECT_EQ(totals.forced, 0) << "no pin moves";
  EXPECT_EQ(totals.meeting, 0);
  EXPECT_EQ(totals.halts, 0);
}

TEST(ClothGuardTangle, WithoutGuardPassesThroughItself) {
  Tangle tangle(2, false);
  tangle.scene->watch();
  tangle.scene->step(40);
  EXPECT_GT(tangle.scene->passages(), 10);
}

}  // namespace
}  // namespace wetcloth_test::cloth_guard_tangles_test
