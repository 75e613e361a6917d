// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <BulletSoftBody/btSoftBody.h>

#include <memory>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Nodes that btSoftBody's constructor takes in 0.1 s: 128 x 128.
constexpr int mostNodesForBullet = 16384;

/// A soft body of nodes without links and faces, as btSoftBody's constructor makes it, in O(n log n). The constructor
/// puts the nodes one by one into the tree m_ndbvt that Bullet collides by: rows in their order make it 2 sqrt(n) deep,
/// which takes 15 s at 512 x 512 nodes. Beyond mostNodesForBullet nodes the tree is halved, and halved again. Up to
/// there it is Bullet's own: contacts are listed in the tree's order, and a cloth that lies on a body which moves would
/// end elsewhere in its last digits.
/// Throws std::invalid_argument naming the parameter and the value.
/// @param positions  of the nodes [m], finite
/// @param masses     of the nodes [kg], one each, >= 0, 0 pins; none: 1 kg each
WETCLOTH_EXPORT std::unique_ptr<btSoftBody> looseNodes(btSoftBodyWorldInfo& worldInfo,
                                                       const std::vector<btVector3>& positions,
                                                       const std::vector<btScalar>& masses = {});

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
