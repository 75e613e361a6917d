// SPDX-License-Identifier: Zlib
// Contacts that are certain without exact arithmetic: a point crosses a face, or an edge another, in the inside of both
// and by far more than long double rounds. These need no Boost, and there are many of them.

#include "tests/support/QueryGenerator.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace wetcloth_test::continuous_check_certain_test {
namespace {

template <class Scalar>
long double volumeAt(const Query<Scalar>& query, long double time) {
  const Point p0 = pointAt(query, 0, time);
  return dot(cross(pointAt(query, 1, time) - p0, pointAt(query, 2, time) - p0), pointAt(query, 3, time) - p0);
}

// Whether both places of the pair are inside by a millionth when the four points are coplanar.
template <class Scalar>
bool clearlyInside(Pair pair, const Query<Scalar>& query, long double time) {
  const Point p0 = pointAt(query, 0, time), p1 = pointAt(query, 1, time);
  const Point p2 = pointAt(query, 2, time), p3 = pointAt(query, 3, time);
  const long double margin = 1e-6L;
  const bool face = pair == Pair::vertexFace;
  const Point u = face ? p2 - p1 : p1 - p0;
  const Point v = face ? p3 - p1 : p3 - p2;
  const Point w = face ? p0 - p1 : p2 - p0;
  const Point normal = cross(u, v);
  const long double square = dot(normal, normal);
  if (!(square > 1e-6L * dot(u, u) * dot(v, v))) return false;
  const long double a = dot(cross(w, v), normal) / square;
  const long double b = face ? dot(cross(u, w), normal) / square : dot(cross(w, u), normal) / square;
  return a > margin && a < 1 - margin && b > margin && b < 1 - margin && (!face || a + b < 1 - margin);
}

// The first certain contact that is seen at 65 moments; more than 1 when there is none.
template <class Scalar>
long double certainTime(Pair pair, const Query<Scalar>& query) {
  const long double size = extent(query);
  const long double certain = 1e-12L * size * size * size;
  for (int moment = 0; moment < 64; ++moment) {
    long double from = moment / 64.0L, to = (moment + 1) / 64.0L;
    const long double before = volumeAt(query, from), after = volumeAt(query, to);
    if (!(std::abs(before) > certain && std::abs(after) > certain && (before < 0) != (after < 0))) continue;
    // 40 halvings: 1e-14, beside a margin of a millionth of the size.
    for (int step = 0; step < 40; ++step) {
      const long double middle = (from + to) / 2;
      ((volumeAt(query, middle) < 0) == (before < 0) ? from : to) = middle;
    }
    if (clearlyInside(pair, query, from) && clearlyInside(pair, query, to)) return to;
  }
  return 2;
}

template <class Scalar>
class ContinuousCheckCertain : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(ContinuousCheckCertain, Scalars, );

TYPED_TEST(ContinuousCheckCertain, ContactsAreFoundInTimeAndInPlace) {
  QueryGenerator generator(95);
  int met = 0;
  for (const QueryClass kind : kQueryClasses) {
    // Far apart scales are outside of what long double is certain of.
    if (kind == QueryClass::mixedScale || kind == QueryClass::farOffset) continue;
    for (const Pair pair : {Pair::vertexFace, Pair::edgeEdge}) {
      for (int i = 0; i < 2000; ++i) {
        const Query<TypeParam> query = generator.next<TypeParam>(kind, pair);
        const long double time = certainTime(pair, query);
        if (time > 1) continue;
        ++met;
        for (const Way& way : everyWay()) {
          const Contact contact = ask(way, pair, query);
          EXPECT_TRUE(contact.found) << way.name << ": " << literal(pair, query);
          EXPECT_LE(contact.time, time) << way.name << ": " << literal(pair, query);
          EXPECT_TRUE(whereInRange(pair, contact)) << way.name << ": " << literal(pair, query);
          EXPECT_LE(
              distanceOf(pair, query, contact.time, contact.where),
              std::min(distanceAt(pair, query, contact.time), relativeSpeed(pair, query) * (time - contact.time)) +
                  whereRounding(query))
              << way.name << " at " << contact.time << ": " << literal(pair, query);
        }
      }
    }
  }
  EXPECT_GT(met, 3000);
}

}  // namespace
}  // namespace wetcloth_test::continuous_check_certain_test
