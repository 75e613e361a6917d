// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/water/Water.h"

#include <BulletSoftBody/btSoftBody.h>

#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class StateArchive;

/// The one writer of node masses.
///
/// btSoftBody::setMass() makes the next step reset every rest length to the deformed length, so it must never be
/// used on a running body. This writes m_im and then what Bullet derived from it: cluster masses and inertia, pose
/// weights, the deformable world's anchors and mass preconditioner. The links' constants are LinkConstants' to write.
class WETCLOTH_EXPORT NodeMasses {
 public:
  /// For the nodes of this body, which must outlive it; `deformable` in that world of Bullet.
  NodeMasses(btSoftBody& body, bool deformable) : m_body(body), m_deformable(deformable) {}

  /// Takes over the body's present masses as known.
  void remember();

  /// Whether the application seems to have set masses since the last commit. What setMass() and its like leave behind
  /// tells at once, until Bullet's next step; of masses that were written by hand a part is looked at, another one in
  /// each call, and all within 32 calls.
  bool seemSet();
  /// The same for certain: looks at all nodes.
  bool wereSet() const;
  /// Looks at all nodes for masses that the application set: each is that node's new dry mass, and its water stays. The
  /// dry masses of pinned nodes, which Bullet does not keep, change in proportion to those of the free ones together,
  /// as if the cloth had been added with them. Returns whether there was one and the cloth holds water, so that masses
  /// must be committed.
  bool takeOver(Water& water);

  /// Whether a commit would change a free node's mass by more than this share, or what arrived there is more; with 0
  /// always.
  bool areDue(const Water& water, double tolerance) const;
  /// Writes dry mass plus water into each free node, mixes the momentum of what arrived
  /// (v' = (m v + p) / (m + dm)), and refreshes Bullet's caches if a mass changed, which it returns: then the links'
  /// constants are out of date. Takes over what the application set; a node it pinned stays pinned.
  bool commit(Water& water);

  /// The first part of a commit, for water that is to move on in the same step: mixes in the momentum of what arrived
  /// at a node so far. Masses follow with commit().
  void joinArrival(Water& water, std::size_t node);

  /// As last written or remembered, one per node [1/kg].
  const std::vector<btScalar>& inverseMasses() const { return m_inverseMass; }

  /// Names what goes on from step to step: see StateArchive.
  void transferState(StateArchive& archive);

  /// How often masses were written: for tests that count work.
  long long commits() const { return m_commits; }

 private:
  bool writeNodes(Water& water);
  void scalePinned(Water& water, double factor) const;
  void mixMomentum(btSoftBody::Node& node, const Water& water, std::size_t index) const;
  void refreshClusters();
  void refreshPose();
  void refreshDeformable();

  btSoftBody& m_body;
  bool m_deformable;
  std::vector<btScalar> m_inverseMass;  // what we last wrote
  std::size_t m_nextNode = 0;           // to look at
  long long m_commits = 0;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
