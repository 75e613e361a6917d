// SPDX-License-Identifier: Zlib
// The cubic's error bound against rational arithmetic, for queries of every class: mixed scales are beyond integers.

#include <bullet_wetcloth/collision/CoplanarityCubic.h>

#include "tests/support/QueryGenerator.h"

#include <gtest/gtest.h>
#include <boost/multiprecision/cpp_int.hpp>

namespace wetcloth_test::continuous_check_cubic_exact_test {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using wetcloth::collision::coplanarityCubic;
using wetcloth::collision::CoplanarityCubic;

template <class Scalar>
void exactCoefficients(const Query<Scalar>& query, Rational (&coefficients)[4]) {
  const int binomial[4] = {1, 3, 3, 1};
  for (int mask = 0; mask < 8; ++mask) {
    Rational row[3][3];
    int ends = 0;
    for (int k = 0; k < 3; ++k) {
      const bool end = (mask >> k & 1) != 0;
      ends += end ? 1 : 0;
      const auto& points = end ? query.end : query.start;
      for (int axis = 0; axis < 3; ++axis) row[k][axis] = Rational(points[k + 1][axis]) - Rational(points[0][axis]);
    }
    coefficients[ends] += row[0][0] * (row[1][1] * row[2][2] - row[1][2] * row[2][1]) +
                          row[0][1] * (row[1][2] * row[2][0] - row[1][0] * row[2][2]) +
                          row[0][2] * (row[1][0] * row[2][1] - row[1][1] * row[2][0]);
  }
  for (int k = 0; k < 4; ++k) coefficients[k] /= binomial[k];
}

template <class Scalar>
class CoplanarityCubicExact : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(CoplanarityCubicExact, Scalars, );

TYPED_TEST(CoplanarityCubicExact, ErrorBoundsEveryCoefficient) {
  QueryGenerator generator(71);
  int rooted = 0;
  for (const QueryClass kind : kQueryClasses) {
    for (const Pair pair : {Pair::vertexFace, Pair::edgeEdge}) {
      for (int i = 0; i < 150; ++i) {
        Query<TypeParam> query = generator.next<TypeParam>(kind, pair);
        // Down to where products underflow, in double.
        const int power = std::is_same<TypeParam, double>::value ? -(i % 5) * 90 : -(i % 3) * 30;
        for (auto* points : {&query.start, &query.end}) {
          for (auto& point : *points)
            for (TypeParam& coordinate : point) coordinate = std::ldexp(coordinate, power);
        }
        Rational exact[4];
        exactCoefficients(query, exact);
        const CoplanarityCubic cubic = coplanarityCubic(query);
        ASSERT_TRUE(std::isfinite(cubic.error)) << literal(pair, query);
        for (int k = 0; k < 4; ++k) {
          const Rational off = abs(Rational(cubic.bernstein[k]) - exact[k]);
          EXPECT_LE(off, Rational(cubic.error)) << k << " of " << nameOf(kind) << " " << literal(pair, query);
        }
        if (exact[0] * exact[3] <= 0) {
          ++rooted;
          EXPECT_FALSE(cubic.hasNoRoot()) << nameOf(kind) << " " << literal(pair, query);
        }
      }
    }
  }
  EXPECT_GT(rooted, 500);
}

}  // namespace
}  // namespace wetcloth_test::continuous_check_cubic_exact_test
