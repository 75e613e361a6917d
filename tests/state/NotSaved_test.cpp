// SPDX-License-Identifier: Zlib
// What is not saved is refused when it is to be saved, by name; never restored as something else.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/ContactScene.h"
#include "tests/support/Patches.h"
#include "tests/support/RigidBody.h"

#include <BulletCollision/BroadphaseCollision/btAxisSweep3.h>
#include <BulletDynamics/ConstraintSolver/btNNCGConstraintSolver.h>
#include <BulletDynamics/ConstraintSolver/btPoint2PointConstraint.h>
#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/MLCPSolvers/btMLCPSolver.h>
#include <BulletDynamics/MLCPSolvers/btSolveProjectedGaussSeidel.h>
#include <BulletSoftBody/btSoftRigidCollisionAlgorithm.h>

#include <gtest/gtest.h>

#include <memory>
#include <sstream>
#include <string>

namespace wetcloth_test::not_saved_test {
namespace {

std::string saved(const wetcloth::WetClothWorld& wet) {
  std::ostringstream stream;
  wet.save(stream);
  return stream.str();
}

/// What saving says, "" when it succeeds.
std::string refusal(const wetcloth::WetClothWorld& wet) {
  try {
    saved(wet);
  } catch (const wetcloth::StateError& error) {
    return error.what();
  }
  return "";
}

void expectRefused(const wetcloth::WetClothWorld& wet, const std::string& why) {
  EXPECT_NE(refusal(wet).find(why), std::string::npos) << '"' << refusal(wet) << '"';
}

std::unique_ptr<btSoftBody> cloth(BulletWorld& bullet, double height) {
  wetcloth::ClothPatch patch = squarePatch(4);
  patch.origin = btVector3(0, btScalar(height), 0);
  auto body = patch.build(bullet.info());
  body->m_cfg.collisions = contactFlags(bullet.kind());
  return body;
}

/// A soft-rigid world of parts that an application chooses.
struct OwnWorld {
  OwnWorld(btBroadphaseInterface& broadphase, btConstraintSolver& solver)
      : world(&dispatcher, &broadphase, &solver, &configuration) {
    world.getWorldInfo().m_sparsesdf.Initialize();
    body = squarePatch(4).build(world.getWorldInfo());
    world.addSoftBody(body.get());
    wet = std::make_unique<wetcloth::WetClothWorld>(world);
    wet->add(*body);
    world.stepSimulation(btScalar(1) / 240, 0);
  }
  ~OwnWorld() {
    wet.reset();
    world.removeSoftBody(body.get());
  }
  btSoftBodyRigidBodyCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btSoftRigidDynamicsWorld world;
  std::unique_ptr<btSoftBody> body;
  std::unique_ptr<wetcloth::WetClothWorld> wet;
};

TEST(NotSaved, AreOtherBroadphases) {
  btSequentialImpulseConstraintSolver solver;
  const btVector3 far(100, 100, 100);
  btAxisSweep3 sweep(-far, far);
  bt32BitAxisSweep3 largeSweep(-far, far);
  btSimpleBroadphase simple;
  for (btBroadphaseInterface* broadphase :
       {static_cast<btBroadphaseInterface*>(&sweep), static_cast<btBroadphaseInterface*>(&largeSweep),
        static_cast<btBroadphaseInterface*>(&simple)}) {
    expectRefused(*OwnWorld(*broadphase, solver).wet, "broadphase is not a btDbvtBroadphase");
  }
  btSortedOverlappingPairCache pairs;
  btDbvtBroadphase sorted(&pairs);
  expectRefused(*OwnWorld(sorted, solver).wet, "btSortedOverlappingPairCache");
}

class OwnBroadphase : public btDbvtBroadphase {
 public:
  int calls = 0;
  void calculateOverlappingPairs(btDispatcher* dispatcher) override {
    ++calls;
    btDbvtBroadphase::calculateOverlappingPairs(dispatcher);
  }
};

TEST(NotSaved, AreBroadphasesOfOnesOwn) {
  btSequentialImpulseConstraintSolver solver;
  OwnBroadphase broadphase;
  expectRefused(*OwnWorld(broadphase, solver).wet, "broadphase is not a btDbvtBroadphase");
}

TEST(NotSaved, AreOtherSolvers) {
  btDbvtBroadphase broadphase;
  btSolveProjectedGaussSeidel gaussSeidel;
  btMLCPSolver solver(&gaussSeidel);
  expectRefused(*OwnWorld(broadphase, solver).wet, "constraint solver");
  btDbvtBroadphase another;
  btNNCGConstraintSolver known;
  EXPECT_EQ(refusal(*OwnWorld(another, known).wet), "");
}

TEST(NotSaved, AreMultiBodies) {
  for (const WorldKind kind : {WorldKind::softMultiBody, WorldKind::deformable}) {
    BodyScene scene(kind);
    auto& world = static_cast<btMultiBodyDynamicsWorld&>(scene.world());
    btMultiBody multiBody(0, 1, btVector3(1, 1, 1), false, false);
    multiBody.finalizeMultiDof();
    {
      wetcloth::WetClothWorld wet(scene.world());
      EXPECT_EQ(refusal(wet), "");
      world.addMultiBody(&multiBody);
      expectRefused(wet, "multibod");
    }
    world.removeMultiBody(&multiBody);
  }
}

// Bullet draws random numbers for each such contact, and where it is in their row is not to be seen.
TEST(NotSaved, AreContactsOfSoftBodiesInTheDeformableWorld) {
  for (const WorldKind kind : {WorldKind::deformable, WorldKind::deformableImplicit}) {
    BulletWorld bullet(kind);
    const auto lower = cloth(bullet, 0);
    const auto upper = cloth(bullet, 1);
    bullet.add(*lower);
    bullet.add(*upper);
    wetcloth::WetClothWorld wet(bullet.world());
    expectRefused(wet, "soft body 1 may touch soft body 0");
    // Two that pass through each other have no such contact.
    upper->getBroadphaseHandle()->m_collisionFilterMask = btBroadphaseProxy::StaticFilter;
    EXPECT_EQ(refusal(wet), "");
    lower->setSelfCollision(true);
    expectRefused(wet, "soft body 0 may touch itself");
    lower->m_cfg.collisions = btSoftBody::fCollision::SDF_RD;
    EXPECT_EQ(refusal(wet), "");
    bullet.remove(*lower);
    bullet.remove(*upper);
  }
}

// Bullet measures a convex shape once, in cells, and goes by that when the shape has become another one.
TEST(NotSaved, AreOldDistancesOfAShapeThatWasChanged) {
  BodyScene scene(WorldKind::softRigid);
  scene.body().m_cfg.collisions = contactFlags(WorldKind::softRigid);
  RigidBody sphere(scene.bullet(), std::make_unique<btSphereShape>(btScalar(0.2)), 0,
                   btVector3(btScalar(0.5), btScalar(-0.22), btScalar(0.5)));
  wetcloth::WetClothWorld wet(scene.world());
  scene.bullet().step(30);
  EXPECT_EQ(refusal(wet), "");
  auto& shape = static_cast<btSphereShape&>(*sphere.body().getCollisionShape());
  shape.setUnscaledRadius(btScalar(0.25));
  expectRefused(wet, "the shape of collision object 1 was changed");
  scene.bullet().info().m_sparsesdf.RemoveReferences(&shape);
  EXPECT_EQ(refusal(wet), "");
}

class OwnAlgorithm : public btSoftRigidCollisionAlgorithm {
 public:
  using btSoftRigidCollisionAlgorithm::btSoftRigidCollisionAlgorithm;
  struct CreateFunc : btCollisionAlgorithmCreateFunc {
    btCollisionAlgorithm* CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info,
                                                   const btCollisionObjectWrapper* first,
                                                   const btCollisionObjectWrapper* second) override {
      void* const place = info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(OwnAlgorithm));
      return new (place) OwnAlgorithm(nullptr, info, first, second, m_swapped);
    }
  };
};

TEST(NotSaved, AreAlgorithmsOfOnesOwn) {
  BodyScene scene(WorldKind::softRigid);
  OwnAlgorithm::CreateFunc create;
  OwnAlgorithm::CreateFunc createSwapped;
  createSwapped.m_swapped = true;
  auto& dispatcher = static_cast<btCollisionDispatcher&>(*scene.world().getDispatcher());
  dispatcher.registerCollisionCreateFunc(SOFTBODY_SHAPE_PROXYTYPE, SPHERE_SHAPE_PROXYTYPE, &create);
  dispatcher.registerCollisionCreateFunc(SPHERE_SHAPE_PROXYTYPE, SOFTBODY_SHAPE_PROXYTYPE, &createSwapped);
  RigidBody sphere(scene.bullet(), std::make_unique<btSphereShape>(btScalar(0.2)), 0,
                   btVector3(btScalar(0.5), btScalar(-0.22), btScalar(0.5)));
  wetcloth::WetClothWorld wet(scene.world());
  EXPECT_EQ(refusal(wet), "");
  scene.bullet().step(1);
  expectRefused(wet, "algorithm that is not one of Bullet's");
}

// Bullet turns off a constraint that breaks, and a world built anew has it whole.
TEST(SavedConstraints, AreAsBrokenAsTheyWere) {
  const auto build = [](BodyScene& scene) {
    return std::make_unique<RigidBody>(scene.bullet(), std::make_unique<btSphereShape>(btScalar(0.2)), btScalar(1),
                                       btVector3(3, 0, 0));
  };
  BodyScene early(WorldKind::softRigid);
  const auto ball = build(early);
  btPoint2PointConstraint rope(ball->body(), btVector3(0, 1, 0));
  rope.setBreakingImpulseThreshold(btScalar(1e-4));
  early.world().addConstraint(&rope);
  BodyScene late(WorldKind::softRigid);
  const auto lateBall = build(late);
  btPoint2PointConstraint lateRope(lateBall->body(), btVector3(0, 1, 0));
  late.world().addConstraint(&lateRope);
  {
    wetcloth::WetClothWorld wet(early.world());
    wetcloth::WetClothWorld lateWet(late.world());
    early.bullet().step(3);
    ASSERT_FALSE(rope.isEnabled());
    std::istringstream stream(saved(wet));
    lateWet.restore(stream);
    EXPECT_FALSE(lateRope.isEnabled());
  }
  early.world().removeConstraint(&rope);
  late.world().removeConstraint(&lateRope);
}

}  // namespace
}  // namespace wetcloth_test::not_saved_test
