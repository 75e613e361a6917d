// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/solver/GuardPlanes.h"

#include "bullet_wetcloth/numerics/InstructionSet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

namespace wetcloth_test::guard_planes_test {
namespace {

using wetcloth::GuardNodes;
using wetcloth::GuardPlanes;
using wetcloth::InstructionSet;

constexpr int kNodes = 50;

class SomePlanes : public testing::TestWithParam<InstructionSet> {
 protected:
  SomePlanes() { wetcloth::forceInstructionSet(GetParam()); }
  ~SomePlanes() override { wetcloth::forceInstructionSet(InstructionSet::avx2); }

  btScalar number() { return m_numbers(m_random); }
  std::vector<GuardNodes::Place> places() {
    std::vector<GuardNodes::Place> places(kNodes);
    for (GuardNodes::Place& place : places) place = {{number(), number(), number(), 0}};
    return places;
  }
  GuardPlanes planes(int first, int count) {
    GuardPlanes planes(first);
    for (int k = 0; k < count; ++k) {
      GuardPlanes::Plane plane = {};
      for (int& node : plane.pair.node) node = m_nodes(m_random);
      for (btScalar& axis : plane.normal) axis = number();
      for (int which = 1; which < 4; ++which) plane.weights[which] = number();
      plane.weights[0] = -(plane.weights[1] + plane.weights[2] + plane.weights[3]);
      plane.gap = static_cast<btScalar>(k);
      plane.apart = static_cast<btScalar>(2 * k);
      planes.add(plane);
    }
    return planes;
  }

 private:
  std::mt19937 m_random{3};
  std::uniform_real_distribution<btScalar> m_numbers{-1, 1};
  std::uniform_int_distribution<int> m_nodes{0, kNodes - 1};
};

// Bit for bit: nearest() measures plane by plane, and is the same for all processors.
TEST_P(SomePlanes, OfABlockAreMeasuredAsEachByItself) {
  const std::vector<GuardNodes::Place> at = places();
  for (const int first : {1, 2}) {
    for (int count = 1; count < 40; ++count) {
      GuardPlanes some = planes(first, count);
      ASSERT_EQ(some.size(), std::size_t(count));
      for (std::size_t block = 0; block < some.blocks(); ++block) some.measure(block, at);
      some.keep();
      for (std::size_t plane = 0; plane < some.size(); ++plane) {
        EXPECT_EQ(some.gap(plane), some.nearest(plane, at).gap);
        EXPECT_EQ(some.apart(plane), some.nearest(plane, at).apart);
      }
    }
  }
}

TEST_P(SomePlanes, ThatABlockLacksAreNeverBelowADistance) {
  const std::vector<GuardNodes::Place> at = places();
  for (int count = 1; count < 20; ++count) {
    GuardPlanes some = planes(2, count);
    std::size_t below = 0;
    for (std::size_t block = 0; block < some.blocks(); ++block) {
      for (unsigned bits = GuardPlanes::below(some.measure(block, at), 100, 100); bits != 0; bits >>= 1)
        below += bits & 1;
    }
    EXPECT_EQ(below, some.size());
  }
}

TEST_P(SomePlanes, ThatAreLeftAreTheOnesThatWereKept) {
  GuardPlanes some = planes(1, 30);
  const GuardPlanes before = some;
  EXPECT_EQ(some.filter([](std::size_t plane) { return plane % 3 != 0; }), 10U);
  ASSERT_EQ(some.size(), 20U);
  for (std::size_t plane = 0; plane < some.size(); ++plane) {
    const std::size_t was = plane / 2 * 3 + 1 + plane % 2;
    EXPECT_EQ(some.gap(plane), before.gap(was));
    EXPECT_EQ(some.apart(plane), before.apart(was));
    EXPECT_EQ(some.normal(plane), before.normal(was));
    for (int which = 0; which < 4; ++which) {
      EXPECT_EQ(some.node(plane, which), before.node(was, which));
      EXPECT_EQ(some.weight(plane, which), before.weight(was, which));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, SomePlanes, testing::Values(InstructionSet::baseline, InstructionSet::avx2));

TEST(GuardPlanes, ABitTellsWhatIsBelowADistance) {
  GuardPlanes::Measure measure;
  std::fill_n(measure.gap, GuardPlanes::kAtOnce, btScalar(1));
  std::fill_n(measure.apart, GuardPlanes::kAtOnce, btScalar(2));
  EXPECT_EQ(GuardPlanes::below(measure, 1, 2), 0U);
  measure.gap[1] = btScalar(0.5);
  measure.apart[6] = btScalar(1.5);
  measure.gap[3] = measure.apart[4] = std::numeric_limits<btScalar>::quiet_NaN();
  EXPECT_EQ(GuardPlanes::below(measure, 1, 2), 1U << 1 | 1U << 6 | 1U << 3 | 1U << 4);
}

}  // namespace
}  // namespace wetcloth_test::guard_planes_test
