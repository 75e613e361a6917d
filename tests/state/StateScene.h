// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/bullet/Contacts.h"
#include "bullet_wetcloth/bullet_wetcloth.h"
#include "tests/support/BodyState.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/ClothScene.h"
#include "tests/support/ContactScene.h"
#include "tests/support/Patches.h"
#include "tests/support/RigidBody.h"

#include <BulletCollision/CollisionShapes/btTriangleMesh.h>

#include <cstring>
#include <memory>
#include <ostream>
#include <sstream>
#include <string>
#include <vector>

namespace wetcloth_test::state_scene {

enum class Story { hanging, onRigid, onPile, clothOnCloth, sleeping };

inline std::ostream& operator<<(std::ostream& out, Story story) {
  const char* const names[] = {"hanging", "onRigid", "onPile", "clothOnCloth", "sleeping"};
  return out << names[static_cast<int>(story)];
}

struct Case {
  WorldKind kind;
  Story story;
};

/// A world that is built in the same way each time, with every effect that its cloths can have.
class StateScene {
 public:
  explicit StateScene(const Case& what)
      : m_bullet(what.kind, what.story == Story::sleeping ? btVector3(0, 0, 0) : kEarthGravity),
        m_isDeformable(m_bullet.isDeformable()) {
    m_wet = std::make_unique<wetcloth::WetClothWorld>(m_bullet.world());
    m_wet->setLog(nullptr);
    switch (what.story) {
      case Story::hanging: buildHanging(); break;
      case Story::onRigid: buildOnRigid(); break;
      case Story::onPile: buildOnPile(); break;
      case Story::clothOnCloth: buildClothOnCloth(); break;
      case Story::sleeping: buildSleeping(); break;
    }
  }
  ~StateScene() {
    m_wet.reset();
    for (const auto& body : m_bodies) m_bullet.remove(*body);
  }
  StateScene(const StateScene&) = delete;
  StateScene& operator=(const StateScene&) = delete;

  wetcloth::WetClothWorld& wet() { return *m_wet; }
  wetcloth::WetCloth& cloth() { return m_wet->cloths()[0]; }
  BulletWorld& bullet() { return m_bullet; }
  btRigidBody& ball() { return m_rigid.back()->body(); }

  /// As an application that draws at 60 Hz: some of Bullet's clock is left over after each call.
  void step(int count) {
    for (int i = 0; i < count; ++i) m_bullet.world().stepSimulation(btScalar(0.01), 5, btScalar(1) / 240);
  }

  std::string saved() const {
    std::ostringstream stream;
    m_wet->save(stream);
    return stream.str();
  }
  void restore(const std::string& state) {
    std::istringstream stream(state);
    m_wet->restore(stream);
  }

  /// Motion and water, the numbers themselves.
  std::vector<double> look() const {
    std::vector<double> numbers;
    for (const auto& body : m_bodies) {
      for (const btScalar number : stateOf(*body)) numbers.push_back(double(number));
    }
    for (const auto& rigid : m_rigid) {
      const btTransform& frame = rigid->body().getWorldTransform();
      const btVector3 vectors[] = {frame.getOrigin(), frame.getBasis()[0], frame.getBasis()[1],
                                   rigid->body().getLinearVelocity(), rigid->body().getAngularVelocity()};
      for (const btVector3& vector : vectors) {
        for (int axis = 0; axis < 3; ++axis) numbers.push_back(double(vector[axis]));
      }
    }
    for (const wetcloth::WetCloth& cloth : m_wet->cloths()) {
      for (int i = 0; i < cloth.nodeCount(); ++i) numbers.push_back(cloth.held(i));
      const wetcloth::Ledger ledger = cloth.ledger();
      for (const double number : {ledger.absorbed, ledger.dripped, ledger.evaporated, ledger.runOff}) {
        numbers.push_back(number);
      }
    }
    return numbers;
  }

 private:
  wetcloth::WetCloth& add(const wetcloth::ClothPatch& patch) {
    m_bodies.push_back(patch.build(m_bullet.info()));
    btSoftBody& body = *m_bodies.back();
    body.m_cfg.collisions = contactFlags(m_bullet.kind());
    body.m_cfg.piterations = 3;
    body.m_cfg.kDF = btScalar(0.4);
    body.getCollisionShape()->setMargin(btScalar(kMargin));
    m_bullet.add(body);
    return m_wet->add(body);
  }
  void addBulletSprings() {
    if (!m_isDeformable) return;
    m_bullet.addForce(*m_bodies.back(), bulletSprings(20, 0.05));
  }
  void addRigid(std::unique_ptr<btCollisionShape> shape, double mass, const btVector3& position) {
    m_rigid.push_back(std::make_unique<RigidBody>(m_bullet, std::move(shape), btScalar(mass), position));
  }

  // A towel in the rain and the wind over a pool, with everything that does not need a contact.
  void buildHanging() {
    m_bullet.info().water_normal = btVector3(0, 1, 0);
    m_bullet.info().water_offset = btScalar(-0.2);
    m_bullet.info().water_density = 1000;
    wetcloth::ClothPatch patch = hangingPatch(6);
    wetcloth::WetCloth& cloth = add(patch);
    wetcloth::Absorption::Parameters absorption;
    absorption.exposure =
        wetcloth::Exposure([](const btVector3& x, const btVector3&) { return x.x() > 0.5 ? 0.2 : 0; });
    cloth.add<wetcloth::Absorption>(absorption);
    cloth.add<wetcloth::Immersion>();
    cloth.add<wetcloth::Rain>({btVector3(0.2f, -1, 0.1f), 0.02, 5, true});
    cloth.add<wetcloth::Splash>({wetcloth::Splash::Cone{btVector3(0.5f, 0.5f, 1), 0.4, 2}, btVector3(0, 0, -3), 0.05});
    cloth.add<wetcloth::Diffusion>();
    cloth.add<wetcloth::Seepage>({2e-3, 3});
    cloth.add<wetcloth::Dripping>({0.02, 1, 1e-6, 0.02, 0.5, nullptr});
    wetcloth::Drying::Parameters drying;
    drying.air = btVector3(2, 0, 0);
    cloth.add<wetcloth::Drying>(drying);
    cloth.add<wetcloth::HookeSprings>({80, 2, {}, 5});
    cloth.add<wetcloth::WetStiffness>({0.7, 0.5, 2, 5});
    cloth.add<wetcloth::Swelling>();
    cloth.add<wetcloth::Wind>({wetcloth::WindField([](const btVector3& x, double time) {
      return btVector3(btScalar(std::sin(5 * time)), 0, btScalar(4 + std::cos(3 * double(x.y()))));
    })});
    cloth.add<wetcloth::WaterDrag>();
    cloth.add<wetcloth::CollisionAudit>();
  }

  // A cloth falls over a wet sphere, and a ball onto the cloth.
  void buildOnRigid() {
    wetcloth::ClothPatch patch = squarePatch(9);
    patch.origin = btVector3(0, btScalar(0.3), 0);
    wetcloth::WetCloth& cloth = add(patch);
    addBulletSprings();
    addRigid(std::make_unique<btSphereShape>(btScalar(0.25)), 0, btVector3(btScalar(0.55), 0, btScalar(0.5)));
    addRigid(std::make_unique<btSphereShape>(btScalar(0.1)), 0.05, btVector3(btScalar(0.4), btScalar(0.45), 0.5));
    cloth.add<wetcloth::Absorption>();
    wetcloth::ContactWetting::Parameters wetting;
    wetting.wetBodies = {{&m_rigid[0]->body(), 0.02}};
    cloth.add<wetcloth::ContactWetting>(wetting);
    cloth.add<wetcloth::Diffusion>();
    cloth.add<wetcloth::Wind>({btVector3(0, 0, 0)});
    cloth.add<wetcloth::Cling>();
    cloth.add<wetcloth::WetFriction>();
  }

  // A cloth falls over rigid bodies that lie on each other, each pair of shapes with contacts of its own kind: boxes,
  // a lying roller, a dumbbell of two balls, a slope of triangles, and a ball that is fast enough for Bullet to predict
  // where it hits.
  void buildOnPile() {
    wetcloth::ClothPatch patch = squarePatch(7);
    patch.origin = btVector3(btScalar(-0.5), btScalar(0.5), btScalar(-0.5));
    add(patch).add<wetcloth::Absorption>();
    addBulletSprings();
    addRigid(std::make_unique<btBoxShape>(btVector3(2, btScalar(0.1), 2)), 0, btVector3(0, btScalar(-0.1), 0));
    for (int i = 0; i < 3; ++i) {
      addRigid(std::make_unique<btBoxShape>(btVector3(btScalar(0.1), btScalar(0.05), btScalar(0.1))), 0.2 + 0.3 * i,
               btVector3(btScalar(0.02 * i), btScalar(0.051 + 0.101 * i), 0));
    }
    addRigid(std::make_unique<btCylinderShapeZ>(btVector3(btScalar(0.06), btScalar(0.06), btScalar(0.1))), 0.3,
             btVector3(btScalar(0.3), btScalar(0.07), 0));
    auto dumbbell = std::make_unique<btCompoundShape>();
    for (const double side : {-0.1, 0.1}) {
      dumbbell->addChildShape(btTransform(btQuaternion::getIdentity(), btVector3(btScalar(side), 0, 0)), &m_end);
    }
    addRigid(std::move(dumbbell), 0.4, btVector3(btScalar(0.03), btScalar(0.4), btScalar(0.02)));
    m_triangles.addTriangle(btVector3(-1, 0, -1), btVector3(-1, 0, 1), btVector3(-1, 1, 0));
    m_triangles.addTriangle(btVector3(-1, 1, -1), btVector3(-1, 1, 1), btVector3(btScalar(-0.2), 0, 0));
    addRigid(std::make_unique<btBvhTriangleMeshShape>(&m_triangles, true), 0, btVector3(0, 0, 0));
    addRigid(std::make_unique<btSphereShape>(btScalar(0.04)), 0.05, btVector3(btScalar(-0.6), btScalar(0.6), 0));
    ball().setCcdMotionThreshold(btScalar(0.01));
    ball().setCcdSweptSphereRadius(btScalar(0.03));
    ball().setLinearVelocity(btVector3(6, -6, 0));
  }

  // A wet cloth falls onto a dry one that is held at its corners.
  void buildClothOnCloth() {
    wetcloth::ClothPatch lower = squarePatch(7);
    wetcloth::ClothPatch upper = levelPatch(6, 0.5);
    upper.origin = btVector3(btScalar(0.23), btScalar(0.06), btScalar(0.27));
    add(lower);
    addBulletSprings();
    for (const int corner : {0, 6, 42, 48}) m_bodies[0]->setMass(corner, 0);
    wetcloth::WetCloth& cloth = add(upper);
    addBulletSprings();
    cloth.setSaturation(0.8);
    wetcloth::ContactWetting::Parameters wetting;
    wetting.cloths = true;
    cloth.add<wetcloth::ContactWetting>(wetting);
    cloth.add<wetcloth::WetFriction>();
    cloth.add<wetcloth::CollisionAudit>();
    this->cloth().add<wetcloth::Swelling>();
  }

  // A wet cloth dries without gravity: Bullet's deformable world puts it to sleep after two seconds, and it wakes when
  // it weighs less.
  void buildSleeping() {
    wetcloth::WetCloth& cloth = add(levelPatch(3, 0.2));
    addBulletSprings();
    cloth.setSaturation(0.5);
    wetcloth::Drying::Parameters drying;
    drying.air = btVector3(5, 0, 0);
    drying.relativeHumidity = 0.1;
    cloth.add<wetcloth::Drying>(drying);
    cloth.add<wetcloth::Diffusion>();
  }

  BulletWorld m_bullet;
  bool m_isDeformable;
  btSphereShape m_end{btScalar(0.05)};  // of the dumbbell
  btTriangleMesh m_triangles;
  std::vector<std::unique_ptr<RigidBody>> m_rigid;
  std::vector<std::unique_ptr<btSoftBody>> m_bodies;
  std::unique_ptr<wetcloth::WetClothWorld> m_wet;
};

inline bool sameNumbers(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

/// What restoring this state into the scene says, "" when it succeeds.
inline std::string refusal(StateScene& scene, const std::string& state) {
  try {
    scene.restore(state);
  } catch (const wetcloth::StateError& error) {
    return error.what();
  }
  return "";
}

}  // namespace wetcloth_test::state_scene
