// SPDX-License-Identifier: Zlib
#pragma once

#include "tests/solver/SolverScene.h"
#include "tests/support/BodyState.h"
#include "tests/support/Measures.h"
#include "tests/support/PassageCheck.h"
#include "tests/support/RigidBody.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace wetcloth_test {

using Guard = wetcloth::ClothSolver::Guard;

inline wetcloth::ClothSolver::Parameters guardedBy(std::optional<Guard> guard) {
  wetcloth::ClothSolver::Parameters parameters;
  parameters.guard = guard;
  return parameters;
}

/// Cloths that ClothSolver steps, with the guard or without, and an exact check of what they pass through.
class GuardScene {
 public:
  explicit GuardScene(std::optional<Guard> guard = Guard(), WorldKind kind = WorldKind::softRigid,
                      const btVector3& gravity = kEarthGravity)
      : m_scene(kind, gravity, guardedBy(guard)) {}

  template <class Source>
  btSoftBody& add(const Source& source) {
    btSoftBody& body = m_scene.add(source);
    body.getCollisionShape()->setMargin(btScalar(0.01));
    body.m_cfg.kDF = btScalar(0.5);
    body.m_cfg.kDP = btScalar(0.002);
    m_bodies.push_back(&body);
    return body;
  }
  /// Its top is at this height.
  void addFloor(double height = 0, double x = 0) {
    m_floor = std::make_unique<RigidBody>(m_scene.bullet(), box(3, 1, 3), btScalar(0),
                                          btVector3(btScalar(x), btScalar(height - 1), 0));
  }
  /// The cloths that are there, from now on.
  PassageCheck& watch() {
    m_check = std::make_unique<PassageCheck>(m_bodies);
    m_check->watch(m_scene.solver());
    return *m_check;
  }
  void forgetLast() {
    m_scene.removeLast();
    m_bodies.pop_back();
  }
  void step(int count) { m_scene.step(count); }

  long long passages() const { return m_check->passages(); }
  wetcloth::ClothSolver::GuardTotals totals() { return m_scene.solver().guardTotals(); }
  wetcloth::ClothSolver& solver() { return m_scene.solver(); }
  SolverScene& scene() { return m_scene; }

 private:
  SolverScene m_scene;
  std::unique_ptr<RigidBody> m_floor;
  std::vector<const btSoftBody*> m_bodies;
  std::unique_ptr<PassageCheck> m_check;
};

inline double largestStretch(const btSoftBody& body) {
  double largest = 0;
  for (int k = 0; k < body.m_links.size(); ++k) {
    const btSoftBody::Link& link = body.m_links[k];
    largest = std::max(largest, double((link.m_n[0]->m_x - link.m_n[1]->m_x).length() / link.m_rl));
  }
  return largest;
}

inline double rmsSpeed(const btSoftBody& body) {
  double sum = 0;
  for (int k = 0; k < body.m_nodes.size(); ++k) sum += double(body.m_nodes[k].m_v.length2());
  return std::sqrt(sum / body.m_nodes.size());
}

/// A sheet of n x n nodes, upright in waves above this place, so that it falls into folds.
inline BodyBuilder wavySheet(int n, double side = 1, const btVector3& place = btVector3(0, btScalar(0.05), 0)) {
  return [=](btSoftBodyWorldInfo& info) {
    wetcloth::ClothPatch patch = squarePatch(n);
    patch.origin = place - btVector3(btScalar(side / 2), 0, 0);
    patch.edgeU = btVector3(btScalar(side), 0, 0);
    patch.edgeV = btVector3(0, btScalar(side), 0);
    std::unique_ptr<btSoftBody> body = patch.build(info);
    for (int k = 0; k < body->m_nodes.size(); ++k) {
      btVector3& x = body->m_nodes[k].m_x;
      const btVector3 along = (x - place) / btScalar(side);
      x.setZ(x.z() + btScalar(0.03 * side * std::sin(15 * double(along.y()) + 2 * double(along.x()))));
      body->m_nodes[k].m_q = x;
    }
    return body;
  };
}

/// Level, its middle at this place.
inline wetcloth::ClothPatch levelSheet(int n, double side, const btVector3& middle) {
  wetcloth::ClothPatch patch = levelPatch(n, side);
  patch.origin += middle;
  return patch;
}

/// A mesh of triangles with a link along each edge.
inline BodyBuilder linkedTriangles(const std::vector<btVector3>& places, const std::vector<std::array<int, 3>>& faces,
                                   double mass = 0.001) {
  return [=](btSoftBodyWorldInfo& info) {
    const std::vector<btScalar> masses(places.size(), btScalar(mass));
    std::unique_ptr<btSoftBody> body = triangles(places, masses, faces)(info);
    std::set<std::pair<int, int>> edges;
    for (const auto& face : faces) {
      for (std::size_t k = 0; k < 3; ++k) edges.insert(std::minmax(face[k], face[(k + 1) % 3]));
    }
    for (const auto& edge : edges) body->appendLink(edge.first, edge.second);
    return body;
  };
}

/// The places and triangles of an n x n sheet, to be changed.
struct Triangles {
  std::vector<btVector3> places;
  std::vector<std::array<int, 3>> faces;

  static Triangles of(const wetcloth::ClothPatch& patch) {
    Triangles mesh;
    for (int j = 0; j < patch.rows; ++j) {
      for (int i = 0; i < patch.columns; ++i) {
        mesh.places.push_back(patch.origin + patch.edgeU * (btScalar(i) / btScalar(patch.columns - 1)) +
                              patch.edgeV * (btScalar(j) / btScalar(patch.rows - 1)));
        if (i + 1 == patch.columns || j + 1 == patch.rows) continue;
        const int corner = patch.node(i, j);
        const int above = corner + patch.columns;
        mesh.faces.push_back({corner, corner + 1, above + 1});
        mesh.faces.push_back({corner, above + 1, above});
      }
    }
    return mesh;
  }
  /// The same, with its nodes numbered in another order, in which there are no rows.
  Triangles shuffled(std::mt19937& random) const {
    std::vector<int> numbers(places.size());
    for (std::size_t k = 0; k < numbers.size(); ++k) numbers[k] = int(k);
    std::shuffle(numbers.begin(), numbers.end(), random);
    Triangles other = *this;
    for (std::size_t k = 0; k < numbers.size(); ++k) other.places[std::size_t(numbers[k])] = places[k];
    for (auto& face : other.faces) {
      for (int& node : face) node = numbers[std::size_t(node)];
    }
    return other;
  }
  BodyBuilder builder() const { return linkedTriangles(places, faces); }
};

}  // namespace wetcloth_test
