// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/GuardBodies.h"

#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/solver/HullCrossing.h"

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

// How deep in a body what the guard has kept outside may be, in roundings of a place.
constexpr double kRoundingsInside = 16;
// With which what a body has stretched pushes it out, at most [m/s].
constexpr btScalar kPushedOut = btScalar(0.5);
// And it does not begin to turn faster than corners that go straight can show, in a step [rad].
constexpr btScalar kMostTurn = btScalar(0.1);

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

// From the centre of mass to what is farthest.
btScalar radiusOf(const btCollisionShape& shape) {
  btVector3 centre;
  btScalar radius = 0;
  shape.getBoundingSphere(centre, radius);
  return centre.length() + radius;
}

double turnOf(const BodyWays::Body& body) {
  return static_cast<double>(std::fabs(body.from.getRotation().angleShortestPath(body.to.getRotation())));
}

// Of the body's frame, what may come into a box on the way from one pose to the other.
BodyBox sweptInto(const BodyWays::Body& body, const BodyPose& from, const BodyPose& to, const BodyBox& box) {
  BodyBox result = boxInto(from, box);
  result.include(boxInto(to, box));
  double farthest = 0;
  for (unsigned k = 0; k < 8; ++k) farthest = std::max(farthest, lengthOf(result.corner(k)));
  const double turn = static_cast<double>(std::fabs(body.from.getRotation().angleShortestPath(body.to.getRotation())));
  result.grow(turn * turn * farthest);
  return result;
}

}  // namespace

// --- where the cloths are -------------------------------------------------------------------------------------------

BodyBox GuardBodies::boxOf(const Cloth& cloth) const {
  BodyBox box;
  for (int node = 0; node < cloth.guarded.nodeCount; ++node) {
    box.include(placeOf(cloth.guarded, toSize(cloth.guarded.slots[node]), m_origin));
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

double GuardBodies::roundingOf(const BodyBox& box) const {
  double farthest = 0;
  for (std::size_t k = 0; k < 3; ++k) farthest = std::max({farthest, std::fabs(box.low[k]), std::fabs(box.high[k])});
  return farthest * std::max(static_cast<double>(std::numeric_limits<btScalar>::epsilon()), 1e-12);
}

// --- the bodies -----------------------------------------------------------------------------------------------------

void GuardBodies::begin(const std::vector<Cloth>& cloths, double thickness, btScalar dt) {
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
  m_exemptions.clear();
  m_shares.clear();
  m_inside = 0;
  gather(cloths, 0);
}

void GuardBodies::gather(const std::vector<Cloth>& cloths, double share) {
  if (share > 0) bound(cloths);
  int firstOfBodies = 0;
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
    if (share == 0) m_shares.push_back({0, 0, btVector3(0, 0, 0), btVector3(0, 0, 0), 0});
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
    m_other[axis].assign(count, 0);
  }
  m_inverseMass.assign(count, 0);
  for (std::size_t k = m_slots.size(); k < m_mesh.nodes(); ++k) m_slots.push_back(static_cast<int>(k));
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

// A push is what a body gets that does not give way. This one gains no more along it than what makes it go with the
// cloth; and what pulls a cloth back that it has stretched in one step does not throw it.
void GuardBodies::slow(const std::vector<GuardNodes::Place>& recoil, double share, btScalar h) {
  const btVector3 origin = guarded().origin;
  for (std::size_t k = 0; k < m_shares.size(); ++k) {
    const BodyWays::Body& body = m_ways.bodies()[k];
    const btRigidBody* const rigid = btRigidBody::upcast(body.object);
    if (!rigid || rigid->isStaticOrKinematicObject() || !(rigid->getInvMass() > 0)) continue;
    Share& total = m_shares[k];
    const Share gained = m_shares[k];
    const auto hasPush = [](const GuardNodes::Place& push) { return push.at[3] > 0; };
    const auto pushes =
        static_cast<btScalar>(std::count_if(recoil.begin() + static_cast<std::ptrdiff_t>(gained.firstNode),
                                            recoil.begin() + static_cast<std::ptrdiff_t>(gained.endNode), hasPush));
    const btVector3 centre = body.from.getOrigin().lerp(body.to.getOrigin(), static_cast<btScalar>(share)) - origin;
    const btScalar radius = radiusOf(*body.object->getCollisionShape());
    for (std::size_t i = gained.firstNode; i < gained.endNode; ++i) {
      const btVector3 push(recoil[i].at[0], recoil[i].at[1], recoil[i].at[2]);
      const btScalar size = push.length();
      if (!(size > 0)) continue;
      const btVector3 along = push / size;
      const btVector3 arm = btVector3(m_position[0][i], m_position[1][i], m_position[2][i]) - centre;
      const btVector3 turn = rigid->getInvInertiaTensorWorld() * arm.cross(along);
      const btScalar yield = rigid->getInvMass() + turn.dot(arm.cross(along));
      const auto speed = [&](const btVector3& velocity, const btVector3& turning) {
        return (velocity + turning.cross(arm)).dot(along);
      };
      const btScalar gain = speed(gained.velocity, gained.turning);
      const btScalar own = speed(rigid->getLinearVelocity(), rigid->getAngularVelocity());
      const btScalar met = recoil[i].at[3] / (size * h);
      const btScalar stopped = std::min(met, -own) - gain;
      const btScalar wanted = std::min(met, kPushedOut - own) - gain;
      const auto impulseFor = [&](btScalar change) {
        return std::max(std::min(size / h, change / (yield * pushes)), btScalar(0));
      };
      total.velocity += along * (impulseFor(wanted) * rigid->getInvMass());
      total.turning += turn * impulseFor(stopped);
      total.most = std::max(total.most, std::min(stopped / radius, kMostTurn / static_cast<btScalar>(m_dt)));
    }
  }
}

void GuardBodies::end() {
  for (std::size_t k = 0; k < m_shares.size(); ++k) {
    Share& gained = m_shares[k];
    if (gained.velocity.isZero() && gained.turning.isZero()) continue;
    const btScalar turning = gained.turning.length();
    if (turning > gained.most) gained.turning *= gained.most / turning;
    auto& rigid = *const_cast<btRigidBody*>(btRigidBody::upcast(m_ways.bodies()[k].object));
    rigid.setLinearVelocity(rigid.getLinearVelocity() + gained.velocity * rigid.getLinearFactor());
    rigid.setAngularVelocity(rigid.getAngularVelocity() + gained.turning * rigid.getAngularFactor());
    rigid.activate();
  }
  m_ways.end();
  m_hulls.endStep();
}

ClothGuard::Cloth GuardBodies::guarded() {
  MovingNodes nodes = {m_inverseMass.size(), {}, {}, {}, m_inverseMass.data(), {}};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    nodes.position[axis] = m_position[axis].data();
    nodes.predicted[axis] = nodes.velocity[axis] = m_other[axis].data();
  }
  const btVector3 origin(static_cast<btScalar>(m_origin[0]), static_cast<btScalar>(m_origin[1]),
                         static_cast<btScalar>(m_origin[2]));
  return {&m_mesh.mesh(), nodes, m_slots.data(), static_cast<int>(m_mesh.nodes()), origin};
}

// --- what is not kept from a body -----------------------------------------------------------------------------------

void GuardBodies::exempt(const std::vector<Cloth>& cloths, std::size_t body, const BodyPose& pose) {
  const btCollisionObject& object = *m_ways.bodies()[body].object;
  int firstNode = 0;
  for (const Cloth& cloth : cloths) {
    if (BodyWays::collide(*cloth.body, object)) {
      for (int k = 0; k < cloth.body->m_anchors.size(); ++k) {
        const btSoftBody::Anchor& anchor = cloth.body->m_anchors[k];
        if (anchor.m_body != &object) continue;
        m_exemptions.add(firstNode + nodeIndex(*cloth.body, anchor.m_node), static_cast<int>(body));
      }
      for (const ShapeFaces::Hull& hull : m_faces.hulls()) exemptWhatStandsIn(cloth, firstNode, body, hull, pose);
    } else {
      for (int k = 0; k < cloth.guarded.nodeCount; ++k) m_exemptions.add(firstNode + k, static_cast<int>(body));
    }
    firstNode += cloth.guarded.nodeCount;
  }
}

void GuardBodies::exemptWhatStandsIn(const Cloth& cloth, int firstNode, std::size_t body, const ShapeFaces::Hull& hull,
                                     const BodyPose& pose) {
  const BodyBox hullBox = boxOutOf(pose, boxOutOf(hull.pose, hull.hull->box));
  const BodyBox clothBox = boxOf(cloth);
  if (!clothBox.overlaps(hullBox)) return;
  HullCrossing crossing(*hull.hull, kRoundingsInside * roundingOf(clothBox));
  for (const GuardMesh::Face& face : cloth.guarded.mesh->faces) {
    std::array<BodyPoint, 3> places;
    BodyBox box;
    for (std::size_t k = 0; k < 3; ++k) {
      places[k] = placeOf(cloth.guarded, toSize(cloth.guarded.slots[face.node[k]]), m_origin);
      box.include(places[k]);
    }
    if (!box.overlaps(hullBox)) continue;
    for (BodyPoint& place : places) place = hull.pose.into(pose.into(place));
    if (!crossing.isIn(places)) continue;
    for (const int node : face.node) m_exemptions.add(firstNode + node, static_cast<int>(body));
    m_inside += 1;
  }
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
