// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <BulletSoftBody/btSoftBody.h>

#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class StateArchive;

/// The one writer of what Bullet derives for each link from its nodes' masses and its stiffness, Link::m_c0: the sum of
/// the two inverse masses over the link's stiffness [1/kg], by which the position-based worlds correct its length.
///
/// The stiffness is that of the link's material times a factor of the link's own, 1 at first.
class WETCLOTH_EXPORT LinkConstants {
 public:
  /// For the links of this body, which must outlive it.
  explicit LinkConstants(btSoftBody& body) : m_body(body) {}

  /// Writes the constants of all links, with the masses that the nodes have now.
  void refresh();
  /// The same with these inverse masses [1/kg], one per node: faster, since the nodes are several cache lines each.
  void refresh(const std::vector<btScalar>& inverseMasses);

  /// Scales the stiffness of each link, in the order of btSoftBody::m_links, without touching its material, which other
  /// bodies may share. Each factor finite and > 0; empty: none, and then all is as if this had never been called. Takes
  /// effect with the step's commit or with refresh(), and is left aside while there is not one factor per link.
  ///
  /// In a position-based world a factor above 1 raises a stiffness to 1 at most: from 2 on the links would explode.
  void setStiffness(const std::vector<btScalar>& factors);
  /// As last set.
  const std::vector<btScalar>& stiffness() const { return m_stiffness; }
  /// Grows with every setStiffness().
  unsigned long long stiffnessRevision() const { return m_stiffnessRevision; }
  /// Whether setStiffness() waits for a refresh().
  bool areStale() const { return m_areStale; }

  /// Names what goes on from step to step: see StateArchive.
  void transferState(StateArchive& archive);

  /// How often all were written: for tests that count work.
  long long refreshes() const { return m_refreshes; }

 private:
  template <class InverseMassOf>
  void write(InverseMassOf inverseMassOf);

  btSoftBody& m_body;
  std::vector<btScalar> m_stiffness;
  unsigned long long m_stiffnessRevision = 0;
  bool m_areStale = false;
  long long m_refreshes = 0;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
