#include "Command.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace {

using namespace command;

constexpr double area = 1;                // of the cloth of smallScene() [m^2]
constexpr double capacity = 0.15 * 0.84;  // [kg]
constexpr double timeConstant = 8.844;    // [s]
constexpr double penman = 0.1279 / 3600;  // from each side in still air of 20 C and 50 % [kg/m^2/s]
constexpr double singlePrecision = 1e-5;  // relative, of lengths and times
const char* const worlds[] = {"soft_rigid", "soft_multibody", "deformable"};

Json& cloth(Json& scene) { return scene["cloths"][0]; }

/// The cloth of smallScene() with these effects, level at a height of 1 m, where all its nodes are held.
Json fixedScene(const Json& effects) {
  Json scene = smallScene();
  scene["gravity_m_s2"] = {0, 0, 0};
  cloth(scene)["effects"] = effects;
  for (int node = 0; node < 20; ++node) cloth(scene)["pins"]["nodes"].push_back(node);
  return scene;
}

/// The cloth just above a floor.
Json floorScene(const Json& effects) {
  Json scene = smallScene();
  cloth(scene)["effects"] = effects;
  cloth(scene)["patch"]["origin_m"] = {0, 0.06, 0};
  scene["colliders"] = Json::array({{{"plane", {{"offset_m", 0}}}}});
  return scene;
}

Outcome runOutcome(const Json& scene, std::vector<std::string> more) {
  const TemporaryDirectory directory;
  std::vector<std::string> arguments{"run", directory.write("scene.json", scene.dump()), "--precision", ownPrecision()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  Outcome outcome = runWetcloth(arguments);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return outcome;
}

Json runScene(const Json& scene) {
  const Outcome outcome = runOutcome(scene, {"--json", "-"});
  return outcome.status == 0 ? Json::parse(outcome.out) : Json();
}

std::string summaryOf(const Json& scene) { return runOutcome(scene, {}).out; }

double ledger(const Json& result, const char* key) { return result.at("ledger").at(key).get<double>(); }
double duration(const Json& result) { return result.at("steps").get<double>() * result.at("dt").get<double>(); }

void expectLedgerCloses(const Json& result) {
  const double in = ledger(result, "initial") + ledger(result, "absorbed");
  EXPECT_NEAR(in - ledger(result, "dripped") - ledger(result, "evaporated"), ledger(result, "held"), 1e-12 * in);
}

/// What an effect needs beside itself to run; most run as {}.
const std::map<std::string, Json> newEffects{
    {"immersion", Json::object()},
    {"rain", Json::object()},
    {"splash", {{"sphere", {{"centre_m", {0.5, 1, 0.5}}, {"radius_m", 1}}}, {"velocity_m_s", {0, -5, 0}}}},
    {"contact_wetting", Json::object()},
    {"diffusion", Json::object()},
    {"seepage", Json::object()},
    {"dripping", Json::object()},
    {"drying", Json::object()},
    {"wet_stiffness", Json::object()},
    {"swelling", Json::object()},
    {"water_drag", Json::object()},
    {"cling", Json::object()},
    {"wet_friction", Json::object()}};

/// Two cloths, the upper one falling on the lower one, on a wet sphere in water, with all that a scene can have.
Json everything(const std::string& world) {
  Json scene = smallScene();
  scene["world"] = world;
  scene["duration_s"] = 1;
  scene["substeps"] = 8;
  scene["water"] = {{"level_m", 0.4}};
  scene["colliders"] = Json::array({{{"sphere", {{"centre_m", {0.5, 0.2, 0.5}}, {"radius_m", 0.4}}}}});
  Json effects = newEffects;
  effects["absorption"] = {{"exposure", {{"below_m", 0.3}}}};
  effects["hooke_springs"] = Json::object();
  effects["wind"] = {{"velocity_m_s", {1, 0, 0}}};
  effects["rain"] = {{"flux_kg_m2_s", 0.05}, {"self_shelter", true}};
  effects["contact_wetting"] = {{"cloths", true}, {"films", Json::array({{{"collider", 0}, {"water_kg", 0.002}}})}};
  Json& lower = cloth(scene);
  lower["effects"] = effects;
  lower["initial_saturation"] = 0.3;
  lower["collisions"] = world == "deformable" ? Json{"SDF_RD", "SDF_RDN", "VF_DD"} : Json{"SDF_RS", "VF_SS"};
  lower["pins"] = {{"corners", {"bottom_left", "bottom_right"}}};
  lower["motion"] = {{"times_s", {0.2, 0.6}}, {"offsets_m", {{0, 0, 0}, {0, -0.2, 0.1}}}};
  Json upper = lower;
  upper.erase("pins");
  upper.erase("motion");
  upper["patch"]["origin_m"] = {0, 1.1, 0};
  upper["initial_saturation"] = 0.9;
  scene["cloths"].push_back(upper);
  return scene;
}

}  // namespace

TEST(WaterCycleCommand, RainFillsALevelClothByFluxAreaAndTime) {
  const double flux = 0.3;
  const Json result = runScene(fixedScene({{"rain", {{"flux_kg_m2_s", flux}}}}));
  EXPECT_NEAR(ledger(result, "absorbed"), flux * area * duration(result), singlePrecision * flux * area);
  EXPECT_NEAR(ledger(result, "held"), ledger(result, "absorbed"), 1e-12);
  EXPECT_EQ(ledger(result, "run_off"), 0);
  EXPECT_EQ(result.at("effects"), Json::array({"Rain"}));
}

TEST(WaterCycleCommand, RainThatAFullClothCannotHoldRunsOff) {
  const double flux = 3;
  const Json result = runScene(fixedScene({{"rain", {{"flux_kg_m2_s", flux}}}}));
  EXPECT_NEAR(ledger(result, "absorbed"), capacity, singlePrecision * capacity);
  EXPECT_NEAR(ledger(result, "absorbed") + ledger(result, "run_off"), flux * area * duration(result),
              singlePrecision * flux);
  EXPECT_DOUBLE_EQ(result.at("saturation").at("min").get<double>(), 1);
}

TEST(WaterCycleCommand, DryingFollowsPenmanOnBothSidesOfACooledCloth) {
  Json scene = fixedScene({{"drying", {{"self_cooling", 0.5}}}});
  scene["duration_s"] = 2;
  cloth(scene)["initial_saturation"] = 1;
  const Json still = runScene(scene);
  const double expected = 2 * 0.5 * penman * area * duration(still);
  EXPECT_NEAR(ledger(still, "evaporated"), expected, 1e-3 * expected);  // penman has four digits
  EXPECT_NEAR(ledger(still, "initial") - ledger(still, "evaporated"), ledger(still, "held"), 1e-12 * capacity);

  cloth(scene)["effects"]["drying"] = {{"self_cooling", 1}, {"sides", 1}, {"velocity_m_s", {3, 0, 0}}};
  const double windy = ledger(runScene(scene), "evaporated");
  EXPECT_NEAR(windy, (1 + 0.536 * 3) * expected, 1e-3 * windy);

  cloth(scene)["effects"]["drying"] = {{"relative_humidity", 1}};
  EXPECT_EQ(ledger(runScene(scene), "evaporated"), 0);
}

TEST(WaterCycleCommand, AFilmGivesWhatItHasAndNoMore) {
  const double film = 0.005;
  for (const char* world : worlds) {
    SCOPED_TRACE(world);
    for (const double rate : {0.001, 10.0}) {
      Json scene =
          floorScene({{"contact_wetting",
                       {{"rate_kg_m2_s", rate}, {"films", Json::array({{{"collider", 0}, {"water_kg", film}}})}}}});
      scene["world"] = world;
      scene["duration_s"] = 0.5;
      const Json result = runScene(scene);
      EXPECT_GT(ledger(result, "absorbed"), 0) << rate;
      EXPECT_LE(ledger(result, "absorbed"), film * (1 + 1e-12)) << rate;
      EXPECT_EQ(ledger(result, "absorbed") < film * (1 - 1e-6), rate < 1) << ledger(result, "absorbed");
      expectLedgerCloses(result);
    }
  }
}

TEST(WaterCycleCommand, WaterGoesFromAWetClothToADryOneOnIt) {
  for (const char* world : worlds) {
    SCOPED_TRACE(world);
    Json scene = fixedScene({{"contact_wetting", {{"cloths", true}}}});
    scene["world"] = world;
    scene["gravity_m_s2"] = {0, -9.81, 0};
    scene["duration_s"] = 0.5;
    cloth(scene)["initial_saturation"] = 1;
    cloth(scene)["collisions"] = world == std::string("deformable") ? Json{"SDF_RD", "VF_DD"} : Json{"SDF_RS", "VF_SS"};
    Json upper = cloth(scene);
    upper.erase("pins");
    upper["initial_saturation"] = 0;
    upper["effects"] = Json::object();
    upper["patch"]["origin_m"] = {0.05, 1.1, 0.03};
    scene["cloths"].push_back(upper);
    const Json result = runScene(scene);
    EXPECT_GT(ledger(result, "absorbed"), 0);
    EXPECT_NEAR(ledger(result, "absorbed"), ledger(result, "dripped"), 1e-12 * capacity);
    EXPECT_GT(result.at("saturation").at("min").get<double>(), -1e-12);
    expectLedgerCloses(result);
  }
}

TEST(WaterCycleCommand, MotionMovesThePinsAndWithThemAClothThatHangsOnAllOfItsNodes) {
  for (const char* world : worlds) {
    SCOPED_TRACE(world);
    Json scene = fixedScene(Json::object());
    scene["world"] = world;
    scene["gravity_m_s2"] = {0, -9.81, 0};
    cloth(scene)["motion"] = {{"times_s", {0.2, 0.4}}, {"offsets_m", {{0, 0, 0}, {0.3, 0.2, -0.1}}}};
    for (const auto& [time, share] : std::map<double, double>{{0.1, 0}, {0.3, 0.5}, {0.4, 1}, {0.5, 1}}) {
      scene["duration_s"] = time;
      const Json centre = runScene(scene).at("centre_of_mass");
      const double expected[] = {0.5 + 0.3 * share, 1 + 0.2 * share, 0.5 - 0.1 * share};
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(centre.at(axis).get<double>(), expected[axis], 1e-5) << "axis " << axis << " at " << time << " s";
      }
    }
  }
}

TEST(WaterCycleCommand, ImmersionWetsOnlyWhatIsBelowTheWater) {
  Json scene = fixedScene({{"immersion", Json::object()}});
  cloth(scene)["patch"]["edge_v_m"] = {0, 1, 0};  // upright, from 1 m to 2 m: two rows of four are below 1.5 m
  scene["water"] = {{"level_m", 1.5}};
  const Json result = runScene(scene);
  const double soaked = -std::expm1(-duration(result) / timeConstant);
  EXPECT_EQ(result.at("saturation").at("min"), 0);
  EXPECT_NEAR(result.at("saturation").at("max").get<double>(), soaked, singlePrecision * soaked);
  EXPECT_NEAR(ledger(result, "held"), capacity * soaked / 2, singlePrecision * capacity * soaked);

  scene["water"]["level_m"] = 0.9;
  EXPECT_EQ(ledger(runScene(scene), "held"), 0);
}

TEST(WaterCycleCommand, ImmersionFollowsAClothThatMovesIntoTheWater) {
  Json scene = fixedScene({{"immersion", Json::object()}});
  scene["water"] = {{"level_m", 0}};
  scene["duration_s"] = 1;
  cloth(scene)["motion"] = {{"times_s", {0.5, 0.50001}}, {"offsets_m", {{0, 0, 0}, {0, -1.5, 0}}}};
  const double soaked = -std::expm1(-0.5 / timeConstant);
  EXPECT_NEAR(runScene(scene).at("saturation").at("mean").get<double>(), soaked, 0.02 * soaked);
}

TEST(WaterCycleCommand, TheLedgerClosesWithEverythingAtOnce) {
  for (const char* world : worlds) {
    SCOPED_TRACE(world);
    const Json result = runScene(everything(world));
    EXPECT_EQ(result.at("effects").size(), newEffects.size() + 3);
    for (const char* key : {"initial", "absorbed", "evaporated", "dripped", "held", "run_off"}) {
      EXPECT_GT(ledger(result, key), 0) << key;
    }
    EXPECT_NEAR(ledger(result, "initial"), (0.3 + 0.9) * capacity, 1e-6 * capacity);
    EXPECT_LE(result.at("saturation").at("max").get<double>(), 1 + 1e-12);
    EXPECT_GE(result.at("saturation").at("min").get<double>(), 0);
    expectLedgerCloses(result);
  }
}

TEST(WaterCycleCommand, EachEffectRunsAloneWithItsDefaults) {
  for (const auto& [key, parameters] : newEffects) {
    SCOPED_TRACE(key);
    Json scene = floorScene({{key, parameters}});
    scene["water"] = {{"level_m", 0.02}};
    cloth(scene)["initial_saturation"] = 0.5;
    const Json result = runScene(scene);
    EXPECT_EQ(result.at("effects").size(), 1u);
    expectLedgerCloses(result);
  }
}

TEST(WaterCycleCommand, TheSummaryHasALineForRunOffOnlyWhenWaterRanOff) {
  const std::string dripping = summaryOf(fixedScene({{"rain", {{"flux_kg_m2_s", 3}}}}));
  EXPECT_NE(dripping.find("\nrun-off        174 g "), std::string::npos) << dripping;
  const std::string drizzle = summaryOf(fixedScene({{"rain", {{"flux_kg_m2_s", 0.3}}}}));
  EXPECT_EQ(drizzle.find("run-off"), std::string::npos) << drizzle;
}

TEST(WaterCycleCommand, TheSummaryHasNoMinusBeforeAZero) {
  for (const int rate : {1, 2, 3, 5, 7}) {  // in some of them rounding leaves an initial amount just below 0
    const std::string summary = summaryOf(fixedScene(
        {{"rain", {{"flux_kg_m2_s", 0.01 * rate}}}, {"drying", Json::object()}, {"absorption", {{"exposure", 1}}}}));
    EXPECT_NE(summary.find(" 0.0 initial"), std::string::npos) << summary;
    EXPECT_EQ(summary.find("-0.0"), std::string::npos) << summary;
  }
}
