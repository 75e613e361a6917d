// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/state/SoftBodyState.h"

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

void transferNodePointer(StateArchive& archive, btSoftBody::tNodeArray& nodes, btSoftBody::Node*& node) {
  const int index = archive.isSaving() ? findIndex<btSoftBody::Node>(nodes, node) : 0;
  const int place = archive.place(index, nodes.size(), "node of a contact");
  if (archive.isRestoring()) node = &nodes[place];
}

void transferFacePointer(StateArchive& archive, btSoftBody::tFaceArray& faces, btSoftBody::Face*& face) {
  const int index = archive.isSaving() ? findIndex<btSoftBody::Face>(faces, face) : 0;
  const int place = archive.place(index, faces.size(), "face of a contact");
  if (archive.isRestoring()) face = &faces[place];
}

// A contact's face may be another body's.
void transferFacePointer(StateArchive& archive, const SoftBodyArray& bodies, btSoftBody::Face*& face) {
  int owner = 0;
  if (archive.isSaving()) {
    while (owner < bodies.size() && findIndex<btSoftBody::Face>(bodies[owner]->m_faces, face) < 0) ++owner;
  }
  owner = archive.place(owner < bodies.size() ? owner : -1, bodies.size(), "soft body of a contact");
  transferFacePointer(archive, bodies[owner]->m_faces, face);
}

// Bullet leaves the lists of the last step as they are when a body is cut, or leaves the world.
template <class Contact>
auto namesNode(const btSoftBody& body) {
  return [&](const Contact& contact) { return findIndex<btSoftBody::Node>(body.m_nodes, contact.m_node) >= 0; };
}

template <class Contact>
auto namesFace(const btSoftBody& body) {
  return [&](const Contact& contact) { return findIndex<btSoftBody::Face>(body.m_faces, contact.m_face) >= 0; };
}

template <class Contact>
auto namesNodeAndFace(const btSoftBody& body, const SoftBodyArray& bodies) {
  return [&](const Contact& contact) {
    bool isThere = false;
    for (int i = 0; i < bodies.size() && !isThere; ++i) isThere = namesFace<Contact>(*bodies[i])(contact);
    return isThere && namesNode<Contact>(body)(contact);
  };
}

void transferInfo(StateArchive& archive, btSoftBody::sCti& info) {
  archive.object(info.m_colObj);
  archive.value(info.m_normal, info.m_offset);  // Bullet neither writes nor reads m_bary of this
}

// Bullet sets the impulse matrix and the arm for a rigid body only, and the rest for links of multibodies only.
void transferRigid(StateArchive& archive, btSoftBody::DeformableRigidContact& contact) {
  const btCollisionObject* const object = contact.m_cti.m_colObj;
  const bool isThere = archive.isSaving() && archive.has(object);
  unsigned char isRigid = isThere && object->getInternalType() == btCollisionObject::CO_RIGID_BODY ? 1 : 0;
  transferInfo(archive, contact.m_cti);
  archive.local(isRigid);
  if (isRigid != 0) archive.value(contact.m_c0, contact.m_c1);
  archive.value(contact.m_c2, contact.m_c3, contact.m_c4, contact.m_c5);
}

void transferPositionBased(StateArchive& archive, btSoftBody& body, const SoftBodyArray& bodies) {
  using Rigid = btSoftBody::RContact;
  const auto transferRigid = [&](Rigid& contact) {
    transferInfo(archive, contact.m_cti);
    transferNodePointer(archive, body.m_nodes, contact.m_node);
    // t1 and t2 are set for the links of multibodies only, and anew in each step before they are read.
    archive.value(contact.m_c0, contact.m_c1, contact.m_c2, contact.m_c3, contact.m_c4);
  };
  archive.growing(body.m_rcontacts, transferRigid, namesNode<Rigid>(body));
  using Soft = btSoftBody::SContact;
  const auto transferSoft = [&](Soft& contact) {
    transferNodePointer(archive, body.m_nodes, contact.m_node);
    transferFacePointer(archive, bodies, contact.m_face);
    archive.value(contact.m_weights, contact.m_normal, contact.m_margin, contact.m_friction);
    archive.value(contact.m_cfm[0], contact.m_cfm[1]);
  };
  archive.growing(body.m_scontacts, transferSoft, namesNodeAndFace<Soft>(body, bodies));
}

// Bullet has it from 3.22 on.
template <class FaceNode>
auto transferOther(StateArchive& archive, FaceNode& contact, int /*newer*/)
    -> decltype(archive.object(contact.m_colObj)) {
  archive.object(contact.m_colObj);
}

template <class FaceNode>
void transferOther(StateArchive& /*archive*/, FaceNode& /*contact*/, long /*older*/) {}

void transferDeformable(StateArchive& archive, btSoftBody& body, const SoftBodyArray& bodies) {
  using NodeRigid = btSoftBody::DeformableNodeRigidContact;
  const auto transferNodeRigid = [&](NodeRigid& contact) {
    transferRigid(archive, contact);
    transferNodePointer(archive, body.m_nodes, contact.m_node);
  };
  archive.growing(body.m_nodeRigidContacts, transferNodeRigid, namesNode<NodeRigid>(body));
  using FaceRigid = btSoftBody::DeformableFaceRigidContact;
  const auto transferFaceRigid = [&](FaceRigid& contact) {
    transferRigid(archive, contact);
    transferFacePointer(archive, body.m_faces, contact.m_face);
    archive.value(contact.m_contactPoint, contact.m_bary, contact.m_weights);
  };
  archive.growing(body.m_faceRigidContacts, transferFaceRigid, namesFace<FaceRigid>(body));
  using FaceNode = btSoftBody::DeformableFaceNodeContact;
  const auto transferFaceNode = [&](FaceNode& contact) {
    transferNodePointer(archive, body.m_nodes, contact.m_node);
    transferFacePointer(archive, bodies, contact.m_face);
    transferOther(archive, contact, 0);
    archive.value(contact.m_bary, contact.m_weights, contact.m_normal, contact.m_margin, contact.m_friction);
    archive.value(contact.m_imf, contact.m_c0);
  };
  archive.growing(body.m_faceNodeContacts, transferFaceNode, namesNodeAndFace<FaceNode>(body, bodies));
}

}  // namespace

// Jacobians of multibodies are left out: they are computed when a contact is found and used in the same substep.
// m_faceNodeContactsCCD is filled and emptied within the substep.
void transferContacts(StateArchive& archive, btSoftBody& body, const SoftBodyArray& bodies) {
  transferPositionBased(archive, body, bodies);
  transferDeformable(archive, body, bodies);
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
