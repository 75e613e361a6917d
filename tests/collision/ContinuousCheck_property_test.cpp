// SPDX-License-Identifier: Zlib
// Properties on queries that rapidcheck makes up and, where one fails, shrinks.

#include "tests/support/QueryJudge.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <sstream>

namespace wetcloth_test::continuous_check_property_test {
namespace {

// Structure makes the hard cases: small fractions that coincide, neighbours of them, and the odd arbitrary number.
template <class Scalar>
rc::Gen<Scalar> coordinate() {
  const auto quarters = rc::gen::map(rc::gen::inRange(-8, 9), [](int value) { return static_cast<Scalar>(value) / 4; });
  const auto zero = rc::gen::just(Scalar(0));
  const auto neighbour = rc::gen::map(rc::gen::inRange(-8, 9), [](int value) {
    const Scalar exact = static_cast<Scalar>(value) / 4;
    return std::nextafter(exact, value % 2 == 0 ? Scalar(100) : Scalar(-100));
  });
  const auto fraction = rc::gen::map(rc::gen::inRange(-1000000, 1000001),
                                     [](int value) { return static_cast<Scalar>(value) / Scalar(333333); });
  return rc::gen::weightedOneOf<Scalar>({{6, quarters}, {2, zero}, {2, neighbour}, {2, fraction}});
}

template <class Scalar>
rc::Gen<Query<Scalar>> queries() {
  return rc::gen::map(
      rc::gen::container<std::vector<Scalar>>(24, coordinate<Scalar>()), [](const std::vector<Scalar>& numbers) {
        Query<Scalar> query;
        for (int place = 0; place < 24; ++place)
          (place < 12 ? query.start : query.end)[place % 12 / 3][place % 3] = numbers[static_cast<std::size_t>(place)];
        return query;
      });
}

// A sanitizer multiplies the time of exact integers by far more than a hundred.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int kCases = 200;
#else
constexpr int kCases = 4000;
#endif

// With a seed of its own each time the suite would not be the same twice.
template <class Property>
void expectHolds(std::uint64_t seed, const Property& property) {
  rc::detail::TestParams params;
  params.seed = seed;
  params.maxSuccess = kCases;
  params.maxSize = 1000;
  const auto result = rc::detail::checkTestable(property, rc::detail::TestMetadata(), params);
  std::ostringstream text;
  rc::detail::printResultMessage(result, text);
  EXPECT_TRUE(result.template is<rc::detail::SuccessResult>()) << text.str();
}

template <class Scalar>
void expectNoFaults(Pair pair, std::uint64_t seed) {
  int met = 0;
  expectHolds(seed, [pair, &met] {
    const Query<Scalar> query = *queries<Scalar>();
    const Verdict verdict = verdictOn(pair, query);
    met += verdict.meets ? 1 : 0;
    for (const Way& way : everyWay()) {
      const std::string fault = faultOf(way.tier, pair, query, ask(way, pair, query), verdict);
      if (!fault.empty()) RC_FAIL(std::string(way.name) + " " + fault + ": " + literal(pair, query));
    }
  });
  EXPECT_GT(met, kCases / 40);
}

TEST(ContinuousCheckProperty, NoFaultOnVertexFaceInDouble) { expectNoFaults<double>(Pair::vertexFace, 81); }
TEST(ContinuousCheckProperty, NoFaultOnEdgeEdgeInDouble) { expectNoFaults<double>(Pair::edgeEdge, 82); }
TEST(ContinuousCheckProperty, NoFaultOnVertexFaceInFloat) { expectNoFaults<float>(Pair::vertexFace, 83); }
TEST(ContinuousCheckProperty, NoFaultOnEdgeEdgeInFloat) { expectNoFaults<float>(Pair::edgeEdge, 84); }

// Shrinking an edge to one of its ends can only lose contacts.
TEST(ContinuousCheckProperty, AnEdgeMeetsWhereverItsEndsDo) {
  expectHolds(85, [] {
    const Query<double> edges = *queries<double>();
    Query<double> ends = edges;
    std::copy(&ends.start[0][0], &ends.start[0][0] + 3, &ends.start[1][0]);
    std::copy(&ends.end[0][0], &ends.end[0][0] + 3, &ends.end[1][0]);
    if (verdictOn(Pair::edgeEdge, ends).meets)
      for (const Way& way : everyWay()) RC_ASSERT(ask(way, Pair::edgeEdge, edges).found);
  });
}

// Whatever meets an edge of the face meets the face.
TEST(ContinuousCheckProperty, AFaceIsMetWhereverItsEdgesAre) {
  expectHolds(86, [] {
    const Query<double> face = *queries<double>();
    Query<double> edge = face;
    std::copy(&face.start[0][0], &face.start[0][0] + 3, &edge.start[1][0]);
    std::copy(&face.end[0][0], &face.end[0][0] + 3, &edge.end[1][0]);
    if (verdictOn(Pair::edgeEdge, edge).meets)
      for (const Way& way : everyWay()) RC_ASSERT(ask(way, Pair::vertexFace, face).found);
  });
}

}  // namespace
}  // namespace wetcloth_test::continuous_check_property_test
