// SPDX-License-Identifier: Zlib
// Roots and signs at them against the oracle, for polynomials whose roots are multiple, common, at the ends of the
// interval, or nearly so.

#include <bullet_wetcloth/collision/ExactRoots.h>

#include "tests/collision/ExactOracle.h"

#include <gtest/gtest.h>

#include <optional>
#include <random>
#include <vector>

namespace wetcloth_test::exact_roots_test {
namespace {

using oracle::Rational;
using oracle::operator+;
using oracle::operator-;
using oracle::operator*;
using wetcloth::collision::exact::Integer;
using wetcloth::collision::exact::Polynomial;
using wetcloth::collision::exact::Root;
using wetcloth::collision::exact::RootFinder;

constexpr double kTolerance = 1e-12;

Polynomial ours(const oracle::Polynomial& p) {
  Polynomial result;
  for (std::size_t i = 0; i < p.size(); ++i) result.c[i] = Integer(p[i]);
  return result;
}

class Factory {
 public:
  int number(int largest) { return static_cast<int>(m_random() % static_cast<unsigned>(2 * largest + 1)) - largest; }

  /// Of few different roots, most of them in [0, 1], and some hardly different.
  oracle::Polynomial linear() {
    oracle::Polynomial p = {-(number(2) + 1), number(1) + 2};
    if (number(2) != 0) return oracle::trimmed(p);
    const unsigned closeness = number(1) > 0 ? 40 : 150;
    for (auto& coefficient : p) coefficient <<= closeness;
    p[0] += number(1);
    return oracle::trimmed(p);
  }

  oracle::Polynomial quadratic() {
    if (number(1) == 0) return oracle::trimmed({number(3), number(3), number(3)});
    oracle::Polynomial p = linear() * linear();
    if (number(1) == 0) p = p + oracle::Polynomial{number(1)};
    return p;
  }

  oracle::Polynomial cubic() { return number(1) == 0 ? linear() * quadratic() : linear() * linear() * linear(); }

 private:
  std::mt19937 m_random{20210702};
};

/// All roots in order, and the signs of the others there.
void expectRight(const oracle::Polynomial& p, const std::vector<oracle::Polynomial>& others) {
  const std::vector<oracle::Root> expected = oracle::rootsInUnitInterval(p);
  const Polynomial polynomial = ours(p);
  RootFinder finder(polynomial);
  for (const oracle::Root& root : expected) {
    std::optional<Root> found = finder.next();
    ASSERT_TRUE(found);
    for (const oracle::Polynomial& other : others) {
      Root copy = *found;
      EXPECT_EQ(found->sign(ours(other)), root.sign(other));
    }
    const Rational time(found->fromBelow(kTolerance));
    const Rational latest = time + Rational(kTolerance);
    EXPECT_GE(root.sign({-numerator(time), denominator(time)}), 0);
    EXPECT_LE(root.sign({-numerator(latest), denominator(latest)}), 0);
  }
  EXPECT_FALSE(finder.next());
  EXPECT_FALSE(finder.next());
}

TEST(ExactRoots, AgreeWithTheOracle) {
  Factory factory;
  for (int i = 0; i < 800; ++i) {
    SCOPED_TRACE(i);
    const oracle::Polynomial p = i % 3 == 0 ? factory.quadratic() : factory.cubic();
    expectRight(p, {factory.linear(), factory.quadratic(), factory.quadratic(), factory.quadratic()});
    if (HasFailure()) return;
  }
}

TEST(ExactRoots, AFractionThatOnlyTheDivisionDiscovers) {
  // g has roots on either side of 1/3, closer than any first look; p = (3t - 1) (g + much).
  const oracle::Polynomial third = {-1, 3};
  const oracle::Integer large = oracle::Integer(1) << 100;
  const oracle::Polynomial g = oracle::Polynomial{large} * third * third - oracle::Polynomial{1};
  for (const int sign : {-1, 1}) {
    const oracle::Polynomial signedG = oracle::Polynomial{sign} * g;
    expectRight(third * (signedG + oracle::Polynomial{2 * sign * large}),
                {signedG, third, signedG * oracle::Polynomial{5}});
  }
}

TEST(ExactRoots, MultipleRootsAloneAndBesideAnother) {
  const oracle::Polynomial third = {-1, 3};
  expectRight(third * third, {third});
  expectRight(third * third * third, {third});
  for (const oracle::Polynomial& other : {oracle::Polynomial{-33, 100}, {-34, 100}, {-1, 300}, {-299, 300}, {1, 1}}) {
    expectRight(third * third * other, {other, third, other * third, third * third});
  }
}

TEST(ExactRoots, OfConstantsThereAreNone) {
  for (const int value : {-1, 0, 1}) {
    const Polynomial constant = ours(oracle::trimmed({value}));
    EXPECT_FALSE(RootFinder(constant).next());
  }
}

}  // namespace
}  // namespace wetcloth_test::exact_roots_test
