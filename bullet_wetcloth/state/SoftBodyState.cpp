// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/state/SoftBodyState.h"

#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/bullet/Versions.h"
#include "bullet_wetcloth/state/TreeState.h"

#include <algorithm>
#include <string>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

void requireSavable(StateArchive& archive, const btSoftBody& body) {
  if (body.m_tetras.size() > 0) archive.fail("a soft body has tetrahedra, whose state is not saved");
  if (isReduced(body)) archive.fail("a soft body is a btReducedDeformableBody, whose state is not saved");
  if (body.m_joints.size() > 0) archive.fail("a soft body has joints of clusters, whose state is not saved");
}

void requireSameShape(StateArchive& archive, const btSoftBody& body) {
  archive.expect(body.m_nodes.size(), "a soft body's number of nodes");
  archive.expect(body.m_links.size(), "a soft body's number of links");
  archive.expect(body.m_faces.size(), "a soft body's number of faces");
  archive.expect(body.m_anchors.size(), "a soft body's number of anchors");
  archive.expect(body.m_deformableAnchors.size(), "a soft body's number of anchors of the deformable world");
  archive.expect(body.m_clusters.size(), "a soft body's number of clusters");
}

void transferNode(StateArchive& archive, btSoftBody::Node& node) {
  archive.value(node.m_x, node.m_q, node.m_v, node.m_vn, node.m_f, node.m_n, node.m_splitv);
  archive.value(node.m_im, node.m_area, node.m_constrained);
  archive.value(node.m_effectiveMass, node.m_effectiveMass_inv);
  bool isAttached = node.m_battach != 0;
  archive.value(isAttached);
  if (archive.isRestoring()) node.m_battach = isAttached ? -1 : 0;  // one bit, signed
}

void transferLink(StateArchive& archive, btSoftBody::Link& link) {
  archive.value(link.m_c3, link.m_rl, link.m_c0, link.m_c1, link.m_c2);
}

void transferFace(StateArchive& archive, btSoftBody::Face& face) {
  archive.value(face.m_normal, face.m_ra, face.m_n0, face.m_n1, face.m_vn);
  for (int k = 0; k < 4; ++k) archive.value(face.m_pcontact[k]);
}

void transferPose(StateArchive& archive, btSoftBody::Pose& pose) {
  archive.value(pose.m_bvolume, pose.m_bframe, pose.m_volume, pose.m_com, pose.m_rot, pose.m_scl);
  unsigned char isSet = pose.m_bvolume || pose.m_bframe ? 1 : 0;
  archive.local(isSet);
  if (isSet != 0) archive.value(pose.m_aqq);
  archive.each(pose.m_pos, [&](btVector3& place) { archive.value(place); });
  archive.each(pose.m_wgh, [&](btScalar& weight) { archive.value(weight); });
}

void transferCluster(StateArchive& archive, btSoftBody::Cluster& cluster) {
  archive.each(cluster.m_masses, [&](btScalar& mass) { archive.value(mass); });
  archive.each(cluster.m_framerefs, [&](btVector3& place) { archive.value(place); });
  archive.value(cluster.m_framexform, cluster.m_imass, cluster.m_locii, cluster.m_invwi);
  archive.value(cluster.m_com, cluster.m_vimpulses[0], cluster.m_vimpulses[1], cluster.m_dimpulses[0]);
  archive.value(cluster.m_dimpulses[1], cluster.m_nvimpulses, cluster.m_ndimpulses, cluster.m_lv, cluster.m_av);
}

// Of the anchors of the deformable world Bullet sets the rest for links of multibodies only; the constants of the
// others are computed before each solve.
void transferAnchors(StateArchive& archive, btSoftBody& body) {
  for (int k = 0; k < body.m_anchors.size(); ++k) {
    archive.value(body.m_anchors[k].m_local, body.m_anchors[k].m_influence);
  }
  for (int k = 0; k < body.m_deformableAnchors.size(); ++k) {
    btSoftBody::DeformableNodeRigidAnchor& anchor = body.m_deformableAnchors[k];
    archive.value(anchor.m_local, anchor.m_c0, anchor.m_c1, anchor.m_c2, anchor.m_c3, anchor.m_c4);
    archive.value(anchor.m_cti.m_normal, anchor.m_cti.m_offset);
  }
}

// Bullet sets these in the first substep.
void transferStep(StateArchive& archive, btSoftBody::SolverState& step) {
  unsigned char isSet = step.sdt != 0 && step.isdt == 1 / step.sdt ? 1 : 0;
  archive.local(isSet);
  if (isSet != 0) archive.value(step.sdt, step.isdt, step.velmrg, step.radmrg, step.updmrg);
}

void transferSolver(StateArchive& archive, btSoftBody& body) {
  transferStep(archive, body.m_sst);
  archive.value(body.m_timeacc, body.m_bounds[0], body.m_bounds[1], body.m_bUpdateRtCst, body.m_maxSpeedSquared);
  archive.value(body.m_restLengthScale, body.m_windVelocity, body.m_softSoftCollision);
}

template <class Element>
TreeLeaves leavesOf(const char* what, btAlignedObjectArray<Element>& elements) {
  TreeLeaves leaves;
  leaves.what = what;
  leaves.size = elements.size();
  leaves.indexOf = [&](const void* data) { return findIndex<Element>(elements, static_cast<const Element*>(data)); };
  leaves.dataOf = [&](int index) -> void* { return &elements[index]; };
  leaves.tell = [&](int index, btDbvtNode& leaf) { elements[index].m_leaf = &leaf; };
  return leaves;
}

TreeLeaves leavesOf(btSoftBody::tClusterArray& clusters) {
  TreeLeaves leaves;
  leaves.what = "cluster";
  leaves.size = clusters.size();
  leaves.indexOf = [&](const void* data) {
    for (int k = 0; k < clusters.size(); ++k) {
      if (clusters[k] == data) return k;
    }
    return -1;
  };
  leaves.dataOf = [&](int index) -> void* { return clusters[index]; };
  leaves.tell = [&](int index, btDbvtNode& leaf) { clusters[index]->m_leaf = &leaf; };
  return leaves;
}

bool isComplete(const std::vector<bool>& has) { return std::find(has.begin(), has.end(), false) == has.end(); }
bool isEmpty(const std::vector<bool>& has) { return std::find(has.begin(), has.end(), true) == has.end(); }

void transferTrees(StateArchive& archive, btSoftBody& body) {
  if (archive.isRestoring()) {
    for (int i = 0; i < body.m_nodes.size(); ++i) body.m_nodes[i].m_leaf = nullptr;
    for (int i = 0; i < body.m_faces.size(); ++i) body.m_faces[i].m_leaf = nullptr;
    for (int i = 0; i < body.m_clusters.size(); ++i) body.m_clusters[i]->m_leaf = nullptr;
  }
  const TreeLeaves nodes = leavesOf("node", body.m_nodes);
  TreeLeaves faces = leavesOf("face", body.m_faces);
  const bool hasAllNodes = isComplete(transferTree(archive, body.m_ndbvt, nodes));
  const std::vector<bool> hasFaces = transferTree(archive, body.m_fdbvt, faces);
  // Bullet looks for the leaf of each node, and of each face once there is one of any.
  if (!hasAllNodes || !(isEmpty(hasFaces) || isComplete(hasFaces))) archive.fail("a tree of boxes has not all leaves");
  transferTree(archive, body.m_cdbvt, leavesOf(body.m_clusters));
  faces.tell = {};
  transferNormalTree(archive, body.m_fdbvnt, faces);
}

}  // namespace

void transferSoftBody(StateArchive& archive, btSoftBody& body, const SoftBodyArray& bodies) {
  requireSavable(archive, body);
  requireSameShape(archive, body);
  for (int i = 0; i < body.m_nodes.size(); ++i) transferNode(archive, body.m_nodes[i]);
  for (int i = 0; i < body.m_links.size(); ++i) transferLink(archive, body.m_links[i]);
  for (int i = 0; i < body.m_faces.size(); ++i) transferFace(archive, body.m_faces[i]);
  for (int i = 0; i < body.m_clusters.size(); ++i) transferCluster(archive, *body.m_clusters[i]);
  transferPose(archive, body.m_pose);
  transferAnchors(archive, body);
  transferSolver(archive, body);
  transferTrees(archive, body);
  transferContacts(archive, body, bodies);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
