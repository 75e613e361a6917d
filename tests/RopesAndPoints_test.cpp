// SPDX-License-Identifier: Zlib
// Bodies that are no cloth: a rope has links and no faces, a cloud of points has neither. Effects that need faces or
// links say so; the others work.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BodyState.h"
#include "tests/support/CallEffect.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Materials.h"

#include <BulletSoftBody/btSoftBodyHelpers.h>

namespace wetcloth_test::ropes_and_points_test {

namespace {

// 1 m long, 11 nodes of 1 kg, its first one fixed.
std::unique_ptr<btSoftBody> rope(btSoftBodyWorldInfo& info) {
  return std::unique_ptr<btSoftBody>(
      btSoftBodyHelpers::CreateRope(info, btVector3(0, 0, 0), btVector3(0, -1, 0), 9, 1));
}

std::unique_ptr<btSoftBody> points(btSoftBodyWorldInfo& info) {
  const btVector3 positions[3] = {btVector3(0, 0, 0), btVector3(1, 0, 0), btVector3(0, 0, 1)};
  const btScalar masses[3] = {1, 2, 0};
  return std::make_unique<btSoftBody>(&info, 3, positions, masses);
}

template <class E>
std::string messageOfAdding(wetcloth::WetCloth& cloth, typename E::Parameters parameters = {}) {
  try {
    cloth.add<E>(parameters);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST_IN_EVERY_WORLD(RopesAndPoints, ARopeAbsorbs) {
  BodyScene scene(GetParam(), rope);
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = wet.add(scene.body(), fabricOf(1, 1));
  EXPECT_NEAR(cloth.dryMass(0), 1, 1e-6) << "the fixed node weighs what the others do";
  cloth.add<wetcloth::Absorption>();
  scene.bullet().step(240);
  EXPECT_NEAR(cloth.meanSaturation(), 1 - std::exp(-1), 1e-5);
  EXPECT_NEAR(1 / double(scene.body().m_nodes[5].m_im), 1 + cloth.held(5), 1e-6);
  EXPECT_EQ(scene.body().m_nodes[0].m_im, 0);
  EXPECT_TRUE(isFinite(scene.body()));
}

TEST_IN_EVERY_WORLD(RopesAndPoints, WindSaysThatARopeHasNoFaces) {
  BodyScene scene(GetParam(), rope);
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = wet.add(scene.body());
  EXPECT_NE(messageOfAdding<wetcloth::Wind>(cloth).find("face"), std::string::npos)
      << messageOfAdding<wetcloth::Wind>(cloth);
  EXPECT_TRUE(cloth.effects().empty());
  scene.bullet().step(3);
}

// A heavy end on springs: extension m g / k, each spring carries what hangs below it.
TEST_IN_EVERY_WORLD(RopesAndPoints, SpringsWorkOnARope) {
  constexpr double k = 5000;
  BodyScene scene(GetParam(), rope);
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = wet.add(scene.body(), fabricOf(1, 1));
  cloth.add<wetcloth::HookeSprings>(springsOf(k));
  addCall(cloth, [](wetcloth::WetCloth& wetCloth, const wetcloth::Step& step) {  // comes to rest
    for (int i = 0; i < wetCloth.nodeCount(); ++i) {
      wetCloth.push(wetCloth.body().m_nodes[i], wetCloth.body().m_nodes[i].m_v * btScalar(-8 * step.dt));
    }
  });
  scene.bullet().step(2400);
  // 10 springs carry 10, 9, ... 1 kg.
  const double expected = 1 + 55 * 9.81 / k;
  EXPECT_NEAR(-double(scene.body().m_nodes[10].m_x.y()), expected, 0.05 * (expected - 1));
}

TEST_IN_EVERY_WORLD(RopesAndPoints, SpringsSayThatPointsHaveNoLinks) {
  BodyScene scene(GetParam(), points);
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = wet.add(scene.body());
  EXPECT_NE(messageOfAdding<wetcloth::HookeSprings>(cloth).find("link"), std::string::npos)
      << messageOfAdding<wetcloth::HookeSprings>(cloth);
  EXPECT_NE(messageOfAdding<wetcloth::Wind>(cloth).find("face"), std::string::npos);
  EXPECT_TRUE(cloth.effects().empty());
  cloth.add<wetcloth::Absorption>();
  scene.bullet().step(10);
  EXPECT_GT(cloth.meanSaturation(), 0);
}

// The springs take the place of the links' own pull; removing them gives it back.
TEST_IN_EVERY_WORLD(RopesAndPoints, RemovedSpringsGiveTheLinksBack) {
  BodyScene scene(GetParam(), rope);
  std::vector<const btSoftBody::Material*> materials;
  for (int i = 0; i < scene.body().m_links.size(); ++i) materials.push_back(scene.body().m_links[i].m_material);
  std::vector<btScalar> stiffness;
  for (const btSoftBody::Material* material : materials) stiffness.push_back(material->m_kLST);
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = wet.add(scene.body());
  wetcloth::HookeSprings& springs = cloth.add<wetcloth::HookeSprings>(springsOf(1000));
  scene.bullet().step(5);
  cloth.remove(springs);
  for (int i = 0; i < scene.body().m_links.size(); ++i) {
    const btSoftBody::Link& link = scene.body().m_links[i];
    EXPECT_EQ(link.m_material, materials[std::size_t(i)]);
    EXPECT_EQ(link.m_material->m_kLST, stiffness[std::size_t(i)]);
    EXPECT_NEAR(link.m_c0, (link.m_n[0]->m_im + link.m_n[1]->m_im) / link.m_material->m_kLST, 1e-6);
  }
}

}  // namespace
}  // namespace wetcloth_test::ropes_and_points_test
