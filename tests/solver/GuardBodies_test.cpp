// SPDX-License-Identifier: Zlib
// With the guard's `bodies` no vertex of a cloth meets a face of a rigid body, no corner of the body a face of the
// cloth, and no edge an edge, from small step to small step.
#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/solver/ClothAndBodies.h"

#include <BulletCollision/Gimpact/btGImpactShape.h>
#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>
#include <sstream>
#include <string>

namespace wetcloth_test::guard_bodies_test {
namespace {

using Edge = wetcloth::ClothPatch::Edge;

void expectNothingForced(ClothAndBodies& scene) {
  EXPECT_EQ(scene.passages(), 0);
  EXPECT_EQ(scene.totals().forced, 0);
  EXPECT_EQ(scene.totals().meeting, 0);
  EXPECT_EQ(scene.totals().inside, 0);
  EXPECT_EQ(scene.totals().halts, 0);
}

wetcloth::ClothPatch frame(const btVector3& middle = btVector3(0, 0, 0)) {
  wetcloth::ClothPatch patch = levelSheet(13, 0.6, middle);
  patch.pinnedEdges = {Edge::top, Edge::bottom, Edge::left, Edge::right};
  return patch;
}

void throwDown(btSoftBody& cloth, double speed) { setVelocity(cloth, btVector3(0, btScalar(-speed), 0)); }

std::unique_ptr<btCollisionShape> hullOf(const BodySurface& surface) {
  auto shape = std::make_unique<btConvexHullShape>();
  for (const btVector3& corner : surface.corners) shape->addPoint(corner);
  return shape;
}

std::unique_ptr<btTriangleMesh> meshOf(const BodySurface& surface) {
  auto mesh = std::make_unique<btTriangleMesh>();
  for (const auto& face : surface.faces) {
    mesh->addTriangle(surface.corners[std::size_t(face[0])], surface.corners[std::size_t(face[1])],
                      surface.corners[std::size_t(face[2])]);
  }
  return mesh;
}

/// A mesh that owns its triangles.
class MeshShape : public btBvhTriangleMeshShape {
 public:
  static std::unique_ptr<btCollisionShape> of(const BodySurface& surface) {
    return std::make_unique<MeshShape>(meshOf(surface));
  }
  explicit MeshShape(std::unique_ptr<btTriangleMesh> mesh)
      : btBvhTriangleMeshShape(mesh.get(), true), m_mesh(std::move(mesh)) {}

 private:
  std::unique_ptr<btTriangleMesh> m_mesh;
};

/// The same, of Bullet's meshes that may move.
class MovingMeshShape : public btGImpactMeshShape {
 public:
  static std::unique_ptr<btCollisionShape> of(const BodySurface& surface) {
    auto shape = std::make_unique<MovingMeshShape>(meshOf(surface));
    shape->updateBound();
    return shape;
  }
  explicit MovingMeshShape(std::unique_ptr<btTriangleMesh> mesh)
      : btGImpactMeshShape(mesh.get()), m_mesh(std::move(mesh)) {}

 private:
  std::unique_ptr<btTriangleMesh> m_mesh;
};

/// Blades that stand upright around an axis, sharp edges up.
BodySurface fan(int blades, double radius, double height) {
  std::vector<btVector3> corners;
  std::vector<std::array<int, 3>> faces;
  for (int k = 0; k < blades; ++k) {
    const double angle = 2 * 3.14159265358979 * k / blades;
    const btScalar x = btScalar(radius * std::cos(angle));
    const btScalar z = btScalar(radius * std::sin(angle));
    const int first = int(corners.size());
    corners.insert(corners.end(), {btVector3(x / 10, 0, z / 10), btVector3(x, 0, z), btVector3(x, btScalar(height), z),
                                   btVector3(x / 10, btScalar(height / 2), z / 10)});
    faces.push_back({first, first + 1, first + 2});
    faces.push_back({first, first + 2, first + 3});
  }
  return BodySurface::ofTriangles(std::move(corners), std::move(faces));
}

void makeKinematic(btRigidBody& body) {
  body.setCollisionFlags(body.getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
}

btTransform at(const btVector3& place, const btQuaternion& turn = btQuaternion::getIdentity()) {
  return btTransform(turn, place);
}

// --- cloth falls on what is thin or sharp ---------------------------------------------------------------------------

struct Fall {
  const char* name;
  double speed;
  void (*addObstacle)(ClothAndBodies&);
};
std::ostream& operator<<(std::ostream& out, const Fall& fall) { return out << fall.name; }

void addCorner(ClothAndBodies& scene) { scene.addBox(0.1, 0.1, 0.1, btVector3(0, btScalar(-0.13), 0)); }
void addSpike(ClothAndBodies& scene) {
  const BodySurface spike = BodySurface::ofSpike(5, 0.03, 0.3);
  scene.add(hullOf(spike), spike, btVector3(0, btScalar(-0.33), 0));
}
void addCone(ClothAndBodies& scene) {
  // What is checked is a pyramid in the cone.
  BodySurface inner = BodySurface::ofSpike(4, 0.02, 0.3);
  for (btVector3& corner : inner.corners) corner -= btVector3(0, btScalar(0.15), 0);
  scene.add(std::make_unique<btConeShape>(btScalar(0.02), btScalar(0.3)), inner, btVector3(0, btScalar(-0.18), 0));
}
void addMesh(ClothAndBodies& scene) {
  const BodySurface blades = fan(7, 0.2, 0.2);
  scene.add(MeshShape::of(blades), blades, btVector3(0, btScalar(-0.23), 0));
}
void addMovingMesh(ClothAndBodies& scene) {
  const BodySurface blades = fan(7, 0.2, 0.2);
  scene.add(MovingMeshShape::of(blades), blades, btVector3(0, btScalar(-0.23), 0));
}
void addCompound(ClothAndBodies& scene) {
  // A rod on a shelf.
  static btBoxShape rod(btVector3(btScalar(0.002), btScalar(0.1), btScalar(0.002)));
  auto shape = std::make_unique<btCompoundShape>();
  shape->addChildShape(at(btVector3(btScalar(0.05), btScalar(0.1), 0)), &rod);
  BodySurface surface = BodySurface::ofBox(0.002, 0.1, 0.002);
  for (btVector3& corner : surface.corners) corner += btVector3(btScalar(0.05), btScalar(0.1), 0);
  scene.add(std::move(shape), surface, btVector3(0, btScalar(-0.23), 0));
}

class ClothFalls : public testing::TestWithParam<Fall> {};
INSTANTIATE_TEST_SUITE_P(, ClothFalls,
                         testing::Values(Fall{"overACorner", 1, addCorner}, Fall{"fastOverACorner", 20, addCorner},
                                         Fall{"overASpike", 1, addSpike}, Fall{"fastOverASpike", 20, addSpike},
                                         Fall{"overACone", 1, addCone}, Fall{"fastOverACone", 20, addCone},
                                         Fall{"overAMesh", 1, addMesh}, Fall{"fastOverAMesh", 20, addMesh},
                                         Fall{"overAMovingMesh", 1, addMovingMesh},
                                         Fall{"fastOverAMovingMesh", 20, addMovingMesh},
                                         Fall{"overACompound", 1, addCompound},
                                         Fall{"fastOverACompound", 20, addCompound}),
                         [](const auto& test) { return std::string(test.param.name); });

void fall(ClothAndBodies& scene, const Fall& what) {
  btSoftBody& cloth = scene.add(levelSheet(13, 0.6, btVector3(btScalar(0.021), 0, btScalar(0.013))));
  throwDown(cloth, what.speed);
  what.addObstacle(scene);
  scene.step(what.speed > 10 ? 12 : 30);
}

TEST_P(ClothFalls, AndPassesNothing) {
  ClothAndBodies scene(true);
  fall(scene, GetParam());
  expectNothingForced(scene);
  EXPECT_GT(scene.totals().pairs, 0);
  EXPECT_TRUE(isFinite(scene.cloth()));
}

TEST_P(ClothFalls, AndPassesWithoutTheOption) {
  ClothAndBodies scene(false);
  fall(scene, GetParam());
  EXPECT_GT(scene.passages(), 0);
}

// --- bodies fall on cloth -------------------------------------------------------------------------------------------

class NeedleFalls : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(, NeedleFalls, testing::Values(1, 20));

// 4 mm wide, on a cloth whose edges are 50 mm long.
btRigidBody& dropNeedle(ClothAndBodies& scene, double speed) {
  return scene.addBox(0.002, 0.1, 0.002, btVector3(btScalar(0.02), btScalar(0.13), btScalar(0.013)), 0.05,
                      btVector3(0, btScalar(-speed), 0));
}

TEST_P(NeedleFalls, AndIsCaught) {
  ClothAndBodies scene(true);
  scene.add(frame());
  const btRigidBody& needle = dropNeedle(scene, GetParam());
  scene.step(30);
  expectNothingForced(scene);
  EXPECT_LT(std::fabs(double(needle.getLinearVelocity().y())), 1.5) << "the cloth has stopped it";
  EXPECT_GT(double(needle.getWorldTransform().getOrigin().y()), -0.5);
}

TEST_P(NeedleFalls, AndPassesWithoutTheOption) {
  ClothAndBodies scene(false);
  scene.add(frame());
  dropNeedle(scene, GetParam());
  scene.step(20);
  EXPECT_GT(scene.passages(), 0);
}

void shoot(ClothAndBodies& scene) {
  wetcloth::ClothPatch sail = sailPatch(13);
  sail.pinnedEdges = {Edge::top};
  scene.add(sail);
  scene.addBox(0.02, 0.02, 0.02, btVector3(btScalar(0.51), btScalar(0.52), btScalar(0.7)), 0.1, btVector3(0, 0, -30));
  scene.step(15);
}

// It flies half a metre in a step, and is not near when that begins.
TEST(GuardBodies, AFastBoxHitsAHangingCloth) {
  ClothAndBodies with(true);
  shoot(with);
  expectNothingForced(with);
  ClothAndBodies without(false);
  shoot(without);
  EXPECT_GT(without.passages(), 0);
}

// --- bodies that an application moves -------------------------------------------------------------------------------

void sweep(ClothAndBodies& scene, double turning) {
  scene.add(frame());
  btRigidBody& body = scene.addBox(0.03, 0.02, 0.12, btVector3(btScalar(-0.05), btScalar(0.25), 0));
  makeKinematic(body);
  const btVector3 axis = btVector3(1, btScalar(0.3), btScalar(0.7)).normalized();
  scene.step(90, [&](int step) {
    const double time = step / 60.0;
    const btVector3 place(btScalar(-0.05 + 0.05 * time), btScalar(0.25 - 0.3 * std::sin(time)), 0);
    body.setWorldTransform(at(place, btQuaternion(axis, btScalar(turning * time))));
  });
}

TEST(GuardBodies, AKinematicBoxSweeps) {
  for (const double turning : {0.0, 5.0}) {
    ClothAndBodies with(true);
    sweep(with, turning);
    expectNothingForced(with);
    ClothAndBodies without(false);
    sweep(without, turning);
    EXPECT_GT(without.passages(), 0);
  }
}

// Two boxes close on a cloth; this is left between them at the end [m].
void pinch(ClothAndBodies& scene, double gap) {
  scene.add(levelSheet(13, 0.6, btVector3(0, 0, 0)));
  btRigidBody& above = scene.addBox(0.2, 0.05, 0.2, btVector3(0, btScalar(0.1), 0));
  btRigidBody& below = scene.addBox(0.2, 0.05, 0.2, btVector3(btScalar(0.02), btScalar(-0.1), 0));
  makeKinematic(above);
  makeKinematic(below);
  scene.step(45, [&](int step) {
    const double half = std::max(gap / 2, 0.05 - (0.05 - gap / 2) * step / 30.0);
    above.setWorldTransform(at(btVector3(0, btScalar(0.05 + half), 0)));
    below.setWorldTransform(at(btVector3(btScalar(0.02), btScalar(-0.05 - half), 0)));
  });
}

TEST(GuardBodies, APinchThatLeavesRoom) {
  for (const double gap : {0.03, 0.005}) {
    ClothAndBodies scene(true);
    pinch(scene, gap);
    expectNothingForced(scene);
  }
  ClothAndBodies without(false);
  pinch(without, 0.03);
  EXPECT_GT(without.passages(), 0);
}

// Bodies go where they are told. It is told, and the rest of the cloth goes on.
TEST(GuardBodies, APinchThatLeavesNone) {
  ClothAndBodies scene(true);
  pinch(scene, -0.01);
  EXPECT_GT(scene.totals().forced, 0);
  EXPECT_TRUE(isFinite(scene.cloth()));
  EXPECT_LT(largestSpeed(scene.cloth()), 20);
  EXPECT_LT(double(scene.cloth().m_nodes[0].m_x.y()), -0.01) << "a corner that nothing holds falls";
}

TEST(GuardBodies, ABodyThatIsPutElsewhereSweepsNothing) {
  ClothAndBodies scene(true, kNoGravity);
  scene.add(levelSheet(9, 0.4, btVector3(0, 0, 0)));
  btRigidBody& body = scene.addBox(0.05, 0.05, 0.05, btVector3(0, btScalar(0.3), 0), 1);
  scene.step(2);
  body.setCenterOfMassTransform(at(btVector3(0, btScalar(-0.5), 0)));
  scene.step(2);
  EXPECT_EQ(scene.totals().forced, 0);
  EXPECT_NEAR(double(meanPosition(scene.cloth()).y()), 0, 1e-3);
}

// --- what stands in a body ------------------------------------------------------------------------------------------

TEST(GuardBodies, WhatStandsInABodyComesOut) {
  ClothAndBodies scene(true, kNoGravity);
  btSoftBody& cloth = scene.add(levelSheet(13, 0.6, btVector3(0, 0, 0)));
  scene.addBox(0.12, 0.06, 0.12, btVector3(0, btScalar(-0.05), 0));
  scene.step(1);
  EXPECT_GT(scene.totals().inside, 0);
  scene.step(60);
  EXPECT_TRUE(isFinite(cloth));
  EXPECT_EQ(scene.totals().halts, 0);
  EXPECT_LT(largestSpeed(cloth), 5);
  scene.scene().solver().resetGuardTotals();
  scene.step(1);
  EXPECT_EQ(scene.totals().inside, 0) << "it has come out";
  EXPECT_EQ(scene.meetings(), 0);
}

// A rod stands through a face: it can be pulled out.
TEST(GuardBodies, WhatIsPiercedIsNotCaught) {
  ClothAndBodies scene(true, kNoGravity);
  scene.add(frame());
  btRigidBody& rod = scene.addBox(0.002, 0.05, 0.002, btVector3(btScalar(0.02), 0, btScalar(0.01)));
  makeKinematic(rod);
  scene.step(40, [&](int step) {
    rod.setWorldTransform(at(btVector3(btScalar(0.02), btScalar(0.005 * step), btScalar(0.01))));
  });
  EXPECT_GT(scene.totals().inside, 0);
  EXPECT_LT(largestStretch(scene.cloth()), 1.1);
  EXPECT_EQ(scene.totals().halts, 0);
}

// --- which bodies ---------------------------------------------------------------------------------------------------

TEST(GuardBodies, BodiesThatDoNotCollideAreNone) {
  const auto looksAt = [](const std::function<void(ClothAndBodies&, btRigidBody&)>& change) {
    ClothAndBodies scene(true);
    scene.add(levelSheet(9, 0.4, btVector3(0, btScalar(0.02), 0)));
    btRigidBody& body = scene.addBox(0.05, 0.01, 0.05, btVector3(0, 0, 0));
    change(scene, body);
    scene.step(10);
    return scene.totals().pairs > 0;
  };
  EXPECT_TRUE(looksAt([](ClothAndBodies&, btRigidBody&) {}));
  EXPECT_FALSE(looksAt([](ClothAndBodies&, btRigidBody& body) {
    body.setCollisionFlags(body.getCollisionFlags() | btCollisionObject::CF_NO_CONTACT_RESPONSE);
  }));
  EXPECT_FALSE(looksAt([](ClothAndBodies& scene, btRigidBody& body) {
    scene.scene().bullet().world().removeRigidBody(&body);
    scene.scene().bullet().world().addRigidBody(&body, 64, 64);
  }));
  EXPECT_FALSE(
      looksAt([](ClothAndBodies& scene, btRigidBody& body) { scene.cloth().setIgnoreCollisionCheck(&body, true); }));
  EXPECT_FALSE(looksAt(
      [](ClothAndBodies& scene, btRigidBody& body) { scene.cloth().m_collisionDisabledObjects.push_back(&body); }));
}

TEST(GuardBodies, BodiesComeAndGo) {
  ClothAndBodies scene(true);
  scene.add(frame());
  for (int turn = 0; turn < 3; ++turn) {
    dropNeedle(scene, 1);
    scene.step(12);
    scene.removeLastBody();
    scene.step(3);
  }
  EXPECT_EQ(scene.totals().forced, 0);
  EXPECT_TRUE(isFinite(scene.cloth()));
}

TEST(GuardBodies, AClothIsNotKeptFromWhatItIsFixedTo) {
  ClothAndBodies scene(true);
  btSoftBody& cloth = scene.add(sailPatch(9));
  btRigidBody& rod = scene.addBox(0.6, 0.01, 0.01, btVector3(btScalar(0.5), 1, 0));
  for (int k = 72; k < 81; ++k) cloth.appendAnchor(k, &rod);
  scene.step(30);
  EXPECT_TRUE(isFinite(cloth));
  EXPECT_EQ(scene.totals().halts, 0);
  EXPECT_LT(largestStretch(cloth), 1.3);
}

TEST(GuardBodies, InTheWorldOfMultibodies) {
  ClothAndBodies scene(true, kEarthGravity, WorldKind::softMultiBody);
  fall(scene, {"", 5, addSpike});
  expectNothingForced(scene);
}

TEST(GuardBodies, ALinkOfAMultibody) {
  ClothAndBodies scene(true, kEarthGravity, WorldKind::softMultiBody);
  throwDown(scene.add(levelSheet(13, 0.6, btVector3(btScalar(0.021), 0, btScalar(0.013)))), 5);
  btMultiBody multibody(0, 0, btVector3(0, 0, 0), true, false);
  multibody.setBaseWorldTransform(at(btVector3(0, btScalar(-0.33), 0)));
  multibody.finalizeMultiDof();
  const BodySurface spike = BodySurface::ofSpike(5, 0.03, 0.3);
  const auto shape = hullOf(spike);
  btMultiBodyLinkCollider link(&multibody, -1);
  link.setCollisionShape(shape.get());
  link.setWorldTransform(multibody.getBaseWorldTransform());
  multibody.setBaseCollider(&link);
  btDiscreteDynamicsWorld& world = scene.scene().bullet().world();
  world.addCollisionObject(&link);
  static_cast<btMultiBodyDynamicsWorld&>(world).addMultiBody(&multibody);
  scene.watch(link, spike);
  scene.step(30);
  expectNothingForced(scene);
  EXPECT_GT(scene.totals().pairs, 0);
  static_cast<btMultiBodyDynamicsWorld&>(world).removeMultiBody(&multibody);
  world.removeCollisionObject(&link);
}

TEST(GuardBodies, OneKilometreFromTheOrigin) {
  for (const bool isGuarded : {true, false}) {
    ClothAndBodies scene(isGuarded);
    const btVector3 there(1000, 0, 1000);
    throwDown(scene.add(levelSheet(13, 0.6, there + btVector3(btScalar(0.021), 0, btScalar(0.013)))), 2);
    const BodySurface spike = BodySurface::ofSpike(5, 0.03, 0.3);
    scene.add(hullOf(spike), spike, there + btVector3(0, btScalar(-0.33), 0));
    scene.step(30);
    if (isGuarded) {
      expectNothingForced(scene);
    } else {
      EXPECT_GT(scene.passages(), 0);
    }
  }
}

// A needle falls on a cloth.
struct Saved {
  Saved() : scene(true) {
    scene.add(frame());
    dropNeedle(scene, 3);
    wet = std::make_unique<wetcloth::WetClothWorld>(scene.scene().bullet().world());
  }
  std::string state() const {
    std::ostringstream stream;
    wet->save(stream);
    return stream.str();
  }
  ClothAndBodies scene;
  std::unique_ptr<wetcloth::WetClothWorld> wet;
};

TEST(GuardBodies, ARestoredRunGoesOnBitForBit) {
  Saved first;
  first.scene.step(4);
  const std::string saved = first.state();
  first.scene.step(10);
  Saved second;
  std::istringstream stream(saved);
  second.wet->restore(stream);
  EXPECT_EQ(second.state(), saved);
  second.scene.step(10);
  EXPECT_TRUE(sameBits(stateOf(first.scene.cloth()), stateOf(second.scene.cloth())));
  EXPECT_GT(first.scene.totals().pairs, 0);
}

// Nothing of a body that is not finite is taken.
TEST(GuardBodies, ABodyThatIsNotFinite) {
  ClothAndBodies scene(true);
  scene.add(levelSheet(9, 0.4, btVector3(0, btScalar(0.02), 0)));
  scene.addBox(0.05, 0.01, 0.05, btVector3(0, 0, 0));
  btRigidBody& bad = scene.addBox(0.05, 0.01, 0.05, btVector3(btScalar(0.1), btScalar(-0.1), 0));
  scene.step(2);
  bad.getWorldTransform().getOrigin().setX(std::numeric_limits<btScalar>::quiet_NaN());
  scene.step(5);
  EXPECT_TRUE(isFinite(scene.cloth()));
}

}  // namespace
}  // namespace wetcloth_test::guard_bodies_test
