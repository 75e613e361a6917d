// SPDX-License-Identifier: Zlib
#include "command/accuracy/Advice.h"

#include <cmath>
#include <cstdio>

namespace accuracy {

const Point* fastestWithin(const std::vector<Point>& points, double error) {
  const Point* fastest = nullptr;
  for (const Point& point : points) {
    if (!point.isOnFront || point.error > error) continue;
    if (fastest == nullptr || point.microsecondsPerNodeSecond < fastest->microsecondsPerNodeSecond) fastest = &point;
  }
  return fastest;
}

std::string errorText(double error) {
  if (!std::isfinite(error)) return "blows up";
  char text[32];
  if (error == 0) return "0";
  if (error >= 1e-4) {
    std::snprintf(text, sizeof text, error < 0.995 ? "%.2g %%" : "%.0f %%", 100 * error);
  } else {
    std::snprintf(text, sizeof text, "%.1e", error);
  }
  return text;
}

std::string adviceOn(const std::vector<Point>& points) {
  const Point* best = nullptr;
  for (const Point& point : points) {
    if (point.isOnFront && (best == nullptr || point.error < best->error)) best = &point;
  }
  if (best == nullptr) return "Nothing that was tried stays finite.";
  const Point* usual = fastestWithin(points, 0.01);
  char text[480];
  if (usual == nullptr) {
    std::snprintf(text, sizeof text, "Nothing comes below 1 %%: the nearest is %s (%s, %.3g us per node and second).",
                  best->name().c_str(), errorText(best->error).c_str(), best->microsecondsPerNodeSecond);
  } else if (usual == best) {
    std::snprintf(text, sizeof text, "Take %s: it is the most accurate (%s), and nothing faster comes below 1 %%.",
                  best->name().c_str(), errorText(best->error).c_str());
  } else {
    std::snprintf(text, sizeof text, "For 1 %% take %s (%s); the most accurate is %s (%s), at %.3g times the time.",
                  usual->name().c_str(), errorText(usual->error).c_str(), best->name().c_str(),
                  errorText(best->error).c_str(), best->microsecondsPerNodeSecond / usual->microsecondsPerNodeSecond);
  }
  return text;
}

}  // namespace accuracy
