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
/// used on a running body. This writes m_im and then everything that Bullet derived from it: the links' m_c0,
/// cluster masses and inertia, pose weights, the deformable world's anchors and mass preconditioner.
class WETCLOTH_EXPORT NodeMasses {
 public:
  NodeMasses(btSoftBody& body, bool deformable) : m_body(body), m_deformable(deformable) {}

  /// Takes over the body's present masses as known.
  void remember();

  /// Writes dry mass plus water into each free node, mixes the momentum of what arrived
  /// (v' = (m v + p) / (m + dm)), and refreshes Bullet's caches if a mass changed. A free node whose mass the
  /// application changed since the last commit takes that mass as its new dry mass; a node it pinned stays pinned.
  void commit(Water& water);

  /// The first part of a commit, for water that is to move on in the same step: mixes in the momentum of what arrived
  /// at a node so far. Masses follow with commit().
  void joinArrival(Water& water, std::size_t node);

  /// Recomputes what Bullet derived from node masses and link materials for each link, with the factors below.
  void refreshLinks();

  /// Scales the stiffness of each link, in the order of btSoftBody::m_links, without touching its material, which other
  /// bodies may share. Each factor finite and > 0; empty: none, and then all is as if this had never been called. Takes
  /// effect with the next commit() or refreshLinks(), and is left aside while there is not one factor per link.
  ///
  /// In a position-based world a factor above 1 raises a stiffness to 1 at most: from 2 on the links would explode.
  void setLinkStiffness(const std::vector<btScalar>& factors);
  const std::vector<btScalar>& linkStiffness() const { return m_linkStiffness; }
  /// Grows with every setLinkStiffness().
  unsigned long long linkStiffnessRevision() const { return m_linkStiffnessRevision; }

  void transferState(StateArchive& archive);

  /// How often masses and link constants were written: for tests that count work.
  long long commits() const { return m_commits; }
  long long linkRefreshes() const { return m_linkRefreshes; }

 private:
  bool writeNodes(Water& water);
  template <class InverseMassOf>
  void writeLinks(InverseMassOf inverseMassOf);
  void mixMomentum(btSoftBody::Node& node, const Water& water, std::size_t index) const;
  void refreshClusters();
  void refreshPose();
  void refreshDeformable();

  btSoftBody& m_body;
  bool m_deformable;
  std::vector<btScalar> m_inverseMass;  // what we last wrote, packed for the link loop
  std::vector<btScalar> m_linkStiffness;
  unsigned long long m_linkStiffnessRevision = 0;
  bool m_linksAreStale = false;
  long long m_commits = 0;
  long long m_linkRefreshes = 0;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
