// SPDX-License-Identifier: Zlib
// The cubic of Eq. 8 and its error bound against integer arithmetic without any rounding.

#include <bullet_wetcloth/collision/CoplanarityCubic.h>

#include "tests/support/QueryGenerator.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace wetcloth_test::coplanarity_cubic_test {
namespace {

using wetcloth::collision::coplanarityCubic;
using wetcloth::collision::CoplanarityCubic;

__extension__ using Integer = __int128;

// A query of integers, and the power of two that it is multiplied by.
struct IntegerQuery {
  std::int64_t start[4][3];
  std::int64_t end[4][3];
  int power = 0;
};

template <class Scalar>
Query<Scalar> queryOf(const IntegerQuery& integers) {
  Query<Scalar> query;
  for (int i = 0; i < 4; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      query.start[i][axis] =
          static_cast<Scalar>(std::ldexp(static_cast<double>(integers.start[i][axis]), integers.power));
      query.end[i][axis] = static_cast<Scalar>(std::ldexp(static_cast<double>(integers.end[i][axis]), integers.power));
    }
  }
  return query;
}

// With the k-th of `ends` set, edge k is the one at the end of the motion.
Integer determinant(const IntegerQuery& query, const bool (&ends)[3]) {
  Integer rows[3][3];
  for (int k = 0; k < 3; ++k) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto& points = ends[k] ? query.end : query.start;
      rows[k][axis] = static_cast<Integer>(points[k + 1][axis]) - points[0][axis];
    }
  }
  return rows[0][0] * (rows[1][1] * rows[2][2] - rows[1][2] * rows[2][1]) +
         rows[0][1] * (rows[1][2] * rows[2][0] - rows[1][0] * rows[2][2]) +
         rows[0][2] * (rows[1][0] * rows[2][1] - rows[1][1] * rows[2][0]);
}

// C(3, k) times the Bernstein coefficients: integers.
void exactCoefficients(const IntegerQuery& query, Integer (&coefficients)[4]) {
  for (Integer& coefficient : coefficients) coefficient = 0;
  for (int mask = 0; mask < 8; ++mask) {
    const bool ends[3] = {(mask & 1) != 0, (mask & 2) != 0, (mask & 4) != 0};
    coefficients[ends[0] + ends[1] + ends[2]] += determinant(query, ends);
  }
}

// |exact / times - given| in units of the integers' cubes.
long double distance(Integer exact, int times, double given) {
  const double whole = std::trunc(given);
  const Integer rest = exact - times * static_cast<Integer>(whole);
  return std::abs(static_cast<long double>(rest) / times - (static_cast<long double>(given) - whole));
}

constexpr int kBinomial[4] = {1, 3, 3, 1};

// Integers of at most `bits` bits, around an offset that has them all.
IntegerQuery integerQuery(QueryGenerator& generator, int bits, std::int64_t offset) {
  IntegerQuery query;
  const double range = std::ldexp(1.0, bits);
  std::int64_t center[3];
  for (std::int64_t& coordinate : center)
    coordinate = static_cast<std::int64_t>(std::llround(generator.real(-1, 1) * static_cast<double>(offset)));
  for (auto* points : {&query.start, &query.end}) {
    for (auto& point : *points) {
      for (int axis = 0; axis < 3; ++axis)
        point[axis] = center[axis] + static_cast<std::int64_t>(std::llround(generator.real(-1, 1) * range));
    }
  }
  return query;
}

template <class Scalar>
void expectWithinError(const IntegerQuery& integers) {
  const Query<Scalar> query = queryOf<Scalar>(integers);
  const CoplanarityCubic cubic = coplanarityCubic(query);
  Integer exact[4];
  exactCoefficients(integers, exact);
  ASSERT_TRUE(std::isfinite(cubic.error)) << literal(Pair::vertexFace, query);
  // One part in 2^50 for the long double of this test.
  const long double allowed = std::ldexp(static_cast<long double>(cubic.error), -3 * integers.power) * (1 + 0x1p-50L);
  for (int k = 0; k < 4; ++k) {
    const double given = std::ldexp(cubic.bernstein[k], -3 * integers.power);
    EXPECT_LE(distance(exact[k], kBinomial[k], given), allowed) << k << " of " << literal(Pair::vertexFace, query);
  }
}

struct Range {
  const char* name;
  int bits;
  std::int64_t offset;
  int power;
};

// The shape's size, how far it lies, and the unit. A far offset in double has 52 bits.
const Range kDoubleRanges[] = {{"lattice", 2, 0, 0},
                               {"20 bits", 20, 0, 0},
                               {"39 bits", 39, 0, -39},
                               {"far", 10, std::int64_t(1) << 50, -20},
                               {"farther", 2, std::int64_t(1) << 52, 0},
                               {"half far", 30, std::int64_t(1) << 40, -30},
                               {"tiny", 30, 0, -300},
                               {"huge", 30, 0, 290}};
const Range kFloatRanges[] = {{"lattice", 2, 0, 0},       {"22 bits", 22, 0, 0}, {"far", 8, 1 << 22, -8},
                              {"farther", 2, 1 << 23, 0}, {"tiny", 20, 0, -140}, {"huge", 20, 0, 100}};

TEST(CoplanarityCubic, ErrorBoundsEveryCoefficientInDouble) {
  QueryGenerator generator(41);
  for (const Range& range : kDoubleRanges) {
    for (int i = 0; i < 3000; ++i) {
      IntegerQuery query = integerQuery(generator, range.bits, range.offset);
      query.power = range.power;
      SCOPED_TRACE(range.name);
      expectWithinError<double>(query);
    }
  }
}

TEST(CoplanarityCubic, ErrorBoundsEveryCoefficientInFloat) {
  QueryGenerator generator(42);
  for (const Range& range : kFloatRanges) {
    for (int i = 0; i < 3000; ++i) {
      IntegerQuery query = integerQuery(generator, range.bits, range.offset);
      query.power = range.power;
      SCOPED_TRACE(range.name);
      expectWithinError<float>(query);
    }
  }
}

// A bound that anything fits in would be no help: 15 digits of the products are left by a few dozen roundings.
TEST(CoplanarityCubic, ErrorIsSmall) {
  QueryGenerator generator(43);
  for (int i = 0; i < 1000; ++i) {
    const Query<double> query = generator.uniform();
    const long double size = extent(query);
    EXPECT_LE(coplanarityCubic(query).error, 1e-13L * size * size * size) << literal(Pair::vertexFace, query);
  }
}

// The differences of coordinates are what counts, and they are exact here.
TEST(CoplanarityCubic, ErrorDoesNotGrowWithTheOffsetWhereDifferencesAreExact) {
  QueryGenerator generator(44);
  for (int i = 0; i < 1000; ++i) {
    const IntegerQuery query = integerQuery(generator, 10, std::int64_t(1) << 45);
    const double size = 3 * 4096;
    EXPECT_LE(coplanarityCubic(queryOf<double>(query)).error, 1e-11 * size * size * size);
  }
}

template <class Scalar>
void expectARootWhereOneIs() {
  QueryGenerator generator(45);
  int signs = 0;
  for (int i = 0; i < 20000; ++i) {
    const Pair pair = i % 2 == 0 ? Pair::vertexFace : Pair::edgeEdge;
    const Query<Scalar> touching = converted<Scalar>(generator.touching(pair, generator.integer(0, 4)));
    EXPECT_FALSE(coplanarityCubic(touching).hasNoRoot()) << literal(pair, touching);

    const IntegerQuery integers = integerQuery(generator, 3, 0);
    Integer exact[4];
    exactCoefficients(integers, exact);
    const bool root = exact[0] == 0 || exact[3] == 0 || (exact[0] < 0) != (exact[3] < 0);
    if (!root) continue;
    ++signs;
    const Query<Scalar> query = queryOf<Scalar>(integers);
    EXPECT_FALSE(coplanarityCubic(query).hasNoRoot()) << literal(pair, query);
  }
  EXPECT_GT(signs, 5000);
}

TEST(CoplanarityCubic, HasARootWhereOneIsInDouble) { expectARootWhereOneIs<double>(); }
TEST(CoplanarityCubic, HasARootWhereOneIsInFloat) { expectARootWhereOneIs<float>(); }

// One coordinate of a touching query moved by one ulp: roots come and go by less than any rounding. The exact signs at
// both ends say for sure that there is one.
TEST(CoplanarityCubic, HasARootWhereOneIsByOneUlp) {
  QueryGenerator generator(46);
  const int power = -52;
  int signs = 0;
  for (int i = 0; i < 20000; ++i) {
    // Coordinates of 52 bits, differences of a few units: what one ulp changes, changes a sign.
    IntegerQuery integers = integerQuery(generator, 2, std::int64_t(1) << 51);
    integers.power = power;
    Integer exact[4];
    exactCoefficients(integers, exact);
    if (exact[0] != 0 && exact[3] != 0 && (exact[0] < 0) == (exact[3] < 0)) continue;
    ++signs;
    const Query<double> query = queryOf<double>(integers);
    EXPECT_FALSE(coplanarityCubic(query).hasNoRoot()) << literal(Pair::vertexFace, query);
  }
  EXPECT_GT(signs, 5000);
}

TEST(CoplanarityCubic, HasNoRootWhereOneSignIsPlain) {
  QueryGenerator generator(47);
  int plain = 0;
  for (int i = 0; i < 2000; ++i) {
    const IntegerQuery integers = integerQuery(generator, 20, 0);
    Integer exact[4];
    exactCoefficients(integers, exact);
    Integer least = exact[0], most = exact[0];
    for (const Integer coefficient : exact) {
      least = std::min(least, coefficient);
      most = std::max(most, coefficient);
    }
    // Beyond 2^40 of 2^60 no rounding of double reaches.
    const Integer margin = static_cast<Integer>(1) << 40;
    if (least > margin || most < -margin) {
      ++plain;
      EXPECT_TRUE(coplanarityCubic(queryOf<double>(integers)).hasNoRoot());
    }
  }
  EXPECT_GT(plain, 50);
}

TEST(CoplanarityCubic, HasRootsWhenItIsZeroAllAlong) {
  const Query<double> flat = {{{1, 1, 0}, {0, 0, 0}, {4, 0, 0}, {0, 4, 0}},
                              {{9, 9, 0}, {0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};
  EXPECT_FALSE(coplanarityCubic(flat).hasNoRoot());
  const Query<double> point = {};
  EXPECT_FALSE(coplanarityCubic(point).hasNoRoot());
  EXPECT_FALSE(coplanarityCubic(converted<float>(flat)).hasNoRoot());
}

// Point 0 at height 1 - 2 t over the face (0, 0), (4, 0), (0, 4): (p1 - p0) x (p2 - p0) . (p3 - p0) = -16 (1 - 2 t).
TEST(CoplanarityCubic, HasTheSignAndTheUnitOfItsDefinition) {
  const Query<double> query = {{{1, 1, 1}, {0, 0, 0}, {4, 0, 0}, {0, 4, 0}},
                               {{1, 1, -1}, {0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};
  for (const CoplanarityCubic& cubic : {coplanarityCubic(query), coplanarityCubic(converted<float>(query))}) {
    EXPECT_NEAR(cubic.bernstein[0], -16, 1e-12);
    EXPECT_NEAR(cubic.bernstein[1], -16 / 3.0, 1e-12);
    EXPECT_NEAR(cubic.bernstein[2], 16 / 3.0, 1e-12);
    EXPECT_NEAR(cubic.bernstein[3], 16, 1e-12);
    EXPECT_NEAR(cubic.value(0.25), -8, 1e-12);
  }
}

TEST(CoplanarityCubic, ValueIsTheVolumeAtThatTime) {
  QueryGenerator generator(48);
  for (int i = 0; i < 1000; ++i) {
    const Query<double> query = generator.uniform();
    const CoplanarityCubic cubic = coplanarityCubic(query);
    EXPECT_EQ(cubic.value(0), cubic.bernstein[0]);
    EXPECT_EQ(cubic.value(1), cubic.bernstein[3]);
    for (const double time : {0.0, 0.125, 0.3, 0.5, 0.99, 1.0}) {
      const Point p0 = pointAt(query, 0, time);
      const long double volume =
          dot(cross(pointAt(query, 1, time) - p0, pointAt(query, 2, time) - p0), pointAt(query, 3, time) - p0);
      double largest = 0;
      for (const double coefficient : cubic.bernstein) largest = std::max(largest, std::abs(coefficient));
      // Three steps of three roundings each, of numbers no larger than the coefficients.
      EXPECT_NEAR(cubic.value(time), static_cast<double>(volume), cubic.error + 9 * 0x1p-53 * largest);
    }
  }
}

TEST(CoplanarityCubic, OfNumbersThatAreNotFiniteHasAnInfiniteError) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), infinity, -infinity}) {
    for (int place = 0; place < 24; ++place) {
      QueryGenerator generator(49);
      Query<double> query = generator.uniform();
      (place < 12 ? query.start : query.end)[place % 12 / 3][place % 3] = bad;
      const CoplanarityCubic cubic = coplanarityCubic(query);
      EXPECT_EQ(cubic.error, infinity) << place;
      EXPECT_FALSE(cubic.hasNoRoot()) << place;
      EXPECT_EQ(coplanarityCubic(converted<float>(query)).error, infinity) << place;
    }
  }
}

TEST(CoplanarityCubic, OfProductsThatOverflowHasAnInfiniteError) {
  const double infinity = std::numeric_limits<double>::infinity();
  QueryGenerator generator(50);
  for (int i = 0; i < 100; ++i) {
    for (const int power : {345, 500, 1023}) {
      Query<double> query = generator.uniform();
      for (auto* points : {&query.start, &query.end}) {
        for (auto& point : *points)
          for (double& coordinate : point) coordinate = std::ldexp(coordinate, power);
      }
      const CoplanarityCubic cubic = coplanarityCubic(query);
      EXPECT_FALSE(cubic.hasNoRoot() && cubic.error < infinity) << literal(Pair::vertexFace, query);
      if (power > 345) {
        EXPECT_EQ(cubic.error, infinity) << literal(Pair::vertexFace, query);
      }
    }
  }
}

// Products that underflow to 0 must not pass for exact.
TEST(CoplanarityCubic, OfProductsThatUnderflowKeepsItsError) {
  QueryGenerator generator(51);
  for (int i = 0; i < 2000; ++i) {
    for (const int power : {-345, -358, -370, -500, -1000}) {
      const int quarters = generator.integer(0, 4);
      Query<double> query = generator.touching(i % 2 == 0 ? Pair::vertexFace : Pair::edgeEdge, quarters);
      for (auto* points : {&query.start, &query.end}) {
        for (auto& point : *points)
          for (double& coordinate : point) coordinate = std::ldexp(coordinate, power);
      }
      EXPECT_FALSE(coplanarityCubic(query).hasNoRoot()) << literal(Pair::vertexFace, query);
    }
  }
}

}  // namespace
}  // namespace wetcloth_test::coplanarity_cubic_test
