// SPDX-License-Identifier: Zlib
#include "command/scene/Twist.h"

#include "command/scene/PatchReader.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace command {
namespace {

using wetcloth::ClothPatch;
using Edge = ClothPatch::Edge;

bool isAlongU(Edge edge) { return edge == Edge::bottom || edge == Edge::top; }

/// Of each node, a third of each of its faces [m^2].
std::vector<double> nodeAreas(const btSoftBody& body) {
  std::vector<double> areas(static_cast<std::size_t>(body.m_nodes.size()), 0);
  const btSoftBody::Node* const first = &body.m_nodes[0];
  for (int f = 0; f < body.m_faces.size(); ++f) {
    const auto& corners = body.m_faces[f].m_n;
    const btVector3 across = (corners[1]->m_x - corners[0]->m_x).cross(corners[2]->m_x - corners[0]->m_x);
    for (const btSoftBody::Node* corner : corners) {
      areas[static_cast<std::size_t>(corner - first)] += static_cast<double>(across.length()) / 6;
    }
  }
  return areas;
}

}  // namespace

Twist::Twist(btSoftBody& body, const ClothPatch& patch, const TwistScene& scene) : m_body(body), m_scene(scene) {
  m_nodes = nodesOfEdge(patch, scene.edge);
  const std::vector<double> areas = nodeAreas(body);
  for (const int node : m_nodes) {
    m_starts.push_back(body.m_nodes[node].m_x);
    m_dryMasses.push_back(patch.arealDensity * areas[static_cast<std::size_t>(node)]);
  }
  m_centre = (m_starts.front() + m_starts.back()) / 2;
  m_axis = (isAlongU(scene.edge) ? patch.edgeV : patch.edgeU).normalized();
  const bool isFarEdge = scene.edge == Edge::top || scene.edge == Edge::right;
  m_inwards = isFarEdge ? btVector3(-m_axis) : m_axis;
}

/// Of a wet cloth too these are the dry masses: what the nodes hold comes on top.
void Twist::letGo() {
  for (std::size_t i = 0; i < m_nodes.size(); ++i) m_body.m_nodes[m_nodes[i]].m_im = btScalar(1 / m_dryMasses[i]);
  m_body.updateLinkConstants();
  m_isHeld = false;
}

void Twist::moveTo(double time) {
  if (time >= m_scene.letGo) {
    if (m_isHeld) letGo();
    return;
  }
  const double turns = std::min(std::abs(m_scene.turnsPerSecond) * time, m_scene.turns);
  const btQuaternion turn(m_axis, btScalar(SIMD_2_PI * std::copysign(turns, m_scene.turnsPerSecond)));
  const double share = m_scene.turns > 0 ? turns / m_scene.turns : 0;
  const btVector3 centre = m_centre + m_inwards * btScalar(share * m_scene.approach);
  for (std::size_t i = 0; i < m_nodes.size(); ++i) {
    m_body.m_nodes[m_nodes[i]].m_x = centre + quatRotate(turn, m_starts[i] - m_centre);
  }
}

}  // namespace command
