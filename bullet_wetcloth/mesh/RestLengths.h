// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <BulletSoftBody/btSoftBody.h>

#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class StateArchive;

/// The rest lengths of a body's links, Link::m_rl: what they are without the changes of the cloth's own effects, and
/// whether somebody else has changed them, as btSoftBody::scale() does.
class WETCLOTH_EXPORT RestLengths {
 public:
  /// Of this body, which must outlive it.
  explicit RestLengths(const btSoftBody& body) : m_body(body) {}

  /// Takes the lengths as they are now for known. Until the first time nothing is watched.
  void remember();
  /// Says that an effect has given a link this length [m], `factor` times the one that it has by itself (> 0): not a
  /// new shape at rest, but the old one, swollen.
  void note(std::size_t link, btScalar length, double factor);

  /// Of a link, without what was noted [m].
  double natural(std::size_t link) const;

  /// Whether somebody else has changed lengths by more than rounding. Looks at a 32nd of the links in each call,
  /// another one each time, and after a remember() that followed a change not in the next 32 calls: an application that
  /// transforms a running body, by which Bullet resets its rest lengths, in every step is followed once in 32.
  bool haveChanged();

  /// Names what goes on from step to step: see StateArchive.
  void transferState(StateArchive& archive);

 private:
  const btSoftBody& m_body;
  std::vector<btScalar> m_known;
  std::vector<double> m_factors;  // empty: 1
  std::size_t m_nextLink = 0;     // to look at
  int m_pause = 0;                // calls that do not look
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
