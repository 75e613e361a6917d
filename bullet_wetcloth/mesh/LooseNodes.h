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
/// which takes 10 s at 512 x 512 nodes. Beyond mostNodesForBullet nodes the tree is halved, and halved again. Up to
/// there it is Bullet's own, which a different tree is not quite: nodes come into contact in another order, and Bullet
/// solves contacts one after the other.
/// @param positions  of the nodes [m], finite
/// @param masses     of the nodes [kg], one each, 0 pins; none: 1 kg each
WETCLOTH_EXPORT std::unique_ptr<btSoftBody> looseNodes(btSoftBodyWorldInfo& worldInfo,
                                                       const std::vector<btVector3>& positions,
                                                       const std::vector<btScalar>& masses = {});

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
