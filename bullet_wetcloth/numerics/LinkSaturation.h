// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <BulletSoftBody/btSoftBody.h>

#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class StateArchive;
class Water;

/// The saturation of each link of a cloth: the mean of its two nodes', each in [0, 1]; a node that was filled above its
/// capacity counts as saturated. A member of effects whose law depends on it.
///
/// While water moves the values lag behind by at most a tolerance, so that a slow change costs little; once a step has
/// passed in which no water moved they are exact. So they depend on the water alone, not on how it came there.
class WETCLOTH_EXPORT LinkSaturation {
 public:
  /// @param tolerance  how far a value may lag behind while water moves [-]
  explicit LinkSaturation(double tolerance) : m_tolerance(tolerance) {}

  /// Takes over the body's links, and the water as it is. O(links).
  void reset(const btSoftBody& body, const Water& water);

  /// Whether a value changed. Visits no link while none does, and no node while no water moves.
  bool update(const Water& water);

  /// Names what goes on from step to step: see StateArchive.
  void transferState(StateArchive& archive);

  /// Number of links.
  std::size_t size() const { return m_links.size(); }
  /// The nodes of a link.
  struct Ends {
    std::size_t a;  ///< in btSoftBody::m_nodes
    std::size_t b;  ///< in btSoftBody::m_nodes
  };
  /// Those of a link.
  const Ends& ends(std::size_t link) const { return m_links[link]; }
  /// Of a link, in [0, 1].
  double operator[](std::size_t link) const {
    return (m_saturation[m_links[link].a] + m_saturation[m_links[link].b]) / 2;
  }

 private:
  double largestChange(const Water& water) const;
  void take(const Water& water);

  double m_tolerance;
  std::vector<Ends> m_links;
  std::vector<double> m_saturation;  // of each node, as last taken
  unsigned long long m_revision = 0;
  bool m_lags = false;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
