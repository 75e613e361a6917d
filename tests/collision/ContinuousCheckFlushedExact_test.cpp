// SPDX-License-Identifier: Zlib
// Games let the processor flush denormal numbers to zero. The tiers must not miss a contact for it; judged by exact
// arithmetic on the same numbers with flushing off.

#include "bullet_wetcloth/collision/ContinuousCheck.h"
#include "bullet_wetcloth/collision/ExactContact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#ifdef __SSE2__
#include <pmmintrin.h>
#include <xmmintrin.h>

namespace wetcloth_test::continuous_check_flushed_exact_test {
namespace {

using wetcloth::collision::Contact;
using wetcloth::collision::ContinuousCheck;
using wetcloth::collision::exactContact;
using wetcloth::collision::Pair;
using wetcloth::collision::Query;
using wetcloth::collision::Tier;

class FlushingDenormals {
 public:
  FlushingDenormals() {
    _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
    _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
  }
  ~FlushingDenormals() { _mm_setcsr(m_before); }
  FlushingDenormals(const FlushingDenormals&) = delete;
  FlushingDenormals& operator=(const FlushingDenormals&) = delete;

 private:
  unsigned m_before = _mm_getcsr();
};

/// Coordinates of 12 bits times a power of two for each axis.
template <class Scalar>
Query<Scalar> randomQuery(std::mt19937& random, const int (&exponents)[3]) {
  Query<Scalar> query;
  for (auto* points : {&query.start, &query.end}) {
    for (auto& point : *points)
      for (int k = 0; k < 3; ++k) point[k] = Scalar(std::ldexp(double(int(random() % 4096) - 2048), exponents[k] - 11));
  }
  return query;
}

Query<double> widened(const Query<float>& query) {
  Query<double> result;
  std::copy_n(&query.start[0][0], 12, &result.start[0][0]);
  std::copy_n(&query.end[0][0], 12, &result.end[0][0]);
  return result;
}
Query<double> widened(const Query<double>& query) { return query; }

template <class Scalar>
void expectNothingIsMissed(const int (&exponents)[3]) {
  std::mt19937 random(7);
  int contacts = 0;
  for (int i = 0; i < 3000; ++i) {
    const Pair pair = i % 2 == 0 ? Pair::vertexFace : Pair::edgeEdge;
    const Query<Scalar> query = randomQuery<Scalar>(random, exponents);
    const Contact truth = exactContact(pair, widened(query), 1e-12);
    contacts += truth.found;
    for (const Tier tier : {Tier::fast, Tier::conservative, Tier::exact}) {
      const ContinuousCheck check(tier);
      Contact single;
      Contact batch;
      {
        const FlushingDenormals flushing;
        single = check(pair, query);
        check(pair, &query, 1, &batch);
      }
      for (const Contact& contact : {single, batch}) {
        ASSERT_GE(int(contact.found), int(truth.found)) << "query " << i << ", tier " << int(tier);
        if (tier == Tier::exact) {
          ASSERT_EQ(contact.found, truth.found) << "query " << i;
        }
        // exactContact's own time may be early by its tolerance.
        if (truth) {
          ASSERT_LE(contact.time, truth.time + 1e-12) << "query " << i << ", tier " << int(tier);
        }
      }
    }
  }
  EXPECT_GT(contacts, 100);
}

// Tests that need Tier::exact are skipped where this says no. This file is compiled only where Boost was found, so
// there none of them may be skipped.
TEST(ContinuousCheckFlushed, ABuildWithBoostHasTheTierExact) { ASSERT_TRUE(ContinuousCheck::hasExact()); }

TEST(ContinuousCheckFlushed, DoublesOfDenormalDifferences) { expectNothingIsMissed<double>({-1019, -1019, -1019}); }
TEST(ContinuousCheckFlushed, DoublesOfWhichOneAxisIsDenormal) { expectNothingIsMissed<double>({-1020, -500, -500}); }
TEST(ContinuousCheckFlushed, DoublesWhereTheSearchTakesOver) { expectNothingIsMissed<double>({-1020, -299, -299}); }
TEST(ContinuousCheckFlushed, FloatsOfWhichOneAxisIsDenormal) { expectNothingIsMissed<float>({-124, 0, 0}); }
TEST(ContinuousCheckFlushed, FloatsThatAreDenormal) { expectNothingIsMissed<float>({-124, -124, -124}); }

}  // namespace
}  // namespace wetcloth_test::continuous_check_flushed_exact_test

#endif
