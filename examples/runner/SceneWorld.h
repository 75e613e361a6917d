#pragma once

#include "BulletWorld.h"
#include "FallingDrops.h"
#include "Motion.h"
#include "Scene.h"
#include "Twist.h"

#include <memory>
#include <vector>

namespace runner {

/// A scene, ready to run.
class SceneWorld {
 public:
  /// The same scene with the library, or in Bullet alone: what it is compared with.
  enum class Kind { wet, plainBullet };

  /// Throws InputError naming the file and the JSON pointer when the library refuses a cloth or an effect.
  explicit SceneWorld(const Scene& scene, Kind kind = Kind::wet);

  /// One step of the scene, all its substeps.
  void step();
  /// After the last step: collision audits look at its last substep.
  void finish();

  const Scene& scene() const { return m_scene; }
  const std::vector<btSoftBody*>& bodies() const { return m_bodies; }
  /// The wet cloths, in the order of the scene; none in plain Bullet.
  const std::vector<wetcloth::WetCloth*>& cloths() const { return m_cloths; }
  const FallingDrops& drops() const { return m_drops; }
  const std::vector<wetcloth::CollisionAudit*>& audits() const { return m_audits; }
  /// Whether all positions and velocities are finite.
  bool isFinite() const;

 private:
  void addCloth(const ClothScene& cloth);
  void addEffects(std::size_t index, wetcloth::WetCloth& wet);
  void addWater(const WaterScene& water);
  void addCollider(const Collider& collider);

  const Scene& m_scene;
  BulletWorld m_world;
  FallingDrops m_drops;                                 // before the effects that it follows
  std::unique_ptr<wetcloth::WetClothWorld> m_wetWorld;  // after the world: it detaches before the world goes
  std::vector<btSoftBody*> m_bodies;
  std::vector<wetcloth::WetCloth*> m_cloths;
  std::vector<wetcloth::CollisionAudit*> m_audits;
  Colliders m_colliders;
  std::vector<Twist> m_twists;
  std::vector<Motion> m_motions;
  int m_substeps = 0;
};

}  // namespace runner
