// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/PartBoxes.h"

#include "bullet_wetcloth/numerics/InstructionSet.h"
#include "tests/solver/GuardScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace wetcloth_test::part_boxes_test {
namespace {

using wetcloth::GuardBox;
using wetcloth::GuardMesh;
using wetcloth::GuardNodes;
using wetcloth::InstructionSet;
using wetcloth::PartBoxes;

constexpr btScalar kNear = btScalar(0.02);

using Pairs = std::vector<std::pair<int, int>>;

// A crumpled sheet of shuffled triangles. Its nodes are on their ways in all directions.
class CrumpledSheet : public testing::TestWithParam<InstructionSet> {
 public:
  CrumpledSheet() {
    wetcloth::forceInstructionSet(GetParam());
    std::mt19937 random(11);
    const Triangles triangles = Triangles::of(levelSheet(14, 1, btVector3(0, 0, 0))).shuffled(random);
    const btSoftBody& body = m_scene.add(triangles.builder());
    m_mesh = wetcloth::guardMeshOf(body, wetcloth::findSlots(body).grid);
    std::uniform_real_distribution<btScalar> off(btScalar(-0.05), btScalar(0.05));
    m_nodes.resize(std::size_t(body.m_nodes.size()));
    for (int k = 0; k < body.m_nodes.size(); ++k) {
      GuardNodes::Way& way = m_nodes.expected[std::size_t(k)];
      for (int axis = 0; axis < 3; ++axis) {
        way.start.at[axis] = body.m_nodes[k].m_x[axis] + off(random);
        way.end.at[axis] = way.start.at[axis] + off(random);
      }
      way.start.at[3] = way.end.at[3] = btScalar(0.001) * btScalar(1 + k % 3);
    }
    m_boxes.add(m_mesh, 0);
    m_boxes.begin(m_nodes, kNear);
    for (std::size_t tile = 0; tile < m_mesh.tiles.size(); ++tile) m_boxes.bound(tile);
  }
  ~CrumpledSheet() override { wetcloth::forceInstructionSet(InstructionSet::avx2); }

 protected:
  std::vector<int> nodesOf(PartBoxes::Kind kind, int part) const {
    const auto k = std::size_t(part);
    if (kind == PartBoxes::kVertices) return {m_mesh.vertices[k]};
    if (kind == PartBoxes::kEdges) return {std::begin(m_mesh.edges[k].node), std::end(m_mesh.edges[k].node)};
    return {std::begin(m_mesh.faces[k].node), std::end(m_mesh.faces[k].node)};
  }
  // Of a tile's parts of one kind the first, and the one after the last.
  std::pair<int, int> rangeOf(std::size_t tile, PartBoxes::Kind kind) const {
    const auto part = [&](int cell) {
      const GuardMesh::Cell& of = m_mesh.cells[std::size_t(cell)];
      return kind == PartBoxes::kVertices ? of.vertex : kind == PartBoxes::kEdges ? of.edge : of.face;
    };
    return {part(m_mesh.tiles[tile].cell), part(m_mesh.tiles[tile].endCell)};
  }
  GuardBox boxOf(PartBoxes::Kind kind, int part) const {
    GuardBox box;
    for (const int node : nodesOf(kind, part)) box.include(m_boxes.vertex(node));
    return box;
  }
  GuardBox boxOfTile(std::size_t tile) const {
    GuardBox box;
    const auto [begin, end] = rangeOf(tile, PartBoxes::kFaces);
    for (int face = begin; face < end; ++face) box.include(boxOf(PartBoxes::kFaces, face));
    return box;
  }
  bool isNew(PartBoxes::Kind kind, int part) const {
    const std::vector<int> nodes = nodesOf(kind, part);
    return std::any_of(nodes.begin(), nodes.end(), [&](int node) { return m_boxes.isNew(node); });
  }
  PartBoxes::ChosenParts choose(std::size_t tile, PartBoxes::Kind kind, const GuardBox& box) const {
    PartBoxes::ChosenParts chosen;
    m_boxes.find(tile, kind, box, chosen);
    return chosen;
  }
  // One pair after the other, of what overlaps the other tile's box.
  Pairs pairsOf(std::size_t a, PartBoxes::Kind kind, std::size_t b, PartBoxes::Kind other, bool newOnly) const {
    Pairs pairs;
    const auto [beginA, endA] = rangeOf(a, kind);
    const auto [beginB, endB] = rangeOf(b, other);
    for (int i = beginA; i < endA; ++i) {
      for (int k = beginB; k < endB; ++k) {
        const std::vector<int> nodes = nodesOf(kind, i);
        const std::vector<int> across = nodesOf(other, k);
        const bool shares = std::any_of(nodes.begin(), nodes.end(), [&](int node) {
          return std::find(across.begin(), across.end(), node) != across.end();
        });
        if (shares || (a == b && kind == other && k <= i)) continue;
        if (newOnly && !isNew(kind, i) && !isNew(other, k)) continue;
        if (boxOf(kind, i).overlaps(boxOf(other, k))) pairs.emplace_back(i, k);
      }
    }
    return pairs;
  }
  static Pairs sorted(const PartBoxes::Meetings& meetings) {
    Pairs pairs;
    for (std::size_t k = 0; k < meetings.count; ++k) pairs.emplace_back(meetings.parts[k], meetings.others[k]);
    std::sort(pairs.begin(), pairs.end());
    return pairs;
  }
  void expectAllPairs(bool newOnly) {
    PartBoxes::Meetings meetings;
    std::size_t count = 0;
    for (std::size_t a = 0; a < m_mesh.tiles.size(); ++a) {
      for (std::size_t b = a; b < m_mesh.tiles.size(); ++b) {
        const GuardBox boxA = boxOfTile(a);
        const GuardBox boxB = boxOfTile(b);
        PartBoxes::meetFaces(choose(a, PartBoxes::kVertices, boxB), choose(b, PartBoxes::kFaces, boxA), newOnly,
                             meetings);
        EXPECT_EQ(sorted(meetings), pairsOf(a, PartBoxes::kVertices, b, PartBoxes::kFaces, newOnly)) << a << " " << b;
        count += meetings.count;
        PartBoxes::meetEdges(choose(a, PartBoxes::kEdges, boxB), choose(b, PartBoxes::kEdges, boxA), a == b, newOnly,
                             meetings);
        EXPECT_EQ(sorted(meetings), pairsOf(a, PartBoxes::kEdges, b, PartBoxes::kEdges, newOnly)) << a << " " << b;
        count += meetings.count;
      }
    }
    EXPECT_GT(count, 1000u);  // there was something to find
  }

  SolverScene m_scene;
  GuardMesh m_mesh;
  GuardNodes m_nodes;
  PartBoxes m_boxes;
};

TEST_P(CrumpledSheet, AllPairsThatOverlapAreFoundOnce) {
  ASSERT_FALSE(m_mesh.isGrid());
  ASSERT_GT(m_mesh.tiles.size(), 5u);
  expectAllPairs(false);
}

TEST_P(CrumpledSheet, OfThoseThatAreNewOnlyPairsWithANewNode) {
  const std::vector<int> changed = {3, 50, 51, 120};
  for (const int node : changed) m_nodes.expected[std::size_t(node)].end.at[2] += btScalar(0.1);
  m_boxes.renew(changed);
  for (std::size_t tile = 0; tile < m_mesh.tiles.size(); ++tile) m_boxes.bound(tile);
  PartBoxes::Meetings meetings;
  for (std::size_t a = 0; a < m_mesh.tiles.size(); ++a) {
    for (std::size_t b = a; b < m_mesh.tiles.size(); ++b) {
      PartBoxes::meetEdges(choose(a, PartBoxes::kEdges, boxOfTile(b)), choose(b, PartBoxes::kEdges, boxOfTile(a)),
                           a == b, true, meetings);
      EXPECT_EQ(sorted(meetings), pairsOf(a, PartBoxes::kEdges, b, PartBoxes::kEdges, true)) << a << " " << b;
    }
  }
}

TEST_P(CrumpledSheet, WhatIsAroundChosenPartsIsAroundThemAlone) {
  for (std::size_t tile = 0; tile < m_mesh.tiles.size(); ++tile) {
    GuardBox half = boxOfTile(tile);
    half.high = (half.low + half.high) * wetcloth::everywhere<wetcloth::Quad>(btScalar(0.5));
    GuardBox expected;
    const auto [begin, end] = rangeOf(tile, PartBoxes::kFaces);
    for (int face = begin; face < end; ++face) {
      if (boxOf(PartBoxes::kFaces, face).overlaps(half)) expected.include(boxOf(PartBoxes::kFaces, face));
    }
    const GuardBox around = choose(tile, PartBoxes::kFaces, half).around();
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(around.low[axis], expected.low[axis]);
      EXPECT_EQ(around.high[axis], expected.high[axis]);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(PartBoxes, CrumpledSheet, testing::Values(InstructionSet::baseline, InstructionSet::avx2));

}  // namespace
}  // namespace wetcloth_test::part_boxes_test
