// SPDX-License-Identifier: Zlib
// The audit counts what passes through what: hand-made motions with passages that can be counted by hand, in each of
// Bullet's worlds. Bodies without links move freely, so each node goes where its velocity takes it.

#include "tests/support/BulletWorld.h"
#include "tests/support/ClothScene.h"
#include "tests/support/InEveryWorld.h"
#include "tests/support/SoftBodies.h"

#include <LinearMath/btIDebugDraw.h>

#include <algorithm>
#include <limits>
#include <set>

namespace wetcloth_test::collision_audit_test {
namespace {

using wetcloth::AuditTotals;
using wetcloth::CollisionAudit;
using wetcloth::Passage;
using wetcloth::collision::Pair;

const double kDt = kExactSubstep;

btScalar real(double value) { return static_cast<btScalar>(value); }
btVector3 at(double x, double y, double z) { return btVector3(real(x), real(y), real(z)); }

void setNodeVelocity(btSoftBody::Node& node, const btVector3& velocity) {
  node.m_v = velocity;
  node.m_vn = velocity;
}

/// A large triangle in the plane y = 0, and three nodes of a small one below or above it. Nodes 0, 1, 2 and 3, 4, 5.
std::vector<btVector3> triangleAndSmallOne(double height) {
  return {at(-1, 0, -1),          at(1, 0, -1),          at(0, 0, 1),
          at(-0.05, height, 0.0), at(0.05, height, 0.0), at(0, height, 0.0625)};
}

/// Two triangles of one body, each free to move as it likes.
class TwoTriangles {
 public:
  TwoTriangles(WorldKind kind, std::vector<btVector3> positions, CollisionAudit::Parameters parameters = {})
      : m_scene(kind, kNoGravity,
                triangles(std::move(positions), std::vector<btScalar>(6, real(0.01)), {{{0, 1, 2}}, {{3, 4, 5}}})) {
    m_scene.body().m_cfg.collisions = 0;
    parameters.onPassage = [this](const Passage& passage) { m_events.push_back(passage); };
    m_audit = &m_scene.cloth().add<CollisionAudit>(parameters);
  }

  void move(std::initializer_list<int> nodes, const btVector3& velocity) {
    for (const int node : nodes) setNodeVelocity(m_scene.node(node), velocity);
  }
  void step(int count) { m_scene.step(count, kDt); }
  ClothScene& scene() { return m_scene; }
  CollisionAudit& audit() { return *m_audit; }
  const std::vector<Passage>& events() const { return m_events; }

 private:
  ClothScene m_scene;
  std::vector<Passage> m_events;
  CollisionAudit* m_audit = nullptr;
};

/// The edges of a body's faces, each once.
std::set<std::pair<int, int>> edgesOf(const btSoftBody& body) {
  std::set<std::pair<int, int>> edges;
  for (int f = 0; f < body.m_faces.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int a = static_cast<int>(body.m_faces[f].m_n[k] - &body.m_nodes[0]);
      const int b = static_cast<int>(body.m_faces[f].m_n[(k + 1) % 3] - &body.m_nodes[0]);
      edges.insert(std::minmax(a, b));
    }
  }
  return edges;
}

bool crossSeenFromAbove(const btSoftBody& body, const std::pair<int, int>& e, const std::pair<int, int>& f) {
  const auto side = [&body](const std::pair<int, int>& edge, int node) {
    const btVector3 along = body.m_nodes[edge.second].m_x - body.m_nodes[edge.first].m_x;
    const btVector3 to = body.m_nodes[node].m_x - body.m_nodes[edge.first].m_x;
    return along.x() * to.z() - along.z() * to.x() > 0;
  };
  return side(e, f.first) != side(e, f.second) && side(f, e.first) != side(f, e.second);
}

/// Edges among the first `still` nodes that cross others when seen from above.
int crossingsSeenFromAbove(const btSoftBody& body, int still) {
  int crossings = 0;
  for (const auto& e : edgesOf(body)) {
    for (const auto& f : edgesOf(body)) {
      const bool areApart = e.first != f.first && e.first != f.second && e.second != f.first && e.second != f.second;
      if (e.second < still && f.second >= still && areApart && crossSeenFromAbove(body, e, f)) ++crossings;
    }
  }
  return crossings;
}

// Three vertices go through the inside of a face in different substeps, edges meet nothing.
TEST_IN_EVERY_WORLD(AuditInEveryWorld, CountsEachVertexThatGoesThroughAFaceOnce) {
  TwoTriangles two(GetParam(), triangleAndSmallOne(-0.1));
  two.move({3, 4, 5}, at(0, 2, 0));
  two.step(40);
  two.audit().look();
  EXPECT_EQ(two.audit().totals().vertexFace, 3);
  EXPECT_EQ(two.audit().totals().edgeEdge, 0);
  std::set<int> vertices;
  for (const Passage& passage : two.events()) {
    EXPECT_EQ(passage.pair, Pair::vertexFace);
    vertices.insert(passage.nodes[0]);
    EXPECT_EQ((std::set<int>{passage.nodes[1], passage.nodes[2], passage.nodes[3]}), (std::set<int>{0, 1, 2}));
    EXPECT_EQ(passage.first, &two.scene().body());
    EXPECT_EQ(passage.second, &two.scene().body());
  }
  EXPECT_EQ(vertices, (std::set<int>{3, 4, 5}));
}

// The face at y = 0, a vertex from y = -0.1 at 2 m/s: the contact is at 0.05 s, where the vertex is.
TEST_IN_EVERY_WORLD(AuditInEveryWorld, TellsWhenAndWhere) {
  TwoTriangles two(GetParam(), triangleAndSmallOne(-0.1));
  two.move({3, 4, 5}, at(0, 2, 0));
  two.step(40);
  ASSERT_EQ(two.events().size(), 3u);
  for (const Passage& passage : two.events()) {
    const btVector3 expected(triangleAndSmallOne(0)[std::size_t(passage.nodes[0])]);
    EXPECT_NEAR(passage.time, 0.05, 1e-5);
    EXPECT_LT((passage.position - expected).length(), real(1e-5));
    EXPECT_LT((passage.points[0] - expected).length(), real(1e-5));
  }
}

// Two upright triangles with an edge along x and one along z, which cross like scissors: one pair of edges meets.
TEST_IN_EVERY_WORLD(AuditInEveryWorld, CountsTwoEdgesThatCrossOnce) {
  TwoTriangles two(GetParam(),
                   {at(-1, 0, 0), at(1, 0, 0), at(0, -2, 0), at(0, 0.0625, -1), at(0, 0.0625, 1), at(0, 3, 0.25)});
  two.move({3, 4, 5}, at(0, -1, 0));
  two.step(20);
  two.audit().look();
  EXPECT_EQ(two.audit().totals().edgeEdge, 1);
  EXPECT_EQ(two.audit().totals().vertexFace, 0);
  ASSERT_EQ(two.events().size(), 1u);
  const Passage& passage = two.events()[0];
  EXPECT_EQ(passage.pair, Pair::edgeEdge);
  EXPECT_NEAR(passage.time, 0.0625, 1e-5);
  EXPECT_LT(passage.position.length(), real(1e-5));
  EXPECT_EQ(two.audit().totals().passages(), 1);
}

TEST_IN_EVERY_WORLD(AuditInEveryWorld, WhatTouchesAndReturnsIsNoPassage) {
  // 1/8 m at 1 m/s: the vertices are exactly in the plane after 32 substeps of 1/256 s.
  for (const double side : {-1.0, 1.0}) {
    TwoTriangles two(GetParam(), triangleAndSmallOne(side * 0.125));
    two.move({3, 4, 5}, at(0, -side, 0));
    two.step(32);
    EXPECT_EQ(two.scene().node(3).m_x.y(), 0) << "it touches";
    two.move({3, 4, 5}, at(0, side, 0));
    two.step(20);
    two.audit().look();
    EXPECT_EQ(two.audit().totals().passages(), 0) << "side " << side;
  }
}

TEST_IN_EVERY_WORLD(AuditInEveryWorld, WhatStopsInThePlaneAndGoesOnIsOnePassagePerVertex) {
  for (const double side : {-1.0, 1.0}) {
    TwoTriangles two(GetParam(), triangleAndSmallOne(side * 0.125));
    two.move({3, 4, 5}, at(0, -side, 0));
    two.step(32);
    two.move({3, 4, 5}, at(0, 0, 0));
    two.step(5);
    EXPECT_EQ(two.audit().totals().passages(), 0);
    two.move({3, 4, 5}, at(0, -side, 0));
    two.step(5);
    EXPECT_EQ(two.audit().totals().vertexFace, 3) << "side " << side;
    EXPECT_EQ(two.audit().totals().edgeEdge, 0) << "side " << side;
  }
}

TEST_IN_EVERY_WORLD(AuditInEveryWorld, ThereAndBackIsTwoPassages) {
  TwoTriangles two(GetParam(), triangleAndSmallOne(-0.1));
  two.move({3, 4, 5}, at(0, 2, 0));
  two.step(30);
  two.move({3, 4, 5}, at(0, -2, 0));
  two.step(30);
  two.audit().look();
  EXPECT_EQ(two.audit().totals().vertexFace, 6);
}

// Beside the face the side changes, too.
TEST_IN_EVERY_WORLD(AuditInEveryWorld, WhatPassesBesideIsNoPassage) {
  std::vector<btVector3> positions = triangleAndSmallOne(-0.1);
  for (std::size_t i = 3; i < 6; ++i) positions[i] += at(0.9, 0, 0.5);
  TwoTriangles two(GetParam(), positions);
  two.move({3, 4, 5}, at(0, 2, 0));
  two.step(40);
  two.audit().look();
  EXPECT_EQ(two.audit().totals().passages(), 0);
}

TEST_IN_EVERY_WORLD(AuditInEveryWorld, SelfCanBeTurnedOff) {
  CollisionAudit::Parameters parameters;
  parameters.self = false;
  TwoTriangles two(GetParam(), triangleAndSmallOne(-0.1), parameters);
  two.move({3, 4, 5}, at(0, 2, 0));
  two.step(40);
  EXPECT_EQ(two.audit().totals().passages(), 0);
}

// The last substep is seen by look(), and not once more by the next step.
TEST_IN_EVERY_WORLD(AuditInEveryWorld, LookSeesThePendingSubstepOnce) {
  TwoTriangles two(GetParam(), triangleAndSmallOne(-0.001));
  two.move({3, 4, 5}, at(0, 2, 0));
  two.step(1);
  EXPECT_EQ(two.audit().totals().passages(), 0);
  EXPECT_EQ(two.audit().totals().substeps, 0);
  two.audit().look();
  EXPECT_EQ(two.audit().totals().passages(), 3);
  EXPECT_EQ(two.audit().passages().size(), 3u);
  EXPECT_NEAR(two.events()[0].time, 0.0005, 1e-6);
  two.audit().look();
  two.step(3);
  two.audit().look();
  EXPECT_EQ(two.audit().totals().passages(), 3);
  EXPECT_EQ(two.audit().totals().substeps, 4);
  EXPECT_DOUBLE_EQ(two.audit().totals().seconds, 4 * kDt);
  EXPECT_NEAR(two.audit().totals().perSecond(), 3 / (4 * kDt), 1e-6);
}

TEST_IN_EVERY_WORLD(AuditInEveryWorld, AfterResetAMoveByHandIsNoMotion) {
  for (const bool resets : {false, true}) {
    TwoTriangles two(GetParam(), triangleAndSmallOne(-0.1));
    two.step(2);
    two.audit().look();
    for (const int i : {3, 4, 5}) two.scene().node(i).m_x += at(0, 0.2, 0);
    if (resets) two.audit().reset();
    two.step(2);
    EXPECT_EQ(two.audit().totals().passages(), resets ? 0 : 3);
  }
}

TEST_IN_EVERY_WORLD(AuditInEveryWorld, NodesThatAreNotFiniteAreLeftOut) {
  TwoTriangles two(GetParam(), triangleAndSmallOne(-0.1));
  two.step(2);
  two.audit().look();
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    two.scene().node(3).m_x = at(bad, 0, 0);
    two.audit().look();
    two.scene().node(4).m_x = at(0, bad, bad);
    two.audit().look();
  }
  EXPECT_EQ(two.audit().totals().passages(), 0);
  // And back: the jump from nowhere is no motion either.
  for (const int i : {3, 4, 5}) two.scene().node(i).m_x = triangleAndSmallOne(0.1)[std::size_t(i)];
  two.audit().look();
  EXPECT_EQ(two.audit().totals().passages(), 0);
  for (const int i : {3, 4, 5}) two.scene().node(i).m_x = triangleAndSmallOne(-0.1)[std::size_t(i)];
  two.audit().look();
  EXPECT_EQ(two.audit().totals().passages(), 3);
}

// A folded strip: the upper half, which is narrower, goes straight down through the lower one. Each of its vertices
// goes through one face, and the edges that pass are those that cross when seen from above.
TEST_IN_EVERY_WORLD(AuditInEveryWorld, AFoldedStripThatIsPulledThroughItself) {
  const int rows = 6;
  std::vector<btVector3> positions;
  std::vector<std::array<int, 3>> faces;
  for (int j = 0; j < rows; ++j) {  // the near half is wide
    positions.push_back(at(-1, 0, j));
    positions.push_back(at(1, 0, j));
  }
  for (int j = rows - 1; j >= 1; --j) {  // the far half is narrow, above it, and its rows lie between
    positions.push_back(at(-0.4, 0.5, j - 0.45));
    positions.push_back(at(0.3, 0.5, j - 0.45));
  }
  for (int i = 0; i + 3 < static_cast<int>(positions.size()); i += 2) {
    faces.push_back({{i, i + 1, i + 2}});
    faces.push_back({{i + 1, i + 3, i + 2}});
  }
  const std::vector<btScalar> masses(positions.size(), real(0.01));
  ClothScene scene(GetParam(), kNoGravity, triangles(positions, masses, faces));
  scene.body().m_cfg.collisions = 0;
  CollisionAudit& audit = scene.cloth().add<CollisionAudit>();
  scene.step(1, kDt);
  audit.look();
  for (int i = 2 * rows; i < static_cast<int>(positions.size()); ++i) scene.node(i).m_x += at(0, -1, 0);
  audit.look();
  EXPECT_EQ(audit.totals().vertexFace, 2 * (rows - 1));
  EXPECT_GT(audit.totals().edgeEdge, 4 * (rows - 1));
  EXPECT_EQ(audit.totals().edgeEdge, crossingsSeenFromAbove(scene.body(), 2 * rows));
}

}  // namespace
}  // namespace wetcloth_test::collision_audit_test
