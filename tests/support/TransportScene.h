// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/effects/Diffusion.h"
#include "bullet_wetcloth/effects/Seepage.h"
#include "tests/support/BulletWorld.h"
#include "tests/support/ClothScene.h"
#include "tests/support/Pi.h"
#include "tests/support/SoftBodies.h"

#include <algorithm>
#include <functional>
#include <random>
#include <utility>

namespace wetcloth_test {
namespace transport {

/// Points and triangles of a cloth at rest.
struct Mesh {
  std::vector<btVector3> points;
  std::vector<std::array<int, 3>> faces;
};

/// Columns x rows points over width x height in the plane z = 0, from the origin. A point inside is moved by up to
/// `jitter` of the spacing, and diagonals turn at random, when `jitter` > 0.
inline Mesh grid(int columns, int rows, double width, double height, double jitter = 0, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-jitter, jitter);
  const double dx = width / (columns - 1);
  const double dy = height / (rows - 1);
  Mesh mesh;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const bool isInside = i > 0 && j > 0 && i < columns - 1 && j < rows - 1;
      const double x = dx * (i + (isInside && jitter > 0 ? shift(random) : 0));
      const double y = dy * (j + (isInside && jitter > 0 ? shift(random) : 0));
      mesh.points.emplace_back(btScalar(x), btScalar(y), btScalar(0));
    }
  }
  for (int j = 0; j + 1 < rows; ++j) {
    for (int i = 0; i + 1 < columns; ++i) {
      const int a = j * columns + i;
      const int b = a + 1;
      const int c = a + columns;
      const int d = c + 1;
      if (jitter > 0 && random() % 2 == 0) {
        mesh.faces.push_back({a, b, c});
        mesh.faces.push_back({b, d, c});
      } else {
        mesh.faces.push_back({a, b, d});
        mesh.faces.push_back({a, d, c});
      }
    }
  }
  return mesh;
}

/// A body of this mesh, with the masses of an even cloth; nodes of no area weigh a hundredth of the mean. No links.
inline BodyBuilder clothOf(const Mesh& mesh, double arealDensity = 0.150) {
  std::vector<double> masses(mesh.points.size(), 0);
  double total = 0;
  for (const auto& f : mesh.faces) {
    const btVector3& a = mesh.points[std::size_t(f[0])];
    const double area =
        double((mesh.points[std::size_t(f[1])] - a).cross(mesh.points[std::size_t(f[2])] - a).length()) / 2;
    for (const int node : f) masses[std::size_t(node)] += arealDensity * area / 3;
    total += arealDensity * area;
  }
  std::vector<btScalar> rounded;
  for (const double mass : masses) {
    rounded.push_back(btScalar(mass > 0 ? mass : 0.01 * (total > 0 ? total : 1) / double(masses.size())));
  }
  return triangles(mesh.points, rounded, mesh.faces);
}

/// A cloth of its own in a world without gravity whose steps are only ours.
class TransportScene : public ClothScene {
 public:
  explicit TransportScene(const Mesh& mesh, const btVector3& gravity = btVector3(0, 0, 0))
      : ClothScene(WorldKind::softRigid, gravity, clothOf(mesh), wetcloth::Fabric::cotton(), wetcloth::Hook::manual) {}

  void run(int steps, double dt) {
    for (int i = 0; i < steps; ++i) preTick(dt);
  }
  int count() { return cloth().nodeCount(); }
  double x(int i) { return double(node(i).m_x.x()); }
  double y(int i) { return double(node(i).m_x.y()); }
  double s(int i) { return cloth().saturation(i); }
  void wet(const std::function<double(double, double)>& saturationAt) {
    std::vector<double> held;
    for (int i = 0; i < count(); ++i) held.push_back(saturationAt(x(i), y(i)) * cloth().capacity(i));
    cloth().setHeld(held);
  }
  void wetAtRandom(unsigned seed, double least = 0, double most = 1) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> saturation(least, most);
    wet([&](double, double) { return saturation(random); });
  }
  double lowest() {
    double value = HUGE_VAL;
    for (int i = 0; i < count(); ++i) value = std::min(value, s(i));
    return value;
  }
  double highest() {
    double value = -HUGE_VAL;
    for (int i = 0; i < count(); ++i) value = std::max(value, s(i));
    return value;
  }
};

/// Keeps the nodes at the left border saturated, as a strip is that dips into water.
class DipsLeftEdge : public wetcloth::Effect {
 public:
  const char* name() const override { return "DipsLeftEdge"; }
  wetcloth::Stage stage() const override { return wetcloth::Stage::sources; }
  void apply(wetcloth::WetCloth& cloth, const wetcloth::Step&) override {
    for (int i = 0; i < cloth.nodeCount(); ++i) {
      const double room = cloth.capacity(i) - cloth.held(i);
      if (cloth.body().m_nodes[i].m_x.x() == 0 && room > 0) cloth.water().absorb(std::size_t(i), room, 0, 0, 0);
    }
  }
};

/// Meshes that are hard on a Laplacian.
inline std::vector<std::pair<std::string, Mesh>> hardMeshes() {
  std::vector<std::pair<std::string, Mesh>> meshes;
  meshes.emplace_back("grid", grid(6, 5, 0.2, 0.1));
  meshes.emplace_back("irregular", grid(7, 7, 0.1, 0.1, 0.4, 3));
  Mesh needles = grid(6, 6, 1, 0.002, 0.3, 5);
  for (btVector3& p : needles.points) p.setX(p.x() + 300 * p.y());  // sheared: almost all angles are 0 or 180 degrees
  meshes.emplace_back("needles", needles);
  Mesh book = grid(3, 3, 0.1, 0.1);  // three pages on one spine
  book.points.emplace_back(btScalar(0.05), btScalar(0.02), btScalar(0.07));
  book.faces.push_back({1, 4, 9});
  meshes.emplace_back("non-manifold", book);
  Mesh flat = grid(4, 4, 0.1, 0.1);
  flat.points[5] = flat.points[6];                                     // triangles of no area
  flat.points.emplace_back(btScalar(0.05), btScalar(0), btScalar(0));  // on a border edge
  flat.points.emplace_back(btScalar(0.4), btScalar(0), btScalar(0));   // of no triangle
  flat.faces.push_back({1, 2, 16});
  flat.faces.push_back(flat.faces[0]);  // twice
  flat.faces.push_back({3, 3, 2});
  meshes.emplace_back("degenerate", flat);
  meshes.emplace_back("lone triangle", Mesh{{btVector3(0, 0, 0), btVector3(1, 0, 0), btVector3(0, 1, 0)}, {{0, 1, 2}}});
  meshes.emplace_back("point", Mesh{{btVector3(0, 0, 0), btVector3(0, 0, 0), btVector3(0, 0, 0)}, {{0, 1, 2}}});
  return meshes;
}

}  // namespace transport
}  // namespace wetcloth_test
