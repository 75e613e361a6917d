// SPDX-License-Identifier: Zlib
// Basori et al. 2017, claim S8: the cubic of Eq. 8, whose roots are the times of possible contact.

#include "bullet_wetcloth/collision/CoplanarityCubic.h"
#include "bullet_wetcloth/collision/ContinuousCheck.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

namespace wetcloth_test::paper_coplanarity_cubic_test {
namespace {

using wetcloth::collision::ContinuousCheck;
using wetcloth::collision::CoplanarityCubic;
using wetcloth::collision::Pair;
using wetcloth::collision::Query;
using Wide = long double;
using WideVector = std::array<Wide, 3>;

/// x_i1 + t v_i1, the paper's notation, of points numbered from 1.
WideVector relative(const Query<double>& query, int i, Wide t) {
  WideVector result;
  for (std::size_t k = 0; k < 3; ++k) {
    const Wide x = Wide(query.start[i - 1][k]) - query.start[0][k];
    const Wide moved = Wide(query.end[i - 1][k]) - query.end[0][k];
    result[k] = x + t * (moved - x);
  }
  return result;
}

/// (x21 + t v21) x (x31 + t v31) . (x41 + t v41), as it is printed.
Wide equation8(const Query<double>& query, Wide t) {
  const WideVector a = relative(query, 2, t);
  const WideVector b = relative(query, 3, t);
  const WideVector c = relative(query, 4, t);
  return (a[1] * b[2] - a[2] * b[1]) * c[0] + (a[2] * b[0] - a[0] * b[2]) * c[1] + (a[0] * b[1] - a[1] * b[0]) * c[2];
}

TEST(PaperCubic, S8_TheCubicIsThatOfEquation8) {
  std::mt19937 random(8);
  const auto coordinate = [&] { return double(random()) / 4294967296.0 - 0.5; };
  for (int i = 0; i < 200; ++i) {
    Query<double> query;
    for (auto* points : {&query.start, &query.end})
      for (auto& point : *points)
        for (double& x : point) x = coordinate();
    const CoplanarityCubic cubic = coplanarityCubic(query);
    for (const double t : {0.0, 0.25, 0.5, 0.8125, 1.0})
      // Besides its coefficients' error, de Casteljau's scheme rounds three times; 1e-15 is 9 roundings of values
      // below 1.
      EXPECT_NEAR(cubic.value(t), double(equation8(query, t)), cubic.error + 1e-15) << "query " << i << ", t = " << t;
  }
}

// A node that falls with 2 m/s onto a triangle that rises with 1 m/s, 0.3 m apart: they meet after 0.1 s.
TEST(PaperCubic, S8_TheRootIsTheTimeOfContact) {
  constexpr double step = 0.125;  // [s]
  const Query<double> query = {{{0.1, 0.3, 0.1}, {0, 0, 0}, {1, 0, 0}, {0, 0, 1}},
                               {{0.1, 0.3 - 2 * step, 0.1}, {0, step, 0}, {1, step, 0}, {0, step, 1}}};
  const CoplanarityCubic cubic = coplanarityCubic(query);
  EXPECT_GT(cubic.value(0.79) * cubic.value(0), 0);
  EXPECT_LT(cubic.value(0.81) * cubic.value(0), 0);
  const auto contact = ContinuousCheck()(Pair::vertexFace, query);
  ASSERT_TRUE(contact);
  EXPECT_NEAR(contact.time * step, 0.1, 1e-6 * step + 1e-15);  // the check's tolerance, from below
}

}  // namespace
}  // namespace wetcloth_test::paper_coplanarity_cubic_test
