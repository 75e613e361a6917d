// SPDX-License-Identifier: Zlib
// The step allocates nothing after its first turns, nor does a world's whole step on ClothSolver. C++ allocations are
// counted by replacing operator new for the whole test program; Bullet's own go through btAlignedAlloc and are not
// counted. Sanitizers bring an operator new of their own, so there the count is left out.

#include "tests/solver/GuardScene.h"
#include "tests/solver/SolverScene.h"
#include "tests/support/BodyScene.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Materials.h"
#include "tests/support/Patches.h"
#include "tests/support/RigidBody.h"
#include "tests/support/WaterCycle.h"

#include <cstdlib>
#include <new>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define WETCLOTH_COUNTS_ALLOCATIONS 0
#else
#define WETCLOTH_COUNTS_ALLOCATIONS 1
#endif

namespace {
thread_local bool g_counting = false;
thread_local long long g_allocations = 0;

#if WETCLOTH_COUNTS_ALLOCATIONS
void* countedAllocation(std::size_t size) {
  if (g_counting) ++g_allocations;
  void* memory = std::malloc(size > 0 ? size : 1);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
#endif
}  // namespace

#if WETCLOTH_COUNTS_ALLOCATIONS
void* operator new(std::size_t size) { return countedAllocation(size); }
void* operator new[](std::size_t size) { return countedAllocation(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
#endif

namespace wetcloth_test::allocation_test {

namespace {

template <class Action>
long long allocationsIn(Action action) {
  g_allocations = 0;
  g_counting = true;
  action();
  g_counting = false;
  return g_allocations;
}

// Water that comes and goes fast, so that in each step every effect has something to do.
void addWaterCycle(BodyScene& scene, wetcloth::WetCloth& cloth) {
  water_cycle::giveWater(scene.bullet().info(), btScalar(0.4));
  water_cycle::letTouch(scene.bullet(), scene.body());
  cloth.add<wetcloth::Immersion>();
  cloth.add<wetcloth::Rain>({btVector3(1, -1, 1), 0.01, 5, true});
  cloth.add<wetcloth::Splash>(
      {wetcloth::Splash::Cone{btVector3(btScalar(0.5), btScalar(0.5), -1), 0.3, 3}, btVector3(0, 0, 5), 0.1});
  cloth.add<wetcloth::ContactWetting>();
  cloth.add<wetcloth::Diffusion>();
  cloth.add<wetcloth::Seepage>({0.01, 3});
  cloth.add<wetcloth::Dripping>({0.1, 1, 1e-5, 0.02, 0.5, nullptr});
  cloth.add<wetcloth::Drying>();
  cloth.add<wetcloth::WetStiffness>({0.8, 0.5, 1, 2});
  cloth.add<wetcloth::Swelling>();
  cloth.add<wetcloth::WaterDrag>();
  cloth.add<wetcloth::Cling>();
  cloth.add<wetcloth::WetFriction>();
}

TEST_IN_EVERY_WORLD(NoAllocation, TheCounterCounts) {
  if (!WETCLOTH_COUNTS_ALLOCATIONS) GTEST_SKIP() << "a sanitizer owns operator new";
  EXPECT_GE(allocationsIn([] { std::make_unique<std::vector<double>>(100); }), 2);
}

TEST_IN_EVERY_WORLD(NoAllocation, InTheStepAfterItsFirstTurns) {
  if (!WETCLOTH_COUNTS_ALLOCATIONS) GTEST_SKIP() << "a sanitizer owns operator new";
  BodyScene scene(GetParam(), hangingPatch(10));
  wetcloth::WetClothWorld wet(scene.world(), wetcloth::Hook::manual);
  wetcloth::WetCloth& cloth = wet.add(scene.body(), fabricOf(1, 3));
  cloth.add<wetcloth::Absorption>({[](const btVector3& x, const btVector3&) { return x.x() > 0.5 ? 1.0 : 0.5; }});
  cloth.add<wetcloth::Wind>(
      {[](const btVector3&, double time) { return btVector3(0, 0, btScalar(3 + std::sin(time))); }});
  cloth.add<wetcloth::CollisionAudit>();
  wetcloth::HookeSprings& springs = cloth.add<wetcloth::HookeSprings>(springsOf(300, 5));
  addWaterCycle(scene, cloth);
  const btScalar dt = btScalar(1) / 240;
  for (int turn = 0; turn < 3; ++turn) {
    wet.preTick(dt);
    scene.world().stepSimulation(dt, 0);
  }
  // The springs factor their matrix anew when masses have doubled; that alone may allocate.
  int quietSteps = 0;
  for (int step = 0; step < 240; ++step) {
    const long long factored = springs.factorizations();
    const long long allocations = allocationsIn([&] { wet.preTick(dt); });
    if (springs.factorizations() == factored) {
      ++quietSteps;
      ASSERT_EQ(allocations, 0) << "in step " << step;
    }
    scene.world().stepSimulation(dt, 0);
  }
  EXPECT_GT(quietSteps, 100);
}

TEST_IN_EVERY_WORLD(NoAllocation, InFillingAVertexBuffer) {
  if (!WETCLOTH_COUNTS_ALLOCATIONS) GTEST_SKIP() << "a sanitizer owns operator new";
  BodyScene scene(GetParam(), hangingPatch(10));
  wetcloth::WetClothWorld wet(scene.world(), wetcloth::Hook::manual);
  const wetcloth::WetCloth& cloth = wet.add(scene.body());
  std::vector<float> floats(1000);
  const wetcloth::VertexBuffer buffer = {floats.data(), 100, {0, 10}, {3, 10}, {6, 10}, {9, 10}};
  EXPECT_EQ(allocationsIn([&] { wetcloth::fillVertexBuffer(cloth, buffer); }), 0);
  EXPECT_GT(floats.back(), 0);
}

// Drops that are poured, fly, land on the cloth and on a box below it, run off and merge; after a second, in which the
// box gets its first film.
TEST_IN_EVERY_WORLD(NoAllocation, ByDropsThatFlyAndLand) {
  if (!WETCLOTH_COUNTS_ALLOCATIONS) GTEST_SKIP() << "a sanitizer owns operator new";
  BodyScene scene(GetParam(), hangingPatch(10));
  RigidBody floor(scene.bullet(), box(2, 0.1, 2), 0, btVector3(0, -2, 0));
  wetcloth::WetClothWorld wet(scene.world(), wetcloth::Hook::manual);
  wetcloth::WetCloth& cloth = wet.add(scene.body());
  cloth.add<wetcloth::Dripping>();
  cloth.setSaturation(0.9);
  wetcloth::Drops::Parameters parameters;
  parameters.mostDrops = 300;
  wetcloth::Drops drops(wet, parameters);
  wetcloth::Pour pour;
  pour.position = btVector3(btScalar(0.5), btScalar(0.5), 1);
  pour.velocity = btVector3(0, 1, -3);
  pour.halfAngle = 0.5;
  pour.flow = 0.1;
  drops.add(pour);
  const btScalar dt = btScalar(1) / 240;
  for (int step = 0; step < 480; ++step) {
    const long long allocations = allocationsIn([&] { wet.preTick(dt); });
    if (step >= 240) {
      ASSERT_EQ(allocations, 0) << "in step " << step;
    }
    scene.world().stepSimulation(dt, 0);
  }
  EXPECT_GT(drops.landedOnCloth(), 100);
  EXPECT_GT(drops.merged(), 0);
  EXPECT_GT(drops.ledger().films, 0);
}

TEST_IN_EVERY_WORLD(NoAllocation, ByAClothOfSeveralFabrics) {
  if (!WETCLOTH_COUNTS_ALLOCATIONS) GTEST_SKIP() << "a sanitizer owns operator new";
  BodyScene scene(GetParam(), hangingPatch(10));
  wetcloth::WetClothWorld wet(scene.world(), wetcloth::Hook::manual);
  std::vector<int> halves(50, 0);
  halves.resize(100, 1);
  wetcloth::WetCloth& cloth = wet.add(scene.body(), {fabricOf(1, 3), fabricOf(2, 5)}, halves);
  water_cycle::giveWater(scene.bullet().info(), btScalar(0.4));
  cloth.add<wetcloth::Absorption>();
  cloth.add<wetcloth::Immersion>();
  cloth.add<wetcloth::Diffusion>();
  cloth.add<wetcloth::Drying>();
  const btScalar dt = btScalar(1) / 240;
  for (int turn = 0; turn < 3; ++turn) {
    wet.preTick(dt);
    scene.world().stepSimulation(dt, 0);
  }
  for (int step = 0; step < 60; ++step) {
    ASSERT_EQ(allocationsIn([&] { wet.preTick(dt); }), 0) << "in step " << step;
    scene.world().stepSimulation(dt, 0);
  }
  std::vector<float> floats(400);
  const wetcloth::VertexBuffer buffer = {floats.data(), 100, {}, {}, {0, 4}, {3, 4}};
  EXPECT_EQ(allocationsIn([&] { wetcloth::fillVertexBuffer(cloth, buffer); }), 0);
}

// Two layers that lie on each other, with the guard: what Bullet allocates in its own step it does not take from here.
TEST(NoAllocationOfTheGuard, InALayeredHeapAtRest) {
  if (!WETCLOTH_COUNTS_ALLOCATIONS) GTEST_SKIP() << "a sanitizer owns operator new";
  GuardScene scene;
  scene.addFloor();
  scene.add(levelSheet(10, 0.5, btVector3(0, btScalar(0.02), 0)));
  scene.add(levelSheet(11, 0.4, btVector3(btScalar(0.01), btScalar(0.04), btScalar(0.02))));
  scene.step(120);
  const long long pairs = scene.totals().pairs;
  for (int step = 0; step < 60; ++step) {
    ASSERT_EQ(allocationsIn([&] { scene.step(1); }), 0) << "in step " << step;
  }
  EXPECT_GT(scene.totals().pairs, pairs) << "something was held apart";
}

TEST(NoAllocationOfTheGuard, InWetLayersThatTouch) {
  if (!WETCLOTH_COUNTS_ALLOCATIONS) GTEST_SKIP() << "a sanitizer owns operator new";
  GuardScene scene;
  scene.addFloor();
  btSoftBody* const bodies[2] = {&scene.add(levelSheet(10, 0.5, btVector3(0, btScalar(0.02), 0))),
                                 &scene.add(levelSheet(11, 0.4, btVector3(0, btScalar(0.025), 0)))};
  wetcloth::WetClothWorld wet(scene.scene().bullet().world());
  for (btSoftBody* const body : bodies) {
    body->m_cfg.collisions |= btSoftBody::fCollision::VF_SS;
    wetcloth::WetCloth& cloth = wet.add(*body);
    wetcloth::ContactWetting::Parameters parameters;
    parameters.cloths = true;
    cloth.add<wetcloth::ContactWetting>(parameters);
    cloth.add<wetcloth::WetFriction>();
    cloth.add<wetcloth::Cling>();
    cloth.setSaturation(body == bodies[0] ? 0.2 : 1);
  }
  scene.step(120);
  ASSERT_GT(bodies[1]->m_scontacts.size(), 0);
  for (int step = 0; step < 60; ++step) {
    ASSERT_EQ(allocationsIn([&] { scene.step(1); }), 0) << "in step " << step;
  }
  EXPECT_GT(wet.find(*bodies[0])->ledger().absorbed, 0);
}

// A cloth that is held all around with a weight under it and a ball in it, and one that falls on the floor: contacts
// with what moves and with what does not, an anchor, links that soften while water comes.
TEST_IN_POSITION_BASED_WORLDS(NoAllocationOnClothSolver, InTheWholeStepOfTwoCloths) {
  if (!WETCLOTH_COUNTS_ALLOCATIONS) GTEST_SKIP() << "a sanitizer owns operator new";
  SolverScene scene(GetParam());
  using Edge = wetcloth::ClothPatch::Edge;
  wetcloth::ClothPatch held = levelPatch(10, 1);
  held.pinnedEdges = {Edge::left, Edge::right, Edge::top, Edge::bottom};
  wetcloth::ClothPatch lying = levelPatch(8, 0.5);
  lying.origin.setY(btScalar(-0.97));
  btSoftBody* const cloths[2] = {&scene.add(held), &scene.add(lying)};
  RigidBody floor(scene.bullet(), box(2, 0.5, 2), 0, btVector3(0, btScalar(-1.5), 0));
  RigidBody weight(scene.bullet(), box(0.02, 0.02, 0.02), btScalar(0.01), cloths[0]->m_nodes[22].m_x);
  RigidBody ball(scene.bullet(), std::make_unique<btSphereShape>(btScalar(0.2)), btScalar(0.05),
                 btVector3(0, btScalar(0.25), 0));
  cloths[0]->appendAnchor(22, &weight.body(), true);
  wetcloth::WetClothWorld wet(scene.bullet().world());
  for (btSoftBody* const body : cloths) {
    body->getCollisionShape()->setMargin(btScalar(0.02));
    wetcloth::WetCloth& cloth = wet.add(*body, fabricOf(1, 3));
    cloth.add<wetcloth::Absorption>();
    cloth.add<wetcloth::Wind>();
    cloth.add<wetcloth::WetStiffness>({0.8, 0.5, 1, 2});
    cloth.add<wetcloth::Swelling>();
  }
  scene.step(90);
  ASSERT_GT(cloths[0]->m_rcontacts.size(), 0);
  ASSERT_GT(cloths[1]->m_rcontacts.size(), 0);
  for (int step = 0; step < 120; ++step) ASSERT_EQ(allocationsIn([&] { scene.step(1); }), 0) << "in step " << step;
  EXPECT_GT(wet.find(*cloths[0])->ledger().absorbed, 0);
}

}  // namespace
}  // namespace wetcloth_test::allocation_test
