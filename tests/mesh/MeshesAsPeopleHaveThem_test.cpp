// SPDX-License-Identifier: Zlib
// Bodies as applications make them, faults and all: each effect runs on each, finite and with a closed ledger, or is
// refused with a reason when it is added.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BulletWorld.h"

#include <BulletSoftBody/btSoftBodyHelpers.h>

#include <functional>
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
      {"CreateEllipsoid",
       [](auto& info) {
         return Body(btSoftBodyHelpers::CreateEllipsoid(info, {0, 0, 0}, {1, 1, 1}, 64));
       }},
      {"CreateRope",
       [](auto& info) {
         return Body(btSoftBodyHelpers::CreateRope(info, {0, 0, 0}, {1, 0, 0}, 8, 1));
       }},
      {"CreateFromTriMesh",
       [=](auto& info) {
         return fromTriangles(info, square, {0, 1, 2, 0, 2, 3});
       }},
      {"doubled faces",
       [=](auto& info) {
         return fromTriangles(info, square, {0, 1, 2, 0, 2, 3, 2, 1, 0, 3, 2, 0});
       }},
      {"three faces at an edge",
       [=](auto& info) {
         std::vector<btScalar> five = square;
         five.insert(five.end(), {0, 1, 0});
         return fromTriangles(info, five, {0, 1, 2, 0, 2, 3, 0, 2, 4});
       }},
      {"face without area",
       [=](auto& info) {
         std::vector<btScalar> five = square;
         five.insert(five.end(), {btScalar(0.5), 0, 0});
         return fromTriangles(info, five, {0, 1, 2, 0, 2, 3, 0, 4, 1});
       }},
      {"stray node",
       [=](auto& info) {
         Body body = fromTriangles(info, square, {0, 1, 2, 0, 2, 3});
         body->appendNode(btVector3(5, 0, 0), btScalar(0.01));
         return body;
       }},
      {"two parts, coincident nodes",
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

struct Kind {
  const char* name;
  std::function<void(WetCloth&)> add;
};

template <class E>
Kind kind(const char* name) {
  return {name, [](WetCloth& cloth) { cloth.add<E>(); }};
}

std::vector<Kind> kinds() {
  using namespace wetcloth;
  return {kind<Absorption>("Absorption"),
          kind<Rain>("Rain"),
          kind<ContactWetting>("ContactWetting"),
          kind<Diffusion>("Diffusion"),
          kind<Seepage>("Seepage"),
          kind<Dripping>("Dripping"),
          kind<Drying>("Drying"),
          kind<Swelling>("Swelling"),
          kind<WetStiffness>("WetStiffness"),
          kind<Cling>("Cling"),
          kind<WetFriction>("WetFriction"),
          kind<Wind>("Wind"),
          kind<HookeSprings>("HookeSprings"),
          kind<CollisionAudit>("CollisionAudit")};
}

class MeshesAsPeopleHaveThem : public testing::TestWithParam<WorldKind> {};

TEST_P(MeshesAsPeopleHaveThem, EveryEffectRunsOrIsRefusedWithAReason) {
  for (const Shape& shape : shapes()) {
    for (const Kind& effect : kinds()) {
      SCOPED_TRACE(std::string(shape.name) + ", " + effect.name);
      BulletWorld world(GetParam());
      const Body body = shape.make(world.info());
      if (world.isDeformable()) {
        body->m_cfg.collisions = btSoftBody::fCollision::SDF_RD | btSoftBody::fCollision::SDF_RDF;
        if (!wetcloth::checkMesh(*body).bulletBuildsFaceTree()) wetcloth::buildFaceTree(*body);
      }
      world.add(*body);
      {
        wetcloth::WetClothWorld wet(world.world());
        try {
          WetCloth& cloth = wet.add(*body, wetcloth::Fabric::cotton());
          cloth.setSaturation(0.5);
          effect.add(cloth);
          world.step(24);
          for (int i = 0; i < body->m_nodes.size(); ++i) {
            EXPECT_TRUE(std::isfinite(body->m_nodes[i].m_x.length2())) << i;
            EXPECT_GE(cloth.held(i), 0) << i;
          }
          const wetcloth::Ledger ledger = cloth.ledger();
          EXPECT_LE(std::abs(ledger.imbalance()), 1e-12 * (ledger.initial + ledger.absorbed));
        } catch (const std::invalid_argument& refusal) {
          EXPECT_GT(std::string(refusal.what()).size(), 20u) << refusal.what();
        }
      }
      world.remove(*body);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, MeshesAsPeopleHaveThem, testing::Values(WorldKind::softRigid, WorldKind::deformable),
                         [](const auto& test) { return std::string(nameOf(test.param)); });

}  // namespace
}  // namespace wetcloth_test::meshes_as_people_have_them_test
