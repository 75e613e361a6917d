// SPDX-License-Identifier: Zlib
#include "tests/command/WaterScene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

// What wetness and water do to the cloth, and how a scene moves it.

namespace wetcloth_test::water_cycle_cloth_test {
namespace {

using namespace cli;

/// Hangs from its top edge by true springs, saturated, at rest after some seconds.
Json hangingWet(const std::string& world, const Json& stiffness) {
  Json scene = levelScene({{"hooke_springs", {{"stiffness_n_m", 300}}}, {"wet_stiffness", stiffness}}, 6);
  scene["world"] = world;
  clothOf(scene)["patch"]["edge_v_m"] = {0, 1, 0};
  clothOf(scene)["pins"]["edges"] = {"top"};
  clothOf(scene)["initial_saturation"] = 1;
  return scene;
}

double strainOf(const Json& scene) { return runScene(scene).at("max_stretch").get<double>() - 1; }

/// Under the level face of a box, which is at a height of 1 m, within the margin of collision.
Json underABox(const Json& effects, double saturation) {
  Json scene = levelScene(effects, 1);
  clothOf(scene)["patch"]["origin_m"] = {0, 0.985, 0};
  clothOf(scene)["initial_saturation"] = saturation;
  scene["colliders"] = {{{"box", {{"centre_m", {0.5, 1.1, 0.5}}, {"half_extents_m", {2, 0.1, 2}}}}}};
  return scene;
}

/// How far a cloth with a friction of 0.2 slides in a second on a floor that gravity meets at a slope of 0.3 [m].
double slidden(const Json& effects, double saturation) {
  Json scene = levelScene(effects, 1);
  scene["gravity_m_s2"] = {0.3 * gravity, -gravity, 0};
  clothOf(scene)["patch"]["origin_m"] = {0, 0.02, 0};
  clothOf(scene)["friction"] = 0.2;
  clothOf(scene)["initial_saturation"] = saturation;
  scene["colliders"] = {{{"box", {{"centre_m", {0, -1, 0}}, {"half_extents_m", {20, 1, 20}}}}}};
  return centre(runScene(scene), 0) - 0.5;
}

double heightAt(double time) {
  Json scene = uprightScene(Json::object(), time);
  clothOf(scene)["motion"] = {{"times_s", {1, 2, 4}}, {"offsets_m", {{0, 0.5, 0}, {0, 2, 0}, {0, 1, 0}}}};
  return centre(runScene(scene), 1) - 1.5;
}

TEST(WaterCycleCloth, HalfTheStiffnessIsTwiceTheStretch) {
  for (const char* world : {"soft_rigid", "deformable"}) {
    const Json none = {{"wet_stretch", 1}, {"wet_bending", 1}, {"wet_damping_1_s", 5}};
    const Json half = {{"wet_stretch", 0.5}, {"wet_bending", 0.5}, {"wet_damping_1_s", 5}};
    const double strain = strainOf(hangingWet(world, none));
    ASSERT_GT(strain, 0.001) << world;
    EXPECT_NEAR(strainOf(hangingWet(world, half)) / strain, 2, 0.1) << world;  // what is not linear in the strain
  }
}

TEST(WaterCycleCloth, WetDampingIsOfWetLinksAndDryDampingOfDryOnes) {
  const auto speed = [](const Json& stiffness, double saturation) {
    Json scene = hangingWet("soft_rigid", stiffness);
    clothOf(scene)["effects"]["hooke_springs"]["stiffness_n_m"] = 5;  // it goes on falling for a while
    clothOf(scene)["initial_saturation"] = saturation;
    scene["duration_s"] = 0.1;
    return runScene(scene).at("max_speed").get<double>();
  };
  const Json none = {{"wet_bending", 0.5}};
  const Json wet = {{"wet_damping_1_s", 100}};
  const Json dry = {{"dry_damping_1_s", 100}};
  EXPECT_LT(speed(wet, 1), 0.9 * speed(none, 1));
  EXPECT_LT(speed(dry, 0), 0.9 * speed(none, 0));
  EXPECT_DOUBLE_EQ(speed(wet, 0), speed(none, 0));
  EXPECT_DOUBLE_EQ(speed(dry, 1), speed(none, 1));
}

TEST(WaterCycleCloth, ASwellingOfMinusATenthShortensByATenth) {
  for (const double wetness : {0., 0.5, 1.}) {
    Json scene = floatingScene({{"swelling", {{"saturated_strain", -0.1}}}}, 3);
    scene["iterations"] = 20;
    clothOf(scene)["damping"] = 0.05;
    clothOf(scene)["pins"]["corners"] = {"bottom_left"};
    clothOf(scene)["initial_saturation"] = wetness;
    const Json result = runScene(scene);
    const double length = std::hypot(centre(result, 0), centre(result, 2)) / std::sqrt(0.5);
    EXPECT_NEAR(length, 1 - 0.1 * wetness, 1e-3) << wetness;  // what the iterations leave
  }
}

TEST(WaterCycleCloth, ASheetSinksAtTheSpeedOfTheClosedForm) {
  const double fibre = 2000;
  const double density = 1030;
  const double drag = 1.5;
  Json scene = levelScene(
      {{"water_drag", {{"drag_coefficient", drag}, {"skin_friction", 0}, {"fibre_density_kg_m3", fibre}}}}, 2);
  scene["water"] = {{"level_m", 3}, {"density_kg_m3", density}};
  const double expected = std::sqrt(2 * dryMass * (1 - density / fibre) * gravity / (density * drag));
  EXPECT_NEAR(runScene(scene).at("max_speed").get<double>(), expected, 1e-3 * expected);
}

TEST(WaterCycleCloth, AboveTheWaterItFallsFreely) {
  Json scene = levelScene({{"water_drag", Json::object()}}, 0.3);
  scene["water"]["level_m"] = 0.2;
  const Json result = runScene(scene);
  EXPECT_NEAR(result.at("max_speed").get<double>(), gravity * timeOf(result), 1e-3);
}

TEST(WaterCycleCloth, ClingHoldsAgainstItsStressAndNoMore) {
  const double wet = (dryMass + 0.5 * capacity) * gravity;  // weight by area [Pa], where cling is strongest
  EXPECT_NEAR(centre(runScene(underABox({{"cling", Json::object()}}, 0.5)), 1), 0.985, 0.02);
  EXPECT_NEAR(centre(runScene(underABox({{"cling", {{"adhesion_pa", 1.5 * wet}}}}, 0.5)), 1), 0.985, 0.02);
  for (const Json& lets :
       std::vector<Json>{underABox(Json::object(), 0.5), underABox({{"cling", Json::object()}}, 0.1),
                         underABox({{"cling", {{"adhesion_pa", 0.7 * wet}}}}, 0.5),
                         underABox({{"cling", {{"minimum_saturation", 0.5}, {"peak_saturation", 0.6}}}}, 0.5),
                         underABox({{"cling", {{"flooded_share", 0}}}}, 1)}) {
    EXPECT_LT(centre(runScene(lets), 1), -2) << lets.at("cloths").at(0).at("effects");
  }
}

TEST(WaterCycleCloth, WetFrictionHoldsWhatSlidesDry) {
  const Json usual = {{"wet_friction", Json::object()}};
  const double slides = 0.03;  // [m]; Bullet brakes by more than Coulomb's law does, which gives 0.5 m
  EXPECT_GT(slidden(Json::object(), 0.5), slides);
  EXPECT_DOUBLE_EQ(slidden(usual, 0), slidden(Json::object(), 0));
  EXPECT_LT(slidden(usual, 0.5), 0.1 * slides);
  EXPECT_LT(slidden(usual, 1), 0.1 * slides);
  EXPECT_GT(slidden({{"wet_friction", {{"wet_factor", 1}}}}, 0.5), slides);
  // Without friction: half the acceleration's part along the floor.
  const double free = 0.5 * 0.3 * gravity;
  EXPECT_NEAR(slidden({{"wet_friction", {{"flooded_factor", 0}}}}, 1), free, 0.01 * free);
  EXPECT_NEAR(slidden({{"wet_friction", {{"wet_factor", 0}, {"peak_saturation", 0.3}}}}, 0.3), free, 0.01 * free);
}

TEST(WaterCycleCloth, MotionTakesThePinsInStraightLinesFromTimeToTime) {
  EXPECT_NEAR(heightAt(0.5), 0.5, 1e-5);
  EXPECT_NEAR(heightAt(1.5), 1.25, 1e-5);
  EXPECT_NEAR(heightAt(2), 2, 1e-5);
  EXPECT_NEAR(heightAt(3), 1.5, 1e-5);
  EXPECT_NEAR(heightAt(5), 1, 1e-5);
}

TEST(WaterCycleCloth, MotionMovesPinsOnlyAndTheClothFollows) {
  Json scene = floatingScene(Json::object(), 4);
  clothOf(scene)["pins"]["edges"] = {"left"};
  clothOf(scene)["damping"] = 0.05;
  clothOf(scene)["motion"] = {{"times_s", {0, 2}}, {"offsets_m", {{0, 0, 0}, {-2, 0, 0}}}};
  EXPECT_NEAR(centre(runScene(scene), 0), -1.5, 0.05);
}

TEST(WaterCycleCloth, WhatIsLetDownIntoWaterGetsWetAsFarAsItIsIn) {
  Json scene = uprightScene({{"immersion", Json::object()}}, 2);
  scene["water"]["level_m"] = 0.5;
  EXPECT_EQ(saturation(runScene(scene), "max"), 0);
  clothOf(scene)["motion"] = {{"times_s", {0}}, {"offsets_m", {{0, -1, 0}}}};
  const Json result = runScene(scene);
  EXPECT_NEAR(ledger(result, "held"), capacity / 2 * (1 - std::exp(-timeOf(result) / timeConstant)), 1e-5 * capacity);
}

TEST(WaterCycleCloth, ALaundryLineDripsFastAndThenSlowly) {
  const Json drips = runScene(sceneFile("laundry_line"), {"--duration", "60"}).at("drips");
  const Json& tenths = drips.at("kg_by_tenth");
  ASSERT_EQ(tenths.size(), 10u);
  for (std::size_t i = 1; i < 10; ++i) EXPECT_LT(tenths.at(i).get<double>(), tenths.at(i - 1).get<double>()) << i;
  EXPECT_GT(tenths.at(0).get<double>(), 5 * tenths.at(9).get<double>());
}

TEST(WaterCycleCloth, AWrungTowelLosesWaterByTheSqueezeAndPassesThroughNothing) {
  Json scene = readJson(sceneFile("wring_out"));
  scene["duration_s"] = 2;
  clothOf(scene)["patch"]["columns"] = 17;
  clothOf(scene)["patch"]["rows"] = 13;
  clothOf(scene)["twist"]["turns_per_s"] = 1.5;
  const Json wrung = runScene(scene);
  EXPECT_EQ(wrung.at("guard").at("passages"), 0);
  EXPECT_EQ(wrung.at("audit").at("vertex_face"), 0);
  EXPECT_EQ(wrung.at("audit").at("edge_edge"), 0);
  EXPECT_GT(ledger(wrung, "dripped"), 0.1 * ledger(wrung, "initial"));
  clothOf(scene)["effects"]["dripping"].erase("squeeze");
  clothOf(scene)["effects"].erase("collision_audit");  // which only looks
  EXPECT_LT(ledger(runScene(scene), "dripped"), 0.4 * ledger(wrung, "dripped"));
}

TEST(WaterCycleCloth, TheSummaryHasALineForDripsAndOneForRunOff) {
  const TemporaryDirectory directory;
  const auto summaryOf = [&](const Json& scene) {
    return runWetcloth({"run", directory.write("scene.json", scene.dump()), "--precision", testedPrecision()}).out;
  };
  Json scene = uprightScene({{"dripping", Json::object()}, {"rain", {{"direction", {0, 0, 1}}}}}, 0.2);
  clothOf(scene)["initial_saturation"] = 1;
  const std::string both = summaryOf(scene);
  EXPECT_NE(both.find("\ndrips "), std::string::npos) << both;
  EXPECT_NE(both.find("\nrun-off "), std::string::npos) << both;
  const std::string neither = summaryOf(uprightScene({{"rain", {{"direction", {0, 0, 1}}}}}, 0.2));
  EXPECT_EQ(neither.find("\ndrips "), std::string::npos) << neither;
  EXPECT_EQ(neither.find("\nrun-off "), std::string::npos) << neither;
  EXPECT_EQ(neither.find("-0.0"), std::string::npos) << neither;
}

}  // namespace
}  // namespace wetcloth_test::water_cycle_cloth_test
