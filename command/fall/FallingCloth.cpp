// SPDX-License-Identifier: Zlib
#include "command/fall/FallingCloth.h"

#include "command/scene/BlowUp.h"

#include <utility>

namespace command {
namespace {

/// Height of the centre of mass. All nodes of one fabric are equally wet, so their masses weigh as their areas do.
double centreHeight(const btSoftBody& body) {
  double moment = 0;
  double mass = 0;
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    const double nodeMass = 1 / static_cast<double>(body.m_nodes[i].m_im);
    moment += nodeMass * static_cast<double>(body.m_nodes[i].m_x.y());
    mass += nodeMass;
  }
  return moment / mass;
}

void wet(wetcloth::WetCloth& cloth, double massRatio) {
  std::vector<double> water;
  for (int i = 0; i < cloth.nodeCount(); ++i) water.push_back((massRatio - 1) * cloth.dryMass(i));
  cloth.setHeld(water);
}

/// Without springs a sheet in the deformable world is a cloud of triangles, which the air crumples. These are half as
/// stiff as would make the explicit world unstable.
DeformableSprings springsFor(const wetcloth::ClothPatch& patch, double massRatio) {
  const double area = static_cast<double>(patch.edgeU.cross(patch.edgeV).length());
  const double nodeMass = massRatio * patch.arealDensity * area / patch.nodeCount();
  DeformableSprings springs;
  springs.stiffness = springs.bendingStiffness = 0.15 * nodeMass / (fallSubstep * fallSubstep);
  springs.damping = 0;
  return springs;
}

/// Air is everywhere alike, so the fall may be watched from a lift that stops at every metre: near the origin, float32
/// still resolves the small steps of a long fall. The shift is exact. Not through btSoftBody::translate(), which makes
/// the present lengths of the links their rest lengths.
void liftByOneMetre(btSoftBody& body) {
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    body.m_nodes[i].m_x += btVector3(0, 1, 0);
    body.m_nodes[i].m_q += btVector3(0, 1, 0);
  }
  body.updateBounds();
}

BulletWorld::Settings settingsOf(WorldKind kind, const FallMode::Case& fallCase,
                                 const std::optional<wetcloth::ClothSolver::Parameters>& clothSolver) {
  BulletWorld::Settings settings;
  settings.kind = kind;
  if (fallCase.inAir) settings.clothSolver = clothSolver;
  settings.gravity = btVector3(0, btScalar(-fallGravity), 0);
  return settings;
}

}  // namespace

FallingCloth::FallingCloth(const FallMode& mode, const FallMode::Case& fallCase, WorldKind kind,
                           const std::optional<wetcloth::ClothSolver::Parameters>& clothSolver)
    : m_world(settingsOf(kind, fallCase, clothSolver)) {
  wetcloth::ClothPatch patch;  // its nodes are 1/32 m apart, which is exact: rounding would seed crumples
  patch.edgeU = btVector3(btScalar(31.0 / 32), 0, 0);
  patch.edgeV = btVector3(0, 0, btScalar(-31.0 / 32));
  patch.arealDensity = mode.fabric.arealDensity;
  const DeformableSprings springs = springsFor(patch, fallCase.massRatio);
  m_body = &m_world.add(patch.build(m_world.worldInfo()), &springs);
  if (!fallCase.inAir) return;
  wetcloth::WetCloth& cloth = m_world.wet().add(*m_body, mode.fabric);
  cloth.setPace(wetcloth::WaterPace::exact());
  cloth.add<wetcloth::Wind>(mode.air);
  wet(cloth, fallCase.massRatio);
}

void FallingCloth::substep() {
  m_world.substep(btScalar(fallSubstep));
  ++m_substeps;
  m_fallen = m_lifted - centreHeight(*m_body);
  for (; m_fallen - m_lifted > 1; ++m_lifted) liftByOneMetre(*m_body);
}

std::optional<std::string> FallingCloth::blowUp() const {
  return findBlowUp(*m_body, {fallGravity * (time() + fallSubstep), fallSubstep});
}

}  // namespace command
