// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/solver/LocalNodes.h"
#include "bullet_wetcloth/solver/SmallStep.h"

#include <BulletSoftBody/btSoftBody.h>

#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Nodes that get no further from their nearest pins than along the cloth at rest (long range attachments; Kim et al.
/// 2012). A few passes over the links, which each carry a pull by one link only, leave a cloth stretched; this carries
/// it at once, and only where the cloth is taut.
class Tethers {
 public:
  /// For this body, whose links have their lengths at rest: `perNode` for each node, each `scale` times as long as the
  /// shortest way along links. Done again when other nodes are pinned; nothing for 0 of them.
  void follow(const btSoftBody& body, const LocalNodes& nodes, int perNode, btScalar scale);
  /// The body has other links, or other lengths.
  void forget() { m_perNode = 0; }
  /// Pulls back the nodes that are too far away.
  void project(const MovingNodes& nodes) const;
  /// How many there are.
  std::size_t size() const { return m_tethers.size(); }

 private:
  struct Tether {
    std::size_t slot;
    std::size_t pin;  // slot
    btScalar length;
  };

  bool arePinsKnown(const LocalNodes& nodes) const;
  void build(const btSoftBody& body, const LocalNodes& nodes);

  std::vector<Tether> m_tethers;
  std::vector<std::size_t> m_pins;  // slots
  int m_perNode = 0;
  btScalar m_scale = 0;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
