// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/GuardBodies.h"

#include "bullet_wetcloth/bullet/Index.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

BodyPoint placeOf(const ClothGuard::Cloth& cloth, std::size_t slot, const BodyPoint& origin) {
  BodyPoint place = bodyPointOf(cloth.origin);
  for (std::size_t k = 0; k < 3; ++k) place[k] += static_cast<double>(cloth.nodes.position[k][slot]) - origin[k];
  return place;
}

BodyBox moved(BodyBox box, const BodyPoint& by) {
  for (std::size_t k = 0; k < 3; ++k) {
    box.low[k] += by[k];
    box.high[k] += by[k];
  }
  return box;
}

double lengthOf(const BodyPoint& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

double turnOf(const BodyWays::Body& body) {
  return static_cast<double>(std::fabs(body.from.getRotation().angleShortestPath(body.to.getRotation())));
}

// Of the body's frame, what may come into a box on the way from one pose to the other.
BodyBox sweptInto(const BodyWays::Body& body, const BodyPose& from, const BodyPose& to, const BodyBox& box) {
  BodyBox result = boxInto(from, box);
  result.include(boxInto(to, box));
  double farthest = 0;
  for (unsigned k = 0; k < 8; ++k) farthest = std::max(farthest, lengthOf(result.corner(k)));
  const double turn = turnOf(body);
  result.grow(turn * turn * farthest);
  return result;
}

}  // namespace

// --- where the cloths are -------------------------------------------------------------------------------------------

BodyBox GuardBodies::boxOf(const Cloth& cloth) const {
  BodyBox box;
  const BodyPoint origin = bodyPointOf(cloth.guarded.origin);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const btScalar* const places = cloth.guarded.nodes.position[axis];
    btScalar low = std::numeric_limits<btScalar>::infinity();
    btScalar high = -low;
    for (int node = 0; node < cloth.guarded.nodeCount; ++node) {
      const btScalar place = places[cloth.guarded.slots[node]];
      low = std::min(low, place);
      high = std::max(high, place);
    }
    box.low[axis] = static_cast<double>(low) + (origin[axis] - m_origin[axis]);
    box.high[axis] = static_cast<double>(high) + (origin[axis] - m_origin[axis]);
  }
  return box;
}

void GuardBodies::bound(const std::vector<Cloth>& cloths) {
  m_near.clear();
  for (const Cloth& cloth : cloths) {
    const MovingNodes& nodes = cloth.guarded.nodes;
    BodyBox box = boxOf(cloth);
    double fastest = 0;
    for (int node = 0; node < cloth.guarded.nodeCount; ++node) {
      const std::size_t slot = toSize(cloth.guarded.slots[node]);
      BodyPoint place = placeOf(cloth.guarded, slot, m_origin);
      for (std::size_t k = 0; k < 3; ++k) {
        const double way = static_cast<double>(nodes.velocity[k][slot]) * m_dt;
        fastest = std::max(fastest, std::fabs(way));
        place[k] += way;
      }
      box.include(place);
    }
    const double fall = static_cast<double>(cloth.body->m_worldInfo->m_gravity.length()) * m_dt * m_dt;
    const double reach = m_thickness + cloth.guarded.mesh->edgeLength + fastest + fall;
    Near near = {box, box};
    near.box.grow(reach / 2);
    near.room.grow(reach);
    m_near.push_back(near);
  }
}

bool GuardBodies::covers(const std::vector<Cloth>& cloths) const {
  for (std::size_t k = 0; k < cloths.size(); ++k) {
    if (!m_near[k].box.contains(boxOf(cloths[k]))) return false;
  }
  return true;
}

// --- the bodies -----------------------------------------------------------------------------------------------------

void GuardBodies::begin(const std::vector<Cloth>& cloths, int others, double thickness, btScalar dt) {
  m_others = others;
  m_thickness = thickness;
  m_dt = static_cast<double>(dt);
  m_origin = bodyPointOf(cloths.front().guarded.origin);
  m_edge = std::numeric_limits<double>::infinity();
  for (const Cloth& cloth : cloths) m_edge = std::min(m_edge, cloth.guarded.mesh->edgeLength);
  bound(cloths);
  m_places.clear();
  for (std::size_t k = 0; k < cloths.size(); ++k) {
    m_places.push_back({cloths[k].body, moved(m_near[k].room, m_origin)});
  }
  m_ways.find(m_places, dt);
  m_standing.clear();
  for (const Cloth& cloth : cloths) m_standing.add(cloth.guarded, m_origin);
  m_exemptions.clear();
  m_shares.clear();
  m_inside = 0;
  gather(cloths, 0);
}

void GuardBodies::gather(const std::vector<Cloth>& cloths, double share) {
  if (share > 0) bound(cloths);
  int firstOfBodies = m_others;
  BodyBox around;
  for (std::size_t k = 0; k < cloths.size(); ++k) {
    firstOfBodies += cloths[k].guarded.nodeCount;
    around.include(m_near[k].room);
  }
  m_exemptions.clearNodes(firstOfBodies);
  m_mesh.clear();
  for (std::size_t k = 0; k < m_ways.bodies().size(); ++k) {
    const BodyWays::Body& body = m_ways.bodies()[k];
    const BodyPose from(body.from, m_origin);
    const BodyPose to(body.to, m_origin);
    m_boxes.clear();
    for (std::size_t c = 0; c < cloths.size(); ++c) {
      if (BodyWays::collide(*cloths[c].body, *body.object)) {
        m_boxes.push_back(sweptInto(body, from, to, m_near[c].room));
      }
    }
    m_faces.find(*body.object->getCollisionShape(), m_boxes, sweptInto(body, from, to, around), m_hulls);
    m_faces.refine(std::max(m_edge, m_thickness / std::max(turnOf(body), 1e-9)));
    if (share == 0) m_shares.push_back({0, 0, BodyRecoil(*body.object, static_cast<btScalar>(m_dt))});
    m_shares[k].firstNode = m_mesh.nodes();
    m_mesh.add(m_faces, from, to);
    m_shares[k].endNode = m_mesh.nodes();
    m_exemptions.addNodes(static_cast<int>(k), m_faces.corners().size());
    if (share == 0) exempt(cloths, k, from);
  }
  m_mesh.finish();
  m_exemptions.sort();
  const std::size_t count = (m_mesh.nodes() + NodeSlots::kLanes - 1) / NodeSlots::kLanes * NodeSlots::kLanes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    m_position[axis].assign(count, 0);
    m_velocity[axis].assign(count, 0);
    m_other[axis].assign(count, 0);
  }
  m_inverseMass.assign(count, 0);
  for (std::size_t k = m_slots.size(); k < m_mesh.nodes(); ++k) m_slots.push_back(static_cast<int>(k));
  for (std::size_t node = 0; node < m_mesh.nodes(); ++node) {
    for (std::size_t k = 0; k < 3; ++k) {
      m_velocity[k][node] = static_cast<btScalar>((m_mesh.to()[node][k] - m_mesh.from()[node][k]) / m_dt);
    }
  }
  go(share);
}

void GuardBodies::go(double share) {
  for (std::size_t node = 0; node < m_mesh.nodes(); ++node) {
    const BodyPoint& from = m_mesh.from()[node];
    const BodyPoint& to = m_mesh.to()[node];
    for (std::size_t k = 0; k < 3; ++k) {
      m_position[k][node] = static_cast<btScalar>(share < 1 ? from[k] + share * (to[k] - from[k]) : to[k]);
    }
  }
}

void GuardBodies::recoil(const std::vector<GuardNodes::Place>& recoil, double share, btScalar h) {
  const btVector3 origin = guarded(h).origin;
  for (std::size_t k = 0; k < m_shares.size(); ++k) {
    Share& of = m_shares[k];
    if (!of.recoil.isNeeded()) continue;
    const BodyWays::Body& body = m_ways.bodies()[k];
    const btVector3 centre = body.from.getOrigin().lerp(body.to.getOrigin(), static_cast<btScalar>(share)) - origin;
    const auto first = recoil.begin() + static_cast<std::ptrdiff_t>(of.firstNode);
    const auto end = recoil.begin() + static_cast<std::ptrdiff_t>(of.endNode);
    const auto impulseOf = [h](const GuardNodes::Place& push) {
      return btVector3(push.at[0], push.at[1], push.at[2]) / h;
    };
    const auto isPush = [&](const GuardNodes::Place& push) { return impulseOf(push).length2() > 0; };
    of.recoil.beginSmallStep(static_cast<int>(std::count_if(first, end, isPush)));
    for (std::size_t i = of.firstNode; i < of.endNode; ++i) {
      if (!isPush(recoil[i])) continue;
      const btVector3 arm = btVector3(m_position[0][i], m_position[1][i], m_position[2][i]) - centre;
      const btVector3 impulse = impulseOf(recoil[i]);
      of.recoil.add(arm, impulse, recoil[i].at[3] / (impulse.length() * h * h));
    }
  }
}

void GuardBodies::end() {
  for (Share& share : m_shares) {
    if (share.recoil.isNeeded()) share.recoil.apply();
  }
  m_ways.end();
  m_hulls.endStep();
}

// @param h  of a small step [s]
ClothGuard::Cloth GuardBodies::guarded(btScalar h) {
  MovingNodes nodes = {m_inverseMass.size(), {}, {}, {}, m_inverseMass.data(), {}};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    nodes.position[axis] = m_position[axis].data();
    nodes.velocity[axis] = m_velocity[axis].data();
    nodes.predicted[axis] = m_other[axis].data();
  }
  const btVector3 origin(static_cast<btScalar>(m_origin[0]), static_cast<btScalar>(m_origin[1]),
                         static_cast<btScalar>(m_origin[2]));
  return {&m_mesh.mesh(), nodes, m_slots.data(), static_cast<int>(m_mesh.nodes()), origin, h};
}

// --- what is not kept from a body -----------------------------------------------------------------------------------

void GuardBodies::exempt(const std::vector<Cloth>& cloths, std::size_t body, const BodyPose& pose) {
  const btCollisionObject& object = *m_ways.bodies()[body].object;
  int firstNode = 0;
  const auto add = [&](int node) { m_exemptions.add(firstNode + node, static_cast<int>(body)); };
  for (std::size_t c = 0; c < cloths.size(); ++c) {
    const btSoftBody& cloth = *cloths[c].body;
    if (BodyWays::collide(cloth, object)) {
      for (int k = 0; k < cloth.m_anchors.size(); ++k) {
        if (cloth.m_anchors[k].m_body == &object) add(nodeIndex(cloth, cloth.m_anchors[k].m_node));
      }
      for (const ShapeFaces::Hull& hull : m_faces.hulls()) {
        m_standing.forEachIn(c, hull, pose, [&](const GuardMesh::Face& face) {
          for (const int node : face.node) add(node);
          ++m_inside;
        });
      }
    } else {
      for (int node = 0; node < cloths[c].guarded.nodeCount; ++node) add(node);
    }
    firstNode += cloths[c].guarded.nodeCount;
  }
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
