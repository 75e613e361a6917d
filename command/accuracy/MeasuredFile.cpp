// SPDX-License-Identifier: Zlib
#include "command/accuracy/MeasuredFile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace accuracy {
namespace {

/// Without the half of its settings that some curves have in their names: "Bullet's links, 4 substeps". Empty for
/// springs with another number of iterations than the usual one, which no stepping can choose.
std::string methodOf(const Point& point) {
  const std::string links = "Bullet's links";
  const std::string springs = "HookeSprings";
  if (point.method.rfind(links, 0) == 0) return links;
  if (point.method.rfind(springs, 0) != 0) return point.method;
  return point.method == springs + ", 4 iterations" ? springs : "";
}

bool isOfStepping(const Study& study) {
  constexpr std::array<const char*, 5> names = {"absorption", "diffusion", "wind_quadratic", "cloth_sag",
                                                "cloth_period"};
  return std::find(names.begin(), names.end(), study.measure.name) != names.end();
}

/// A file that people compare between versions needs no more.
double rounded(double value) {
  const double scale = std::pow(10, 3 - std::floor(std::log10(std::max(value, 1e-300))));
  return std::round(value * scale) / scale;
}

}  // namespace

nlohmann::ordered_json measuredJson(const std::vector<Study>& studies) {
  nlohmann::ordered_json points = nlohmann::ordered_json::array();
  for (const Study& study : studies) {
    if (!isOfStepping(study)) continue;
    for (const Point& point : study.points) {
      if (!point.substep || methodOf(point).empty()) continue;
      nlohmann::ordered_json json;
      json["study"] = study.measure.name;
      json["method"] = methodOf(point);
      json["substep_s"] = *point.substep;
      json["iterations"] = point.iterations.value_or(0);
      json["error"] = std::isfinite(point.error) ? nlohmann::ordered_json(rounded(point.error)) : nullptr;
      json["us_per_node_second"] = rounded(point.microsecondsPerNodeSecond);
      points.push_back(json);
    }
  }
  return {{"points", points}};
}

}  // namespace accuracy
