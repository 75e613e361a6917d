// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/GuardContacts.h"

#include "bullet_wetcloth/bullet/Index.h"
#include "bullet_wetcloth/solver/PackedCloth.h"
#include "bullet_wetcloth/solver/Separation.h"
#include "bullet_wetcloth/solver/WhyNotTaken.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

// A vertex and a face that a plane tells apart.
struct TouchingPair {
  PackedCloth* vertexOf;
  PackedCloth* faceOf;
  int nodes[4];  // each in its own cloth
  double places[4][3];
};

// False: one is a rigid body's, or the vertex one of a cloth that is not stepped.
bool readPair(const ClothGuard& guard, const std::vector<PackedCloth*>& cloths, std::size_t stepped, std::size_t plane,
              TouchingPair& pair) {
  const std::vector<std::size_t>& first = guard.firstNodes();
  std::size_t owners[4];
  for (int k = 0; k < 4; ++k) {
    const std::size_t node = toSize(guard.vertexFace().node(plane, k));
    const auto next = std::upper_bound(first.begin(), first.end(), node);
    owners[k] = static_cast<std::size_t>(next - first.begin()) - 1;
    if (owners[k] >= (k == 0 ? stepped : cloths.size())) return false;
    pair.nodes[k] = static_cast<int>(node - first[owners[k]]);
    for (int axis = 0; axis < 3; ++axis) {
      pair.places[k][axis] = static_cast<double>(guard.nodes().to[node].at[axis]);
    }
  }
  pair.vertexOf = cloths[owners[0]];
  pair.faceOf = cloths[owners[1]];
  return collidesWithSoftBodies(pair.vertexOf->body()) && collidesWithSoftBodies(pair.faceOf->body());
}

// As Bullet has it: a face with a pinned corner does not yield.
btScalar faceInverseMassOf(const btSoftBody::Face& face, const btVector3& weights) {
  btScalar sum = 0;
  for (int k = 0; k < 3; ++k) {
    if (!(face.m_n[k]->m_im > 0)) return 0;
    sum += face.m_n[k]->m_im * weights[k];
  }
  return sum;
}

// The weights are in the order of the pair's nodes, a face's in its own.
btVector3 faceWeightsOf(const btSoftBody& body, const btSoftBody::Face& face, const TouchingPair& pair,
                        const Separation& separation) {
  btVector3 weights(0, 0, 0);
  for (int k = 0; k < 3; ++k) {
    for (int corner = 1; corner < 4; ++corner) {
      const bool isIt = face.m_n[k] == &body.m_nodes[pair.nodes[corner]];
      if (isIt) weights[k] = static_cast<btScalar>(-separation.weights[corner]);
    }
  }
  return weights;
}

void listContact(const TouchingPair& pair, int number, const Separation& separation, btScalar margin,
                 btScalar friction) {
  btSoftBody& vertexOf = pair.vertexOf->body();
  btSoftBody& faceOf = pair.faceOf->body();
  btSoftBody::SContact contact;
  contact.m_node = &vertexOf.m_nodes[pair.nodes[0]];
  contact.m_face = &faceOf.m_faces[number];
  contact.m_weights = faceWeightsOf(faceOf, *contact.m_face, pair, separation);
  const btScalar ofVertex = contact.m_node->m_im;
  const btScalar ofFace = faceInverseMassOf(*contact.m_face, contact.m_weights);
  if (!(ofVertex + ofFace > 0)) return;
  for (int axis = 0; axis < 3; ++axis) contact.m_normal[axis] = static_cast<btScalar>(separation.normal[axis]);
  contact.m_normal[3] = 0;
  contact.m_margin = margin;
  contact.m_friction = friction;
  contact.m_cfm[0] = ofVertex / (ofVertex + ofFace) * vertexOf.m_cfg.kSHR;
  contact.m_cfm[1] = ofFace / (ofVertex + ofFace) * faceOf.m_cfg.kSHR;
  vertexOf.m_scontacts.push_back(contact);
}

}  // namespace

// A plane is up to some small steps old; a gap along its normal is at most what the parts are apart.
void listContacts(const ClothGuard& guard, const std::vector<PackedCloth*>& cloths, std::size_t stepped) {
  constexpr btScalar kAnyWay = -std::numeric_limits<btScalar>::infinity();
  const GuardPlanes& planes = guard.vertexFace();
  TouchingPair pair;
  for (std::size_t block = 0; block < planes.blocks(); ++block) {
    unsigned near = GuardPlanes::below(planes.kept(block), guard.touching(), kAnyWay);
    for (std::size_t plane = block * GuardPlanes::kAtOnce; near != 0; ++plane, near >>= 1) {
      if ((near & 1) == 0 || !readPair(guard, cloths, stepped, plane, pair)) continue;
      const Separation separation = separationOfVertexAndFace(pair.places);
      if (!(separation.distance <= static_cast<double>(guard.touching()))) continue;
      const int face = pair.faceOf->facesByNodes().find(pair.nodes[1], pair.nodes[2], pair.nodes[3]);
      if (face >= 0) listContact(pair, face, separation, guard.touching(), guard.frictionOf(plane));
    }
  }
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
