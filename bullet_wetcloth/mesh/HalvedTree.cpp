// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/mesh/HalvedTree.h"

#include <algorithm>
#include <new>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

// With its box beside it, so that halving reads one row of memory.
struct Leaf {
  btDbvtVolume box;
  btDbvtNode* node;
};

btDbvtNode* halved(Leaf* first, Leaf* last) {
  if (last - first == 1) return first->node;
  btDbvtVolume box = first->box;
  for (const Leaf* leaf = first; leaf != last; ++leaf) Merge(box, leaf->box, box);
  const int axis = box.Lengths().maxAxis();
  Leaf* const middle = first + (last - first) / 2;
  std::nth_element(first, middle, last,
                   [axis](const Leaf& a, const Leaf& b) { return a.box.Center()[axis] < b.box.Center()[axis]; });
  btDbvtNode* const node = newTreeNode(box);
  node->childs[0] = halved(first, middle);
  node->childs[1] = halved(middle, last);
  node->childs[0]->parent = node->childs[1]->parent = node;
  return node;
}

}  // namespace

btDbvtNode* newTreeNode(const btDbvtVolume& volume, void* data) {
  // Bullet frees nodes with btAlignedFree().
  auto* const node = new (btAlignedAlloc(sizeof(btDbvtNode), 16)) btDbvtNode();
  node->parent = nullptr;
  node->childs[0] = node->childs[1] = nullptr;
  if (data != nullptr) node->data = data;  // in the place of the first child
  node->volume = volume;
  return node;
}

void fillTree(btDbvt& tree, const std::vector<btDbvtNode*>& nodes) {
  if (nodes.empty()) return;
  std::vector<Leaf> leaves;
  leaves.reserve(nodes.size());
  for (btDbvtNode* const node : nodes) leaves.push_back({node->volume, node});
  tree.m_root = halved(leaves.data(), leaves.data() + leaves.size());
  tree.m_leaves = static_cast<int>(leaves.size());
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
