// SPDX-License-Identifier: Zlib
#pragma once

#include "tests/solver/GuardScene.h"

#include <BulletCollision/CollisionShapes/btConvexHullShape.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace wetcloth_test {

/// The surface of a body as a test knows it, in the body's frame.
struct BodySurface {
  std::vector<btVector3> corners;
  std::vector<std::array<int, 2>> edges;
  std::vector<std::array<int, 3>> faces;

  static BodySurface ofBox(double x, double y, double z) {
    BodySurface result;
    for (int k = 0; k < 8; ++k) {
      result.corners.emplace_back(btScalar(k & 1 ? x : -x), btScalar(k & 2 ? y : -y), btScalar(k & 4 ? z : -z));
      for (const int bit : {1, 2, 4}) {
        if ((k & bit) == 0) result.edges.push_back({k, k | bit});
      }
    }
    result.faces = {{0, 1, 3}, {0, 3, 2}, {4, 6, 7}, {4, 7, 5}, {0, 4, 5}, {0, 5, 1},
                    {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 5, 7}, {1, 7, 3}};
    return result;
  }
  /// All sides of the triangles are edges.
  static BodySurface ofTriangles(std::vector<btVector3> corners, std::vector<std::array<int, 3>> faces) {
    BodySurface result;
    std::set<std::pair<int, int>> edges;
    for (const auto& face : faces) {
      for (std::size_t k = 0; k < 3; ++k) edges.insert(std::minmax(face[k], face[(k + 1) % 3]));
    }
    for (const auto& edge : edges) result.edges.push_back({edge.first, edge.second});
    result.corners = std::move(corners);
    result.faces = std::move(faces);
    return result;
  }
  /// A pyramid of n sides whose tip is at the origin's height of `height`, its foot at 0.
  static BodySurface ofSpike(int n, double radius, double height) {
    std::vector<btVector3> corners = {btVector3(0, btScalar(height), 0)};
    std::vector<std::array<int, 3>> faces;
    for (int k = 0; k < n; ++k) {
      const double angle = 2 * 3.14159265358979 * k / n;
      corners.emplace_back(btScalar(radius * std::cos(angle)), btScalar(0), btScalar(radius * std::sin(angle)));
      faces.push_back({0, 1 + k, 1 + (k + 1) % n});
    }
    return ofTriangles(std::move(corners), std::move(faces));
  }
};

/// Looks, in each small step, for what of a cloth meets a surface whose corners go straight from where the body was at
/// the end of the step before to where it is now.
class BodyPassageCheck {
 public:
  BodyPassageCheck(const btSoftBody& cloth, double dt) : m_cloth(cloth), m_dt(dt) {
    m_places.resize(std::size_t(cloth.m_nodes.size()));
    std::set<std::pair<int, int>> edges;
    for (int k = 0; k < cloth.m_faces.size(); ++k) {
      std::array<int, 3> face;
      for (int i = 0; i < 3; ++i) face[std::size_t(i)] = numberOf(cloth, cloth.m_faces[k].m_n[i]);
      m_mesh.faces.push_back(face);
      for (std::size_t i = 0; i < 3; ++i) edges.insert(std::minmax(face[i], face[(i + 1) % 3]));
    }
    for (const auto& edge : edges) m_mesh.edges.push_back({edge.first, edge.second});
    for (int k = 0; k < cloth.m_nodes.size(); ++k) {
      m_mesh.vertices.push_back(k);
      m_places[std::size_t(k)] = placeOf(cloth.m_nodes[k].m_x);
    }
  }
  void add(const btCollisionObject& object, const BodySurface& surface) {
    const int first = int(m_places.size());
    for (const auto& edge : surface.edges) m_mesh.edges.push_back({first + edge[0], first + edge[1]});
    for (const auto& face : surface.faces) m_mesh.faces.push_back({first + face[0], first + face[1], first + face[2]});
    m_bodies.push_back({&object, surface.corners, object.getWorldTransform(), object.getWorldTransform()});
    for (std::size_t k = 0; k < surface.corners.size(); ++k) m_mesh.vertices.push_back(first + int(k));
    m_places.resize(m_places.size() + surface.corners.size());
    putBodies(1, m_places);
  }
  /// Looks no more at the surface that was added last.
  void removeLast() {
    const int first = int(m_places.size() - m_bodies.back().corners.size());
    const auto isGone = [first](const auto& part) { return part[0] >= first; };
    m_mesh.faces.erase(std::remove_if(m_mesh.faces.begin(), m_mesh.faces.end(), isGone), m_mesh.faces.end());
    m_mesh.edges.erase(std::remove_if(m_mesh.edges.begin(), m_mesh.edges.end(), isGone), m_mesh.edges.end());
    m_mesh.vertices.resize(std::size_t(first));
    m_places.resize(std::size_t(first));
    m_bodies.pop_back();
  }
  void watch(wetcloth::ClothSolver& solver) {
    solver.setSmallStepCallback([this](const wetcloth::ClothSolver::SmallStepView& view) { see(view); });
  }
  long long passages() const { return m_passages; }
  /// How many pairs meet now.
  int meetings() const { return count(m_places, m_places); }

 private:
  struct Body {
    const btCollisionObject* object;
    std::vector<btVector3> corners;
    btTransform from;
    btTransform to;
  };
  static Place placeOf(const btVector3& x) { return {double(x[0]), double(x[1]), double(x[2])}; }
  static Place placeOf(const btTransform& pose, const btVector3& corner) {
    Place place = placeOf(pose.getOrigin());
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) place[std::size_t(i)] += double(pose.getBasis()[i][k]) * double(corner[k]);
    }
    return place;
  }
  void putBodies(double share, std::vector<Place>& places) const {
    auto place = places.begin() + m_cloth.m_nodes.size();
    for (const Body& body : m_bodies) {
      for (const btVector3& corner : body.corners) {
        const Place from = placeOf(body.from, corner);
        const Place to = placeOf(body.to, corner);
        for (std::size_t k = 0; k < 3; ++k) (*place)[k] = share < 1 ? from[k] + share * (to[k] - from[k]) : to[k];
        ++place;
      }
    }
  }
  int count(const std::vector<Place>& from, const std::vector<Place>& to) const {
    const int nodes = m_cloth.m_nodes.size();
    return countPassages(m_mesh, from, to, [&](const PassagePair& pair) {
      const auto ofBodies = std::count_if(pair.node.begin(), pair.node.end(), [&](int node) { return node >= nodes; });
      return ofBodies > 0 && ofBodies < 4;
    });
  }
  void see(const wetcloth::ClothSolver::SmallStepView& view) {
    if (&view.body != &m_cloth) return;
    if (view.index == 0) {
      for (Body& body : m_bodies) {
        body.from = body.to;
        body.to = body.object->getWorldTransform();
      }
    }
    std::vector<Place> places = m_places;
    for (int k = 0; k < m_cloth.m_nodes.size(); ++k) {
      for (int axis = 0; axis < 3; ++axis) {
        places[std::size_t(k)][std::size_t(axis)] = double(view.x[axis][view.slots[k]]) + double(view.origin[axis]);
      }
    }
    putBodies((view.index + 1) / std::round(m_dt / double(view.length)), places);
    if (m_passages <= PassageCheck::kMany) m_passages += count(m_places, places);
    m_places = std::move(places);
  }

  const btSoftBody& m_cloth;
  double m_dt;
  PassageMesh m_mesh;
  std::vector<Body> m_bodies;
  std::vector<Place> m_places;
  long long m_passages = 0;
};

/// One cloth and some bodies, guarded against them or not.
class ClothAndBodies {
 public:
  explicit ClothAndBodies(bool isGuarded, const btVector3& gravity = kEarthGravity,
                          WorldKind kind = WorldKind::softRigid)
      : m_scene(kind, gravity, parametersOf(isGuarded)) {}

  template <class Source>
  btSoftBody& add(const Source& source) {
    m_cloth = &m_scene.add(source);
    m_cloth->getCollisionShape()->setMargin(btScalar(0.01));
    m_cloth->m_cfg.kDF = btScalar(0.5);
    m_check = std::make_unique<BodyPassageCheck>(*m_cloth, 1.0 / 60);
    m_check->watch(m_scene.solver());
    return *m_cloth;
  }
  /// After the cloth. A mass of 0: it does not move by itself.
  btRigidBody& add(std::unique_ptr<btCollisionShape> shape, const BodySurface& surface, const btVector3& place,
                   double mass = 0, const btVector3& velocity = btVector3(0, 0, 0)) {
    m_bodies.push_back(std::make_unique<RigidBody>(m_scene.bullet(), std::move(shape), btScalar(mass), place));
    btRigidBody& body = m_bodies.back()->body();
    body.setActivationState(DISABLE_DEACTIVATION);
    body.setLinearVelocity(velocity);
    m_check->add(body, surface);
    return body;
  }
  btRigidBody& addBox(double x, double y, double z, const btVector3& place, double mass = 0,
                      const btVector3& velocity = btVector3(0, 0, 0)) {
    return add(box(x, y, z), BodySurface::ofBox(x, y, z), place, mass, velocity);
  }
  void step(int count) { m_scene.step(count); }
  /// Moves kinematic bodies before each step.
  void step(int count, const std::function<void(int)>& move) {
    for (int k = 1; k <= count; ++k) {
      move(k);
      m_scene.step(1);
    }
  }

  long long passages() const { return m_check->passages(); }
  int meetings() const { return m_check->meetings(); }
  btSoftBody& cloth() { return *m_cloth; }
  wetcloth::ClothSolver::GuardTotals totals() { return m_scene.solver().guardTotals(); }
  SolverScene& scene() { return m_scene; }
  /// Looks at one more surface.
  void watch(const btCollisionObject& object, const BodySurface& surface) { m_check->add(object, surface); }
  void removeLastBody() {
    m_check->removeLast();
    m_bodies.pop_back();
  }

 private:
  static wetcloth::ClothSolver::Parameters parametersOf(bool isGuarded) {
    Guard guard;
    guard.bodies = isGuarded;
    return guardedBy(guard);
  }
  SolverScene m_scene;
  std::vector<std::unique_ptr<RigidBody>> m_bodies;
  btSoftBody* m_cloth = nullptr;
  std::unique_ptr<BodyPassageCheck> m_check;
};

}  // namespace wetcloth_test
