// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/WhyNotTaken.h"

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

// Anchors, rigid contacts, soft contacts, links: each once.
bool hasBulletsSequence(const btSoftBody& body) {
  const btAlignedObjectArray<btSoftBody::ePSolver::_>& sequence = body.m_cfg.m_psequence;
  bool has[btSoftBody::ePSolver::END] = {};
  for (int k = 0; k < sequence.size(); ++k) {
    if (has[sequence[k]]) return false;
    has[sequence[k]] = true;
  }
  for (const bool isThere : has) {
    if (!isThere) return false;
  }
  return true;
}

}  // namespace

const char* whyNotTaken(const btSoftBody& body) {
  using Collision = btSoftBody::fCollision;
  const btSoftBody::Config& config = body.m_cfg;
  if (body.m_nodes.size() == 0) return "it has no nodes";
  if (body.m_tetras.size() > 0) return "it has tetrahedra";
  if (body.m_clusters.size() > 0) return "it has clusters";
  if (body.m_joints.size() > 0) return "it has joints";
  if (config.collisions & Collision::CL_SS) return "it collides with other soft bodies by clusters";
  if (config.collisions & Collision::RVSmask & ~Collision::SDF_RS) return "it collides with rigid bodies by clusters";
  if (config.kMT > 0 && body.m_pose.m_bframe) return "it keeps a pose (kMT)";
  if (config.kDG > 0 || config.kLF > 0) return "Bullet's own air acts on it (kDG, kLF)";
  if (config.kPR != 0) return "it has a pressure (kPR)";
  if (config.kVC > 0) return "it keeps its volume (kVC)";
  if (config.piterations <= 0) return "it has no position iterations";
  if (config.viterations > 0) return "it has velocity iterations";
  if (config.diterations > 0) return "it has drift iterations";
  if (!hasBulletsSequence(body)) return "the sequence of its position solver is another one than Bullet's";
  return "";
}

bool collidesWithSoftBodies(const btSoftBody& body) {
  return (body.m_cfg.collisions & btSoftBody::fCollision::VF_SS) != 0;
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
