// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/drawing/DebugDraw.h"

#include "bullet_wetcloth/Require.h"
#include "bullet_wetcloth/WetCloth.h"
#include "bullet_wetcloth/WetClothWorld.h"
#include "bullet_wetcloth/effects/Wind.h"

#include <LinearMath/btIDebugDraw.h>

#include <algorithm>
#include <array>
#include <cstddef>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

const btVector3 kWindColour(btScalar(0.9), btScalar(0.15), btScalar(0.1));

btVector3 toBullet(const Colour& colour) {
  return btVector3(static_cast<btScalar>(colour.r), static_cast<btScalar>(colour.g), static_cast<btScalar>(colour.b));
}

// A body that was cut since the last step may have nodes that our water does not know yet: they draw dry.
double saturationOf(const WetCloth& cloth, const btSoftBody::Node* node) {
  const std::ptrdiff_t index = node - &cloth.body().m_nodes[0];
  return index < cloth.nodeCount() ? cloth.saturation(static_cast<int>(index)) : 0;
}

void drawTractions(const Wind& wind, const btSoftBody& body, btIDebugDraw& drawer, double time, btScalar scale) {
  for (int f = 0; f < body.m_faces.size(); ++f) {
    const btSoftBody::Face& face = body.m_faces[f];
    const btVector3 line = wind.traction(face, time) * scale;
    if (line.isZero()) continue;
    const btVector3 centre = (face.m_n[0]->m_x + face.m_n[1]->m_x + face.m_n[2]->m_x) / 3;
    drawer.drawLine(centre, centre + line, kWindColour);
  }
}

}  // namespace

Colour saturationColour(double saturation) {
  static constexpr std::array<Colour, 3> kStops = {Colour{0.93, 0.84, 0.62}, {0.25, 0.62, 0.60}, {0.05, 0.14, 0.45}};
  const double place = 2 * (saturation > 0 ? std::min(saturation, 1.0) : 0);
  const std::size_t first = place < 1 ? 0 : 1;
  const Colour& a = kStops[first];
  const Colour& b = kStops[first + 1];
  const double share = place - static_cast<double>(first);
  return {a.r + (b.r - a.r) * share, a.g + (b.g - a.g) * share, a.b + (b.b - a.b) * share};
}

void drawSaturation(const WetCloth& cloth, btIDebugDraw& drawer) {
  const btSoftBody& body = cloth.body();
  for (int f = 0; f < body.m_faces.size(); ++f) {
    const auto& nodes = body.m_faces[f].m_n;
    double sum = 0;
    for (const btSoftBody::Node* const node : nodes) sum += saturationOf(cloth, node);
    drawer.drawTriangle(nodes[0]->m_x, nodes[1]->m_x, nodes[2]->m_x, toBullet(saturationColour(sum / 3)), 1);
  }
}

void drawWind(const WetCloth& cloth, btIDebugDraw& drawer, double time, double metresPerPascal) {
  requireFiniteScalar("metresPerPascal", metresPerPascal);
  cloth.forEach<Wind>([&](const Wind& wind) {
    drawTractions(wind, cloth.body(), drawer, time, static_cast<btScalar>(metresPerPascal));
  });
}

void debugDraw(const WetClothWorld& world, btIDebugDraw& drawer, double metresPerPascal) {
  requireFiniteScalar("metresPerPascal", metresPerPascal);
  for (const WetCloth& cloth : world.cloths()) {
    if (!world.isInWorld(cloth.body())) continue;
    drawSaturation(cloth, drawer);
    if (metresPerPascal != 0) drawWind(cloth, drawer, world.time(), metresPerPascal);
  }
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
