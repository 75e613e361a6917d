// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/solver/ClothSolver.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/Patches.h"
#include "tests/support/SoftBodies.h"

#include <memory>
#include <string>
#include <vector>

namespace wetcloth_test {

/// A world whose cloths ClothSolver steps.
class SolverScene {
 public:
  explicit SolverScene(WorldKind kind = WorldKind::softRigid, const btVector3& gravity = kEarthGravity,
                       const wetcloth::ClothSolver::Parameters& parameters = {})
      : m_solver(parameters), m_bullet(kind, gravity, &m_solver) {
    m_solver.setLog([this](const std::string& message) { m_messages.push_back(message); });
  }
  ~SolverScene() {
    for (const auto& body : m_bodies) m_bullet.remove(*body);
  }
  SolverScene(const SolverScene&) = delete;
  SolverScene& operator=(const SolverScene&) = delete;

  btSoftBody& add(const BodyBuilder& builder) {
    m_bodies.push_back(builder(m_bullet.info()));
    m_bullet.add(*m_bodies.back());
    return *m_bodies.back();
  }
  btSoftBody& add(const wetcloth::ClothPatch& patch) {
    return add([&](btSoftBodyWorldInfo& info) { return patch.build(info); });
  }
  void removeLast() {
    m_bullet.remove(*m_bodies.back());
    m_bodies.pop_back();
  }
  void step(int count, double dt = 1.0 / 60) { m_bullet.step(count, btScalar(dt)); }

  wetcloth::ClothSolver& solver() { return m_solver; }
  BulletWorld& bullet() { return m_bullet; }
  const std::vector<std::string>& messages() const { return m_messages; }

 private:
  wetcloth::ClothSolver m_solver;
  BulletWorld m_bullet;
  std::vector<std::unique_ptr<btSoftBody>> m_bodies;
  std::vector<std::string> m_messages;
};

inline wetcloth::ClothSolver::Parameters smallSteps(int count, double stiffness = HUGE_VAL) {
  wetcloth::ClothSolver::Parameters parameters;
  parameters.smallSteps = count;
  parameters.stiffness = stiffness;
  return parameters;
}

}  // namespace wetcloth_test
