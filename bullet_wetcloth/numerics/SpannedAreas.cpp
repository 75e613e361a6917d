// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/numerics/SpannedAreas.h"

#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/mesh/FaceWinding.h"
#include "bullet_wetcloth/mesh/RestMesh.h"

#include <algorithm>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

constexpr double kFlat = 1 - 1e-5;  // above it is what lengths in float32 are rounded by

}  // namespace

void SpannedAreas::fit(const RestMesh& mesh) {
  m_windings = faceWindings(mesh);
  m_spans.resize(mesh.nodeCount());
  m_shares.resize(mesh.nodeCount());
}

void SpannedAreas::measure(const RestMesh& mesh, const btSoftBody& body) {
  if (m_windings.empty()) fit(mesh);
  std::fill(m_spans.begin(), m_spans.end(), btVector3(0, 0, 0));
  for (std::size_t t = 0; t < m_windings.size(); ++t) {
    const auto& nodes = mesh.triangles()[t].nodes;
    const btVector3& a = body.m_nodes[nodes[0]].m_x;
    const btVector3 normal = (body.m_nodes[nodes[1]].m_x - a).cross(body.m_nodes[nodes[2]].m_x - a);
    for (const int node : nodes) m_spans[toSize(node)] += normal * btScalar(m_windings[t]);
  }
  for (std::size_t i = 0; i < m_spans.size(); ++i) {
    const double share = static_cast<double>(m_spans[i].length()) / (6 * mesh.nodeAreas()[i]);
    m_shares[i] = share < kFlat ? share : 1;
  }
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
