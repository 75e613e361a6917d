// SPDX-License-Identifier: Zlib
#include "command/stability/CaseParts.h"
#include "command/stability/Cases.h"
#include "command/stability/GuardedCase.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

// Cloth that would pass through cloth, with the guard of ClothSolver and without.
namespace stability {
namespace {

using Guard = wetcloth::ClothSolver::Guard;

/// Two rods turn a sheet of 1.2 m x 1.6 m, and come together as hands do.
class Wringing {
 public:
  explicit Wringing(CaseScene& scene) : m_scene(scene) {
    wetcloth::ClothPatch patch;
    patch.columns = kColumns;
    patch.rows = kRows;
    patch.origin = btVector3(btScalar(-kHalfWidth), 0, 0);
    patch.edgeU = btVector3(btScalar(2 * kHalfWidth), 0, 0);
    patch.edgeV = btVector3(0, btScalar(kHeight), 0);
    patch.pinnedEdges = {wetcloth::ClothPatch::Edge::top, wetcloth::ClothPatch::Edge::bottom};
    m_body = &addCloth(scene, patch);
    scene.limits.source = std::hypot(2 * kPi * kTurns * kHalfWidth, kHeight / 2) / scene.duration();
    scene.limits.drop = kHeight;
    scene.limits.stretch = 1.5;  // layers that are held against a pull
  }

  void beforeStep() const {
    const double done = (m_scene.time() + m_scene.dt()) / m_scene.duration();
    const double angle = 2 * kPi * kTurns * done;
    const double halfWidth = kHalfWidth * (1 - 0.5 * std::min(1., 3 * done));
    const double height = kHeight * (1 - 0.5 * done);
    for (int i = 0; i < kColumns; ++i) {
      const double x = halfWidth * (2. * i / (kColumns - 1) - 1);
      m_body->m_nodes[i].m_x = btVector3(btScalar(x), 0, 0);
      m_body->m_nodes[(kRows - 1) * kColumns + i].m_x =
          btVector3(btScalar(x * std::cos(angle)), btScalar(height), btScalar(x * std::sin(angle)));
    }
  }

 private:
  static constexpr int kColumns = 13;
  static constexpr int kRows = 17;
  static constexpr double kHalfWidth = 0.6;
  static constexpr double kHeight = 1.6;
  static constexpr double kTurns = 2;

  CaseScene& m_scene;
  btSoftBody* m_body;
};

HardCase wrungTwoTurns() {
  HardCase hardCase =
      guarded("wrung_two_turns", "a sheet is wrung two turns by rods that come together", {}, [](CaseScene& scene) {
        Script script;
        script.before = [wringing = Wringing(scene)] { wringing.beforeStep(); };
        return script;
      });
  hardCase.duration = 3;
  return hardCase;
}

/// A band of cloth that is bent to a ring about the z axis and hangs by its seam.
void addRing(CaseScene& scene, double radius) {
  wetcloth::ClothPatch patch;
  patch.columns = 20;
  patch.rows = 3;
  patch.edgeU = btVector3(btScalar(2 * kPi * radius), 0, 0);
  patch.edgeV = btVector3(0, 0, btScalar(0.1));
  patch.pinnedEdges = {wetcloth::ClothPatch::Edge::left, wetcloth::ClothPatch::Edge::right};
  std::unique_ptr<btSoftBody> ring = patch.build(scene.worldInfo());
  for (int i = 0; i < ring->m_nodes.size(); ++i) {
    btVector3& x = ring->m_nodes[i].m_x;
    const double angle = (double(x.x()) / radius - kPi) * 0.99;  // the two ends are two layers
    x.setX(btScalar(radius * std::sin(angle)));
    x.setY(btScalar(-radius * std::cos(angle)));
    ring->m_nodes[i].m_q = x;
  }
  addCloth(scene, std::move(ring));
}

HardCase throughALoop() {
  HardCase hardCase = guarded(
      "corner_through_a_loop", "a corner of a cloth is pulled through a ring of cloth at 0.5 m/s, the rest follows", {},
      [](CaseScene& scene) {
        constexpr double radius = 0.12;
        constexpr double speed = 0.5;
        constexpr double side = 0.5;
        addRing(scene, radius);
        wetcloth::ClothPatch patch;
        patch.columns = patch.rows = 10;
        patch.origin = btVector3(0, 0, btScalar(-0.02));
        patch.edgeU = btVector3(btScalar(side / std::sqrt(2.)), 0, btScalar(-side / std::sqrt(2.)));
        patch.edgeV = btVector3(btScalar(-side / std::sqrt(2.)), 0, btScalar(-side / std::sqrt(2.)));
        patch.pinnedNodes = {0};
        btSoftBody& body = addCloth(scene, patch);
        scene.limits.source = speed;
        scene.limits.drop = 2 * std::sqrt(2.) * side;
        Script script;
        script.before = [&scene, &body, start = body.m_nodes[0].m_x] {
          body.m_nodes[0].m_x = start + btVector3(0, 0, btScalar(speed * (scene.time() + scene.dt())));
        };
        return script;
      });
  hardCase.duration = 2.5;
  return hardCase;
}

HardCase layersAtRest() {
  HardCase hardCase =
      guarded("layers_at_rest", "three cloths lie on each other for a minute: no node is faster than 2 cm/s then", {},
              [](CaseScene& scene) {
                scene.addFloor(0);
                for (int layer = 0; layer < 3; ++layer) {
                  wetcloth::ClothPatch patch = levelCloth(0.02 + 0.01 * layer);
                  patch.origin += btVector3(btScalar(0.03 * layer), 0, btScalar(0.02 * layer));
                  addCloth(scene, patch);
                }
                scene.limits.drop = 0.05;
                Script script;
                script.finish = [&scene](CaseMeter& meter) {
                  double fastest = 0;
                  for (const CaseScene::Cloth& cloth : scene.cloths()) {
                    for (int i = 0; i < cloth.body->m_nodes.size(); ++i) {
                      fastest = std::max(fastest, double(cloth.body->m_nodes[i].m_v.length()));
                    }
                  }
                  meter.compare("final speed", fastest, 0.02);
                };
                return script;
              });
  hardCase.duration = 60;
  hardCase.quickDuration = 5;
  return hardCase;
}

HardCase thrownAtItself() {
  HardCase hardCase =
      guarded("thrown_at_itself_30_m_s", "both halves of a sheet fly into each other at 30 m/s each, without weight",
              {}, [](CaseScene& scene) {
                constexpr double speed = 30;
                btSoftBody& body = addCloth(scene, uprightCloth(17));
                for (int i = 0; i < body.m_nodes.size(); ++i) {
                  const double side = double(body.m_nodes[i].m_x.x()) - 0.5;
                  // A little aside, so that the layers do not only meet in the plane of the sheet.
                  const double aside = 0.3 * std::sin(7 * double(body.m_nodes[i].m_x.y()));
                  body.m_nodes[i].m_v = btVector3(btScalar(side > 0 ? -speed : speed), 0, btScalar(speed * aside));
                }
                scene.limits.source = speed * std::hypot(1, 0.3);
                return Script();
              });
  hardCase.isWeightless = true;
  hardCase.duration = 1;
  return hardCase;
}

/// A cloth with waves stands on its edge, and falls into folds.
HardCase droppedOnItsEdge(std::string name, std::string about, const Guard& guard) {
  HardCase hardCase = guarded(std::move(name), std::move(about), guard, [](CaseScene& scene) {
    scene.addFloor(0);
    wetcloth::ClothPatch patch = uprightCloth(13);
    patch.origin.setY(btScalar(0.05));
    std::unique_ptr<btSoftBody> cloth = patch.build(scene.worldInfo());
    for (int i = 0; i < cloth->m_nodes.size(); ++i) {
      btVector3& x = cloth->m_nodes[i].m_x;
      x.setZ(btScalar(0.02 * std::sin(15 * (double(x.y()) - 0.05) + 2 * double(x.x()))));
      cloth->m_nodes[i].m_q = x;
    }
    addCloth(scene, std::move(cloth));
    scene.limits.drop = 1.05;
    return Script();
  });
  hardCase.duration = 3;
  hardCase.quickDuration = 1.5;
  return hardCase;
}

Guard ofThickness(double thickness) {
  Guard guard;
  guard.thickness = thickness;
  return guard;
}

}  // namespace

std::vector<HardCase> guardCases() {
  return {wrungTwoTurns(),
          throughALoop(),
          layersAtRest(),
          thrownAtItself(),
          droppedOnItsEdge("dropped_on_its_edge", "a cloth is dropped on its edge and falls into folds", {}),
          droppedOnItsEdge("thickness_0", "the same with layers of no thickness", ofThickness(0)),
          droppedOnItsEdge("thickness_above_an_edge", "the same with layers that are thicker than edges are long",
                           ofThickness(0.2))};
}

}  // namespace stability
