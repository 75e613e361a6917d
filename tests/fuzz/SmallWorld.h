// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "bullet_wetcloth/state/StateEnvelope.h"
#include "tests/support/BodyScene.h"
#include "tests/support/RigidBody.h"

#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace fuzz {

/// Nine nodes that hang over a plane and a sphere on which a dumbbell lies, with effects of every kind of state, after
/// some steps; moved by Bullet, or by ClothSolver with a guard.
class SmallWorld {
 public:
  enum class MovedBy { bullet, guardedSolver };

  explicit SmallWorld(MovedBy mover) : m_mover(mover) {
    m_wet = std::make_unique<wetcloth::WetClothWorld>(m_scene.world());
    wetcloth::WetCloth& cloth = m_wet->add(m_scene.body());
    cloth.add<wetcloth::Absorption>();
    cloth.add<wetcloth::Diffusion>();
    cloth.add<wetcloth::Dripping>();
    cloth.add<wetcloth::HookeSprings>();
    cloth.add<wetcloth::WetStiffness>();
    cloth.add<wetcloth::Swelling>();
    cloth.add<wetcloth::Cling>();
    cloth.add<wetcloth::Wind>({btVector3(1, 0, 0)});
    cloth.add<wetcloth::CollisionAudit>();
    wetcloth::Pour pour;
    pour.position = btVector3(btScalar(0.5), 1, btScalar(0.5));
    m_drops = std::make_unique<wetcloth::Drops>(*m_wet);
    m_drops->add(pour);
    m_drops->add(wetcloth::Glass());
    m_scene.bullet().step(30);
    m_start = saved();
  }
  SmallWorld(const SmallWorld&) = delete;
  SmallWorld& operator=(const SmallWorld&) = delete;

  const std::string& start() const { return m_start; }
  std::string saved() const {
    std::ostringstream stream;
    m_wet->save(stream);
    return stream.str();
  }
  void restore(const std::string& state) {
    std::istringstream stream(state);
    m_wet->restore(stream);
  }
  /// These bytes as a stream that is not refused for its envelope.
  std::string wrapped(const std::string& bytes) {
    std::ostringstream stream;
    wetcloth::StateEnvelope::write(stream, static_cast<std::uint32_t>(m_scene.world().getWorldType()),
                                   std::vector<unsigned char>(bytes.begin(), bytes.end()));
    return stream.str();
  }

 private:
  static wetcloth::ClothSolver::Parameters guarded() {
    wetcloth::ClothSolver::Parameters parameters;
    parameters.guard.emplace();
    parameters.guard->bodies = true;
    return parameters;
  }
  static wetcloth::ClothPatch patch() {
    wetcloth::ClothPatch patch = wetcloth_test::squarePatch(3);
    patch.pinnedEdges = {wetcloth::ClothPatch::Edge::top};
    return patch;
  }
  std::unique_ptr<btCollisionShape> dumbbell() {
    auto shape = std::make_unique<btCompoundShape>();
    for (const double side : {-0.1, 0.1}) {
      shape->addChildShape(btTransform(btQuaternion::getIdentity(), btVector3(btScalar(side), 0, 0)), &m_end);
    }
    return shape;
  }

  MovedBy m_mover;
  wetcloth::ClothSolver m_solver{guarded()};
  wetcloth_test::BodyScene m_scene{wetcloth_test::WorldKind::softRigid,
                                   [](btSoftBodyWorldInfo& info) { return patch().build(info); },
                                   wetcloth_test::kEarthGravity, m_mover == MovedBy::bullet ? nullptr : &m_solver};
  wetcloth_test::RigidBody m_sphere{m_scene.bullet(), std::make_unique<btSphereShape>(btScalar(0.3)), 0,
                                    btVector3(btScalar(0.5), btScalar(-0.2), btScalar(0.5))};
  wetcloth_test::RigidBody m_ground{m_scene.bullet(),
                                    std::make_unique<btStaticPlaneShape>(btVector3(0, 1, 0), btScalar(-0.5)), 0,
                                    btVector3(0, 0, 0)};
  btSphereShape m_end{btScalar(0.05)};  // of the dumbbell
  wetcloth_test::RigidBody m_dumbbell{m_scene.bullet(), dumbbell(), btScalar(0.1),
                                      btVector3(btScalar(0.5), btScalar(0.14), btScalar(0.5))};
  std::unique_ptr<wetcloth::WetClothWorld> m_wet;
  std::unique_ptr<wetcloth::Drops> m_drops;
  std::string m_start;
};

}  // namespace fuzz
