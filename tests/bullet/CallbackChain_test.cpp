// SPDX-License-Identifier: Zlib
// The application's callbacks and ours share Bullet's one slot: who is called when, and what is left behind.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/CallEffect.h"
#include "tests/support/InEveryWorld.h"

#include <memory>
#include <stdexcept>

namespace wetcloth_test::callback_chain_test {

namespace {

struct Application {
  std::vector<std::string> calls;
  wetcloth::WetClothWorld* wet = nullptr;

  static void preTick(btDynamicsWorld* world, btScalar) { of(world).calls.push_back("application"); }
  static void otherPreTick(btDynamicsWorld* world, btScalar) { of(world).calls.push_back("other"); }
  static void postTick(btDynamicsWorld* world, btScalar) { of(world).calls.push_back("post"); }
  static void preTickThatCallsUs(btDynamicsWorld* world, btScalar dt) {
    of(world).calls.push_back("application");
    of(world).wet->preTick(dt);
  }
  static Application& of(btDynamicsWorld* world) { return *static_cast<Application*>(world->getWorldUserInfo()); }
};

wetcloth::Effect& addRecorder(wetcloth::WetCloth& cloth, Application& application) {
  return addCall(cloth,
                 [&application](wetcloth::WetCloth&, const wetcloth::Step&) { application.calls.push_back("effect"); });
}

using Calls = std::vector<std::string>;

TEST_IN_EVERY_WORLD(CallbackChain, TheApplicationComesFirst) {
  BodyScene scene(GetParam());
  Application application;
  scene.world().setInternalTickCallback(Application::preTick, &application, true);
  wetcloth::WetClothWorld wet(scene.world());
  addRecorder(wet.add(scene.body()), application);
  scene.bullet().step(2);
  EXPECT_EQ(application.calls, (Calls{"application", "effect", "application", "effect"}));
  EXPECT_TRUE(wet.isHooked());
}

TEST_IN_EVERY_WORLD(CallbackChain, DetachingPutsTheApplicationsCallbackBack) {
  BodyScene scene(GetParam());
  Application application;
  scene.world().setInternalTickCallback(Application::preTick, &application, true);
  {
    wetcloth::WetClothWorld wet(scene.world());
    addRecorder(wet.add(scene.body()), application);
  }
  EXPECT_EQ(scene.world().getWorldUserInfo(), &application);
  scene.bullet().step(2);
  EXPECT_EQ(application.calls, (Calls{"application", "application"}));
}

TEST_IN_EVERY_WORLD(CallbackChain, WithoutAnApplicationsCallbackNothingIsLeftBehind) {
  BodyScene scene(GetParam());
  { wetcloth::WetClothWorld wet(scene.world()); }
  EXPECT_EQ(scene.world().getWorldUserInfo(), nullptr);
  scene.bullet().step(2);  // a stale pointer would crash here
}

// The post-tick callback and the user info can be set on top of us at any time.
TEST_IN_EVERY_WORLD(CallbackChain, ThePostTickCallbackMayBeSetLater) {
  BodyScene scene(GetParam());
  wetcloth::WetClothWorld wet(scene.world());
  Application application;
  addRecorder(wet.add(scene.body()), application);
  scene.world().setInternalTickCallback(Application::postTick, &application, false);
  scene.bullet().step(1);
  EXPECT_EQ(application.calls, (Calls{"effect", "post"}));
  EXPECT_TRUE(wet.isHooked());
}

TEST_IN_EVERY_WORLD(CallbackChain, OverwritingTheSlotIsNoticed) {
  BodyScene scene(GetParam());
  Application application;
  wetcloth::WetClothWorld wet(scene.world());
  addRecorder(wet.add(scene.body()), application);
  scene.world().setInternalTickCallback(Application::preTick, &application, true);
  EXPECT_FALSE(wet.isHooked());
  scene.bullet().step(1);
  EXPECT_EQ(application.calls, Calls{"application"});
  // A cloth that is added now would never get wet: that is said.
  std::vector<std::string> messages;
  wet.setLog([&messages](const std::string& message) { messages.push_back(message); });
  wet.remove(scene.body());
  wet.add(scene.body());
  EXPECT_EQ(messages.size(), 1u);
}

// Whoever took the slot after us keeps it when we leave.
TEST_IN_EVERY_WORLD(CallbackChain, ACallbackSetOnTopOfOursSurvivesUs) {
  BodyScene scene(GetParam());
  Application application;
  scene.world().setInternalTickCallback(Application::preTick, &application, true);
  {
    wetcloth::WetClothWorld wet(scene.world());
    scene.world().setInternalTickCallback(Application::otherPreTick, &application, true);
  }
  scene.bullet().step(1);
  EXPECT_EQ(application.calls, Calls{"other"});
}

TEST_IN_EVERY_WORLD(CallbackChain, AnApplicationThatTookTheSlotMayCallUsItself) {
  BodyScene scene(GetParam());
  Application application;
  wetcloth::WetClothWorld wet(scene.world());
  addRecorder(wet.add(scene.body()), application);
  application.wet = &wet;
  scene.world().setInternalTickCallback(Application::preTickThatCallsUs, &application, true);
  scene.bullet().step(2);
  EXPECT_EQ(application.calls, (Calls{"application", "effect", "application", "effect"}));
}

TEST_IN_EVERY_WORLD(CallbackChain, InManualModeTheSlotIsTheApplications) {
  BodyScene scene(GetParam());
  Application application;
  scene.world().setInternalTickCallback(Application::preTickThatCallsUs, &application, true);
  {
    wetcloth::WetClothWorld wet(scene.world(), wetcloth::Hook::manual);
    application.wet = &wet;
    addRecorder(wet.add(scene.body()), application);
    EXPECT_FALSE(wet.isHooked());
    scene.bullet().step(2);
    EXPECT_NEAR(wet.time(), 2.0 / 240, 1e-9);
    scene.world().setInternalTickCallback(Application::otherPreTick, &application, true);
  }
  EXPECT_EQ(application.calls, (Calls{"application", "effect", "application", "effect"}));
  scene.bullet().step(1);
  EXPECT_EQ(application.calls.back(), "other");
}

TEST_IN_EVERY_WORLD(CallbackChain, TwoOnOneWorldAreRefused) {
  BodyScene scene(GetParam());
  for (const wetcloth::Hook second : {wetcloth::Hook::preTick, wetcloth::Hook::manual}) {
    wetcloth::WetClothWorld wet(scene.world());
    EXPECT_THROW(wetcloth::WetClothWorld(scene.world(), second), std::invalid_argument);
    EXPECT_TRUE(wet.isHooked());
    int calls = 0;
    addCall(wet.add(scene.body()), [&calls](wetcloth::WetCloth&, const wetcloth::Step&) { ++calls; });
    scene.bullet().step(1);
    EXPECT_EQ(calls, 1);
  }
}

TEST_IN_EVERY_WORLD(CallbackChain, AttachingAgainAfterDetachingWorks) {
  BodyScene scene(GetParam());
  Application application;
  scene.world().setInternalTickCallback(Application::preTick, &application, true);
  for (int round = 0; round < 3; ++round) {
    wetcloth::WetClothWorld wet(scene.world());
    addRecorder(wet.add(scene.body()), application);
    application.calls.clear();
    scene.bullet().step(1);
    EXPECT_EQ(application.calls, (Calls{"application", "effect"})) << round;
  }
}

// An exception of the application's own travels through Bullet's step to the application; the next step is whole.
TEST_IN_EVERY_WORLD(CallbackChain, AnApplicationsExceptionDoesNotSilenceUs) {
  BodyScene scene(GetParam());
  Application application;
  scene.world().setInternalTickCallback(
      [](btDynamicsWorld*, btScalar) { throw std::runtime_error("the application's"); }, &application, true);
  wetcloth::WetClothWorld wet(scene.world());
  int calls = 0;
  addCall(wet.add(scene.body()), [&calls](wetcloth::WetCloth&, const wetcloth::Step&) { ++calls; });
  EXPECT_THROW(scene.bullet().step(1), std::runtime_error);
  EXPECT_THROW(scene.bullet().step(1), std::runtime_error) << "the application's callback is called in every step";
  EXPECT_EQ(calls, 0);
}

// What we know of the slot must outlive the call that is under way.
TEST_IN_EVERY_WORLD(CallbackChain, TheApplicationMayDestroyUsFromItsCallback) {
  static std::unique_ptr<wetcloth::WetClothWorld> wet;
  BodyScene scene(GetParam());
  scene.world().setInternalTickCallback([](btDynamicsWorld*, btScalar) { wet.reset(); }, nullptr, true);
  wet = std::make_unique<wetcloth::WetClothWorld>(scene.world());
  int calls = 0;
  addCall(wet->add(scene.body()), [&calls](wetcloth::WetCloth&, const wetcloth::Step&) { ++calls; });
  scene.bullet().step(2);
  EXPECT_FALSE(wet);
  EXPECT_EQ(calls, 0);
  const wetcloth::WetClothWorld another(scene.world());
  EXPECT_TRUE(another.isHooked());
}

// A world without soft bodies cannot have cloths.
TEST(CallbackChainOfAnotherWorld, IsRefused) {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  EXPECT_THROW(wetcloth::WetClothWorld wet(world), std::invalid_argument);
  world.stepSimulation(btScalar(1) / 60);  // and nothing is left in its slot
}

}  // namespace
}  // namespace wetcloth_test::callback_chain_test
