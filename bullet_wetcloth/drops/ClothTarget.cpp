// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/drops/ClothTarget.h"

#include "bullet_wetcloth/WetClothWorld.h"
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

double ClothTarget::land(const Hit& hit, double mass, const Double3& velocity) {
  Water& water = m_cloth->water();
  const double shares[3] = {hit.weights[0] * mass, hit.weights[1] * mass,
                            mass - (hit.weights[0] + hit.weights[1]) * mass};
  double kept = mass;
  for (std::size_t k = 0; k < 3; ++k) {
    const double share = std::max(0.0, shares[k]);
    const std::size_t node = static_cast<std::size_t>(hit.nodes[k]);
    const double rest = m_uptake.catchDrops(water, node, share, velocity[0], velocity[1], velocity[2]);
    water.runOff(node, rest, velocity[0], velocity[1], velocity[2]);
    kept -= rest;
  }
  if (!m_cloth->body().isActive()) m_cloth->body().activate(true);
  return kept;
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
