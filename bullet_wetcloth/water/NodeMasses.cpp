// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/water/NodeMasses.h"

#include "bullet_wetcloth/bullet/ImpulseMatrix.h"
#include "bullet_wetcloth/state/StateArchive.h"

#include <BulletSoftBody/btDeformableBackwardEulerObjective.h>
#include <BulletSoftBody/btDeformableBodySolver.h>
#include <BulletSoftBody/btPreconditioner.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

constexpr std::size_t kStepsForAllNodes = 32;  // steps in which all nodes are looked at

}  // namespace

void NodeMasses::remember() {
  m_inverseMass.resize(static_cast<std::size_t>(m_body.m_nodes.size()));
  for (int i = 0; i < m_body.m_nodes.size(); ++i) m_inverseMass[static_cast<std::size_t>(i)] = m_body.m_nodes[i].m_im;
}

bool NodeMasses::seemSet() {
  if (m_body.m_bUpdateRtCst) return true;
  const std::size_t count = m_inverseMass.size();
  const std::size_t first = m_nextNode < count ? m_nextNode : 0;
  const std::size_t end = std::min(first + count / kStepsForAllNodes + 1, count);
  m_nextNode = end;
  for (std::size_t i = first; i < end; ++i) {
    if (m_body.m_nodes[static_cast<int>(i)].m_im != m_inverseMass[i]) return true;
  }
  return false;
}

bool NodeMasses::wereSet() const {
  for (std::size_t i = 0; i < m_inverseMass.size(); ++i) {
    if (m_body.m_nodes[static_cast<int>(i)].m_im != m_inverseMass[i]) return true;
  }
  return false;
}

bool NodeMasses::takeOver(Water& water) {
  bool isAnySet = false;
  double held = 0;
  double before = 0;  // dry mass of the nodes that were free and still are
  double after = 0;
  for (std::size_t i = 0; i < m_inverseMass.size(); ++i) {
    const btScalar found = m_body.m_nodes[static_cast<int>(i)].m_im;
    const bool isFree = found > 0 && m_inverseMass[i] > 0;
    held += water.held(i);
    before += isFree ? water.dryMass(i) : 0;
    if (found != m_inverseMass[i]) {
      isAnySet = true;
      if (found > 0 && std::isfinite(found)) water.setDryMass(i, 1 / static_cast<double>(found));
      m_inverseMass[i] = found;
    }
    after += isFree ? water.dryMass(i) : 0;
  }
  if (after != before) scalePinned(water, after / before);
  return isAnySet && held > 0;
}

void NodeMasses::scalePinned(Water& water, double factor) const {
  for (std::size_t i = 0; i < m_inverseMass.size(); ++i) {
    if (m_inverseMass[i] == 0) water.setDryMass(i, water.dryMass(i) * factor);
  }
}

bool NodeMasses::areDue(const Water& water, double tolerance) const {
  if (tolerance == 0) return true;
  for (std::size_t i = 0; i < m_inverseMass.size(); ++i) {
    if (m_inverseMass[i] == 0) continue;
    const double share = water.totalMass(i) * static_cast<double>(m_inverseMass[i]) - 1;
    const Water::Arrival& arrival = water.arrival(i);
    const double arrived = (arrival.mass + arrival.runOff) * static_cast<double>(m_inverseMass[i]);
    if (!(std::fabs(share) <= tolerance && arrived <= tolerance)) return true;
  }
  return false;
}

bool NodeMasses::commit(Water& water) {
  const bool changed = writeNodes(water);
  water.clearArrivals();
  if (!changed) return false;
  ++m_commits;
  if (m_body.m_clusters.size() > 0) refreshClusters();
  if (m_body.m_pose.m_bframe) refreshPose();
  if (m_deformable) refreshDeformable();
  return true;
}

bool NodeMasses::writeNodes(Water& water) {
  bool changed = false;
  for (std::size_t i = 0; i < m_inverseMass.size(); ++i) {
    btSoftBody::Node& node = m_body.m_nodes[static_cast<int>(i)];
    if (node.m_im != m_inverseMass[i]) {
      takeOver(water);
      changed = true;
    }
    if (node.m_im == 0) continue;
    mixMomentum(node, water, i);
    // However much water it is, it does not pin the node.
    const btScalar rounded =
        std::max(static_cast<btScalar>(1 / water.totalMass(i)), std::numeric_limits<btScalar>::min());
    changed = changed || rounded != node.m_im;
    node.m_im = m_inverseMass[i] = rounded;
  }
  return changed;
}

void NodeMasses::joinArrival(Water& water, std::size_t node) {
  btSoftBody::Node& target = m_body.m_nodes[static_cast<int>(node)];
  if (target.m_im > 0) mixMomentum(target, water, node);
  water.joinArrival(node);
}

// What leaves takes the node's own velocity with it, so only arrivals change the velocity: v' - v = (p - dm v) /
// (m + dm), with m the mass that they meet, the node's before anything dripped or dried off it.
void NodeMasses::mixMomentum(btSoftBody::Node& node, const Water& water, std::size_t index) const {
  const Water::Arrival& arrival = water.arrival(index);
  const double arrived = arrival.mass + arrival.runOff;
  if (!(arrived > 0)) return;
  const bool isSum = !water.leftSinceCommit() && arrival.runOff == 0;
  const double met = 1 / static_cast<double>(node.m_im) + arrival.shifted;
  const double inverseMass = 1 / (isSum ? water.totalMass(index) : std::max(met, 0.0) + arrived);
  const auto change = [&](int axis) {
    const double velocity = static_cast<double>(node.m_v[axis]);
    return static_cast<btScalar>((arrival.momentum[axis] - arrived * velocity) * inverseMass);
  };
  const btVector3 deltaVelocity(change(0), change(1), change(2));
  node.m_v += deltaVelocity;
  if (m_deformable) node.m_vn += deltaVelocity;
}

// As btSoftBody::initializeClusters(), which cannot run on a moving body (it zeroes velocities and leaks the
// cluster's tree leaf): masses, and then centre, inertia and frame in the rest shape.
void NodeMasses::refreshClusters() {
  for (int k = 0; k < m_body.m_clusters.size(); ++k) {
    btSoftBody::Cluster& cluster = *m_body.m_clusters[k];
    if (cluster.m_nodes.size() == 0 || cluster.m_masses.size() != cluster.m_nodes.size()) continue;
    btScalar total = 0;
    btVector3 centre(0, 0, 0);
    for (int j = 0; j < cluster.m_nodes.size(); ++j) {
      const btScalar inverseMass = cluster.m_nodes[j]->m_im;
      cluster.m_masses[j] = inverseMass > 0 ? 1 / inverseMass : btScalar(BT_LARGE_FLOAT);
      total += cluster.m_masses[j];
      centre += cluster.m_framerefs[j] * cluster.m_masses[j];
    }
    cluster.m_imass = 1 / total;
    centre *= cluster.m_imass;
    btMatrix3x3 inertia(0, 0, 0, 0, 0, 0, 0, 0, 0);
    for (int j = 0; j < cluster.m_nodes.size(); ++j) {
      cluster.m_framerefs[j] -= centre;
      const btVector3& r = cluster.m_framerefs[j];
      const btScalar mass = cluster.m_masses[j];
      const btScalar squared = r.length2();
      for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) inertia[row][column] -= mass * r[row] * r[column];
        inertia[row][row] += mass * squared;
      }
    }
    cluster.m_locii = inertia.inverse();
  }
}

// As btSoftBody::setPose(), which would also reset every rest length: weights by mass, and then the reference shape
// about its new centre.
void NodeMasses::refreshPose() {
  btSoftBody::Pose& pose = m_body.m_pose;
  const int count = m_body.m_nodes.size();
  if (pose.m_wgh.size() != count || pose.m_pos.size() != count) return;
  btScalar freeMass = 0;
  int pinned = 0;
  for (int i = 0; i < count; ++i) {
    if (m_body.m_nodes[i].m_im > 0) {
      freeMass += 1 / m_body.m_nodes[i].m_im;
    } else {
      ++pinned;
    }
  }
  const btScalar pinnedMass = freeMass * static_cast<btScalar>(count) * 1000;  // Bullet's own weight for a pin
  const btScalar total = freeMass + static_cast<btScalar>(pinned) * pinnedMass;
  btVector3 centre(0, 0, 0);
  for (int i = 0; i < count; ++i) {
    const btScalar inverseMass = m_body.m_nodes[i].m_im;
    pose.m_wgh[i] = (inverseMass > 0 ? 1 / inverseMass : pinnedMass) / total;
    centre += pose.m_pos[i] * pose.m_wgh[i];
  }
  btMatrix3x3 moments(0, 0, 0, 0, 0, 0, 0, 0, 0);
  for (int i = 0; i < count; ++i) {
    pose.m_pos[i] -= centre;
    const btVector3& r = pose.m_pos[i];
    for (int row = 0; row < 3; ++row) moments[row] += r * (pose.m_wgh[i] * r[row]);
  }
  // A flat cloth has no extent across itself: Bullet's own inverse is not finite there, and ours leaves it alone.
  if (moments.determinant() != 0) pose.m_aqq = moments.inverse();
}

void NodeMasses::refreshDeformable() {
  for (int i = 0; i < m_body.m_deformableAnchors.size(); ++i) {
    btSoftBody::DeformableNodeRigidAnchor& anchor = m_body.m_deformableAnchors[i];
    anchor.m_c2 = anchor.m_node->m_im;
    const btRigidBody* rigid = btRigidBody::upcast(anchor.m_cti.m_colObj);
    if (rigid) anchor.m_c0 = impulseMatrix(anchor.m_node->m_im, *rigid, anchor.m_c1);
  }
  btSoftBodySolver* solver = m_body.getSoftBodySolver();
  if (solver) static_cast<btDeformableBodySolver*>(solver)->m_objective->m_massPreconditioner->reinitialize(true);
}

void NodeMasses::transferState(StateArchive& archive) {
  archive.array(m_inverseMass);
  archive.value(m_nextNode);
  archive.value(m_commits);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
