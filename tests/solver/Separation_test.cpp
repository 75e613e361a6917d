// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/Separation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

namespace wetcloth_test::separation_test {
namespace {

using wetcloth::gapAlong;
using wetcloth::Separation;
using wetcloth::separationOfEdges;
using wetcloth::separationOfVertexAndFace;
using wetcloth::turnApart;

struct Four {
  double node[4][3];
};

enum class Kind { any, parallel, degenerate, thin };

class Separations : public testing::TestWithParam<Kind> {
 protected:
  double number() { return m_numbers(m_random); }
  Four fourNodes(int first) {
    Four four;
    for (auto& node : four.node) {
      for (double& x : node) x = number();
    }
    const int last = first == 1 ? 1 : 2;  // the first node of the second part
    for (int axis = 0; axis < 3; ++axis) {
      double(&n)[4][3] = four.node;
      if (GetParam() == Kind::degenerate) n[3][axis] = n[last][axis];  // a face is an edge, an edge a point
      if (GetParam() == Kind::thin) n[3][axis] = n[last][axis] + 1e-9 * n[3][axis];
      if (GetParam() != Kind::parallel) continue;
      if (first == 1) {
        n[3][axis] = 2 * n[2][axis] - n[1][axis];  // on a line
      } else {
        n[3][axis] = n[2][axis] + 0.7 * (n[1][axis] - n[0][axis]);
      }
    }
    return four;
  }

 private:
  std::mt19937 m_random{11};
  std::uniform_real_distribution<double> m_numbers{-1, 1};
};

double distanceAt(const Four& four, const double (&weights)[4]) {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    double x = 0;
    for (int k = 0; k < 4; ++k) x += weights[k] * four.node[k][axis];
    sum += x * x;
  }
  return std::sqrt(sum);
}

// The smallest distance between places on a grid of kSamples numbers each.
double sampled(const Four& four, int first) {
  constexpr int kSamples = 40;
  double least = HUGE_VAL;
  for (int i = 0; i <= kSamples; ++i) {
    for (int j = 0; j <= kSamples; ++j) {
      const double s = double(i) / kSamples;
      const double t = double(j) / kSamples;
      if (first == 1 && s + t > 1) continue;
      const double vertexFace[4] = {1, -(1 - s - t), -s, -t};
      const double edges[4] = {1 - s, s, -(1 - t), -t};
      least = std::min(least, first == 1 ? distanceAt(four, vertexFace) : distanceAt(four, edges));
    }
  }
  return least;
}

Separation separationOf(const Four& four, int first) {
  return first == 1 ? separationOfVertexAndFace(four.node) : separationOfEdges(four.node);
}

void expectSound(const Four& four, int first) {
  const Separation found = separationOf(four, first);
  const double brute = sampled(four, first);
  EXPECT_LE(found.distance, brute + 1e-12);
  EXPECT_GE(found.distance, brute - 2.5 * 3.5 / 40) << "a place is within a sample of it";
  double sums[2] = {0, 0};
  for (int k = 0; k < 4; ++k) {
    const double share = k < first ? found.weights[k] : -found.weights[k];
    EXPECT_GE(share, -1e-12);
    EXPECT_LE(share, 1 + 1e-12);
    sums[k < first ? 0 : 1] += share;
  }
  EXPECT_NEAR(sums[0], 1, 1e-12);
  EXPECT_NEAR(sums[1], 1, 1e-12);
  EXPECT_NEAR(distanceAt(four, found.weights), found.distance, 1e-9);
  if (found.distance < 1e-6) return;
  double length = 0;
  double along = 0;
  for (int axis = 0; axis < 3; ++axis) {
    length += found.normal[axis] * found.normal[axis];
    for (int k = 0; k < 4; ++k) along += found.normal[axis] * found.weights[k] * four.node[k][axis];
  }
  EXPECT_NEAR(length, 1, 1e-12);
  EXPECT_NEAR(along, found.distance, 1e-9) << "from the second part to the first";
  int low = -1;
  int high = -1;
  const double gap = gapAlong(found.normal, four.node, first, low, high);
  EXPECT_NEAR(gap, found.distance, 1e-6) << "the nearest places of convex parts lie on two parallel planes";
}

TEST_P(Separations, AreWhatSamplingFinds) {
  for (const int first : {1, 2}) {
    for (int turn = 0; turn < 300; ++turn) {
      const Four four = fourNodes(first);
      expectSound(four, first);
      if (HasFailure()) {
        for (const auto& node : four.node) ADD_FAILURE() << node[0] << ' ' << node[1] << ' ' << node[2];
        return;
      }
    }
  }
}

// All turns of a face's nodes, an edge's ends and two edges are the same parts.
TEST_P(Separations, DoNotDependOnTheOrder) {
  for (int turn = 0; turn < 300; ++turn) {
    const Four face = fourNodes(1);
    Four turned = face;
    for (int axis = 0; axis < 3; ++axis) {
      turned.node[1][axis] = face.node[3][axis];
      turned.node[2][axis] = face.node[1][axis];
      turned.node[3][axis] = face.node[2][axis];
    }
    EXPECT_NEAR(separationOf(face, 1).distance, separationOf(turned, 1).distance, 1e-9);
    const Four edges = fourNodes(2);
    for (int axis = 0; axis < 3; ++axis) {
      turned.node[0][axis] = edges.node[3][axis];
      turned.node[1][axis] = edges.node[2][axis];
      turned.node[2][axis] = edges.node[0][axis];
      turned.node[3][axis] = edges.node[1][axis];
    }
    EXPECT_NEAR(separationOf(edges, 2).distance, separationOf(turned, 2).distance, 1e-9);
  }
}

std::string nameOfKind(const testing::TestParamInfo<Kind>& test) {
  const char* const names[] = {"any", "parallel", "degenerate", "thin"};
  return names[int(test.param)];
}
INSTANTIATE_TEST_SUITE_P(, Separations, testing::Values(Kind::any, Kind::parallel, Kind::degenerate, Kind::thin),
                         nameOfKind);

TEST(Separation, OfPartsThatMeetIsZero) {
  const double onFace[4][3] = {{0.25, 0.25, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_EQ(separationOfVertexAndFace(onFace).distance, 0);
  const double crossing[4][3] = {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}};
  EXPECT_EQ(separationOfEdges(crossing).distance, 0);
  const double points[4][3] = {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}};
  EXPECT_EQ(separationOfVertexAndFace(points).distance, 0);
  EXPECT_EQ(separationOfEdges(points).distance, 0);
}

TEST(Separation, OfAVertexAboveAFace) {
  const double nodes[4][3] = {{0.25, 0.25, 0.5}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const Separation found = separationOfVertexAndFace(nodes);
  EXPECT_DOUBLE_EQ(found.distance, 0.5);
  EXPECT_DOUBLE_EQ(found.normal[2], 1);
  EXPECT_DOUBLE_EQ(found.weights[0], 1);
  EXPECT_DOUBLE_EQ(found.weights[1], -0.5);
  EXPECT_DOUBLE_EQ(found.weights[2], -0.25);
}

// By the definition: the lowest node of the first part above the highest one of the second.
// The difference of two places that are 1e-11 m apart is known to five digits: across it the far corners of parts of
// 0.1 m are on the wrong side.
TEST(Separation, PartsWhoseCornersNearlyTouchAreToldApart) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-1, 1);
  int turned = 0;
  for (int turn = 0; turn < 200; ++turn) {
    for (const int first : {1, 2}) {
      // Both are nearly in a plane across d, the first above and the second below it.
      double d[3] = {number(random), number(random), 2};
      const double length = std::hypot(d[0], d[1], d[2]);
      for (double& x : d) x /= length;
      double nodes[4][3];
      for (int node = 0; node < 4; ++node) {
        const double x = node == 0 || node == first ? 0.02 : 0.1 * number(random);
        const double y = node == 0 || node == first ? 0.03 : 0.1 * number(random);
        const double height = (node < first ? 1 : -1) * (node == 0 || node == first ? 5e-12 : 1e-11);
        nodes[node][0] = 0.3 + x * d[2] + height * d[0];
        nodes[node][1] = 0.3 + y * d[2] + height * d[1];
        nodes[node][2] = 0.3 - x * d[0] - y * d[1] + height * d[2];
      }
      Separation separation = first == 1 ? separationOfVertexAndFace(nodes) : separationOfEdges(nodes);
      int low = 0, high = 0;
      if (gapAlong(separation.normal, nodes, first, low, high) > 0.9 * separation.distance) continue;
      ++turned;
      turnApart(nodes, first, separation);
      EXPECT_GT(gapAlong(separation.normal, nodes, first, low, high), 0.5 * separation.distance) << first;
      EXPECT_NEAR(std::hypot(separation.normal[0], separation.normal[1], separation.normal[2]), 1, 1e-12);
    }
  }
  EXPECT_GT(turned, 20);
}

TEST(Separation, AGapIsBetweenTheNearestNodes) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int turn = 0; turn < 1000; ++turn) {
    const int first = 1 + turn % 2;
    double nodes[4][3];
    double normal[3];
    for (auto& node : nodes) {
      for (double& x : node) x = number(random);
    }
    for (double& x : normal) x = number(random);
    const double length = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
    for (double& x : normal) x /= length;
    double heights[4];
    for (int k = 0; k < 4; ++k) {
      heights[k] = nodes[k][0] * normal[0] + nodes[k][1] * normal[1] + nodes[k][2] * normal[2];
    }
    const double lowest = *std::min_element(heights, heights + first);
    const double highest = *std::max_element(heights + first, heights + 4);
    int low = -1;
    int high = -1;
    const double gap = gapAlong(normal, nodes, first, low, high);
    if (lowest - highest > 1e-14) {
      EXPECT_NEAR(gap, lowest - highest, 1e-14);
    } else if (lowest - highest < -1e-14) {
      EXPECT_LE(gap, 0);
    }
    ASSERT_TRUE(0 <= low && low < first && first <= high && high < 4);
    EXPECT_NEAR(heights[low], lowest, 1e-14);
    EXPECT_NEAR(heights[high], highest, 1e-14);
  }
}

}  // namespace
}  // namespace wetcloth_test::separation_test
