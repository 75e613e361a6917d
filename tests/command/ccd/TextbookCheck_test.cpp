// SPDX-License-Identifier: Zlib
#include "command/ccd/TextbookCheck.h"
#include "tests/support/QueryData.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <tuple>

namespace wetcloth_test::textbook_check_test {
namespace {

using namespace wetcloth::collision;
using command::comparison::textbookCheck;

template <class Scalar>
class TextbookCheck : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(TextbookCheck, Scalars, );

TYPED_TEST(TextbookCheck, VertexThroughFace) {
  const Query<TypeParam> query{{{0.25, 0.5, 1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                               {{0.25, 0.5, -3}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  const Contact contact = textbookCheck(Pair::vertexFace, query, TypeParam(0));
  EXPECT_TRUE(contact.found);
  EXPECT_NEAR(contact.time, 0.25, 1e-6);
  EXPECT_NEAR(contact.where[0], 0.25, 1e-6);
  EXPECT_NEAR(contact.where[1], 0.5, 1e-6);
}

TYPED_TEST(TextbookCheck, EdgeThroughEdge) {
  const Query<TypeParam> query{{{-1, 0, 1}, {3, 0, 1}, {0, -1, 0}, {0, 1, 0}},
                               {{-1, 0, -1}, {3, 0, -1}, {0, -1, 0}, {0, 1, 0}}};
  const Contact contact = textbookCheck(Pair::edgeEdge, query, TypeParam(0));
  EXPECT_TRUE(contact.found);
  EXPECT_NEAR(contact.time, 0.5, 1e-6);
  EXPECT_NEAR(contact.where[0], 0.25, 1e-6);
  EXPECT_NEAR(contact.where[1], 0.5, 1e-6);
}

TYPED_TEST(TextbookCheck, FirstOfThreeCoplanarMoments) {
  // The volume is (1 - 4t)(1 - 2t)(3 - 4t); at the first root the vertex is in the middle of the face.
  const Query<TypeParam> query{{{0, 0, 0}, {1, -1, -3}, {0, 1, 0}, {0, 0, 3}},
                               {{0, 0, 0}, {-3, 1, 1}, {0, -1, 0}, {0, 0, -1}}};
  const Contact contact = textbookCheck(Pair::vertexFace, query, TypeParam(0));
  EXPECT_TRUE(contact.found);
  EXPECT_NEAR(contact.time, 0.25, 1e-6);
  EXPECT_NEAR(contact.where[0], 1. / 3, 1e-5);
  EXPECT_NEAR(contact.where[1], 1. / 3, 1e-5);
}

TYPED_TEST(TextbookCheck, ToleranceReachesOutside) {
  const TypeParam beside = TypeParam(-0.01);
  const Query<TypeParam> query{{{beside, 0.5, 1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                               {{beside, 0.5, -1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  EXPECT_FALSE(textbookCheck(Pair::vertexFace, query, TypeParam(0)).found);
  const Contact contact = textbookCheck(Pair::vertexFace, query, TypeParam(0.02));
  EXPECT_TRUE(contact.found);
  EXPECT_EQ(contact.where[0], 0);
}

TYPED_TEST(TextbookCheck, MissesWhatIsCoplanarAllAlong) {
  const Query<TypeParam> query{{{-1, 0.25, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                               {{0.25, 0.25, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  EXPECT_FALSE(textbookCheck(Pair::vertexFace, query, TypeParam(1e-6)).found);
}

TYPED_TEST(TextbookCheck, ValuesThatAreNotFiniteDoNoHarm) {
  for (const TypeParam bad : {std::numeric_limits<TypeParam>::quiet_NaN(), std::numeric_limits<TypeParam>::infinity(),
                              std::numeric_limits<TypeParam>::max()}) {
    Query<TypeParam> query{};
    query.start[1][2] = bad;
    query.end[3][0] = -bad;
    textbookCheck(Pair::vertexFace, query, TypeParam(0));
    textbookCheck(Pair::edgeEdge, query, TypeParam(0));
  }
}

TEST(TextbookCheckOnData, MissesFewAndOnlyOfTheHardCollection) {
  for (const auto& [collection, fewest, most] : {std::tuple{"real", 1, 15}, std::tuple{"cloth", 0, 0}}) {
    const auto queries = knownQueries(collection);
    const auto misses = std::count_if(queries.begin(), queries.end(), [](const KnownQuery& query) {
      return query.meets && !textbookCheck(query.pair, query.points, 1e-6).found;
    });
    EXPECT_GE(misses, fewest);
    EXPECT_LE(misses, most);
  }
}

}  // namespace
}  // namespace wetcloth_test::textbook_check_test
