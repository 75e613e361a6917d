// SPDX-License-Identifier: Zlib
// The order of links decides how fast Bullet's position solve runs, and the order of links that share a node decides
// its result. btSoftBodyHelpers can reorder them; for a body that is not ours that is the application's choice, so
// nothing here may do it.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/InEveryWorld.h"

#include <BulletSoftBody/btSoftBodyHelpers.h>

namespace wetcloth_test::link_order_test {

namespace {

std::unique_ptr<btSoftBody> bulletPatch(btSoftBodyWorldInfo& info) {
  return std::unique_ptr<btSoftBody>(btSoftBodyHelpers::CreatePatch(
      info, btVector3(0, 0, 0), btVector3(1, 0, 0), btVector3(0, 0, 1), btVector3(1, 0, 1), 8, 8, 3, true));
}

std::vector<std::pair<int, int>> orderOf(const btSoftBody& body) {
  std::vector<std::pair<int, int>> order;
  for (int i = 0; i < body.m_links.size(); ++i) {
    order.emplace_back(int(body.m_links[i].m_n[0] - &body.m_nodes[0]), int(body.m_links[i].m_n[1] - &body.m_nodes[0]));
  }
  return order;
}

// The fact: another order, the same result, since links that share a node keep theirs.
TEST(LinkOrder, InPlainBulletReoptimizingKeepsTheResult) {
  BodyScene one(WorldKind::softRigid, bulletPatch);
  BodyScene other(WorldKind::softRigid, bulletPatch);
  btSoftBodyHelpers::ReoptimizeLinkOrder(&other.body());
  EXPECT_NE(orderOf(one.body()), orderOf(other.body()));
  one.bullet().step(60);
  other.bullet().step(60);
  EXPECT_TRUE(sameBits(stateOf(one.body()), stateOf(other.body())));
}

// The fact: any other order gives another result, so reordering a foreign body would not go unnoticed.
TEST(LinkOrder, InPlainBulletReversingChangesTheResult) {
  BodyScene one(WorldKind::softRigid, bulletPatch);
  BodyScene other(WorldKind::softRigid, bulletPatch);
  btSoftBody::tLinkArray& links = other.body().m_links;
  for (int i = 0, j = links.size() - 1; i < j; ++i, --j) links.swap(i, j);
  one.bullet().step(60);
  other.bullet().step(60);
  EXPECT_GT(largestDifference(stateOf(one.body()), stateOf(other.body())), 1e-4);
}

TEST_IN_EVERY_WORLD(LinkOrderIsKept, OfABodyThatIsNotOurs) {
  BodyScene scene(GetParam(), bulletPatch);
  const auto before = orderOf(scene.body());
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = wet.add(scene.body());
  cloth.add<wetcloth::Absorption>();
  cloth.add<wetcloth::Wind>({btVector3(1, 2, 3)});
  cloth.add<wetcloth::HookeSprings>();
  scene.bullet().step(10);
  EXPECT_EQ(orderOf(scene.body()), before);
  wet.remove(scene.body());
  EXPECT_EQ(orderOf(scene.body()), before);
}

}  // namespace
}  // namespace wetcloth_test::link_order_test
