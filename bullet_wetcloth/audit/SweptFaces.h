// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/audit/SweptBoxes.h"

#include <BulletSoftBody/btSoftBody.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class StateArchive;

/// The faces of a soft body between two moments, in a tree of the boxes that they sweep. The leaves are patches of a
/// few faces: neighbours overlap in any case, so a tree that tells them apart takes longer than it saves.
///
/// Bullet's own trees cannot serve: at the end of a substep their boxes are those of its prediction, not of where the
/// solver put the nodes, and many bodies have no tree of faces at all. See docs/bullet_notes.md.
class SweptFaces {
 public:
  /// Of the vertices, edges or faces of a patch, with the gaps after them.
  static constexpr std::size_t kMostInPatch = SweptBoxes::kMost;
  static constexpr std::size_t kPatchFaces = kMostInPatch / 3;

  /// Which of a kind of parts belong to a patch: begin and end are multiples of SweptBoxes::kWide.
  struct Range {
    std::size_t begin, end;
  };
  /// A vertex or an edge that faces share belongs to the patch of one of them, so that each pair is met once.
  struct Patch {
    Range vertices, edges, faces;
  };
  /// All parts of one kind: the vertices, the edges or the faces. Gaps between patches have empty boxes.
  template <int nodeCount>
  struct Parts {
    struct Nodes {
      int node[nodeCount];
      int face;  // that it belongs to: an index among the faces
    };
    std::vector<Nodes> nodes;
    SweptBoxes boxes;
  };
  /// Where a node is at both moments: the numbers of the body or of its solver, as the double that the volumes are
  /// computed in.
  struct Position {
    double at[3][2];
    btScalar start(std::size_t axis) const { return static_cast<btScalar>(at[axis][0]); }
    btScalar end(std::size_t axis) const { return static_cast<btScalar>(at[axis][1]); }
  };

  /// Takes the body's faces, and its present positions for both moments. Allocates.
  void build(const btSoftBody& body);
  /// The positions of both moments, and the tree, whose order of faces tells when which pair is looked at.
  void transferState(StateArchive& archive, const btSoftBody& body);
  /// False when the body's nodes or faces have changed in number.
  bool fits(const btSoftBody& body) const;
  /// The body's present positions become those of both moments.
  void restart(const btSoftBody& body);
  /// The end becomes the start, and the body's present positions the end. Returns whether any node moved.
  bool advance(const btSoftBody& body);
  /// The same with places relative to an origin, x, y, z of each node [m]: in double, so that nothing is rounded. The
  /// origin is near the body from then on.
  void advance(const btScalar* places, const btVector3& origin);
  /// The end becomes the start, too.
  void stand();
  /// The body's present position becomes the end of each node that is not there already, up to rounding.
  /// @param arePinsLeft  but of pinned nodes: the way to where they were put since belongs to the next small steps
  void correct(const btSoftBody& body, bool arePinsLeft);
  /// Fits the boxes to the positions. A face with a node that is not finite and what belongs to it get empty boxes.
  void refit();

  const btSoftBody* body() const { return m_body; }
  /// Near the body, or nothing: what is computed in the body's own precision is computed from here [m].
  const btVector3& origin() const { return m_origin; }
  const Position& position(int node) const { return m_positions[static_cast<std::size_t>(node)]; }
  const Parts<1>& vertices() const { return m_vertices; }
  const Parts<2>& edges() const { return m_edges; }
  const Parts<3>& faces() const { return m_faces; }
  const Patch& patch(int index) const { return m_patches[static_cast<std::size_t>(index)]; }
  const SweptBox& boxOf(int patch) const { return m_patchBoxes[static_cast<std::size_t>(patch)]; }

  /// Calls visit(patch, otherPatch) once for each two patches of this body of which the boxes overlap, and for each
  /// patch with itself, for as long as it returns true. Returns whether it did to the end.
  template <class Visit>
  bool visitSelf(const Visit& visit) const {
    return m_tree.empty() || visitSelf(0, visit);
  }
  /// Calls visit(patch) for each patch of which the box overlaps this one.
  template <class Visit>
  void visitNear(const SweptBox& box, const Visit& visit) const {
    if (!m_tree.empty()) visitNear(0, box, visit);
  }
  /// Round all that is finite; empty where nothing is. Good after refit().
  SweptBox bounds() const { return m_tree.empty() ? SweptBox() : m_tree[0].box; }
  /// visitSelf() for a patch of this body and one of another.
  template <class Visit>
  bool visitPairs(const SweptFaces& other, const Visit& visit) const {
    return m_tree.empty() || other.m_tree.empty() || visitPairs(0, other, 0, visit);
  }

 private:
  // In preorder: the left child follows its parent. Patches have the order of their leaves.
  struct TreeNode {
    SweptBox box;
    int right = 0;
    int firstPatch = 0;
    int patches = 1;
    bool isLeaf() const { return patches == 1; }
  };

  void build(const btSoftBody& body, std::vector<int> order, const std::vector<btVector3>* centres);
  void buildTree(int* first, int* last, const btSoftBody& body, const std::vector<btVector3>* centres);
  void addPatch(const int* first, const int* last, const btSoftBody& body);
  void assignOwners();
  SweptBox boxOfPatch(const Patch& patch) const;
  const TreeNode& at(int index) const { return m_tree[static_cast<std::size_t>(index)]; }

  template <class Visit>
  void visitNear(int index, const SweptBox& box, const Visit& visit) const {
    const TreeNode& node = at(index);
    if (!node.box.overlaps(box)) return;
    if (node.isLeaf()) {
      visit(node.firstPatch);
      return;
    }
    visitNear(index + 1, box, visit);
    visitNear(node.right, box, visit);
  }
  template <class Visit>
  bool visitSelf(int index, const Visit& visit) const {
    const TreeNode& node = at(index);
    if (node.isLeaf()) return visit(node.firstPatch, node.firstPatch);
    return visitSelf(index + 1, visit) && visitSelf(node.right, visit) &&
           visitPairs(index + 1, *this, node.right, visit);
  }
  template <class Visit>
  bool visitPairs(int index, const SweptFaces& other, int otherIndex, const Visit& visit) const {
    const TreeNode& a = at(index);
    const TreeNode& b = other.at(otherIndex);
    if (!a.box.overlaps(b.box)) return true;
    if (a.isLeaf() && b.isLeaf()) return visit(a.firstPatch, b.firstPatch);
    if (a.patches >= b.patches) {
      return visitPairs(index + 1, other, otherIndex, visit) && visitPairs(a.right, other, otherIndex, visit);
    }
    return visitPairs(index, other, otherIndex + 1, visit) && visitPairs(index, other, b.right, visit);
  }

  const btSoftBody* m_body = nullptr;
  int m_faceCount = 0;
  std::vector<int> m_order;  // of the faces, in the tree
  std::vector<Position> m_positions;
  btVector3 m_origin{0, 0, 0};
  std::vector<SweptBox> m_nodeBoxes;
  Parts<1> m_vertices;
  Parts<2> m_edges;
  Parts<3> m_faces;
  std::vector<Patch> m_patches;
  std::vector<SweptBox> m_patchBoxes;
  std::vector<TreeNode> m_tree;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
