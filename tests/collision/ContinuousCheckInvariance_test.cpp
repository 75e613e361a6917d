// SPDX-License-Identifier: Zlib
// A query says the same however its points are named, placed or measured: transformations without any rounding, so that
// the truth cannot change.

#include "tests/support/QueryData.h"
#include "tests/support/QueryGenerator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

namespace wetcloth_test::continuous_check_invariance_test {
namespace {

struct Asked {
  Pair pair;
  bool meets;
  Query<double> query;
};

// Every contact of the real queries and a part of the others, which are many.
const std::vector<Asked>& realQueries() {
  static const std::vector<Asked> queries = [] {
    std::vector<Asked> result;
    int others = 0;
    for (const KnownQuery& known : knownQueries("real"))
      if (known.meets || others++ % 4 == 0) result.push_back({known.pair, known.meets, known.points});
    return result;
  }();
  return queries;
}

using Transformation = std::function<Query<double>(const Query<double>&)>;

Query<double> renamed(const Query<double>& query, const int (&order)[4]) {
  Query<double> result;
  for (int i = 0; i < 4; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      result.start[i][axis] = query.start[order[i]][axis];
      result.end[i][axis] = query.end[order[i]][axis];
    }
  }
  return result;
}

Transformation renaming(int p0, int p1, int p2, int p3) {
  return [=](const Query<double>& query) { return renamed(query, {p0, p1, p2, p3}); };
}

Transformation onCoordinates(const std::function<void(double (&)[3])>& change) {
  return [change](const Query<double>& query) {
    Query<double> result = query;
    for (auto* points : {&result.start, &result.end})
      for (auto& point : *points) change(point);
    return result;
  };
}

// A quarter turn about `axis`: (u, v) becomes (-v, u).
Transformation quarterTurn(int axis) {
  return onCoordinates([axis](double(&point)[3]) {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    const double before = point[u];
    point[u] = -point[v];
    point[v] = before;
  });
}

Transformation reflection(int axis) {
  return onCoordinates([axis](double(&point)[3]) { point[axis] = -point[axis]; });
}

Transformation scaling(int power) {
  return onCoordinates([power](double(&point)[3]) {
    for (double& coordinate : point) coordinate = std::ldexp(coordinate, power);
  });
}

Query<double> backwards(const Query<double>& query) {
  Query<double> result;
  std::copy(&query.start[0][0], &query.start[0][0] + 12, &result.end[0][0]);
  std::copy(&query.end[0][0], &query.end[0][0] + 12, &result.start[0][0]);
  return result;
}

struct Named {
  std::string name;
  Transformation change;
};

// No tier may lose a contact, and the exact one may not find any more either.
void expectTheSameTruth(Pair pair, const std::vector<Named>& transformations) {
  for (const Named& transformation : transformations) {
    for (const Way& way : everyWay()) {
      if (way.batch) continue;
      const ContinuousCheck check(way.tier);
      int wrong = 0;
      std::string first;
      int asked = 0;
      for (const Asked& known : realQueries()) {
        if (known.pair != pair) continue;
        ++asked;
        const Query<double> query = transformation.change(known.query);
        const bool found = check(pair, query).found;
        const bool right = way.tier == Tier::exact ? found == known.meets : found || !known.meets;
        if (!right && wrong++ == 0) first = literal(pair, query);
      }
      EXPECT_GT(asked, 300);
      EXPECT_EQ(wrong, 0) << transformation.name << ", " << way.name << ", first " << first;
    }
  }
}

std::vector<Named> namings(Pair pair) {
  if (pair == Pair::vertexFace) {
    return {{"points 2 and 3 swapped", renaming(0, 1, 3, 2)},
            {"points 1 and 2 swapped", renaming(0, 2, 1, 3)},
            {"points 1 and 3 swapped", renaming(0, 3, 2, 1)},
            {"face turned", renaming(0, 2, 3, 1)},
            {"face turned twice", renaming(0, 3, 1, 2)}};
  }
  return {{"ends of the first swapped", renaming(1, 0, 2, 3)},
          {"ends of the second swapped", renaming(0, 1, 3, 2)},
          {"ends of both swapped", renaming(1, 0, 3, 2)},
          {"edges swapped", renaming(2, 3, 0, 1)},
          {"edges and ends swapped", renaming(3, 2, 1, 0)}};
}

class ContinuousCheckInvariance : public testing::TestWithParam<Pair> {};

TEST_P(ContinuousCheckInvariance, UnderOtherNamesOfThePoints) { expectTheSameTruth(GetParam(), namings(GetParam())); }

TEST_P(ContinuousCheckInvariance, UnderQuarterTurnsAndReflections) {
  expectTheSameTruth(GetParam(), {{"quarter turn about x", quarterTurn(0)},
                                  {"quarter turn about y", quarterTurn(1)},
                                  {"quarter turn about z", quarterTurn(2)},
                                  {"reflection of x", reflection(0)},
                                  {"reflection of y", reflection(1)},
                                  {"reflection of z", reflection(2)}});
}

TEST_P(ContinuousCheckInvariance, UnderTimeTurnedBack) { expectTheSameTruth(GetParam(), {{"backwards", backwards}}); }

// 2^300 and 2^-300 put products of three coordinates near the ends of the range, where those of four leave it.
TEST_P(ContinuousCheckInvariance, UnderScaleByPowersOfTwo) {
  std::vector<Named> scales;
  for (const int power : {-300, -200, -60, -1, 1, 60, 200, 300})
    scales.push_back({"2^" + std::to_string(power), scaling(power)});
  expectTheSameTruth(GetParam(), scales);
}

// The same answer also where it is a false alarm: within 2^-60 .. 2^60 nothing that rounds can differ.
TEST_P(ContinuousCheckInvariance, ConservativeAnswersTheSameAtModerateScales) {
  const ContinuousCheck check;
  int asked = 0;
  for (const Asked& known : realQueries()) {
    if (known.pair != GetParam()) continue;
    const Contact contact = check(known.pair, known.query);
    asked += contact.found ? 0 : 1;
    for (const int power : {-60, 60}) {
      const Contact scaled = check(known.pair, scaling(power)(known.query));
      EXPECT_EQ(scaled.found, contact.found) << literal(known.pair, known.query);
      EXPECT_EQ(scaled.time, contact.time) << literal(known.pair, known.query);
    }
  }
  EXPECT_GT(asked, 300);
}

// Contacts of small integers stay what they are under translations that a float holds; the time is known.
template <class Scalar>
void expectTranslationsKeepContacts(Pair pair) {
  QueryGenerator generator(7);
  for (int i = 0; i < 300; ++i) {
    const int quarters = generator.integer(0, 4);
    const Query<double> query = generator.touching(pair, quarters);
    for (const double distance : {0.0, 1.0, -1000.0, 65536.0}) {
      const Query<Scalar> moved = converted<Scalar>(onCoordinates([distance](double(&point)[3]) {
        point[0] += distance;
        point[1] -= 3 * distance;
        point[2] += 7 * distance;
      })(query));
      for (const Way& way : everyWay()) {
        const Contact contact = ask(way, pair, moved);
        EXPECT_TRUE(contact.found) << way.name << ": " << literal(pair, moved);
        EXPECT_LE(contact.time, quarters / 4.0) << way.name << ": " << literal(pair, moved);
      }
    }
  }
}

TEST_P(ContinuousCheckInvariance, OfContactsUnderTranslationInDouble) {
  expectTranslationsKeepContacts<double>(GetParam());
}
TEST_P(ContinuousCheckInvariance, OfContactsUnderTranslationInFloat) {
  expectTranslationsKeepContacts<float>(GetParam());
}

TEST_P(ContinuousCheckInvariance, OfExactAnswersUnderTranslation) {
  if (!ContinuousCheck::hasExact()) GTEST_SKIP() << "a build without Tier::exact";
  const ContinuousCheck check(Tier::exact);
  QueryGenerator generator(8);
  int met = 0;
  const int asked = 2000;
  for (int i = 0; i < asked; ++i) {
    const Query<double> query = generator.lattice();
    const bool found = check(GetParam(), query).found;
    met += found ? 1 : 0;
    const Query<double> moved = onCoordinates([](double(&point)[3]) {
      point[0] += 12345678;
      point[1] -= 1048576;
      point[2] += 3;
    })(query);
    EXPECT_EQ(check(GetParam(), moved).found, found) << literal(GetParam(), query);
  }
  EXPECT_GT(met, asked / 10);
  EXPECT_LT(met, asked - asked / 10);
}

// A contact where a shape is large and the motion plain: the names given to points decide nothing about its time.
TEST_P(ContinuousCheckInvariance, OfTimeAndPlaceUnderOtherNamesOfThePoints) {
  QueryGenerator generator(9);
  const CheckSettings settings;
  for (int i = 0; i < 200; ++i) {
    Query<double> query = generator.aimed(GetParam(), 0.5, 0);
    for (int point = 0; point < (GetParam() == Pair::vertexFace ? 1 : 2); ++point)
      for (int axis = 0; axis < 3; ++axis) query.end[point][axis] += axis == 2 ? 0.125 : 0;
    const ContinuousCheck check;
    const Contact contact = check(GetParam(), query);
    for (const Named& naming : namings(GetParam())) {
      const Contact other = check(GetParam(), naming.change(query));
      if (contact.found && other.found) {
        // Each is early by a tolerance at most for its rounding and by another for its last interval.
        EXPECT_NEAR(other.time, contact.time, 2 * settings.tolerance) << naming.name << literal(GetParam(), query);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Pairs, ContinuousCheckInvariance, testing::Values(Pair::vertexFace, Pair::edgeEdge),
                         NameOfPair());

}  // namespace
}  // namespace wetcloth_test::continuous_check_invariance_test
