// SPDX-License-Identifier: Zlib
#pragma once

#include "command/stability/World.h"

#include "command/scene/BulletWorld.h"

#include <bullet_wetcloth/bullet_wetcloth.h>

#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace stability {

/// What physics allows in a scene. SI units.
struct Limits {
  /// Fastest thing that pushes: air, pins, rigid bodies, water, or the cloth itself at the start [m/s].
  double source = 0;
  double drop = 0;   ///< furthest that anything can fall [m]
  double force = 0;  ///< greatest force on a whole cloth, for the static stretch of springs of `stiffness` [N]
  /// How much faster one node may be than all: a free edge doubles the velocity of a wave that reaches it, and what
  /// layers have held against a pull lets go like a whip [-].
  double whip = 2;
  double stretch = 0.5;  ///< of a link, beyond what one step at full speed and the static stretch give [-]
  /// From here on nothing forces the cloth any more; at the end it must be at rest. Infinite: forced to the end [s].
  double calmFrom = std::numeric_limits<double>::infinity();
};

/// One run's Bullet world and what is in it, taken down in the right order.
class CaseScene {
 public:
  CaseScene(World world, Way way, double dt, const btVector3& gravity = btVector3(0, btScalar(-9.81), 0));
  CaseScene(const CaseScene&) = delete;
  CaseScene& operator=(const CaseScene&) = delete;

  World world() const { return m_world; }
  Way way() const { return m_way; }
  bool isOurs() const { return m_way == Way::ours; }
  bool isPlainBullet() const { return m_way == Way::plainBullet || m_way == Way::plainBulletWet; }
  bool isNaive() const { return m_way == Way::naive; }
  double dt() const { return m_dt; }
  double time() const { return m_steps * m_dt; }  ///< at the beginning of the step that is next [s]
  int steps() const { return m_steps; }
  double duration() const { return m_duration; }
  void setDuration(double duration) { m_duration = duration; }
  double gravity() const { return m_gravity; }  ///< its size at the beginning [m/s^2]
  Limits limits;
  int springIterations = 4;  ///< of HookeSprings that wet() adds: their own default

  // --- what a case builds -----------------------------------------------------------------------------------

  btSoftBodyWorldInfo& worldInfo() { return m_bullet->worldInfo(); }
  btDiscreteDynamicsWorld& bullet() { return m_bullet->world(); }
  /// Takes a body in. Its springs in the deformable worlds, Bullet's own or our HookeSprings, have this stiffness
  /// [N/m]; the position-based worlds have their links.
  btSoftBody& add(std::unique_ptr<btSoftBody> body, double stiffness);
  btSoftBody& add(const wetcloth::ClothPatch& patch, double stiffness) {
    return add(patch.build(worldInfo()), stiffness);
  }
  /// Lets cloths be found by rigid bodies node by node and, if asked, by each other.
  void collide(btSoftBody& body, bool withCloths = false);
  /// Makes a body of this scene wettable; null unless this is our way.
  wetcloth::WetCloth* wet(btSoftBody& body, const wetcloth::Fabric& fabric = wetcloth::Fabric::cotton());
  /// Counts what a body that nobody wets, and those added after it, pass through; null in plain Bullet.
  wetcloth::CollisionAudit* audit(btSoftBody& body);
  /// Of the cloths in this scene, from the next step on, if this is our way in World::softRigidGuard.
  void guardBy(const wetcloth::ClothSolver::Guard& guard);
  /// Null where Bullet's own solver steps the cloths.
  const wetcloth::ClothSolver* clothSolver() const { return m_bullet->clothSolver(); }
  /// The WetClothWorld; null unless this is our way.
  wetcloth::WetClothWorld* wetWorld() { return m_wetWorld; }
  /// A rigid body; a mass of 0 is a kinematic one, which the case moves by moveKinematic().
  btRigidBody& addRigid(std::unique_ptr<btCollisionShape> shape, double mass, const btVector3& position) {
    return m_bullet->addRigid(std::move(shape), mass, position);
  }
  /// A floor whose top is at this height.
  btRigidBody& addFloor(double height);
  /// Takes a soft body out of the Bullet world, and puts it back.
  void takeOut(btSoftBody& body);
  void putBack(btSoftBody& body);
  void setGravity(const btVector3& gravity);

  // --- the run ----------------------------------------------------------------------------------------------

  void substep() { m_bullet->substep(btScalar(m_dt)); }
  void countStep() { ++m_steps; }

  struct Cloth {
    btSoftBody* body;
    double stiffness;
    wetcloth::WetCloth* wet = nullptr;
    bool isInWorld = true;
    std::vector<double> restLengths = {};  ///< at the beginning [m], whatever becomes of the body's own
    double meanRestLength = 0;
  };
  std::vector<Cloth>& cloths() { return m_cloths; }
  /// To be called once all is built.
  void begin();

 private:
  Cloth& clothOf(const btSoftBody& body);

  World m_world;
  Way m_way;
  double m_dt;
  double m_gravity;
  double m_duration = 0;
  int m_steps = 0;
  std::unique_ptr<command::BulletWorld> m_bullet;
  std::vector<Cloth> m_cloths;
  wetcloth::WetClothWorld* m_wetWorld = nullptr;
};

/// Moves a kinematic body in the step that is next to where it shall be at its end, with the velocity that takes it
/// there.
void moveKinematic(btRigidBody& body, const btVector3& position, const btQuaternion& rotation, double dt);

}  // namespace stability
