// SPDX-License-Identifier: Zlib
// What the studies compare with, against physics: these share no code with the library.

#include "command/accuracy/BarenblattSpread.h"
#include "command/accuracy/MassSpringReference.h"
#include "command/accuracy/SwingingCloth.h"
#include "tests/support/BulletWorld.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace wetcloth_test::references_test {
namespace {

using accuracy::BarenblattSpread;
using accuracy::ClothRecord;
using accuracy::MassSpringReference;
using accuracy::SwingingCloth;

constexpr double kPi = 3.14159265358979323846;

/// A mass on a spring, in its rest position, with a speed of 1 m/s.
MassSpringReference oscillator() {
  std::vector<MassSpringReference::Point> points(2);
  points[0] = {{0, 0, 0}, 1, true};
  points[1] = {{1, 0, 0}, 2, false, {1, 0, 0}};
  return MassSpringReference(points, {{0, 1, 1, 8}}, 0);
}

double displacementAfter(double time, double dt) {
  MassSpringReference reference = oscillator();
  for (int i = 0; i < std::lround(time / dt); ++i) reference.step(dt);
  return reference.points()[1].position[0] - 1;
}

TEST(MassSpringReference, OscillatesAsTheClosedForm) {
  const double omega = std::sqrt(8. / 2);  // rad/s
  const double time = 3;
  const double exact = std::sin(omega * time) / omega;
  const double coarse = displacementAfter(time, 1e-2) - exact;
  const double fine = displacementAfter(time, 1e-3) - exact;
  EXPECT_NEAR(fine, 0, omega * omega * 1e-6 * time / 24 * 2);  // Verlet's phase error, doubled
  EXPECT_NEAR(coarse / fine, 100, 2);                          // second order
}

TEST(MassSpringReference, KeepsEnergyForThousandsOfPeriods) {
  MassSpringReference reference = oscillator();
  const double before = reference.kineticEnergy() + reference.springEnergy();
  double worst = 0;
  for (int i = 0; i < 200000; ++i) {
    reference.step(0.02);
    worst = std::max(worst, std::fabs(reference.kineticEnergy() + reference.springEnergy() - before));
  }
  // It wavers by (omega dt / 2)^2 and does not drift.
  EXPECT_LT(worst / before, std::pow(2 * 0.02, 2) / 4 * 1.01);
}

TEST(MassSpringReference, FallsFreely) {
  std::vector<MassSpringReference::Point> points(1);
  points[0] = {{0, 5, 0}, 3};
  MassSpringReference reference(points, {}, 9.81);
  for (int i = 0; i < 100; ++i) reference.step(0.01);
  EXPECT_NEAR(reference.points()[0].position[1], 5 - 9.81 / 2, 1e-12);  // exact for a constant force, but for rounding
  EXPECT_NEAR(reference.gravityEnergy() + reference.kineticEnergy(), 3 * 9.81 * 5, 1e-10);
}

TEST(SwingingCloth, ItsReferenceIsThePatchThatBulletGets) {
  for (const double angle : {0.0, 0.35}) {
    const SwingingCloth cloth{angle};
    const MassSpringReference reference = cloth.reference();
    btSoftBodyWorldInfo info;
    const auto body = cloth.patch().build(info);
    ASSERT_EQ(body->m_nodes.size(), static_cast<int>(reference.points().size()));
    for (int i = 0; i < body->m_nodes.size(); ++i) {
      const auto& point = reference.points()[static_cast<std::size_t>(i)];
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(static_cast<double>(body->m_nodes[i].m_x[axis]), point.position[static_cast<std::size_t>(axis)],
                    1e-6);  // btScalar may be float
      }
      EXPECT_EQ(point.isFixed, body->m_nodes[i].m_im == 0) << i;
      if (!point.isFixed) {
        EXPECT_NEAR(1 / static_cast<double>(body->m_nodes[i].m_im) / point.mass, 1, 1e-5) << i;
      }
    }
    EXPECT_EQ(reference.springEnergy() < 1e-20, true) << "made at rest";
  }
}

TEST(SwingingCloth, SagsByAboutTheSumOfItsRowsStretches) {
  // Each of the springs down carries what hangs below it: sum over n rows of m g k / (columns K), k = 1..n, which the
  // flexion springs (of 1/100 the stiffness) and the shear lower by a few percent.
  const int rows = SwingingCloth::side - 1;
  const double weight = 0.150 * 9.81 / rows;  // of a row [N]
  const double estimate = weight * rows * rows / 2 / (SwingingCloth::side * SwingingCloth::stiffness);
  const double sag = accuracy::sagOf(accuracy::recordReference({}, 1e-4, 0.5));
  EXPECT_LT(sag, estimate);
  EXPECT_GT(sag, 0.5 * estimate);
}

TEST(SwingingCloth, SwingsAboutAsAHangingChain) {
  // The lowest mode of a chain of length L: omega = 2.405 / 2 sqrt(g / L), first zero of the Bessel function J0. At 20
  // degrees a pendulum is slower by 0.8 %; and higher modes take part.
  const ClothRecord record = accuracy::recordReference({0.3490659}, 2e-4, 3);
  EXPECT_NEAR(accuracy::periodOf(record) / (2 * kPi / (2.4048 / 2 * std::sqrt(9.81))), 1, 0.05);
  EXPECT_NEAR(accuracy::energyDriftOf(record), 0, 0.01);  // what the springs hold for a while
}

TEST(BarenblattSpread, KeepsItsWaterAndSolvesItsEquation) {
  const BarenblattSpread spread;
  const auto water = [&](double time) {
    double sum = 0;
    for (int i = -5000; i <= 5000; ++i) sum += spread.saturation(i * 1e-4, time) * 1e-4;
    return sum;
  };
  EXPECT_NEAR(spread.saturation(0, 0), 0.9, 1e-12);
  EXPECT_NEAR(water(BarenblattSpread::duration) / water(0), 1, 1e-4);  // of the sum, at the root at its front
  // ds/dt = (D / 3) (s^3)_xx by central differences, inside the front.
  const double h = 1e-4;
  for (const double x : {0.0, 0.05, 0.1}) {
    const double time = 2;
    const double rate = (spread.saturation(x, time + h) - spread.saturation(x, time - h)) / (2 * h);
    const auto cube = [&](double place) { return std::pow(spread.saturation(place, time), 3); };
    const double flow = BarenblattSpread::diffusivity / 3 * (cube(x + h) - 2 * cube(x) + cube(x - h)) / (h * h);
    EXPECT_NEAR(rate, flow, 1e-5 * std::fabs(rate) + 1e-7) << x;  // second order in h
  }
}

}  // namespace
}  // namespace wetcloth_test::references_test
