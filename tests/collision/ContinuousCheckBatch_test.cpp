// SPDX-License-Identifier: Zlib
// A batch answers what its queries would be answered one by one, whatever its size and wherever it lies.

#include "tests/support/QueryData.h"
#include "tests/support/QueryGenerator.h"

#include <gtest/gtest.h>

#include <memory>
#include <new>

namespace wetcloth_test::continuous_check_batch_test {
namespace {

bool same(const Contact& a, const Contact& b) {
  return a.found == b.found && a.time == b.time && a.where[0] == b.where[0] && a.where[1] == b.where[1];
}

template <class Scalar>
std::vector<Query<Scalar>> mixedQueries(Pair pair, std::size_t count) {
  QueryGenerator generator(count + 1000);
  std::vector<Query<Scalar>> queries;
  while (queries.size() < count) {
    for (const QueryClass kind : kQueryClasses)
      if (queries.size() < count) queries.push_back(generator.next<Scalar>(kind, pair));
  }
  return queries;
}

// What `fast` may say of a query of which `conservative` says `single`: nothing found where that one is a false alarm
// that its own bound excludes; otherwise the same, for it is that tier that answers.
void expectAllowed(Tier tier, const Contact& batch, const Contact& single, const std::string& text) {
  if (tier == Tier::fast && !batch.found) {
    EXPECT_EQ(batch.time, 0) << text;
    return;
  }
  EXPECT_TRUE(same(batch, single)) << text << ": " << batch.found << " at " << batch.time << ", not " << single.found
                                   << " at " << single.time;
}

std::vector<Tier> everyTier() {
  std::vector<Tier> tiers = {Tier::fast, Tier::conservative};
  if (ContinuousCheck::hasExact()) tiers.push_back(Tier::exact);
  return tiers;
}

template <class Scalar>
class ContinuousCheckBatch : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(ContinuousCheckBatch, Scalars, );

TYPED_TEST(ContinuousCheckBatch, OfEverySizeAnswersLikeSingleQueries) {
  for (const Tier tier : everyTier()) {
    for (const Pair pair : {Pair::vertexFace, Pair::edgeEdge}) {
      for (const std::size_t count : {0u, 1u, 2u, 3u, 7u, 8u, 9u, 15u, 16u, 17u, 63u, 64u, 65u, 1000u}) {
        const ContinuousCheck check(tier);
        const std::vector<Query<TypeParam>> queries = mixedQueries<TypeParam>(pair, count);
        Contact untouched;
        untouched.time = -7;
        std::vector<Contact> contacts(count + 1, untouched);
        check(pair, queries.data(), count, contacts.data());
        for (std::size_t i = 0; i < count; ++i) {
          expectAllowed(tier, contacts[i], check(pair, queries[i]),
                        std::to_string(i) + " of " + std::to_string(count) + " " + literal(pair, queries[i]));
        }
        EXPECT_TRUE(same(contacts[count], untouched)) << "wrote behind a batch of " << count;
      }
    }
  }
}

TYPED_TEST(ContinuousCheckBatch, MissesNoContactAtAnyPlaceInIt) {
  for (const Tier tier : everyTier()) {
    for (const Pair pair : {Pair::vertexFace, Pair::edgeEdge}) {
      const ContinuousCheck check(tier);
      QueryGenerator generator(31);
      std::vector<Query<TypeParam>> queries;
      std::vector<int> quarters;
      for (int i = 0; i < 4000; ++i) {
        quarters.push_back(generator.integer(0, 4));
        queries.push_back(converted<TypeParam>(generator.touching(pair, quarters.back())));
      }
      std::vector<Contact> contacts(queries.size());
      check(pair, queries.data(), queries.size(), contacts.data());
      for (std::size_t i = 0; i < queries.size(); ++i) {
        EXPECT_TRUE(contacts[i].found) << i << ": " << literal(pair, queries[i]);
        EXPECT_LE(contacts[i].time, quarters[i] / 4.0) << i << ": " << literal(pair, queries[i]);
      }
    }
  }
}

TYPED_TEST(ContinuousCheckBatch, OfOneTierFindsNothingThatConservativeExcludes) {
  for (const Pair pair : {Pair::vertexFace, Pair::edgeEdge}) {
    const std::vector<Query<TypeParam>> queries = mixedQueries<TypeParam>(pair, 9000);
    std::vector<Contact> conservative(queries.size());
    ContinuousCheck()(pair, queries.data(), queries.size(), conservative.data());
    int misses = 0;
    for (const Tier tier : everyTier()) {
      std::vector<Contact> contacts(queries.size());
      ContinuousCheck{tier}(pair, queries.data(), queries.size(), contacts.data());
      for (std::size_t i = 0; i < queries.size(); ++i) {
        misses += conservative[i].found ? 0 : 1;
        EXPECT_TRUE(conservative[i].found || !contacts[i].found) << literal(pair, queries[i]);
      }
    }
    EXPECT_GT(misses, 1000);
  }
}

TYPED_TEST(ContinuousCheckBatch, MayLieAtAnyAddress) {
  const std::size_t count = 67;
  for (const Tier tier : everyTier()) {
    for (const Pair pair : {Pair::vertexFace, Pair::edgeEdge}) {
      const ContinuousCheck check(tier);
      const std::vector<Query<TypeParam>> queries = mixedQueries<TypeParam>(pair, count + 8);
      std::vector<Contact> whole(count + 8);
      check(pair, queries.data(), queries.size(), whole.data());
      for (std::size_t shift = 0; shift < 8; ++shift) {
        // Nothing better aligned than a query must be.
        std::vector<unsigned char> bytes((count + 1) * sizeof(queries[0]) + 64);
        void* aligned = bytes.data();
        std::size_t space = bytes.size();
        std::align(64, count * sizeof(queries[0]), aligned, space);
        unsigned char* const place = static_cast<unsigned char*>(aligned) + shift * alignof(Query<TypeParam>);
        Query<TypeParam>* const first = new (place) Query<TypeParam>(queries[0]);
        for (std::size_t i = 1; i < count; ++i) new (place + i * sizeof(queries[0])) Query<TypeParam>(queries[i]);
        std::vector<Contact> contacts(count);
        check(pair, first, count, contacts.data());
        for (std::size_t i = 0; i < count; ++i)
          EXPECT_TRUE(same(contacts[i], whole[i])) << "shifted by " << shift << ", " << i;
      }
    }
  }
}

TYPED_TEST(ContinuousCheckBatch, AnswersBadNumbersWithoutHarmToTheOthers) {
  for (const Tier tier : everyTier()) {
    for (const Pair pair : {Pair::vertexFace, Pair::edgeEdge}) {
      const ContinuousCheck check(tier);
      const std::vector<Query<TypeParam>> good = mixedQueries<TypeParam>(pair, 64);
      std::vector<Contact> before(good.size());
      check(pair, good.data(), good.size(), before.data());
      for (const std::size_t bad : {0u, 1u, 6u, 7u, 8u, 62u, 63u}) {
        std::vector<Query<TypeParam>> queries = good;
        queries[bad].end[2][1] = std::numeric_limits<TypeParam>::quiet_NaN();
        queries[bad].start[0][0] = std::numeric_limits<TypeParam>::infinity();
        std::vector<Contact> contacts(queries.size());
        check(pair, queries.data(), queries.size(), contacts.data());
        for (std::size_t i = 0; i < queries.size(); ++i) {
          if (i == bad) {
            EXPECT_TRUE(contacts[i].found);
            EXPECT_EQ(contacts[i].time, 0);
          } else {
            EXPECT_TRUE(same(contacts[i], before[i])) << i << " beside " << bad << ": " << literal(pair, good[i]);
          }
        }
      }
    }
  }
}

TYPED_TEST(ContinuousCheckBatch, GivesTheSameTwice) {
  const std::vector<Query<TypeParam>> queries = mixedQueries<TypeParam>(Pair::vertexFace, 500);
  for (const Tier tier : everyTier()) {
    const ContinuousCheck check(tier);
    std::vector<Contact> first(queries.size()), second(queries.size());
    check(Pair::vertexFace, queries.data(), queries.size(), first.data());
    check(Pair::vertexFace, queries.data(), queries.size(), second.data());
    for (std::size_t i = 0; i < queries.size(); ++i) EXPECT_TRUE(same(first[i], second[i])) << i;
  }
}

// Batches of plain queries are what the fast tier is there for: nearly all of them it must exclude, or it is of no use.
TYPED_TEST(ContinuousCheckBatch, ExcludesNearlyAllThatAreFarApart) {
  QueryGenerator generator(33);
  for (const Pair pair : {Pair::vertexFace, Pair::edgeEdge}) {
    std::vector<Query<TypeParam>> queries;
    for (int i = 0; i < 1000; ++i) {
      Query<double> query = generator.uniform();
      for (int point = pair == Pair::vertexFace ? 1 : 2; point < 4; ++point) {
        query.start[point][i % 3] += 2.5;
        query.end[point][i % 3] += 2.5;
      }
      queries.push_back(converted<TypeParam>(query));
    }
    for (const Tier tier : everyTier()) {
      std::vector<Contact> contacts(queries.size());
      ContinuousCheck{tier}(pair, queries.data(), queries.size(), contacts.data());
      for (std::size_t i = 0; i < queries.size(); ++i) EXPECT_FALSE(contacts[i].found) << literal(pair, queries[i]);
    }
  }
}

}  // namespace
}  // namespace wetcloth_test::continuous_check_batch_test
