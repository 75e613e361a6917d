// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletSoftBody/btSoftBody.h>

#include <functional>
#include <vector>

namespace viewer {

/// Two fingers that hold a cloth at a node and those linked to it, and pull them towards a goal. They pull through
/// velocities before Bullet predicts, as Bullet's own SoftDemo does, but with no more than some times the weight of
/// the cloth and no faster than a hand moves: what is let go flies no further than what a hand throws.
class Grip {
 public:
  /// Adds to a free node's velocity in a way that the body's world takes notice of.
  using Push = std::function<void(btSoftBody::Node&, const btVector3&)>;

  static constexpr double fastest = 5;        ///< that a hand moves [m/s]
  static constexpr double timesWeight = 3;    ///< that a hand pulls with
  static constexpr double usualGravity = 10;  ///< of the weight that limits the pull, whatever the scene's [m/s^2]

  Grip(btSoftBody& body, int node, Push push);

  /// @param goal of the node [m]
  void moveTo(const btVector3& goal) { m_goal = goal; }
  const btVector3& goal() const { return m_goal; }
  const btSoftBody::Node& node() const { return m_body.m_nodes[m_nodes.front().index]; }
  /// Before a substep of dt seconds.
  void pull(btScalar dt);

 private:
  struct Held {
    int index;
    btVector3 offset;  // from the node that was gripped [m]
  };

  btScalar mostVelocityChange(btScalar dt) const;

  btSoftBody& m_body;
  Push m_push;
  std::vector<Held> m_nodes;  // the gripped one first
  btVector3 m_goal;
};

}  // namespace viewer
