// SPDX-License-Identifier: Zlib
#include "command/scene/Dressing.h"

#include "command/cli/Errors.h"
#include "command/scene/BulletWorld.h"
#include "command/scene/ClothBody.h"
#include "command/scene/ColliderShape.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace command {
namespace {

constexpr double dressingStep = 1.0 / 60;
/// What is left of the velocities after a step: seams come together as in honey.
constexpr double slowness = 0.9;

BulletWorld::Settings settingsOf(const Scene& scene) {
  wetcloth::ClothSolver::Parameters solver = scene.clothSolver.value_or(wetcloth::ClothSolver::Parameters());
  if (!solver.guard) solver.guard.emplace();
  solver.guard->bodies = true;
  return {WorldKind::softRigid, scene.gravity, scene.iterations, false, solver};
}

/// The links of a cloth whose seams are open: as long as they are at first, later as long as they are at rest.
class Seams {
 public:
  Seams(btSoftBody& body, double duration) : m_body(body), m_duration(duration) {
    for (int k = 0; k < body.m_links.size(); ++k) {
      const btSoftBody::Link& link = body.m_links[k];
      const btScalar open = (link.m_n[1]->m_x - link.m_n[0]->m_x).length();
      if (btFabs(open - link.m_rl) > btScalar(1e-3) * link.m_rl) m_open.push_back({k, open, link.m_rl});
    }
  }

  void drawTo(double time) {
    const double share = std::min(1.0, time / m_duration);
    for (const Open& open : m_open) {
      btSoftBody::Link& link = m_body.m_links[open.link];
      link.m_rl = share < 1 ? open.open + (open.rest - open.open) * btScalar(share) : open.rest;
      link.m_c1 = link.m_rl * link.m_rl;
    }
  }

 private:
  struct Open {
    int link;
    btScalar open, rest;
  };
  btSoftBody& m_body;
  double m_duration;
  std::vector<Open> m_open;
};

class DressingRoom {
 public:
  explicit DressingRoom(const Scene& scene) : m_scene(scene), m_world(settingsOf(scene)) {
    for (const Collider& collider : scene.colliders) {
      ColliderShape made = shapeOf(collider);
      m_world.addStatic(std::move(made.shape), collider.at(0) * made.rest);
    }
    for (const ClothScene& cloth : scene.cloths) {
      if (!cloth.garment) continue;
      btSoftBody& body = m_world.add(makeClothBody(cloth, m_world.worldInfo()));
      if (cloth.collisions) body.m_cfg.collisions = *cloth.collisions;
      m_bodies.push_back(&body);
      m_seams.emplace_back(body, cloth.garment->sewing);
      m_duration = std::max(m_duration, cloth.garment->sewing + cloth.garment->settling);
    }
  }

  std::vector<std::vector<btVector3>> places() {
    const int steps = static_cast<int>(std::ceil(m_duration / dressingStep));
    for (int i = 1; i <= steps; ++i) {
      for (Seams& seams : m_seams) seams.drawTo(i * dressingStep);
      m_world.substep(btScalar(dressingStep));
      slowDown();
    }
    std::vector<std::vector<btVector3>> places(m_scene.cloths.size());
    std::size_t next = 0;
    for (std::size_t c = 0; c < places.size(); ++c) {
      if (!m_scene.cloths[c].garment) continue;
      const btSoftBody& body = *m_bodies[next++];
      for (int i = 0; i < body.m_nodes.size(); ++i) places[c].push_back(body.m_nodes[i].m_x);
    }
    return places;
  }

 private:
  void slowDown() {
    for (btSoftBody* body : m_bodies) {
      for (int i = 0; i < body->m_nodes.size(); ++i) {
        btSoftBody::Node& node = body->m_nodes[i];
        if (!std::isfinite(node.m_x.length2())) throw RunError(m_scene.file + ": while it was sewn the cloth blew up");
        node.m_v *= btScalar(slowness);
      }
    }
  }

  const Scene& m_scene;
  BulletWorld m_world;
  std::vector<btSoftBody*> m_bodies;
  std::vector<Seams> m_seams;
  double m_duration = 0;
};

}  // namespace

const std::vector<std::vector<btVector3>>& dressedPlaces(const Scene& scene) {
  std::vector<std::vector<btVector3>>& places = scene.dressed->places;
  if (!places.empty()) return places;
  places =
      scene.hasGarments() ? DressingRoom(scene).places() : std::vector<std::vector<btVector3>>(scene.cloths.size());
  return places;
}

}  // namespace command
