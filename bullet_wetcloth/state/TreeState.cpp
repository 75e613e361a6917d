// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/state/TreeState.h"

#include <LinearMath/btAlignedAllocator.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <new>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

constexpr int kInternal = -1;

// A node of a tree, in preorder: so the order tells the tree's shape.
struct Branch {
  int leaf = kInternal;  // the number of what the leaf stands for
  int rank = 0;          // of its address among those of the tree
  btVector3 low = btVector3(0, 0, 0);
  btVector3 high = btVector3(0, 0, 0);
  btVector3 normal = btVector3(0, 0, 0);
  btScalar angle = 0;
};

template <class Node>
std::vector<Node*> preorder(Node* root) {
  std::vector<Node*> nodes;
  std::vector<Node*> pending;
  if (root) pending.push_back(root);
  while (!pending.empty()) {
    Node* const node = pending.back();
    pending.pop_back();
    nodes.push_back(node);
    if (node->isleaf()) continue;
    pending.push_back(node->childs[1]);
    pending.push_back(node->childs[0]);
  }
  return nodes;
}

// Whether the branches are one whole tree, or none.
bool isTree(const std::vector<Branch>& branches) {
  std::size_t open = branches.empty() ? 0 : 1;
  for (const Branch& branch : branches) {
    if (open == 0) return false;
    open = branch.leaf == kInternal ? open + 1 : open - 1;
  }
  return open == 0;
}

template <class Node>
Branch branchOf(StateArchive& archive, const Node& node, const TreeLeaves& leaves) {
  Branch branch;
  branch.leaf = node.isleaf() ? leaves.indexOf(node.data) : kInternal;
  if (node.isleaf() && branch.leaf < 0)
    archive.fail(std::string("a tree of boxes has a leaf that is no ") + leaves.what);
  branch.low = node.volume.Mins();
  branch.high = node.volume.Maxs();
  return branch;
}

void transferBranches(StateArchive& archive, std::vector<Branch>& branches, const TreeLeaves& leaves) {
  branches.resize(archive.count(branches.size()));
  for (Branch& branch : branches) {
    branch.leaf = archive.index(branch.leaf, leaves.size, leaves.what);
    archive.local(branch.low);
    archive.local(branch.high);
  }
  if (!isTree(branches)) archive.fail(std::string("the boxes of each ") + leaves.what + " make no tree");
}

std::vector<bool> leavesIn(StateArchive& archive, const std::vector<Branch>& branches, const TreeLeaves& leaves) {
  std::vector<bool> has(static_cast<std::size_t>(leaves.size), false);
  for (const Branch& branch : branches) {
    if (branch.leaf == kInternal) continue;
    const auto number = static_cast<std::size_t>(branch.leaf);
    if (has[number])
      archive.fail(std::string(leaves.what) + " number " + std::to_string(branch.leaf) + " has two boxes");
    has[number] = true;
  }
  return has;
}

// Calls place(parent or null, side, branch) for each branch, which returns its node.
template <class Node, class Place>
void build(const std::vector<Branch>& branches, const Place& place) {
  struct Opening {
    Node* parent;
    int side;
  };
  std::vector<Opening> openings = {{nullptr, 0}};
  for (const Branch& branch : branches) {
    const Opening opening = openings.back();
    openings.pop_back();
    Node* const node = place(opening.parent, opening.side, branch);
    if (branch.leaf != kInternal) continue;
    openings.push_back({node, 1});
    openings.push_back({node, 0});
  }
}

// Bullet keeps one node that it has taken out for the next that it puts in.
std::vector<btDbvtNode*> memoryOf(const btDbvt& tree) {
  std::vector<btDbvtNode*> nodes = preorder(tree.m_root);
  if (tree.m_free) nodes.push_back(tree.m_free);
  return nodes;
}

std::vector<int> ranksOf(const std::vector<btDbvtNode*>& nodes) {
  std::vector<btDbvtNode*> sorted = nodes;
  std::sort(sorted.begin(), sorted.end(), std::less<>());
  std::vector<int> ranks;
  for (btDbvtNode* node : nodes) {
    const auto place = std::lower_bound(sorted.begin(), sorted.end(), node, std::less<>());
    ranks.push_back(static_cast<int>(place - sorted.begin()));
  }
  return ranks;
}

void transferRanks(StateArchive& archive, std::vector<int>& ranks) {
  const int size = static_cast<int>(ranks.size());
  std::vector<bool> isTaken(ranks.size(), false);
  for (int& rank : ranks) {
    rank = archive.place(rank, size, "place in memory");
    if (isTaken[static_cast<std::size_t>(rank)]) archive.fail("two nodes of a tree have one place in memory");
    isTaken[static_cast<std::size_t>(rank)] = true;
  }
}

// As many nodes as needed, in the order of their addresses.
std::vector<btDbvtNode*> takeMemory(const btDbvt& tree, std::size_t size) {
  std::vector<btDbvtNode*> nodes = memoryOf(tree);
  while (nodes.size() < size) nodes.push_back(new (btAlignedAlloc(sizeof(btDbvtNode), 16)) btDbvtNode());
  std::sort(nodes.begin(), nodes.end(), std::less<>());
  for (; nodes.size() > size; nodes.pop_back()) btAlignedFree(nodes.back());
  return nodes;
}

void rebuild(btDbvt& tree, const std::vector<Branch>& branches, const std::vector<int>& ranks,
             const TreeLeaves& leaves) {
  const std::vector<btDbvtNode*> memory = takeMemory(tree, ranks.size());
  const auto nodeAt = [&](std::size_t number) { return memory[static_cast<std::size_t>(ranks[number])]; };
  tree.m_root = nullptr;
  tree.m_free = ranks.size() > branches.size() ? nodeAt(branches.size()) : nullptr;
  std::size_t number = 0;
  build<btDbvtNode>(branches, [&](btDbvtNode* parent, int side, const Branch& branch) {
    btDbvtNode* const node = nodeAt(number++);
    node->parent = parent;
    node->volume = btDbvtVolume::FromMM(branch.low, branch.high);
    (parent ? parent->childs[side] : tree.m_root) = node;
    if (branch.leaf == kInternal) return node;
    node->childs[1] = nullptr;
    node->data = leaves.dataOf(branch.leaf);
    if (leaves.tell) leaves.tell(branch.leaf, *node);
    return node;
  });
}

}  // namespace

std::vector<bool> transferTree(StateArchive& archive, btDbvt& tree, const TreeLeaves& leaves) {
  std::vector<Branch> branches;
  std::vector<int> ranks;
  bool hasFree = tree.m_free != nullptr;
  if (archive.isSaving()) {
    for (const btDbvtNode* node : preorder(tree.m_root)) branches.push_back(branchOf(archive, *node, leaves));
    ranks = ranksOf(memoryOf(tree));
  }
  transferBranches(archive, branches, leaves);
  unsigned char free = hasFree ? 1 : 0;
  archive.local(free);
  if (!archive.isSaving()) ranks.resize(branches.size() + (free != 0 ? 1 : 0));
  transferRanks(archive, ranks);
  std::vector<bool> has = leavesIn(archive, branches, leaves);
  if (archive.isRestoring()) rebuild(tree, branches, ranks, leaves);
  archive.value(tree.m_lkhd, tree.m_leaves, tree.m_opath);
  return has;
}

void transferNormalTree(StateArchive& archive, btDbvntNode*& root, const TreeLeaves& leaves) {
  std::vector<Branch> branches;
  if (archive.isSaving()) {
    for (const btDbvntNode* node : preorder(root)) {
      branches.push_back(branchOf(archive, *node, leaves));
      branches.back().normal = node->normal;
      branches.back().angle = node->angle;
    }
  }
  transferBranches(archive, branches, leaves);
  for (Branch& branch : branches) {
    archive.local(branch.normal);
    archive.local(branch.angle);
  }
  leavesIn(archive, branches, leaves);
  if (!archive.isRestoring()) return;
  delete root;
  root = nullptr;
  build<btDbvntNode>(branches, [&](btDbvntNode* parent, int side, const Branch& branch) {
    btDbvtNode model = {};
    model.volume = btDbvtVolume::FromMM(branch.low, branch.high);
    model.data = branch.leaf == kInternal ? nullptr : leaves.dataOf(branch.leaf);
    auto* const node = new btDbvntNode(&model);
    node->normal = branch.normal;
    node->angle = branch.angle;
    (parent ? parent->childs[side] : root) = node;
    return node;
  });
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
