// SPDX-License-Identifier: Zlib
// Cloth that an application puts through cloth is told, in that step and once.
#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/solver/TangledCloths.h"

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

namespace wetcloth_test::guard_teleports_test {
namespace {

// A level sheet that is pinned all around, and an upright one above it, which does not fall.
struct Sheets {
  explicit Sheets(std::optional<Guard> guard = Guard(), bool isPinned = false)
      : scene(guard, WorldKind::softRigid, btVector3(0, 0, 0)) {
    wetcloth::ClothPatch patch = levelSheet(9, 0.5, btVector3(0, 0, 0));
    using Edge = wetcloth::ClothPatch::Edge;
    patch.pinnedEdges = {Edge::left, Edge::right, Edge::bottom, Edge::top};
    level = &scene.add(patch);
    patch = squarePatch(6);
    patch.origin = btVector3(btScalar(-0.1), btScalar(0.05), btScalar(0.013));
    patch.edgeU = btVector3(btScalar(0.2), 0, btScalar(0.01));
    patch.edgeV = btVector3(0, btScalar(0.2), 0);
    for (int k = 0; isPinned && k < patch.nodeCount(); ++k) patch.pinnedNodes.push_back(k);
    upright = &scene.add(patch);
  }
  void moveBy(double x, double y) const {
    for (int k = 0; k < upright->m_nodes.size(); ++k) {
      upright->m_nodes[k].m_x += btVector3(btScalar(x), btScalar(y), 0);
    }
  }
  int crossings() const { return countCrossings({level, upright}); }
  std::size_t told() { return scene.scene().messages().size(); }

  GuardScene scene;
  btSoftBody* level = nullptr;
  btSoftBody* upright = nullptr;
};

TEST(GuardTeleports, OfFreeNodesThroughALayerAreToldInThatStepAndOnce) {
  Sheets sheets;
  sheets.scene.step(5);
  ASSERT_EQ(sheets.told(), 0u);
  sheets.moveBy(0, -0.12);
  const int crossings = sheets.crossings();
  ASSERT_GT(crossings, 5);
  sheets.scene.step(1);
  ASSERT_EQ(sheets.told(), 1u);
  const std::string& message = sheets.scene.scene().messages().front();
  EXPECT_NE(message.find(std::to_string(crossings) + " pairs"), std::string::npos) << message;
  EXPECT_NE(message.find("0, 1"), std::string::npos) << message;
  EXPECT_EQ(sheets.scene.totals().crossing, crossings);
  sheets.scene.solver().resetGuardTotals();
  sheets.scene.step(30);
  EXPECT_EQ(sheets.told(), 1u);
  EXPECT_EQ(sheets.scene.totals().crossing, 0) << "none is counted where nothing was moved";
}

TEST(GuardTeleports, AreToldEachTime) {
  Sheets sheets;
  sheets.scene.step(2);
  for (int k = 0; k < 3; ++k) {
    sheets.moveBy(0, -0.12);
    sheets.scene.step(2);
    sheets.moveBy(0, 0.12);
    sheets.scene.step(2);
  }
  EXPECT_EQ(sheets.told(), 6u) << "that they cross, and that they do no more";
}

TEST(GuardTeleports, OfASingleNodeAreTold) {
  Sheets sheets;
  sheets.scene.step(3);
  sheets.upright->m_nodes[2].m_x.setY(btScalar(-0.03));
  sheets.scene.step(1);
  EXPECT_EQ(sheets.told(), 1u);
}

TEST(GuardTeleports, FarAwayIntoAnotherClothAreTold) {
  Sheets sheets;
  sheets.moveBy(2000, 0);
  sheets.scene.step(5);
  sheets.moveBy(-2000, -0.12);
  sheets.scene.step(1);
  EXPECT_EQ(sheets.told(), 1u);
  EXPECT_GT(sheets.scene.totals().crossing, 5);
}

TEST(GuardTeleports, ToWhereNothingCrossesAreNotTold) {
  Sheets sheets;
  sheets.scene.step(3);
  sheets.moveBy(0.01, 0.03);
  sheets.scene.step(3);
  sheets.moveBy(50, 0);
  sheets.scene.step(3);
  EXPECT_EQ(sheets.told(), 0u);
  EXPECT_EQ(sheets.scene.totals().crossing, 0);
}

// Gravity takes it far: the arrays get another origin on the way.
TEST(GuardTeleports, AreNoneWhereCrossingClothsFall) {
  GuardScene scene;
  const auto cloths = addCornerThroughSheet(scene, 0.05, false);
  scene.step(120);
  EXPECT_LT(double(cloths.first->m_nodes[0].m_x.y()), -10);
  EXPECT_EQ(scene.scene().messages().size(), 1u) << "when they were new";
}

TEST(GuardTeleports, OfPinsThroughAClothAreToldInThatStep) {
  Sheets sheets(Guard(), true);
  for (int k = 0; k < sheets.level->m_nodes.size(); ++k) sheets.level->setMass(k, 0);
  sheets.scene.step(3);
  sheets.moveBy(0, -0.12);
  sheets.scene.step(1);
  EXPECT_EQ(sheets.told(), 1u);
  EXPECT_GT(sheets.scene.totals().forced, 0);
  EXPECT_GT(sheets.scene.totals().crossing, 5);
  sheets.scene.step(10);
  EXPECT_EQ(sheets.told(), 1u);
}

TEST(GuardTeleports, WhileTheGuardWasOffAreTold) {
  Sheets sheets;
  sheets.scene.step(2);
  sheets.scene.solver().setParameters(guardedBy(std::nullopt));
  sheets.upright->setVelocity(btVector3(0, -1, 0));
  sheets.scene.step(8);
  sheets.upright->setVelocity(btVector3(0, 0, 0));
  ASSERT_GT(sheets.crossings(), 0);
  ASSERT_EQ(sheets.told(), 0u);
  sheets.scene.solver().setParameters(guardedBy(Guard()));
  sheets.scene.step(3);
  EXPECT_EQ(sheets.told(), 1u);
}

TEST(GuardTeleports, WhileBulletHadTheBodyAreTold) {
  Sheets sheets;
  sheets.scene.step(2);
  sheets.upright->m_cfg.kDG = btScalar(0.01);
  ASSERT_NE(sheets.scene.solver().reasonNotTaken(*sheets.upright), "");
  sheets.upright->setVelocity(btVector3(0, -1, 0));
  sheets.scene.step(8);
  ASSERT_GT(sheets.crossings(), 0);
  sheets.upright->m_cfg.kDG = 0;
  sheets.upright->setVelocity(btVector3(0, 0, 0));
  sheets.scene.step(3);
  EXPECT_EQ(sheets.told(), 1u);
}

TEST(GuardTeleports, ByARestoredStateAreTold) {
  Sheets sheets;
  wetcloth::WetClothWorld wet(sheets.scene.scene().bullet().world());
  sheets.scene.step(2);
  sheets.moveBy(0, -0.12);
  sheets.scene.step(2);
  std::ostringstream saved;
  wet.save(saved);
  sheets.moveBy(0, 1);
  sheets.scene.step(2);
  const std::size_t told = sheets.told();
  std::istringstream stream(saved.str());
  wet.restore(stream);
  sheets.scene.step(3);
  EXPECT_EQ(sheets.told(), told + 1);
}

// The choice holds for what was put so, too.
TEST(GuardTeleports, AreUntangledByChoice) {
  Sheets sheets(untangling());
  sheets.scene.step(2);
  sheets.moveBy(0, -0.08);
  ASSERT_GT(sheets.crossings(), 5);
  sheets.scene.step(240);
  EXPECT_EQ(sheets.crossings(), 0);
  EXPECT_EQ(sheets.told(), 2u);
}

}  // namespace
}  // namespace wetcloth_test::guard_teleports_test
