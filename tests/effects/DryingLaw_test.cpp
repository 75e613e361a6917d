// SPDX-License-Identifier: Zlib
// The law of drying over plain numbers: vapour pressure, rate, the two stages, drying time.

#include "bullet_wetcloth/effects/Drying.h"

#include "tests/support/ClothScene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace wetcloth_test::drying_law_test {
namespace {

using wetcloth::dryingStep;
using wetcloth::dryingTime;
using wetcloth::evaporationRate;
using wetcloth::saturationVapourPressure;

TEST(DryingRate, VapourPressureAgreesWithTheTables) {
  // Over water, IAPWS-95 (Wagner & Pruss 2002) [Pa].
  const double table[][2] = {{0.01, 611.66}, {10, 1228.2}, {20, 2339.3}, {30, 4246.9}, {40, 7384.9}, {60, 19946}};
  for (const auto& row : table) EXPECT_NEAR(saturationVapourPressure(row[0]) / row[1], 1, 2e-3) << row[0];
}

TEST(DryingRate, IsPenmansInHisUnits) {
  // 6.43 x 1.169 kPa / 2.45 = 3.07 kg/m^2/day = 128 g/m^2/h at 20 degrees, 50 %, in still air.
  EXPECT_NEAR(evaporationRate(20, 0.5, 0) * 3600, 0.1279, 0.0001);
  EXPECT_NEAR(evaporationRate(20, 0.5, 0) * 86400 * 2.45 / 6.43, saturationVapourPressure(20) / 2000, 1e-12);
}

TEST(DryingRate, WindAndHumidityChangeItAsTheFormulaSays) {
  const double still = evaporationRate(20, 0.5, 0);
  EXPECT_NEAR(evaporationRate(20, 0.5, 4) / still, 1 + 0.536 * 4, 1e-14);
  EXPECT_NEAR(evaporationRate(20, 0.8, 0) / still, 0.2 / 0.5, 1e-14);
  EXPECT_NEAR(evaporationRate(20, 0, 0) / still, 2, 1e-14);
  EXPECT_EQ(evaporationRate(20, 1, 10), 0);
  EXPECT_GT(evaporationRate(30, 0.5, 0), 1.7 * still);  // 4247 over 2339 Pa
}

TEST(DryingStep, IsConstantAboveTheCriticalContent) {
  EXPECT_DOUBLE_EQ(dryingStep(10, 3, 0.5, 4), 2);
  EXPECT_DOUBLE_EQ(dryingStep(10, 3, 0.5, 14), 7);
  EXPECT_EQ(dryingStep(10, 3, 0.5, 0), 0);
  EXPECT_EQ(dryingStep(10, 3, 0, 100), 0);
}

TEST(DryingStep, IsExponentialBelowIt) {
  EXPECT_NEAR(dryingStep(2, 4, 0.5, 8), 2 * (1 - std::exp(-1.0)), 1e-15);
  EXPECT_NEAR(dryingStep(2, 4, 0.5, 1e-16) / 2.5e-17, 1, 1e-14) << "small steps keep their digits";
}

TEST(DryingStep, CrossesTheChangeOfStageExactly) {
  // 2 s to fall from 4 to 3, then 6 s of the exponential with the time constant 3 / 0.5 = 6 s.
  EXPECT_NEAR(dryingStep(4, 3, 0.5, 8), 1 + 3 * (1 - std::exp(-1.0)), 1e-15);
  const double above = dryingStep(3 * (1 + 1e-9), 3, 0.5, 1);
  const double below = dryingStep(3 * (1 - 1e-9), 3, 0.5, 1);
  EXPECT_NEAR(above, below, 1e-8) << "the rate has no jump";
}

TEST(DryingStep, DoesNotDependOnHowTheTimeIsSplit) {
  for (const double held : {0.5, 2.9999, 3.0, 3.0001, 5.0, 20.0}) {
    for (const double first : {1e-6, 0.1, 1.0, 3.9, 4.0, 15.0}) {
      const double whole = dryingStep(held, 3, 0.5, 16);
      const double part = dryingStep(held, 3, 0.5, first);
      EXPECT_NEAR(part + dryingStep(held - part, 3, 0.5, 16 - first), whole, 1e-14) << held << " " << first;
    }
  }
}

TEST(DryingStep, NeverTakesMoreThanThereIs) {
  for (const double held : {0.0, 1e-300, 1e-9, 1.0, 1e9}) {
    for (const double dt : {1e-6, 1.0, 1e3, 1e300}) {
      const double left = dryingStep(held, 3, 0.5, dt);
      EXPECT_GE(left, 0);
      EXPECT_LE(left, held) << held << " " << dt;
    }
  }
}

TEST(DryingTime, IsTheInverseOfTheStep) {
  for (const double from : {1.0, 3.0, 7.0}) {
    for (const double to : {0.01, 0.5, 2.9, 3.0, 5.0}) {
      if (to >= from) continue;
      EXPECT_NEAR(from - dryingStep(from, 3, 0.5, dryingTime(from, to, 3, 0.5)), to, 1e-14) << from << " " << to;
    }
  }
}

TEST(DryingTime, OfSpecialCases) {
  EXPECT_DOUBLE_EQ(dryingTime(7, 5, 3, 0.5), 4);
  EXPECT_DOUBLE_EQ(dryingTime(7, 3 * std::exp(-2.0), 3, 0.5), 8 + 12);
  EXPECT_EQ(dryingTime(2, 2, 3, 0.5), 0);
  EXPECT_EQ(dryingTime(2, 5, 3, 0.5), 0);
  EXPECT_EQ(dryingTime(2, 0, 3, 0.5), HUGE_VAL) << "an exponential never arrives";
  EXPECT_EQ(dryingTime(2, 1, 3, 0), HUGE_VAL);
}

}  // namespace
}  // namespace wetcloth_test::drying_law_test
