// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/solver/NodeSlots.h"
#include "bullet_wetcloth/solver/SmallStep.h"

#include <BulletSoftBody/btSoftBody.h>

#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class StateArchive;

/// The nodes of a body in arrays, each in its slot, with places relative to an origin near the body.
///
/// In float32 a place 1 km from the world's origin is known to 0.06 mm, which is further than a node moves in a small
/// step: a cloth would stand still there. So places are kept relative, from step to step, and a node's own place is
/// only taken where somebody else has changed it.
class LocalNodes {
 public:
  /// Arrays are longer than there are slots by this, so that loops may work in blocks of this size.
  static constexpr std::size_t kPadding = 64;
  using Lane = std::vector<btScalar>;

  /// For the nodes of this body, which must outlive it.
  explicit LocalNodes(btSoftBody& body) : m_body(body) {}

  /// Makes room for the nodes in these slots, and forgets what was kept of them.
  void reset(const NodeSlots& slots);
  /// Takes over what the body's nodes say now. False when something of a node is not finite; badNode() is its number.
  bool read();
  int badNode() const { return m_badNode; }
  /// Writes into the body's nodes what a step has made of them; places from before the step become m_q.
  void write(const Lane (&normals)[3]);

  /// Where nodes will be after dt [s], as far as links and contacts let them: kept until the first small step.
  void predict(btScalar dt, const btVector3& gravity, btScalar largestPush);
  /// The box of these places [m].
  void predictedBounds(btVector3& least, btVector3& largest) const;
  /// Calls action(node) for the nodes that are predicted to be in this box, after m_q and m_x of the body's node are
  /// set to where it is and to where it is predicted to be, as Bullet's detection wants them.
  template <class Action>
  void forEachPredictedIn(const btVector3& least, const btVector3& largest, Action action) {
    findPredictedIn(least, largest);
    for (const int slot : m_found) action(showPrediction(slot));
  }

  /// Names what goes on from step to step: see StateArchive.
  void transferState(StateArchive& archive);

  std::size_t slot(int node) const { return static_cast<std::size_t>(m_slots[static_cast<std::size_t>(node)]); }
  /// Those of all nodes.
  const int* slots() const { return m_slots.data(); }
  /// Where the arrays' places are relative to [m].
  const btVector3& origin() const { return m_origin; }
  btVector3 position(std::size_t slot) const {
    return btVector3(m_position[0][slot], m_position[1][slot], m_position[2][slot]);
  }

  MovingNodes moving();

 private:
  void centre();
  void findPredictedIn(const btVector3& least, const btVector3& largest);
  btSoftBody::Node& showPrediction(int slot);
  void hidePredictions();
  bool isFinite() const;
  void findBadNode();

  btSoftBody& m_body;
  std::vector<int> m_slots;
  std::vector<int> m_nodeOfSlot;
  std::size_t m_count = 0;
  btVector3 m_origin = btVector3(0, 0, 0);
  Lane m_position[3];
  Lane m_predicted[3];
  Lane m_velocity[3];
  Lane m_force[3];
  Lane m_inverseMass;
  Lane m_isNode;             // 1 where there is one, else 0
  std::vector<int> m_found;  // slots, by the last search
  std::vector<int> m_shown;  // nodes whose predictions the body shows
  bool m_hasForces = false;
  bool m_isNew = true;
  int m_badNode = -1;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
