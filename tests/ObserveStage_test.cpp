// SPDX-License-Identifier: Zlib
// Stage::observe: an observer sees how the last substep ended, before anything changes, and of a sleeping body too.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/CallEffect.h"
#include "tests/support/ExactPace.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Patches.h"

#include <stdexcept>
#include <string>
#include <vector>

namespace wetcloth_test::observe_stage_test {

namespace {

using wetcloth::Stage;
using Names = std::vector<std::string>;

void addRecorder(wetcloth::WetCloth& cloth, Stage stage, const std::string& name, Names& names) {
  addCall(
      cloth, [name, &names](wetcloth::WetCloth&, const wetcloth::Step&) { names.push_back(name); }, stage);
}

/// Two cloths in one world.
class TwoCloths {
 public:
  explicit TwoCloths(WorldKind kind)
      : m_scene(kind),
        m_other(squarePatch(3).build(m_scene.bullet().info())),
        wet(m_scene.world(), wetcloth::Hook::manual),
        first(exactly(wet.add(m_scene.body()))),
        second(addOther()) {}
  ~TwoCloths() { m_scene.bullet().remove(*m_other); }
  TwoCloths(const TwoCloths&) = delete;
  TwoCloths& operator=(const TwoCloths&) = delete;

 private:
  wetcloth::WetCloth& addOther() {
    m_scene.bullet().add(*m_other);
    return exactly(wet.add(*m_other));
  }

  BodyScene m_scene;
  std::unique_ptr<btSoftBody> m_other;

 public:
  wetcloth::WetClothWorld wet;
  wetcloth::WetCloth& first;
  wetcloth::WetCloth& second;
};

TEST_IN_EVERY_WORLD(ObserveStage, ComesBeforeAllOtherStagesOfAllCloths) {
  TwoCloths cloths(GetParam());
  Names names;
  addRecorder(cloths.first, Stage::elasticity, "first elasticity", names);
  addRecorder(cloths.first, Stage::sources, "first sources", names);
  addRecorder(cloths.second, Stage::sources, "second sources", names);
  addRecorder(cloths.second, Stage::observe, "second observes", names);
  addRecorder(cloths.first, Stage::observe, "first observes", names);
  cloths.wet.preTick(btScalar(0.01));
  EXPECT_EQ(names, (Names{"first observes", "second observes", "first sources", "first elasticity", "second sources"}));
}

TEST_IN_EVERY_WORLD(ObserveStage, SeesTheClothAsTheLastSubstepLeftIt) {
  BodyScene scene(GetParam());
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body()));
  cloth.add<wetcloth::Absorption>();
  cloth.add<wetcloth::Wind>({btVector3(9, 9, 9)});
  std::vector<btScalar> last = stateOf(scene.body());
  double held = 0;
  int looks = 0;
  addCall(
      cloth,
      [&](wetcloth::WetCloth& observed, const wetcloth::Step&) {
        EXPECT_EQ(stateOf(observed.body()), last);
        EXPECT_EQ(observed.ledger().held, held);
        ++looks;
      },
      Stage::observe);
  for (int i = 0; i < 5; ++i) {
    scene.bullet().step(1);
    last = stateOf(scene.body());
    held = cloth.ledger().held;
  }
  EXPECT_GT(held, 0);
  EXPECT_EQ(looks, 5);
}

TEST_IN_EVERY_WORLD(ObserveStage, SeesABodyThatWasCutAsItIsNow) {
  BodyScene scene(GetParam());
  wetcloth::WetClothWorld wet(scene.world(), wetcloth::Hook::manual);
  wet.setLog(nullptr);
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body()));
  std::size_t nodes = 0;
  addCall(
      cloth, [&](wetcloth::WetCloth& observed, const wetcloth::Step&) { nodes = observed.water().size(); },
      Stage::observe);
  scene.body().appendNode(btVector3(0, 0, 0), 1);
  wet.preTick(btScalar(0.01));
  EXPECT_EQ(nodes, static_cast<std::size_t>(scene.body().m_nodes.size()));
}

TEST_IN_EVERY_WORLD(ObserveStage, AnObserverThatThrowsIsRemoved) {
  BodyScene scene(GetParam());
  wetcloth::WetClothWorld wet(scene.world(), wetcloth::Hook::manual);
  Names messages;
  wet.setLog([&](const std::string& message) { messages.push_back(message); });
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body()));
  addCall(
      cloth, [](wetcloth::WetCloth&, const wetcloth::Step&) { throw std::runtime_error("seen enough"); },
      Stage::observe);
  wet.preTick(btScalar(0.01));
  EXPECT_TRUE(cloth.effects().empty());
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_NE(messages[0].find("seen enough"), std::string::npos);
}

// Only the deformable world lets a soft body sleep.
TEST(ObserveStageAsleep, RunsWhileForcesRest) {
  BodyScene scene(WorldKind::deformable);
  wetcloth::WetClothWorld wet(scene.world(), wetcloth::Hook::manual);
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body()));
  Names names;
  addRecorder(cloth, Stage::forces, "forces", names);
  addRecorder(cloth, Stage::observe, "observe", names);
  scene.body().forceActivationState(ISLAND_SLEEPING);
  wet.preTick(btScalar(0.01));
  EXPECT_EQ(names, Names{"observe"});
  scene.body().forceActivationState(ACTIVE_TAG);
  wet.preTick(btScalar(0.01));
  EXPECT_EQ(names, (Names{"observe", "observe", "forces"}));
}

TEST(ObserveStageOf, CollisionAudit) {
  EXPECT_EQ(wetcloth::CollisionAudit(wetcloth::CollisionAudit::Parameters()).stage(), Stage::observe);
}

}  // namespace
}  // namespace wetcloth_test::observe_stage_test
