// SPDX-License-Identifier: Zlib
#include "command/ccd/NewtonCheck.h"
#include "tests/support/QueryData.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <tuple>

namespace wetcloth_test::newton_check_test {
namespace {

using namespace wetcloth::collision;
using command::comparison::newtonCheck;

template <class Scalar>
class NewtonCheck : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(NewtonCheck, Scalars, );

TYPED_TEST(NewtonCheck, FirstOfThreeCoplanarMoments) {
  // The volume is (1 - 4t)(1 - 2t)(3 - 4t); at the first root the vertex is in the middle of the face.
  const Query<TypeParam> query{{{0, 0, 0}, {1, -1, -3}, {0, 1, 0}, {0, 0, 3}},
                               {{0, 0, 0}, {-3, 1, 1}, {0, -1, 0}, {0, 0, -1}}};
  const Contact contact = newtonCheck(Pair::vertexFace, query, 0);
  EXPECT_TRUE(contact.found);
  EXPECT_NEAR(contact.time, 0.25, 1e-14);
  EXPECT_NEAR(contact.where[0], 1. / 3, 1e-14);
  EXPECT_NEAR(contact.where[1], 1. / 3, 1e-14);
}

TYPED_TEST(NewtonCheck, EdgeThroughEdgeAndPastIt) {
  Query<TypeParam> query{{{-1, 0, 1}, {3, 0, 1}, {0, -1, 0}, {0, 1, 0}},
                         {{-1, 0, -1}, {3, 0, -1}, {0, -1, 0}, {0, 1, 0}}};
  const Contact contact = newtonCheck(Pair::edgeEdge, query, 0);
  EXPECT_TRUE(contact.found);
  EXPECT_NEAR(contact.time, 0.5, 1e-14);
  EXPECT_NEAR(contact.where[0], 0.25, 1e-14);
  EXPECT_NEAR(contact.where[1], 0.5, 1e-14);
  query.start[0][0] = query.end[0][0] = TypeParam(0.25);
  EXPECT_FALSE(newtonCheck(Pair::edgeEdge, query, 1e-6).found);
}

TYPED_TEST(NewtonCheck, DoubleRootThatOnlyTouches) {
  // The volume is 2 (1 - 2t)^2: the edges cross in their middles and part on the side they came from.
  const Query<TypeParam> query{{{0, 0, 0}, {1, 0, 0}, {0.5, 1, -1}, {0.5, 1, 1}},
                               {{0, 0, 0}, {1, 0, 0}, {0.5, -3, 1}, {0.5, 1, -1}}};
  const Contact contact = newtonCheck(Pair::edgeEdge, query, 1e-6);
  EXPECT_TRUE(contact.found);
  EXPECT_NEAR(contact.time, 0.5, 1e-14);
  EXPECT_NEAR(contact.where[0], 0.5, 1e-14);
  EXPECT_NEAR(contact.where[1], 0.5, 1e-14);
}

TYPED_TEST(NewtonCheck, CoplanarAllAlongIsSeenOnlyAtTheEnds) {
  Query<TypeParam> query{{{-1, 0.25, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                         {{0.25, 0.25, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  EXPECT_TRUE(newtonCheck(Pair::vertexFace, query, 1e-6).found);
  query.end[0][0] = 3;
  EXPECT_FALSE(newtonCheck(Pair::vertexFace, query, 1e-6).found);
}

TYPED_TEST(NewtonCheck, ValuesThatAreNotFiniteDoNoHarm) {
  for (const TypeParam bad : {std::numeric_limits<TypeParam>::quiet_NaN(), std::numeric_limits<TypeParam>::infinity(),
                              std::numeric_limits<TypeParam>::max()}) {
    Query<TypeParam> query{};
    query.start[1][2] = bad;
    query.end[3][0] = -bad;
    newtonCheck(Pair::vertexFace, query, 1e-6);
    newtonCheck(Pair::edgeEdge, query, 1e-6);
  }
}

TEST(NewtonCheckOnData, MissesFewAndOnlyOfTheHardCollection) {
  for (const auto& [collection, fewest, most] : {std::tuple{"real", 1, 10}, std::tuple{"cloth", 0, 0}}) {
    const auto queries = knownQueries(collection);
    const auto misses = std::count_if(queries.begin(), queries.end(), [](const KnownQuery& query) {
      return query.meets && !newtonCheck(query.pair, query.points, 1e-6).found;
    });
    EXPECT_GE(misses, fewest);
    EXPECT_LE(misses, most);
  }
}

}  // namespace
}  // namespace wetcloth_test::newton_check_test
