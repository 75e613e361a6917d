// SPDX-License-Identifier: Zlib
// Bullet's tick callback, between its collision detection and its solve, is shared with the application like the
// pre-tick callback, but only while a cloth has an effect of the stage `contact`.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/CallEffect.h"
#include "tests/support/ExactPace.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Patches.h"

#include <stdexcept>

namespace wetcloth_test::tick_callback_chain_test {

namespace {

using wetcloth::Stage;
using Calls = std::vector<std::string>;

struct Application {
  Calls calls;
  wetcloth::WetClothWorld* wet = nullptr;

  static void tick(btDynamicsWorld* world, btScalar) { of(world).calls.push_back("application"); }
  static void otherTick(btDynamicsWorld* world, btScalar) { of(world).calls.push_back("other"); }
  static void preTick(btDynamicsWorld* world, btScalar) { of(world).calls.push_back("pre"); }
  static void preTickThatCallsUs(btDynamicsWorld* world, btScalar dt) { of(world).wet->preTick(dt); }
  static void tickThatCallsUs(btDynamicsWorld* world, btScalar dt) {
    of(world).calls.push_back("application");
    of(world).wet->tick(dt);
  }
  static Application& of(btDynamicsWorld* world) { return *static_cast<Application*>(world->getWorldUserInfo()); }
};

wetcloth::Effect& addRecorder(wetcloth::WetCloth& cloth, Application& application, Stage stage, const char* name) {
  return addCall(
      cloth, [&application, name](wetcloth::WetCloth&, const wetcloth::Step&) { application.calls.push_back(name); },
      stage);
}

TEST_IN_EVERY_WORLD(TickCallbackChain, TheSlotIsTheApplicationsWhileNoEffectNeedsIt) {
  BodyScene scene(GetParam());
  Application application;
  scene.world().setInternalTickCallback(Application::tick, &application, false);
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body()));
  addRecorder(cloth, application, Stage::forces, "forces");
  EXPECT_FALSE(wet.isTickHooked());
  scene.bullet().step(1);
  EXPECT_EQ(application.calls, (Calls{"forces", "application"}));
}

TEST_IN_EVERY_WORLD(TickCallbackChain, TheApplicationComesFirst) {
  BodyScene scene(GetParam());
  Application application;
  scene.world().setInternalTickCallback(Application::tick, &application, false);
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body()));
  addRecorder(cloth, application, Stage::contact, "contact");
  addRecorder(cloth, application, Stage::sources, "sources");
  EXPECT_TRUE(wet.isTickHooked());
  EXPECT_EQ(scene.world().getWorldUserInfo(), &application);
  scene.bullet().step(2);
  EXPECT_EQ(application.calls, (Calls{"sources", "application", "contact", "sources", "application", "contact"}));
}

TEST_IN_EVERY_WORLD(TickCallbackChain, TheSlotIsGivenBackWithTheLastEffect) {
  BodyScene scene(GetParam());
  Application application;
  scene.world().setInternalTickCallback(Application::tick, &application, false);
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body()));
  wetcloth::Effect& first = addRecorder(cloth, application, Stage::contact, "first");
  wetcloth::Effect& second = addRecorder(cloth, application, Stage::contact, "second");
  cloth.remove(first);
  EXPECT_TRUE(wet.isTickHooked());
  scene.bullet().step(1);
  cloth.remove(second);
  EXPECT_FALSE(wet.isTickHooked());
  scene.bullet().step(1);
  EXPECT_EQ(application.calls, (Calls{"application", "second", "application"}));
  addRecorder(cloth, application, Stage::contact, "third");
  wet.remove(scene.body());
  EXPECT_FALSE(wet.isTickHooked());
}

TEST_IN_EVERY_WORLD(TickCallbackChain, DetachingPutsTheApplicationsCallbackBack) {
  BodyScene scene(GetParam());
  Application application;
  scene.world().setInternalTickCallback(Application::tick, &application, false);
  {
    wetcloth::WetClothWorld wet(scene.world());
    addRecorder(exactly(wet.add(scene.body())), application, Stage::contact, "contact");
  }
  scene.bullet().step(1);
  EXPECT_EQ(application.calls, Calls{"application"});
}

TEST_IN_EVERY_WORLD(TickCallbackChain, NothingIsLeftBehind) {
  BodyScene scene(GetParam());
  Application application;
  {
    wetcloth::WetClothWorld wet(scene.world());
    addRecorder(exactly(wet.add(scene.body())), application, Stage::contact, "contact");
  }
  scene.bullet().step(1);  // a stale pointer would crash here
  EXPECT_TRUE(application.calls.empty());
  EXPECT_EQ(scene.world().getWorldUserInfo(), nullptr);
}

TEST_IN_EVERY_WORLD(TickCallbackChain, ThePreTickCallbackMayBeSetLater) {
  BodyScene scene(GetParam());
  Application application;
  wetcloth::WetClothWorld wet(scene.world());
  addRecorder(exactly(wet.add(scene.body())), application, Stage::contact, "contact");
  scene.world().setInternalTickCallback(Application::preTick, &application, true);
  scene.bullet().step(1);
  EXPECT_EQ(application.calls, (Calls{"pre", "contact"}));
  EXPECT_TRUE(wet.isTickHooked());
  EXPECT_FALSE(wet.isHooked());
}

TEST_IN_EVERY_WORLD(TickCallbackChain, OverwritingTheSlotIsNoticed) {
  BodyScene scene(GetParam());
  Application application;
  wetcloth::WetClothWorld wet(scene.world());
  Calls messages;
  wet.setLog([&messages](const std::string& message) { messages.push_back(message); });
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body()));
  addRecorder(cloth, application, Stage::contact, "contact");
  EXPECT_TRUE(messages.empty());
  scene.world().setInternalTickCallback(Application::otherTick, &application, false);
  EXPECT_FALSE(wet.isTickHooked());
  EXPECT_TRUE(wet.isHooked());
  scene.bullet().step(1);
  EXPECT_EQ(application.calls, Calls{"other"});
  addRecorder(cloth, application, Stage::contact, "second");
  EXPECT_EQ(messages.size(), 1u);
}

TEST_IN_EVERY_WORLD(TickCallbackChain, AnApplicationThatTookTheSlotMayCallUsItself) {
  BodyScene scene(GetParam());
  Application application;
  {
    wetcloth::WetClothWorld wet(scene.world());
    application.wet = &wet;
    addRecorder(exactly(wet.add(scene.body())), application, Stage::contact, "contact");
    scene.world().setInternalTickCallback(Application::tickThatCallsUs, &application, false);
    scene.bullet().step(2);
    EXPECT_EQ(application.calls, (Calls{"application", "contact", "application", "contact"}));
    scene.world().setInternalTickCallback(Application::otherTick, &application, false);
  }
  scene.bullet().step(1);
  EXPECT_EQ(application.calls.back(), "other") << "whoever took the slot after us keeps it";
}

TEST_IN_EVERY_WORLD(TickCallbackChain, InManualModeTheSlotIsTheApplications) {
  BodyScene scene(GetParam());
  Application application;
  scene.world().setInternalTickCallback(Application::preTickThatCallsUs, &application, true);
  scene.world().setInternalTickCallback(Application::tickThatCallsUs, &application, false);
  wetcloth::WetClothWorld wet(scene.world(), wetcloth::Hook::manual);
  application.wet = &wet;
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body()));
  addRecorder(cloth, application, Stage::contact, "contact");
  addRecorder(cloth, application, Stage::forces, "forces");
  EXPECT_FALSE(wet.isTickHooked());
  scene.bullet().step(1);
  EXPECT_EQ(application.calls, (Calls{"forces", "application", "contact"}));
}

TEST_IN_EVERY_WORLD(TickCallbackChain, AnApplicationsExceptionDoesNotSilenceUs) {
  BodyScene scene(GetParam());
  Application application;
  scene.world().setInternalTickCallback([](btDynamicsWorld*, btScalar) { throw std::runtime_error("its own"); },
                                        &application, false);
  wetcloth::WetClothWorld wet(scene.world());
  addRecorder(exactly(wet.add(scene.body())), application, Stage::contact, "contact");
  EXPECT_THROW(scene.bullet().step(1), std::runtime_error);
  EXPECT_THROW(scene.bullet().step(1), std::runtime_error) << "it is called in every step";
}

// --- the stage ------------------------------------------------------------------------------------------------------

TEST_IN_EVERY_WORLD(TickCallbackChain, AnEffectSeesTheSubstepOfItsPreTick) {
  BodyScene scene(GetParam());
  wetcloth::WetClothWorld wet(scene.world());
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body()));
  std::vector<wetcloth::Step> steps;
  const auto record = [&steps](wetcloth::WetCloth&, const wetcloth::Step& step) { steps.push_back(step); };
  addCall(cloth, record, Stage::contact);
  addCall(cloth, record, Stage::forces);
  scene.bullet().step(3);
  ASSERT_EQ(steps.size(), 6u);
  for (std::size_t i = 0; i < 6; i += 2) {
    EXPECT_EQ(steps[i].time, steps[i + 1].time);
    EXPECT_EQ(steps[i].dt, steps[i + 1].dt);
  }
}

TEST_IN_EVERY_WORLD(TickCallbackChain, AThrowingEffectIsRemovedAndTheSlotGivenBack) {
  BodyScene scene(GetParam());
  wetcloth::WetClothWorld wet(scene.world());
  Calls messages;
  wet.setLog([&messages](const std::string& message) { messages.push_back(message); });
  wetcloth::WetCloth& cloth = exactly(wet.add(scene.body()));
  addCall(
      cloth, [](wetcloth::WetCloth&, const wetcloth::Step&) { throw std::runtime_error("no"); }, Stage::contact);
  scene.bullet().step(2);
  EXPECT_EQ(messages.size(), 1u);
  EXPECT_TRUE(cloth.effects().empty());
  EXPECT_FALSE(wet.isTickHooked());
}

TEST_IN_EVERY_WORLD(TickCallbackChain, AnEffectThatDoesNothingChangesNothing) {
  BodyScene with(GetParam(), hangingPatch(5));
  BodyScene without(GetParam(), hangingPatch(5));
  wetcloth::WetClothWorld wet(with.world());
  addCall(
      exactly(wet.add(with.body())), [](wetcloth::WetCloth&, const wetcloth::Step&) {}, Stage::contact);
  with.bullet().step(60);
  without.bullet().step(60);
  EXPECT_TRUE(sameBits(stateOf(with.body()), stateOf(without.body())));
}

TEST(TickCallbackOfASleeper, DoesNotRun) {
  BodyScene scene(WorldKind::deformable, squarePatch(4), btVector3(0, 0, 0));
  wetcloth::WetClothWorld wet(scene.world());
  int calls = 0;
  addCall(
      exactly(wet.add(scene.body())), [&calls](wetcloth::WetCloth&, const wetcloth::Step&) { ++calls; },
      Stage::contact);
  scene.bullet().step(2000);
  ASSERT_FALSE(scene.body().isActive());
  const int before = calls;
  scene.bullet().step(10);
  EXPECT_EQ(calls, before);
}

}  // namespace
}  // namespace wetcloth_test::tick_callback_chain_test
