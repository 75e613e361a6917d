// SPDX-License-Identifier: Zlib
#include "command/scene/MeasuredFront.h"

#include "Measured.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace command {
namespace {

std::string elasticityOf(const Scene& scene) {
  const auto hasSprings = [](const ClothScene& cloth) { return cloth.hasEffect("hooke_springs"); };
  if (std::any_of(scene.cloths.begin(), scene.cloths.end(), hasSprings)) return "HookeSprings";
  if (scene.world != WorldKind::deformable) return "Bullet's links";
  return scene.implicit ? "deformable, implicit" : "deformable, explicit";
}

bool isOfCloth(const StudyOfScene& study) { return study.study.rfind("cloth_", 0) == 0; }

/// A step and a number of iterations: what a scene can choose.
using Stepping = std::pair<double, int>;

bool concerns(const MeasuredPoint& point, const StudyOfScene& study, const Stepping& stepping) {
  // A step that was read from a file of decimal numbers.
  return point.study == study.study && point.method == study.method &&
         std::fabs(point.substep / stepping.first - 1) < 1e-6 &&
         (point.iterations == 0 || point.iterations == stepping.second);
}

/// Those of the cloth's own studies, which all have both; without a cloth's study the steps of all.
std::vector<Stepping> steppings(const std::vector<StudyOfScene>& studies, const std::vector<MeasuredPoint>& points) {
  std::vector<Stepping> found;
  for (const MeasuredPoint& point : points) {
    const bool isWanted = std::any_of(studies.begin(), studies.end(), [&](const StudyOfScene& study) {
      return isOfCloth(study) && point.study == study.study && point.method == study.method;
    });
    const Stepping stepping(point.substep, point.iterations);
    if (isWanted && std::find(found.begin(), found.end(), stepping) == found.end()) found.push_back(stepping);
  }
  return found;
}

/// None (a step of 0) when one of the studies was not made with this stepping.
SteppingChoice choiceOf(const std::vector<StudyOfScene>& studies, const Stepping& stepping,
                        const std::vector<MeasuredPoint>& points) {
  SteppingChoice choice;
  for (const StudyOfScene& study : studies) {
    const auto point = std::find_if(points.begin(), points.end(),
                                    [&](const MeasuredPoint& one) { return concerns(one, study, stepping); });
    if (point == points.end()) return {};
    choice.expected.push_back({study, point->error});
    // Of the cloth's studies the time is that of the whole step; the slower of them counts.
    if (isOfCloth(study)) choice.time = std::max(choice.time, point->time);
  }
  choice.substep = stepping.first;
  choice.iterations = stepping.second;
  return choice;
}

}  // namespace

std::vector<MeasuredPoint> readMeasuredPoints(const nlohmann::json& file) {
  std::vector<MeasuredPoint> points;
  for (const nlohmann::json& json : file.at("points")) {
    MeasuredPoint point;
    point.study = json.at("study");
    point.method = json.at("method");
    point.substep = json.at("substep_s");
    point.iterations = json.at("iterations");
    point.error = json.at("error").is_null() ? std::numeric_limits<double>::infinity() : json.at("error").get<double>();
    point.time = json.at("us_per_node_second");
    points.push_back(std::move(point));
  }
  return points;
}

const std::vector<MeasuredPoint>& measuredPoints() {
  static const std::vector<MeasuredPoint> points = readMeasuredPoints(nlohmann::json::parse(embedded::measured_json));
  return points;
}

std::vector<StudyOfScene> studiesOf(const Scene& scene) {
  const std::string elasticity = elasticityOf(scene);
  std::vector<StudyOfScene> studies{{"cloth_sag", elasticity}, {"cloth_period", elasticity}};
  const auto add = [&](const char* effect, const char* study, const char* method) {
    const auto has = [&](const ClothScene& cloth) { return cloth.hasEffect(effect); };
    if (std::any_of(scene.cloths.begin(), scene.cloths.end(), has)) studies.push_back({study, method});
  };
  add("absorption", "absorption", "exact, exposure at the start");
  add("diffusion", "diffusion", "factored");
  add("wind", "wind_quadratic", "semi-implicit");
  return studies;
}

double SteppingChoice::largestError() const { return worst().error; }

const SteppingChoice::Expectation& SteppingChoice::worst() const {
  return *std::max_element(expected.begin(), expected.end(),
                           [](const Expectation& a, const Expectation& b) { return a.error < b.error; });
}

SteppingChoice cheapestStepping(const std::vector<StudyOfScene>& studies, double error,
                                const std::vector<MeasuredPoint>& points) {
  SteppingChoice best;
  const auto isBetter = [error](const SteppingChoice& one, const SteppingChoice& other) {
    const bool isGood = one.largestError() <= error;
    if (isGood != (other.largestError() <= error)) return isGood;
    if (!isGood && one.largestError() != other.largestError()) return one.largestError() < other.largestError();
    return one.time < other.time;
  };
  for (const Stepping& stepping : steppings(studies, points)) {
    SteppingChoice choice = choiceOf(studies, stepping, points);
    if (choice.substep == 0) continue;
    if (best.substep == 0 || isBetter(choice, best)) best = std::move(choice);
  }
  return best;
}

SteppingChoice steppingWithin(const Scene& scene, double error) { return cheapestStepping(studiesOf(scene), error); }

void apply(const SteppingChoice& choice, Scene& scene) {
  // Not one more for a step that is a whole number of them but for rounding.
  scene.substeps = std::max(1, static_cast<int>(std::ceil(scene.step / choice.substep - 1e-6)));
  if (choice.iterations > 0) scene.iterations = choice.iterations;
}

}  // namespace command
