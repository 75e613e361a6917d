// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/mesh/RestMesh.h"

#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/bullet/Layers.h"
#include "bullet_wetcloth/mesh/TriangleArea.h"
#include "bullet_wetcloth/state/StateArchive.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

std::pair<int, int> ends(const RestMesh::Edge& edge) { return {edge.a, edge.b}; }

bool isBefore(const RestMesh::Edge& edge, const RestMesh::Edge& other) { return ends(edge) < ends(other); }

}  // namespace

RestMesh::RestMesh(const btSoftBody& body, const RestLengths& lengths)
    : m_nodeAreas(static_cast<std::size_t>(body.m_nodes.size()), 0) {
  findEdges(body);
  takeLinkLengths(body, lengths);
  findTriangles(body);
  findNeighbours();
}

void RestMesh::findEdges(const btSoftBody& body) {
  m_edges.reserve(3 * static_cast<std::size_t>(body.m_faces.size()));
  for (int f = 0; f < body.m_faces.size(); ++f) {
    btSoftBody::Node* const* corners = body.m_faces[f].m_n;
    for (int k = 0; k < 3; ++k) {
      const btSoftBody::Node* from = corners[k];
      const btSoftBody::Node* to = corners[(k + 1) % 3];
      if (from == to) continue;
      const std::pair<int, int> sorted = std::minmax({nodeIndex(body, from), nodeIndex(body, to)});
      m_edges.push_back({sorted.first, sorted.second, static_cast<double>((to->m_x - from->m_x).length())});
    }
  }
  std::sort(m_edges.begin(), m_edges.end(), isBefore);
  const auto isSame = [](const Edge& edge, const Edge& other) { return ends(edge) == ends(other); };
  m_edges.erase(std::unique(m_edges.begin(), m_edges.end(), isSame), m_edges.end());
  m_edges.shrink_to_fit();
}

void RestMesh::takeLinkLengths(const btSoftBody& body, const RestLengths& lengths) {
  for (int k = 0; k < body.m_links.size(); ++k) {
    const btSoftBody::Link& link = body.m_links[k];
    const int edge = edgeBetween(nodeIndex(body, link.m_n[0]), nodeIndex(body, link.m_n[1]));
    const double length = lengths.natural(toSize(k));
    if (edge >= 0 && length > 0 && std::isfinite(length)) m_edges[static_cast<std::size_t>(edge)].length = length;
  }
}

void RestMesh::findTriangles(const btSoftBody& body) {
  const std::vector<FaceNodes> faces = nodesOfFaces(body);
  const std::vector<bool> doubled = areDoubled(faces);
  m_triangles.resize(faces.size());
  for (std::size_t f = 0; f < m_triangles.size(); ++f) {
    Triangle& triangle = m_triangles[f];
    triangle.nodes = faces[f];
    triangle.isDoubled = doubled[f];
    std::array<double, 3> lengths = {0, 0, 0};
    for (std::size_t k = 0; k < 3; ++k) {
      triangle.edges[k] = edgeBetween(triangle.nodes[(k + 1) % 3], triangle.nodes[(k + 2) % 3]);
      if (triangle.edges[k] >= 0) lengths[k] = m_edges[static_cast<std::size_t>(triangle.edges[k])].length;
    }
    triangle.area = triangle.isDoubled ? 0 : triangleArea(lengths[0], lengths[1], lengths[2]);
    for (const int node : triangle.nodes) m_nodeAreas[static_cast<std::size_t>(node)] += triangle.area / 3;
  }
}

void RestMesh::findNeighbours() {
  m_firstNeighbour.assign(nodeCount() + 1, 0);
  for (const Edge& edge : m_edges) {
    ++m_firstNeighbour[static_cast<std::size_t>(edge.a) + 1];
    ++m_firstNeighbour[static_cast<std::size_t>(edge.b) + 1];
  }
  for (std::size_t i = 0; i < nodeCount(); ++i) m_firstNeighbour[i + 1] += m_firstNeighbour[i];
  m_neighbours.resize(2 * m_edges.size());
  std::vector<std::size_t> next(m_firstNeighbour.begin(), m_firstNeighbour.end() - 1);
  for (const Edge& edge : m_edges) {
    m_neighbours[next[static_cast<std::size_t>(edge.a)]++] = edge.b;
    m_neighbours[next[static_cast<std::size_t>(edge.b)]++] = edge.a;
  }
}

int RestMesh::edgeBetween(int a, int b) const {
  const Edge wanted = {std::min(a, b), std::max(a, b), 0};
  const auto found = std::lower_bound(m_edges.begin(), m_edges.end(), wanted, isBefore);
  return found != m_edges.end() && ends(*found) == ends(wanted) ? static_cast<int>(found - m_edges.begin()) : -1;
}

void RestMesh::transferState(StateArchive& archive) {
  archive.each(m_edges, [&](Edge& edge) { archive.value(edge.length); });
  archive.each(m_triangles, [&](Triangle& triangle) { archive.value(triangle.area); });
  archive.array(m_nodeAreas);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
