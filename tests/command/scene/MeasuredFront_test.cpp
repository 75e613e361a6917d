// SPDX-License-Identifier: Zlib
// The stepping that a quality or an error budget chooses is the cheapest that was measured to be good enough.

#include "command/scene/MeasuredFront.h"
#include "command/scene/Quality.h"
#include "command/scene/SceneReader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace wetcloth_test::measured_front_test {
namespace {

using command::cheapestStepping;
using command::MeasuredPoint;
using command::SteppingChoice;
using command::StudyOfScene;

command::Scene sceneNamed(const std::string& name) {
  return command::readScene(std::string(WETCLOTH_SOURCE_DIR) + "/examples/scenes/" + name + ".json");
}

std::vector<std::vector<StudyOfScene>> kinds() {
  std::vector<std::vector<StudyOfScene>> kinds;
  for (const char* cloth : {"Bullet's links", "HookeSprings", "deformable, implicit"}) {
    kinds.push_back({{"cloth_sag", cloth}, {"cloth_period", cloth}});
    kinds.push_back({{"cloth_sag", cloth}, {"cloth_period", cloth}, {"wind_quadratic", "semi-implicit"}});
  }
  return kinds;
}

TEST(MeasuredFront, WasMeasuredForAllThatAQualityNeeds) {
  for (const auto& studies : kinds()) {
    const SteppingChoice choice = cheapestStepping(studies, 0.1);
    EXPECT_GT(choice.substep, 0) << studies.front().method;
    EXPECT_EQ(choice.expected.size(), studies.size());
  }
  for (const MeasuredPoint& point : command::measuredPoints()) {
    EXPECT_GT(point.time, 0);
    EXPECT_GE(point.error, 0);
  }
}

TEST(MeasuredFront, NothingCheaperIsGoodEnough) {
  for (const auto& studies : kinds()) {
    for (const double error : {0.3, 0.1, 0.03, 0.01}) {
      const SteppingChoice choice = cheapestStepping(studies, error);
      if (choice.largestError() > error) continue;
      for (const MeasuredPoint& point : command::measuredPoints()) {
        if (point.method != studies.front().method || point.study != "cloth_period" || point.time >= choice.time)
          continue;
        // Of the choice itself the slower of its studies counts.
        if (point.substep == choice.substep && point.iterations == choice.iterations) continue;
        // A cheaper stepping fails in one of the studies.
        bool fails = point.error > error;
        for (const MeasuredPoint& other : command::measuredPoints()) {
          for (const StudyOfScene& study : studies) {
            const bool isSame =
                other.substep == point.substep && (other.iterations == 0 || other.iterations == point.iterations);
            if (isSame && other.study == study.study && other.method == study.method) {
              fails = fails || other.error > error || other.time > choice.time;
            }
          }
        }
        EXPECT_TRUE(fails) << studies.front().method << " " << point.substep << " " << point.iterations;
      }
    }
  }
}

TEST(MeasuredFront, ASmallerErrorIsNeverCheaper) {
  for (const auto& studies : kinds()) {
    double before = 0;
    for (const double error : {0.3, 0.1, 0.03, 0.01, 0.005}) {
      const SteppingChoice choice = cheapestStepping(studies, error);
      if (choice.largestError() > error) break;
      EXPECT_GE(choice.time, before) << studies.front().method << " " << error;
      before = choice.time;
    }
  }
}

TEST(MeasuredFront, WhatNobodyReachesGivesTheMostAccurate) {
  const std::vector<StudyOfScene> studies = kinds().front();
  const SteppingChoice best = cheapestStepping(studies, 0);
  for (const MeasuredPoint& point : command::measuredPoints()) {
    if (point.method != studies.front().method || point.study != "cloth_sag") continue;
    for (const MeasuredPoint& other : command::measuredPoints()) {
      const bool isSame = other.substep == point.substep && other.iterations == point.iterations;
      if (!isSame || other.study != "cloth_period" || other.method != point.method) continue;
      EXPECT_GE(std::max(point.error, other.error), best.largestError());
    }
  }
}

TEST(MeasuredFront, AScenesEffectsDecideWhichStudiesCount) {
  const auto namesOf = [](const command::Scene& scene) {
    std::vector<std::string> names;
    for (const StudyOfScene& study : command::studiesOf(scene)) names.push_back(study.study);
    return names;
  };
  EXPECT_EQ(namesOf(sceneNamed("flag_wind_100")).back(), "wind_quadratic");
  const std::vector<std::string> strip = namesOf(sceneNamed("wick_strip"));
  EXPECT_NE(std::find(strip.begin(), strip.end(), "diffusion"), strip.end());
}

TEST(MeasuredFront, QualitiesAreOrdered) {
  double before = 0;
  for (const auto& [name, quality] : command::qualityNames()) {
    const SteppingChoice choice = command::steppingWithin(sceneNamed("flag_wind_100"), command::allowedError(quality));
    EXPECT_GE(choice.time, before) << name;
    if (quality != command::Quality::reference) {
      EXPECT_LE(choice.largestError(), command::allowedError(quality)) << name;
    }
    before = choice.time;
  }
}

TEST(MeasuredFront, ASceneGetsAsManySubstepsAsItsStepNeeds) {
  command::Scene scene = sceneNamed("flag_wind_100");
  SteppingChoice choice;
  choice.substep = 1. / 240;
  choice.iterations = 7;
  for (const auto& [step, substeps] : std::vector<std::pair<double, int>>{{1. / 60, 4}, {1. / 50, 5}, {1. / 1000, 1}}) {
    scene.step = step;
    command::apply(choice, scene);
    EXPECT_EQ(scene.substeps, substeps) << step;
    EXPECT_EQ(scene.iterations, 7);
  }
  choice.iterations = 0;
  command::apply(choice, scene);
  EXPECT_EQ(scene.iterations, 7) << "springs do not use them";
}

}  // namespace
}  // namespace wetcloth_test::measured_front_test
