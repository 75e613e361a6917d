// SPDX-License-Identifier: Zlib
// Every way of asking against exact arithmetic: found, when and where, for the collections and for generated queries,
// in float (where the truth is that of the rounded query) and in double.

#include "tests/support/QueryData.h"
#include "tests/support/QueryGenerator.h"
#include "tests/support/QueryJudge.h"

#include <gtest/gtest.h>

#include <map>

namespace wetcloth_test::continuous_check_judged_test {
namespace {

using wetcloth::collision::coplanarityCubic;
using wetcloth::collision::CoplanarityCubic;
using wetcloth::collision::exactContact;

// The first query of each kind of fault, and how many there are.
class Faults {
 public:
  void note(const std::string& fault, const std::string& query) {
    if (!fault.empty() && m_counts[fault]++ == 0) m_first[fault] = query;
  }
  std::string text() const {
    std::string all;
    for (const auto& [fault, count] : m_counts)
      all += std::to_string(count) + " x " + fault + ", first " + m_first.at(fault) + "\n";
    return all;
  }

 private:
  std::map<std::string, int> m_counts;
  std::map<std::string, std::string> m_first;
};

template <class Scalar>
class ContinuousCheckJudged : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(ContinuousCheckJudged, Scalars, );

// The answers of each tier, in one batch and one by one.
template <class Scalar>
int judgeAll(Pair pair, const std::vector<Query<Scalar>>& queries, const CheckSettings& settings, Faults& faults) {
  std::vector<Verdict> verdicts;
  int met = 0;
  for (const Query<Scalar>& query : queries) {
    verdicts.push_back(verdictOn(pair, query));
    met += verdicts.back().meets ? 1 : 0;
  }
  for (const Way& way : everyWay()) {
    const ContinuousCheck check(way.tier, settings);
    std::vector<Contact> contacts(queries.size());
    if (way.batch) check(pair, queries.data(), queries.size(), contacts.data());
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const Contact contact = way.batch ? contacts[i] : check(pair, queries[i]);
      const std::string fault = faultOf(way.tier, pair, queries[i], contact, verdicts[i]);
      if (!fault.empty()) faults.note(std::string(way.name) + " " + fault, literal(pair, queries[i]));
    }
  }
  return met;
}

TYPED_TEST(ContinuousCheckJudged, RealAndClothQueries) {
  for (const char* collection : {"real", "cloth"}) {
    for (const Pair pair : {Pair::vertexFace, Pair::edgeEdge}) {
      std::vector<Query<TypeParam>> queries;
      for (const KnownQuery& known : knownQueries(collection))
        if (known.pair == pair) queries.push_back(converted<TypeParam>(known.points));
      Faults faults;
      EXPECT_GT(judgeAll(pair, queries, {}, faults), 50) << collection;
      EXPECT_EQ(faults.text(), "") << collection;
    }
  }
}

TYPED_TEST(ContinuousCheckJudged, GeneratedQueriesOfEveryClass) {
  QueryGenerator generator(61);
  for (const QueryClass kind : kQueryClasses) {
    for (const Pair pair : {Pair::vertexFace, Pair::edgeEdge}) {
      std::vector<Query<TypeParam>> queries;
      for (int i = 0; i < 1500; ++i) queries.push_back(generator.next<TypeParam>(kind, pair));
      Faults faults;
      EXPECT_GT(judgeAll(pair, queries, {}, faults), 30) << nameOf(kind);
      EXPECT_EQ(faults.text(), "") << nameOf(kind);
    }
  }
}

TYPED_TEST(ContinuousCheckJudged, GeneratedQueriesWithOtherSettings) {
  const std::pair<double, int> settingsOf[] = {{1e-12, 256}, {1e-2, 16}, {1, 1}, {1e-6, 3}};
  for (const auto& [tolerance, budget] : settingsOf) {
    CheckSettings settings;
    settings.tolerance = tolerance;
    settings.maxIntervals = budget;
    QueryGenerator generator(62);
    for (const QueryClass kind : kQueryClasses) {
      for (const Pair pair : {Pair::vertexFace, Pair::edgeEdge}) {
        std::vector<Query<TypeParam>> queries;
        for (int i = 0; i < 300; ++i) queries.push_back(generator.next<TypeParam>(kind, pair));
        Faults faults;
        judgeAll(pair, queries, settings, faults);
        EXPECT_EQ(faults.text(), "") << nameOf(kind) << ", tolerance " << tolerance << ", budget " << budget;
      }
    }
  }
}

// A point that crosses the plane of the other three fast: whatever ends before the contact is seen on one side of it.
TYPED_TEST(ContinuousCheckJudged, TimeIsWithinTheToleranceWhereThePlaneIsCrossedFast) {
  QueryGenerator generator(63);
  const CheckSettings settings;
  int plain = 0;
  for (const Pair pair : {Pair::vertexFace, Pair::edgeEdge}) {
    for (int i = 0; i < 3000; ++i) {
      const Query<TypeParam> query = generator.next<TypeParam>(QueryClass::cloth, pair);
      const Verdict verdict = verdictOn(pair, query);
      if (!verdict.meets || verdict.earliest < 3 * settings.tolerance) continue;
      const CoplanarityCubic cubic = coplanarityCubic(query);
      const double at = static_cast<double>(verdict.earliest);
      const double slope = std::abs(cubic.value(at) - cubic.value(at - 2 * settings.tolerance));
      const double size = static_cast<double>(extent(query));
      // By a thousandth of the size in the whole motion.
      if (slope < 1e-3 * size * size * size * 2 * settings.tolerance) continue;
      ++plain;
      for (const Way& way : everyWay()) {
        const Contact contact = ask(way, pair, query, settings);
        // Twice: the last interval may end just before the contact.
        EXPECT_GE(contact.time, verdict.earliest - 2 * settings.tolerance) << way.name << ": " << literal(pair, query);
      }
    }
  }
  EXPECT_GT(plain, 500);
}

// The judge itself, where the answer is known.
TEST(ContinuousCheckJudge, KnowsTheCollections) {
  int wrong = 0;
  for (const char* collection : {"real", "cloth"}) {
    for (const KnownQuery& known : knownQueries(collection)) {
      if (exactContact(known.pair, known.points, 1e-6).found != known.meets) {
        ++wrong;
        ADD_FAILURE() << known.id << ": " << literal(known.pair, known.points);
      }
    }
  }
  EXPECT_EQ(wrong, 0);
}

TEST(ContinuousCheckJudge, KnowsWhatTouchesAtAQuarter) {
  QueryGenerator generator(64);
  for (const Pair pair : {Pair::vertexFace, Pair::edgeEdge}) {
    for (int i = 0; i < 3000; ++i) {
      const int quarters = generator.integer(0, 4);
      const Query<double> query = generator.touching(pair, quarters);
      const Contact contact = exactContact(pair, query, 1e-9);
      EXPECT_TRUE(contact.found) << literal(pair, query);
      EXPECT_LE(contact.time, quarters / 4.0) << literal(pair, query);
    }
  }
}

// The first time, and closer for a smaller tolerance.
TEST(ContinuousCheckJudge, ItsTimesAreWithinItsTolerance) {
  QueryGenerator generator(65);
  for (const QueryClass kind : kQueryClasses) {
    for (const Pair pair : {Pair::vertexFace, Pair::edgeEdge}) {
      for (int i = 0; i < 300; ++i) {
        const Query<double> query = generator.next<double>(kind, pair);
        const Contact closely = exactContact(pair, query, 1e-12);
        for (const double tolerance : {1e-6, 1e-2, 1.0}) {
          const Contact contact = exactContact(pair, query, tolerance);
          EXPECT_EQ(contact.found, closely.found) << literal(pair, query);
          EXPECT_LE(contact.time, closely.time + 1e-12) << literal(pair, query);
          EXPECT_GE(contact.time, closely.time - tolerance) << literal(pair, query);
        }
      }
    }
  }
}

// Another judge, of 257 moments: what is apart by more than the speed covers between two of them never meets, and
// nothing meets before a moment until which that holds.
TEST(ContinuousCheckJudge, AgreesWithDistancesAtManyMoments) {
  QueryGenerator generator(66);
  int apart = 0;
  for (const QueryClass kind : kQueryClasses) {
    for (const Pair pair : {Pair::vertexFace, Pair::edgeEdge}) {
      for (int i = 0; i < 100; ++i) {
        const Query<double> query = generator.next<double>(kind, pair);
        const int moments = 256;
        const long double cover = relativeSpeed(pair, query) / moments * 1.001L + whereRounding(query);
        int moment = 0;
        while (moment <= moments && distanceAt(pair, query, static_cast<long double>(moment) / moments) > cover)
          ++moment;
        const Contact contact = exactContact(pair, query, 1e-9);
        if (moment > moments) {
          ++apart;
          EXPECT_FALSE(contact.found) << literal(pair, query);
        } else if (contact.found) {
          EXPECT_GE(contact.time, static_cast<double>(moment - 1) / moments - 1e-9) << literal(pair, query);
        }
      }
    }
  }
  EXPECT_GT(apart, 100);
}

}  // namespace
}  // namespace wetcloth_test::continuous_check_judged_test
