// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BulletWorld.h"

#include <BulletSoftBody/btDeformableMassSpringForce.h>
#include <BulletSoftBody/btSoftBodyHelpers.h>

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace wetcloth_test {

/// Substep of the paper's fall test [s].
inline constexpr double kSubstep = 1.0 / 240;
/// A substep that float32 and float64 hold without rounding [s]. Bullet takes the step as float in some places, so
/// only with such a step can its motion be compared more closely than 1e-7.
inline constexpr double kExactSubstep = 1.0 / 256;

/// One cloth in a world of its own, taken down in the right order.
class ClothScene {
 public:
  using Builder = std::function<std::unique_ptr<btSoftBody>(btSoftBodyWorldInfo&)>;

  ClothScene(WorldKind kind, const btVector3& gravity, const Builder& builder,
             const wetcloth::Fabric& fabric = wetcloth::Fabric::cotton(), wetcloth::Hook hook = wetcloth::Hook::preTick)
      : m_bullet(kind, gravity), m_body(builder(m_bullet.info())) {
    // The deformable world puts slow bodies to sleep, which would stop what is measured.
    m_body->setActivationState(DISABLE_DEACTIVATION);
    m_bullet.add(*m_body);
    m_wet = std::make_unique<wetcloth::WetClothWorld>(m_bullet.world(), hook);
    m_cloth = &m_wet->add(*m_body, fabric);
  }
  ClothScene(WorldKind kind, const btVector3& gravity, const wetcloth::ClothPatch& patch,
             const wetcloth::Fabric& fabric = wetcloth::Fabric::cotton(), wetcloth::Hook hook = wetcloth::Hook::preTick)
      : ClothScene(
            kind, gravity, [&patch](btSoftBodyWorldInfo& info) { return patch.build(info); }, fabric, hook) {}
  ~ClothScene() {
    m_wet.reset();
    m_bullet.remove(*m_body);
  }
  ClothScene(const ClothScene&) = delete;
  ClothScene& operator=(const ClothScene&) = delete;

  BulletWorld& bullet() { return m_bullet; }
  btSoftBody& body() { return *m_body; }
  btSoftBody::Node& node(int i) { return m_body->m_nodes[i]; }
  wetcloth::WetClothWorld& wet() { return *m_wet; }
  wetcloth::WetCloth& cloth() { return *m_cloth; }

  /// Bullet's own springs, which a cloth in the deformable world needs: without them it is a cloud of triangles that
  /// the air crumples. Does nothing in the other worlds, whose links hold a cloth together.
  void addBulletSprings(double stiffness, double damping = 0) {
    if (!m_bullet.isDeformable()) return;
    m_bullet.addForce(*m_body, std::make_unique<btDeformableMassSpringForce>(btScalar(stiffness), btScalar(damping)));
  }
  /// The same, as stiff as explicit integration with this substep bears well.
  void addBulletSpringsForStep(double dt = kSubstep) { addBulletSprings(0.1 * freeMassPerNode() / (dt * dt)); }

  void step(int count, double dt = kSubstep) { m_bullet.step(count, btScalar(dt)); }
  /// Only our part of a substep, Bullet's left out; for Hook::manual.
  void preTick(double dt) { m_wet->preTick(btScalar(dt)); }

 private:
  double freeMassPerNode() const {
    double mass = 0;
    for (int i = 0; i < m_body->m_nodes.size(); ++i) {
      if (m_body->m_nodes[i].m_im > 0) mass += 1.0 / double(m_body->m_nodes[i].m_im);
    }
    return mass / m_body->m_nodes.size();
  }

  BulletWorld m_bullet;
  std::unique_ptr<btSoftBody> m_body;
  std::unique_ptr<wetcloth::WetClothWorld> m_wet;
  wetcloth::WetCloth* m_cloth = nullptr;
};

/// A square patch of n x n nodes in the plane y = 0, centred on the origin.
inline wetcloth::ClothPatch levelPatch(int n, double side, double arealDensity = 0.150) {
  wetcloth::ClothPatch patch;
  patch.columns = n;
  patch.rows = n;
  patch.origin = btVector3(btScalar(-side / 2), 0, btScalar(-side / 2));
  patch.edgeU = btVector3(btScalar(side), 0, 0);
  patch.edgeV = btVector3(0, 0, btScalar(side));
  patch.arealDensity = arealDensity;
  return patch;
}

/// `links` links that hang straight down from the origin, node 0 at the top and pinned; `mass` for each node [kg].
inline ClothScene::Builder hangingRope(int links, double linkLength, double mass, bool pinned = true) {
  return [=](btSoftBodyWorldInfo& info) {
    const btVector3 end(0, btScalar(-links * linkLength), 0);
    std::unique_ptr<btSoftBody> rope(
        btSoftBodyHelpers::CreateRope(info, btVector3(0, 0, 0), end, links - 1, pinned ? 1 : 0));
    for (int i = pinned ? 1 : 0; i < rope->m_nodes.size(); ++i) rope->setMass(i, btScalar(mass));
    // setMass() makes Bullet take the shape of the first step for the shape at rest; a test may stretch it before that.
    rope->updateConstants();
    rope->m_bUpdateRtCst = false;
    return rope;
  };
}

/// A body of these nodes, masses and triangles, without links.
inline ClothScene::Builder triangles(std::vector<btVector3> positions, std::vector<btScalar> masses,
                                     std::vector<std::array<int, 3>> faces) {
  return [=](btSoftBodyWorldInfo& info) {
    auto body =
        std::make_unique<btSoftBody>(&info, static_cast<int>(positions.size()), positions.data(), masses.data());
    for (const auto& face : faces) body->appendFace(face[0], face[1], face[2]);
    return body;
  };
}

/// Gives each node this velocity, in the way that each world takes notice of.
inline void setVelocity(btSoftBody& body, const btVector3& velocity) {
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    btSoftBody::Node& node = body.m_nodes[i];
    if (node.m_im == 0) continue;
    node.m_v = velocity;
    node.m_vn = velocity;
  }
}

/// Takes a share of all velocities away: lets a scene come to rest without changing where.
inline void damp(btSoftBody& body, double share) {
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    body.m_nodes[i].m_v *= btScalar(1 - share);
    body.m_nodes[i].m_vn *= btScalar(1 - share);
  }
}

/// Mass of the free nodes as Bullet sees it [kg].
inline double freeMass(const btSoftBody& body) {
  double mass = 0;
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    if (body.m_nodes[i].m_im > 0) mass += 1.0 / double(body.m_nodes[i].m_im);
  }
  return mass;
}

/// Momentum of the free nodes [kg m/s].
inline std::array<double, 3> momentum(const btSoftBody& body) {
  std::array<double, 3> sum = {0, 0, 0};
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    const btSoftBody::Node& node = body.m_nodes[i];
    if (node.m_im == 0) continue;
    for (int k = 0; k < 3; ++k) sum[std::size_t(k)] += double(node.m_v[k]) / double(node.m_im);
  }
  return sum;
}

/// Centre of mass of the free nodes [m].
inline std::array<double, 3> centreOfMass(const btSoftBody& body) {
  std::array<double, 3> sum = {0, 0, 0};
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    const btSoftBody::Node& node = body.m_nodes[i];
    if (node.m_im == 0) continue;
    for (int k = 0; k < 3; ++k) sum[std::size_t(k)] += double(node.m_x[k]) / double(node.m_im);
  }
  for (double& component : sum) component /= freeMass(body);
  return sum;
}

/// The text of the std::invalid_argument that `action` throws, "" when it throws nothing.
template <class Action>
std::string rejection(Action action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

}  // namespace wetcloth_test
