// SPDX-License-Identifier: Zlib
// btSoftBody::generateBendingConstraints(2) links every pair of nodes two edges apart, nearly twice the paper's
// springs, and indexes an n x n array with int, which overflows from 46,341 nodes on.

#include "tests/support/BulletWorld.h"
#include "tests/support/Patches.h"

#include <gtest/gtest.h>

#include <BulletSoftBody/btSoftBodyHelpers.h>

#include <algorithm>
#include <limits>
#include <set>

namespace wetcloth_test::bending_constraints_test {

namespace {

// The fact.
TEST(BendingConstraints, InPlainBulletThereAreTooMany) {
  BulletWorld bullet(WorldKind::softRigid);
  std::unique_ptr<btSoftBody> body(btSoftBodyHelpers::CreatePatch(
      bullet.info(), btVector3(0, 0, 0), btVector3(1, 0, 0), btVector3(0, 0, 1), btVector3(1, 0, 1), 32, 32, 0, true));
  body->generateBendingConstraints(2);
  EXPECT_EQ(body->m_links.size(), 10446);
}

TEST(BendingConstraints, OurPatchHasThePapersSprings) {
  BulletWorld bullet(WorldKind::softRigid);
  const std::unique_ptr<btSoftBody> body = squarePatch(32).build(bullet.info());
  EXPECT_EQ(body->m_links.size(), 5826);
}

// 220 x 220 = 48,400 nodes: their square is no int any more.
TEST(BendingConstraints, OurPatchIsRightAboveBulletsLimit) {
  constexpr int n = 220;
  static_assert(static_cast<long long>(n) * n * n * n > std::numeric_limits<int>::max(),
                "Bullet's index would overflow");
  BulletWorld bullet(WorldKind::softRigid);
  const std::unique_ptr<btSoftBody> body = squarePatch(n).build(bullet.info());
  const long long expected = 2LL * n * (n - 1) + 2LL * (n - 1) * (n - 1) + 2LL * n * (n - 2);
  EXPECT_EQ(body->m_links.size(), expected);
  std::set<std::pair<int, int>> pairs;
  for (int i = 0; i < body->m_links.size(); ++i) {
    const int a = int(body->m_links[i].m_n[0] - &body->m_nodes[0]);
    const int b = int(body->m_links[i].m_n[1] - &body->m_nodes[0]);
    ASSERT_TRUE(a >= 0 && a < n * n && b >= 0 && b < n * n && a != b) << i;
    const int columns = std::abs(a % n - b % n);
    const int rows = std::abs(a / n - b / n);
    ASSERT_TRUE((columns <= 1 && rows <= 1) || (columns == 2 && rows == 0) || (columns == 0 && rows == 2)) << i;
    pairs.insert({std::min(a, b), std::max(a, b)});
  }
  EXPECT_EQ(static_cast<long long>(pairs.size()), expected) << "a spring is there twice";
}

}  // namespace
}  // namespace wetcloth_test::bending_constraints_test
