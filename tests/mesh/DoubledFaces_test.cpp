// SPDX-License-Identifier: Zlib
// A face that is there twice, either way round, is one layer of cloth: a body with doubled faces does what the body
// without them does, bit for bit.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "bullet_wetcloth/mesh/RestMesh.h"
#include "bullet_wetcloth/water/DryMass.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/InEveryWorld.h"

#include <BulletSoftBody/btSoftBodyHelpers.h>

#include <functional>
#include <memory>
#include <vector>

namespace wetcloth_test::doubled_faces_test {
namespace {

using wetcloth::WetCloth;

constexpr int kSide = 5;

/// A slope of kSide x kSide nodes as applications make it. Doubled: each face again, the other way round, and every
/// third once more as it is.
std::unique_ptr<btSoftBody> slope(btSoftBodyWorldInfo& info, bool isDoubled) {
  std::vector<btScalar> vertices;
  for (int i = 0; i < kSide * kSide; ++i) {
    const int column = i % kSide;
    const int row = i / kSide;
    vertices.insert(vertices.end(), {btScalar(0.25) * column, btScalar(0.1) * row, btScalar(0.25) * row});
  }
  std::vector<int> corners;
  for (int row = 0; row + 1 < kSide; ++row) {
    for (int column = 0; column + 1 < kSide; ++column) {
      const int a = row * kSide + column;
      corners.insert(corners.end(), {a, a + 1, a + kSide, a + 1, a + kSide + 1, a + kSide});
    }
  }
  const std::size_t single = corners.size();
  for (std::size_t k = 0; isDoubled && k < single; k += 3) {
    corners.insert(corners.end(), {corners[k + 2], corners[k + 1], corners[k]});
    if (k % 9 == 0) corners.insert(corners.end(), {corners[k + 1], corners[k + 2], corners[k]});
  }
  std::unique_ptr<btSoftBody> body(btSoftBodyHelpers::CreateFromTriMesh(info, vertices.data(), corners.data(),
                                                                        static_cast<int>(corners.size() / 3), false));
  body->setTotalMass(btScalar(0.2));
  body->setMass(0, 0);
  body->setMass(kSide - 1, 0);
  return body;
}

using Add = std::function<void(WetCloth&)>;

struct Outcome {
  std::vector<double> held;
  std::vector<btVector3> places;
  wetcloth::Ledger ledger;
};

Outcome run(WorldKind kind, bool isDoubled, const Add& add) {
  BulletWorld world(kind);
  const auto body = slope(world.info(), isDoubled);
  world.add(*body);
  Outcome outcome;
  {
    wetcloth::WetClothWorld wet(world.world());
    WetCloth& cloth = wet.add(*body);
    std::vector<double> held;
    for (int i = 0; i < cloth.nodeCount(); ++i) held.push_back(0.1 * (i % 7) * cloth.capacity(i));
    cloth.setHeld(held);
    add(cloth);
    world.step(24);
    for (int i = 0; i < cloth.nodeCount(); ++i) {
      outcome.held.push_back(cloth.held(i));
      outcome.places.push_back(body->m_nodes[i].m_x);
    }
    outcome.ledger = cloth.ledger();
  }
  world.remove(*body);
  return outcome;
}

class DoubledFaces {
 protected:
  void areOneLayer(const Add& add) {
    const Outcome single = run(GetParam(), false, add);
    const Outcome doubled = run(GetParam(), true, add);
    EXPECT_EQ(doubled.held, single.held);
    EXPECT_EQ(doubled.ledger.runOff, single.ledger.runOff);
    for (std::size_t i = 0; i < single.places.size(); ++i) {
      for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(doubled.places[i][axis], single.places[i][axis]) << i;
    }
  }
};

TEST_F_IN_EVERY_WORLD(DoubledFaces, Dry) {
  areOneLayer([](WetCloth& cloth) { cloth.add<wetcloth::Drying>(); });
}

TEST_F_IN_EVERY_WORLD(DoubledFaces, Diffuse) {
  areOneLayer([](WetCloth& cloth) { cloth.add<wetcloth::Diffusion>(); });
}

TEST_F_IN_EVERY_WORLD(DoubledFaces, DiffuseAlongTheWarp) {
  wetcloth::Diffusion::Parameters wicking;
  wicking.warpDiffusivity *= 3;
  areOneLayer([&](WetCloth& cloth) { cloth.add<wetcloth::Diffusion>(wicking); });
}

TEST_F_IN_EVERY_WORLD(DoubledFaces, Seep) {
  areOneLayer([](WetCloth& cloth) { cloth.add<wetcloth::Seepage>(); });
}

TEST_F_IN_EVERY_WORLD(DoubledFaces, Drip) {
  areOneLayer([](WetCloth& cloth) {
    cloth.setSaturation(1);
    cloth.add<wetcloth::Dripping>();
  });
}

TEST_F_IN_EVERY_WORLD(DoubledFaces, CatchRain) {
  for (const bool selfShelter : {false, true}) {
    wetcloth::Rain::Parameters rain;
    rain.selfShelter = selfShelter;
    areOneLayer([&](WetCloth& cloth) { cloth.add<wetcloth::Rain>(rain); });
  }
}

TEST_F_IN_EVERY_WORLD(DoubledFaces, FeelWind) {
  using Law = wetcloth::Wind::Law;
  for (const Law law : {Law::quadratic, Law::linear, Law::paper}) {
    wetcloth::Wind::Parameters air;
    air.velocity = btVector3(1, 2, 3);
    air.skinFriction = 0.01;
    air.law = law;
    areOneLayer([&](WetCloth& cloth) { cloth.add<wetcloth::Wind>(air); });
  }
}

TEST_F_IN_EVERY_WORLD(DoubledFaces, FeelWater) {
  wetcloth::WaterDrag::Parameters pool;
  pool.surface = wetcloth::WaterSurface();
  pool.surface->offset = -0.25;
  areOneLayer([&](WetCloth& cloth) { cloth.add<wetcloth::WaterDrag>(pool); });
}

TEST(DoubledFacesOf, AMeshHaveOneLayersArea) {
  btSoftBodyWorldInfo info;
  const auto single = slope(info, false);
  const auto doubled = slope(info, true);
  const wetcloth::RestMesh mesh(*doubled);
  EXPECT_EQ(mesh.nodeAreas(), wetcloth::RestMesh(*single).nodeAreas());
  EXPECT_EQ(wetcloth::nodeAreas(*doubled), wetcloth::nodeAreas(*single));
  ASSERT_EQ(static_cast<int>(mesh.triangles().size()), doubled->m_faces.size());
  for (std::size_t f = 0; f < mesh.triangles().size(); ++f) {
    EXPECT_EQ(mesh.triangles()[f].isDoubled, static_cast<int>(f) >= single->m_faces.size()) << f;
  }
}

// Falls through without touching: each vertex passes one layer.
TEST(DoubledFacesOf, AMeshAreAuditedOnce) {
  long long passages[2][2];
  for (const bool isDoubled : {false, true}) {
    BulletWorld world(WorldKind::softRigid, kNoGravity);
    const auto still = slope(world.info(), isDoubled);
    const auto falling = slope(world.info(), isDoubled);
    falling->translate(btVector3(btScalar(0.03), btScalar(0.2), btScalar(0.07)));
    falling->setVelocity(btVector3(0, -8, 0));
    for (btSoftBody* body : {still.get(), falling.get()}) {
      body->m_cfg.collisions = 0;
      world.add(*body);
    }
    for (int i = 0; i < falling->m_nodes.size(); ++i) falling->m_nodes[i].m_im = 1;
    {
      wetcloth::WetClothWorld wet(world.world());
      wetcloth::CollisionAudit& audit = wet.add(*still).add<wetcloth::CollisionAudit>();
      wet.add(*falling);
      world.step(24);
      audit.look();
      passages[isDoubled][0] = audit.totals().vertexFace;
      passages[isDoubled][1] = audit.totals().edgeEdge;
    }
    world.remove(*still);
    world.remove(*falling);
  }
  EXPECT_GT(passages[0][0], 0);
  EXPECT_EQ(passages[1][0], passages[0][0]);
  EXPECT_EQ(passages[1][1], passages[0][1]);
}

}  // namespace
}  // namespace wetcloth_test::doubled_faces_test
