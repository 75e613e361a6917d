// SPDX-License-Identifier: Zlib
#include "command/accuracy/Specimen.h"

#include <BulletCollision/CollisionShapes/btBoxShape.h>

#include <memory>

namespace accuracy {

Specimen::Specimen(const Settings& settings) : m_world(settings.world) {
  m_body = &m_world.add(settings.patch.build(m_world.worldInfo()), settings.springs ? &*settings.springs : nullptr);
  m_cloth = &m_world.wet().add(*m_body, settings.fabric);
  m_cloth->setPace(settings.pace);
}

void Specimen::addFloor() {
  const btVector3 half(3, 1, 3);
  m_world.addStatic(std::make_unique<btBoxShape>(half), btTransform(btQuaternion::getIdentity(), btVector3(0, -1, 0)));
}

wetcloth::ClothPatch levelSquare(double side, int nodes, double arealDensity) {
  wetcloth::ClothPatch patch;
  patch.columns = patch.rows = nodes;
  patch.edgeU = btVector3(btScalar(side), 0, 0);
  patch.edgeV = btVector3(0, 0, btScalar(side));
  patch.arealDensity = arealDensity;
  return patch;
}

}  // namespace accuracy
