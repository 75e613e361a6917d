#pragma once

#include "bullet_wetcloth/Precision.h"

#include <BulletSoftBody/btSoftBody.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// A box along the axes; empty at first. Boxes that only touch overlap, an empty one overlaps nothing.
struct SweptBox {
  btScalar low[3] = {std::numeric_limits<btScalar>::infinity(), std::numeric_limits<btScalar>::infinity(),
                     std::numeric_limits<btScalar>::infinity()};
  btScalar high[3] = {-std::numeric_limits<btScalar>::infinity(), -std::numeric_limits<btScalar>::infinity(),
                      -std::numeric_limits<btScalar>::infinity()};

  void include(const btScalar (&point)[3]) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], point[k]);
      high[k] = std::max(high[k], point[k]);
    }
  }
  void include(const SweptBox& other) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], other.low[k]);
      high[k] = std::max(high[k], other.high[k]);
    }
  }
  bool isEmpty() const { return high[0] < low[0]; }
  bool overlaps(const SweptBox& other) const {
    bool result = true;
    for (std::size_t k = 0; k < 3; ++k) result &= low[k] <= other.high[k] && other.low[k] <= high[k];
    return result;
  }
};

/// The faces of a soft body between two moments, in a tree of the boxes that they sweep.
///
/// Bullet's own trees cannot serve: at the end of a substep their boxes are those of its prediction, not of where the
/// solver put the nodes, and many bodies have no tree of faces at all. See docs/bullet_notes.md.
class SweptFaces {
 public:
  using Point = btScalar[3];

  /// A vertex or an edge that faces share belongs to one of them, so that each pair of them is met once. A face's own
  /// follow one another.
  struct Face {
    int nodes[3];
    std::size_t vertexBegin, vertexEnd;
    std::size_t edgeBegin, edgeEnd;
  };
  struct Vertex {
    int node;
    SweptBox box;
  };
  struct Edge {
    int nodes[2];
    SweptBox box;
  };
  struct Position {
    Point start;
    Point end;
  };

  /// Takes the body's faces, and its present positions for both moments. Allocates.
  void build(const btSoftBody& body);
  /// False when the body's nodes or faces have changed in number.
  bool fits(const btSoftBody& body) const;
  /// The body's present positions become those of both moments.
  void restart(const btSoftBody& body);
  /// The end becomes the start, and the body's present positions the end. Returns whether any node moved.
  bool advance(const btSoftBody& body);
  /// Fits the boxes to the positions. A face with a corner that is not finite gets an empty box.
  void refit();

  const btSoftBody* body() const { return m_body; }
  const Face& face(int index) const { return m_faces[static_cast<std::size_t>(index)]; }
  const Vertex& vertex(std::size_t index) const { return m_vertices[index]; }
  const Edge& edge(std::size_t index) const { return m_edges[index]; }
  const Position& position(int node) const { return m_positions[static_cast<std::size_t>(node)]; }
  const SweptBox& boxOf(int face) const {
    return m_tree[static_cast<std::size_t>(m_leafOfFace[std::size_t(face)])].box;
  }

  /// Calls visit(face, otherFace) once for each two faces of this body of which the boxes overlap.
  template <class Visit>
  void visitSelf(const Visit& visit) const {
    if (!m_tree.empty()) visitSelf(0, visit);
  }
  /// The same for a face of this body and one of another.
  template <class Visit>
  void visitPairs(const SweptFaces& other, const Visit& visit) const {
    if (!m_tree.empty() && !other.m_tree.empty()) visitPairs(0, other, 0, visit);
  }

 private:
  // In preorder: the left child follows its parent.
  struct TreeNode {
    SweptBox box;
    int right = 0;
    int face = -1;  // of a leaf
    bool isLeaf() const { return face >= 0; }
  };

  void assignOwners();
  SweptBox boxOfNode(int node) const;
  void buildTree(int* first, int* last, const std::vector<btVector3>& centres);
  const TreeNode& at(int index) const { return m_tree[static_cast<std::size_t>(index)]; }

  template <class Visit>
  void visitSelf(int index, const Visit& visit) const {
    const TreeNode& node = at(index);
    if (node.isLeaf()) return;
    visitSelf(index + 1, visit);
    visitSelf(node.right, visit);
    visitPairs(index + 1, *this, node.right, visit);
  }
  template <class Visit>
  void visitPairs(int index, const SweptFaces& other, int otherIndex, const Visit& visit) const {
    const TreeNode& a = at(index);
    const TreeNode& b = other.at(otherIndex);
    if (!a.box.overlaps(b.box)) return;
    if (a.isLeaf() && b.isLeaf()) {
      visit(a.face, b.face);
    } else if (a.isLeaf()) {
      visitPairs(index, other, otherIndex + 1, visit);
      visitPairs(index, other, b.right, visit);
    } else {
      visitBoth(index + 1, other, otherIndex, visit);
      visitBoth(a.right, other, otherIndex, visit);
    }
  }
  // Goes down in the other tree, too: the two are about equally deep.
  template <class Visit>
  void visitBoth(int index, const SweptFaces& other, int otherIndex, const Visit& visit) const {
    const TreeNode& b = other.at(otherIndex);
    if (b.isLeaf()) {
      visitPairs(index, other, otherIndex, visit);
    } else if (at(index).box.overlaps(b.box)) {
      visitPairs(index, other, otherIndex + 1, visit);
      visitPairs(index, other, b.right, visit);
    }
  }

  const btSoftBody* m_body = nullptr;
  std::vector<Face> m_faces;
  std::vector<Vertex> m_vertices;
  std::vector<Edge> m_edges;
  std::vector<Position> m_positions;
  std::vector<TreeNode> m_tree;
  std::vector<int> m_leafOfFace;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
