// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/solver/SolverScene.h"
#include "tests/support/BodyState.h"
#include "tests/support/ExactPace.h"
#include "tests/support/RigidBody.h"

#include <gtest/gtest.h>

#include <memory>
#include <sstream>
#include <string>

namespace wetcloth_test::solver_state_test {
namespace {

// A wet cloth that swings into a box and pulls at another, far from the origin, and a body that is left to Bullet.
struct Scene {
  explicit Scene(WorldKind kind, double away)
      : bullets(kind), box1(bullets.bullet(), box(0.2, 0.2, 0.2), 0, btVector3(btScalar(away), btScalar(-0.5), 0)) {
    wetcloth::ClothPatch patch = levelPatch(8, 1);
    patch.origin.setX(btScalar(away));
    patch.pinnedEdges = {wetcloth::ClothPatch::Edge::left};
    cloth = &bullets.add(patch);
    cloth->getCollisionShape()->setMargin(btScalar(0.02));
    left = &bullets.add(hangingPatch(4));
    left->m_cfg.kDG = btScalar(0.1);
    hook = std::make_unique<RigidBody>(bullets.bullet(), box(0.05, 0.05, 0.05), btScalar(0.1), cloth->m_nodes[7].m_x);
    cloth->appendAnchor(7, &hook->body(), true);
    wet = std::make_unique<wetcloth::WetClothWorld>(bullets.bullet().world());
    wet->setLog({});
    wetcloth::WetCloth& towel = wet->add(*cloth);
    towel.add<wetcloth::Absorption>();
    towel.add<wetcloth::Wind>();
    towel.add<wetcloth::WetStiffness>();
  }

  std::string state() const {
    std::ostringstream stream;
    wet->save(stream);
    return stream.str();
  }
  std::vector<btScalar> places() const {
    std::vector<btScalar> all = stateOf(*cloth);
    const std::vector<btScalar> more = stateOf(*left);
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  SolverScene bullets;
  RigidBody box1;
  std::unique_ptr<RigidBody> hook;
  btSoftBody* cloth = nullptr;
  btSoftBody* left = nullptr;
  std::unique_ptr<wetcloth::WetClothWorld> wet;
};

TEST(SolverState, ARestoredRunGoesOnBitForBit) {
  for (const double away : {0.0, 3000.0}) {
    Scene first(WorldKind::softRigid, away);
    first.bullets.step(40);
    const std::string saved = first.state();
    first.bullets.step(40);
    Scene second(WorldKind::softRigid, away);
    std::istringstream stream(saved);
    second.wet->restore(stream);
    EXPECT_EQ(second.state(), saved);
    second.bullets.step(40);
    EXPECT_TRUE(sameBits(first.places(), second.places())) << away;
    EXPECT_EQ(first.state(), second.state()) << away;
  }
}

TEST(SolverState, AStateOfAnotherSolverIsRefused) {
  Scene first(WorldKind::softRigid, 0);
  first.bullets.step(3);
  BulletWorld plain(WorldKind::softRigid);
  wetcloth::WetClothWorld wet(plain.world());
  std::istringstream stream(first.state());
  EXPECT_THROW(wet.restore(stream), wetcloth::StateError);
}

}  // namespace
}  // namespace wetcloth_test::solver_state_test
