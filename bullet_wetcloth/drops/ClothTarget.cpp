// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/drops/ClothTarget.h"

#include "bullet_wetcloth/WetClothWorld.h"
#include "bullet_wetcloth/numerics/Direction.h"
#include "bullet_wetcloth/state/StateArchive.h"

#include <algorithm>
#include <tuple>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

ClothTarget::ClothTarget(WetCloth& cloth) : m_cloth(&cloth), m_check(collision::Tier::conservative) { restart(); }

// Its body may have been deleted; then only the address is looked at.
bool ClothTarget::isThere() const {
  const btSoftBody& body = m_cloth->body();
  return m_cloth->world().isInWorld(body) && body.m_faces.size() > 0 &&
         static_cast<std::size_t>(body.m_nodes.size()) == m_cloth->water().size();
}

void ClothTarget::restart() {
  m_isFitted = false;
  if (!isThere()) return;
  fitUptake();
  if (m_faces.fits(m_cloth->body())) {
    m_faces.restart(m_cloth->body());
  } else {
    m_faces.build(m_cloth->body());
  }
}

void ClothTarget::advance() {
  if (!isThere()) return;
  if (!m_faces.fits(m_cloth->body())) {
    restart();
    return;
  }
  m_isFitted = false;
  m_faces.advance(m_cloth->body());
}

// The body may have been cut.
void ClothTarget::fitUptake() {
  if (m_uptake.size() != m_cloth->water().size()) m_uptake.reset(m_cloth->water().size());
}

void ClothTarget::fit() {
  if (m_isFitted) return;
  m_faces.refit();
  m_isFitted = true;
}

ClothTarget::Hit ClothTarget::firstHit(const DropPath& path, bool areStill, int except) {
  Hit best;
  fit();
  const SweptBox box = path.box();
  m_faces.visitNear(box, [&](int patch) {
    const SweptFaces::Range range = m_faces.patch(patch).faces;
    int found[SweptFaces::kMostInPatch];
    const std::size_t count = m_faces.faces().boxes.findOverlapping(box, range.begin, range.end, found);
    for (std::size_t i = 0; i < count; ++i) {
      const SweptFaces::Parts<3>::Nodes& face = m_faces.faces().nodes[static_cast<std::size_t>(found[i])];
      if (except >= 0 && std::count(face.node, face.node + 3, except) > 0) continue;
      consider(path, face, areStill, best);
    }
  });
  return best;
}

void ClothTarget::consider(const DropPath& path, const SweptFaces::Parts<3>::Nodes& face, bool areStill, Hit& best) {
  ++m_candidates;
  collision::Query<double> query;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    query.start[0][axis] = path.from[axis];
    query.end[0][axis] = path.to[axis];
    for (std::size_t k = 0; k < 3; ++k) {
      const double(&at)[2] = m_faces.position(face.node[k]).at[axis];
      query.start[k + 1][axis] = at[areStill ? 1 : 0];
      query.end[k + 1][axis] = at[1];
    }
  }
  const collision::Contact contact = m_check(collision::Pair::vertexFace, query);
  std::array<int, 3> nodes;
  std::copy(face.node, face.node + 3, nodes.begin());
  // On an edge two faces are met at once; which is taken must not depend on the shape of the tree.
  if (!contact.found || !(std::tie(contact.time, nodes) < std::tie(best.time, best.nodes))) return;
  best.time = contact.time;
  best.nodes = nodes;
  best.weights = {std::max(0.0, 1 - contact.where[0] - contact.where[1]), contact.where[0], contact.where[1]};
}

ClothTarget::Side ClothTarget::sideOf(const Hit& hit, const DropPath& path) const {
  constexpr double off = 1e-4;  // [m]
  Double3 corners[3];
  Double3 way;  // of the drop, as seen from the place of the face
  Side side;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    side.onFace[axis] = 0;
    way[axis] = path.to[axis] - path.from[axis];
    for (std::size_t k = 0; k < 3; ++k) {
      const double(&at)[2] = m_faces.position(hit.nodes[k]).at[axis];
      corners[k][axis] = at[1];
      side.onFace[axis] += hit.weights[k] * at[1];
      way[axis] -= hit.weights[k] * (at[1] - at[0]);
    }
  }
  const btVector3 u = asBullet(corners[1]) - asBullet(corners[0]);
  const btVector3 v = asBullet(corners[2]) - asBullet(corners[0]);
  btVector3 normal = directionOf(u.cross(v));
  if (normal.dot(asBullet(way)) > 0) normal = -normal;
  side.normal = asDouble(normal);
  for (std::size_t axis = 0; axis < 3; ++axis) side.place[axis] = side.onFace[axis] + off * side.normal[axis];
  return side;
}

Double3 ClothTarget::velocityAt(const Hit& hit) const {
  Double3 velocity = {0, 0, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    const Double3 node = asDouble(m_cloth->body().m_nodes[hit.nodes[k]].m_v);
    for (std::size_t axis = 0; axis < 3; ++axis) velocity[axis] += hit.weights[k] * node[axis];
  }
  return velocity;
}

double ClothTarget::tooMuch(const Hit& hit, double mass) const {
  double rest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double room = m_uptake.room(m_cloth->water(), static_cast<std::size_t>(hit.nodes[k]));
    rest += std::max(0.0, hit.weights[k] * mass - std::max(0.0, room));
  }
  return rest;
}

double ClothTarget::land(const Hit& hit, double mass, const Double3& velocity, Double3* after) {
  Water& water = m_cloth->water();
  const double last = mass - (hit.weights[0] + hit.weights[1]) * mass;
  const double shares[3] = {hit.weights[0] * mass, hit.weights[1] * mass, last};
  double kept = mass;
  double stopped = 0;  // of the rest, as far as the nodes are heavy enough to turn it [kg]
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t node = static_cast<std::size_t>(hit.nodes[k]);
    const double share = std::max(0.0, shares[k]);
    const double rest = m_uptake.catchDrops(water, node, share, velocity[0], velocity[1], velocity[2]);
    kept -= rest;
    if (!(rest > 0)) continue;
    if (after) {
      stopped += bounce(node, rest, velocity, *after);
    } else {
      water.runOff(node, rest, velocity[0], velocity[1], velocity[2]);
    }
  }
  for (std::size_t k = 0; after && k < 3; ++k) {
    (*after)[k] = velocity[k] + ((*after)[k] - velocity[k]) * (stopped / (mass - kept));
  }
  if (!m_cloth->body().isActive()) m_cloth->body().activate(true);
  return kept;
}

// A light node cannot turn a heavy drop: what the two exchange is m dm / (m + dm) (u - u'). Run-off leaves with the
// node's own velocity, so it is told to have come with what gives the node that. Returns dm m / (m + dm) [kg].
double ClothTarget::bounce(std::size_t node, double mass, const Double3& velocity, const Double3& after) {
  Water& water = m_cloth->water();
  const btSoftBody::Node& target = m_cloth->body().m_nodes[static_cast<int>(node)];
  const Double3 own = asDouble(target.m_v);
  Double3 seen;
  for (std::size_t k = 0; k < 3; ++k) seen[k] = own[k] + velocity[k] - after[k];
  water.runOffFollowed(node, mass, seen[0], seen[1], seen[2]);
  if (target.m_im == 0) return mass;
  const double met = water.totalMass(node);
  return mass * met / (met + mass);
}

void ClothTarget::transferState(StateArchive& archive) {
  const bool isThere = this->isThere();
  archive.expect(isThere, "whether drops may land on a cloth");
  if (!isThere) return;
  fitUptake();
  m_uptake.transferState(archive);
  archive.value(m_candidates);
  m_isFitted = m_isFitted && !archive.isRestoring();
  if (archive.isSaving() && !m_faces.fits(m_cloth->body())) restart();
  m_faces.transferState(archive, m_cloth->body());
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
