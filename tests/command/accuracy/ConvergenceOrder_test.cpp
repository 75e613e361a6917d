// SPDX-License-Identifier: Zlib
// Orders, fronts and extrapolation, on numbers whose answers are known.

#include "command/accuracy/ConvergenceOrder.h"
#include "command/accuracy/Advice.h"
#include "command/accuracy/ParetoFront.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace wetcloth_test::convergence_order_test {
namespace {

using accuracy::fitOrder;
using accuracy::Order;
using accuracy::ordersOf;
using accuracy::Point;

Point pointAt(double knob, double error, const std::string& method = "method", double time = 1) {
  Point point;
  point.method = method;
  point.knob = knob;
  point.error = error;
  point.microsecondsPerNodeSecond = time;
  return point;
}

TEST(ConvergenceOrder, OfAPowerIsItsExponent) {
  const std::vector<double> knobs{0.01, 0.02, 0.05, 0.1};
  for (const double exponent : {0.5, 1.0, 2.0, 4.0}) {
    std::vector<double> errors;
    for (const double knob : knobs) errors.push_back(3 * std::pow(knob, exponent));
    const auto order = fitOrder(knobs, errors);
    ASSERT_TRUE(order);
    EXPECT_NEAR(order->value, exponent, 1e-12);  // rounding of four logarithms
    EXPECT_NEAR(order->halfWidth, 0, 1e-6);      // the root of a sum that is rounding alone
    EXPECT_EQ(order->points, 4);
  }
}

TEST(ConvergenceOrder, IsWithinItsIntervalWhenTheErrorsScatter) {
  // Residuals +d, -2d, +d about slope 1 over equal steps of log(knob): they are orthogonal to a line, so the slope is
  // still 1; with one degree of freedom its standard error is sqrt(6 d^2 / (2 l^2)).
  const double d = 0.1;
  const double l = std::log(2);
  const std::vector<double> knobs{1, 2, 4};
  const std::vector<double> errors{std::exp(d), 2 * std::exp(-2 * d), 4 * std::exp(d)};
  const auto order = fitOrder(knobs, errors);
  ASSERT_TRUE(order);
  EXPECT_NEAR(order->value, 1, 1e-12);
  EXPECT_NEAR(order->halfWidth, 12.706 * std::sqrt(6 * d * d / (2 * l * l)), 1e-9);
}

TEST(ConvergenceOrder, NeedsThreePoints) {
  EXPECT_FALSE(fitOrder({1, 2}, {1, 2}));
  EXPECT_FALSE(fitOrder({1, 1, 1}, {1, 2, 3}));
}

TEST(ConvergenceOrder, LeavesOutTheLevelEndAndWhatDoesNotConvergeYet) {
  std::vector<Point> points;
  for (const double dt : {0.001, 0.002, 0.004}) points.push_back(pointAt(dt, 1e-3));  // another error's
  for (const double dt : {0.01, 0.02, 0.04}) points.push_back(pointAt(dt, 100 * dt * dt));
  points.push_back(pointAt(1, 5));
  points.push_back(pointAt(2, std::numeric_limits<double>::infinity()));
  const std::vector<Order> orders = ordersOf(points, 0);
  ASSERT_EQ(orders.size(), 1u);
  EXPECT_NEAR(orders[0].value, 2, 1e-9);
  EXPECT_EQ(orders[0].points, 3);
}

TEST(ConvergenceOrder, CountsNoErrorNearThatOfTheReference) {
  std::vector<Point> points;
  for (const double dt : {0.001, 0.002, 0.004, 0.008}) points.push_back(pointAt(dt, dt));
  EXPECT_EQ(ordersOf(points, 0).size(), 1u);
  EXPECT_TRUE(ordersOf(points, 0.0011).empty());  // two of them are within 4 times that
}

TEST(Richardson, IsExactForAnErrorOfThatOrder) {
  const double limit = 0.7;
  const auto result = [limit](double step, double order) { return limit + 0.3 * std::pow(step, order); };
  for (const double order : {1.0, 2.0, 4.0}) {
    const double fine = result(0.05, order);
    EXPECT_NEAR(accuracy::richardsonError(result(0.1, order), fine, 2, order), fine - limit, 1e-12);
  }
}

TEST(ParetoFront, IsWhatNothingBeats) {
  std::vector<Point> points{pointAt(1, 0.1, "fast", 1),      pointAt(1, 0.01, "accurate", 10),
                            pointAt(1, 0.1, "slow", 2),      pointAt(1, 0.05, "between", 3),
                            pointAt(1, 0.02, "beaten", 11),  pointAt(1, 0.01, "as good", 10),
                            pointAt(1, 1e-9, "no way", 0.1), pointAt(1, std::nan(""), "not a number", 0.1)};
  points[6].isCompared = false;
  accuracy::markFront(points);
  std::vector<std::string> front;
  for (const Point& point : points) {
    if (point.isOnFront) front.push_back(point.method);
  }
  EXPECT_EQ(front, (std::vector<std::string>{"fast", "accurate", "between", "as good"}));
}

TEST(Advice, NamesTheFastestWithinOnePercentAndTheMostAccurate) {
  std::vector<Point> points{pointAt(1, 0.1, "coarse", 1), pointAt(1, 0.008, "usual", 4), pointAt(1, 1e-6, "best", 40)};
  accuracy::markFront(points);
  const std::string advice = accuracy::adviceOn(points);
  EXPECT_NE(advice.find("usual"), std::string::npos) << advice;
  EXPECT_NE(advice.find("best"), std::string::npos) << advice;
  EXPECT_NE(advice.find("10 times"), std::string::npos) << advice;
  EXPECT_EQ(advice.find("coarse"), std::string::npos) << advice;
  EXPECT_EQ(accuracy::fastestWithin(points, 1e-7), nullptr);
}

}  // namespace
}  // namespace wetcloth_test::convergence_order_test
