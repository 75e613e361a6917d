// SPDX-License-Identifier: Zlib
// What a tilted glass holds, against a sum over slices.

#include "bullet_wetcloth/numerics/TiltedGlass.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace wetcloth_test::tilted_glass_test {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kRadius = 0.035;
constexpr double kHeight = 0.1;

// Slices along the direction of the tilt: 2 sqrt(R^2 - x^2) wide, the water as high as the plane through the lip.
double bySlices(double angle) {
  constexpr int slices = 200000;
  const double slope = std::tan(angle);
  double sum = 0;
  for (int i = 0; i < slices; ++i) {
    const double x = kRadius * (2 * (i + 0.5) / slices - 1);
    sum += 2 * std::sqrt(kRadius * kRadius - x * x) * std::max(0.0, kHeight - (kRadius - x) * slope);
  }
  return sum * 2 * kRadius / slices;
}

TEST(TiltedGlass, HoldsWhatIsBelowItsLip) {
  const double full = kPi * kRadius * kRadius * kHeight;
  for (const double angle : {0.0, 0.2, 0.6, 0.95, 0.97, 1.2, 1.4, 1.55}) {
    // The sum's own error, of sqrt at its ends.
    EXPECT_NEAR(wetcloth::heldInTiltedGlass(kRadius, kHeight, std::cos(angle)), bySlices(angle), 1e-7 * full) << angle;
  }
}

TEST(TiltedGlass, IsFullUprightAndEmptyLying) {
  EXPECT_DOUBLE_EQ(wetcloth::heldInTiltedGlass(kRadius, kHeight, 1), kPi * kRadius * kRadius * kHeight);
  EXPECT_EQ(wetcloth::heldInTiltedGlass(kRadius, kHeight, 0), 0);
  EXPECT_EQ(wetcloth::heldInTiltedGlass(kRadius, kHeight, -1), 0);
  double last = 1;
  for (int i = 0; i <= 1000; ++i) {
    const double held = wetcloth::heldInTiltedGlass(kRadius, kHeight, std::cos(kPi / 2 * i / 1000));
    EXPECT_LE(held, last);
    EXPECT_GE(held, 0);
    last = held;
  }
}

}  // namespace
}  // namespace wetcloth_test::tilted_glass_test
