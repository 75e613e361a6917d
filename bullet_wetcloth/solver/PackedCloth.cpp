// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/PackedCloth.h"

#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/solver/Parts.h"
#include "bullet_wetcloth/solver/WhyNotTaken.h"
#include "bullet_wetcloth/state/StateArchive.h"

#include <BulletCollision/BroadphaseCollision/btBroadphaseInterface.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

constexpr std::size_t kStepsForAllLinks = 64;  // in which all links are looked at

btScalar inverseMasses(const btSoftBody::Link& link) { return link.m_n[0]->m_im + link.m_n[1]->m_im; }

const void* addressOf(const btAlignedObjectArray<btSoftBody::Node>& array) {
  return array.size() ? &array[0] : nullptr;
}
const void* addressOf(const btAlignedObjectArray<btSoftBody::Link>& array) {
  return array.size() ? &array[0] : nullptr;
}

btScalar largestPush(const btSoftBody& body) { return body.m_worldInfo->m_maxDisplacement / body.m_sst.sdt; }

// Of a number of small steps that comes out whole.
constexpr double kCountRounding = 1e-4;

}  // namespace

// --- before the step ------------------------------------------------------------------------------------------------

// A step of another length softens soft links differently, as in Bullet's solver.
void PackedCloth::follow(const ClothSolver::Parameters& parameters, btScalar dt) {
  m_isPredicted = m_isSolved = false;
  const bool restLengthsAreReset = m_body.m_bUpdateRtCst;
  if (restLengthsAreReset) {
    m_body.m_bUpdateRtCst = false;
    m_body.updateConstants();
    m_body.m_fdbvt.clear();
  }
  if (restLengthsAreReset) takeMesh();
  followMesh();
  m_dt = dt * m_body.m_cfg.timescale;
  if (linksSeemChanged(parameters)) takeLinks(parameters);
}

void PackedCloth::followMesh() {
  if (hasNewMesh()) takeMesh();
}

bool PackedCloth::hasNewMesh() const {
  return m_mesh[0] != addressOf(m_body.m_nodes) || m_mesh[1] != addressOf(m_body.m_links) ||
         m_counts[0] != m_body.m_nodes.size() || m_counts[1] != m_body.m_links.size() ||
         m_counts[2] != m_body.m_faces.size();
}

void PackedCloth::takeMesh() {
  m_mesh[0] = addressOf(m_body.m_nodes);
  m_mesh[1] = addressOf(m_body.m_links);
  m_counts[0] = m_body.m_nodes.size();
  m_counts[1] = m_body.m_links.size();
  m_counts[2] = m_body.m_faces.size();
  const NodeSlots slots = findSlots(m_body);
  m_tiles = slots.tiles;
  m_grid = slots.grid;
  m_guardMesh.reset();
  m_guardPlaces.clear();
  for (PackedNodes::Lane& settled : m_settled) settled.clear();
  m_coincident.keepOf(toSize(m_body.m_nodes.size()));
  m_facesByNodes.reset();
  m_nodes.reset(slots);
  m_links.reset(m_body, slots);
  m_normals.reset(m_body, slots);
  m_weights.resize(toSize(m_body.m_links.size()));
  for (int k = 0; k < m_body.m_links.size(); ++k) m_weights[toSize(k)] = inverseMasses(m_body.m_links[k]);
  m_stiffness = 0;  // of no link: they are taken
}

// Of a link that Bullet's solver corrects by a share of what is left in each of its passes: the compliance that lets it
// hang as far.
btScalar PackedCloth::complianceOf(const btSoftBody::Link& link, std::size_t index,
                                   const ClothSolver::Parameters& parameters) const {
  const double factor = index < m_stiffnessFactors.size() ? static_cast<double>(m_stiffnessFactors[index]) : 1;
  const double hardness = static_cast<double>(link.m_material->m_kLST) * factor;
  if (!(hardness > 0)) return std::numeric_limits<btScalar>::infinity();  // it does not pull
  if (std::isfinite(parameters.stiffness)) return static_cast<btScalar>(1 / (parameters.stiffness * hardness));
  if (hardness >= 1) return 0;
  const double left = std::pow(1 - hardness, m_body.m_cfg.piterations);
  const double dt = static_cast<double>(m_dt);
  return static_cast<btScalar>(static_cast<double>(m_weights[index]) * dt * dt * left / (1 - left));
}

bool PackedCloth::linksSeemChanged(const ClothSolver::Parameters& parameters) {
  if (m_stiffness != parameters.stiffness) return true;
  const std::size_t count = m_links.size();
  const std::size_t first = m_nextLink < count ? m_nextLink : 0;
  const std::size_t end = std::min(first + count / kStepsForAllLinks + 1, count);
  m_nextLink = end;
  for (std::size_t k = first; k < end; ++k) {
    const btSoftBody::Link& link = m_body.m_links[static_cast<int>(k)];
    if (link.m_rl != m_links.restLength(k) || complianceOf(link, k, parameters) != m_links.compliance(k)) return true;
  }
  return false;
}

void PackedCloth::setLinkStiffness(const std::vector<btScalar>& factors, unsigned long long revision) {
  if (revision == m_stiffnessRevision) return;
  m_stiffnessRevision = revision;
  m_stiffnessFactors = factors;
  m_stiffness = 0;  // of no link: they are taken
}

void PackedCloth::takeLinks(const ClothSolver::Parameters& parameters) {
  ++m_linksTaken;
  m_tethers.forget();
  m_stiffness = parameters.stiffness;
  for (std::size_t k = 0; k < m_links.size(); ++k) {
    const btSoftBody::Link& link = m_body.m_links[static_cast<int>(k)];
    m_links.set(k, link.m_rl, complianceOf(link, k, parameters));
  }
}

int PackedCloth::smallStepsFor() const {
  if (!std::isfinite(m_stiffness)) return 1;  // as soft as in Bullet's passes, or not at all
  double most = 0;
  for (std::size_t k = 0; k < m_links.size(); ++k) {
    const double compliance = static_cast<double>(m_links.compliance(k));
    const double half = static_cast<double>(inverseMasses(m_body.m_links[static_cast<int>(k)])) / 2;
    if (compliance > 0) most = std::max(most, half / compliance / m_links.passes());
  }
  return std::max(1, static_cast<int>(std::ceil(std::sqrt(most) / ClothSolver::kSmallStepsPer * (1 - kCountRounding))));
}

// As an author may leave it: some link is half as long again as at rest, or half as long.
bool PackedCloth::isCrumpled() const {
  constexpr btScalar kFar = btScalar(0.5);
  for (int k = 0; k < m_body.m_links.size(); ++k) {
    const btSoftBody::Link& link = m_body.m_links[k];
    const btScalar length = (link.m_n[1]->m_x - link.m_n[0]->m_x).length();
    if (std::fabs(length - link.m_rl) > kFar * link.m_rl) return true;
  }
  return false;
}

int PackedCloth::smallStepsIn(const ClothSolver::Parameters& parameters, double dt) const {
  return m_smallSteps.of(parameters, dt * static_cast<double>(m_body.m_cfg.timescale), isCrumpled());
}

// --- the step -------------------------------------------------------------------------------------------------------

bool PackedCloth::predict(btScalar dt) {
  m_body.m_sst.sdt = dt * m_body.m_cfg.timescale;
  m_body.m_sst.isdt = 1 / m_body.m_sst.sdt;
  m_body.m_sst.velmrg = m_body.m_sst.sdt * 3;
  m_body.m_sst.radmrg = m_body.getCollisionShape()->getMargin();
  m_body.m_sst.updmrg = m_body.m_sst.radmrg * btScalar(0.25);
  m_detection.begin(m_body);
  m_body.m_scontacts.resize(0);
  m_isPredicted = m_body.m_sst.sdt > 0 && std::isfinite(m_body.m_sst.isdt) && m_nodes.take();
  if (!m_isPredicted) return false;
  m_nodes.predict(m_body.m_sst.sdt, m_body.m_worldInfo->m_gravity, largestPush(m_body));
  updateBounds();
  updateFaceTree();
  return true;
}

void PackedCloth::updateBounds() {
  btVector3 least(0, 0, 0);
  btVector3 largest(0, 0, 0);
  m_nodes.predictedBounds(least, largest);
  const btVector3 margin = btVector3(1, 1, 1) * m_body.m_sst.radmrg;
  m_body.m_bounds[0] = least - margin;
  m_body.m_bounds[1] = largest + margin;
  if (btBroadphaseProxy* const proxy = m_body.getBroadphaseHandle()) {
    m_body.m_worldInfo->m_broadphase->setAabb(proxy, m_body.m_bounds[0], m_body.m_bounds[1],
                                              m_body.m_worldInfo->m_dispatcher);
  }
}

// Only a body that an application has given one has it: rays use it.
void PackedCloth::updateFaceTree() {
  if (m_body.m_fdbvt.empty()) return;
  for (int k = 0; k < m_body.m_faces.size(); ++k) {
    btSoftBody::Face& face = m_body.m_faces[k];
    const btVector3 velocity = (face.m_n[0]->m_v + face.m_n[1]->m_v + face.m_n[2]->m_v) / 3;
    btVector3 least = face.m_n[0]->m_x;
    btVector3 largest = least;
    for (const btSoftBody::Node* const node : face.m_n) {
      least.setMin(node->m_x);
      largest.setMax(node->m_x);
    }
    btDbvtVolume volume = btDbvtVolume::FromMM(least, largest);
    volume.Expand(btVector3(1, 1, 1) * m_body.m_sst.radmrg);
    m_body.m_fdbvt.update(face.m_leaf, volume, velocity * m_body.m_sst.velmrg, m_body.m_sst.updmrg);
  }
  m_body.m_fdbvt.optimizeIncremental(1);
}

void PackedCloth::collide(const btCollisionObjectWrapper& object) {
  const int way = m_body.m_cfg.collisions & btSoftBody::fCollision::RVSmask;
  if (m_isPredicted && way == btSoftBody::fCollision::SDF_RS) m_detection.detect(m_body, m_nodes, object);
}

// Of the places in the arrays.
btScalar PackedCloth::rounding() const {
  btScalar farthest = 0;
  for (const btVector3& corner : m_body.m_bounds) farthest = std::max(farthest, (corner - m_nodes.origin()).length());
  return farthest * std::numeric_limits<btScalar>::epsilon() / 2;
}

void PackedCloth::solve(const ClothSolver::Parameters& parameters, SmallStepViewers& viewers) {
  if (!beginSmallSteps(parameters)) return;
  for (int k = 0; k < m_count; ++k) {
    takeSmallStep(k);
    show(viewers, k);
  }
  endSmallSteps();
}

bool PackedCloth::beginSmallSteps(const ClothSolver::Parameters& parameters) {
  if (!m_isPredicted) return false;
  const double sdt = static_cast<double>(m_body.m_sst.sdt);
  m_count = m_smallSteps.of(parameters, sdt, !m_smallSteps.hasStepped() && isCrumpled());
  m_smallSteps.had(sdt, m_count);
  const btScalar count = static_cast<btScalar>(m_count);
  const btScalar keeps = std::pow(std::max(1 - m_body.m_cfg.kDP, btScalar(0)), 1 / count);
  m_step = {m_body.m_sst.sdt / count, m_body.m_worldInfo->m_gravity, keeps, largestPush(m_body) / count};
  m_links.prepare(linked(), m_step.h, rounding());
  m_anchors.prepare(m_body, m_nodes);
  m_contacts.prepare(m_body, m_nodes, m_count);
  m_tethers.follow(m_body, m_nodes, parameters.tethers, static_cast<btScalar>(parameters.tetherScale));
  const bool wasGuarded = m_isGuarded;
  m_isGuarded = parameters.guard.has_value();
  if (!m_isGuarded) return true;
  if (!wasGuarded) m_nodes.setPlaced();
  m_pins.spread(m_nodes, m_body.m_sst.sdt);
  return true;
}

void PackedCloth::show(SmallStepViewers& viewers, int index) {
  if (viewers.empty()) return;
  const LinkedNodes nodes = linked();
  viewers.show({m_body,
                index,
                m_step.h,
                m_nodes.slots(),
                {nodes.position[0], nodes.position[1], nodes.position[2]},
                m_nodes.origin()});
}

// What holds a cloth to rigid bodies comes between; without it a tile's nodes are moved and linked in one go, while
// they are in a cache.
void PackedCloth::takeSmallStep(int index) {
  const MovingNodes nodes = m_nodes.moving();
  const LinkedNodes links = linked();
  const std::size_t tileSize = nodes.count / m_tiles;
  const auto advance = [&](std::size_t tile) {
    m_step.advance(nodes, index == 0, tile * tileSize, (tile + 1) * tileSize);
  };
  const auto link = [&](std::size_t tile) { m_links.solveTile(links, tile); };
  if (m_anchors.size() + m_contacts.size() > 0) {
    forEachPart(m_tiles, advance);
    m_anchors.project(nodes, m_step.h);
    m_contacts.project(nodes, m_step.h);
    forEachPart(m_tiles, link);
  } else {
    forEachPart(m_tiles, [&](std::size_t tile) {
      advance(tile);
      link(tile);
    });
  }
  m_links.solveOthers(links);
  if (m_links.passes() > 1) forEachPart(m_tiles, [&](std::size_t tile) { m_links.solveTileBack(links, tile); });
  m_tethers.project(nodes);
  if (m_isGuarded && index == m_count - 1) m_pins.arrive(m_nodes);
}

void PackedCloth::endSmallSteps() {
  m_step.end(m_nodes.moving());
  m_isGuarded ? m_pins.end(m_nodes) : m_pins.forget();
  for (int axis = 0; axis < 3; ++axis) {
    m_settled[axis].clear();
    if (m_isGuarded && !m_grid) m_settled[axis] = m_nodes.velocity[axis];
  }
  m_isSolved = true;
}

LinkedNodes PackedCloth::linked() {
  const MovingNodes nodes = m_nodes.moving();
  return {{nodes.position[0], nodes.position[1], nodes.position[2]}, nodes.inverseMass};
}

// A restored one is made as the saved one was, wherever the nodes are by now: what is divided otherwise is kept apart
// in another order.
void PackedCloth::makeGuardMesh() {
  const bool isRestored = !m_guardPlaces.empty();
  for (int k = 0; k < m_body.m_nodes.size() && !isRestored; ++k) m_guardPlaces.push_back(m_body.m_nodes[k].m_x);
  m_guardMesh = std::make_unique<GuardMesh>(guardMeshOf(m_body, m_grid, m_guardPlaces));
  if (!isRestored) m_coincident.find(m_guardPlaces);
  m_coincident.setEdges(m_guardMesh->edges, m_guardPlaces);
  if (isRestored) m_guardMesh->edgeLength = m_guardEdge;  // links may not follow all edges
  m_guardEdge = m_guardMesh->edgeLength;
}

ClothGuard::Cloth PackedCloth::guarded() {
  const bool isNew = !m_guardMesh;
  if (isNew) makeGuardMesh();
  return {m_guardMesh.get(),
          m_nodes.moving(),
          m_nodes.slots(),
          m_nodes.nodeCount(),
          m_nodes.origin(),
          m_step.h,
          false,
          isNew,
          &m_wetness,
          m_nodes.nodesOfSlots(),
          m_coincident.isEmpty() ? nullptr : &m_coincident,
          {settledOf(0), settledOf(1), settledOf(2)}};
}

const btScalar* PackedCloth::settledOf(int axis) const {
  return m_settled[axis].size() == m_nodes.velocity[axis].size() ? m_settled[axis].data() : nullptr;
}

bool PackedCloth::separateCoincident() {
  const MovingNodes nodes = m_nodes.moving();
  const auto placeOf = [&](int node) {
    const std::size_t slot = toSize(m_nodes.slots()[node]);
    return btVector3(nodes.position[0][slot], nodes.position[1][slot], nodes.position[2][slot]);
  };
  return m_coincident.separate(placeOf);
}

std::optional<ClothGuard::Cloth> PackedCloth::standing() {
  followMesh();
  if (!m_nodes.take()) return std::nullopt;
  m_isGuarded = true;
  ClothGuard::Cloth cloth = guarded();
  cloth.isStill = true;
  return cloth;
}

const FacesByNodes& PackedCloth::facesByNodes() {
  if (!m_facesByNodes) m_facesByNodes = std::make_unique<FacesByNodes>(m_body);
  return *m_facesByNodes;
}

void PackedCloth::finish() {
  if (!m_isSolved) return;
  m_normals.compute(m_nodes.moving());
  m_nodes.write(m_normals.lanes());
  m_normals.writeFaces(m_body, m_nodes.moving());
  m_isPredicted = m_isSolved = false;
}

// --- save and restore -----------------------------------------------------------------------------------------------

void PackedCloth::transferState(StateArchive& archive) {
  if (hasNewMesh()) takeMesh();  // cut since the last step
  m_nodes.transferState(archive);
  m_links.transferState(archive);
  archive.array(m_weights);
  archive.growingArray(m_stiffnessFactors);
  archive.value(m_nextLink, m_stiffness, m_dt, m_stiffnessRevision);
  m_smallSteps.transferState(archive);
  m_pins.transferState(archive);
  transferGuardMesh(archive);
}

void PackedCloth::transferGuardMesh(StateArchive& archive) {
  unsigned char isMade = m_guardPlaces.empty() ? 0 : 1;
  archive.local(isMade);
  std::vector<btVector3> places(isMade == 0 ? 0 : toSize(m_body.m_nodes.size()));
  if (archive.isSaving()) places = m_guardPlaces;
  archive.array(places);
  archive.value(m_guardEdge);
  m_coincident.transferState(archive, m_body.m_nodes.size());
  for (PackedNodes::Lane& settled : m_settled) archive.growing(settled, [&](btScalar& speed) { archive.value(speed); });
  if (!archive.isRestoring()) return;
  m_guardPlaces = places;
  m_guardMesh.reset();
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
