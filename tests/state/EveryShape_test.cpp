// SPDX-License-Identifier: Zlib
// Bullet keeps caches of its own for a cloth and what it lies on: against a shape of each kind, in each world, a
// restored run goes on bit for bit. One cloth, no effects.

#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyState.h"
#include "tests/support/BulletSprings.h"
#include "tests/support/ContactScene.h"
#include "tests/support/Measures.h"

#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>
#include <BulletCollision/CollisionShapes/btMultiSphereShape.h>
#include <BulletCollision/CollisionShapes/btScaledBvhTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btTriangleMesh.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace wetcloth_test::every_shape_test {
namespace {

btVector3 vector(double x, double y, double z) { return btVector3(btScalar(x), btScalar(y), btScalar(z)); }
btTransform at(double x, double y, double z) { return btTransform(btQuaternion::getIdentity(), vector(x, y, z)); }

/// A hilly ground in the square of 2 m around the origin, about as high as y = 0.
class Ground {
 public:
  static constexpr int kPoints = 9;
  Ground() {
    for (int k = 0; k < kPoints; ++k) {
      for (int i = 0; i < kPoints; ++i) m_heights.push_back(btScalar(0.05 * std::sin(1.3 * i) * std::cos(0.9 * k)));
    }
    for (int k = 0; k + 1 < kPoints; ++k) {
      for (int i = 0; i + 1 < kPoints; ++i) {
        m_triangles.addTriangle(point(i, k), point(i, k + 1), point(i + 1, k));
        m_triangles.addTriangle(point(i + 1, k), point(i, k + 1), point(i + 1, k + 1));
      }
    }
  }
  std::unique_ptr<btBvhTriangleMeshShape> mesh() {
    return std::make_unique<btBvhTriangleMeshShape>(&m_triangles, true);
  }
  std::unique_ptr<btCollisionShape> heightfield() {
    auto shape = std::make_unique<btHeightfieldTerrainShape>(kPoints, kPoints, m_heights.data(), btScalar(-0.1),
                                                             btScalar(0.1), 1, false);
    shape->setLocalScaling(vector(0.25, 1, 0.25));
    return shape;
  }

 private:
  btVector3 point(int i, int k) const {
    return btVector3(btScalar(-1 + 0.25 * i), m_heights[std::size_t(k * kPoints + i)], btScalar(-1 + 0.25 * k));
  }
  std::vector<btScalar> m_heights;
  btTriangleMesh m_triangles;
};

/// Shapes of all kinds, each with what it is made of.
class Shapes {
 public:
  /// By its name below; its upper side is at about y = 0.
  btCollisionShape& make(const std::string& name) { return *(this->*makers().at(name))(); }
  static std::vector<std::string> names() {
    std::vector<std::string> names;
    for (const auto& maker : makers()) names.push_back(maker.first);
    return names;
  }

 private:
  using Maker = btCollisionShape* (Shapes::*)();
  static const std::map<std::string, Maker>& makers() {
    static const std::map<std::string, Maker> all = {
        {"plane", &Shapes::plane},
        {"slope", &Shapes::slope},
        {"box", &Shapes::box},
        {"sphere", &Shapes::sphere},
        {"capsule", &Shapes::capsule},
        {"cylinder", &Shapes::cylinder},
        {"cone", &Shapes::cone},
        {"hull", &Shapes::hull},
        {"multiSphere", &Shapes::multiSphere},
        {"mesh", &Shapes::mesh},
        {"scaledMesh", &Shapes::scaledMesh},
        {"heightfield", &Shapes::heightfield},
        {"compound", &Shapes::compound},
        {"compoundWithoutTree", &Shapes::compoundWithoutTree},
        {"planeInCompound", &Shapes::planeInCompound},
        {"planeInCompoundOfCompound", &Shapes::planeInCompoundOfCompound},
        {"meshInCompound", &Shapes::meshInCompound},
    };
    return all;
  }

  template <class Shape>
  Shape* keep(std::unique_ptr<Shape> shape) {
    Shape* const kept = shape.get();
    m_shapes.push_back(std::move(shape));
    return kept;
  }
  template <class Shape, class... Arguments>
  Shape* add(Arguments&&... arguments) {
    return keep(std::make_unique<Shape>(std::forward<Arguments>(arguments)...));
  }
  btCollisionShape* compoundOf(const std::vector<btCollisionShape*>& children, bool hasTree = true) {
    auto* const compound = add<btCompoundShape>(hasTree);
    for (btCollisionShape* child : children) compound->addChildShape(at(0, 0, 0), child);
    return compound;
  }

  btCollisionShape* plane() { return add<btStaticPlaneShape>(vector(0, 1, 0), btScalar(0)); }
  btCollisionShape* slope() { return add<btStaticPlaneShape>(vector(0.3, 1, 0.1).normalized(), btScalar(0)); }
  btCollisionShape* box() { return add<btBoxShape>(vector(0.4, 0.03, 0.3)); }
  btCollisionShape* sphere() { return add<btSphereShape>(btScalar(0.3)); }
  btCollisionShape* capsule() { return add<btCapsuleShapeX>(btScalar(0.2), btScalar(0.5)); }
  btCollisionShape* cylinder() { return add<btCylinderShapeZ>(vector(0.2, 0.2, 0.4)); }
  btCollisionShape* cone() { return add<btConeShape>(btScalar(0.3), btScalar(0.4)); }
  btCollisionShape* hull() {
    auto* const shape = add<btConvexHullShape>();
    for (const btVector3& point : {vector(0.4, 0, 0), vector(-0.3, 0, 0.3), vector(-0.3, 0, -0.3), vector(0, 0.2, 0)}) {
      shape->addPoint(point);
    }
    return shape;
  }
  btCollisionShape* multiSphere() {
    const btVector3 centres[] = {vector(-0.2, 0, 0), vector(0.25, 0, 0.1)};
    const btScalar radii[] = {btScalar(0.15), btScalar(0.2)};
    return add<btMultiSphereShape>(centres, radii, 2);
  }
  btCollisionShape* mesh() { return keep(m_ground.mesh()); }
  btCollisionShape* scaledMesh() { return add<btScaledBvhTriangleMeshShape>(keep(m_ground.mesh()), vector(0.9, 2, 1)); }
  btCollisionShape* heightfield() { return keep(m_ground.heightfield()); }
  btCollisionShape* compound() { return compoundOf({sphere(), box()}); }
  btCollisionShape* compoundWithoutTree() { return compoundOf({sphere(), box()}, false); }
  btCollisionShape* planeInCompound() { return compoundOf({sphere(), plane()}); }
  btCollisionShape* planeInCompoundOfCompound() { return compoundOf({compoundOf({box(), slope()}), sphere()}, false); }
  btCollisionShape* meshInCompound() { return compoundOf({mesh(), sphere()}); }

  Ground m_ground;
  std::vector<std::unique_ptr<btCollisionShape>> m_shapes;
};

/// A cloth that falls, and flies sideways, onto one body.
class OnShape {
 public:
  OnShape(WorldKind kind, const std::string& shape) : m_bullet(kind) {
    btRigidBody::btRigidBodyConstructionInfo info(0, nullptr, &m_shapes.make(shape));
    m_rigid = std::make_unique<btRigidBody>(info);
    m_bullet.world().addRigidBody(m_rigid.get());
    wetcloth::ClothPatch patch = levelPatch(8, 0.7);
    patch.origin += vector(-0.35, 0.36, -0.3);
    m_body = patch.build(m_bullet.info());
    m_body->m_cfg.collisions = contactFlags(kind);
    m_body->m_cfg.kDF = btScalar(0.3);
    m_body->getCollisionShape()->setMargin(btScalar(kMargin));
    m_body->setActivationState(DISABLE_DEACTIVATION);
    m_body->addVelocity(vector(0.6, -2, 0.3));
    m_bullet.add(*m_body);
    if (m_bullet.isDeformable()) {
      m_bullet.addForce(*m_body, bulletSprings(20, 0.05));
    }
    m_wet = std::make_unique<wetcloth::WetClothWorld>(m_bullet.world());
    m_wet->setLog(nullptr);
    m_wet->add(*m_body);
  }
  ~OnShape() {
    m_wet.reset();
    m_bullet.remove(*m_body);
    m_bullet.world().removeRigidBody(m_rigid.get());
  }
  OnShape(const OnShape&) = delete;
  OnShape& operator=(const OnShape&) = delete;

  void step(int count) { m_bullet.step(count); }
  std::vector<btScalar> look() const { return stateOf(*m_body); }
  bool hasContact() const { return m_body->m_rcontacts.size() + m_body->m_nodeRigidContacts.size() > 0; }
  btScalar height() const { return meanPosition(*m_body).y(); }
  std::string saved() const {
    std::ostringstream stream;
    m_wet->save(stream);
    return stream.str();
  }
  void restore(const std::string& state) {
    std::istringstream stream(state);
    m_wet->restore(stream);
  }
  BulletWorld& bullet() { return m_bullet; }
  btRigidBody& rigid() { return *m_rigid; }

 private:
  BulletWorld m_bullet;
  Shapes m_shapes;
  std::unique_ptr<btRigidBody> m_rigid;
  std::unique_ptr<btSoftBody> m_body;
  std::unique_ptr<wetcloth::WetClothWorld> m_wet;
};

class StateOnEveryShape : public testing::TestWithParam<std::tuple<WorldKind, std::string>> {
 protected:
  std::unique_ptr<OnShape> scene() const {
    return std::make_unique<OnShape>(std::get<0>(GetParam()), std::get<1>(GetParam()));
  }
};

TEST_P(StateOnEveryShape, GoesOnBitForBit) {
  constexpr int kStepsAfter = 30;
  bool touched = false;
  const std::unique_ptr<OnShape> early = scene();
  const std::unique_ptr<OnShape> whole = scene();
  int earlySteps = 0;
  int wholeSteps = 0;
  for (const int saveAt : {3, 22, 48, 80}) {
    early->step(saveAt - std::exchange(earlySteps, saveAt));
    touched = touched || early->hasContact();
    const std::string state = early->saved();
    const std::unique_ptr<OnShape> late = scene();
    late->restore(state);
    EXPECT_EQ(late->saved(), state) << "saved after step " << saveAt;
    late->step(kStepsAfter);
    whole->step(saveAt + kStepsAfter - std::exchange(wholeSteps, saveAt + kStepsAfter));
    EXPECT_TRUE(sameBits(late->look(), whole->look()))
        << "saved after step " << saveAt << ", off by " << largestDifference(late->look(), whole->look());
  }
  EXPECT_TRUE(touched) << "nothing was put to the test; the cloth is at " << early->height();
}

// A world that has run on has caches of its own when it is taken back.
TEST_P(StateOnEveryShape, TurnsBackTime) {
  const std::unique_ptr<OnShape> turned = scene();
  turned->step(30);
  const std::string state = turned->saved();
  turned->step(40);
  const std::vector<btScalar> end = turned->look();
  turned->restore(state);
  EXPECT_EQ(turned->saved(), state);
  turned->step(40);
  EXPECT_TRUE(sameBits(turned->look(), end));
}

INSTANTIATE_TEST_SUITE_P(, StateOnEveryShape,
                         testing::Combine(testing::Values(WorldKind::softRigid, WorldKind::softMultiBody,
                                                          WorldKind::deformable, WorldKind::deformableImplicit),
                                          testing::ValuesIn(Shapes::names())),
                         [](const auto& test) {
                           return std::string(nameOf(std::get<0>(test.param))) + "_" + std::get<1>(test.param);
                         });

}  // namespace
}  // namespace wetcloth_test::every_shape_test
