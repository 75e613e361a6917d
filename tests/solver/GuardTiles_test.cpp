// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/GuardTiles.h"

#include "bullet_wetcloth/solver/Separation.h"
#include "tests/solver/GuardScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>
#include <vector>

namespace wetcloth_test::guard_tiles_test {
namespace {

using wetcloth::GuardCandidates;
using wetcloth::GuardMesh;
using wetcloth::GuardTiles;
using wetcloth::collision::ContinuousCheck;
using wetcloth::collision::Pair;
using wetcloth::collision::Query;
using wetcloth::collision::Tier;

// A pair, whatever the order of its nodes.
using Key = std::array<int, 5>;
Key keyOf(int first, std::array<int, 4> node) {
  if (first == 1) {
    std::sort(node.begin() + 1, node.end());
  } else {
    std::sort(node.begin(), node.begin() + 2);
    std::sort(node.begin() + 2, node.end());
    if (node[2] < node[0]) node = {node[2], node[3], node[0], node[1]};
  }
  return {first, node[0], node[1], node[2], node[3]};
}

// Nodes are expected to go on for so many small steps, within so much [m]; parts that come nearer than `near` [m] are
// wanted.
struct Expectation {
  int steps;
  btScalar slack;
  btScalar near;
};

// How many of the nodes are of the first part, and the nodes.
struct FoundPair {
  FoundPair(int count, const int (&nodes)[4]) : first(count) { std::copy(nodes, nodes + 4, node); }
  int first;
  int node[4];
};

// Cloths in a tangle, their nodes one after the other.
class Tangle {
 public:
  void add(SolverScene& scene, const BodyBuilder& builder) {
    const btSoftBody& body = scene.add(builder);
    m_firstNodes.push_back(from.size());
    m_meshes.push_back(std::make_unique<GuardMesh>(wetcloth::guardMeshOf(body, wetcloth::findSlots(body).grid)));
    const int first = int(from.size());
    for (int k = 0; k < body.m_nodes.size(); ++k) {
      const btVector3& x = body.m_nodes[k].m_x;
      from.push_back({double(x[0]), double(x[1]), double(x[2])});
      cloth.push_back(int(m_meshes.size()) - 1);
    }
    std::set<std::pair<int, int>> edges;
    for (int k = 0; k < body.m_faces.size(); ++k) {
      std::array<int, 3> face;
      for (int i = 0; i < 3; ++i) face[std::size_t(i)] = first + numberOf(body, body.m_faces[k].m_n[i]);
      parts.faces.push_back(face);
      for (std::size_t i = 0; i < 3; ++i) edges.insert(std::minmax(face[i], face[(i + 1) % 3]));
    }
    for (const auto& edge : edges) parts.edges.push_back({edge.first, edge.second});
    for (int k = 0; k < body.m_nodes.size(); ++k) parts.vertices.push_back(first + k);
  }
  bool isGrid(int node) const { return m_meshes[std::size_t(cloth[std::size_t(node)])]->isGrid(); }
  std::vector<FoundPair> find(const std::vector<Place>& to, const Expectation& expectation,
                              const GuardTiles::Scope& scope) const {
    GuardTiles tiles;
    addTo(tiles);
    GuardCandidates candidates;
    const wetcloth::GuardNodes nodes = expected(to, expectation);
    tiles.findPairs(nodes, expectation.near, scope, candidates);
    return listed(candidates);
  }
  // The same, but nodes were expected elsewhere first, and have left their ways at one time and another.
  std::vector<FoundPair> findAgain(const std::vector<std::vector<Place>>& ways, const Expectation& expectation) const {
    GuardTiles tiles;
    addTo(tiles);
    GuardCandidates found;
    wetcloth::GuardNodes nodes = expected(ways.front(), expectation);
    tiles.findPairs(nodes, expectation.near, {true, true}, found);
    for (std::size_t time = 1; time < ways.size(); ++time) {
      std::vector<int> changed;
      for (std::size_t k = 0; k < from.size(); ++k) {
        if (ways[time][k] != ways[time - 1][k]) changed.push_back(int(k));
      }
      nodes = expected(ways[time], expectation);
      GuardCandidates again;
      tiles.findPairsAgain(changed, again);
      const auto keep = [&](const std::vector<wetcloth::GuardPair>& pairs, std::vector<wetcloth::GuardPair>& kept) {
        for (const auto& pair : pairs) {
          if (!tiles.isLookedAtAgain(pair)) kept.push_back(pair);
        }
      };
      keep(found.vertexFace, again.vertexFace);
      keep(found.edgeEdge, again.edgeEdge);
      found = again;
    }
    return listed(found);
  }

  std::vector<Place> from;
  std::vector<int> cloth;  // of each node
  PassageMesh parts;

 private:
  void addTo(GuardTiles& tiles) const {
    for (std::size_t k = 0; k < m_meshes.size(); ++k) tiles.add(*m_meshes[k], m_firstNodes[k]);
  }
  wetcloth::GuardNodes expected(const std::vector<Place>& to, const Expectation& expectation) const {
    wetcloth::GuardNodes nodes;
    nodes.resize(from.size());
    for (std::size_t k = 0; k < from.size(); ++k) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        nodes.expected[k].start.at[axis] = btScalar(from[k][axis]);
        nodes.expected[k].end.at[axis] = btScalar(from[k][axis] + expectation.steps * (to[k][axis] - from[k][axis]));
      }
      nodes.expected[k].start.at[3] = nodes.expected[k].end.at[3] = expectation.slack;
    }
    return nodes;
  }
  static std::vector<FoundPair> listed(const GuardCandidates& candidates) {
    std::vector<FoundPair> pairs;
    for (const auto& pair : candidates.vertexFace) pairs.emplace_back(1, pair.node);
    for (const auto& pair : candidates.edgeEdge) pairs.emplace_back(2, pair.node);
    return pairs;
  }

  std::vector<std::unique_ptr<GuardMesh>> m_meshes;
  std::vector<std::size_t> m_firstNodes;
};

// The triangles of a body, with its nodes in another order, in which there are no rows.
BodyBuilder shuffled(const BodyBuilder& builder) {
  return [=](btSoftBodyWorldInfo& info) {
    const std::unique_ptr<btSoftBody> body = builder(info);
    Triangles mesh;
    for (int k = 0; k < body->m_nodes.size(); ++k) mesh.places.push_back(body->m_nodes[k].m_x);
    for (int k = 0; k < body->m_faces.size(); ++k) {
      const btSoftBody::Face& face = body->m_faces[k];
      mesh.faces.push_back({numberOf(*body, face.m_n[0]), numberOf(*body, face.m_n[1]), numberOf(*body, face.m_n[2])});
    }
    std::mt19937 random(6);
    return mesh.shuffled(random).builder()(info);
  };
}

BodyBuilder shuffledSheet(int n, const btVector3& place) {
  const Triangles mesh = Triangles::of(levelSheet(n, 0.4, place));
  std::mt19937 random(5);
  return mesh.shuffled(random).builder();
}

// A crumpled sheet: folds that are sharp enough to meet.
BodyBuilder crumpled(int n, std::uint32_t seed, const btVector3& place) {
  return [=](btSoftBodyWorldInfo& info) {
    std::unique_ptr<btSoftBody> body = levelSheet(n, 0.4, place).build(info);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> number(-1, 1);
    for (int k = 0; k < body->m_nodes.size(); ++k) {
      btVector3& x = body->m_nodes[k].m_x;
      x.setY(x.y() + btScalar(0.1 * std::sin(20 * double(x.x() - place.x()))));
      x.setX(place.x() + (x.x() - place.x()) * btScalar(0.3) + btScalar(0.01 * number(random)));
      x.setZ(x.z() + btScalar(0.01 * number(random)));
    }
    return body;
  };
}

// The least distance of a pair on its way, at some moments.
double leastDistance(const PassagePair& pair, const std::vector<Place>& from, const std::vector<Place>& to) {
  double least = HUGE_VAL;
  for (int moment = 0; moment <= 6; ++moment) {
    double nodes[4][3];
    for (std::size_t k = 0; k < 4; ++k) {
      const auto node = std::size_t(pair.node[k]);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        nodes[k][axis] = from[node][axis] + (to[node][axis] - from[node][axis]) * moment / 6;
      }
    }
    const wetcloth::Separation separation =
        pair.kind == Pair::vertexFace ? wetcloth::separationOfVertexAndFace(nodes) : wetcloth::separationOfEdges(nodes);
    least = std::min(least, separation.distance);
  }
  return least;
}

bool meets(const PassagePair& pair, const std::vector<Place>& from, const std::vector<Place>& to) {
  static const ContinuousCheck check(ContinuousCheck::hasExact() ? Tier::exact : Tier::conservative);
  Query<double> query;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto node = std::size_t(pair.node[k]);
    std::copy(from[node].begin(), from[node].end(), query.start[k]);
    std::copy(to[node].begin(), to[node].end(), query.end[k]);
  }
  return check(pair.kind, query).found;
}

class GuardTilesOfATangle : public testing::Test {
 protected:
  GuardTilesOfATangle() {
    m_tangle.add(m_scene, crumpled(11, 1, btVector3(0, 0, 0)));
    m_tangle.add(m_scene, crumpled(10, 2, btVector3(btScalar(0.05), btScalar(0.04), btScalar(0.02))));
    m_tangle.add(m_scene, shuffledSheet(8, btVector3(0, btScalar(0.02), 0)));
    m_tangle.add(m_scene, shuffled(crumpled(12, 3, btVector3(btScalar(0.02), btScalar(-0.03), btScalar(0.01)))));
  }
  std::vector<Place> moved(double size) {
    std::vector<Place> to = m_tangle.from;
    for (Place& x : to) {
      for (double& number : x) number += size * m_number(m_random);
    }
    return to;
  }
  // Where nodes may be: on their way for all small steps, and some way off.
  void expectFound(const std::vector<Place>& to, const Expectation& expectation) {
    expectAllIn(m_tangle.find(to, expectation, {true, true}), to, expectation);
  }
  void expectAllIn(const std::vector<FoundPair>& pairs, const std::vector<Place>& to, const Expectation& expectation) {
    std::set<Key> found;
    for (const FoundPair& pair : pairs) {
      const Key key = keyOf(pair.first, {pair.node[0], pair.node[1], pair.node[2], pair.node[3]});
      EXPECT_TRUE(found.insert(key).second) << "twice";
      EXPECT_EQ(std::set<int>(pair.node, pair.node + 4).size(), 4u) << "a node is shared";
    }
    for (int turn = 0; turn < 3; ++turn) {
      std::vector<Place> begin = m_tangle.from;
      std::vector<Place> end = begin;
      for (std::size_t k = 0; k < begin.size(); ++k) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const double off = turn == 0 ? 0 : 0.999 * double(expectation.slack) * m_number(m_random);
          end[k][axis] += expectation.steps * (to[k][axis] - begin[k][axis]) + off;
          begin[k][axis] += off;
        }
      }
      expectNearOnes(begin, end, double(expectation.near), found);
    }
  }
  Tangle m_tangle;
  int m_required[3] = {0, 0, 0};  // pairs of a grid and itself, of another mesh and itself, and of two cloths

 private:
  void expectNearOnes(const std::vector<Place>& begin, const std::vector<Place>& end, double near,
                      const std::set<Key>& found) {
    for (const PassagePair& pair : pairsThatComeNear(m_tangle.parts, begin, end, near)) {
      const int first = pair.kind == Pair::vertexFace ? 1 : 2;
      const int other = pair.node[std::size_t(first)];
      const bool isOfOne = m_tangle.cloth[std::size_t(pair.node[0])] == m_tangle.cloth[std::size_t(other)];
      // A certificate may leave out parts of a sheet that come near but cannot meet.
      const bool isWanted = isOfOne ? meets(pair, begin, end) : leastDistance(pair, begin, end) < 0.999 * near;
      if (!isWanted) continue;
      ++m_required[!isOfOne ? 2 : m_tangle.isGrid(other) ? 0 : 1];
      EXPECT_EQ(found.count(keyOf(first, pair.node)), 1u) << (isOfOne ? "of one cloth, " : "") << pair.node[0] << ' '
                                                          << pair.node[1] << ' ' << pair.node[2] << ' ' << pair.node[3];
    }
  }
  SolverScene m_scene;
  std::mt19937 m_random{23};
  std::uniform_real_distribution<double> m_number{-1, 1};
};

TEST_F(GuardTilesOfATangle, AllThatMayMeetIsFoundOnce) {
  for (const int steps : {1, 5}) {
    for (const double near : {0.0005, 0.01}) {
      for (const double slack : {0.0001, 0.005}) {
        expectFound(moved(0.01 / steps), {steps, btScalar(slack), btScalar(near)});
      }
    }
  }
  EXPECT_GT(m_required[0], 100);
  EXPECT_GT(m_required[1], 50);
  EXPECT_GT(m_required[2], 1000);
}

// In turn: nodes that are strewn over all cloths, and those in a corner, which leave most tiles as they were.
TEST_F(GuardTilesOfATangle, WhatLeavesItsWayIsFoundAgain) {
  const Expectation expectation = {3, btScalar(0.0005), btScalar(0.002)};
  const std::vector<Place> first = moved(0.003);
  const std::vector<Place> other = moved(0.02);
  for (const std::size_t every : {1, 7, 100, 0}) {
    std::vector<Place> then = first;
    for (std::size_t k = 0; k < then.size(); ++k) {
      if (every > 0 ? k % every == 0 : k < 12) then[k] = other[k];
    }
    expectAllIn(m_tangle.findAgain({first, then}, expectation), then, expectation);
  }
  EXPECT_GT(m_required[0], 100);
  EXPECT_GT(m_required[1], 50);
  EXPECT_GT(m_required[2], 1000);
}

// Each time others. What was left out since it lay in a flat piece may meet after any of them.
TEST_F(GuardTilesOfATangle, WhatLeavesItsWayAgainAndAgainIsFound) {
  const Expectation expectation = {3, btScalar(0.0002), btScalar(0.002)};
  const std::vector<Place> other = moved(0.02);
  std::vector<std::vector<Place>> ways = {moved(0.0005)};
  for (std::size_t time = 0; time < 5; ++time) {
    ways.push_back(ways.back());
    for (std::size_t k = time; k < other.size(); k += 31) ways.back()[k] = other[k];
    expectAllIn(m_tangle.findAgain(ways, expectation), ways.back(), expectation);
  }
  EXPECT_GT(m_required[1], 50);
}

TEST_F(GuardTilesOfATangle, OnlyWhatIsAskedFor) {
  const std::vector<Place> to = moved(0.01);
  const Expectation expectation = {2, btScalar(0.001), btScalar(0.002)};
  const auto isSelf = [&](const FoundPair& pair) {
    return m_tangle.cloth[std::size_t(pair.node[0])] == m_tangle.cloth[std::size_t(pair.node[pair.first])];
  };
  const std::vector<FoundPair> all = m_tangle.find(to, expectation, {true, true});
  const std::vector<FoundPair> self = m_tangle.find(to, expectation, {true, false});
  const std::vector<FoundPair> others = m_tangle.find(to, expectation, {false, true});
  EXPECT_TRUE(std::all_of(self.begin(), self.end(), isSelf));
  EXPECT_TRUE(std::none_of(others.begin(), others.end(), isSelf));
  EXPECT_EQ(self.size() + others.size(), all.size());
  EXPECT_FALSE(self.empty());
  EXPECT_FALSE(others.empty());
  EXPECT_TRUE(m_tangle.find(to, expectation, {false, false}).empty());
}

TEST(GuardTiles, AFlatSheetHasNoPairsOfItsOwn) {
  SolverScene scene;
  Tangle tangle;
  tangle.add(scene, [](btSoftBodyWorldInfo& info) { return levelPatch(20, 1).build(info); });
  EXPECT_TRUE(tangle.find(tangle.from, {5, btScalar(0.0001), btScalar(0.001)}, {true, true}).empty());
}

}  // namespace
}  // namespace wetcloth_test::guard_tiles_test
