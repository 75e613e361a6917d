// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/mesh/RestLengths.h"

#include <BulletSoftBody/btSoftBody.h>

#include <array>
#include <cstddef>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

class StateArchive;

/// The triangles of a cloth at rest, known by the rest lengths of their edges: those of the body's links, and the
/// present length where no link follows an edge. So it is the same however the body is bent when it is made.
///
/// Nodes are numbered as in btSoftBody::m_nodes, triangles as in m_faces.
class WETCLOTH_EXPORT RestMesh {
 public:
  /// An edge of triangles, once; a < b.
  struct Edge {
    int a;          ///< lower node number
    int b;          ///< higher node number
    double length;  ///< at rest [m]
  };
  /// A face of the body.
  struct Triangle {
    std::array<int, 3> nodes;  ///< as in the body's face
    std::array<int, 3> edges;  ///< edges[k] is opposite nodes[k]; numbers in edges(), -1 from a node to itself
    double area;               ///< at rest [m^2]; 0 when the lengths make no triangle, and of a doubled one
    bool isDoubled;            ///< has the nodes of an earlier one, either way round: the same layer of cloth
  };
  /// A range of node numbers.
  struct Neighbours {
    const int* first;  ///< the first
    const int* last;   ///< past the last
    /// For range-for.
    const int* begin() const { return first; }
    /// For range-for.
    const int* end() const { return last; }
  };

  /// O(faces log faces).
  explicit RestMesh(const btSoftBody& body) : RestMesh(body, RestLengths(body)) {}
  /// With the natural lengths of the body's links, which an effect may have changed.
  RestMesh(const btSoftBody& body, const RestLengths& lengths);

  /// Nodes of the body.
  std::size_t nodeCount() const { return m_nodeAreas.size(); }
  /// Sorted by their nodes.
  const std::vector<Edge>& edges() const { return m_edges; }
  /// In the order of btSoftBody::m_faces.
  const std::vector<Triangle>& triangles() const { return m_triangles; }
  /// A third of the node's triangles [m^2]; 0 for a node of no triangle.
  const std::vector<double>& nodeAreas() const { return m_nodeAreas; }
  /// Lengths and areas; the same faces make the same triangles.
  void transferState(StateArchive& archive);

  /// Nodes that share an edge of a triangle with this one.
  Neighbours neighbours(std::size_t node) const {
    return {m_neighbours.data() + m_firstNeighbour[node], m_neighbours.data() + m_firstNeighbour[node + 1]};
  }

 private:
  void findEdges(const btSoftBody& body);
  void takeLinkLengths(const btSoftBody& body, const RestLengths& lengths);
  void findTriangles(const btSoftBody& body);
  void findNeighbours();
  int edgeBetween(int a, int b) const;

  std::vector<Edge> m_edges;  // sorted by (a, b)
  std::vector<Triangle> m_triangles;
  std::vector<double> m_nodeAreas;
  std::vector<std::size_t> m_firstNeighbour;
  std::vector<int> m_neighbours;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
