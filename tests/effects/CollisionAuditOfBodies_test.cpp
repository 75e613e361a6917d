// SPDX-License-Identifier: Zlib
// The audit of whole cloths: between bodies, without a trace on their motion, and through all that may happen to a body
// while it runs.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Patches.h"

#include <LinearMath/btIDebugDraw.h>

#include <string>

namespace wetcloth_test::collision_audit_of_bodies_test {

namespace {

using wetcloth::CollisionAudit;
using wetcloth::Passage;

/// Two level sheets of n x n nodes without gravity, the upper one coming down through the lower. Nothing collides.
class TwoSheets {
 public:
  TwoSheets(WorldKind kind, int n, bool springs = true)
      : lower(kind, squarePatch(n), btVector3(0, 0, 0)), m_upper(upperPatch(n).build(lower.bullet().info())) {
    lower.bullet().add(*m_upper);
    for (btSoftBody* body : {&lower.body(), m_upper.get()}) {
      body->m_cfg.collisions = 0;
      body->setActivationState(DISABLE_DEACTIVATION);
    }
    if (springs) lower.addBulletSprings(20, 0);
    for (int i = 0; i < m_upper->m_nodes.size(); ++i) {
      m_upper->m_nodes[i].m_v = btVector3(0, -2, 0);
      m_upper->m_nodes[i].m_vn = btVector3(0, -2, 0);
    }
  }
  ~TwoSheets() {
    if (m_upper) lower.bullet().remove(*m_upper);
  }

  btSoftBody& upper() { return *m_upper; }
  void deleteUpper() {
    lower.bullet().remove(*m_upper);
    m_upper.reset();
  }
  void step(int count) { lower.bullet().step(count, btScalar(1) / 256); }

  BodyScene lower;

 private:
  static wetcloth::ClothPatch upperPatch(int n) {
    wetcloth::ClothPatch patch = squarePatch(n);
    patch.origin = btVector3(btScalar(0.013), btScalar(0.1), btScalar(0.017));
    return patch;
  }

  std::unique_ptr<btSoftBody> m_upper;
};

// 3 x 3 nodes, the upper sheet moved by a little along x and z. A vertex of each goes through the other where it lies
// over it: (n - 1)^2 = 4 of the upper sheet's, whose last row and column are outside, and 4 of the lower sheet's, whose
// first row and column are. Of the edges seen from above see crossings().
TEST_IN_EVERY_WORLD(AuditOfBodies, SheetThroughSheetInClosedForm) {
  TwoSheets sheets(GetParam(), 3);
  wetcloth::WetClothWorld wet(sheets.lower.world());
  CollisionAudit& audit = wet.add(sheets.lower.body()).add<CollisionAudit>();
  sheets.step(30);
  audit.look();
  EXPECT_EQ(audit.totals().vertexFace, 4 + 4);
  EXPECT_GT(audit.totals().edgeEdge, 0);
  for (const Passage& passage : audit.passages()) EXPECT_NE(passage.first, passage.second);
}

// Whichever cloth has the audit, and if both have one, each passage is counted once.
TEST_IN_EVERY_WORLD(AuditOfBodies, EachPairOnceWhateverTheOrder) {
  std::vector<long long> counted;
  for (const int audited : {1, 2, 3}) {
    for (const bool upperFirst : {false, true}) {
      TwoSheets sheets(GetParam(), 4);
      wetcloth::WetClothWorld wet(sheets.lower.world());
      btSoftBody* bodies[2] = {upperFirst ? &sheets.upper() : &sheets.lower.body(),
                               upperFirst ? &sheets.lower.body() : &sheets.upper()};
      std::vector<CollisionAudit*> audits;
      for (btSoftBody* body : bodies) {
        wetcloth::WetCloth& cloth = wet.add(body);
        cloth.add<wetcloth::Wind>({btVector3(0, 0, 0)});
        const bool isUpper = body == &sheets.upper();
        if ((audited & (isUpper ? 2 : 1)) != 0) audits.push_back(&cloth.add<CollisionAudit>());
      }
      sheets.step(40);
      counted.push_back(0);
      for (CollisionAudit* audit : audits) {
        audit->look();
        counted.back() += audit->totals().passages();
      }
    }
  }
  EXPECT_GT(counted.front(), 20);
  for (const long long count : counted) EXPECT_EQ(count, counted.front());
}

TEST_IN_EVERY_WORLD(AuditOfBodies, OthersCanBeTurnedOff) {
  TwoSheets sheets(GetParam(), 3);
  wetcloth::WetClothWorld wet(sheets.lower.world());
  CollisionAudit::Parameters parameters;
  parameters.others = false;
  CollisionAudit& audit = wet.add(sheets.lower.body()).add<CollisionAudit>(parameters);
  sheets.step(30);
  audit.look();
  EXPECT_EQ(audit.totals().passages(), 0);
}

// A cloth that crumples: the same motion bit for bit with an audit and without.
std::vector<btScalar> crumple(WorldKind kind, bool audited, long long* candidates = nullptr) {
  BodyScene scene(kind, hangingPatch(12));
  scene.addBulletSprings(20, 0.05, SpringDamping::everyDirection);
  scene.body().m_cfg.collisions |= btSoftBody::fCollision::VF_SS | btSoftBody::fCollision::SDF_RD;
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = wet.add(scene.body());
  cloth.add<wetcloth::Wind>({[](const btVector3& x, double t) {
    return btVector3(btScalar(3 * std::sin(9 * t + 8 * double(x.y()))), 0, btScalar(5 * std::cos(7 * t)));
  }});
  CollisionAudit* const audit = audited ? &cloth.add<CollisionAudit>() : nullptr;
  for (int step = 0; step < 200; ++step) {
    scene.bullet().step(1);
    if (audit && step % 50 == 0) audit->look();
  }
  if (audit && candidates) *candidates = audit->totals().candidatePairs;
  return stateOf(scene.body());
}

TEST_IN_EVERY_WORLD(AuditOfBodies, ChangesNothing) {
  long long candidates = 0;
  EXPECT_TRUE(sameBits(crumple(GetParam(), false), crumple(GetParam(), true, &candidates)));
  EXPECT_GT(candidates, 1000);
}

TEST_IN_EVERY_WORLD(AuditOfBodies, DoesNotWakeASleepingCloth) {
  BodyScene scene(GetParam(), squarePatch(4), btVector3(0, 0, 0));
  wetcloth::WetClothWorld wet(scene.world());
  CollisionAudit& audit = wet.add(scene.body()).add<CollisionAudit>();
  scene.body().setActivationState(ISLAND_SLEEPING);
  scene.bullet().step(4);
  EXPECT_EQ(scene.body().getActivationState(), ISLAND_SLEEPING);
  EXPECT_EQ(audit.totals().substeps, 3) << "it looks all the same";
}

TEST_IN_EVERY_WORLD(AuditOfBodies, GoesOnAfterACut) {
  TwoSheets sheets(GetParam(), 5);
  wetcloth::WetClothWorld wet(sheets.lower.world());
  wet.setLog({});
  CollisionAudit& audit = wet.add(sheets.lower.body()).add<CollisionAudit>();
  sheets.step(4);
  for (btSoftBody* body : {&sheets.lower.body(), &sheets.upper()}) {
    ASSERT_TRUE(body->cutLink(body->m_faces[0].m_n[0], body->m_faces[0].m_n[1], btScalar(0.5)));
    sheets.step(2);
  }
  EXPECT_EQ(audit.totals().passages(), 0);
  sheets.step(30);
  audit.look();
  EXPECT_GE(audit.totals().vertexFace, 16 + 16);
}

TEST_IN_EVERY_WORLD(AuditOfBodies, OtherBodiesMayComeAndGo) {
  TwoSheets sheets(GetParam(), 4);
  wetcloth::WetClothWorld wet(sheets.lower.world());
  CollisionAudit& audit = wet.add(sheets.lower.body()).add<CollisionAudit>();
  sheets.step(4);
  sheets.lower.bullet().remove(sheets.upper());
  sheets.step(4);
  sheets.upper().translate(btVector3(0, -1, 0));  // while it is away: no passage
  sheets.lower.bullet().add(sheets.upper());
  sheets.step(4);
  sheets.deleteUpper();
  sheets.step(4);
  audit.look();
  EXPECT_EQ(audit.totals().passages(), 0);
}

TEST_IN_EVERY_WORLD(AuditOfBodies, ItsOwnBodyMayLeaveAndComeBack) {
  TwoSheets sheets(GetParam(), 4);
  wetcloth::WetClothWorld wet(sheets.lower.world());
  wet.setLog({});
  CollisionAudit& audit = wet.add(sheets.lower.body()).add<CollisionAudit>();
  sheets.step(4);
  sheets.lower.bullet().remove(sheets.lower.body());
  sheets.step(40);  // the other sheet falls past the place
  sheets.lower.bullet().add(sheets.lower.body());
  sheets.step(4);
  audit.look();
  EXPECT_EQ(audit.totals().passages(), 0);
}

TEST_IN_EVERY_WORLD(AuditOfBodies, CanBeRemovedAndAddedAgain) {
  TwoSheets sheets(GetParam(), 4);
  wetcloth::WetClothWorld wet(sheets.lower.world());
  wetcloth::WetCloth& cloth = wet.add(sheets.lower.body());
  CollisionAudit& first = cloth.add<CollisionAudit>();
  sheets.step(4);
  cloth.remove(first);
  CollisionAudit& second = cloth.add<CollisionAudit>();
  sheets.step(40);
  second.look();
  EXPECT_GE(second.totals().vertexFace, 9 + 9);
}

// Everything is thrown about in the space of 10 sheets, so that nearly every two swept boxes overlap.
void explode(btSoftBody& body, int round) {
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    const auto anywhere = [&](int k) {
      return btScalar(std::fmod(7.3 * std::sin(12.9 * i + 78.2 * (k + 3 * round)), 10));
    };
    body.m_nodes[i].m_x = btVector3(anywhere(0), anywhere(1), anywhere(2));
  }
}

TEST_IN_EVERY_WORLD(AuditOfBodies, AnExplodedSheetIsLookedAtUpToTheLimitWhichIsSaidOnce) {
  for (const bool limited : {false, true}) {
    BodyScene scene(GetParam(), squarePatch(20), btVector3(0, 0, 0));
    wetcloth::WetClothWorld wet(scene.world());
    std::vector<std::string> said;
    wet.setLog([&said](const std::string& message) { said.push_back(message); });
    CollisionAudit::Parameters parameters;
    parameters.mostPairsPerFace = limited ? 20 : 1000000;
    CollisionAudit& audit = wet.add(scene.body()).add<CollisionAudit>(parameters);
    scene.bullet().step(1);
    audit.look();
    EXPECT_EQ(audit.totals().incompleteSubsteps, 0);
    const long long before = audit.totals().candidatePairs;
    const int rounds = limited ? 3 : 1;
    for (int round = 1; round <= rounds; ++round) {
      explode(scene.body(), round);
      audit.look();
    }
    const long long perFace = (audit.totals().candidatePairs - before) / (rounds * scene.body().m_faces.size());
    EXPECT_EQ(audit.totals().incompleteSubsteps, limited ? 3 : 0);
    EXPECT_EQ(said.size(), limited ? 1u : 0u);
    EXPECT_GE(perFace, limited ? 20 : 500);
    EXPECT_LE(perFace, limited ? 30 : 5000) << "it stops after the patch that reached the limit";
  }
}

TEST(CollisionAuditLimit, HasToBePositive) {
  CollisionAudit::Parameters parameters;
  parameters.mostPairsPerFace = 0;
  EXPECT_THROW(CollisionAudit{parameters}, std::invalid_argument);
}

class Lines : public btIDebugDraw {
 public:
  int count = 0;
  void drawLine(const btVector3&, const btVector3&, const btVector3&) override { ++count; }
  void drawContactPoint(const btVector3&, const btVector3&, btScalar, int, const btVector3&) override {}
  void reportErrorWarning(const char*) override {}
  void draw3dText(const btVector3&, const char*) override {}
  void setDebugMode(int) override {}
  int getDebugMode() const override { return 0; }
};

// A cross has three lines; a face three, two edges two.
TEST_IN_EVERY_WORLD(AuditOfBodies, DrawsThePassagesOfTheLastSubstep) {
  TwoSheets sheets(GetParam(), 3);
  wetcloth::WetClothWorld wet(sheets.lower.world());
  CollisionAudit& audit = wet.add(sheets.lower.body()).add<CollisionAudit>();
  int drawn = 0;
  for (int step = 0; step < 30; ++step) {
    const wetcloth::AuditTotals before = audit.totals();
    sheets.step(1);
    audit.look();
    const wetcloth::AuditTotals after = audit.totals();
    Lines lines;
    audit.draw(lines);
    EXPECT_EQ(lines.count, 6 * (after.vertexFace - before.vertexFace) + 5 * (after.edgeEdge - before.edgeEdge));
    drawn += lines.count;
  }
  EXPECT_GT(drawn, 0);
}

TEST_IN_EVERY_WORLD(AuditOfBodies, ARopeHasNothingToLookAt) {
  BodyScene scene(GetParam(), [](btSoftBodyWorldInfo& info) {
    return std::unique_ptr<btSoftBody>(
        btSoftBodyHelpers::CreateRope(info, btVector3(0, 0, 0), btVector3(1, 0, 0), 5, 1));
  });
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = wet.add(scene.body());
  EXPECT_THROW(cloth.add<CollisionAudit>(), std::invalid_argument);
  EXPECT_TRUE(cloth.effects().empty());
}

TEST(CollisionAuditTier, ExactIsRefusedWhereItIsNotBuilt) {
  CollisionAudit::Parameters parameters;
  parameters.tier = wetcloth::collision::Tier::exact;
  if (wetcloth::collision::ContinuousCheck::hasExact()) {
    EXPECT_NO_THROW(CollisionAudit{parameters});
  } else {
    EXPECT_THROW(CollisionAudit{parameters}, std::invalid_argument);
  }
}

}  // namespace
}  // namespace wetcloth_test::collision_audit_of_bodies_test
