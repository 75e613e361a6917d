// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/bullet/Contacts.h"

#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/bullet/Versions.h"

#include <algorithm>
#include <cstddef>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

using Flags = btSoftBody::fCollision;

ContactPoint nodePoint(int node) {
  ContactPoint point;
  point.nodes[0] = node;
  return point;
}

// Bullet's own weights may be a rounding below zero.
bool facePoint(const btSoftBody& body, const btSoftBody::Face& face, const btVector3& weights, ContactPoint& point) {
  point.count = 3;
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    point.nodes[k] = findIndex<btSoftBody::Node>(body.m_nodes, face.m_n[k]);
    point.weights[k] = std::max(0.0, static_cast<double>(weights[static_cast<int>(k)]));
    sum += point.weights[k];
    if (point.nodes[k] < 0) return false;
  }
  if (!(sum > 0)) return false;
  for (double& weight : point.weights) weight /= sum;
  return true;
}

}  // namespace

std::string whyNoRigidContacts(const btSoftBody& body, bool deformable) {
  const int flags = body.m_cfg.collisions;
  const int handler = flags & Flags::RVSmask;
  if (handler == Flags::CL_RS) {
    return "the body collides by clusters (fCollision::CL_RS), and Bullet lists no nodes for these";
  }
  if (!deformable) {
    if (handler == Flags::SDF_RS) return "";
    return "m_cfg.collisions has not fCollision::SDF_RS (alone of SDF_RS, CL_RS and SDF_RD), the one by which the "
           "position-based worlds list and solve contacts of nodes with rigid bodies";
  }
  if (handler != Flags::SDF_RD) {
    return "m_cfg.collisions has not fCollision::SDF_RD (alone of SDF_RS, CL_RS and SDF_RD), the one by which the "
           "deformable world finds contacts with rigid bodies";
  }
  if (flags & (Flags::SDF_RDN | Flags::SDF_RDF | Flags::SDF_MDF)) return "";
  return "m_cfg.collisions has neither fCollision::SDF_RDN (nodes) nor SDF_RDF (triangles), without which SDF_RD finds "
         "no contacts in the deformable world";
}

std::string whyNoNodeContacts(const btSoftBody& body, bool deformable) {
  std::string why = whyNoRigidContacts(body, deformable);
  if (!why.empty() || !deformable || (body.m_cfg.collisions & Flags::SDF_RDN)) return why;
  return "m_cfg.collisions has not fCollision::SDF_RDN, without which the deformable world lists contacts of "
         "triangles, "
         "not of nodes";
}

std::string whyNoFaceContacts(const btSoftBody& body, bool deformable) {
  const int flags = body.m_cfg.collisions;
  if (flags & Flags::CL_SS) {
    return "the body collides by clusters (fCollision::CL_SS), and Bullet lists no nodes for these";
  }
  if (deformable) {
    if (!keepsFaceContacts()) {
      return "the deformable world of Bullet " + bulletVersion() +
             " empties its list of contacts with other bodies' triangles in each substep; that of 3.22 and newer keeps "
             "it";
    }
    if (flags & Flags::VF_DD) return "";
    return "m_cfg.collisions has not fCollision::VF_DD, by which the deformable world lists contacts of nodes with "
           "other "
           "bodies' triangles";
  }
  if ((flags & Flags::SVSmask) == Flags::VF_SS) return "";
  return "m_cfg.collisions has not fCollision::VF_SS (alone of VF_SS, CL_SS and VF_DD), by which the position-based "
         "worlds list contacts of nodes with other bodies' triangles";
}

btCollisionObject* WorldObjects::find(const btCollisionObject* object) {
  if (object == m_last) return m_found;
  const btCollisionObjectArray& objects = m_world.getCollisionObjectArray();
  m_last = object;
  m_found = nullptr;
  for (int i = 0; i < objects.size() && !m_found; ++i) m_found = objects[i] == object ? objects[i] : nullptr;
  return m_found;
}

int RigidContacts::size() const {
  if (!m_deformable) return m_body.m_rcontacts.size();
  return m_body.m_nodeRigidContacts.size() + m_body.m_faceRigidContacts.size();
}

bool RigidContacts::read(int i, RigidContact& contact) {
  const int nodeContacts = m_deformable ? m_body.m_nodeRigidContacts.size() : m_body.m_rcontacts.size();
  const btSoftBody::sCti* found = nullptr;
  contact.face = -1;
  if (!m_deformable) {
    btSoftBody::RContact& entry = m_body.m_rcontacts[i];
    contact.point = nodePoint(findIndex<btSoftBody::Node>(m_body.m_nodes, entry.m_node));
    contact.positionBased = &entry;
    found = &entry.m_cti;
  } else if (i < nodeContacts) {
    btSoftBody::DeformableNodeRigidContact& entry = m_body.m_nodeRigidContacts[i];
    contact.point = nodePoint(findIndex<btSoftBody::Node>(m_body.m_nodes, entry.m_node));
    contact.deformable = &entry;
    found = &entry.m_cti;
  } else {
    btSoftBody::DeformableFaceRigidContact& entry = m_body.m_faceRigidContacts[i - nodeContacts];
    contact.face = findIndex<btSoftBody::Face>(m_body.m_faces, entry.m_face);
    if (contact.face < 0) return false;
    if (!facePoint(m_body, m_body.m_faces[contact.face], entry.m_bary, contact.point)) return false;
    contact.deformable = &entry;
    found = &entry.m_cti;
  }
  contact.object = m_objects.find(found->m_colObj);
  if (contact.point.nodes[0] < 0 || !contact.object) return false;
  contact.normal = found->m_normal;
  contact.gap = static_cast<double>(found->m_offset);
  if (!m_deformable) {
    contact.gap += static_cast<double>(m_body.m_nodes[contact.point.nodes[0]].m_x.dot(found->m_normal));
  }
  return true;
}

int FaceContacts::size() const {
  return m_deformable ? m_nodesOf.m_faceNodeContacts.size() : m_nodesOf.m_scontacts.size();
}

bool FaceContacts::read(int i, FaceContact& contact) {
  const auto fill = [&](const auto& entry, const btVector3& weights) {
    contact.node = findIndex<btSoftBody::Node>(m_nodesOf.m_nodes, entry.m_node);
    contact.face = findIndex<btSoftBody::Face>(m_facesOf.m_faces, entry.m_face);
    contact.normal = entry.m_normal;
    return contact.node >= 0 && contact.face >= 0 &&
           facePoint(m_facesOf, m_facesOf.m_faces[contact.face], weights, contact.point);
  };
  if (m_deformable) return fill(m_nodesOf.m_faceNodeContacts[i], m_nodesOf.m_faceNodeContacts[i].m_bary);
  contact.positionBased = &m_nodesOf.m_scontacts[i];
  return fill(*contact.positionBased, contact.positionBased->m_weights);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
