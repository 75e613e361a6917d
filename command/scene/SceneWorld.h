// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/BulletWorld.h"
#include "command/scene/Motion.h"
#include "command/scene/Scene.h"
#include "command/scene/Twist.h"

#include <functional>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace command {

/// A scene, ready to run.
class SceneWorld {
 public:
  /// The same scene with the library, or in Bullet alone: what it is compared with. There, Bullet's own solver steps
  /// the cloths, and those of the deformable world have Bullet's own springs, those with `hooke_springs`, too.
  enum class Kind { wet, plainBullet };

  /// Throws InputError naming the file and the JSON pointer when the library refuses a cloth or an effect.
  explicit SceneWorld(const Scene& scene, Kind kind = Kind::wet);

  /// Called before each substep with its length [s]: to push nodes, for instance.
  using BeforeSubstep = std::function<void(btScalar)>;

  /// One step of the scene, all its substeps; the scene's number of them may change from one step to the next.
  void step(const BeforeSubstep& before = {});
  /// After the last step: collision audits look at its last substep.
  void finish();

  /// Of the position solver and the contacts' solver, from the next step on. @param iterations >= 1
  void setIterations(int iterations);
  /// Goes on from where another world of the same scene is: its time, places and velocities, not its water.
  void continueFrom(const SceneWorld& other);

  /// What the wet world is in now, to go on from it in another run of the same scene. Throws wetcloth::StateError as
  /// wetcloth::WetClothWorld::save() and restore() do.
  void save(std::ostream& stream) const;
  void restore(std::istream& stream, int steps);

  const Scene& scene() const { return m_scene; }
  /// Simulated [s].
  double time() const { return m_steps * m_scene.step; }
  int steps() const { return m_steps; }  ///< of the scene, since its start
  const std::vector<btSoftBody*>& bodies() const { return m_bodies; }
  /// The wet cloths, in the order of the scene; none in plain Bullet.
  const std::vector<wetcloth::WetCloth*>& cloths() const { return m_cloths; }
  /// Null where the scene asks for none, and in plain Bullet.
  const wetcloth::Drops* drops() const { return m_drops.get(); }
  const std::vector<wetcloth::CollisionAudit*>& audits() const { return m_audits; }
  const Colliders& colliders() const { return m_colliders; }
  /// Water on a collider, by its place in the scene: films that the cloths' effects know of, and where drops landed
  /// [kg].
  double filmOn(std::size_t collider) const;
  /// Bullet's own springs of each cloth; none outside the deformable world, or where `hooke_springs` hold a wet cloth.
  const std::vector<std::optional<DeformableSprings>>& springs() const { return m_springs; }
  /// Null: Bullet's own solver steps the cloths.
  wetcloth::ClothSolver* clothSolver() { return m_world.clothSolver(); }
  const wetcloth::ClothSolver* clothSolver() const { return m_world.clothSolver(); }
  /// Whether all positions and velocities are finite.
  bool isFinite() const;
  /// "/cloths/0: node 7 moves with ...": what of the cloths has blown up; none while all are sound.
  /// @param otherPush  of what pushes the cloths and is not in the scene [m/s]
  std::optional<std::string> blowUp(double otherPush = 0) const;

 private:
  bool isInReach() const;
  void addCloth(std::size_t index, Kind kind);
  wetcloth::WetCloth& wet(const ClothScene& cloth, btSoftBody& body) const;
  void settle();
  void addFaceTree(btSoftBody& body) const;
  double substep() const { return m_scene.step / m_scene.substeps; }
  double sagOf(std::size_t cloth) const;
  void addEffects(std::size_t index, wetcloth::WetCloth& wet);
  void addWater(const WaterScene& water);
  void addDrops(const DropsScene& scene);
  void addCollider(const Collider& collider);
  void moveColliders(double time);
  void placeColliders();

  struct Moving {
    btRigidBody* body;
    const Collider* collider;
    btTransform rest;
  };

  const Scene& m_scene;
  BulletWorld m_world;
  wetcloth::WetClothWorld* m_wetWorld = nullptr;  // null in plain Bullet
  std::unique_ptr<wetcloth::Drops> m_drops;
  std::vector<btSoftBody*> m_bodies;
  std::vector<std::optional<DeformableSprings>> m_springs;
  std::vector<wetcloth::WetCloth*> m_cloths;
  std::vector<wetcloth::CollisionAudit*> m_audits;
  Colliders m_colliders;
  std::vector<Moving> m_moving;
  std::vector<Twist> m_twists;
  std::vector<Motion> m_motions;
  int m_steps = 0;
};

}  // namespace command
