// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/Scene.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace command {

/// What `wetcloth accuracy` measured of one way to step, as it is kept in measured.json.
struct MeasuredPoint {
  std::string study;   ///< "cloth_period"
  std::string method;  ///< "HookeSprings"
  double substep = 0;  ///< [s]
  int iterations = 0;  ///< 0 where they do not matter
  double error = 0;    ///< relative; infinite where it blew up
  double time = 0;     ///< [us per node and simulated second]
};

/// All that was measured, on one machine: see docs/accuracy.md.
const std::vector<MeasuredPoint>& measuredPoints();
/// The points of a file such as measured.json.
std::vector<MeasuredPoint> readMeasuredPoints(const nlohmann::json& file);

/// A study that bears on a scene, and the way in which the scene does it.
struct StudyOfScene {
  std::string study;
  std::string method;
};

/// By the scene's effects, its world and what holds its cloths together.
std::vector<StudyOfScene> studiesOf(const Scene& scene);

/// How a scene is to be stepped, and what that comes to.
struct SteppingChoice {
  struct Expectation {
    StudyOfScene study;
    double error = 0;
  };

  double substep = 0;  ///< [s]
  int iterations = 0;  ///< 0: the scene's own
  double time = 0;     ///< of the whole step [us per node and simulated second]
  std::vector<Expectation> expected;

  double largestError() const;
  /// The study that is the farthest off.
  const Expectation& worst() const;
};

/// The cheapest way that was measured whose error is at most `error` in each of these studies; when there is none, the
/// most accurate one, and of several that are as accurate the cheapest.
SteppingChoice cheapestStepping(const std::vector<StudyOfScene>& studies, double error,
                                const std::vector<MeasuredPoint>& points = measuredPoints());

/// The same of the studies that bear on a scene.
SteppingChoice steppingWithin(const Scene& scene, double error);

/// Steps the scene in that way: as many substeps as its step needs.
void apply(const SteppingChoice& choice, Scene& scene);

}  // namespace command
