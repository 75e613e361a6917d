// SPDX-License-Identifier: Zlib
// A body may be cut or refined while it is wet: no water is lost, one message says so, and the world goes on.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/CallEffect.h"
#include "tests/support/Materials.h"
#include "tests/support/Patches.h"

#include <gtest/gtest.h>

namespace wetcloth_test::cut_and_refine_test {

namespace {

// The plane x = 0.37.
class Plane : public btSoftBody::ImplicitFn {
 public:
  btScalar Eval(const btVector3& x) override { return x.x() - btScalar(0.37); }
};

void cutOneLink(btSoftBody& body) {
  ASSERT_TRUE(body.cutLink(body.m_faces[0].m_n[0], body.m_faces[0].m_n[1], btScalar(0.5)));
}
void refine(btSoftBody& body) {
  Plane plane;
  body.refine(&plane, btScalar(0.001), false);
}
void cutAlongAPlane(btSoftBody& body) {
  Plane plane;
  body.refine(&plane, btScalar(0.001), true);
}

struct Knife {
  const char* name;
  void (*cut)(btSoftBody&);
};

std::ostream& operator<<(std::ostream& out, const Knife& knife) { return out << knife.name; }

using CutAndRefine = testing::TestWithParam<std::tuple<WorldKind, Knife>>;

TEST_P(CutAndRefine, KeepsTheWater) {
  const auto [kind, knife] = GetParam();
  BodyScene scene(kind, hangingPatch(6));
  scene.addBulletSprings(20, 0.1, SpringDamping::everyDirection);
  wetcloth::WetClothWorld wet(scene.world());
  std::vector<std::string> messages;
  wet.setLog([&messages](const std::string& message) { messages.push_back(message); });
  wetcloth::WetCloth& cloth = wet.add(scene.body(), fabricOf(2, 1));
  wetcloth::Absorption& soak = cloth.add<wetcloth::Absorption>(
      {[](const btVector3& x, const btVector3&) { return double(x.x()) < 0.5 ? 1.0 : 0.25; }});
  cloth.add<wetcloth::Wind>({btVector3(0, 0, 1)});
  scene.bullet().step(30);
  adjust(soak, [](auto& p) { p.exposure = 0.0; });
  const wetcloth::Ledger before = cloth.ledger();
  const int nodes = scene.body().m_nodes.size();
  ASSERT_GT(before.held, 0);

  knife.cut(scene.body());
  ASSERT_GT(scene.body().m_nodes.size(), nodes) << "the knife cuts";
  scene.bullet().step(1);

  EXPECT_EQ(cloth.nodeCount(), scene.body().m_nodes.size());
  const wetcloth::Ledger after = cloth.ledger();
  double held = 0;
  for (int i = 0; i < cloth.nodeCount(); ++i) held += cloth.held(i);
  EXPECT_NEAR(after.held, before.held, 1e-12 * before.held);
  EXPECT_NEAR(held, before.held, 1e-12 * before.held);
  EXPECT_LE(std::fabs(after.imbalance()), 1e-12 * before.held);
  EXPECT_EQ(messages.size(), 1u) << (messages.empty() ? "" : messages.back());

  adjust(soak, [](auto& p) { p.exposure = 1.0; });
  scene.bullet().step(60);
  EXPECT_TRUE(isFinite(scene.body()));
  EXPECT_EQ(messages.size(), 1u) << "said once: " << messages.back();
  EXPECT_GT(cloth.ledger().held, before.held) << "it goes on soaking";
  for (int i = 0; i < cloth.nodeCount(); ++i) {
    EXPECT_TRUE(std::isfinite(cloth.held(i)) && cloth.held(i) >= 0) << i;
    EXPECT_TRUE(std::isfinite(cloth.dryMass(i)) && cloth.dryMass(i) > 0) << i;
  }
}

// Masses are Bullet's to share; nothing is over-full afterwards, and what was evenly wet stays so.
TEST_P(CutAndRefine, OverfillsNoNode) {
  const auto [kind, knife] = GetParam();
  for (const double capacity : {0.84, 83.0}) {
    for (const int pattern : {0, 1, 2}) {
      BodyScene scene(kind, squarePatch(6));
      wetcloth::WetClothWorld wet(scene.world(), wetcloth::Hook::manual);
      wet.setLog({});
      wetcloth::WetCloth& cloth = wet.add(scene.body(), fabricOf(capacity, 1));
      std::vector<double> held;
      for (int i = 0; i < 36; ++i) {
        held.push_back(cloth.capacity(i) * (pattern == 0 ? 1 : pattern == 1 ? 0.5 : (i % 3) / 2.0));
      }
      cloth.setHeld(held);
      const double water = cloth.ledger().held;
      knife.cut(scene.body());
      const bool isShared = scene.body().m_nodes[36].m_im != 1;  // not cutLink(), which makes nodes of 1 kg
      addCall(cloth, [](wetcloth::WetCloth&, const wetcloth::Step&) {});
      wet.preTick(btScalar(0.01));
      ASSERT_GT(cloth.nodeCount(), 36);
      EXPECT_NEAR(cloth.ledger().held, water, 1e-12 * water);
      for (int i = 0; i < cloth.nodeCount(); ++i) {
        EXPECT_LE(cloth.saturation(i), 1 + 1e-5) << i;  // Bullet rounds the masses that it shares out
        if (pattern == 1 && isShared) {
          EXPECT_NEAR(cloth.saturation(i), 0.5, 1e-4) << i;
        }
      }
    }
  }
}

// With every effect, springs too, and per-link or per-node parameters that fit no more.
TEST_P(CutAndRefine, EveryEffectGoesOnOrSaysWhyNot) {
  const auto [kind, knife] = GetParam();
  BodyScene scene(kind, hangingPatch(6));
  wetcloth::WetClothWorld wet(scene.world());
  std::vector<std::string> messages;
  wet.setLog([&messages](const std::string& message) { messages.push_back(message); });
  wetcloth::WetCloth& cloth = wet.add(scene.body());
  cloth.add<wetcloth::Absorption>({std::vector<double>(std::size_t(cloth.nodeCount()), 0.5)});
  cloth.add<wetcloth::Wind>({btVector3(0, 0, 1)});
  cloth.add<wetcloth::HookeSprings>(springsOf(200, 5));
  scene.bullet().step(30);
  knife.cut(scene.body());
  scene.bullet().step(60);
  EXPECT_TRUE(isFinite(scene.body()));
  EXPECT_GE(messages.size(), 1u);
  EXPECT_LE(messages.size(), 4u) << "the cut, and at most one per effect that had to go";
}

// Springs with one value per link no longer fit after a cut. Whatever becomes of the effect, each link is pulled by
// something: by the effect, or, once it is gone, by its own stiffness again.
TEST_P(CutAndRefine, NoLinkIsLeftWithoutStrength) {
  const auto [kind, knife] = GetParam();
  BodyScene scene(kind, hangingPatch(6));
  wetcloth::WetClothWorld wet(scene.world());
  wet.setLog({});
  wetcloth::WetCloth& cloth = wet.add(scene.body());
  wetcloth::HookeSprings::Parameters springs;
  springs.perLink.assign(std::size_t(scene.body().m_links.size()), 200);
  wetcloth::HookeSprings& added = cloth.add<wetcloth::HookeSprings>(springs);
  scene.bullet().step(3);
  knife.cut(scene.body());
  scene.bullet().step(3);
  EXPECT_TRUE(isFinite(scene.body()));
  if (!cloth.effects().empty()) cloth.remove(added);
  for (int i = 0; i < scene.body().m_links.size(); ++i) {
    EXPECT_GE(scene.body().m_links[i].m_material->m_kLST, btScalar(0.5)) << "link " << i;
  }
}

// What Bullet itself does: cutLink() gives each new node 1 kg, whatever the cloth weighs.
TEST(CutLink, InPlainBulletMakesNodesOfOneKilogram) {
  BodyScene scene(WorldKind::softRigid, hangingPatch(6));
  const int nodes = scene.body().m_nodes.size();
  cutOneLink(scene.body());
  ASSERT_EQ(scene.body().m_nodes.size(), nodes + 2);
  EXPECT_EQ(scene.body().getMass(nodes), 1);
}

// A refined node shares the mass of its neighbours, so it is as wet as they are: evenly wet stays evenly wet.
class SharedMass : public CutAndRefine {};  // cutLink does not share: its nodes of 1 kg are dry

TEST_P(SharedMass, RefiningAnEvenlyWetClothLeavesItEvenlyWet) {
  const auto [kind, knife] = GetParam();
  wetcloth::ClothPatch patch = squarePatch(6);
  BodyScene scene(kind, patch);
  wetcloth::WetClothWorld wet(scene.world());
  wet.setLog({});
  wetcloth::WetCloth& cloth = wet.add(scene.body(), fabricOf(1, 1));
  cloth.setSaturation(0.5);
  const double mass = cloth.totalMass();
  knife.cut(scene.body());
  scene.bullet().step(1);
  // Bullet's masses round.
  EXPECT_NEAR(cloth.totalMass(), mass, 1e-5 * mass);
  for (int i = 0; i < cloth.nodeCount(); ++i) EXPECT_NEAR(cloth.saturation(i), 0.5, 1e-4) << i;
}

const auto kEveryWorld = testing::Values(WorldKind::softRigid, WorldKind::softMultiBody, WorldKind::deformable,
                                         WorldKind::deformableImplicit);
const auto nameOfCase = [](const auto& test) {
  return std::string(nameOf(std::get<0>(test.param))) + "_" + std::get<1>(test.param).name;
};

INSTANTIATE_TEST_SUITE_P(, CutAndRefine,
                         testing::Combine(kEveryWorld,
                                          testing::Values(Knife{"cutLink", cutOneLink}, Knife{"refine", refine},
                                                          Knife{"cutPlane", cutAlongAPlane})),
                         nameOfCase);
INSTANTIATE_TEST_SUITE_P(, SharedMass,
                         testing::Combine(kEveryWorld,
                                          testing::Values(Knife{"refine", refine}, Knife{"cutPlane", cutAlongAPlane})),
                         nameOfCase);

}  // namespace
}  // namespace wetcloth_test::cut_and_refine_test
