// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/SupportPlanes.h"

#include "bullet_wetcloth/solver/Separation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace wetcloth_test::support_planes_test {
namespace {

using wetcloth::GuardMesh;
using wetcloth::GuardNodes;
using wetcloth::SupportPlanes;

constexpr btScalar kNear = btScalar(0.002);
constexpr btScalar kSlack = btScalar(0.001);

// A box of 0.2 m that turns and goes on, and after its corners the three of a face of a cloth.
class BoxAndFace {
 public:
  BoxAndFace() {
    for (int k = 0; k < 8; ++k) {
      m_corners.push_back(btVector3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1) * btScalar(0.1));
    }
    const std::array<int, 4> sides[] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1},
                                        {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};
    // The two faces of a side do not come one after the other, as where faces were halved.
    for (const auto& side : sides) mesh.faces.push_back({{side[0], side[1], side[2]}});
    for (const auto& side : sides) mesh.faces.push_back({{side[0], side[2], side[3]}});
    mesh.isOfBodies = true;
    mesh.shells = {{0, 8, 0, 12}};
    nodes.expected.resize(11);
  }
  void move(const btTransform& from, const btTransform& to) {
    for (int k = 0; k < 8; ++k) set(k, from * m_corners[std::size_t(k)], to * m_corners[std::size_t(k)]);
  }
  void set(int node, const btVector3& start, const btVector3& end) {
    GuardNodes::Way& way = nodes.expected[std::size_t(node)];
    for (int axis = 0; axis < 3; ++axis) {
      way.start.at[axis] = start[axis];
      way.end.at[axis] = end[axis];
    }
    way.start.at[3] = way.end.at[3] = kSlack;
  }
  bool isBeyond() const {
    SupportPlanes planes;
    planes.begin(nodes, kNear);
    const int face[3] = {8, 9, 10};
    return planes.areBeyond(face, 3, mesh, 0, 0);
  }
  // Of the face and the box, at this share of the way, with each node anywhere within its slack.
  template <class Number>
  double distance(double share, const Number& number) const {
    double at[11][3];
    for (std::size_t k = 0; k < 11; ++k) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double start = double(nodes.expected[k].start.at[axis]);
        at[k][axis] = start + share * (double(nodes.expected[k].end.at[axis]) - start) + double(kSlack) * number();
      }
    }
    double least = HUGE_VAL;
    const auto measure = [&](int first, int a, int b, int c, int d) {
      double places[4][3];
      const int node[4] = {a, b, c, d};
      for (std::size_t k = 0; k < 4; ++k) std::copy(at[node[k]], at[node[k]] + 3, places[k]);
      const wetcloth::Separation separation =
          first == 1 ? wetcloth::separationOfVertexAndFace(places) : wetcloth::separationOfEdges(places);
      least = std::min(least, separation.distance);
    };
    for (int corner = 0; corner < 8; ++corner) measure(1, corner, 8, 9, 10);
    for (const GuardMesh::Face& face : mesh.faces) {
      for (int k = 0; k < 3; ++k) {
        measure(1, 8 + k, face.node[0], face.node[1], face.node[2]);
        for (int i = 0; i < 3; ++i) measure(2, 8 + k, 8 + (k + 1) % 3, face.node[i], face.node[(i + 1) % 3]);
      }
    }
    return least;
  }

  GuardMesh mesh;
  GuardNodes nodes;

 private:
  std::vector<btVector3> m_corners;
};

// Along one normal each side may be nearer by sqrt(3) of its slack, and they are to be farther apart than that.
TEST(SupportPlanes, AFaceIsBeyondFromSlacksAndNearnessOn) {
  BoxAndFace scene;
  scene.move(btTransform::getIdentity(), btTransform::getIdentity());
  const btScalar needed = kNear + 2 * std::sqrt(btScalar(3)) * kSlack;
  for (const btScalar factor : {btScalar(0.99), btScalar(1.01)}) {
    const btScalar height = btScalar(0.1) + factor * needed;
    scene.set(8, btVector3(0, height, 0), btVector3(0, height, 0));
    scene.set(9, btVector3(btScalar(0.05), height, 0), btVector3(btScalar(0.05), height, 0));
    scene.set(10, btVector3(0, height, btScalar(0.05)), btVector3(0, height, btScalar(0.05)));
    EXPECT_EQ(scene.isBeyond(), factor > 1);
  }
}

TEST(SupportPlanes, WhatIsBeyondDoesNotComeNear) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto number = [&] { return uniform(random); };
  const auto vector = [&](double size) {
    return btVector3(btScalar(size * number()), btScalar(size * number()), btScalar(size * number()));
  };
  int beyond = 0;
  for (int turn = 0; turn < 3000; ++turn) {
    BoxAndFace scene;
    const btQuaternion pose(vector(1) + btVector3(0, 0, 2), btScalar(3 * number()));
    const btQuaternion turned = btQuaternion(vector(1) + btVector3(0, 2, 0), btScalar(0.3 * number())) * pose;
    scene.move(btTransform(pose), btTransform(turned, vector(0.02)));
    const btVector3 place = vector(0.25);
    for (int k = 8; k < 11; ++k) {
      const btVector3 start = place + vector(0.03);
      scene.set(k, start, start + vector(0.02));
    }
    if (!scene.isBeyond()) continue;
    ++beyond;
    for (int moment = 0; moment <= 5; ++moment) EXPECT_GT(scene.distance(moment / 5.0, number), double(kNear));
  }
  EXPECT_GT(beyond, 300);
}

}  // namespace
}  // namespace wetcloth_test::support_planes_test
