// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/RigidDetection.h"

#include "bullet_wetcloth/solver/ShapeDistance.h"
#include "tests/solver/SolverScene.h"
#include "tests/support/BodyScene.h"
#include "tests/support/Measures.h"
#include "tests/support/RigidBody.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>

namespace wetcloth_test::rigid_detection_test {
namespace {

using wetcloth::MeasuredShape;

void expectDistance(const btCollisionShape& shape, const btVector3& point, double distance, const btVector3& normal) {
  const wetcloth::ShapeDistance found = MeasuredShape(shape).distanceTo(point);
  EXPECT_NEAR(double(found.distance), distance, 1e-6);
  EXPECT_LT(double((found.normal - normal).length()), 1e-6);
}

TEST(ShapeDistance, OfABox) {
  const btBoxShape shape(btVector3(1, 2, 3));
  expectDistance(shape, btVector3(2, 0, 0), 1, btVector3(1, 0, 0));
  expectDistance(shape, btVector3(0, btScalar(-1.9), 0), -0.1, btVector3(0, -1, 0));
  expectDistance(shape, btVector3(4, 6, 0), 5, btVector3(btScalar(0.6), btScalar(0.8), 0));
  expectDistance(shape, btVector3(0, 0, 0), -1, btVector3(1, 0, 0));
}

TEST(ShapeDistance, OfASphereAndAPlane) {
  const btSphereShape sphere(2);
  expectDistance(sphere, btVector3(0, 0, -3), 1, btVector3(0, 0, -1));
  expectDistance(sphere, btVector3(1, 0, 0), -1, btVector3(1, 0, 0));
  EXPECT_NEAR(double(MeasuredShape(sphere).distanceTo(btVector3(0, 0, 0)).normal.length()), 1, 1e-6);
  const btStaticPlaneShape plane(btVector3(0, 1, 0), btScalar(0.5));
  expectDistance(plane, btVector3(7, 2, 0), 1.5, btVector3(0, 1, 0));
  EXPECT_FALSE(MeasuredShape::isOne(btConeShape(1, 1)));
}

TEST(ShapeDistance, OfACapsule) {
  const btCapsuleShapeZ shape(1, 4);  // 4 m between the middles of its ends
  expectDistance(shape, btVector3(0, 3, 2), 2, btVector3(0, 1, 0));
  expectDistance(shape, btVector3(3, 0, 6), 4, btVector3(btScalar(0.6), 0, btScalar(0.8)));
  expectDistance(shape, btVector3(0, btScalar(0.5), -1), -0.5, btVector3(0, 1, 0));
  EXPECT_NEAR(double(MeasuredShape(shape).distanceTo(btVector3(0, 0, 1)).distance), -1, 1e-6);
}

TEST(ShapeDistance, OfARoundCylinder) {
  const btCylinderShape shape(btVector3(1, 2, 1));
  expectDistance(shape, btVector3(3, 1, 0), 2, btVector3(1, 0, 0));
  expectDistance(shape, btVector3(0, -5, 0), 3, btVector3(0, -1, 0));
  expectDistance(shape, btVector3(0, 6, -4), 5, btVector3(0, btScalar(0.8), btScalar(-0.6)));
  expectDistance(shape, btVector3(btScalar(0.9), 0, 0), -0.1, btVector3(1, 0, 0));
  EXPECT_FALSE(MeasuredShape::isOne(btCylinderShape(btVector3(1, 2, 3))));
}

using ShapeMaker = std::function<std::unique_ptr<btCollisionShape>()>;
struct Ground {
  const char* name;
  ShapeMaker make;
  double top;  // of the shape at the middle of the cloth, over its centre [m]
};

// Bullet's margin around it is a part of it.
std::unique_ptr<btCollisionShape> hullOfABox(double x, double y, double z) {
  auto hull = std::make_unique<btConvexHullShape>();
  hull->setMargin(btScalar(0.01));
  for (int corner = 0; corner < 8; ++corner) {
    const auto side = [&](int bit, double half) { return btScalar((corner & bit) != 0 ? half - 0.01 : 0.01 - half); };
    hull->addPoint(btVector3(side(1, x), side(2, y), side(4, z)));
  }
  return hull;
}

const std::vector<Ground>& grounds() {
  static const std::vector<Ground> all = {
      {"box", [] { return box(2, 0.5, 2); }, 0.5},
      {"plane", [] { return std::make_unique<btStaticPlaneShape>(btVector3(0, 1, 0), btScalar(0.5)); }, 0.5},
      {"sphere", [] { return std::make_unique<btSphereShape>(btScalar(0.5)); }, 0.5},
      {"capsule", [] { return std::make_unique<btCapsuleShapeX>(btScalar(0.5), 3); }, 0.5},
      {"hull", [] { return hullOfABox(2, 0.5, 2); }, 0.5},
      {"cylinder", [] { return std::make_unique<btCylinderShape>(btVector3(2, btScalar(0.5), 2)); }, 0.5},
  };
  return all;
}

// Where Bullet's own detection finds contacts we find them, too, but for nodes at the very edge of the margin.
TEST(RigidDetection, FindsTheContactsThatBulletFinds) {
  for (const Ground& ground : grounds()) {
    wetcloth::ClothPatch patch = levelPatch(9, 1);
    patch.origin.setY(btScalar(ground.top + 0.015));
    BodyScene bullets(WorldKind::softRigid, patch);
    SolverScene scene;
    btSoftBody& body = scene.add(patch);
    RigidBody bulletsGround(bullets.bullet(), ground.make(), 0, btVector3(0, 0, 0));
    RigidBody ourGround(scene.bullet(), ground.make(), 0, btVector3(0, 0, 0));
    for (btSoftBody* const each : {&body, &bullets.body()}) each->getCollisionShape()->setMargin(btScalar(0.02));
    bullets.bullet().step(1, btScalar(1) / 60);
    scene.step(1);
    ASSERT_GT(body.m_rcontacts.size(), 0) << ground.name;
    const auto isTouched = [](const btSoftBody& cloth, int node) {
      for (int k = 0; k < cloth.m_rcontacts.size(); ++k) {
        if (cloth.m_rcontacts[k].m_node == &cloth.m_nodes[node]) return true;
      }
      return false;
    };
    int different = 0;
    for (int k = 0; k < body.m_nodes.size(); ++k) {
      if (isTouched(body, k) != isTouched(bullets.body(), k)) ++different;
    }
    EXPECT_LE(different, 8) << ground.name;
    const btSoftBody::RContact& ours = body.m_rcontacts[0];
    EXPECT_EQ(ours.m_cti.m_colObj, &ourGround.body());
    EXPECT_NEAR(double(ours.m_cti.m_normal.length()), 1, 1e-3) << ground.name;
  }
}

TEST(RigidDetection, AClothComesToRestOnAnyShape) {
  for (const Ground& ground : grounds()) {
    SolverScene scene;
    wetcloth::ClothPatch patch = levelPatch(9, 0.3);
    patch.origin.setY(btScalar(ground.top + 0.1));
    btSoftBody& body = scene.add(patch);
    body.getCollisionShape()->setMargin(btScalar(0.01));
    body.m_cfg.kDF = 1;
    RigidBody under(scene.bullet(), ground.make(), 0, btVector3(0, 0, 0));
    under.body().setFriction(1);
    scene.step(240);
    EXPECT_LT(largestSpeed(body), 0.05) << ground.name;
    EXPECT_NEAR(double(body.m_nodes[40].m_x.y()), ground.top, 0.015) << ground.name;
  }
}

}  // namespace
}  // namespace wetcloth_test::rigid_detection_test
