// SPDX-License-Identifier: Zlib
// The order of a step, effects of the application's own, and what happens to one that fails.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BodyState.h"
#include "tests/support/CallEffect.h"
#include "tests/support/ExactPace.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Materials.h"
#include "tests/support/Patches.h"

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <type_traits>

namespace wetcloth_test::effect_test {

namespace {

using wetcloth::Stage;
using Names = std::vector<std::string>;

void addRecorder(wetcloth::WetCloth& cloth, Stage stage, const std::string& name, Names& names) {
  addCall(
      cloth, [name, &names](wetcloth::WetCloth&, const wetcloth::Step&) { names.push_back(name); }, stage);
}

TEST_IN_EVERY_WORLD(EffectOrder, IsThatOfTheStagesWhateverTheOrderOfAdding) {
  const std::vector<std::pair<Stage, std::string>> inOrder = {
      {Stage::sources, "sources"},   {Stage::transport, "transport"}, {Stage::losses, "losses"},
      {Stage::material, "material"}, {Stage::forces, "forces"},       {Stage::elasticity, "elasticity"}};
  const Names expected = {"sources", "transport", "losses", "material", "forces", "elasticity"};
  for (const std::vector<std::size_t>& order :
       {std::vector<std::size_t>{0, 1, 2, 3, 4, 5}, {5, 4, 3, 2, 1, 0}, {3, 5, 0, 4, 1, 2}}) {
    BodyScene scene(GetParam());
    wetcloth::WetClothWorld wet(scene.world());
    wetcloth::WetCloth& cloth = exactly(wet.add(scene.body()));
    Names names;
    for (const std::size_t i : order) addRecorder(cloth, inOrder[i].first, inOrder[i].second, names);
    scene.bullet().step(1);
    EXPECT_EQ(names, expected);
    for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(cloth.effects()[i].stage(), inOrder[i].first);
  }
}

TEST_IN_EVERY_WORLD(EffectOrder, WithinAStageIsThatOfAdding) {
  BodyScene scene(GetParam());
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body()));
  Names names;
  for (const char* name : {"b", "a", "c"}) addRecorder(cloth, Stage::forces, name, names);
  scene.bullet().step(1);
  EXPECT_EQ(names, (Names{"b", "a", "c"}));
}

// Masses are written between `material` and `forces`: before, the old mass; after, the new one.
TEST_IN_EVERY_WORLD(EffectOrder, MassesAreCommittedBetweenMaterialAndForces) {
  BodyScene scene(GetParam());
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body()));
  const btScalar dry = scene.body().m_nodes[12].m_im;
  cloth.add<wetcloth::Absorption>();
  btScalar seen[2] = {0, 0};
  addCall(
      cloth, [&](wetcloth::WetCloth& c, const wetcloth::Step&) { seen[0] = c.body().m_nodes[12].m_im; },
      Stage::material);
  addCall(
      cloth, [&](wetcloth::WetCloth& c, const wetcloth::Step&) { seen[1] = c.body().m_nodes[12].m_im; }, Stage::forces);
  scene.bullet().step(1);
  EXPECT_EQ(seen[0], dry);
  EXPECT_LT(seen[1], dry);
}

// Order of adding Absorption and Wind is of no consequence, to the last bit.
TEST_IN_EVERY_WORLD(EffectOrder, HasNoInfluenceOnTheResult) {
  std::vector<btScalar> results[2];
  for (const bool windFirst : {false, true}) {
    BodyScene scene(GetParam(), hangingPatch(5));
    wetcloth::WetClothWorld wet(scene.world());
    wetcloth::WetCloth& cloth = exactly(wet.add(scene.body()));
    if (windFirst) cloth.add<wetcloth::Wind>({btVector3(0, 0, 3)});
    cloth.add<wetcloth::Absorption>();
    if (!windFirst) cloth.add<wetcloth::Wind>({btVector3(0, 0, 3)});
    scene.bullet().step(60);
    results[windFirst] = stateOf(scene.body());
  }
  EXPECT_TRUE(sameBits(results[0], results[1]));
}

// An effect of somebody else's, as short as can be: a sponge below y = 0 that wets what it touches.
class Sponge : public wetcloth::Effect {
 public:
  struct Parameters {
    double rate = 0.5;  // of a node's capacity per second
  };
  explicit Sponge(Parameters parameters) : m_parameters(parameters) {
    if (!(m_parameters.rate > 0)) throw std::invalid_argument("Sponge.rate must be > 0");
  }
  const char* name() const override { return "Sponge"; }
  Stage stage() const override { return Stage::sources; }
  void apply(wetcloth::WetCloth& cloth, const wetcloth::Step& step) override {
    wetcloth::Water& water = cloth.water();
    for (std::size_t i = 0; i < water.size(); ++i) {
      if (cloth.body().m_nodes[int(i)].m_x.y() > 0) continue;
      const double room = water.capacity(i) - water.held(i);
      water.absorb(i, std::min(room, m_parameters.rate * water.capacity(i) * step.dt), 0, 0, 0);
    }
  }

 private:
  Parameters m_parameters;
};

TEST_IN_EVERY_WORLD(OwnEffect, WorksLikeOneOfOurs) {
  BodyScene scene(GetParam(), squarePatch(4), btVector3(0, 0, 0));
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body(), fabricOf(1, 1)));
  const Sponge& sponge = cloth.add<Sponge>({0.25});
  EXPECT_EQ(&cloth.effects()[0], &sponge);
  scene.bullet().step(240);
  EXPECT_NEAR(cloth.meanSaturation(), 0.25, 1e-5);  // 240 float steps make a second
  EXPECT_NEAR(1 / double(scene.body().m_nodes[5].m_im), cloth.dryMass(5) * 1.25, 1e-5 * cloth.dryMass(5));
  EXPECT_THROW(cloth.add<Sponge>({-1}), std::invalid_argument);
  EXPECT_EQ(cloth.effects().size(), 1u);
}

class Refuses : public wetcloth::Effect {
 public:
  const char* name() const override { return "Refuses"; }
  Stage stage() const override { return Stage::forces; }
  void attach(wetcloth::WetCloth&) override { throw std::invalid_argument("Refuses: not this body"); }
  void apply(wetcloth::WetCloth&, const wetcloth::Step&) override { FAIL(); }
};

TEST_IN_EVERY_WORLD(OwnEffect, ThatRefusesABodyIsNotAdded) {
  BodyScene scene(GetParam());
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body()));
  EXPECT_THROW(cloth.add(std::make_unique<Refuses>()), std::invalid_argument);
  EXPECT_TRUE(cloth.effects().empty());
  EXPECT_THROW(cloth.add(std::unique_ptr<wetcloth::Effect>()), std::invalid_argument);
  scene.bullet().step(1);
}

// The contract says that apply() never throws; one that does is removed, with a message, and the rest goes on.
TEST_IN_EVERY_WORLD(OwnEffect, ThatThrowsIsRemovedAndTheWorldGoesOn) {
  for (const bool standard : {true, false}) {
    BodyScene scene(GetParam());
    wetcloth::WetClothWorld wet(scene.world());
    std::vector<std::string> messages;
    wet.setLog([&messages](const std::string& message) { messages.push_back(message); });
    wetcloth::WetCloth& cloth = exactly(wet.add(scene.body()));
    Names names;
    addRecorder(cloth, Stage::sources, "before", names);
    addCall(
        cloth,
        [standard](wetcloth::WetCloth&, const wetcloth::Step&) {
          if (standard) throw std::runtime_error("out of soap");
          throw 42;
        },
        Stage::losses);
    addRecorder(cloth, Stage::losses, "same stage", names);
    addRecorder(cloth, Stage::forces, "after", names);
    EXPECT_NO_THROW(scene.bullet().step(1));
    EXPECT_EQ(names, (Names{"before", "same stage", "after"}));
    EXPECT_EQ(cloth.effects().size(), 3u);
    ASSERT_EQ(messages.size(), 1u);
    EXPECT_NE(messages[0].find("Call"), std::string::npos) << "names the effect: " << messages[0];
    if (standard) {
      EXPECT_NE(messages[0].find("out of soap"), std::string::npos) << messages[0];
    }
    scene.bullet().step(5);
    EXPECT_EQ(names.size(), 18u);
    EXPECT_EQ(messages.size(), 1u);
    EXPECT_TRUE(isFinite(scene.body()));
  }
}

// An effect that is removed because it failed gives back what it changed, like any other that is removed.
class FailsAndGivesBack : public wetcloth::Effect {
 public:
  explicit FailsAndGivesBack(bool& gaveBack) : m_gaveBack(gaveBack) {}
  const char* name() const override { return "FailsAndGivesBack"; }
  Stage stage() const override { return Stage::material; }
  void detach(wetcloth::WetCloth&) override { m_gaveBack = true; }
  void apply(wetcloth::WetCloth&, const wetcloth::Step&) override { throw std::runtime_error("failed"); }

 private:
  bool& m_gaveBack;
};

TEST_IN_EVERY_WORLD(OwnEffect, ThatFailsIsDetachedBeforeItIsRemoved) {
  BodyScene scene(GetParam());
  wetcloth::WetClothWorld wet(scene.world());
  wet.setLog({});
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body()));
  bool gaveBack = false;
  cloth.add(std::make_unique<FailsAndGivesBack>(gaveBack));
  EXPECT_NO_THROW(scene.bullet().step(1));
  EXPECT_TRUE(cloth.effects().empty());
  EXPECT_TRUE(gaveBack);
}

// A destructor must not let it through.
class DoesNotGiveBack : public wetcloth::Effect {
 public:
  const char* name() const override { return "DoesNotGiveBack"; }
  Stage stage() const override { return Stage::material; }
  void detach(wetcloth::WetCloth&) override { throw std::runtime_error("mine"); }
  void apply(wetcloth::WetCloth&, const wetcloth::Step&) override {}
};

TEST_IN_EVERY_WORLD(OwnEffect, ThatThrowsAtTheEndIsReported) {
  BodyScene scene(GetParam());
  std::vector<std::string> messages;
  {
    wetcloth::WetClothWorld wet(scene.world());
    wet.setLog([&messages](const std::string& message) { messages.push_back(message); });
    exactly(wet.add(scene.body())).add(std::make_unique<DoesNotGiveBack>());
  }
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_NE(messages[0].find("DoesNotGiveBack"), std::string::npos) << messages[0];
}

// A push is a velocity that Bullet can use: never NaN, never on a pinned node.
TEST_IN_EVERY_WORLD(OwnEffect, CannotPushNonsense) {
  BodyScene scene(GetParam(), hangingPatch(4));
  wetcloth::WetClothWorld wet(scene.world(), wetcloth::Hook::manual);
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body()));
  const std::vector<btScalar> before = stateOf(scene.body());
  const btScalar nan = std::numeric_limits<btScalar>::quiet_NaN();
  const btScalar infinity = std::numeric_limits<btScalar>::infinity();
  for (const btVector3& bad : {btVector3(nan, 0, 0), btVector3(0, infinity, 0), btVector3(0, -infinity, infinity)}) {
    for (int i = 0; i < cloth.nodeCount(); ++i) cloth.push(scene.body().m_nodes[i], bad);
  }
  cloth.push(scene.body().m_nodes[15], btVector3(1, 1, 1));  // pinned
  EXPECT_TRUE(sameBits(stateOf(scene.body()), before));
}

TEST_IN_EVERY_WORLD(OwnEffect, ThatIsNotOursCannotBeRemoved) {
  BodyScene scene(GetParam());
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body()));
  wetcloth::Absorption stranger({});
  EXPECT_THROW(cloth.remove(stranger), std::invalid_argument);
  wetcloth::Absorption& ours = cloth.add<wetcloth::Absorption>();
  scene.bullet().step(5);
  const double before = cloth.ledger().held;
  cloth.remove(ours);
  scene.bullet().step(5);
  EXPECT_EQ(cloth.ledger().held, before);
}

// What an effect remembers of its cloth would be wrong for another one.
static_assert(!std::is_copy_constructible_v<wetcloth::Swelling> && !std::is_copy_assignable_v<wetcloth::Swelling>);
static_assert(!std::is_move_constructible_v<wetcloth::Wind> && !std::is_move_assignable_v<wetcloth::Wind>);

TEST_IN_EVERY_WORLD(OwnEffect, ComesAndGoesBetweenStepsOnly) {
  BodyScene scene(GetParam());
  wetcloth::WetClothWorld wet(scene.world());
  std::vector<std::string> messages;
  wet.setLog([&messages](const std::string& message) { messages.push_back(message); });
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body()));
  Names names;
  using Act = std::function<void(wetcloth::WetCloth&)>;
  const std::vector<Act> acts = {
      [](wetcloth::WetCloth& c) { c.remove(c.effects()[0]); },
      [](wetcloth::WetCloth& c) { c.add<wetcloth::Absorption>(); },
      [](wetcloth::WetCloth& c) { c.world().remove(c.body()); },
      [](wetcloth::WetCloth& c) { c.world().add(c.body()); },
  };
  for (const Act& act : acts) addCall(cloth, [act](wetcloth::WetCloth& c, const wetcloth::Step&) { act(c); });
  addRecorder(cloth, Stage::forces, "stays", names);
  EXPECT_NO_THROW(scene.bullet().step(1));
  EXPECT_EQ(names, Names{"stays"});
  EXPECT_EQ(cloth.effects().size(), 1u);
  ASSERT_EQ(messages.size(), acts.size());
  for (const std::string& message : messages) EXPECT_NE(message.find("in a step"), std::string::npos) << message;
  cloth.remove(cloth.effects()[0]);
  EXPECT_TRUE(cloth.effects().empty());
}

class WakesBadly : public wetcloth::Effect {
 public:
  const char* name() const override { return "WakesBadly"; }
  Stage stage() const override { return Stage::contact; }
  void apply(wetcloth::WetCloth&, const wetcloth::Step&) override {}
  bool wakes(const wetcloth::WetCloth&, const wetcloth::Step&) const override { throw 5; }
};

TEST(OwnEffectOfASleeper, ThatThrowsIsRemovedToo) {
  BodyScene scene(WorldKind::deformable);
  wetcloth::WetClothWorld wet(scene.world());
  std::string said;
  wet.setLog([&said](const std::string& message) { said += message; });
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body()));
  cloth.add(std::make_unique<WakesBadly>());
  scene.body().forceActivationState(ISLAND_SLEEPING);
  EXPECT_NO_THROW(scene.bullet().step(1));
  EXPECT_TRUE(cloth.effects().empty());
  EXPECT_NE(said.find("WakesBadly removed"), std::string::npos) << said;
}

// Which class it was added as is no matter: what it changes in the body is the same.
TEST(SecondEffect, IsRefusedHoweverTheFirstWasAdded) {
  BodyScene scene(WorldKind::softRigid);
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body()));
  using wetcloth::Effect;
  cloth.add(std::unique_ptr<Effect>(std::make_unique<wetcloth::HookeSprings>(wetcloth::HookeSprings::Parameters())));
  cloth.add(std::unique_ptr<Effect>(std::make_unique<wetcloth::Swelling>(wetcloth::Swelling::Parameters())));
  cloth.add(std::unique_ptr<Effect>(std::make_unique<wetcloth::WetStiffness>(wetcloth::WetStiffness::Parameters())));
  EXPECT_THROW(cloth.add<wetcloth::HookeSprings>(), std::invalid_argument);
  EXPECT_THROW(cloth.add<wetcloth::Swelling>(), std::invalid_argument);
  EXPECT_THROW(cloth.add<wetcloth::WetStiffness>(), std::invalid_argument);
  EXPECT_EQ(cloth.effects().size(), 3u);
}

TEST(WaterOfAnyWeight, PinsNoNode) {
  BodyScene scene(WorldKind::softRigid);
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body()));
  const btScalar dry = scene.body().m_nodes[12].m_im;
  cloth.setHeld(std::vector<double>(std::size_t(cloth.nodeCount()), 1e300));
  EXPECT_GT(scene.body().m_nodes[12].m_im, 0);
  cloth.setSaturation(0);
  EXPECT_EQ(scene.body().m_nodes[12].m_im, dry);
  wet.remove(scene.body());
  wetcloth::Fabric repellent = wetcloth::Fabric::cotton();
  repellent.capacity = 1e-322;
  EXPECT_EQ(wet.add(scene.body(), repellent).meanSaturation(), 0);
}

}  // namespace
}  // namespace wetcloth_test::effect_test
