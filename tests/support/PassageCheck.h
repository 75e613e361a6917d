// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/collision/ContinuousCheck.h"
#include "bullet_wetcloth/solver/ClothSolver.h"

#include <BulletSoftBody/btSoftBody.h>

#include <algorithm>
#include <array>
#include <deque>
#include <functional>
#include <set>
#include <utility>
#include <vector>

namespace wetcloth_test {

using Place = std::array<double, 3>;

/// Vertices, edges and faces; parts that share a node are no pair.
struct PassageMesh {
  std::vector<int> vertices;
  std::vector<std::array<int, 2>> edges;
  std::vector<std::array<int, 3>> faces;
};

/// Two parts that may meet: a vertex and a face, or two edges.
struct PassagePair {
  wetcloth::collision::Pair kind;
  std::array<int, 4> node;
};

/// All pairs whose parts come as near as `near` on each axis while nodes move from one place to the other: all there
/// are in a mesh, or nearly so.
std::vector<PassagePair> pairsThatComeNear(const PassageMesh& mesh, const std::vector<Place>& from,
                                           const std::vector<Place>& to, double near = 0);

/// How many pairs meet while nodes move on straight lines. Exact, where the library has the exact check; otherwise it
/// never misses one.
/// @param isWanted  of which pairs; empty: of all
int countPassages(const PassageMesh& mesh, const std::vector<Place>& from, const std::vector<Place>& to,
                  const std::function<bool(const PassagePair&)>& isWanted = {});

/// Watches cloths from small step to small step, as ClothSolver shows them, and counts what meets.
class PassageCheck {
 public:
  /// In the order of their nodes. A body that only has faces needs no links. They outlive this, or are forgotten.
  explicit PassageCheck(std::vector<const btSoftBody*> bodies);

  /// For ClothSolver::setSmallStepCallback().
  void see(const wetcloth::ClothSolver::SmallStepView& view);
  /// Sees all small steps of this solver from now on; only one check does.
  void watch(wetcloth::ClothSolver& solver) {
    solver.setSmallStepCallback([this](const wetcloth::ClothSolver::SmallStepView& view) { see(view); });
  }

  /// Of all small steps so far, until there are more than `kMany`; those of pairs that meet in several count several
  /// times. What is asked is whether there is one, or many: to judge all of a tangle exactly takes longer than its
  /// steps.
  long long passages() const { return m_passages; }
  static constexpr long long kMany = 1000;
  /// How many pairs meet where the nodes are now.
  int meetings() const { return countPassages(m_mesh, m_places, m_places); }
  int smallSteps() const { return m_smallSteps; }
  const std::vector<Place>& places() const { return m_places; }

 private:
  void finish();

  std::vector<const btSoftBody*> m_bodies;
  std::vector<std::deque<std::vector<Place>>> m_seen;  // of each body: small steps that another one has not yet shown
  PassageMesh m_mesh;
  std::vector<Place> m_places;
  long long m_passages = 0;
  int m_smallSteps = 0;
};

inline int numberOf(const btSoftBody& body, const btSoftBody::Node* node) { return int(node - &body.m_nodes[0]); }

inline PassageCheck::PassageCheck(std::vector<const btSoftBody*> bodies)
    : m_bodies(std::move(bodies)), m_seen(m_bodies.size()) {
  std::set<std::pair<int, int>> edges;
  for (const btSoftBody* body : m_bodies) {
    const int first = int(m_places.size());
    std::set<int> vertices;
    for (int k = 0; k < body->m_nodes.size(); ++k) {
      const btVector3& x = body->m_nodes[k].m_x;
      m_places.push_back({double(x[0]), double(x[1]), double(x[2])});
    }
    for (int k = 0; k < body->m_faces.size(); ++k) {
      std::array<int, 3> face;
      for (int i = 0; i < 3; ++i) face[std::size_t(i)] = first + numberOf(*body, body->m_faces[k].m_n[i]);
      m_mesh.faces.push_back(face);
      for (std::size_t i = 0; i < 3; ++i) edges.insert(std::minmax(face[i], face[(i + 1) % 3]));
      vertices.insert(face.begin(), face.end());
    }
    m_mesh.vertices.insert(m_mesh.vertices.end(), vertices.begin(), vertices.end());
  }
  for (const auto& edge : edges) m_mesh.edges.push_back({edge.first, edge.second});
}

inline void PassageCheck::see(const wetcloth::ClothSolver::SmallStepView& view) {
  for (std::size_t which = 0; which < m_bodies.size(); ++which) {
    if (m_bodies[which] != &view.body) continue;
    std::vector<Place> places(std::size_t(view.body.m_nodes.size()));
    for (std::size_t k = 0; k < places.size(); ++k) {
      for (int axis = 0; axis < 3; ++axis) {
        places[k][std::size_t(axis)] = double(view.x[axis][view.slots[k]]) + double(view.origin[axis]);
      }
    }
    m_seen[which].push_back(std::move(places));
  }
  for (const auto& seen : m_seen) {
    if (seen.empty()) return;
  }
  finish();
}

inline void PassageCheck::finish() {
  std::vector<Place> places;
  for (auto& seen : m_seen) {
    places.insert(places.end(), seen.front().begin(), seen.front().end());
    seen.pop_front();
  }
  if (m_passages <= kMany) m_passages += countPassages(m_mesh, m_places, places);
  m_places = std::move(places);
  ++m_smallSteps;
}

}  // namespace wetcloth_test
