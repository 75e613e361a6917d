// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/GuardMesh.h"

#include "tests/solver/GuardScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace wetcloth_test::guard_mesh_test {
namespace {

using wetcloth::GuardMesh;

GuardMesh guardMesh(const btSoftBody& body) { return wetcloth::guardMeshOf(body, wetcloth::findSlots(body).grid); }

template <std::size_t count>
std::array<int, count> sorted(const int (&nodes)[count]) {
  std::array<int, count> all;
  std::copy(nodes, nodes + count, all.begin());
  std::sort(all.begin(), all.end());
  return all;
}

// What the faces of a body have, each once.
struct Parts {
  std::set<int> vertices;
  std::set<std::array<int, 2>> edges;
  std::set<std::array<int, 3>> faces;

  explicit Parts(const btSoftBody& body) {
    for (int k = 0; k < body.m_faces.size(); ++k) {
      int face[3];
      for (int i = 0; i < 3; ++i) face[i] = numberOf(body, body.m_faces[k].m_n[i]);
      faces.insert(sorted(face));
      vertices.insert(face, face + 3);
      for (int i = 0; i < 3; ++i) {
        const int edge[2] = {face[i], face[(i + 1) % 3]};
        edges.insert(sorted(edge));
      }
    }
  }
};

void expectOrdered(const std::vector<GuardMesh::Cell>& cells, int GuardMesh::Cell::*first, std::size_t count) {
  EXPECT_EQ(cells.front().*first, 0);
  EXPECT_EQ(cells.back().*first, int(count));
  for (std::size_t k = 1; k < cells.size(); ++k) EXPECT_LE(cells[k - 1].*first, cells[k].*first);
}

void expectEachPartOnce(const btSoftBody& body) {
  const GuardMesh mesh = guardMesh(body);
  const Parts parts(body);
  EXPECT_EQ(std::set<int>(mesh.vertices.begin(), mesh.vertices.end()), parts.vertices);
  EXPECT_EQ(mesh.vertices.size(), parts.vertices.size());
  std::set<std::array<int, 2>> edges;
  for (const auto& edge : mesh.edges) edges.insert(sorted(edge.node));
  EXPECT_EQ(edges, parts.edges);
  EXPECT_EQ(mesh.edges.size(), parts.edges.size());
  std::set<std::array<int, 3>> faces;
  for (const auto& face : mesh.faces) faces.insert(sorted(face.node));
  EXPECT_EQ(faces, parts.faces);
  // Cells share out the parts, and tiles the cells.
  ASSERT_FALSE(mesh.cells.empty());
  expectOrdered(mesh.cells, &GuardMesh::Cell::vertex, mesh.vertices.size());
  expectOrdered(mesh.cells, &GuardMesh::Cell::edge, mesh.edges.size());
  expectOrdered(mesh.cells, &GuardMesh::Cell::face, mesh.faces.size());
  int cell = 0;
  for (const GuardMesh::Tile& tile : mesh.tiles) {
    EXPECT_EQ(tile.cell, cell);
    EXPECT_LE(tile.cell, tile.endCell);
    cell = tile.endCell;
  }
  EXPECT_EQ(cell, int(mesh.cells.size()) - 1);
}

// What holds a triangle holds all parts of its cell.
void expectPartsInTheirTriangle(const GuardMesh& mesh) {
  for (std::size_t k = 0; k + 1 < mesh.cells.size(); ++k) {
    const GuardMesh::Cell& cell = mesh.cells[k];
    const GuardMesh::Cell& end = mesh.cells[k + 1];
    ASSERT_EQ(end.face - cell.face, 1) << "cell " << k;
    const auto& corners = mesh.faces[std::size_t(cell.face)].node;
    const std::set<int> triangle(corners, corners + 3);
    for (int i = cell.vertex; i < end.vertex; ++i) EXPECT_EQ(triangle.count(mesh.vertices[std::size_t(i)]), 1u);
    for (int i = cell.edge; i < end.edge; ++i) {
      for (const int node : mesh.edges[std::size_t(i)].node) EXPECT_EQ(triangle.count(node), 1u);
    }
  }
}

TEST(GuardMesh, OfGridsOfAnySize) {
  SolverScene scene;
  const int sizes[][2] = {{2, 2}, {2, 9}, {3, 3}, {7, 5}, {8, 8}, {9, 9}, {9, 17}, {16, 15}, {17, 3}, {25, 33}};
  for (const auto& size : sizes) {
    wetcloth::ClothPatch patch;
    patch.columns = size[0];
    patch.rows = size[1];
    const btSoftBody& body = scene.add(patch);
    SCOPED_TRACE(std::to_string(size[0]) + " x " + std::to_string(size[1]));
    expectEachPartOnce(body);
    const GuardMesh mesh = guardMesh(body);
    if (!mesh.isGrid()) continue;
    EXPECT_EQ(mesh.columns, size[0]);
    EXPECT_EQ(mesh.rows, size[1]);
    EXPECT_EQ(int(mesh.tiles.size()), mesh.tileColumns * mesh.tileRows);
    for (std::size_t k = 0; k + 1 < mesh.cells.size(); ++k) {
      const GuardMesh::Cell& cell = mesh.cells[k];
      for (int face = cell.face; face < mesh.cells[k + 1].face; ++face) {
        for (const int node : mesh.faces[std::size_t(face)].node) {
          EXPECT_TRUE(node / size[0] == cell.row || node / size[0] == cell.row + 1);
          EXPECT_TRUE(node % size[0] == cell.column || node % size[0] == cell.column + 1);
        }
      }
    }
  }
}

TEST(GuardMesh, OfALargeGridIsAGridAndItsEdgesAreAsLongAsTheyAre) {
  SolverScene scene;
  const GuardMesh mesh = guardMesh(scene.add(levelPatch(21, 1)));
  EXPECT_TRUE(mesh.isGrid());
  for (const GuardMesh::Tile& tile : mesh.tiles) EXPECT_TRUE(tile.isWhole);
  const double side = 1.0 / 20;
  EXPECT_GE(mesh.edgeLength, side * 0.999);
  EXPECT_LE(mesh.edgeLength, side * std::sqrt(2.0));
}

TEST(GuardMesh, OfAGridWithAHole) {
  SolverScene scene;
  btSoftBody& body = scene.add(levelPatch(19, 1));
  for (int k = body.m_faces.size() - 1; k >= 0; --k) {
    const int node = numberOf(body, body.m_faces[k].m_n[0]);
    if (node / 19 < 9 || node / 19 > 11 || node % 19 < 3 || node % 19 > 6) continue;
    body.m_faces.swap(k, body.m_faces.size() - 1);
    body.m_faces.pop_back();
  }
  expectEachPartOnce(body);
  const GuardMesh mesh = guardMesh(body);
  if (mesh.isGrid()) {
    EXPECT_FALSE(
        std::all_of(mesh.tiles.begin(), mesh.tiles.end(), [](const GuardMesh::Tile& tile) { return tile.isWhole; }));
  }
}

TEST(GuardMesh, OfFlippedRepeatedAndMissingFaces) {
  SolverScene scene;
  btSoftBody& body = scene.add(levelPatch(9, 1));
  for (int k = 0; k < body.m_faces.size(); k += 3) std::swap(body.m_faces[k].m_n[0], body.m_faces[k].m_n[1]);
  expectEachPartOnce(body);
  const int count = body.m_faces.size();
  for (int k = 0; k < count; k += 5) {
    const btSoftBody::Face face = body.m_faces[k];
    body.appendFace(numberOf(body, face.m_n[1]), numberOf(body, face.m_n[2]), numberOf(body, face.m_n[0]));
  }
  expectEachPartOnce(body);
  body.m_faces.clear();
  expectEachPartOnce(body);
  // One that a grid does not have.
  body.appendFace(0, 20, 70);
  body.appendFace(0, 1, 10);
  expectEachPartOnce(body);
}

TEST(GuardMesh, OfAMeshThatIsNoGrid) {
  const Triangles mesh = Triangles::of(levelPatch(11, 1));
  std::mt19937 random(3);
  SolverScene scene;
  const btSoftBody& body = scene.add(mesh.shuffled(random).builder());
  EXPECT_FALSE(guardMesh(body).isGrid());
  expectEachPartOnce(body);
  expectPartsInTheirTriangle(guardMesh(body));
}

TEST(GuardMesh, OfAMeshThatIsNoGridWithTrianglesTwiceAndSomeThatAreNone) {
  Triangles mesh = Triangles::of(levelPatch(11, 1));
  std::mt19937 random(3);
  const std::size_t count = mesh.faces.size();
  for (std::size_t k = 0; k < count; k += 3) {
    const auto [a, b, c] = mesh.faces[k];
    mesh.faces.push_back({b, a, c});
    mesh.faces.push_back({a, b, b});
  }
  std::shuffle(mesh.faces.begin(), mesh.faces.end(), random);
  SolverScene scene;
  const btSoftBody& body = scene.add(mesh.shuffled(random).builder());
  const GuardMesh guarded = guardMesh(body);
  EXPECT_FALSE(guarded.isGrid());
  EXPECT_EQ(guarded.faces.size(), count);
  expectPartsInTheirTriangle(guarded);
}

}  // namespace
}  // namespace wetcloth_test::guard_mesh_test
