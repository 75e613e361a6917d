// SPDX-License-Identifier: Zlib
#include "command/accuracy/PrecisionStudy.h"

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>

namespace accuracy {
namespace {

const nlohmann::json* mostAccurate(const nlohmann::json& study) {
  const nlohmann::json* best = nullptr;
  for (const nlohmann::json& point : study.at("points")) {
    if (!point.at("compared") || point.at("error").is_null()) continue;
    if (best == nullptr || point.at("error") < best->at("error")) best = &point;
  }
  return best;
}

/// The point of the same setting; null when there is none that stayed finite.
const nlohmann::json* sameSetting(const nlohmann::json& study, const nlohmann::json& point) {
  for (const nlohmann::json& other : study.at("points")) {
    if (other.at("setting") == point.at("setting") && !other.at("error").is_null()) return &other;
  }
  return nullptr;
}

Point pointOf(const nlohmann::json& study, const nlohmann::json& best, const std::string& precision) {
  Point point;
  point.method = study.at("name");
  point.label = precision;
  point.error = best.at("error");
  point.nanosecondsPerNodeStep = best.at("ns_per_node_step");
  point.microsecondsPerNodeSecond = best.at("us_per_node_second");
  return point;
}

/// What of the two is on the front of that study: the faster one, and the other if it is more accurate.
void markFront(Point& a, Point& b) {
  a.isOnFront = a.microsecondsPerNodeSecond <= b.microsecondsPerNodeSecond || a.error < b.error;
  b.isOnFront = b.microsecondsPerNodeSecond <= a.microsecondsPerNodeSecond || b.error < a.error;
}

std::string adviceOn(const Study& study) {
  std::string better;
  double ratio = 1;
  for (std::size_t i = 0; i + 1 < study.points.size(); i += 2) {
    const Point& single = study.points[i];
    const Point& twice = study.points[i + 1];
    ratio *= std::pow(twice.microsecondsPerNodeSecond / single.microsecondsPerNodeSecond,
                      2. / static_cast<double>(study.points.size()));
    // By a tenth: less is not worth another build of Bullet.
    if (twice.error < 0.9 * single.error) better += (better.empty() ? "" : ", ") + single.method;
  }
  char text[120];
  std::snprintf(text, sizeof text, "float64 takes %.2f times the time (geometric mean) and ", ratio);
  if (better.empty()) return text + std::string("is nowhere more accurate by a tenth: take float32.");
  return text + ("is more accurate by more than a tenth in " + better + " only.");
}

}  // namespace

Study comparePrecisions(const nlohmann::json& float32, const nlohmann::json& float64) {
  Study study;
  study.measure = {"precision", "float32 against float64",
                   "smallest error that the study reaches in float32, and that of the same setting in float64",
                   "that of each study"};
  study.knob = "precision";
  study.timed = "as in each study, at its most accurate setting";
  for (const nlohmann::json& one : float32) {
    for (const nlohmann::json& other : float64) {
      if (other.at("name") != one.at("name")) continue;
      const nlohmann::json* single = mostAccurate(one);
      const nlohmann::json* twice = single == nullptr ? nullptr : sameSetting(other, *single);
      if (twice == nullptr) continue;
      Point a = pointOf(one, *single, "float32");
      Point b = pointOf(other, *twice, "float64");
      markFront(a, b);
      study.points.push_back(a);
      study.points.push_back(b);
    }
  }
  study.advice = adviceOn(study);
  return study;
}

}  // namespace accuracy
