// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/bullet/PackedNodes.h"
#include "bullet_wetcloth/solver/NodeSlots.h"
#include "bullet_wetcloth/solver/SmallStep.h"

#include <BulletSoftBody/btSoftBody.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class StateArchive;

/// The nodes of a body in arrays, each in its slot, with places relative to an origin near the body.
///
/// In float32 a place 1 km from the world's origin is known to 0.06 mm, which is further than a node moves in a small
/// step: a cloth would stand still there. So places are kept relative, from step to step, and a node's own place is
/// only taken where somebody else has changed it.
///
/// Effects read and change the same arrays before the step.
class LocalNodes : public PackedNodes {
 public:
  /// For the nodes of this body, which must outlive it.
  explicit LocalNodes(btSoftBody& body) : PackedNodes(body, false) {}

  /// Makes room for the nodes in these slots, and forgets what was kept of them.
  void reset(const NodeSlots& slots);
  void fit() override {}
  void keep() override {}
  /// Takes over what the body's nodes say now, or what effects have made of it in this step. False when something of a
  /// node is not finite; badNode() is its number.
  bool take();
  int badNode() const { return m_badNode; }
  /// Whether free nodes were put elsewhere since this was asked last, by somebody else than write();
  /// or setPlaced() says so.
  void setPlaced() { m_arePlaced = true; }
  bool takePlaced() { return std::exchange(m_arePlaced, false); }
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

  int nodeCount() const { return static_cast<int>(m_slots.size()); }
  /// Those of all nodes.
  const int* slots() const { return m_slots.data(); }
  /// The node of each slot, -1: none.
  const int* nodesOfSlots() const { return m_nodeOfSlot.data(); }
  MovingNodes moving();

 protected:
  void readNodes() override;
  void writeVelocities() override;

 private:
  void centre();
  // What was seen of some nodes.
  struct Seen {
    bool areForced;
    bool arePlaced;
  };
  Seen readStretch(std::size_t begin, std::size_t end);
  void writeStretch(const Lane (&normals)[3], std::size_t begin, std::size_t end);
  void findPredictedIn(const btVector3& least, const btVector3& largest);
  btSoftBody::Node& showPrediction(int slot);
  void hidePredictions();
  bool isFinite() const;
  void findBadNode();

  std::vector<int> m_nodeOfSlot;
  Lane m_predicted[3];
  Lane m_force[3];
  Lane m_isNode;             // 1 where there is one, else 0
  std::vector<int> m_found;  // slots, by the last search
  std::vector<int> m_shown;  // nodes whose predictions the body shows
  bool m_hasForces = false;
  bool m_isNew = true;
  bool m_arePlaced = false;
  int m_badNode = -1;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
