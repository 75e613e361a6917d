// SPDX-License-Identifier: Zlib
#include "command/stability/CaseParts.h"
#include "command/stability/Cases.h"
#include "command/stability/NaiveMethods.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <set>
#include <utility>

// Meshes that no tool should make, and all do.
namespace stability {
namespace {

struct Mesh {
  std::vector<btVector3> nodes;  ///< [m]
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> pinned = {0};
  double nodeMass = 2e-3;  ///< [kg]
  double height = 1;       ///< of what hangs below the pins [m]
};

std::unique_ptr<btSoftBody> bodyOf(const Mesh& mesh, btSoftBodyWorldInfo& info) {
  const std::vector<btScalar> masses(mesh.nodes.size(), btScalar(mesh.nodeMass));
  auto body =
      std::make_unique<btSoftBody>(&info, static_cast<int>(mesh.nodes.size()), mesh.nodes.data(), masses.data());
  std::set<std::pair<int, int>> edges;
  for (const auto& [a, b, c] : mesh.triangles) {
    body->appendFace(a, b, c);
    edges.insert(std::minmax(a, b));
    edges.insert(std::minmax(b, c));
    edges.insert(std::minmax(c, a));
  }
  for (const auto& [a, b] : edges) body->appendLink(a, b);
  for (const int node : mesh.pinned) body->setMass(node, 0);
  return body;
}

/// A square of cells of two triangles each, upright, hanging from its two upper corners.
Mesh grid(int columns, int rows, double width, double height) {
  Mesh mesh;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      mesh.nodes.emplace_back(btScalar(width * i / (columns - 1)), btScalar(-height * j / (rows - 1)), 0);
    }
  }
  for (int j = 0; j + 1 < rows; ++j) {
    for (int i = 0; i + 1 < columns; ++i) {
      const int a = j * columns + i;
      mesh.triangles.push_back({a, a + 1, a + columns});
      mesh.triangles.push_back({a + 1, a + columns + 1, a + columns});
    }
  }
  mesh.pinned = {0, columns - 1};
  mesh.height = height;
  return mesh;
}

Mesh degenerateTriangles() {
  Mesh mesh = grid(5, 5, 1, 1);
  const int first = static_cast<int>(mesh.nodes.size());
  // Three in a row, without area; and a needle of 1 m by 1 micrometre.
  mesh.nodes.emplace_back(btScalar(0.25), btScalar(-1.25), 0);
  mesh.nodes.emplace_back(btScalar(0.25), btScalar(-1.5), 0);
  mesh.nodes.emplace_back(1, -2, 0);
  mesh.nodes.emplace_back(btScalar(1.000001), -2, 0);
  mesh.triangles.push_back({21, first, first + 1});
  mesh.triangles.push_back({24, first + 2, first + 3});
  mesh.height = 2;
  return mesh;
}

/// Two nodes at each place of the middle row, one of each half, linked by an edge of length 0.
Mesh duplicateNodes() {
  Mesh mesh = grid(5, 5, 1, 1);
  for (int i = 0; i < 5; ++i) mesh.nodes.push_back(mesh.nodes[static_cast<std::size_t>(10 + i)]);
  for (auto& triangle : mesh.triangles) {
    const bool isLower = triangle[0] > 14 || triangle[1] > 14 || triangle[2] > 14;
    for (int& corner : triangle) {
      if (isLower && corner >= 10 && corner < 15) corner += 15;
    }
  }
  for (int i = 0; i < 4; ++i) mesh.triangles.push_back({10 + i, 25 + i, 11 + i});
  mesh.triangles.push_back({14, 29, 13});
  return mesh;
}

Mesh loneTriangle() {
  Mesh mesh;
  mesh.nodes = {btVector3(0, 0, 0), btVector3(1, 0, 0), btVector3(0, -1, 0)};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

/// Four wings on each edge of a spine.
Mesh nonManifold() {
  Mesh mesh;
  constexpr int spine = 5;
  for (int j = 0; j < spine; ++j) mesh.nodes.emplace_back(0, btScalar(-0.25 * j), 0);
  for (int wing = 0; wing < 4; ++wing) {
    const double angle = 1.5707963 * wing + 0.3;
    const int first = static_cast<int>(mesh.nodes.size());
    for (int j = 0; j < spine; ++j) {
      mesh.nodes.emplace_back(btScalar(0.25 * std::cos(angle)), btScalar(-0.25 * j), btScalar(0.25 * std::sin(angle)));
    }
    for (int j = 0; j + 1 < spine; ++j) {
      mesh.triangles.push_back({j, j + 1, first + j});
      mesh.triangles.push_back({j + 1, first + j + 1, first + j});
    }
  }
  return mesh;
}

/// Sheared so far that every triangle has an angle of 160 degrees and more.
Mesh obtuse() {
  Mesh mesh = grid(6, 6, 1, 1);
  for (btVector3& node : mesh.nodes) node.setX(node.x() - 3 * node.y());
  mesh.height = 4;
  return mesh;
}

Mesh flippedFaces() {
  Mesh mesh = grid(6, 6, 1, 1);
  for (std::size_t f = 0; f < mesh.triangles.size(); f += 2) std::swap(mesh.triangles[f][0], mesh.triangles[f][1]);
  return mesh;
}

Mesh ofSize(double size) {
  Mesh mesh = grid(6, 6, size, size);
  mesh.nodeMass = 0.150 * size * size / 36;
  return mesh;
}

/// Hangs from its pins in wind and rain for half of the time, then in still air.
HardCase ofMesh(const std::string& name, const std::string& about, const std::function<Mesh()>& make) {
  HardCase hardCase = everywhere(name, "meshes", about);
  hardCase.duration = 10;
  hardCase.build = [=](CaseScene& scene) {
    const Mesh mesh = make();
    const double mass = mesh.nodeMass * static_cast<double>(mesh.nodes.size());
    btSoftBody& body = scene.add(bodyOf(mesh, scene.worldInfo()), stiffnessFor(2 * mass, 1));
    // In a step gravity moves the smallest cloth by many times its size.
    if (mesh.height < 0.01) scene.springIterations = 64;
    scene.limits.source = 5.1;
    scene.limits.drop = 2 * mesh.height;
    scene.limits.force = 1.84 * mass * scene.gravity() + windForce(5.1, mesh.height * mesh.height);
    scene.limits.calmFrom = scene.duration() / 2;
    return underWeather(scene, body, scene.wet(body), Weather::Kind::rain, btVector3(1, 0, 5));
  };
  return hardCase;
}

}  // namespace

std::vector<HardCase> meshCases() {
  HardCase large = ofMesh("cloth_100_m", "100 m x 100 m", [] { return ofSize(100); });
  large.duration = 40;  // it swings ten times as slowly
  return {ofMesh("zero_area_and_needles", "triangles without area and a needle of 1 m by 1 um", degenerateTriangles),
          ofMesh("duplicate_nodes", "two nodes at one place, with an edge of length 0", duplicateNodes),
          ofMesh("lone_triangle", "one triangle, pinned at a corner", loneTriangle),
          ofMesh("strip_one_cell_wide", "1 m long and 5 cm wide, in 20 cells", [] { return grid(2, 21, 0.05, 1); }),
          ofMesh("non_manifold_edges", "four sheets meet in one line of edges", nonManifold),
          ofMesh("obtuse_mesh", "every triangle has an angle of more than 160 degrees", obtuse),
          ofMesh("flipped_faces", "every other triangle looks the other way", flippedFaces),
          ofMesh("cloth_1_mm", "1 mm x 1 mm", [] { return ofSize(1e-3); }),
          std::move(large)};
}

}  // namespace stability
