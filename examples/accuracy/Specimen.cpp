#include "Specimen.h"

#include <cmath>
#include <cstdio>

namespace accuracy {

Specimen::Specimen(const Settings& settings)
    : m_world(settings.world), m_wetWorld(std::make_unique<wetcloth::WetClothWorld>(m_world.world())) {
  m_body = &m_world.add(settings.patch.build(m_world.worldInfo()), settings.springs ? &*settings.springs : nullptr);
  m_cloth = &m_wetWorld->add(*m_body, settings.fabric);
}

wetcloth::ClothPatch levelSquare(double side, int nodes, double arealDensity) {
  wetcloth::ClothPatch patch;
  patch.columns = patch.rows = nodes;
  patch.edgeU = btVector3(btScalar(side), 0, 0);
  patch.edgeV = btVector3(0, 0, btScalar(side));
  patch.arealDensity = arealDensity;
  return patch;
}

std::string stepLabel(double dt) {
  char text[32];
  if (dt < 1) {
    std::snprintf(text, sizeof text, "1/%.4g s", 1 / dt);
  } else {
    std::snprintf(text, sizeof text, "%.4g s", dt);
  }
  return text;
}

}  // namespace accuracy
