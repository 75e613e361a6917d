// SPDX-License-Identifier: Zlib
#include "command/scene/BlowUp.h"

#include "command/scene/Farthest.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace command {
namespace {

constexpr double mostSpeed = 20;
constexpr double mostStretch = 10;          // of a link that breaks away
constexpr double mostStretchAtRest = 1000;  // five times what Bullet's stiffest springs come to at their longest step

int numberOf(const btSoftBody& body, const btSoftBody::Node* node) { return static_cast<int>(node - &body.m_nodes[0]); }

/// A speed that btScalar cannot hold makes the next step's numbers infinite.
bool isFinite(const btSoftBody::Node& node) {
  return std::isfinite(node.m_x.length2()) && std::isfinite(node.m_v.length2());
}

std::optional<std::string> findLostNode(const btSoftBody& body, const MotionBounds& bounds) {
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    const btSoftBody::Node& node = body.m_nodes[i];
    if (!isFinite(node)) return "node " + std::to_string(i) + " is not finite";
    const double way = static_cast<double>(node.m_x.length());
    if (way > farthest) {
      char text[96];
      std::snprintf(text, sizeof text, "node %d is %.3g m away, farther than Bullet bears", i, way);
      return text;
    }
    const double speed = static_cast<double>(node.m_v.length());
    if (!(speed > mostSpeed * bounds.speed)) continue;
    char text[96];
    std::snprintf(text, sizeof text, "node %d moves with %.3g m/s", i, speed);
    return text;
  }
  return std::nullopt;
}

double meanRestLength(const btSoftBody& body) {
  double sum = 0;
  for (int k = 0; k < body.m_links.size(); ++k) sum += static_cast<double>(body.m_links[k].m_rl);
  return sum / std::max(1, body.m_links.size());
}

std::optional<std::string> findLongLink(const btSoftBody& body, const MotionBounds& bounds) {
  const double shortest = shortLink * meanRestLength(body);
  for (int k = 0; k < body.m_links.size(); ++k) {
    const btSoftBody::Link& link = body.m_links[k];
    const double rest = std::max(static_cast<double>(link.m_rl), shortest);
    const double length = static_cast<double>((link.m_n[1]->m_x - link.m_n[0]->m_x).length());
    const double parting = static_cast<double>((link.m_n[1]->m_v - link.m_n[0]->m_v).length());
    const bool isTorn = length > mostStretch * rest + 2 * bounds.speed * bounds.substep + bounds.sag;
    const bool isCloth = length <= mostStretchAtRest * rest + bounds.sag;
    if (isCloth && !(isTorn && parting * bounds.substep > rest)) continue;
    const bool isFirst = link.m_n[0]->m_v.length2() >= link.m_n[1]->m_v.length2();
    const btSoftBody::Node* const faster = link.m_n[isFirst ? 0 : 1];
    char text[160];
    std::snprintf(text, sizeof text,
                  "node %d moves with %.3g m/s, its link to node %d is %.3g times as long as at rest",
                  numberOf(body, faster), static_cast<double>(faster->m_v.length()),
                  numberOf(body, link.m_n[isFirst ? 1 : 0]), length / rest);
    return text;
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> findBlowUp(const btSoftBody& body, const MotionBounds& bounds) {
  const auto lost = findLostNode(body, bounds);
  return lost ? lost : findLongLink(body, bounds);
}

}  // namespace command
