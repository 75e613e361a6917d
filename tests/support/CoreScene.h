// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BulletWorld.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace wetcloth_test {

/// A level square of 1 m x 1 m, n x n nodes.
inline wetcloth::ClothPatch squarePatch(int n) {
  wetcloth::ClothPatch patch;
  patch.columns = n;
  patch.rows = n;
  return patch;
}

/// An upright square of 1 m x 1 m, n x n nodes, pinned along its top edge.
inline wetcloth::ClothPatch hangingPatch(int n) {
  wetcloth::ClothPatch patch = squarePatch(n);
  patch.edgeV = btVector3(0, 1, 0);
  patch.pinnedEdges = {wetcloth::ClothPatch::Edge::top};
  return patch;
}

/// An upright square across the z axis, free, for wind along z.
inline wetcloth::ClothPatch sailPatch(int n) {
  wetcloth::ClothPatch patch = hangingPatch(n);
  patch.pinnedEdges.clear();
  return patch;
}

/// A Bullet world with one body in it, taken out before both are destroyed.
class CoreScene {
 public:
  using Maker = std::function<std::unique_ptr<btSoftBody>(btSoftBodyWorldInfo&)>;

  explicit CoreScene(WorldKind kind, const wetcloth::ClothPatch& patch = squarePatch(5),
                     const btVector3& gravity = kEarthGravity)
      : bullet(kind, gravity), m_body(patch.build(bullet.info())) {
    bullet.add(*m_body);
  }
  CoreScene(WorldKind kind, const Maker& make, const btVector3& gravity = kEarthGravity)
      : bullet(kind, gravity), m_body(make(bullet.info())) {
    bullet.add(*m_body);
  }
  ~CoreScene() {
    if (m_body != nullptr) bullet.remove(*m_body);
  }
  CoreScene(const CoreScene&) = delete;
  CoreScene& operator=(const CoreScene&) = delete;

  btSoftBody& body() { return *m_body; }
  btDiscreteDynamicsWorld& world() { return bullet.world(); }

  /// Takes the body out of the world and deletes it.
  void deleteBody() {
    bullet.remove(*m_body);
    m_body.reset();
  }

  /// Bullet's own springs, without which a cloth of the deformable world is a cloud of particles. Nothing in the
  /// other worlds.
  void addDeformableSprings(double stiffness, double damping) {
    if (!bullet.isDeformable()) return;
    bullet.addForce(*m_body,
                    std::make_unique<btDeformableMassSpringForce>(btScalar(stiffness), btScalar(damping), false));
  }

  BulletWorld bullet;

 private:
  std::unique_ptr<btSoftBody> m_body;
};

/// A rigid body in a world, taken out before it is destroyed.
class RigidBody {
 public:
  RigidBody(BulletWorld& bullet, std::unique_ptr<btCollisionShape> shape, btScalar mass, const btVector3& position)
      : m_bullet(bullet), m_shape(std::move(shape)) {
    btVector3 inertia(0, 0, 0);
    if (mass > 0) m_shape->calculateLocalInertia(mass, inertia);
    btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, m_shape.get(), inertia);
    info.m_startWorldTransform.setIdentity();
    info.m_startWorldTransform.setOrigin(position);
    m_body = std::make_unique<btRigidBody>(info);
    m_bullet.world().addRigidBody(m_body.get());
  }
  ~RigidBody() { m_bullet.world().removeRigidBody(m_body.get()); }
  RigidBody(const RigidBody&) = delete;
  RigidBody& operator=(const RigidBody&) = delete;

  btRigidBody& body() { return *m_body; }

 private:
  BulletWorld& m_bullet;
  std::unique_ptr<btCollisionShape> m_shape;
  std::unique_ptr<btRigidBody> m_body;
};

/// Positions and velocities of all nodes, the numbers themselves.
inline std::vector<btScalar> stateOf(const btSoftBody& body) {
  std::vector<btScalar> state;
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      state.push_back(body.m_nodes[i].m_x[axis]);
      state.push_back(body.m_nodes[i].m_v[axis]);
    }
  }
  return state;
}

/// Bit for bit, so that -0 and 0 differ and a NaN equals itself.
inline bool sameBits(const std::vector<btScalar>& a, const std::vector<btScalar>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(btScalar)) == 0);
}

inline double largestDifference(const std::vector<btScalar>& a, const std::vector<btScalar>& b) {
  if (a.size() != b.size()) return HUGE_VAL;
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double difference = std::fabs(double(a[i]) - double(b[i]));
    if (!(difference <= largest)) largest = difference;
  }
  return largest;
}

inline bool isFinite(const btSoftBody& body) {
  const std::vector<btScalar> state = stateOf(body);
  return std::all_of(state.begin(), state.end(), [](btScalar value) { return std::isfinite(value); });
}

/// Of any node [m/s]; NaN counts as infinite.
inline double largestSpeed(const btSoftBody& body) {
  double largest = 0;
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    const double speed = double(body.m_nodes[i].m_v.length());
    if (!(speed <= largest)) largest = std::isfinite(speed) ? speed : HUGE_VAL;
  }
  return largest;
}

/// Unweighted mean of the nodes' positions and velocities.
inline btVector3 meanPosition(const btSoftBody& body) {
  btVector3 sum(0, 0, 0);
  for (int i = 0; i < body.m_nodes.size(); ++i) sum += body.m_nodes[i].m_x;
  return sum / btScalar(body.m_nodes.size());
}
inline btVector3 meanVelocity(const btSoftBody& body) {
  btVector3 sum(0, 0, 0);
  for (int i = 0; i < body.m_nodes.size(); ++i) sum += body.m_nodes[i].m_v;
  return sum / btScalar(body.m_nodes.size());
}

/// Sum over links of length and of rest length [m].
inline double totalLength(const btSoftBody& body) {
  double sum = 0;
  for (int i = 0; i < body.m_links.size(); ++i) {
    const btSoftBody::Link& link = body.m_links[i];
    sum += double((link.m_n[0]->m_x - link.m_n[1]->m_x).length());
  }
  return sum;
}
inline double totalRestLength(const btSoftBody& body) {
  double sum = 0;
  for (int i = 0; i < body.m_links.size(); ++i) sum += double(body.m_links[i].m_rl);
  return sum;
}

/// A fabric that holds `capacity` times its dry mass and fills with this time constant [s].
inline wetcloth::Fabric fabricOf(double capacity, double timeConstant) {
  wetcloth::Fabric fabric;
  fabric.capacity = capacity;
  fabric.timeConstant = timeConstant;
  return fabric;
}

/// Springs of these stiffnesses [N/m].
inline wetcloth::HookeSprings::Parameters springsOf(double stiffness, double bendingStiffness = 10) {
  wetcloth::HookeSprings::Parameters springs;
  springs.stiffness = stiffness;
  springs.bendingStiffness = bendingStiffness;
  return springs;
}

/// Water [kg] that differs from node to node, up to 5 times the dry mass.
inline std::vector<double> unevenWater(const wetcloth::WetCloth& cloth) {
  std::vector<double> water;
  for (int i = 0; i < cloth.nodeCount(); ++i) water.push_back(cloth.dryMass(i) * (i % 6));
  return water;
}

/// Gives the free nodes of a body the masses that wet ones have: the dry mass plus unevenWater(). To compare with a
/// wetted body, call it before the body gets clusters, a pose or anchors.
inline void makeUnevenlyHeavy(btSoftBody& body) {
  for (int i = 0; i < body.m_nodes.size(); ++i) body.m_nodes[i].m_im /= btScalar(1 + i % 6);
  body.updateLinkConstants();
}

/// Calls `function` once per substep, as an effect of the application's own.
class Call : public wetcloth::Effect {
 public:
  using Function = std::function<void(wetcloth::WetCloth&, const wetcloth::Step&)>;
  explicit Call(Function function, wetcloth::Stage stage = wetcloth::Stage::forces)
      : m_function(std::move(function)), m_stage(stage) {}
  const char* name() const override { return "Call"; }
  wetcloth::Stage stage() const override { return m_stage; }
  void apply(wetcloth::WetCloth& cloth, const wetcloth::Step& step) override { m_function(cloth, step); }

 private:
  Function m_function;
  wetcloth::Stage m_stage;
};

inline wetcloth::Effect& addCall(wetcloth::WetCloth& cloth, Call::Function function,
                                 wetcloth::Stage stage = wetcloth::Stage::forces) {
  return cloth.add(std::make_unique<Call>(std::move(function), stage));
}

}  // namespace wetcloth_test
