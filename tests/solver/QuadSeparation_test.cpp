// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/QuadSeparation.h"

#include "bullet_wetcloth/solver/Separation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

namespace wetcloth_test::quad_separation_test {
namespace {

using wetcloth::bitsOf;
using wetcloth::Quad;
using wetcloth::QuadPlaces;
using wetcloth::QuadSeparation;
using wetcloth::Separation;

struct Four {
  btScalar node[4][3];
};

constexpr double kEpsilon = static_cast<double>(std::numeric_limits<btScalar>::epsilon());

QuadSeparation separationOf(const Four (&fours)[4], int first) {
  QuadPlaces places;
  for (int node = 0; node < 4; ++node) {
    for (int axis = 0; axis < 3; ++axis) {
      for (int k = 0; k < 4; ++k) places[node][axis][k] = fours[k].node[node][axis];
    }
    places[node][3] = Quad{};
  }
  return first == 1 ? wetcloth::separationOf<1>(places) : wetcloth::separationOf<2>(places);
}

QuadSeparation separationOf(const Four& four, int first) {
  const Four fours[4] = {four, four, four, four};
  return separationOf(fours, first);
}

Separation exactly(const Four& four, int first) {
  double nodes[4][3];
  for (int node = 0; node < 4; ++node) {
    for (int axis = 0; axis < 3; ++axis) nodes[node][axis] = static_cast<double>(four.node[node][axis]);
  }
  return first == 1 ? wetcloth::separationOfVertexAndFace(nodes) : wetcloth::separationOfEdges(nodes);
}

bool isGood(const QuadSeparation& found, int k) { return (found.isGood >> k & 1) != 0; }

enum class Kind { any, near, parallel, nearlyParallel, degenerate, thin, farAway };

class QuadSeparations : public testing::TestWithParam<Kind> {
 protected:
  Four next(int first) {
    Four four;
    for (auto& node : four.node) {
      for (btScalar& x : node) x = number();
    }
    const int last = first == 1 ? 1 : 2;  // the first node of the second part
    const btScalar height = btScalar(0.01) * number();
    for (int axis = 0; axis < 3; ++axis) {
      btScalar(&n)[4][3] = four.node;
      const auto other = [&](btScalar share) {
        return first == 1 ? n[1][axis] + 2 * (n[2][axis] - n[1][axis]) + share * number()  // on a line
                          : n[2][axis] + btScalar(0.7) * (n[1][axis] - n[0][axis]) + share * number();
      };
      switch (GetParam()) {
        case Kind::any: break;
        case Kind::near: n[first == 1 ? 0 : 1][axis] = nearTo(four, first, axis) + height; break;
        case Kind::parallel: n[3][axis] = other(0); break;
        case Kind::nearlyParallel: n[3][axis] = other(btScalar(1e-3)); break;
        case Kind::degenerate: n[3][axis] = n[last][axis]; break;
        case Kind::thin: n[3][axis] = n[last][axis] + btScalar(1e-4) * number(); break;
        case Kind::farAway:
          for (auto& node : n) node[axis] += 1000;
      }
    }
    return four;
  }
  // How far from a sound result rounding may lead.
  double tolerance() const { return (GetParam() == Kind::farAway ? 1e4 : 100) * kEpsilon; }
  btScalar number() { return m_numbers(m_random); }

 private:
  // So that the first part is near the middle of the second.
  static btScalar nearTo(const Four& four, int first, int axis) {
    const btScalar(&n)[4][3] = four.node;
    if (first == 1) return (n[1][axis] + n[2][axis] + n[3][axis]) / 3;
    return n[2][axis] + n[3][axis] - n[0][axis];  // the middle of both is one
  }
  std::mt19937 m_random{7};
  std::uniform_real_distribution<btScalar> m_numbers{-1, 1};
};

void expectSound(const QuadSeparation& found, int k, const Four& four, int first, double tolerance) {
  double sums[2] = {0, 0};
  double along = 0;
  double length2 = 0;
  for (int node = 0; node < 4; ++node) {
    const double weight = static_cast<double>(found.weights[node][k]);
    const double share = node < first ? weight : -weight;
    EXPECT_GE(share, -tolerance);
    EXPECT_LE(share, 1 + tolerance);
    sums[node < first ? 0 : 1] += share;
  }
  EXPECT_NEAR(sums[0], 1, tolerance);
  EXPECT_NEAR(sums[1], 1, tolerance);
  double normal[3];
  double nodes[4][3];
  for (int axis = 0; axis < 3; ++axis) {
    normal[axis] = static_cast<double>(found.normal[axis][k]);
    length2 += normal[axis] * normal[axis];
    for (int node = 0; node < 4; ++node) {
      nodes[node][axis] = static_cast<double>(four.node[node][axis]);
      along += normal[axis] * static_cast<double>(found.weights[node][k]) * (nodes[node][axis] - nodes[0][axis]);
    }
  }
  EXPECT_NEAR(length2, 1, 64 * kEpsilon);
  EXPECT_NEAR(along, static_cast<double>(found.distance[k]), 0.011 * along + tolerance);
  int low = 0, high = 0;
  EXPECT_NEAR(wetcloth::gapAlong(normal, nodes, first, low, high), static_cast<double>(found.gap[k]), tolerance);
}

TEST_P(QuadSeparations, AreNearlyTheExactOnesWhereTheyAreGood) {
  for (const int first : {1, 2}) {
    int good = 0;
    for (int turn = 0; turn < 500; ++turn) {
      const Four fours[4] = {next(first), next(first), next(first), next(first)};
      const QuadSeparation found = separationOf(fours, first);
      for (int k = 0; k < 4; ++k) {
        if (!isGood(found, k) || !(found.gap[k] > btScalar(64) * static_cast<btScalar>(tolerance()))) continue;
        ++good;
        const double distance = exactly(fours[k], first).distance;
        EXPECT_LE(static_cast<double>(found.gap[k]), distance + tolerance());
        EXPECT_NEAR(static_cast<double>(found.distance[k]), distance, 0.0102 * distance + tolerance());
        expectSound(found, k, fours[k], first, tolerance());
      }
      if (HasFailure()) return;
    }
    const bool mayBeDoubtful = GetParam() == Kind::degenerate || GetParam() == Kind::farAway;
    EXPECT_GT(good, mayBeDoubtful ? 0 : 1000) << "most are beyond doubt, with a first part of " << first;
  }
}

// All turns of a face's nodes, an edge's ends and two edges are the same parts.
TEST_P(QuadSeparations, DoNotDependOnTheOrder) {
  const int orders[2][3][4] = {{{0, 2, 3, 1}, {0, 3, 1, 2}, {0, 1, 3, 2}}, {{1, 0, 2, 3}, {0, 1, 3, 2}, {2, 3, 0, 1}}};
  for (const int first : {1, 2}) {
    for (int turn = 0; turn < 500; ++turn) {
      const Four four = next(first);
      Four fours[4] = {four, four, four, four};
      for (int k = 1; k < 4; ++k) {
        for (int node = 0; node < 4; ++node) {
          std::copy_n(four.node[orders[first - 1][k - 1][node]], 3, fours[k].node[node]);
        }
      }
      const QuadSeparation found = separationOf(fours, first);
      for (int k = 1; k < 4; ++k) {
        if (!isGood(found, 0) || !isGood(found, k)) continue;
        EXPECT_NEAR(found.distance[k], found.distance[0], 0.0102 * found.distance[0] + tolerance());
      }
    }
  }
}

TEST_P(QuadSeparations, DoNotDependOnTheirNeighbours) {
  for (const int first : {1, 2}) {
    for (int turn = 0; turn < 100; ++turn) {
      const Four fours[4] = {next(first), next(first), next(first), next(first)};
      const QuadSeparation together = separationOf(fours, first);
      for (int k = 0; k < 4; ++k) {
        const QuadSeparation alone = separationOf(fours[k], first);
        ASSERT_EQ(isGood(alone, 0), isGood(together, k));
        if (!isGood(alone, 0)) continue;
        ASSERT_EQ(alone.gap[0], together.gap[k]);
        for (int axis = 0; axis < 3; ++axis) ASSERT_EQ(alone.normal[axis][0], together.normal[axis][k]);
        for (int node = 0; node < 4; ++node) ASSERT_EQ(alone.weights[node][0], together.weights[node][k]);
      }
    }
  }
}

// In any of twelve numbers.
TEST_P(QuadSeparations, AreNotGoodWhereSomethingIsNotANumber) {
  for (const btScalar bad : {std::numeric_limits<btScalar>::quiet_NaN(), std::numeric_limits<btScalar>::infinity()}) {
    for (const int first : {1, 2}) {
      for (int which = 0; which < 12; ++which) {
        Four four = next(first);
        four.node[which / 3][which % 3] = bad;
        EXPECT_EQ(separationOf(four, first).isGood, 0U) << which;
      }
    }
  }
}

std::string nameOfKind(const testing::TestParamInfo<Kind>& test) {
  const char* const names[] = {"any", "near", "parallel", "nearlyParallel", "degenerate", "thin", "farAway"};
  return names[int(test.param)];
}
INSTANTIATE_TEST_SUITE_P(, QuadSeparations,
                         testing::Values(Kind::any, Kind::near, Kind::parallel, Kind::nearlyParallel, Kind::degenerate,
                                         Kind::thin, Kind::farAway),
                         nameOfKind);

TEST(QuadSeparation, OfPartsThatMeetIsNotGoodOrHasNoGap) {
  const Four onFace = {{{btScalar(0.25), btScalar(0.25), 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  const Four crossing = {{{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}}};
  const Four points = {{{1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}}};
  for (const int first : {1, 2}) {
    for (const Four& four : {first == 1 ? onFace : crossing, points}) {
      const QuadSeparation found = separationOf(four, first);
      EXPECT_TRUE(!isGood(found, 0) || !(found.gap[0] > 0));
    }
  }
}

TEST(QuadSeparation, OfAVertexAboveAFace) {
  const Four four = {{{btScalar(0.25), btScalar(0.25), btScalar(0.5)}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  const QuadSeparation found = separationOf(four, 1);
  EXPECT_EQ(found.isGood, 15U);
  EXPECT_EQ(found.distance[0], btScalar(0.5));
  EXPECT_EQ(found.gap[0], btScalar(0.5));
  EXPECT_EQ(found.normal[2][0], 1);
  EXPECT_EQ(found.weights[0][0], 1);
  EXPECT_EQ(found.weights[1][0], btScalar(-0.5));
  EXPECT_EQ(found.weights[2][0], btScalar(-0.25));
}

// Lengths whose squares underflow give no direction.
TEST(QuadSeparation, IsNotGoodWhereSquaresUnderflow) {
  const btScalar tiny = std::sqrt(std::numeric_limits<btScalar>::min()) * btScalar(1e-3);
  Four four = {{{tiny / 4, tiny / 4, tiny}, {0, 0, 0}, {tiny, 0, 0}, {0, tiny, 0}}};
  EXPECT_EQ(separationOf(four, 1).isGood, 0U);
  Four edges = {{{-tiny, 0, tiny}, {tiny, 0, tiny}, {0, -tiny, 0}, {0, tiny, 0}}};
  EXPECT_EQ(separationOf(edges, 2).isGood, 0U);
}

}  // namespace
}  // namespace wetcloth_test::quad_separation_test
