// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/effects/WetFriction.h"

#include "bullet_wetcloth/Require.h"
#include "bullet_wetcloth/WetCloth.h"
#include "bullet_wetcloth/WetClothWorld.h"
#include "bullet_wetcloth/bullet/Contacts.h"
#include "bullet_wetcloth/state/StateArchive.h"

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>
#include <string>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

void requireValid(const WetFriction::Parameters& parameters) {
  requireNotNegative("WetFriction.wetFactor", parameters.wetFactor);
  if (!(parameters.peakSaturation > 0 && parameters.peakSaturation <= 1)) {
    rejectValue("WetFriction.peakSaturation", parameters.peakSaturation, "in (0, 1]");
  }
  requireNotNegative("WetFriction.floodedFactor", parameters.floodedFactor);
}

double saturationAt(const Water& water, const ContactPoint& point) {
  double saturation = 0;
  for (int k = 0; k < point.count; ++k) {
    const std::size_t corner = static_cast<std::size_t>(k);
    saturation += point.weights[corner] * water.saturation(static_cast<std::size_t>(point.nodes[corner]));
  }
  return saturation;
}

// In the precision in which a body whose kDF had been set to the product would hold it.
btScalar scaled(btScalar coefficient, double factor) {
  return static_cast<btScalar>(static_cast<double>(coefficient) * factor);
}

}  // namespace

btScalar slidingShare(btScalar friction, btScalar normal, const btVector3& tangential) {
  const btScalar cone = normal * friction * normal * friction;
  return tangential.length2() < cone ? 0 : 1 - std::min(friction, btScalar(1));
}

WetFriction::WetFriction(Parameters parameters) { setParameters(parameters); }

void WetFriction::setParameters(Parameters parameters) {
  requireValid(parameters);
  m_parameters = parameters;
  m_curve = {1, parameters.wetFactor, parameters.floodedFactor, parameters.peakSaturation};
}

void WetFriction::attach(WetCloth& cloth) {
  const std::string noRigid = whyNoRigidContacts(cloth.body(), cloth.isInDeformableWorld());
  const std::string noFaces =
      cloth.isInDeformableWorld()
          ? "the deformable world finds contacts of two soft bodies after its solve and applies "
            "their friction at once, out of reach"
          : whyNoFaceContacts(cloth.body(), cloth.isInDeformableWorld());
  if (!noRigid.empty() && !noFaces.empty()) {
    reject("WetFriction", "Bullet lists no contacts of this body: with rigid bodies, because " + noRigid +
                              "; with soft bodies, because " + noFaces);
  }
  m_hasFaceContacts = noFaces.empty();
  m_factors.resize(cloth.water().size());
}

void WetFriction::detach(WetCloth& cloth) { cloth.setLayerFriction({}); }

void WetFriction::apply(WetCloth& cloth, const Step&) {
  RigidContacts(cloth.body(), cloth.world().world(), cloth.isInDeformableWorld())
      .visit([&](const RigidContact& contact) { changeRigid(cloth, contact); });
  if (cloth.isGuarded()) {
    changeLayers(cloth);
    return;
  }
  if (!m_hasFaceContacts) return;
  const btAlignedObjectArray<btSoftBody*>& bodies = cloth.world().softBodies();
  for (int i = 0; i < bodies.size(); ++i) {
    if (bodies[i] != &cloth.body()) changeSoft(cloth, *bodies[i]);
  }
}

double WetFriction::factorAt(const WetCloth& cloth, const ContactPoint& point) const {
  return m_curve.at(saturationAt(cloth.water(), point));
}

void WetFriction::changeRigid(const WetCloth& cloth, const RigidContact& contact) {
  ++m_contactsVisited;
  const btSoftBody& body = cloth.body();
  const double factor = factorAt(cloth, contact.point);
  const btScalar friction = scaled(body.m_cfg.kDF, factor) * contact.object->getFriction();
  if (contact.deformable) {
    contact.deformable->m_c3 = friction;
    return;
  }
  // A node that Bullet holds fast stays so in a wider cone. Its velocities are those of the detection, ours of a rigid
  // body that has been solved since.
  btSoftBody::RContact& entry = *contact.positionBased;
  if (factor == 1 || (factor > 1 && entry.m_c3 == 0)) return;
  const btRigidBody* rigid = btRigidBody::upcast(contact.object);
  const btVector3 rigidMotion =
      rigid ? rigid->getVelocityInLocalPoint(entry.m_c1) * body.m_sst.sdt : btVector3(0, 0, 0);
  const btVector3 motion = entry.m_node->m_x - entry.m_node->m_q - rigidMotion;
  const btScalar normal = motion.dot(contact.normal);
  entry.m_c3 = slidingShare(friction, normal, motion - contact.normal * normal);
}

// Contacts of two bodies are in the list of the one whose node it is. When both have the effect, both compute the same.
void WetFriction::changeSoft(WetCloth& cloth, btSoftBody& other) {
  const WetCloth* otherCloth = cloth.world().find(other);
  if (otherCloth && otherCloth->nodeCount() != other.m_nodes.size()) otherCloth = nullptr;
  const WetFriction* otherFriction = otherCloth ? otherCloth->find<WetFriction>() : nullptr;
  const auto change = [&](btSoftBody::SContact& entry, const ContactPoint& own, const ContactPoint& theirs) {
    ++m_contactsVisited;
    const double factor = factorAt(cloth, own);
    const double otherFactor = otherFriction ? otherFriction->factorAt(*otherCloth, theirs) : 1;
    if (factor == 1 && otherFactor == 1) return;
    const btScalar friction = std::max(scaled(cloth.body().m_cfg.kDF, factor), scaled(other.m_cfg.kDF, otherFactor));
    entry.m_friction = std::min(friction, btScalar(1));
  };
  const auto nodePoint = [](int node) {
    ContactPoint point;
    point.nodes[0] = node;
    return point;
  };
  FaceContacts(cloth.body(), other, false).visit([&](const FaceContact& contact) {
    change(*contact.positionBased, nodePoint(contact.node), contact.point);
  });
  FaceContacts(other, cloth.body(), false).visit([&](const FaceContact& contact) {
    change(*contact.positionBased, contact.point, nodePoint(contact.node));
  });
}

void WetFriction::changeLayers(WetCloth& cloth) {
  bool isDry = true;
  for (std::size_t i = 0; i < m_factors.size(); ++i) {
    m_factors[i] = static_cast<btScalar>(m_curve.at(cloth.water().saturation(i)));
    isDry = isDry && m_factors[i] == 1;
  }
  isDry ? cloth.setLayerFriction({}) : cloth.setLayerFriction(m_factors);
}

void WetFriction::transferState(StateArchive& archive) { archive.value(m_contactsVisited); }

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
