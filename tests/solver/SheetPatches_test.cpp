// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/SheetPatches.h"

#include "bullet_wetcloth/solver/PatchBounds.h"
#include "tests/solver/GuardScene.h"
#include "tests/support/Pi.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <set>
#include <vector>

namespace wetcloth_test::sheet_patches_test {
namespace {

using wetcloth::GuardMesh;
using wetcloth::SheetPatch;

// A shuffled sheet of triangles, which is no grid to anybody, and where its nodes would be in the unit square.
struct Sheet {
  explicit Sheet(int n) : Sheet(Triangles::of(levelSheet(n, 1, btVector3(0, 0, 0)))) {}
  explicit Sheet(const Triangles& ordered) {
    std::mt19937 random(7);
    triangles = ordered.shuffled(random);
    body = &scene.add(triangles.builder());
    mesh = wetcloth::guardMeshOf(*body, wetcloth::findSlots(*body).grid);
    for (const btVector3& x : triangles.places) flat.push_back({double(x[0]), double(x[1]), double(x[2])});
  }
  SolverScene scene;
  Triangles triangles;
  btSoftBody* body;
  GuardMesh mesh;
  std::vector<Place> flat;
};

std::set<int> nodesOfTile(const GuardMesh& mesh, int tile) {
  std::set<int> nodes;
  const auto& cells = mesh.tiles[std::size_t(tile)];
  for (int face = mesh.cells[std::size_t(cells.cell)].face; face < mesh.cells[std::size_t(cells.endCell)].face;
       ++face) {
    nodes.insert(std::begin(mesh.faces[std::size_t(face)].node), std::end(mesh.faces[std::size_t(face)].node));
  }
  return nodes;
}

bool haveACommonNode(const GuardMesh& mesh, int tileA, int tileB) {
  const std::set<int> a = nodesOfTile(mesh, tileA);
  const std::set<int> b = nodesOfTile(mesh, tileB);
  return std::any_of(a.begin(), a.end(), [&](int node) { return b.count(node) > 0; });
}

TEST(SheetPatches, OfAFlatSheetAllNeighboursAreInOne) {
  const Sheet sheet(40);
  ASSERT_FALSE(sheet.mesh.isGrid());
  const int tiles = int(sheet.mesh.tiles.size());
  ASSERT_GT(tiles, 20);
  for (int a = 0; a < tiles; ++a) {
    for (int b = a; b < tiles; ++b) {
      if (!haveACommonNode(sheet.mesh, a, b)) continue;
      const bool areTogether =
          std::any_of(sheet.mesh.patches.begin(), sheet.mesh.patches.end(), [&](const SheetPatch& patch) {
            return std::binary_search(patch.whole.begin(), patch.whole.end(), a) &&
                   std::binary_search(patch.whole.begin(), patch.whole.end(), b);
          });
      EXPECT_TRUE(areTogether) << a << ' ' << b;
    }
  }
}

// Each border is a ring of edges, no node twice, around a node that is not on it.
TEST(SheetPatches, BordersAreRings) {
  const Sheet sheet(24);
  std::set<std::array<int, 2>> edges;
  for (const GuardMesh::Edge& edge : sheet.mesh.edges) {
    edges.insert({std::min(edge.node[0], edge.node[1]), std::max(edge.node[0], edge.node[1])});
  }
  ASSERT_FALSE(sheet.mesh.patches.empty());
  for (const SheetPatch& patch : sheet.mesh.patches) {
    EXPECT_EQ(std::set<int>(patch.border.begin(), patch.border.end()).size(), patch.border.size());
    EXPECT_EQ(std::count(patch.border.begin(), patch.border.end(), patch.middle), 0);
    for (std::size_t k = 0; k < patch.border.size(); ++k) {
      const int a = patch.border[k];
      const int b = patch.border[(k + 1) % patch.border.size()];
      EXPECT_EQ(edges.count({std::min(a, b), std::max(a, b)}), 1u);
    }
    EXPECT_TRUE(std::includes(patch.tiles.begin(), patch.tiles.end(), patch.whole.begin(), patch.whole.end()));
  }
}

// A band of which the ends are joined has no patch with all of it: no border goes round it once.
TEST(SheetPatches, AClosedBandIsNoPatch) {
  Triangles band;
  const int around = 24;
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * kPi * i / around;
      band.places.emplace_back(btScalar(0.1 * std::cos(angle)), btScalar(0.02 * j), btScalar(0.1 * std::sin(angle)));
    }
  }
  for (int i = 0; i < around; ++i) {
    const int next = (i + 1) % around;
    band.faces.push_back({i, next, around + next});
    band.faces.push_back({i, around + next, around + i});
  }
  EXPECT_TRUE(Sheet(band).mesh.patches.empty());
}

// Nodes are expected on the way between two places, or so far from it.
wetcloth::GuardNodes expected(const std::vector<Place>& from, const std::vector<Place>& to, double slack) {
  wetcloth::GuardNodes nodes;
  nodes.resize(from.size());
  for (std::size_t k = 0; k < from.size(); ++k) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      nodes.expected[k].start.at[axis] = btScalar(from[k][axis]);
      nodes.expected[k].end.at[axis] = btScalar(to[k][axis]);
    }
    nodes.expected[k].start.at[3] = nodes.expected[k].end.at[3] = btScalar(slack);
  }
  return nodes;
}

bool isCertified(const GuardMesh& mesh, const SheetPatch& patch, const wetcloth::GuardNodes& nodes) {
  std::vector<wetcloth::GuardBox> normals(mesh.tiles.size());
  for (const int tile : patch.tiles) {
    normals[std::size_t(tile)] = wetcloth::normalsOfTile(mesh, tile, nodes, 0);
  }
  return wetcloth::cannotMeetItself(patch, normals.data(), nodes, 0);
}

// What of the mesh is in the tiles that a patch has with all faces.
PassageMesh partsOf(const GuardMesh& mesh, const SheetPatch& patch) {
  PassageMesh parts;
  for (const int tile : patch.whole) {
    const GuardMesh::Cell& begin = mesh.cells[std::size_t(mesh.tiles[std::size_t(tile)].cell)];
    const GuardMesh::Cell& end = mesh.cells[std::size_t(mesh.tiles[std::size_t(tile)].endCell)];
    for (int k = begin.vertex; k < end.vertex; ++k) parts.vertices.push_back(mesh.vertices[std::size_t(k)]);
    for (int k = begin.edge; k < end.edge; ++k) {
      parts.edges.push_back({mesh.edges[std::size_t(k)].node[0], mesh.edges[std::size_t(k)].node[1]});
    }
    for (int k = begin.face; k < end.face; ++k) {
      const auto& node = mesh.faces[std::size_t(k)].node;
      parts.faces.push_back({node[0], node[1], node[2]});
    }
  }
  return parts;
}

// A place on the way of a node, or as far off as it may be.
Place anyPlace(const wetcloth::GuardNodes::Way& way, double time, std::mt19937& random) {
  std::uniform_real_distribution<double> number(-1, 1);
  Place place;
  for (std::size_t k = 0; k < 3; ++k) {
    const double start = double(way.start.at[k]);
    place[k] = start + (double(way.end.at[k]) - start) * time + double(way.start.at[3]) * (number(random) > 0 ? 1 : -1);
  }
  return place;
}

TEST(SheetPatches, NormalsStayBetweenTheirBounds) {
  const Sheet sheet(6);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(0, 1);
  std::vector<Place> to = sheet.flat;
  for (Place& x : to) x = {x[0] + 0.1 * number(random), x[1] + 0.1 * number(random), x[2] + 0.1 * number(random)};
  const wetcloth::GuardNodes nodes = expected(sheet.flat, to, 0.03);
  for (int tile = 0; tile < int(sheet.mesh.tiles.size()); ++tile) {
    const wetcloth::GuardBox box = wetcloth::normalsOfTile(sheet.mesh, tile, nodes, 0);
    const auto& cells = sheet.mesh.tiles[std::size_t(tile)];
    const int end = sheet.mesh.cells[std::size_t(cells.endCell)].face;
    for (int face = sheet.mesh.cells[std::size_t(cells.cell)].face; face < end; ++face) {
      for (int sample = 0; sample < 50; ++sample) {
        const double time = number(random);
        Place corner[3];
        for (std::size_t k = 0; k < 3; ++k) {
          const int node = sheet.mesh.faces[std::size_t(face)].node[k];
          corner[k] = anyPlace(nodes.expected[std::size_t(node)], time, random);
        }
        for (std::size_t k = 0; k < 3; ++k) {
          const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
          const double normal = ((corner[1][i] - corner[0][i]) * (corner[2][j] - corner[0][j]) -
                                 (corner[1][j] - corner[0][j]) * (corner[2][i] - corner[0][i])) *
                                double(sheet.mesh.windings[std::size_t(face)]);
          // Rounding of the bounds, which are of a size of 1 to 10.
          EXPECT_GT(normal, double(box.low[int(k)]) - 1e-5);
          EXPECT_LT(normal, double(box.high[int(k)]) + 1e-5);
        }
      }
    }
  }
}

using Shape = std::function<Place(const Place&)>;

std::vector<Place> shaped(const std::vector<Place>& flat, const Shape& shape) {
  std::vector<Place> places;
  for (const Place& x : flat) places.push_back(shape(x));
  return places;
}

TEST(SheetPatches, AFlatSheetIsCertifiedAndGoesOnBeingSoWhereverItMoves) {
  const Sheet sheet(30);
  const auto moved = shaped(sheet.flat, [](const Place& x) { return Place{x[0] + 3, x[1] - 2, x[2] + 5}; });
  for (const SheetPatch& patch : sheet.mesh.patches) {
    EXPECT_TRUE(isCertified(sheet.mesh, patch, expected(sheet.flat, sheet.flat, 0.001)));
    EXPECT_TRUE(isCertified(sheet.mesh, patch, expected(sheet.flat, moved, 0.001)));
  }
}

// Waves that get higher, with noise, until the sheet passes through itself: what is certified does not meet itself.
TEST(SheetPatches, WhatIsCertifiedNeverMeetsItself) {
  const Sheet sheet(15);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> number(-1, 1);
  int certified = 0, refused = 0, meeting = 0;
  for (int turn = 0; turn < 20; ++turn) {
    const double height = 0.02 * turn;
    const double phase = number(random);
    const auto wave = [&](double size) {
      return shaped(sheet.flat, [&](const Place& x) {
        return Place{x[0] * (1 - 0.04 * turn) + size * height * number(random) / 4,
                     x[1] + height * std::sin(9 * x[0] + phase) + size * height * number(random) / 4,
                     x[2] + size * height * number(random) / 4};
      });
    };
    const std::vector<Place> from = wave(0.3);
    std::vector<Place> to = wave(0.6);
    const double slack = 0.0004 * turn;
    for (const SheetPatch& patch : sheet.mesh.patches) {
      const bool meets = countPassages(partsOf(sheet.mesh, patch), from, to) > 0;
      meeting += meets ? 1 : 0;
      if (!isCertified(sheet.mesh, patch, expected(from, to, slack))) {
        ++refused;
        continue;
      }
      ++certified;
      EXPECT_FALSE(meets);
      std::vector<Place> begin = from;
      std::vector<Place> end = to;
      for (std::size_t k = 0; k < begin.size(); ++k) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          begin[k][axis] += 0.999 * slack * number(random);
          end[k][axis] += 0.999 * slack * number(random);
        }
      }
      EXPECT_EQ(countPassages(partsOf(sheet.mesh, patch), begin, end), 0);
    }
  }
  EXPECT_GT(certified, 100);
  EXPECT_GT(refused, 100);
  EXPECT_GT(meeting, 20);
}

// Of a ramp that winds up around an axis all normals point up, and more than once around it lies above itself: only the
// border tells. Squeezed flat it meets itself.
TEST(SheetPatches, ARampMoreThanOnceAroundIsNotCertified) {
  const Sheet sheet(24);
  const auto ramp = shaped(sheet.flat, [](const Place& x) {
    const double angle = 8 * kPi * x[0];  // a patch has less than half of it
    const double radius = 1 + 0.5 * (x[2] + 0.5);
    return Place{radius * std::cos(angle), 0.02 * angle, -radius * std::sin(angle)};
  });
  const auto squeezed = shaped(ramp, [](const Place& x) { return Place{x[0], -x[1], x[2]}; });
  int met = 0;
  for (const SheetPatch& patch : sheet.mesh.patches) {
    if (countPassages(partsOf(sheet.mesh, patch), ramp, squeezed) == 0) continue;
    ++met;
    EXPECT_FALSE(isCertified(sheet.mesh, patch, expected(ramp, squeezed, 1e-6)));
  }
  EXPECT_GT(met, 0);
}

TEST(SheetPatches, ASheetFoldedOverIsNeverCertified) {
  const Sheet sheet(12);
  const auto folded = shaped(sheet.flat, [](const Place& x) { return Place{std::fabs(x[0]), 0.01 * x[0], x[2]}; });
  for (const SheetPatch& patch : sheet.mesh.patches) {
    std::set<int> nodes;
    for (const int tile : patch.whole) nodes.merge(nodesOfTile(sheet.mesh, tile));
    const auto isAt = [&](double sign) {
      return std::any_of(nodes.begin(), nodes.end(),
                         [&](int node) { return sign * sheet.flat[std::size_t(node)][0] > 0.1; });
    };
    if (!isAt(1) || !isAt(-1)) continue;
    EXPECT_FALSE(isCertified(sheet.mesh, patch, expected(folded, folded, 1e-6)));
  }
}

}  // namespace
}  // namespace wetcloth_test::sheet_patches_test
