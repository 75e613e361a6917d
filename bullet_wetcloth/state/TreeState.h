// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/state/StateArchive.h"

#include <BulletCollision/BroadphaseCollision/btDbvt.h>

#include <functional>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// What the leaves of a tree stand for, by number: nodes, faces, clusters, proxies of the broadphase.
struct TreeLeaves {
  const char* what;
  int size = 0;
  /// The number of what a leaf's data points to, or -1.
  std::function<int(const void* data)> indexOf;
  std::function<void*(int index)> dataOf;
  /// Tells what has this number where its leaf is; nothing for trees without such places.
  std::function<void(int index, btDbvtNode& leaf)> tell = {};
};

/// One of Bullet's trees of boxes: its shape, which depends on its history and decides the order in which contacts are
/// found; its boxes; and the order of its nodes' addresses, by which btDbvt::optimizeIncremental() turns it about.
/// When restored, the tree's own memory is used again as far as it goes. Returns which numbers have a leaf: none twice.
std::vector<bool> transferTree(StateArchive& archive, btDbvt& tree, const TreeLeaves& leaves);

/// The tree of faces with normals (btSoftBody::m_fdbvnt), or null.
void transferNormalTree(StateArchive& archive, btDbvntNode*& root, const TreeLeaves& leaves);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
