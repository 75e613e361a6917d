// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/AnchorProjection.h"

#include "bullet_wetcloth/bullet/ImpulseMatrix.h"
#include "bullet_wetcloth/bullet/Index.h"

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

// Bullet has moved its bodies when the cloth is solved: the way back to the start of the step is known by their
// velocities.
void AnchorProjection::prepare(btSoftBody& body, const LocalNodes& nodes) {
  m_anchors.clear();
  m_hardness = body.m_cfg.kAHR;
  for (int k = 0; k < body.m_anchors.size(); ++k) {
    btSoftBody::Anchor& listed = body.m_anchors[k];
    btRigidBody& rigid = *listed.m_body;
    const btTransform& pose = rigid.getWorldTransform();
    Anchor anchor = {};
    anchor.slot = nodes.slot(toSize(nodeIndex(body, listed.m_node)));
    anchor.rigid = &rigid;
    anchor.arm = pose.getBasis() * listed.m_local;
    const btVector3 velocity = rigid.getVelocityInLocalPoint(anchor.arm);
    anchor.place = pose * listed.m_local - velocity * body.m_sst.sdt - nodes.origin();
    anchor.inverseMass = listed.m_node->m_im;
    anchor.pushes = impulseMatrix(anchor.inverseMass, rigid, anchor.arm);
    anchor.influence = listed.m_influence;
    rigid.activate();
    listed.m_c0 = anchor.pushes.scaled(btVector3(1, 1, 1) * body.m_sst.isdt);
    listed.m_c1 = anchor.arm;
    listed.m_c2 = anchor.inverseMass * body.m_sst.sdt;
    m_anchors.push_back(anchor);
  }
}

void AnchorProjection::project(const MovingNodes& nodes, btScalar h) {
  for (Anchor& anchor : m_anchors) {
    const std::size_t i = anchor.slot;
    const btVector3 way = nodes.wayOf(i, h);
    const btVector3 previous = nodes.placeOf(i) - way;
    const btVector3 carried = anchor.rigid->getVelocityInLocalPoint(anchor.arm) * h;
    const btVector3 lag = carried - way + (anchor.place - previous) * m_hardness;
    anchor.place += carried;
    const btVector3 impulse = anchor.pushes * lag * (anchor.influence / h);
    const btVector3 moved = impulse * (anchor.inverseMass * h);
    for (int axis = 0; axis < 3; ++axis) nodes.position[axis][i] += moved[axis];
    anchor.rigid->applyImpulse(-impulse, anchor.arm);
  }
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
