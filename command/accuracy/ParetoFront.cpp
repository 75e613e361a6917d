// SPDX-License-Identifier: Zlib
#include "command/accuracy/ParetoFront.h"

#include <algorithm>
#include <cmath>

namespace accuracy {
namespace {

bool counts(const Point& point) { return point.isCompared && std::isfinite(point.error); }

bool beats(const Point& one, const Point& other) {
  const double time = one.microsecondsPerNodeSecond - other.microsecondsPerNodeSecond;
  const double error = one.error - other.error;
  return time <= 0 && error <= 0 && (time < 0 || error < 0);
}

}  // namespace

void markFront(std::vector<Point>& points) {
  for (Point& point : points) {
    point.isOnFront = counts(point) && std::none_of(points.begin(), points.end(), [&](const Point& other) {
                        return counts(other) && beats(other, point);
                      });
  }
}

}  // namespace accuracy
