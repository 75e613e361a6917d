// SPDX-License-Identifier: Zlib
// The paper's patch: its springs, each once; its masses, pins and texture coordinates; what it refuses.

#include "tests/support/BulletWorld.h"
#include "tests/support/ClothScene.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/Measures.h"
#include "tests/support/Patches.h"
#include "tests/support/Rejection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace wetcloth_test::cloth_patch_test {
namespace {

using wetcloth::ClothPatch;
using Spring = wetcloth::ClothPatch::Spring;
using Pair = std::pair<int, int>;

ClothPatch sized(int columns, int rows) {
  ClothPatch patch;
  patch.columns = columns;
  patch.rows = rows;
  return patch;
}

/// A body without a world: all that a builder needs is the world's info.
struct Built {
  explicit Built(const ClothPatch& patch) { body = patch.build(info); }
  btSoftBodyWorldInfo info;
  std::unique_ptr<btSoftBody> body;
};

int indexOf(const btSoftBody& body, const btSoftBody::Node* node) { return int(node - &body.m_nodes[0]); }

Pair ends(const btSoftBody& body, int link) {
  const int a = indexOf(body, body.m_links[link].m_n[0]);
  const int b = indexOf(body, body.m_links[link].m_n[1]);
  return {std::min(a, b), std::max(a, b)};
}

/// The paper's pairs (III.A), written down from its text.
std::set<Pair> paperPairs(int columns, int rows, Spring kind) {
  std::set<Pair> pairs;
  const auto add = [&](int i, int j, int k, int l) {
    if (i >= columns || k < 0 || k >= columns || j >= rows || l >= rows) return;
    const int a = j * columns + i;
    const int b = l * columns + k;
    pairs.insert({std::min(a, b), std::max(a, b)});
  };
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      if (kind == Spring::mechanical) {
        add(i, j, i + 1, j);
        add(i, j, i, j + 1);
      } else if (kind == Spring::shear) {
        add(i, j, i + 1, j + 1);
        add(i, j, i - 1, j + 1);  // (i + 1, j) - (i, j + 1)
      } else {
        add(i, j, i + 2, j);
        add(i, j, i, j + 2);
      }
    }
  }
  return pairs;
}

constexpr std::array<Spring, 3> kKinds = {Spring::mechanical, Spring::shear, Spring::flexion};

TEST(ClothPatch, ThePapers32By32Has5826Springs) {
  const ClothPatch patch = sized(32, 32);
  EXPECT_EQ(patch.springCount(Spring::mechanical), 1984);  // 2 x 32 x 31
  EXPECT_EQ(patch.springCount(Spring::shear), 1922);       // 2 x 31 x 31
  EXPECT_EQ(patch.springCount(Spring::flexion), 1920);     // 2 x 32 x 30
  EXPECT_EQ(Built(patch).body->m_links.size(), 5826);
}

TEST(ClothPatch, HasExactlyThePapersSpringsEachOnceWithItsMaterial) {
  for (const auto& size : {Pair(2, 2), Pair(2, 7), Pair(7, 2), Pair(3, 3), Pair(5, 9), Pair(32, 32)}) {
    SCOPED_TRACE(testing::Message() << size.first << " x " << size.second);
    const ClothPatch patch = sized(size.first, size.second);
    const Built built(patch);
    const btSoftBody& body = *built.body;
    ASSERT_GE(body.m_materials.size(), 3);
    int links = 0;
    for (std::size_t kind = 0; kind < 3; ++kind) {
      std::set<Pair> found;
      for (int i = 0; i < body.m_links.size(); ++i) {
        if (body.m_links[i].m_material != body.m_materials[int(kind)]) continue;
        ++links;
        EXPECT_TRUE(found.insert(ends(body, i)).second) << "twice: " << ends(body, i).first;
        EXPECT_EQ(body.m_links[i].m_bbending != 0, kKinds[kind] == Spring::flexion);
      }
      EXPECT_EQ(found, paperPairs(size.first, size.second, kKinds[kind]));
      EXPECT_EQ(patch.springCount(kKinds[kind]), static_cast<long long>(found.size()));
    }
    EXPECT_EQ(links, body.m_links.size());
  }
}

TEST(ClothPatch, CountsOfAHugePatchDoNotOverflow) {
  const ClothPatch patch = sized(50000, 50000);
  EXPECT_EQ(patch.springCount(Spring::shear), 2LL * 49999 * 49999);
}

TEST(ClothPatch, NodesLieOnTheGrid) {
  ClothPatch patch = sized(5, 3);
  patch.origin = btVector3(1, 2, 3);
  patch.edgeU = btVector3(4, 0, 0);
  patch.edgeV = btVector3(0, 1, 1);
  const Built built(patch);
  ASSERT_EQ(built.body->m_nodes.size(), 15);
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 5; ++i) {
      const btVector3 expected(btScalar(1 + i), btScalar(2 + 0.5 * j), btScalar(3 + 0.5 * j));
      EXPECT_LE((built.body->m_nodes[patch.node(i, j)].m_x - expected).length(), 1e-6) << i << " " << j;
    }
  }
}

TEST(ClothPatch, SpringsAreAtRestWhenBuilt) {
  const Built built(sized(7, 7));
  for (int i = 0; i < built.body->m_links.size(); ++i) {
    const btSoftBody::Link& link = built.body->m_links[i];
    EXPECT_NEAR(link.m_rl, (link.m_n[0]->m_x - link.m_n[1]->m_x).length(), 1e-6);
    EXPECT_GT(link.m_rl, 0.1);
  }
}

TEST(ClothPatch, MassIsArealDensityTimesAreaSharedByNodeArea) {
  for (const auto& size : {Pair(2, 2), Pair(3, 9), Pair(32, 32)}) {
    ClothPatch patch = sized(size.first, size.second);
    patch.edgeU = btVector3(3, 0, 0);
    patch.edgeV = btVector3(1, 0, 2);  // a parallelogram of 6 m^2
    patch.arealDensity = 0.2;
    const Built built(patch);
    EXPECT_NEAR(freeMass(*built.body), 1.2, 1.2e-5);

    // A third of each triangle to each corner, from the faces themselves.
    const double cell = 6.0 / ((size.first - 1) * (size.second - 1));
    std::vector<double> shares(std::size_t(patch.nodeCount()), 0.0);
    for (int i = 0; i < built.body->m_faces.size(); ++i) {
      for (btSoftBody::Node* node : built.body->m_faces[i].m_n) {
        shares[std::size_t(indexOf(*built.body, node))] += 0.2 * cell / 2 / 3;
      }
    }
    for (int i = 0; i < patch.nodeCount(); ++i) {
      EXPECT_NEAR(1 / double(built.body->m_nodes[i].m_im) / shares[std::size_t(i)], 1, 1e-5) << i;
    }
  }
}

TEST(ClothPatch, TrianglesCoverThePatchOnceAndLookTheSameWay) {
  const Built built(sized(6, 4));
  ASSERT_EQ(built.body->m_faces.size(), 2 * 5 * 3);
  btVector3 sum(0, 0, 0);
  double area = 0;
  for (int i = 0; i < built.body->m_faces.size(); ++i) {
    btSoftBody::Node* const* n = built.body->m_faces[i].m_n;
    const btVector3 cross = (n[1]->m_x - n[0]->m_x).cross(n[2]->m_x - n[0]->m_x) / 2;
    sum += cross;
    area += double(cross.length());
  }
  EXPECT_NEAR(area, 1, 1e-5);
  EXPECT_NEAR(sum.length(), 1, 1e-5);
}

TEST(ClothPatch, PinsByCornerEdgeAndList) {
  ClothPatch patch = sized(5, 4);
  patch.pinnedCorners = {ClothPatch::Corner::bottomLeft, ClothPatch::Corner::topRight};
  patch.pinnedEdges = {ClothPatch::Edge::right};
  patch.pinnedNodes = {patch.node(2, 1), patch.node(2, 1)};
  const std::set<int> expected = {0, 19, 4, 9, 14, 11 - 4};
  ASSERT_EQ(patch.node(2, 1), 7);
  const Built built(patch);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(built.body->m_nodes[i].m_im == 0, expected.count(i) == 1) << i;
}

TEST(ClothPatch, EdgesAndCornersAreWhereTheirNamesSay) {
  const auto pinned = [](const ClothPatch& patch) {
    const Built built(patch);
    std::set<int> nodes;
    for (int i = 0; i < built.body->m_nodes.size(); ++i) {
      if (built.body->m_nodes[i].m_im == 0) nodes.insert(i);
    }
    return nodes;
  };
  using Edge = ClothPatch::Edge;
  using Corner = ClothPatch::Corner;
  ClothPatch patch = sized(3, 3);
  const std::pair<Edge, std::set<int>> edges[] = {
      {Edge::left, {0, 3, 6}}, {Edge::right, {2, 5, 8}}, {Edge::bottom, {0, 1, 2}}, {Edge::top, {6, 7, 8}}};
  for (const auto& edge : edges) {
    patch.pinnedEdges = {edge.first};
    EXPECT_EQ(pinned(patch), edge.second);
  }
  patch.pinnedEdges.clear();
  const std::pair<Corner, int> corners[] = {
      {Corner::bottomLeft, 0}, {Corner::bottomRight, 2}, {Corner::topLeft, 6}, {Corner::topRight, 8}};
  for (const auto& corner : corners) {
    patch.pinnedCorners = {corner.first};
    EXPECT_EQ(pinned(patch), std::set<int>{corner.second});
  }
}

TEST(ClothPatch, StiffnessIsPerKind) {
  ClothPatch patch = sized(4, 4);
  patch.mechanicalStiffness = 0.9;
  patch.shearStiffness = 0.5;
  patch.flexionStiffness = 0.1;
  const Built built(patch);
  EXPECT_FLOAT_EQ(float(built.body->m_materials[0]->m_kLST), 0.9f);
  EXPECT_FLOAT_EQ(float(built.body->m_materials[1]->m_kLST), 0.5f);
  EXPECT_FLOAT_EQ(float(built.body->m_materials[2]->m_kLST), 0.1f);
}

TEST(ClothPatch, TextureCoordinatesSpanTheUnitSquare) {
  const ClothPatch patch = sized(5, 3);
  const auto uv = patch.textureCoordinates();
  ASSERT_EQ(uv.size(), 15u);
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 5; ++i) {
      EXPECT_FLOAT_EQ(uv[std::size_t(patch.node(i, j))][0], float(i) / 4);
      EXPECT_FLOAT_EQ(uv[std::size_t(patch.node(i, j))][1], float(j) / 2);
    }
  }
}

TEST(ClothPatch, NeighboursInTheLinkListShareNoNode) {
  const Built built(sized(32, 32));
  int sharing = 0;
  for (int i = 1; i < built.body->m_links.size(); ++i) {
    const Pair a = ends(*built.body, i - 1);
    const Pair b = ends(*built.body, i);
    sharing += a.first == b.first || a.first == b.second || a.second == b.first || a.second == b.second;
  }
  EXPECT_LT(sharing, built.body->m_links.size() / 20);
}

TEST(ClothPatch, BuildsMoreNodesThanBulletsOwnBendingHelperBears) {
  // btSoftBodyHelpers' helper overflows above 46,340 nodes.
  const ClothPatch patch = sized(256, 256);
  const Built built(patch);
  EXPECT_EQ(built.body->m_nodes.size(), 65536);
  EXPECT_EQ(built.body->m_links.size(), 2 * 256 * 255 + 2 * 255 * 255 + 2 * 256 * 254);
  EXPECT_NEAR(freeMass(*built.body), 0.150, 1e-5);
}

TEST_IN_EVERY_WORLD(ClothPatchInWorld, FallsFreelyAndKeepsItsShape) {
  ClothScene scene(GetParam(), kEarthGravity, levelPatch(9, 1));
  scene.step(120);
  EXPECT_NEAR(centreOfMass(scene.body())[1], -9.81 / 8, 9.81 / 2 * kSubstep);
  EXPECT_NEAR((scene.node(0).m_x - scene.node(80).m_x).length(), std::sqrt(2.0), 1e-4);
}

TEST_IN_EVERY_WORLD(ClothPatchInWorld, HangsFromItsPins) {
  ClothPatch patch = sized(9, 9);
  patch.edgeV = btVector3(0, 1, 0);
  patch.pinnedEdges = {ClothPatch::Edge::top};
  ClothScene scene(GetParam(), kEarthGravity, patch);
  scene.addBulletSpringsForStep();
  scene.step(240);
  for (int i = 0; i < 9; ++i) EXPECT_EQ(scene.node(patch.node(i, 8)).m_x.y(), 1);
  for (int i = 0; i < 9; ++i) EXPECT_NEAR(scene.node(patch.node(i, 0)).m_x.y(), 0, 0.1);
}

// --- bad input
// --------------------------------------------------------------------------------------------------------

TEST(ClothPatchInput, EachFieldIsNamedWithItsValue) {
  const btScalar nan = std::numeric_limits<btScalar>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  const auto refused = [](const char* field, const std::function<void(ClothPatch&)>& spoil) {
    ClothPatch patch = sized(4, 4);
    spoil(patch);
    const std::string message = rejection([&] { Built built(patch); });
    EXPECT_NE(message.find(field), std::string::npos) << field << ": " << message;
  };
  refused("columns", [](ClothPatch& p) { p.columns = 1; });
  refused("rows", [](ClothPatch& p) { p.rows = -3; });
  for (double bad : {0.0, -0.1, double(nan), infinite}) {
    refused("arealDensity", [=](ClothPatch& p) { p.arealDensity = bad; });
    refused("mechanicalStiffness", [=](ClothPatch& p) { p.mechanicalStiffness = bad; });
    refused("shearStiffness", [=](ClothPatch& p) { p.shearStiffness = bad; });
    refused("flexionStiffness", [=](ClothPatch& p) { p.flexionStiffness = bad; });
  }
  refused("mechanicalStiffness", [](ClothPatch& p) { p.mechanicalStiffness = 1.1; });
  refused("origin", [=](ClothPatch& p) { p.origin.setY(nan); });
  refused("edgeU", [=](ClothPatch& p) { p.edgeU.setX(nan); });
  refused("edgeV", [=](ClothPatch& p) { p.edgeV.setZ(nan); });
  refused("edgeV", [](ClothPatch& p) { p.edgeV = btScalar(2) * p.edgeU; });
  refused("edge", [](ClothPatch& p) { p.edgeU = btVector3(0, 0, 0); });
  for (const double extreme : {1e-300, 1e300}) {  // masses without an inverse, at least in float32
    if (sizeof(btScalar) == 4) refused("arealDensity", [=](ClothPatch& p) { p.arealDensity = extreme; });
  }
  if (sizeof(btScalar) == 4) refused("mechanicalStiffness", [](ClothPatch& p) { p.mechanicalStiffness = 1e-300; });
  refused("arealDensity", [](ClothPatch& p) {  // there is no room between its nodes
    p.origin = btVector3(1, 1, 1) * (sizeof(btScalar) == 4 ? btScalar(1e8) : btScalar(1e17));
  });
  refused("pinnedNodes", [](ClothPatch& p) { p.pinnedNodes = {3, 16}; });
  refused("pinnedNodes", [](ClothPatch& p) { p.pinnedNodes = {-1}; });
  const auto refusedCoordinates = [](int columns, int rows) {
    return rejection([&] { static_cast<void>(sized(columns, rows).textureCoordinates()); });
  };
  EXPECT_NE(refusedCoordinates(1, 4).find("ClothPatch.columns = 1"), std::string::npos);
  EXPECT_NE(refusedCoordinates(4, -3).find("ClothPatch.rows = -3"), std::string::npos);
}

}  // namespace
}  // namespace wetcloth_test::cloth_patch_test
