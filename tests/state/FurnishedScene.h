// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyScene.h"
#include "tests/support/BodyState.h"
#include "tests/support/ContactScene.h"
#include "tests/support/RigidBody.h"

#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace wetcloth_test::state_scene {

/// A cloth with a pose, clusters, and anchors to a box, above a body that is not a rigid one: but for the deformable
/// worlds, where impulses of such a one are what the stack happens to hold.
class FurnishedScene {
 public:
  explicit FurnishedScene(WorldKind kind) : m_scene(kind) {
    btSoftBody& body = m_scene.body();
    body.m_cfg.collisions = contactFlags(kind);
    body.setPose(false, true);
    body.generateClusters(4);
    if (m_scene.bullet().isDeformable()) {
      for (const int node : {3, 7}) body.appendDeformableAnchor(node, &m_box.body());
    } else {
      for (const int node : {3, 7}) body.appendAnchor(node, &m_box.body());
    }
    if (m_scene.bullet().isDeformable()) {
      m_below = std::make_unique<btRigidBody>(btScalar(0), nullptr, &m_sphere);
    } else {
      m_below = std::make_unique<btCollisionObject>();
      m_below->setCollisionShape(&m_sphere);
    }
    m_below->getWorldTransform().setOrigin(btVector3(btScalar(0.5), btScalar(-0.22), btScalar(0.5)));
    m_scene.world().addCollisionObject(m_below.get());
    m_wet = std::make_unique<wetcloth::WetClothWorld>(m_scene.world());
    m_wet->setLog(nullptr);
    m_wet->add(body);
  }
  ~FurnishedScene() {
    m_wet.reset();
    m_scene.world().removeCollisionObject(m_below.get());
  }
  FurnishedScene(const FurnishedScene&) = delete;
  FurnishedScene& operator=(const FurnishedScene&) = delete;

  void step(int count) { m_scene.bullet().step(count); }
  std::vector<btScalar> look() { return stateOf(m_scene.body()); }
  void restore(const std::string& state) {
    std::istringstream stream(state);
    m_wet->restore(stream);
  }
  std::string saved() const {
    std::ostringstream stream;
    m_wet->save(stream);
    return stream.str();
  }

 private:
  BodyScene m_scene;
  RigidBody m_box{m_scene.bullet(), box(0.1, 0.1, 0.1), btScalar(0.2), btVector3(btScalar(-0.2), 0, btScalar(0.6))};
  btSphereShape m_sphere{btScalar(0.2)};
  std::unique_ptr<btCollisionObject> m_below;
  std::unique_ptr<wetcloth::WetClothWorld> m_wet;
};

}  // namespace wetcloth_test::state_scene
