// SPDX-License-Identifier: Zlib
// How air slows a drop, against Stokes' law and measured terminal velocities.

#include "bullet_wetcloth/numerics/DropFlight.h"

#include <gtest/gtest.h>

#include <cmath>

namespace wetcloth_test::drop_flight_test {
namespace {

using wetcloth::DropAir;
using wetcloth::DropMove;

// Gunn & Kinzer (1949), Table 2: drops of distilled water in stagnant air of 20 degrees Celsius and 1013 hPa.
struct Measured {
  double millimetres;
  double metresPerSecond;
};
constexpr Measured kMeasured[] = {{0.1, 0.27}, {0.2, 0.72}, {0.5, 2.06}, {1.0, 4.03}, {1.4, 5.17}, {2.0, 6.49},
                                  {2.6, 7.57}, {3.0, 8.06}, {3.6, 8.60}, {4.0, 8.83}, {5.0, 9.09}, {5.8, 9.17}};

TEST(DropDecay, AgreesWithMeasuredTerminalVelocities) {
  for (const Measured& drop : kMeasured) {
    const double speed = wetcloth::terminalSpeed(drop.millimetres / 1000, 9.81, DropAir());
    // What the header promises; the model was not fitted to this table.
    EXPECT_NEAR(speed, drop.metresPerSecond, 0.09 * drop.metresPerSecond) << drop.millimetres;
  }
}

TEST(DropDecay, IsStokesLawForTheSmallest) {
  const DropAir air;
  const double diameter = 1e-6;
  const double stokes = 18 * air.viscosity / (air.waterDensity * diameter * diameter);
  // At Re = 1e-6 the next term, 0.15 Re^0.687, is 1e-5.
  EXPECT_NEAR(wetcloth::dropDecay(diameter, 1.5e-5, air) / stokes, 1, 2e-5);
  EXPECT_DOUBLE_EQ(wetcloth::dropDecay(diameter, 0, air), stokes);
}

TEST(DropDecay, GoesOnWhereTheTwoLawsMeet) {
  const DropAir air;
  const double diameter = 3e-3;
  const double meeting = 1000 * air.viscosity / (air.density * diameter);
  // 0.44 against 24 (1 + 0.15 1000^0.687) / 1000 = 0.438.
  EXPECT_NEAR(
      wetcloth::dropDecay(diameter, meeting * 1.000001, air) / wetcloth::dropDecay(diameter, meeting * 0.999999, air),
      1, 5e-3);
}

TEST(DropDecay, IsNothingInAVacuum) {
  DropAir vacuum;
  vacuum.density = 0;
  vacuum.viscosity = 0;
  EXPECT_EQ(wetcloth::dropDecay(1e-3, 10, vacuum), 0);
}

TEST(DropSize, IsThatOfASphere) {
  const double mass = wetcloth::dropMass(2e-3, 1000);
  EXPECT_NEAR(mass, 4.0 / 3 * 3.14159265358979 * 1e-9 * 1000, 1e-20);
  EXPECT_NEAR(wetcloth::dropDiameter(mass, 1000), 2e-3, 1e-17);
}

TEST(DropMove, IsExactWhileTheRateIsTheSame) {
  for (const double decay : {0.0, 1e-9, 0.1, 0.24, 0.2401, 3.0, 1e4, 1e9}) {
    const double dt = 1.0 / 240;
    double velocity = 5;
    double way = 0;
    for (int i = 0; i < 100; ++i) {
      const DropMove move(decay, dt);
      way += move.way(velocity, 2, -9.81);
      velocity = move.velocity(velocity, 2, -9.81);
    }
    const DropMove whole(decay, 100 * dt);
    // Rounding of a hundred steps; the series ends with z^4, 1e-13 at most.
    EXPECT_NEAR(velocity, whole.velocity(5, 2, -9.81), 1e-11) << decay;
    EXPECT_NEAR(way, whole.way(5, 2, -9.81), 1e-11) << decay;
  }
}

TEST(DropMove, IsAParabolaWithoutAir) {
  const DropMove move(0, 0.5);
  EXPECT_EQ(move.velocity(3, 7, -9.81), 3 - 9.81 * 0.5);
  EXPECT_NEAR(move.way(3, 7, -9.81), 3 * 0.5 - 9.81 * 0.125, 1e-15);
}

TEST(DropMove, EndsAtTheWindWithoutGravity) {
  EXPECT_NEAR(DropMove(1e3, 1).velocity(5, 2, 0), 2, 1e-15);
  EXPECT_NEAR(DropMove(1e3, 1).velocity(0, 0, -9.81), -9.81e-3, 1e-15);
}

}  // namespace
}  // namespace wetcloth_test::drop_flight_test
