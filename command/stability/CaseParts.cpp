// SPDX-License-Identifier: Zlib
#include "command/stability/CaseParts.h"

#include "command/stability/NaiveMethods.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace stability {

const std::vector<World>& everyWorld() {
  static const std::vector<World> worlds{World::softRigid, World::softMultiBody, World::deformable,
                                         World::deformableImplicit, World::softRigidClothSolver};
  return worlds;
}

wetcloth::ClothPatch uprightCloth(int nodes) {
  wetcloth::ClothPatch patch;
  patch.columns = patch.rows = nodes;
  patch.edgeV = btVector3(0, 1, 0);
  return patch;
}

wetcloth::ClothPatch hangingCloth(int nodes) {
  wetcloth::ClothPatch patch = uprightCloth(nodes);
  patch.pinnedEdges = {wetcloth::ClothPatch::Edge::top};
  return patch;
}

wetcloth::ClothPatch levelCloth(double height, int nodes) {
  wetcloth::ClothPatch patch;
  patch.columns = patch.rows = nodes;
  patch.origin = btVector3(btScalar(-0.5), btScalar(height), btScalar(-0.5));
  return patch;
}

HardCase everywhere(std::string name, std::string group, std::string about) {
  HardCase hardCase;
  hardCase.name = std::move(name);
  hardCase.group = std::move(group);
  hardCase.about = std::move(about);
  hardCase.worlds = everyWorld();
  return hardCase;
}

double freeMass(const btSoftBody& body) {
  double mass = 0;
  for (const double one : naive::massesOf(body)) mass += one;
  return mass;
}

double windForce(double speed, double area) {
  const wetcloth::Wind::Parameters defaults;
  return 0.5 * defaults.airDensity * defaults.dragCoefficient * area * speed * speed;
}

double stiffnessFor(double mass, int columns) { return std::max(1000., mass * 9.81 / columns / 1e-3); }

Weather::Weather(CaseScene& scene, btSoftBody& body, wetcloth::WetCloth* cloth, Kind kind, const btVector3& air,
                 double skinFriction)
    : m_scene(scene), m_body(body), m_air(air), m_skinFriction(skinFriction) {
  if (cloth == nullptr) return;
  if (kind == Kind::rain) {
    wetcloth::Absorption::Parameters rain;
    rain.waterVelocity = btVector3(0, -3, 0);
    rain.exposure = 0.8;
    cloth->add<wetcloth::Absorption>(rain);
    cloth->add<wetcloth::Diffusion>();
    cloth->add<wetcloth::Dripping>();
    cloth->add<wetcloth::Drying>();
  }
  wetcloth::Wind::Parameters wind;
  wind.velocity = air;
  wind.skinFriction = skinFriction;
  m_wind = &cloth->add<wetcloth::Wind>(wind);
}

void Weather::blow(const btVector3& air) {
  m_air = air;
  if (m_wind != nullptr) adjust(*m_wind, [&](auto& p) { p.velocity = air; });
}

void Weather::beforeStep() {
  if (m_scene.time() >= m_scene.limits.calmFrom && !m_air.fuzzyZero()) blow(btVector3(0, 0, 0));
  if (m_scene.isPlainBullet()) naive::blowSafely(m_body, m_air, m_skinFriction, m_scene.dt());
}

Script underWeather(CaseScene& scene, btSoftBody& body, wetcloth::WetCloth* cloth, Weather::Kind kind,
                    const btVector3& air) {
  const auto weather = std::make_shared<Weather>(scene, body, cloth, kind, air);
  Script script;
  script.before = [weather] { weather->beforeStep(); };
  return script;
}

void giveWater(CaseScene& scene, btSoftBody& body, wetcloth::WetCloth* cloth, const std::vector<double>& held) {
  if (scene.isOurs()) {
    if (cloth != nullptr) cloth->setHeld(held);
    return;
  }
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    btSoftBody::Node& node = body.m_nodes[i];
    if (node.m_im > 0) node.m_im = btScalar(1 / (1 / double(node.m_im) + held[static_cast<std::size_t>(i)]));
  }
  body.updateLinkConstants();
}

}  // namespace stability
