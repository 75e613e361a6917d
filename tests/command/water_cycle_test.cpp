// SPDX-License-Identifier: Zlib
#include "tests/command/WaterScene.h"
#include "tests/support/Pi.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

// What brings water, moves it and takes it away, as a scene asks for it. Node by node it is computed in double, and
// areas come from float32 positions: 1e-5 of it is rounding.

namespace wetcloth_test::water_cycle_test {
namespace {

using namespace cli;

constexpr double rounding = 1e-5;

void expectLedgerClosed(const Json& result) {
  const double in = ledger(result, "initial") + ledger(result, "absorbed");
  const double out = ledger(result, "dripped") + ledger(result, "evaporated") + ledger(result, "held");
  EXPECT_NEAR(in, out, 1e-12 * (in + out));
}

/// Two squares of 1 m^2, the one 0.1 m above the other, in one mesh.
std::string stackedSquares(const TemporaryDirectory& directory) {
  return directory.write("stacked.obj",
                         "v 0 1 0\nv 1 1 0\nv 1 1 1\nv 0 1 1\nv 0 1.1 0\nv 1 1.1 0\nv 1 1.1 1\nv 0 1.1 1\n"
                         "f 1 2 3\nf 1 3 4\nf 5 6 7\nf 5 7 8\n");
}

double seenFrom(double height) {  // solid angle of the square metre from above its middle [sr]
  return 4 * std::atan(1 / (2 * height * std::sqrt(4 * height * height + 2)));
}

/// Evaporation from one side [kg/m^2/s], Penman (1948) as Shuttleworth (1993) has it, from the formula.
double penman(double celsius, double humidity, double speed) {
  const double kilopascals = 0.6108 * std::exp(17.27 * celsius / (celsius + 237.3));
  return 6.43 * (1 + 0.536 * speed) * kilopascals * (1 - humidity) / 2.45 / 86400;
}

TEST(WaterCycle, RainFillsALevelClothAtFluxTimesAreaAndRunsOffAFullOne) {
  const Json effects = {{"rain", {{"flux_kg_m2_s", 0.01}, {"speed_m_s", 0}}}};
  const Json filling = runScene(floatingScene(effects, 2));
  EXPECT_NEAR(ledger(filling, "held"), 0.01 * timeOf(filling), rounding * 0.02);
  EXPECT_EQ(ledger(filling, "run_off"), 0);
  const Json full = runScene(floatingScene(effects, 20));
  EXPECT_NEAR(ledger(full, "held"), capacity, rounding * capacity);
  EXPECT_LE(saturation(full, "max"), 1);
  EXPECT_NEAR(ledger(full, "run_off"), 0.01 * timeOf(full) - capacity, rounding * 0.2);
  expectLedgerClosed(full);
}

TEST(WaterCycle, RainThatFallsAslantMeetsLess) {
  const Json result =
      runScene(floatingScene({{"rain", {{"direction", {1, -1, 0}}, {"flux_kg_m2_s", 0.01}, {"speed_m_s", 0}}}}, 1));
  EXPECT_NEAR(ledger(result, "held"), 0.01 * timeOf(result) * std::sqrt(0.5), rounding * 0.01);
}

TEST(WaterCycle, RainBringsItsMomentum) {
  const Json result = runScene(floatingScene({{"rain", {{"flux_kg_m2_s", 0.01}, {"speed_m_s", 4}}}}, 1));
  const double water = 0.01 * timeOf(result);
  EXPECT_NEAR(result.at("max_speed").get<double>(), 4 * water / (dryMass + water), 1e-4);
}

TEST(WaterCycle, WhatIsBehindOtherClothIsShelteredWhenAskedFor) {
  const TemporaryDirectory directory;
  stackedSquares(directory);
  for (const bool shelter : {false, true}) {
    Json scene = floatingScene({{"rain", {{"flux_kg_m2_s", 0.01}, {"speed_m_s", 0}, {"self_shelter", shelter}}}}, 0.5);
    clothOf(scene).erase("patch");
    clothOf(scene)["obj"] = "stacked.obj";
    const Json result = runScene(directory.write("scene.json", scene.dump()));
    EXPECT_NEAR(ledger(result, "absorbed"), (shelter ? 1 : 2) * 0.01 * timeOf(result), rounding * 0.01) << shelter;
  }
}

TEST(WaterCycle, SplashWetsWhatIsInItsSphere) {
  Json effects = {{"splash",
                   {{"sphere", {{"centre_m", {0.5, 1, 0.5}}, {"radius_m", 1}}},
                    {"velocity_m_s", {0, -1e-4, 0}},
                    {"flux_kg_m2_s", 0.01}}}};
  const Json inside = runScene(floatingScene(effects, 1));
  EXPECT_NEAR(ledger(inside, "held"), 0.01 * timeOf(inside), rounding * 0.01);
  effects["splash"]["sphere"]["centre_m"] = {0.5, 3, 0.5};
  EXPECT_EQ(ledger(runScene(floatingScene(effects, 1)), "held"), 0);
}

TEST(WaterCycle, AHoseGivesWhatItsConeHoldsOfTheCloth) {
  const double height = 10;
  const double reach = 12;
  const Json result = runScene(
      floatingScene({{"splash",
                      {{"cone", {{"apex_m", {0.5, 1 + height, 0.5}}, {"half_angle_deg", 10}, {"reach_m", reach}}},
                       {"velocity_m_s", {0, -1e-4, 0}},
                       {"flux_kg_m2_s", 0.01}}}},
                    1));
  // The flux is taken at the centroids of triangles of 0.3 m: (0.3 / 10)^2 / 2.
  const double expected = 0.01 * reach * reach * seenFrom(height) * timeOf(result);
  EXPECT_NEAR(ledger(result, "held"), expected, 1e-3 * expected);
}

TEST(WaterCycle, NodesBelowTheWaterSoakByTheFabricsLaw) {
  Json scene = uprightScene({{"immersion", Json::object()}}, 3);
  scene["water"]["level_m"] = 1.5;
  const Json result = runScene(scene);
  const double share = 1 - std::exp(-timeOf(result) / timeConstant);
  EXPECT_EQ(saturation(result, "min"), 0);
  EXPECT_NEAR(saturation(result, "max"), share, rounding);
  EXPECT_NEAR(ledger(result, "held"), share * capacity / 2, rounding * capacity);  // the lower two rows of four
}

TEST(WaterCycle, TheWatersLevelIsMeasuredAgainstGravity) {
  for (const double level : {0.5, -0.1, 1.1}) {
    Json scene = uprightScene({{"immersion", Json::object()}}, 1);
    clothOf(scene)["patch"]["edge_v_m"] = {0, 0, 1};
    scene["gravity_m_s2"] = {0, 0, -9.81};
    scene["water"]["level_m"] = level;
    const double share = level < 0 ? 0 : level < 1 ? 0.5 : 1;
    const Json result = runScene(scene);
    EXPECT_NEAR(saturation(result, "mean"), share * (1 - std::exp(-timeOf(result) / timeConstant)), rounding) << level;
  }
}

TEST(WaterCycle, AFilmLosesWhatTheClothTakesUpAndNoMore) {
  const auto restingOn = [](double film, double seconds) {
    Json scene = levelScene({{"contact_wetting", {{"films", {{{"collider", 0}, {"water_kg", film}}}}}}}, seconds);
    scene["colliders"] = {{{"box", {{"centre_m", {0.5, 0.88, 0.5}}, {"half_extents_m", {1, 0.1, 1}}}}}};
    return runScene(scene);
  };
  const Json little = restingOn(0.01, 5);
  EXPECT_NEAR(ledger(little, "absorbed"), 0.01, 1e-12);
  expectLedgerClosed(little);
  const Json much = restingOn(1, 2);
  // Contacts are those of the substep before, and the first of them come when the cloth has settled: 5 %.
  const double expected = capacity * (1 - std::exp(-0.0142 * timeOf(much) / capacity));
  EXPECT_NEAR(ledger(much, "absorbed"), expected, 0.05 * expected);
  EXPECT_LE(ledger(much, "absorbed"), expected * (1 + rounding));
}

TEST(WaterCycle, WhatAClothGivesAnotherTakes) {
  Json scene = levelScene({{"contact_wetting", {{"cloths", true}}}}, 1);
  clothOf(scene)["pins"]["edges"] = {"left", "right", "top", "bottom"};
  clothOf(scene)["collisions"] = {"SDF_RS", "VF_SS"};
  clothOf(scene)["margin_m"] = 0.1;  // so that in one step the falling nodes do not pass
  Json second = clothOf(scene);
  second["patch"]["origin_m"] = {0.1, 1.05, 0.1};
  second["initial_saturation"] = 1;
  second.erase("pins");
  second.erase("effects");
  scene["cloths"].push_back(second);
  const Json result = runScene(scene);
  EXPECT_GT(ledger(result, "absorbed"), 1e-4);
  EXPECT_NEAR(ledger(result, "absorbed"), ledger(result, "dripped"), 1e-15);
  EXPECT_NEAR(ledger(result, "held"), ledger(result, "initial"), 1e-15);
}

TEST(WaterCycle, DiffusionFromAWetEdgeIsTheErrorFunctions) {
  const double diffusivity = 1e-3;
  const int columns = 41;
  const std::vector<Json> diffusions = {
      {{"warp_diffusivity_m2_s", diffusivity}, {"weft_diffusivity_m2_s", 1e-6}},
      {{"warp_diffusivity_m2_s", 1e-6}, {"weft_diffusivity_m2_s", diffusivity}, {"warp", {0, 0, 1}}},
      {{"warp_diffusivity_m2_s", diffusivity}, {"method", "conjugate_gradients"}},
      {{"warp_diffusivity_m2_s", diffusivity}, {"method", "explicit_substeps"}}};
  for (Json diffusion : diffusions) {
    diffusion["exponent"] = 0;
    Json exposure = Json::array();
    for (int node = 0; node < 2 * columns; ++node) exposure.push_back(node % columns == 0 ? 1 : 0);
    Json scene = floatingScene({{"diffusion", diffusion}, {"absorption", {{"exposure", exposure}}}}, 20);
    scene["substeps"] = 1;
    clothOf(scene)["water_pace"]["every_substeps"] = 1;
    clothOf(scene)["patch"]["columns"] = columns;
    clothOf(scene)["patch"]["rows"] = 2;
    clothOf(scene)["fabric"]["time_constant_s"] = 1e-3;
    const Json result = runScene(scene);
    // Of a wall kept at 1 in a half space: 2 sqrt(D t / pi) of what a unit of length holds (Crank 1975). The edge is
    // full from the start and has half a cell; the rest is the mesh's 0.025 m and the step's 0.02 s.
    const double expected = capacity * 2 * std::sqrt(diffusivity * timeOf(result) / kPi);
    EXPECT_NEAR(ledger(result, "absorbed"), expected, 0.02 * expected) << diffusion;
    EXPECT_LE(saturation(result, "max"), 1);
    EXPECT_GE(saturation(result, "min"), 0);
  }
}

TEST(WaterCycle, SeepageLowersTheCentreOfMassAtItsSpeed) {
  const double speed = 0.01;
  Json scene = uprightScene({{"seepage", {{"speed_m_s", speed}, {"exponent", 3}}}}, 1);
  clothOf(scene)["initial_saturation"] = 0.5;
  const Json result = runScene(scene);
  // All water sinks by v s^(3 - 1) t at first. In that time the ends change by v t = 1 cm of 1 m, at most.
  const double water = capacity / 2;
  const double sunk = water * speed * 0.25 * timeOf(result) / (dryMass + water);
  EXPECT_NEAR(centre(result, 1), 1.5 - sunk, 0.02 * sunk);
  EXPECT_NEAR(ledger(result, "held"), water, 1e-12);
}

TEST(WaterCycle, ALowHemDripsToItsHoldingSaturationAndTheRecordDecays) {
  Json scene = uprightScene({{"dripping", {{"holding_saturation", 0.4}, {"time_constant_s", 2}}}}, 4);
  clothOf(scene)["initial_saturation"] = 1;
  const Json result = runScene(scene);
  const double excess = 0.6 * capacity / 6;  // the lowest of four rows has half a row's third
  EXPECT_NEAR(ledger(result, "dripped"), excess * (1 - std::exp(-timeOf(result) / 2)), rounding * excess);
  const Json& drips = result.at("drips");
  double sum = 0;
  for (int tenth = 0; tenth < 10; ++tenth) {
    const double start = tenth * timeOf(result) / 10;
    const double expected = excess * (std::exp(-start / 2) - std::exp(-(start + timeOf(result) / 10) / 2));
    EXPECT_NEAR(drips.at("kg_by_tenth").at(tenth).get<double>(), expected, rounding * excess) << tenth;
    sum += drips.at("kg_by_tenth").at(tenth).get<double>();
  }
  EXPECT_NEAR(sum, drips.at("mass_kg").get<double>(), 1e-15);
  EXPECT_NEAR(sum, ledger(result, "dripped"), 1e-15);
  const double inDrops = sum - drips.at("pending_kg").get<double>();
  EXPECT_GT(drips.at("count"), 0);
  EXPECT_GE(inDrops, (1 - rounding) * 5e-5 * drips.at("count").get<double>());
}

TEST(WaterCycle, DropsOfNoMassAreReportedAtOnce) {
  Json scene = uprightScene({{"dripping", {{"drop_mass_kg", 0}}}}, 0.2);
  scene["substeps"] = 1;
  clothOf(scene)["water_pace"]["every_substeps"] = 1;
  clothOf(scene)["initial_saturation"] = 1;
  const Json drips = runScene(scene).at("drips");
  EXPECT_EQ(drips.at("count"), 10 * 5);  // steps x nodes of the hem
  EXPECT_EQ(drips.at("pending_kg"), 0);
}

TEST(WaterCycle, DryingLosesTwoSidesTimesSelfCoolingTimesPenman) {
  Json scene = uprightScene({{"drying", Json::object()}}, 100);
  scene["step_s"] = 1;
  clothOf(scene)["initial_saturation"] = 1;
  const Json result = runScene(scene);
  const double expected = 2 * 0.5 * penman(20, 0.5, 0) * timeOf(result);
  EXPECT_NEAR(ledger(result, "evaporated"), expected, rounding * expected);
  expectLedgerClosed(result);
}

TEST(WaterCycle, DryingFollowsTheAirAndBothStages) {
  for (const Json& air :
       std::vector<Json>{{{"velocity_m_s", {0, 0, 3}}},
                         {{"gust", {{"mean_m_s", {0, 0, 3}}, {"amplitude_m_s", {0, 0, 0}}, {"period_s", 1}}}}}) {
    Json drying = {{"temperature_c", 35}, {"relative_humidity", 0.2},
                   {"self_cooling", 0.8}, {"critical_saturation", 0.4},
                   {"sides", 1},          {"exposure", 0.5}};
    drying.update(air);
    Json scene = uprightScene({{"drying", drying}}, 1500);
    scene["step_s"] = 1;
    clothOf(scene)["initial_saturation"] = 1;
    const Json result = runScene(scene);
    const double rate = 0.5 * 0.8 * penman(35, 0.2, 3);  // of the cloth [kg/s]
    const double critical = 0.4 * capacity;
    const double constant = (capacity - critical) / rate;
    ASSERT_GT(timeOf(result), constant);
    const double left = critical * std::exp(-(timeOf(result) - constant) * rate / critical);
    EXPECT_NEAR(ledger(result, "held"), left, rounding * capacity) << air;
  }
}

}  // namespace
}  // namespace wetcloth_test::water_cycle_test
