// SPDX-License-Identifier: Zlib
// The exact answer against an oracle that shares nothing with it, against the published answers, and against what can
// be said by hand about every degenerate case.

#include <bullet_wetcloth/collision/ExactContact.h>

#include "tests/collision/ExactOracle.h"
#include "tests/support/QueryData.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <utility>
#include <vector>

namespace wetcloth_test::exact_contact_test {
namespace {

using wetcloth::collision::Contact;
using wetcloth::collision::exactContact;
using wetcloth::collision::Pair;
using Query = wetcloth::collision::Query<double>;
using oracle::Rational;
using oracle::Root;

constexpr double kTolerance = 1e-6;
constexpr double kFinest = 1e-12;
constexpr Pair kPairs[] = {Pair::vertexFace, Pair::edgeEdge};

/// Returns whether there is a contact.
bool expectRight(Pair pair, const Query& query, double tolerance) {
  const Contact contact = exactContact(pair, query, tolerance);
  const std::vector<Root> times = oracle::Oracle(pair, query).contacts();
  EXPECT_EQ(contact.found, !times.empty());
  if (!contact.found || times.empty()) return !times.empty();
  EXPECT_GE(contact.time, 0);
  const Rational time(contact.time);
  const Rational latest = time + Rational(tolerance);
  const auto after = [](const Rational& t) { return oracle::Polynomial{-numerator(t), denominator(t)}; };
  EXPECT_TRUE(std::all_of(times.begin(), times.end(), [&](const Root& t) { return t.sign(after(time)) >= 0; }))
      << contact.time << " is too late";
  EXPECT_TRUE(std::any_of(times.begin(), times.end(), [&](const Root& t) { return t.sign(after(latest)) <= 0; }))
      << contact.time << " is too early";
  if (std::any_of(times.begin(), times.end(), [](const Root& t) { return t.sign({0, 1}) == 0; })) {
    EXPECT_EQ(contact.time, 0);
  }
  return true;
}

using Points = std::array<std::array<double, 3>, 4>;

Query moving(const Points& start, const Points& end) {
  Query query;
  for (int i = 0; i < 4; ++i) {
    for (int k = 0; k < 3; ++k) {
      query.start[i][k] = start[i][k];
      query.end[i][k] = end[i][k];
    }
  }
  return query;
}

template <class Change>
Query changed(Query query, Change change) {
  for (auto* points : {&query.start, &query.end}) {
    for (auto& point : *points)
      for (double& coordinate : point) coordinate = change(coordinate);
  }
  return query;
}

Query scaled(const Query& query, int exponent) {
  return changed(query, [&](double x) { return std::ldexp(x, exponent); });
}

Query reversed(Query query) {
  std::swap(query.start, query.end);
  return query;
}

/// Point i of the result is point order[i].
Query reordered(const Query& query, const std::array<int, 4>& order) {
  Query result;
  for (int i = 0; i < 4; ++i) {
    for (int k = 0; k < 3; ++k) {
      result.start[i][k] = query.start[order[i]][k];
      result.end[i][k] = query.end[order[i]][k];
    }
  }
  return result;
}

/// Integers small enough that contacts at vertices, on edges, in common planes and on common lines are frequent.
class Lattice {
 public:
  explicit Lattice(unsigned seed) : m_random(seed) {}
  int number(int largest) { return static_cast<int>(m_random() % static_cast<unsigned>(2 * largest + 1)) - largest; }
  Query query(int largest, int dimensions) {
    Query query = {};
    for (auto* points : {&query.start, &query.end}) {
      for (auto& point : *points)
        for (int k = 0; k < dimensions; ++k) point[k] = number(largest);
    }
    return query;
  }
  /// Each coordinate by chance one double up or down (0: hardly more than its neighbours).
  Query nudged(const Query& query) {
    return changed(query, [&](double x) {
      const int way = number(3);
      if (way > 1 || way < -1) return x;
      return x == 0 ? way * 0x1p-54 : std::nextafter(x, way * 10.0);
    });
  }

 private:
  std::mt19937 m_random;
};

/// Query count of the largest kind; the sanitizers are slow.
constexpr int kQueries = 200;

void expectRightOnLattice(int largest, int dimensions, int count, bool nudge = false) {
  Lattice lattice(20210701u + static_cast<unsigned>(10 * largest + dimensions));
  for (const Pair pair : kPairs) {
    int contacts = 0;
    for (int i = 0; i < count; ++i) {
      SCOPED_TRACE(testing::Message() << (pair == Pair::edgeEdge ? "ee " : "vf ") << i);
      Query query = lattice.query(largest, dimensions);
      if (nudge) query = lattice.nudged(query);
      contacts += expectRight(pair, query, i % 2 == 0 ? kTolerance : kFinest);
      if (testing::Test::HasFailure()) return;
    }
    EXPECT_GT(contacts, count / 50);
    EXPECT_LT(contacts, count);
  }
}

TEST(ExactContact, AgreesWithTheOracleInSpace) {
  expectRightOnLattice(1, 3, kQueries);
  expectRightOnLattice(3, 3, kQueries);
  expectRightOnLattice(1000, 3, kQueries / 2);
}

TEST(ExactContact, AgreesWithTheOracleInOnePlaneAllAlong) { expectRightOnLattice(2, 2, kQueries); }
TEST(ExactContact, AgreesWithTheOracleOnOneLineAllAlong) { expectRightOnLattice(4, 1, kQueries); }
TEST(ExactContact, AgreesWithTheOracleBesideDegeneracies) { expectRightOnLattice(1, 3, kQueries / 2, true); }
TEST(ExactContact, AgreesWithTheOracleBesideDegeneraciesInOnePlane) { expectRightOnLattice(1, 2, kQueries / 10, true); }

TEST(ExactContact, AgreesWithEveryPublishedAnswerAndWithTheOracleOnTheTime) {
  for (const char* collection : {"real", "cloth"}) {
    int wrong = 0;
    for (const auto& query : knownQueries(collection)) {
      SCOPED_TRACE(testing::Message() << collection << " " << query.id);
      wrong += exactContact(query.pair, query.points, kTolerance).found != query.meets;
      if (query.meets) expectRight(query.pair, query.points, kFinest);
    }
    EXPECT_EQ(wrong, 0) << collection;
  }
}

TEST(ExactContact, ReportsTheTimeWithinEveryTolerance) {
  for (const auto& query : knownQueries("real")) {
    if (!query.meets) continue;
    for (const double tolerance : {1.0, 0.3, 1e-3, kTolerance, 1e-9}) expectRight(query.pair, query.points, tolerance);
    EXPECT_EQ(exactContact(query.pair, query.points, 1e-3).where[0], 0);
  }
}

TEST(ExactContact, DoesNotDependOnTheOrderOfPointsTheDirectionOfTimeOrTheUnit) {
  const std::vector<std::array<int, 4>> faces = {{0, 1, 3, 2}, {0, 2, 1, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {0, 3, 2, 1}};
  const std::vector<std::array<int, 4>> edges = {{1, 0, 2, 3}, {0, 1, 3, 2}, {1, 0, 3, 2}, {2, 3, 0, 1}, {3, 2, 1, 0}};
  for (const auto& [id, scene, pair, meets, query] : knownQueries("real")) {
    SCOPED_TRACE(id);
    const double time = exactContact(pair, query, kFinest).time;
    for (const auto& order : pair == Pair::edgeEdge ? edges : faces) {
      const Contact contact = exactContact(pair, reordered(query, order), kFinest);
      EXPECT_EQ(contact.found, meets);
      EXPECT_NEAR(contact.time, time, 2 * kFinest);
    }
    EXPECT_EQ(exactContact(pair, reversed(query), kTolerance).found, meets);
    for (const int exponent : {-40, 200}) EXPECT_EQ(exactContact(pair, scaled(query, exponent), kFinest).time, time);
  }
}

TEST(ExactContact, DoesNotDependOnThePlace) {
  Lattice lattice(7);
  for (int i = 0; i < kQueries; ++i) {
    for (const Pair pair : kPairs) {
      const Query query = lattice.query(5, 3);
      const Query far = changed(query, [](double x) { return x + 0x1p52; });
      const Contact contact = exactContact(pair, query, kTolerance);
      EXPECT_EQ(exactContact(pair, far, kTolerance).found, contact.found);
      EXPECT_EQ(exactContact(pair, far, kTolerance).time, contact.time);
    }
  }
}

// --- every degenerate case by name; the triangle is (0,0,0) (1,0,0) (0,1,0) unless written out

constexpr double kInfinite = std::numeric_limits<double>::max();

void expectNone(Pair pair, const Query& query) {
  EXPECT_FALSE(exactContact(pair, query, kTolerance).found);
  EXPECT_FALSE(exactContact(pair, reversed(query), kTolerance).found);
  expectRight(pair, query, kTolerance);
}

void expectAt(double time, Pair pair, const Query& query) {
  for (const double tolerance : {kTolerance, kFinest}) {
    const Contact contact = exactContact(pair, query, tolerance);
    EXPECT_TRUE(contact.found);
    EXPECT_LE(contact.time, time);
    EXPECT_GE(contact.time, time - tolerance);
  }
  EXPECT_TRUE(exactContact(pair, reversed(query), kTolerance).found);
  expectRight(pair, query, kTolerance);
}

/// Point 0 moves, the others rest.
Query movingPoint(const std::array<double, 3>& from, const std::array<double, 3>& to,
                  const std::array<std::array<double, 3>, 3>& others = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}) {
  return moving({from, others[0], others[1], others[2]}, {to, others[0], others[1], others[2]});
}

/// The edge 0-1 moves by `way`, the edge 2-3 rests.
Query movingEdge(Points points, const std::array<double, 3>& way) {
  const Points start = points;
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 2; ++i) points[i][k] += way[k];
  return moving(start, points);
}

TEST(ExactContact, CoplanarAllAlong) {
  expectAt(0.5, Pair::vertexFace, movingPoint({-1, 0.25, 0}, {1, 0.25, 0}));
  expectAt(0.25, Pair::vertexFace, movingPoint({-1, -1, 0}, {3, 3, 0}));  // a corner first
  expectNone(Pair::vertexFace, movingPoint({-1, 2, 0}, {1, 2, 0}));
  expectNone(Pair::vertexFace, movingPoint({-1, 1, 0}, {1, 1.5, 0}));
  expectAt(0.5, Pair::edgeEdge, movingEdge({{{-1, 0, 0}, {0, 0, 0}, {1, -1, 0}, {1, 1, 0}}}, {2, 0, 0}));
  expectNone(Pair::edgeEdge, movingEdge({{{-1, 0, 0}, {0, 0, 0}, {1, 1, 0}, {1, 2, 0}}}, {2, 0, 0}));
}

TEST(ExactContact, DoubleRootThatTouchesAndItsNeighbours) {
  // The volume is -(t - 1/2)^2, and the point then inside the face.
  const Points start = {{{-0.25, 0.25, -0.25}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  const Points end = {{{0.75, 0.25, 0.5}, {0, 0, 0}, {1, 0, 1}, {0, 1, 0}}};
  expectAt(0.5, Pair::vertexFace, moving(start, end));
  Points start2 = start;
  Points end2 = end;
  start2[0][2] = std::nextafter(start2[0][2], -1);
  end2[0][2] = std::nextafter(end2[0][2], -1);
  expectNone(Pair::vertexFace, moving(start2, end2));
  start2[0][2] = std::nextafter(start[0][2], 1);
  end2[0][2] = std::nextafter(end[0][2], 1);
  const Contact early = exactContact(Pair::vertexFace, moving(start2, end2), kFinest);
  EXPECT_TRUE(early.found);
  EXPECT_NEAR(early.time, 0.5 - std::sqrt(0.75 * 0x1p-53), 1e-9);
  expectRight(Pair::vertexFace, moving(start2, end2), kFinest);
  // At 1/3, no double.
  Points third = start;
  for (int k = 0; k < 3; ++k) third[0][k] = start[0][k] + (start[0][k] - end[0][k]) / 2;
  for (int i = 1; i < 4; ++i) third[i][2] = start[i][2] + (start[i][2] - end[i][2]) / 2;
  expectRight(Pair::vertexFace, moving(third, end), kFinest);
  EXPECT_NEAR(exactContact(Pair::vertexFace, moving(third, end), kFinest).time, 2.0 / 3, kFinest);
}

TEST(ExactContact, TripleRoot) {
  const Points start = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const Points end = {{{0, 0, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}}};
  for (const Pair pair : kPairs) expectAt(0.5, pair, moving(start, end));
  // At 1/2 in one plane, but apart.
  const Points start2 = {{{0, 0, 0}, {1, 1, 3}, {0, 1, 2}, {1, 2, 4}}};
  const Points end2 = {{{0, 0, 0}, {-1, 1, 1}, {0, -1, 0}, {-1, 0, 2}}};
  expectNone(Pair::vertexFace, moving(start2, end2));
}

TEST(ExactContact, RootAtTheEnds) {
  const Query landing = movingPoint({0.25, 0.25, 1}, {0.25, 0.25, 0});
  expectAt(1, Pair::vertexFace, landing);
  EXPECT_EQ(exactContact(Pair::vertexFace, landing, kTolerance).time, 1);
  EXPECT_EQ(exactContact(Pair::vertexFace, reversed(landing), kTolerance).time, 0);
  const double above = std::numeric_limits<double>::denorm_min();
  expectNone(Pair::vertexFace, movingPoint({0.25, 0.25, 1}, {0.25, 0.25, above}));
  const Query edges = movingEdge({{{-1, 0, 1}, {1, 0, 1}, {0, -1, 0}, {0, 1, 0}}}, {0, 0, -1});
  expectAt(1, Pair::edgeEdge, edges);
  EXPECT_EQ(exactContact(Pair::edgeEdge, reversed(edges), kTolerance).time, 0);
  // Roots at 0, where they are apart, and at 1, where they meet.
  expectAt(1, Pair::vertexFace, movingPoint({2, 2, 0}, {0, 0, 0}, {{{0, 0, 0}, {1, 0, 0}, {0, 1, 1}}}));
}

TEST(ExactContact, ParallelEdges) {
  expectAt(0.5, Pair::edgeEdge, movingEdge({{{0, 0, 1}, {2, 0, 1}, {1, 0, 0}, {3, 0, 0}}}, {0, 0, -2}));
  expectNone(Pair::edgeEdge, movingEdge({{{0, 0, 1}, {2, 0, 1}, {3, 0, 0}, {4, 0, 0}}}, {0, 0, -2}));
  expectNone(Pair::edgeEdge, movingEdge({{{0, 0, 1}, {2, 0, 1}, {1, 0, 0}, {3, 0, 0}}}, {0, 1, -2}));
  // Parallel only when they meet, and then at a distance along their line, or beside each other.
  const Points start = {{{0, 0, 1}, {2, -1, 2}, {1, 0, 0}, {3, 0, 0}}};
  expectAt(0.5, Pair::edgeEdge, moving(start, {{{0, 0, -1}, {2, 1, -2}, {1, 0, 0}, {3, 0, 0}}}));
  const Points apart = {{{0, 0, 1}, {2, -1, 2}, {3, 0, 0}, {4, 0, 0}}};
  expectNone(Pair::edgeEdge, moving(apart, {{{0, 0, -1}, {2, 1, -2}, {3, 0, 0}, {4, 0, 0}}}));
  const Points beside = {{{0, 0, 1}, {2, -1, 2}, {1, 1, 0}, {3, 1, 0}}};
  expectNone(Pair::edgeEdge, moving(beside, {{{0, 0, -1}, {2, 1, -2}, {1, 1, 0}, {3, 1, 0}}}));
}

TEST(ExactContact, CollinearEdges) {
  expectAt(0.25, Pair::edgeEdge, movingEdge({{{0, 0, 0}, {1, 2, 3}, {2, 4, 6}, {3, 6, 9}}}, {4, 8, 12}));
  expectNone(Pair::edgeEdge, movingEdge({{{0, 0, 0}, {1, 2, 3}, {2, 4, 6}, {3, 6, 9}}}, {0.5, 1, 1.5}));
}

TEST(ExactContact, EdgesThatArePoints) {
  expectAt(0.5, Pair::edgeEdge, movingEdge({{{1, 0, 1}, {1, 0, 1}, {0, 0, 0}, {3, 0, 0}}}, {0, 0, -2}));
  expectNone(Pair::edgeEdge, movingEdge({{{4, 0, 1}, {4, 0, 1}, {0, 0, 0}, {3, 0, 0}}}, {0, 0, -2}));
  expectAt(0.5, Pair::edgeEdge, movingEdge({{{1, 1, 1}, {1, 1, 1}, {0, 0, 0}, {0, 0, 0}}}, {-2, -2, -2}));
  expectNone(Pair::edgeEdge, movingEdge({{{1, 1, 1}, {1, 1, 1}, {0, 0, 0}, {0, 0, 0}}}, {-2, -2, -1}));
}

TEST(ExactContact, FacesWithoutArea) {
  const std::array<std::array<double, 3>, 3> segment = {{{0, 0, 0}, {2, 2, 0}, {1, 1, 0}}};
  expectAt(0.5, Pair::vertexFace, movingPoint({1.5, 1.5, 1}, {1.5, 1.5, -1}, segment));
  expectNone(Pair::vertexFace, movingPoint({1.5, 1, 1}, {1.5, 1, -1}, segment));
  expectNone(Pair::vertexFace, movingPoint({3, 3, 1}, {3, 3, -1}, segment));
  const std::array<std::array<double, 3>, 3> point = {{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}};
  expectAt(0.5, Pair::vertexFace, movingPoint({0, 0, 0}, {2, 2, 2}, point));
  expectNone(Pair::vertexFace, movingPoint({0, 0, 0}, {2, 2, 3}, point));
  // A face that is a segment only when the point reaches its plane.
  const Points start = {{{1, 1, 1}, {0, 0, 0}, {2, 2, 0}, {1, 1, 1}}};
  expectRight(Pair::vertexFace, moving(start, {{{1, 1, -1}, {0, 0, 0}, {2, 2, 0}, {1, 2, -1}}}), kTolerance);
}

TEST(ExactContact, NoMotionAndCommonMotion) {
  const std::array<double, 3> inside = {0.25, 0.25, 0};
  const std::array<double, 3> above = {0.25, 0.25, 1e-300};
  const Points crossing = {{{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}}};
  const Points missing = {{{-1, 0, 0}, {1, 0, 0}, {0, -1, 1e-300}, {0, 1, 1e-300}}};
  for (const double way : {0.0, 0x1p20}) {
    const auto together = [&](const Query& query) {
      Query result = query;
      for (auto& point : result.end) point[0] += way;
      return result;
    };
    EXPECT_EQ(exactContact(Pair::vertexFace, together(movingPoint(inside, inside)), kTolerance).time, 0);
    expectAt(0, Pair::vertexFace, together(movingPoint(inside, inside)));
    expectNone(Pair::vertexFace, together(movingPoint(above, above)));
    expectAt(0, Pair::edgeEdge, together(moving(crossing, crossing)));
    expectNone(Pair::edgeEdge, together(moving(missing, missing)));
  }
}

TEST(ExactContact, FirstContactSoonAfterTheStart) {
  expectAt(0x1p-60, Pair::vertexFace, movingPoint({0.25, 0.25, 0x1p-60}, {0.25, 0.25, -1}));
  // Only at a corner of the face.
  expectAt(0x1p-60, Pair::vertexFace, movingPoint({-0x1p-60, 0x1p-60, 0}, {1, -1, 0}));
  expectRight(Pair::vertexFace, movingPoint({-0x1p-50, 0x1p-51, 0}, {1, -1, 0}), kFinest);
}

TEST(ExactContact, TheSmallestAndTheLargestNumbers) {
  Lattice lattice(11);
  for (int i = 0; i < 200; ++i) {
    for (const Pair pair : kPairs) {
      const Query query = lattice.query(2, 3);
      const Contact contact = exactContact(pair, query, kTolerance);
      for (const int exponent : {-1074, -1070, 1022}) {
        EXPECT_EQ(exactContact(pair, scaled(query, exponent), kTolerance).found, contact.found);
        EXPECT_EQ(exactContact(pair, scaled(query, exponent), kTolerance).time, contact.time);
      }
    }
  }
  const double half = 0x1p-1023;  // denormal; twice that is not
  expectAt(0.5, Pair::vertexFace,
           movingPoint({0, 0, 2 * half}, {0, 0, 0}, {{{0, 0, half}, {1, 0, half}, {0, 1, half}}}));
  const double small = std::numeric_limits<double>::denorm_min();
  const std::array<std::array<double, 3>, 3> huge = {
      {{-kInfinite, -kInfinite, 0}, {kInfinite, 0, 0}, {0, kInfinite, 0}}};
  expectAt(0.5, Pair::vertexFace, movingPoint({small, -small, 3 * small}, {small, -small, -3 * small}, huge));
  expectNone(Pair::vertexFace, movingPoint({small, -small, 3 * small}, {small, -small, small}, huge));
  expectAt(0, Pair::vertexFace, movingPoint({0, kInfinite, 0}, {0, kInfinite, kInfinite}, huge));
  expectNone(Pair::vertexFace, movingPoint({small, kInfinite, 0}, {small, kInfinite, kInfinite}, huge));
  expectAt(0.5, Pair::vertexFace, movingPoint({1e-308, 1, 1e308}, {1e-308, 1, -1e308}, huge));
}

TEST(ExactContact, MinusZeroIsZero) {
  expectAt(0, Pair::vertexFace, movingPoint({-0.0, -0.0, -0.0}, {-0.0, -0.0, -0.0}));
  expectAt(1, Pair::vertexFace, movingPoint({0.25, 0.25, 1}, {0.25, 0.25, -0.0}));
}

}  // namespace
}  // namespace wetcloth_test::exact_contact_test
