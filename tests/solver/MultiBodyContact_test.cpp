// SPDX-License-Identifier: Zlib
// Cloths on the links of multibodies: what a cloth loses the multibody takes, by Newton's third law.

#include "bullet_wetcloth/solver/ClothSolver.h"
#include "tests/solver/SolverScene.h"
#include "tests/support/Measures.h"
#include "tests/support/RigidBody.h"

#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace wetcloth_test::multi_body_contact_test {
namespace {

constexpr double kMass = 0.3;  // of the link [kg]
const btVector3 kTable(btScalar(0.2), btScalar(0.05), btScalar(0.2));

// A multibody in a world: a base that stays, and one link with a box on it.
class Machine {
 public:
  enum class Joint { slides, turns };

  // The joint is at the origin: the link slides along a direction, or turns about the z axis, its box `away` along x.
  Machine(BulletWorld& bullet, Joint joint, const btVector3& halfExtents, double away = 0,
          const btVector3& direction = btVector3(0, 1, 0))
      : m_world(static_cast<btMultiBodyDynamicsWorld&>(bullet.world())), m_shape(halfExtents) {
    btVector3 inertia;
    m_shape.calculateLocalInertia(btScalar(kMass), inertia);
    const btVector3 arm(btScalar(away), 0, 0);
    const btQuaternion straight = btQuaternion::getIdentity();
    m_inertia = double(inertia.z()) + kMass * away * away;
    if (joint == Joint::slides) {
      m_body.setupPrismatic(0, btScalar(kMass), inertia, -1, straight, direction, btVector3(0, 0, 0), arm, true);
    } else {
      m_body.setupRevolute(0, btScalar(kMass), inertia, -1, straight, btVector3(0, 0, 1), btVector3(0, 0, 0), arm,
                           true);
    }
    m_body.finalizeMultiDof();
    m_body.setLinearDamping(0);
    m_body.setAngularDamping(0);
    m_collider.setCollisionShape(&m_shape);
    m_collider.setWorldTransform(btTransform(straight, arm));
    m_collider.setFriction(1);
    m_body.getLink(0).m_collider = &m_collider;
    m_world.addCollisionObject(&m_collider);
    m_world.addMultiBody(&m_body);
  }
  ~Machine() {
    m_world.removeMultiBody(&m_body);
    m_world.removeCollisionObject(&m_collider);
  }
  Machine(const Machine&) = delete;
  Machine& operator=(const Machine&) = delete;

  btMultiBody& body() { return m_body; }
  /// Of the joint [m/s] or [1/s].
  double velocity() const { return double(m_body.getJointVel(0)); }
  /// About the joint's axis [kg m^2].
  double inertia() const { return m_inertia; }

 private:
  btMultiBodyDynamicsWorld& m_world;
  btBoxShape m_shape;
  btMultiBody m_body{1, 0, btVector3(0, 0, 0), true, false};
  btMultiBodyLinkCollider m_collider{&m_body, 0};
  double m_inertia = 0;
};

btSoftBody& addCloth(SolverScene& scene, double x, double height) {
  wetcloth::ClothPatch patch = levelPatch(7, 0.3);
  patch.origin += btVector3(btScalar(x), btScalar(height), 0);
  btSoftBody& body = scene.add(patch);
  body.getCollisionShape()->setMargin(btScalar(0.01));
  return body;
}

TEST(MultiBodyContact, AClothAndALinkThatSlidesKeepTheirMomentum) {
  SolverScene scene(WorldKind::softMultiBody, kNoGravity);
  Machine machine(scene.bullet(), Machine::Joint::slides, kTable);
  btSoftBody& cloth = addCloth(scene, 0, 0.2);
  cloth.setVelocity(btVector3(0, -2, 0));
  const double before = momentum(cloth)[1];
  scene.step(60);
  const double common = before / (freeMass(cloth) + kMass);
  EXPECT_NEAR(momentum(cloth)[1] + kMass * machine.velocity(), before, 0.002 * std::fabs(before));
  EXPECT_NEAR(machine.velocity(), common, 0.02 * std::fabs(common)) << "a cloth does not bounce";
}

// About the axis, of the cloth's nodes [kg m^2/s].
double angularMomentum(const btSoftBody& cloth) {
  double sum = 0;
  for (int k = 0; k < cloth.m_nodes.size(); ++k) {
    const btSoftBody::Node& node = cloth.m_nodes[k];
    sum += double(node.m_x.cross(node.m_v).z()) / double(node.m_im);
  }
  return sum;
}

TEST(MultiBodyContact, AClothThatFallsOnALeverTurnsIt) {
  SolverScene scene(WorldKind::softMultiBody, kNoGravity);
  Machine machine(scene.bullet(), Machine::Joint::turns, kTable, 0.5);
  btSoftBody& cloth = addCloth(scene, 0.5, 0.1);
  cloth.setVelocity(btVector3(0, -1, 0));
  cloth.m_cfg.kDF = 1;
  const double before = angularMomentum(cloth);
  scene.step(12);
  double inertia = machine.inertia();
  for (int k = 0; k < cloth.m_nodes.size(); ++k) {
    inertia += double(cloth.m_nodes[k].m_x.length2()) / double(cloth.m_nodes[k].m_im);
  }
  const double common = before / inertia;
  EXPECT_NEAR(angularMomentum(cloth) + machine.inertia() * machine.velocity(), before, 0.01 * std::fabs(before));
  EXPECT_NEAR(machine.velocity(), common, 0.02 * std::fabs(common));
}

// A motor that lifts the weight of the link and of the cloth holds both: not of half a cloth, nor of two.
TEST(MultiBodyContact, ALinkFeelsTheWeightOfTheClothThatLiesOnIt) {
  SolverScene scene(WorldKind::softMultiBody);
  Machine machine(scene.bullet(), Machine::Joint::slides, kTable);
  btSoftBody& cloth = addCloth(scene, 0, 0.055);
  const double weight = 9.81 * freeMass(cloth);
  for (int step = 0; step < 120; ++step) {
    machine.body().addJointTorque(0, btScalar(9.81 * kMass + weight));
    scene.step(1);
  }
  // With a tenth of the cloth's weight felt too little or too much it would rise or fall by a tenth of it.
  const double oneTenth = 0.1 * weight / (kMass + freeMass(cloth)) * 2;
  EXPECT_LT(std::fabs(machine.velocity()), oneTenth);
  EXPECT_LT(largestSpeed(cloth), oneTenth + 0.05);
}

// A cloth at rest on a link that drives sideways comes up to its speed by friction, and slows it down by as much. In
// Bullet only velocities and impulses along the normal count.
TEST(MultiBodyContact, FrictionCarriesAClothAlong) {
  SolverScene scene(WorldKind::softMultiBody);
  Machine machine(scene.bullet(), Machine::Joint::slides, kTable, 0, btVector3(1, 0, 0));
  btSoftBody& cloth = addCloth(scene, 0, 0.055);
  cloth.m_cfg.kDF = 1;
  machine.body().setJointVel(0, btScalar(0.3));
  const double before = kMass * 0.3;
  scene.step(60);
  EXPECT_NEAR(momentum(cloth)[0] + kMass * machine.velocity(), before, 0.01 * before);
  EXPECT_NEAR(machine.velocity(), before / (freeMass(cloth) + kMass), 0.02 * machine.velocity());
}

}  // namespace
}  // namespace wetcloth_test::multi_body_contact_test
