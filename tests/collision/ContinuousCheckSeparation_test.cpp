// SPDX-License-Identifier: Zlib
// Thickness: two that come as near as minSeparation meet.

#include "tests/support/QueryGenerator.h"

#include <gtest/gtest.h>

namespace wetcloth_test::continuous_check_separation_test {
namespace {

CheckSettings thick(double minSeparation, double tolerance = 1e-6) {
  CheckSettings settings;
  settings.minSeparation = minSeparation;
  settings.tolerance = tolerance;
  return settings;
}

std::vector<Way> waysWithThickness() {
  std::vector<Way> ways;
  for (const Way& way : everyWay())
    if (way.tier != Tier::exact) ways.push_back(way);
  return ways;
}

// The point, or an edge across, at `height` over a resting shape of size 4 in z = 0.
template <class Scalar>
Query<Scalar> above(Pair pair, double height, double endHeight, double x = 1, double endX = 1) {
  const Scalar h = static_cast<Scalar>(height), e = static_cast<Scalar>(endHeight);
  const Scalar u = static_cast<Scalar>(x), v = static_cast<Scalar>(endX);
  if (pair == Pair::vertexFace)
    return {{{u, 1, h}, {0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{v, 1, e}, {0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};
  return {{{u, -1, h}, {u, 1, h}, {0, 0, 0}, {4, 0, 0}}, {{v, -1, e}, {v, 1, e}, {0, 0, 0}, {4, 0, 0}}};
}

template <class Scalar>
class ContinuousCheckSeparation : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(ContinuousCheckSeparation, Scalars, );

TYPED_TEST(ContinuousCheckSeparation, ParallelAtADistanceMeetsWhenAsNear) {
  for (const Pair pair : {Pair::vertexFace, Pair::edgeEdge}) {
    for (const double distance : {0.125, 0.5, 3.0}) {
      for (const double sign : {1.0, -1.0}) {
        const Query<TypeParam> query = above<TypeParam>(pair, sign * distance, sign * distance, 0.5, 2);
        for (const Way& way : waysWithThickness()) {
          EXPECT_FALSE(ask(way, pair, query, thick(0))) << way.name << literal(pair, query);
          // Twelve digits: a distance by a few operations in double.
          EXPECT_FALSE(ask(way, pair, query, thick(distance * (1 - 1e-12)))) << way.name << literal(pair, query);
          EXPECT_TRUE(ask(way, pair, query, thick(distance))) << way.name << literal(pair, query);
          const Contact contact = ask(way, pair, query, thick(distance * 1.5));
          EXPECT_TRUE(contact.found) << way.name << literal(pair, query);
          EXPECT_EQ(contact.time, 0) << way.name << literal(pair, query);
        }
      }
    }
  }
}

TYPED_TEST(ContinuousCheckSeparation, MeetsWhenTheGapIsUsedUp) {
  for (const Pair pair : {Pair::vertexFace, Pair::edgeEdge}) {
    for (const double gap : {0.0, 0.125, 0.25, 0.75}) {
      for (const double tolerance : {1e-9, 1e-6, 1e-2}) {
        const Query<TypeParam> query = above<TypeParam>(pair, 1, -1);
        const double time = (1 - gap) / 2;
        for (const Way& way : waysWithThickness()) {
          const Contact contact = ask(way, pair, query, thick(gap, tolerance));
          EXPECT_TRUE(contact.found) << way.name;
          EXPECT_LE(contact.time, time) << way.name << ", gap " << gap;
          // Twice: the last interval may end just before the contact.
          EXPECT_GE(contact.time, time - 2 * tolerance) << way.name << ", gap " << gap;
          const long double reach = gap + relativeSpeed(pair, query) * (time - contact.time) + whereRounding(query);
          EXPECT_LE(distanceOf(pair, query, contact.time, contact.where), reach) << way.name;
        }
      }
    }
  }
}

// Around a corner the thickness is a ball: a point that comes along the diagonal meets the vertex at its distance.
TYPED_TEST(ContinuousCheckSeparation, MeetsACornerAtItsDistance) {
  const TypeParam from = -4, to = -1;
  const Query<TypeParam> query = {{{from, from, 0}, {0, 0, 0}, {4, 0, 0}, {0, 4, 0}},
                                  {{to, to, 0}, {0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};
  const Query<TypeParam> ends = {{{from, from, 0}, {2 * from, from, 0}, {0, 0, 0}, {4, 0, 0}},
                                 {{to, to, 0}, {2 * to, to, 0}, {0, 0, 0}, {4, 0, 0}}};
  for (const Way& way : waysWithThickness()) {
    for (const Pair pair : {Pair::vertexFace, Pair::edgeEdge}) {
      const Query<TypeParam>& points = pair == Pair::vertexFace ? query : ends;
      const Contact contact = ask(way, pair, points, thick(2));
      EXPECT_TRUE(contact.found) << way.name;
      EXPECT_LE(contact.time, (4 - std::sqrt(2.0)) / 3 * (1 + 1e-15)) << way.name;
      EXPECT_FALSE(ask(way, pair, points, thick(1.25))) << way.name << ": nearest at the end, by 1.41";
    }
  }
}

TYPED_TEST(ContinuousCheckSeparation, KeepsWhatMeetsWithoutIt) {
  QueryGenerator generator(21);
  for (const Pair pair : {Pair::vertexFace, Pair::edgeEdge}) {
    for (int i = 0; i < 400; ++i) {
      const int quarters = generator.integer(0, 4);
      const Query<TypeParam> query = converted<TypeParam>(generator.touching(pair, quarters));
      for (const Way& way : waysWithThickness()) {
        for (const double gap : {1e-300, 1e-12, 0.5, 1e6}) {
          const Contact contact = ask(way, pair, query, thick(gap));
          EXPECT_TRUE(contact.found) << way.name << ", gap " << gap << ": " << literal(pair, query);
          EXPECT_LE(contact.time, quarters / 4.0) << way.name << ", gap " << gap << ": " << literal(pair, query);
          EXPECT_TRUE(whereInRange(pair, contact)) << way.name << ", gap " << gap << ": " << literal(pair, query);
        }
      }
    }
  }
}

// Distances at 33 moments are upper bounds of the smallest one: a judge that needs no other check.
TYPED_TEST(ContinuousCheckSeparation, MissesNothingThatIsAsNearAtSomeMoment) {
  QueryGenerator generator(22);
  int found = 0;
  const int asked = 300;
  for (const QueryClass kind : kQueryClasses) {
    if (kind == QueryClass::mixedScale) continue;
    for (const Pair pair : {Pair::vertexFace, Pair::edgeEdge}) {
      for (int i = 0; i < asked; ++i) {
        const Query<TypeParam> query = generator.next<TypeParam>(kind, pair);
        const double gap = static_cast<double>(extent(query)) * generator.real(0, 0.3);
        // Nine digits and the rounding of the coordinates are left to the distances of the test itself.
        const long double surely = gap * (1 - 1e-9L) - std::ldexp(magnitude(query), -50);
        for (int moment = 0; moment <= 32; ++moment) {
          if (!(distanceAt(pair, query, moment / 32.0L) < surely)) continue;
          ++found;
          for (const Way& way : waysWithThickness()) {
            const Contact contact = ask(way, pair, query, thick(gap));
            EXPECT_TRUE(contact.found) << way.name << ", gap " << gap << ": " << literal(pair, query);
            EXPECT_LE(contact.time, moment / 32.0) << way.name << ", gap " << gap << ": " << literal(pair, query);
          }
          break;
        }
      }
    }
  }
  EXPECT_GT(found, asked);
}

TYPED_TEST(ContinuousCheckSeparation, MoreOfItLosesNothing) {
  QueryGenerator generator(23);
  int changed = 0;
  for (const QueryClass kind : kQueryClasses) {
    for (const Pair pair : {Pair::vertexFace, Pair::edgeEdge}) {
      for (int i = 0; i < 60; ++i) {
        const Query<TypeParam> query = generator.next<TypeParam>(kind, pair);
        const double size = static_cast<double>(extent(query));
        for (const Way& way : waysWithThickness()) {
          bool before = false;
          // Steps of 2 and more: a false alarm of a smaller one, within rounding of it, is a contact for the next.
          for (const double part : {0.0, 0.01, 0.05, 0.25, 1.0}) {
            const bool now = ask(way, pair, query, thick(part * size)).found;
            EXPECT_TRUE(now || !before) << way.name << ", gap " << part * size << ": " << literal(pair, query);
            if (now && !before && part > 0) ++changed;
            before = now;
          }
        }
      }
    }
  }
  EXPECT_GT(changed, 100);
}

}  // namespace
}  // namespace wetcloth_test::continuous_check_separation_test
