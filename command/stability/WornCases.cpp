// SPDX-License-Identifier: Zlib
#include "command/stability/CaseParts.h"
#include "command/stability/Cases.h"
#include "command/stability/GuardedCase.h"

#include "command/scene/MeshBody.h"

#include <BulletCollision/CollisionShapes/btCapsuleShape.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

// A tunic on a body that moves: two upright capsules side by side are its trunk, a third one its neck.
namespace stability {
namespace {

constexpr double kTrunk = 0.12;     // radius [m]
constexpr double kSide = 0.09;      // of the trunk's axes, each from the middle [m]
constexpr double kShoulders = 0.5;  // height of the upper ends of these axes [m]
constexpr double kRoom = 0.06;      // between trunk and cloth [m]
constexpr double kPress = 2;        // what is pressed or bent is let go after so long [s]

/// From 0 to 1 in the first second and back in the last one of 3 s, softly.
double thereAndBack(double time) {
  const double share = std::clamp(std::min(time, kPress + 1 - time), 0., 1.);
  return (1 - std::cos(kPi * share)) / 2;
}
constexpr double kFastest = kPi / 2;  // that it changes [1/s]

/// A piece of the body, and where it is at a time.
struct Limb {
  double radius;
  double length;  ///< of its axis [m]
  std::function<btTransform(double time)> place;
};

/// A tube round the trunk, drawn in over the shoulders to a neck that a head goes through.
command::TriangleMesh tunic() {
  constexpr int columns = 18;
  // How far the cloth is outside the trunk's axes, and how high.
  const std::vector<std::array<double, 2>> rows{{0.05, 0.71},           {0.11, 0.68},           {0.16, 0.62},
                                                {kTrunk + kRoom, 0.54}, {kTrunk + kRoom, 0.45}, {kTrunk + kRoom, 0.36},
                                                {kTrunk + kRoom, 0.27}, {kTrunk + kRoom, 0.18}, {kTrunk + kRoom, 0.09},
                                                {kTrunk + kRoom, 0}};
  command::TriangleMesh mesh;
  for (const auto& [out, height] : rows) {
    for (int i = 0; i < columns; ++i) {
      const double angle = 2 * kPi * (i + 0.5) / columns;
      const double side = std::copysign(kSide * std::min(1., out / 0.1), std::cos(angle));
      mesh.vertices.emplace_back(btScalar(side + out * std::cos(angle)), btScalar(height),
                                 btScalar(out * std::sin(angle)));
    }
  }
  for (int j = 0; j + 1 < static_cast<int>(rows.size()); ++j) {
    for (int i = 0; i < columns; ++i) {
      const int a = j * columns + i, b = j * columns + (i + 1) % columns, c = a + columns, d = b + columns;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
  }
  return mesh;
}

btTransform standing(double x, double y) {
  return btTransform(btQuaternion::getIdentity(), btVector3(btScalar(x), btScalar(y), 0));
}

Limb trunk(double side, std::function<btTransform(double)> moved) {
  return {kTrunk, kShoulders,
          [side, moved = std::move(moved)](double time) { return moved(time) * standing(side, kShoulders / 2); }};
}

/// What moves, and the deepest that a node was in it, of its radius.
class Wearer {
 public:
  Wearer(CaseScene& scene, btSoftBody& cloth, std::vector<Limb> limbs)
      : m_scene(scene), m_cloth(cloth), m_limbs(std::move(limbs)) {
    for (const Limb& limb : m_limbs) {
      auto shape = std::make_unique<btCapsuleShape>(btScalar(limb.radius), btScalar(limb.length));
      btRigidBody& body = scene.addRigid(std::move(shape), 0, limb.place(0).getOrigin());
      body.setWorldTransform(limb.place(0));
      body.setInterpolationWorldTransform(limb.place(0));
      m_bodies.push_back(&body);
    }
  }

  void beforeStep() const {
    for (std::size_t i = 0; i < m_limbs.size(); ++i) {
      const btTransform next = m_limbs[i].place(m_scene.time() + m_scene.dt());
      moveKinematic(*m_bodies[i], next.getOrigin(), next.getRotation(), m_scene.dt());
    }
  }
  void afterStep(CaseMeter& meter) const {
    double deepest = 0;
    for (const Limb& limb : m_limbs) {
      const btTransform inverse = limb.place(m_scene.time()).inverse();
      const btScalar half = btScalar(limb.length / 2);
      for (int k = 0; k < m_cloth.m_nodes.size(); ++k) {
        btVector3 p = inverse * m_cloth.m_nodes[k].m_x;
        p.setY(p.y() - std::clamp(p.y(), -half, half));
        deepest = std::max(deepest, 1 - static_cast<double>(p.length()) / limb.radius);
      }
    }
    // The guard has a polyhedron of 42 corners for a ball, whose faces are up to 8 % of the radius inside.
    meter.compare("in the body", deepest, 0.1);
  }

 private:
  CaseScene& m_scene;
  btSoftBody& m_cloth;
  std::vector<Limb> m_limbs;
  std::vector<btRigidBody*> m_bodies;
};

HardCase worn(std::string name, std::string about, double fastest, std::vector<Limb> limbs) {
  wetcloth::ClothSolver::Guard guard;
  guard.bodies = true;
  HardCase hardCase =
      guarded(std::move(name), std::move(about), guard, [fastest, limbs = std::move(limbs)](CaseScene& scene) {
        btSoftBody& cloth = addCloth(scene, command::makeMeshBody(tunic(), 0.15, scene.worldInfo()));
        cloth.m_cfg.kKHR = 1;
        std::vector<Limb> all = limbs;
        all.push_back({0.04, 0.4, [](double) { return standing(0, 0.6); }});  // the neck
        const auto wearer = std::make_shared<Wearer>(scene, cloth, std::move(all));
        scene.limits.source = fastest;
        scene.limits.drop = 0.7;
        Script script;
        script.before = [wearer] { wearer->beforeStep(); };
        script.observe = [wearer](CaseMeter& meter) { wearer->afterStep(meter); };
        return script;
      });
  hardCase.group = "worn";
  hardCase.duration = 3.5;
  hardCase.quickDuration = 1.5;
  hardCase.stepSizes = {1. / 240, 1. / 60};
  return hardCase;
}

HardCase turnsFast() {
  constexpr double most = kPi;  // there and back in 2 s
  const auto turned = [](double time) {
    return btTransform(btQuaternion(btVector3(0, 1, 0), btScalar(most * std::sin(kPi * time))));
  };
  return worn("worn_turns_fast", "who wears a tunic turns half round and back, twice in 3 s", most * kPi * 0.27,
              {trunk(-kSide, turned), trunk(kSide, turned)});
}

btTransform stays(double) { return btTransform::getIdentity(); }

HardCase crouches() {
  std::vector<Limb> limbs{trunk(-kSide, stays), trunk(kSide, stays)};
  for (const double side : {-kSide, kSide}) {
    limbs.push_back({0.07, 0.4, [side](double time) {
                       const btQuaternion bent(btVector3(1, 0, 0), btScalar(-1.9 * thereAndBack(time)));
                       return standing(side, 0) * btTransform(bent) * standing(0, -0.2);
                     }});
  }
  return worn("worn_crouches", "thighs come up above level and go down, with the cloth in the fold",
              1.9 * kFastest * 0.47, std::move(limbs));
}

HardCase armsPressed() {
  std::vector<Limb> limbs{trunk(-kSide, stays), trunk(kSide, stays)};
  for (const double side : {-1., 1.}) {
    limbs.push_back({0.05, 0.35, [side](double time) {
                       const double pressed = kSide + kTrunk + 0.05 + 0.015;  // room for cloth
                       return standing(side * (pressed + 0.25 * (1 - thereAndBack(time))), 0.25);
                     }});
  }
  return worn("worn_arms_pressed", "arms press the cloth to the sides and let it go", 0.25 * kFastest,
              std::move(limbs));
}

/// 1.56 m go round trunk and belly, and 1.49 m round the tunic.
HardCase tooSmall() {
  std::vector<Limb> limbs{trunk(-kSide, stays), trunk(kSide, stays)};
  limbs.push_back({kTrunk, 0.1, [](double time) {
                     return btTransform(btQuaternion::getIdentity(),
                                        btVector3(0, btScalar(0.15), btScalar(0.3 * thereAndBack(time))));
                   }});
  return worn("worn_too_small", "a belly grows until the tunic is a twentieth too small, and goes again",
              0.3 * kFastest, std::move(limbs));
}

}  // namespace

std::vector<HardCase> wornCases() { return {turnsFast(), crouches(), armsPressed(), tooSmall()}; }

}  // namespace stability
