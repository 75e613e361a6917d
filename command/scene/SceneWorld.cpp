// SPDX-License-Identifier: Zlib
#include "command/scene/SceneWorld.h"

#include "command/cli/Errors.h"
#include "command/scene/BlowUp.h"
#include "command/scene/ClothBody.h"
#include "command/scene/ColliderShape.h"
#include "command/scene/Dressing.h"
#include "command/scene/Farthest.h"
#include "command/scene/StableSprings.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>

namespace command {
namespace {

/// Plain Bullet is stepped by its own solver.
BulletWorld::Settings settingsOf(const Scene& scene, SceneWorld::Kind kind) {
  BulletWorld::Settings settings{scene.world, scene.gravity, scene.iterations, scene.implicit, std::nullopt};
  if (kind == SceneWorld::Kind::wet) settings.clothSolver = scene.clothSolver;
  return settings;
}

/// Calls `action`; what the library refuses is bad input at `pointer`.
template <class Action>
void atPointer(const Scene& scene, const std::string& pointer, Action action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    throw InputError(onOneLine(scene.file + ": " + pointer + ": " + error.what()));
  }
}

/// Throws std::invalid_argument when a region holds no node.
void wetAtTheBeginning(const ClothScene& scene, wetcloth::WetCloth& cloth) {
  cloth.setSaturation(scene.initialSaturation);
  if (scene.wetRegions.empty()) return;
  std::vector<double> held;
  for (int i = 0; i < scene.nodeCount(); ++i) held.push_back(scene.initialSaturation * cloth.capacity(i));
  for (const WetRegion& wet : scene.wetRegions) {
    int inside = 0;
    for (int i = 0; i < scene.nodeCount(); ++i) {
      if (!wet.region.holds(cloth.body().m_nodes[i].m_x)) continue;
      held[static_cast<std::size_t>(i)] = wet.saturation * cloth.capacity(i);
      ++inside;
    }
    if (inside == 0) throw std::invalid_argument("\"wet_regions\": no node of the cloth begins in one of them");
  }
  cloth.setHeld(held);
}

bool isWithinReach(const btVector3& place) { return static_cast<double>(place.length2()) <= farthest * farthest; }

void requireWithinReach(const btSoftBody& body) {
  for (int i = 0; i < body.m_nodes.size(); ++i) {
    if (!isWithinReach(body.m_nodes[i].m_x))
      throw std::invalid_argument("node " + std::to_string(i) + " must be within 1e8 m of 0");
  }
}

/// Its length too: a speed that btScalar cannot hold makes the next step's numbers infinite.
bool isFinite(const btVector3& vector) { return std::isfinite(vector.length2()); }

}  // namespace

SceneWorld::SceneWorld(const Scene& scene, Kind kind) : m_scene(scene), m_world(settingsOf(scene, kind)) {
  if (scene.water) addWater(*scene.water);
  for (const Collider& collider : scene.colliders) addCollider(collider);
  for (std::size_t i = 0; i < scene.cloths.size(); ++i) {
    const std::string pointer = "/cloths/" + std::to_string(i);
    atPointer(scene, pointer, [&] { addCloth(i, kind); });
  }
  if (scene.hasGarments()) settle();
  if (kind == Kind::plainBullet) return;
  m_wetWorld = &m_world.wet();
  if (scene.drops) atPointer(scene, "/drops", [&] { addDrops(*scene.drops); });
  for (std::size_t i = 0; i < scene.cloths.size(); ++i) {
    const std::string pointer = "/cloths/" + std::to_string(i);
    atPointer(scene, pointer, [&] { m_cloths.push_back(&wet(scene.cloths[i], *m_bodies[i])); });
    m_cloths.back()->setPace(scene.cloths[i].pace);
    addEffects(i, *m_cloths.back());
    atPointer(scene, pointer, [&] { wetAtTheBeginning(scene.cloths[i], *m_cloths.back()); });
  }
}

wetcloth::WetCloth& SceneWorld::wet(const ClothScene& cloth, btSoftBody& body) const {
  if (!cloth.garment) return m_wetWorld->add(body, cloth.fabric);
  return m_wetWorld->add(body, cloth.garment->fabrics, cloth.garment->fabricOfNode);
}

void SceneWorld::addCloth(std::size_t index, Kind kind) {
  const ClothScene& cloth = m_scene.cloths[index];
  std::unique_ptr<btSoftBody> body = makeClothBody(cloth, m_world.worldInfo());
  if (cloth.garment) placeNodes(*body, dressedPlaces(m_scene)[index]);
  requireWithinReach(*body);
  const bool wePull = kind == Kind::wet && cloth.hasEffect("hooke_springs");
  const bool bulletPulls = m_scene.world == WorldKind::deformable && !wePull;
  m_springs.emplace_back();
  if (bulletPulls) m_springs.back() = springsOf(cloth.springs, *body, substep(), m_scene.implicit);
  btSoftBody& added = m_world.add(std::move(body), bulletPulls ? &*m_springs.back() : nullptr);
  if (cloth.collisions) added.m_cfg.collisions = *cloth.collisions;
  addFaceTree(added);
  if (cloth.twist) m_twists.emplace_back(added, std::get<wetcloth::ClothPatch>(cloth.shape), *cloth.twist);
  if (cloth.motion) m_motions.emplace_back(added, *cloth.motion);
  m_bodies.push_back(&added);
}

/// The last step of dressing, in this world: so the guard knows garments and bodies before these begin to move.
void SceneWorld::settle() {
  m_world.substep(btScalar(substep()));
  for (std::size_t i = 0; i < m_bodies.size(); ++i) {
    if (!m_scene.cloths[i].garment) placeNodes(*m_bodies[i], m_scene.cloths[i].nodePositions());
    for (int n = 0; n < m_bodies[i]->m_nodes.size(); ++n) m_bodies[i]->m_nodes[n].m_v.setZero();
  }
}

/// Bullet makes the tree by itself, but never ends for cloth in several parts, and its time grows as the square of the
/// faces: 0.5 s for these, 7 s for four times as many.
void SceneWorld::addFaceTree(btSoftBody& body) const {
  constexpr int mostForBullet = 10000;  // faces
  using Flag = btSoftBody::fCollision;
  const int flag = m_scene.world == WorldKind::deformable ? Flag::SDF_RD : Flag::VF_SS;
  if ((body.m_cfg.collisions & flag) == 0) return;
  if (body.m_faces.size() > mostForBullet || !wetcloth::checkMesh(body).bulletBuildsFaceTree()) {
    wetcloth::buildFaceTree(body);
  }
}

void SceneWorld::addWater(const WaterScene& water) {
  btSoftBodyWorldInfo& info = m_world.worldInfo();
  info.water_normal = m_scene.up();
  info.water_offset = btScalar(-water.level);
  info.water_density = btScalar(water.density);
}

void SceneWorld::addEffects(std::size_t index, wetcloth::WetCloth& wet) {
  for (const EffectScene& effect : m_scene.cloths[index].effects) {
    atPointer(m_scene, "/cloths/" + std::to_string(index) + "/effects/" + effect.key,
              [&] { effect.addTo(wet, m_colliders); });
  }
  wet.forEach<wetcloth::CollisionAudit>([&](wetcloth::CollisionAudit& audit) { m_audits.push_back(&audit); });
}

void SceneWorld::addDrops(const DropsScene& scene) {
  m_drops = std::make_unique<wetcloth::Drops>(*m_wetWorld, scene.parameters);
  for (const wetcloth::Pour& pour : scene.pours) m_drops->add(pour);
  for (const DropsScene::FullGlass& full : scene.glasses) {
    wetcloth::Glass glass = full.glass;
    const Collider& collider = m_scene.colliders[full.collider];
    glass.pose = [&collider, rest = full.rest](double time) { return collider.at(time) * rest; };
    m_drops->add(glass);
  }
}

void SceneWorld::addCollider(const Collider& collider) {
  ColliderShape made = shapeOf(collider);
  if (!collider.motion) {
    m_colliders.push_back(&m_world.addStatic(std::move(made.shape), made.rest));
    return;
  }
  btRigidBody& body = m_world.addKinematic(std::move(made.shape), collider.at(0) * made.rest);
  m_colliders.push_back(&body);
  m_moving.push_back({&body, &collider, made.rest});
}

/// Bullet takes their velocities from where they were before.
void SceneWorld::moveColliders(double time) {
  for (const Moving& moving : m_moving) moving.body->setWorldTransform(moving.collider->at(time) * moving.rest);
}

/// As if they had been there all the time.
void SceneWorld::placeColliders() {
  moveColliders(time());
  for (const Moving& moving : m_moving) {
    moving.body->setInterpolationWorldTransform(moving.body->getWorldTransform());
  }
}

void SceneWorld::step(const BeforeSubstep& before) {
  const btScalar dt = btScalar(substep());
  for (int i = 1; i <= m_scene.substeps; ++i) {
    const double time = (m_steps * m_scene.substeps + i) * m_scene.step / m_scene.substeps;
    moveColliders(time);
    for (Twist& twist : m_twists) twist.moveTo(time);
    for (Motion& motion : m_motions) motion.moveTo(time);
    if (before) before(dt);
    m_world.substep(dt);
    if (!isInReach()) break;  // of Bullet, which another substep might crash; blowUp() tells
  }
  ++m_steps;
}

bool SceneWorld::isInReach() const {
  for (const btSoftBody* body : m_bodies) {
    for (int i = 0; i < body->m_nodes.size(); ++i) {
      if (!isWithinReach(body->m_nodes[i].m_x)) return false;
    }
  }
  return true;
}

double SceneWorld::filmOn(std::size_t collider) const {
  double film = m_drops ? m_drops->filmOn(*m_colliders[collider]) : 0;
  for (wetcloth::WetCloth* cloth : m_cloths) {
    cloth->forEach<wetcloth::ContactWetting>(
        [&](const wetcloth::ContactWetting& wetting) { film += wetting.film(*m_colliders[collider]); });
  }
  return film;
}

void SceneWorld::setIterations(int iterations) {
  m_world.world().getSolverInfo().m_numIterations = iterations;
  for (btSoftBody* body : m_bodies) body->m_cfg.piterations = iterations;
}

void SceneWorld::continueFrom(const SceneWorld& other) {
  m_steps = other.m_steps;
  for (std::size_t i = 0; i < m_bodies.size(); ++i) {
    for (int n = 0; n < m_bodies[i]->m_nodes.size(); ++n) {
      btSoftBody::Node& node = m_bodies[i]->m_nodes[n];
      const btSoftBody::Node& there = other.m_bodies[i]->m_nodes[n];
      node.m_x = there.m_x;
      node.m_q = there.m_q;
      node.m_v = there.m_v;
      node.m_vn = there.m_vn;
      node.m_n = there.m_n;
    }
    m_bodies[i]->updateBounds();
  }
  placeColliders();
}

void SceneWorld::save(std::ostream& stream) const { m_wetWorld->save(stream); }

void SceneWorld::restore(std::istream& stream, int steps) {
  // What a twist let go before is free, and then as it was.
  for (Twist& twist : m_twists) twist.moveTo(steps * m_scene.step);
  m_wetWorld->restore(stream);
  m_steps = steps;
  placeColliders();
}

void SceneWorld::finish() {
  for (wetcloth::CollisionAudit* audit : m_audits) audit->look();
}

/// Of springs or soft links that bear all the cloth with its water; links of Bullet's position solver do not give way.
double SceneWorld::sagOf(std::size_t cloth) const {
  double stiffness = m_springs[cloth] ? m_springs[cloth]->stiffness : 0;
  if (clothSolver() != nullptr) stiffness = clothSolver()->parameters().stiffness;
  if (cloth < m_cloths.size()) {
    m_cloths[cloth]->forEach<wetcloth::HookeSprings>(
        [&](const wetcloth::HookeSprings& springs) { stiffness = springs.parameters().stiffness; });
  }
  if (!(stiffness > 0)) return 0;
  double mass = 0;
  for (int i = 0; i < m_bodies[cloth]->m_nodes.size(); ++i) {
    const double inverse = static_cast<double>(m_bodies[cloth]->m_nodes[i].m_im);
    if (inverse > 0) mass += 1 / inverse;
  }
  return mass * static_cast<double>(m_scene.gravity.length()) / stiffness;
}

std::optional<std::string> SceneWorld::blowUp(double otherPush) const {
  const double gravity = static_cast<double>(m_scene.gravity.length());
  for (const Moving& moving : m_moving) otherPush = std::max(otherPush, fastestOf(*moving.collider));
  for (std::size_t i = 0; i < m_bodies.size(); ++i) {
    const double speed = m_scene.cloths[i].fastestPush() + otherPush + gravity * (time() + substep());
    const auto found = findBlowUp(*m_bodies[i], {speed, substep(), sagOf(i)});
    if (found) return "/cloths/" + std::to_string(i) + ": " + *found;
  }
  return std::nullopt;
}

bool SceneWorld::isFinite() const {
  for (const btSoftBody* body : m_bodies) {
    for (int i = 0; i < body->m_nodes.size(); ++i) {
      if (!command::isFinite(body->m_nodes[i].m_x) || !command::isFinite(body->m_nodes[i].m_v)) return false;
    }
  }
  return true;
}

}  // namespace command
