// SPDX-License-Identifier: Zlib
// Bodies as applications make them, faults and all: each effect runs on each in each world, finite and with a closed
// ledger, or is refused with a reason when it is added; and the table of docs/meshes.md.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/DocumentedTable.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/RigidBody.h"

#include <BulletSoftBody/btSoftBodyHelpers.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>
#include <stdexcept>

namespace wetcloth_test::meshes_as_people_have_them_test {
namespace {

using wetcloth::WetCloth;
using Body = std::unique_ptr<btSoftBody>;

struct Shape {
  const char* name;
  std::function<Body(btSoftBodyWorldInfo&)> make;
};

Body patch(btSoftBodyWorldInfo& info) {
  wetcloth::ClothPatch patch;
  patch.columns = patch.rows = 7;
  return patch.build(info);
}

Body fromTriangles(btSoftBodyWorldInfo& info, std::vector<btScalar> vertices, std::vector<int> corners) {
  Body body(btSoftBodyHelpers::CreateFromTriMesh(info, vertices.data(), corners.data(), int(corners.size() / 3)));
  body->setTotalMass(btScalar(0.1));
  return body;
}

/// Grows a link to two nodes that nothing holds together any more.
Body cut(btSoftBodyWorldInfo& info) {
  Body body = patch(info);
  body->cutLink(23, 24, btScalar(0.5));
  return body;
}

Body refined(btSoftBodyWorldInfo& info) {
  struct Middle : btSoftBody::ImplicitFn {
    btScalar Eval(const btVector3& place) override { return place.x() - btScalar(0.45); }
  } middle;
  Body body = patch(info);
  body->refine(&middle, btScalar(0.001), false);
  return body;
}

std::vector<Shape> shapes() {
  const std::vector<btScalar> square = {0, 0, 0, 1, 0, 0, 1, 0, 1, 0, 0, 1};
  return {
      {"patch", patch},
      {"CreatePatch",
       [](auto& info) {
         return Body(btSoftBodyHelpers::CreatePatch(info, {0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {1, 0, 1}, 6, 6, 1, true));
       }},
      {"Ellipsoid",
       [](auto& info) {
         return Body(btSoftBodyHelpers::CreateEllipsoid(info, {0, 0, 0}, {1, 1, 1}, 64));
       }},
      {"Rope",
       [](auto& info) {
         return Body(btSoftBodyHelpers::CreateRope(info, {0, 0, 0}, {1, 0, 0}, 8, 1));
       }},
      {"TriMesh",
       [=](auto& info) {
         return fromTriangles(info, square, {0, 1, 2, 0, 2, 3});
       }},
      {"doubled",
       [=](auto& info) {
         return fromTriangles(info, square, {0, 1, 2, 0, 2, 3, 2, 1, 0, 3, 2, 0});
       }},
      {"3 at edge",
       [=](auto& info) {
         std::vector<btScalar> five = square;
         five.insert(five.end(), {0, 1, 0});
         return fromTriangles(info, five, {0, 1, 2, 0, 2, 3, 0, 2, 4});
       }},
      {"no area",
       [=](auto& info) {
         std::vector<btScalar> five = square;
         five.insert(five.end(), {btScalar(0.5), 0, 0});
         return fromTriangles(info, five, {0, 1, 2, 0, 2, 3, 0, 4, 1});
       }},
      {"stray",
       [=](auto& info) {
         Body body = fromTriangles(info, square, {0, 1, 2, 0, 2, 3});
         body->appendNode(btVector3(5, 0, 0), btScalar(0.01));
         return body;
       }},
      {"2 parts",
       [](auto& info) {
         return fromTriangles(info, {0, 0, 0, 1, 0, 0, 1, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 1}, {0, 1, 2, 3, 4, 5});
       }},
      {"bow tie",
       [](auto& info) {
         return fromTriangles(info, {0, 0, 0, 1, 0, 0, 1, 0, 1, 2, 0, 1, 2, 0, 2}, {0, 1, 2, 2, 3, 4});
       }},
      {"cut", cut},
      {"refined", refined},
  };
}

/// Where a body slides and stretches over a wet floor close below it.
struct Place {
  const btCollisionObject& floor;
  btScalar top;  ///< of the body [m]
};

struct Kind {
  const char* name;
  std::function<void(WetCloth&, const Place&)> add;
  std::function<bool(WetCloth&)> hasSeen = {};  ///< of an effect that changes nothing
};

template <class E>
Kind kind(const char* name, const typename E::Parameters& parameters = {}) {
  return {name, [=](WetCloth& cloth, const Place&) { cloth.add<E>(parameters); }};
}

/// In water that is everywhere.
template <class E>
Kind inWater(const char* name) {
  return {name, [](WetCloth& cloth, const Place& place) {
            typename E::Parameters parameters;
            parameters.surface.emplace();
            parameters.surface->offset = -static_cast<double>(place.top) - 1;
            cloth.add<E>(parameters);
          }};
}

std::vector<Kind> kinds() {
  using namespace wetcloth;
  Splash::Parameters splash;
  splash.region = Splash::Sphere{btVector3(0, 0, 0), 10};
  Wind::Parameters wind;
  wind.velocity = btVector3(3, 2, 1);
  return {kind<Absorption>("Absorption"),
          inWater<Immersion>("Immersion"),
          kind<Rain>("Rain"),
          kind<Splash>("Splash", splash),
          {"ContactWetting",
           [](WetCloth& cloth, const Place& place) {
             ContactWetting::Parameters parameters;
             parameters.wetBodies = {{&place.floor}};
             cloth.add<ContactWetting>(parameters);
           }},
          kind<Diffusion>("Diffusion"),
          kind<Seepage>("Seepage"),
          kind<Dripping>("Dripping"),
          kind<Drying>("Drying"),
          kind<WetStiffness>("WetStiffness"),
          kind<Swelling>("Swelling"),
          kind<Wind>("Wind", wind),
          inWater<WaterDrag>("WaterDrag"),
          kind<Cling>("Cling"),
          kind<HookeSprings>("HookeSprings"),
          kind<WetFriction>("WetFriction"),
          {"CollisionAudit", [](WetCloth& cloth, const Place&) { cloth.add<CollisionAudit>(); },
           [](WetCloth& cloth) { return cloth.find<CollisionAudit>()->totals().candidatePairs > 0; }}};
}

/// What came of a body with an effect, or without one.
struct Outcome {
  std::string refusal;
  std::vector<double> motion;      ///< places [m] and velocities [m/s] of all nodes
  std::vector<double> saturation;  ///< of all nodes
  bool hasSeen = false;
};

void note(const WetCloth& cloth, Outcome& outcome) {
  for (int i = 0; i < cloth.nodeCount(); ++i) {
    const btSoftBody::Node& node = cloth.body().m_nodes[i];
    EXPECT_TRUE(std::isfinite(node.m_x.length2()) && std::isfinite(node.m_v.length2())) << i;
    EXPECT_GE(cloth.held(i), 0) << i;
    for (const btVector3& vector : {node.m_x, node.m_v}) {
      for (int axis = 0; axis < 3; ++axis) outcome.motion.push_back(static_cast<double>(vector[axis]));
    }
    outcome.saturation.push_back(cloth.saturation(i));
  }
  const wetcloth::Ledger ledger = cloth.ledger();
  EXPECT_LE(std::abs(ledger.imbalance()), 1e-12 * (ledger.initial + ledger.absorbed));
}

/// Unevenly wet, every other node full.
void wetUnevenly(WetCloth& cloth) {
  std::vector<double> held;
  for (int i = 0; i < cloth.nodeCount(); ++i) held.push_back(cloth.capacity(i) * (i % 2 == 0 ? 0.7 : 1));
  cloth.setHeld(held);
}

Outcome slide(WorldKind worldKind, const Shape& shape, const Kind* effect) {
  BulletWorld world(worldKind, btVector3(3, -9, 2));  // water seeps in a cloth that is not level
  const Body body = shape.make(world.info());
  if (world.isDeformable()) {
    body->m_cfg.collisions = btSoftBody::fCollision::SDF_RD | btSoftBody::fCollision::SDF_RDN;
    if (!wetcloth::checkMesh(*body).bulletBuildsFaceTree()) wetcloth::buildFaceTree(*body);
  }
  body->getCollisionShape()->setMargin(btScalar(0.02));
  btScalar bottom = body->m_nodes[0].m_x.y(), top = bottom;
  for (int i = 0; i < body->m_nodes.size(); ++i) {
    bottom = std::min(bottom, body->m_nodes[i].m_x.y());
    top = std::max(top, body->m_nodes[i].m_x.y());
    body->m_nodes[i].m_v = btVector3(btScalar(0.5 + std::sin(i)), 0, btScalar(std::cos(3 * i)));
  }
  RigidBody floor(world, box(10, 0.5, 10), 0, btVector3(0, bottom - btScalar(0.518), 0));
  world.add(*body);
  Outcome outcome;
  {
    wetcloth::WetClothWorld wet(world.world());
    try {
      WetCloth& cloth = wet.add(*body, wetcloth::Fabric::cotton());
      wetUnevenly(cloth);
      if (effect != nullptr) effect->add(cloth, {floor.body(), top});
      world.step(24);
      note(cloth, outcome);
      outcome.hasSeen = effect != nullptr && effect->hasSeen && effect->hasSeen(cloth);
    } catch (const std::invalid_argument& refusal) {
      outcome.refusal = refusal.what();
      EXPECT_GT(outcome.refusal.size(), 20u) << refusal.what();
    }
  }
  world.remove(*body);
  return outcome;
}

constexpr WorldKind kWorlds[] = {WorldKind::softRigid, WorldKind::softMultiBody, WorldKind::deformable,
                                 WorldKind::deformableImplicit};

bool differ(const std::vector<double>& a, const std::vector<double>& b, double tolerance) {
  return !std::equal(a.begin(), a.end(), b.begin(), [=](double x, double y) { return std::abs(x - y) <= tolerance; });
}

/// Whether a body ends otherwise than without the effect, by more than rounding may make of it.
bool acts(const Outcome& with, const Outcome& without) {
  return with.hasSeen || differ(with.motion, without.motion, 1e-4) || differ(with.saturation, without.saturation, 1e-9);
}

std::string tableOfMeshes() {
  const std::vector<Shape> bodies = shapes();
  std::ostringstream head, rule, table;
  head << "| effect |";
  rule << "|---|";
  for (const Shape& shape : bodies) {
    head << ' ' << shape.name << " |";
    rule << "---|";
  }
  std::vector<Outcome> without;
  for (const Shape& shape : bodies) {
    for (const WorldKind world : kWorlds) without.push_back(slide(world, shape, nullptr));
  }
  for (const Kind& effect : kinds()) {
    table << "| " << effect.name << " |";
    std::size_t place = 0;
    for (const Shape& shape : bodies) {
      table << ' ';
      for (const WorldKind world : kWorlds) {
        SCOPED_TRACE(std::string(shape.name) + ", " + effect.name + ", " + nameOf(world));
        const Outcome with = slide(world, shape, &effect);
        table << (!with.refusal.empty() ? '-' : acts(with, without[place]) ? '+' : '.');
        ++place;
      }
      table << " |";
    }
    table << '\n';
  }
  return head.str() + '\n' + rule.str() + '\n' + table.str();
}

TEST(TableOfMeshes, IsThatOfTheDocumentation) { expectDocumented("meshes.md", "meshes", tableOfMeshes()); }

}  // namespace
}  // namespace wetcloth_test::meshes_as_people_have_them_test
