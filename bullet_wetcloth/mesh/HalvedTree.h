// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <BulletCollision/BroadphaseCollision/btDbvt.h>

#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// A node of Bullet's trees of boxes, which has no parent and no children yet; Bullet frees it with its tree.
/// @param data  what a leaf stands for
btDbvtNode* newTreeNode(const btDbvtVolume& volume, void* data = nullptr);

/// Fills an empty tree: the leaves are halved where their box is longest, until one is left. O(n log n), and log2(n)
/// deep whatever their order.
void fillTree(btDbvt& tree, const std::vector<btDbvtNode*>& leaves);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
