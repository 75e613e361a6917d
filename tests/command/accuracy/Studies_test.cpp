// SPDX-License-Identifier: Zlib
// The quick studies say what numerical analysis says: orders, and who is right about the paper.

#include "command/accuracy/Studies.h"
#include "command/accuracy/PrecisionStudy.h"
#include "command/accuracy/StudyReport.h"

#include <bullet_wetcloth/bullet_wetcloth.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

namespace wetcloth_test::studies_test {
namespace {

using accuracy::Order;
using accuracy::Point;
using accuracy::Study;

std::vector<Study> quick(accuracy::CarryOutStudies carryOut) {
  double last = 0;
  std::vector<Study> studies = carryOut({true, 1}, [&](double fraction) {
    EXPECT_GE(fraction, last);
    EXPECT_LE(fraction, 1 + 1e-12);
    last = fraction;
  });
  EXPECT_NEAR(last, 1, 1e-12);
  return studies;
}

const Study& named(const std::vector<Study>& studies, const std::string& name) {
  for (const Study& study : studies) {
    if (study.measure.name == name) return study;
  }
  ADD_FAILURE() << name;
  return studies.front();
}

void expectOrder(const Study& study, const std::string& method, double expected, double tolerance) {
  for (const Order& order : study.orders) {
    if (order.method != method) continue;
    EXPECT_NEAR(order.value, expected, tolerance) << study.measure.name << ", " << method;
    return;
  }
  ADD_FAILURE() << study.measure.name << ": no order of " << method;
}

double errorOf(const Study& study, const std::string& name) {
  for (const Point& point : study.points) {
    if (point.name() == name) return point.error;
  }
  ADD_FAILURE() << study.measure.name << ": no " << name;
  return 0;
}

void expectWhole(const Study& study) {
  SCOPED_TRACE(study.measure.name);
  EXPECT_FALSE(study.points.empty());
  EXPECT_FALSE(study.advice.empty());
  std::set<std::string> names;
  for (const Point& point : study.points) {
    EXPECT_TRUE(names.insert(point.name()).second) << point.name() << " twice";
    EXPECT_GT(point.nanosecondsPerNodeStep, 0) << point.name();
    EXPECT_GT(point.microsecondsPerNodeSecond, 0) << point.name();
    const bool isOurs = point.name().find("not in the library") == std::string::npos;
    EXPECT_TRUE(isOurs || !point.isOnFront) << point.name() << " is advised, and cannot be had";
  }
}

// 1/60 s to 1 s, of a process that takes seconds: at the coarse end the next order still shows by a few percent.
constexpr double kCoarse = 0.06;

// Water in every substep is what the others are compared with.
TEST(Studies, TheDefaultPaceOfWaterStaysBelowATenthOfAPercent) {
  const std::vector<Study> studies = quick(accuracy::studyPace);
  const Study& rate = named(studies, "water_rate");
  const Study& tolerance = named(studies, "mass_tolerance");
  expectWhole(rate);
  expectWhole(tolerance);
  ASSERT_EQ(wetcloth::WaterPace().everySubsteps, 5);
  ASSERT_EQ(wetcloth::WaterPace().massTolerance, 1e-3);
  for (const std::string soaking :
       {"cotton falls", "cotton is hung up in wind", "high absorption falls", "high absorption is hung up in wind"}) {
    EXPECT_EQ(errorOf(rate, soaking + ", every 1"), 0) << soaking;
    EXPECT_LT(errorOf(rate, soaking + ", every 5"), 1e-3) << soaking;
    EXPECT_LT(errorOf(tolerance, soaking + ", 0.1 %"), 1e-3) << soaking;
    EXPECT_GT(errorOf(rate, soaking + ", every 25"), errorOf(rate, soaking + ", every 5")) << soaking;
    EXPECT_LE(errorOf(rate, soaking + ", every 25"), errorOf(rate, "worst of the four, every 25")) << soaking;
  }
  // No cloth is advised instead of another.
  for (const Study* study : {&rate, &tolerance}) {
    for (const Point& point : study->points) EXPECT_EQ(point.isCompared, point.method == "worst of the four");
  }
  EXPECT_NE(rate.advice.find("within 0.1 % up to every 5"), std::string::npos) << rate.advice;
}

TEST(Studies, AbsorptionHasTheOrdersOfItsIntegrators) {
  const std::vector<Study> studies = quick(accuracy::studyAbsorption);
  const Study& study = named(studies, "absorption");
  expectWhole(study);
  expectOrder(study, "forward Euler", 1, kCoarse);
  expectOrder(study, "exact, exposure at the start", 1, kCoarse);
  expectOrder(study, "exact, exposure at the middle", 2, kCoarse);
  expectOrder(study, "RK4 (not in the library)", 4, 0.15);
}

TEST(Studies, DiffusionIsOfSecondOrderInTheMeshAndInTheStep) {
  const std::vector<Study> studies = quick(accuracy::studyDiffusion);
  const Study& study = named(studies, "diffusion");
  expectWhole(study);
  expectOrder(study, "mesh, factored at 1/960 s", 2, 0.2);  // 6 to 24 nodes: coarse
  // At these steps the mesh of 24 nodes along would hide the order: by what the step adds to its error.
  const double mesh = errorOf(study, "factored, 1/60 s");
  EXPECT_GT(mesh, 5e-4);
  EXPECT_LT(std::fabs(errorOf(study, "factored, 1/10 s") - mesh), 1e-4);
  EXPECT_LT(errorOf(study, "factored, 1/2 s"), 3e-3);
  // The same step by two solvers.
  EXPECT_NEAR(errorOf(study, "factored, 1/10 s") / errorOf(study, "conjugate gradients, 1/10 s"), 1, 1e-3);
}

TEST(Studies, StrangIsOfSecondOrderAndSoAreTheLibrarysParts) {
  const std::vector<Study> studies = quick(accuracy::studySplitting);
  const Study& study = named(studies, "splitting");
  expectWhole(study);
  expectOrder(study, "Lie of exact parts", 1, kCoarse);
  expectOrder(study, "Strang of exact parts", 2, kCoarse);
  expectOrder(study, "Lie, as the library steps", 1, kCoarse);
  // At the coarse end the corners of the strip are stiff, which lowers it: 1.88 in float32, 1.87 in float64.
  expectOrder(study, "Strang, two absorptions of half the exposure", 2, 0.2);
}

TEST(Studies, WindIsOfFirstOrderAndOnlyExplicitWindBlowsUp) {
  const std::vector<Study> studies = quick(accuracy::studyWind);
  for (const Study& study : studies) expectWhole(study);
  for (const char* name : {"wind_linear", "wind_quadratic"}) {
    // The largest step is as long as the time in which the air stops the sheet.
    expectOrder(named(studies, name), "semi-implicit", 1, 0.2);
    EXPECT_LT(errorOf(named(studies, name), "semi-implicit, 1/10 s"), 0.25) << name;
  }
  EXPECT_GT(errorOf(named(studies, "wind_quadratic"), "explicit, 1/10 s"), 1);
}

TEST(Studies, ThePaperIsWrongWhereItsPageSaysSo) {
  const std::vector<Study> studies = quick(accuracy::studyPaper);
  for (const Study& study : studies) expectWhole(study);
  const Study& absorption = named(studies, "paper_absorption");
  EXPECT_LT(errorOf(absorption, "physics, exact law"), 1e-6);  // float32 holds the step to 3e-8
  EXPECT_GT(errorOf(absorption, "paper, Eq. 1 as printed"), 0.3);
  const Study& wind = named(studies, "paper_wind");
  // The force without an area grows with the number of triangles, 2 (n - 1)^2: 31^2 / 15^2 = 4.27 from 16 to 32.
  const double coarse = 1 + errorOf(wind, "paper, no area, 16 x 16");
  const double fine = 1 + errorOf(wind, "paper, no area, 32 x 32");
  EXPECT_NEAR(fine / coarse / (31. * 31 / (15 * 15)), 1, 1e-4);  // sums in float32
  EXPECT_LT(errorOf(wind, "physics, pressure x area, 64 x 64"), 1e-5);
  const Study& momentum = named(studies, "paper_momentum");
  EXPECT_GT(errorOf(momentum, "paper, mass without momentum"), 0.05);
  EXPECT_LT(errorOf(momentum, "physics, mass with momentum"),
            2e-3);  // water that comes in a step counts from its start
}

TEST(Studies, CollisionChecksMissNothingAndBulletsDoes) {
  const std::vector<Study> studies = quick(accuracy::studyCollision);
  for (const Study& study : studies) {
    expectWhole(study);
    EXPECT_TRUE(study.orders.empty());
  }
  const Study& missed = named(studies, "collision_missed_vf");
  EXPECT_EQ(errorOf(missed, "fast, default tolerance"), 0);
  EXPECT_GT(errorOf(missed, "bullet, no tolerance"), 0.3);
}

TEST(Studies, TheGuardLetsNothingPass) {
  const std::vector<Study> studies = quick(accuracy::studyGuard);
  for (const Study& study : studies) {
    expectWhole(study);
    const bool isOfPassages = study.measure.name == "guard_heap" || study.measure.name == "guard_wring";
    for (const Point& point : study.points) {
      EXPECT_EQ(point.isCompared, point.method != "no guard");
      if (isOfPassages) {
        EXPECT_EQ(point.error, point.isCompared ? 0 : 1) << point.name();
      }
    }
  }
}

TEST(Studies, AnErrorThatIsNoNumberIsNullInJson) {
  Study study;
  study.points.resize(2);
  study.points[0].error = std::nan("");
  study.points[1].error = 0.5;
  const nlohmann::ordered_json json = accuracy::jsonOf(study);
  EXPECT_TRUE(json.at("points")[0].at("error").is_null());
  EXPECT_TRUE(json.at("points")[0].at("blows_up").get<bool>());
  EXPECT_EQ(json.at("points")[1].at("error"), 0.5);
}

TEST(Studies, PrecisionsAreComparedStudyByStudy) {
  const auto study = [](const char* name, double error, double time) {
    nlohmann::json point{{"setting", "one"},
                         {"compared", true},
                         {"error", error},
                         {"ns_per_node_step", 1},
                         {"us_per_node_second", time}};
    return nlohmann::json{{"name", name}, {"points", {point}}};
  };
  const Study both = accuracy::comparePrecisions({study("same", 0.1, 1), study("better", 1e-6, 1)},
                                                 {study("same", 0.1, 2), study("better", 1e-12, 2)});
  ASSERT_EQ(both.points.size(), 4u);
  EXPECT_TRUE(both.points[0].isOnFront);
  EXPECT_FALSE(both.points[1].isOnFront);  // slower and no better
  EXPECT_TRUE(both.points[2].isOnFront);
  EXPECT_TRUE(both.points[3].isOnFront);
  EXPECT_NE(both.advice.find("2.00 times"), std::string::npos) << both.advice;
  EXPECT_NE(both.advice.find("in better only"), std::string::npos) << both.advice;
}

}  // namespace
}  // namespace wetcloth_test::studies_test
