// SPDX-License-Identifier: Zlib
#include "command/accuracy/ConvergenceOrder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace accuracy {
namespace {

/// Student's t at 97.5 %, for 1, 2, ... degrees of freedom.
double studentsT(std::size_t freedom) {
  static constexpr std::array<double, 10> table = {12.706, 4.303, 3.182, 2.776, 2.571,
                                                   2.447,  2.365, 2.306, 2.262, 2.228};
  return freedom <= table.size() ? table[freedom - 1] : 2.0;
}

constexpr double notConverging = 0.3;
constexpr double rounding = 1e-12;

/// Errors of a method's points from `smallest` on, where the knob decides. The end of a curve that has become level is
/// not among them: what another error leaves there would pass for a lower order.
std::vector<const Point*> convergingPoints(const std::vector<Point>& points, const std::string& method,
                                           double smallest) {
  std::vector<const Point*> converging;
  for (const Point& point : points) {
    if (point.method == method && point.error > smallest && point.error < notConverging) converging.push_back(&point);
  }
  if (converging.empty()) return converging;
  const auto lower = [](const Point* a, const Point* b) { return a->error < b->error; };
  const double level = 1.5 * (*std::min_element(converging.begin(), converging.end(), lower))->error;
  const auto isLevel = [&](const Point* point) { return point->error < level; };
  if (std::count_if(converging.begin(), converging.end(), isLevel) > 1) {
    converging.erase(std::remove_if(converging.begin(), converging.end(), isLevel), converging.end());
  }
  return converging;
}

}  // namespace

std::optional<Order> fitOrder(const std::vector<double>& knobs, const std::vector<double>& errors) {
  const std::size_t count = knobs.size();
  if (count < 3) return std::nullopt;
  double meanX = 0;
  double meanY = 0;
  for (std::size_t i = 0; i < count; ++i) {
    meanX += std::log(knobs[i]) / static_cast<double>(count);
    meanY += std::log(errors[i]) / static_cast<double>(count);
  }
  double xx = 0;
  double xy = 0;
  for (std::size_t i = 0; i < count; ++i) {
    xx += (std::log(knobs[i]) - meanX) * (std::log(knobs[i]) - meanX);
    xy += (std::log(knobs[i]) - meanX) * (std::log(errors[i]) - meanY);
  }
  if (!(xx > 0)) return std::nullopt;
  Order order;
  order.value = xy / xx;
  order.points = static_cast<int>(count);
  double residual = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double miss = std::log(errors[i]) - meanY - order.value * (std::log(knobs[i]) - meanX);
    residual += miss * miss;
  }
  order.halfWidth = studentsT(count - 2) * std::sqrt(residual / static_cast<double>(count - 2) / xx);
  return order;
}

std::vector<Order> ordersOf(const std::vector<Point>& points, double referenceError) {
  std::vector<Order> orders;
  for (const std::string& method : methodsOf(points)) {
    std::vector<double> knobs;
    std::vector<double> errors;
    for (const Point* point : convergingPoints(points, method, std::max(rounding, 4 * referenceError))) {
      knobs.push_back(point->knob);
      errors.push_back(point->error);
    }
    if (std::optional<Order> order = fitOrder(knobs, errors)) {
      order->method = method;
      orders.push_back(*order);
    }
  }
  return orders;
}

double richardsonError(double coarse, double fine, double ratio, double order) {
  return std::fabs(fine - coarse) / (std::pow(ratio, order) - 1);
}

}  // namespace accuracy
