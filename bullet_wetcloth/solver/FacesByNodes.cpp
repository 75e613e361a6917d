// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/FacesByNodes.h"

#include "bullet_wetcloth/bullet/Index.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

std::array<int, 3> inRisingOrder(int a, int b, int c) {
  std::array<int, 3> nodes = {a, b, c};
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

std::array<int, 3> risingNodesOf(const btSoftBody& body, int face) {
  int nodes[3];
  for (int k = 0; k < 3; ++k) nodes[k] = findIndex<btSoftBody::Node>(body.m_nodes, body.m_faces[face].m_n[k]);
  return inRisingOrder(nodes[0], nodes[1], nodes[2]);
}

}  // namespace

FacesByNodes::FacesByNodes(const btSoftBody& body)
    : m_first(toSize(body.m_nodes.size()) + 1, 0), m_faces(toSize(body.m_faces.size())) {
  for (int k = 0; k < body.m_faces.size(); ++k) ++m_first[toSize(risingNodesOf(body, k)[0]) + 1];
  for (std::size_t k = 1; k < m_first.size(); ++k) m_first[k] += m_first[k - 1];
  std::vector<int> next(m_first);
  for (int k = 0; k < body.m_faces.size(); ++k) {
    const std::array<int, 3> nodes = risingNodesOf(body, k);
    m_faces[toSize(next[toSize(nodes[0])]++)] = {{nodes[1], nodes[2]}, k};
  }
}

int FacesByNodes::find(int a, int b, int c) const {
  const std::array<int, 3> nodes = inRisingOrder(a, b, c);
  for (int k = m_first[toSize(nodes[0])]; k < m_first[toSize(nodes[0]) + 1]; ++k) {
    const Face& face = m_faces[toSize(k)];
    if (face.others[0] == nodes[1] && face.others[1] == nodes[2]) return face.number;
  }
  return -1;
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
