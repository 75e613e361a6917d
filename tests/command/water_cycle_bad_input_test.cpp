#include "Command.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

namespace {

using namespace command;

const std::string effectsPointer = "/cloths/0/effects/";
const std::string motionPointer = "/cloths/0/motion";

/// smallScene() without effects, with water, a film on its collider and a motion: all of it good.
Json goodScene() {
  Json scene = smallScene();
  Json& cloth = scene["cloths"][0];
  cloth["effects"] = Json::object();
  cloth["motion"] = {{"times_s", {0, 1, 2}}, {"offsets_m", {{0, 0, 0}, {0, 1, 0}, {0, 2, 0}}}};
  cloth["effects"]["contact_wetting"]["films"] = Json::array({{{"collider", 0}, {"water_kg", 0.1}}});
  scene["water"] = {{"level_m", 0.5}};
  return scene;
}

/// Validates a spoilt goodScene(): status 2, nothing on standard output, and on standard error one line with the
/// file and these words.
void expectRefusal(const std::function<void(Json&)>& spoil, std::vector<std::string> words) {
  Json scene = goodScene();
  spoil(scene);
  const TemporaryDirectory directory;
  const std::string file = directory.write("scene.json", scene.dump());
  const Outcome outcome = runWetcloth({"validate", file});
  EXPECT_EQ(outcome.status, 2) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  words.push_back(file);
  for (const std::string& word : words) {
    EXPECT_NE(outcome.err.find(word), std::string::npos) << word << " in: " << outcome.err;
  }
}

/// A value that must not be at a pointer, and what the complaint says is allowed.
struct BadValue {
  std::string pointer;
  Json value;
  std::string allowed;
};

void expectRefusals(const std::string& prefix, const std::vector<BadValue>& values) {
  for (const BadValue& bad : values) {
    const std::string pointer = prefix + bad.pointer;
    SCOPED_TRACE(pointer + " = " + bad.value.dump());
    expectRefusal([&](Json& scene) { scene[Json::json_pointer(pointer)] = bad.value; }, {pointer, bad.allowed});
  }
}

Json& cloth(Json& scene) { return scene["cloths"][0]; }

}  // namespace

TEST(WaterCycleBadInput, TheSceneThatTheOthersSpoilIsGood) {
  const TemporaryDirectory directory;
  const Outcome outcome = runWetcloth({"validate", directory.write("scene.json", goodScene().dump())});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

TEST(WaterCycleBadInput, ValuesOfSources) {
  const Json sphere = {{"centre_m", {0, 1, 0}}, {"radius_m", 1}};
  const Json cone = {{"apex_m", {0, 2, 0}}, {"half_angle_deg", 10}, {"reach_m", 2}};
  const auto withCone = [&](const char* key, const Json& value) {
    Json changed = cone;
    changed[key] = value;
    return Json{{"cone", changed}, {"velocity_m_s", {0, -1, 0}}};
  };
  expectRefusals(
      effectsPointer,
      {{"immersion", 1, "must be an object"},
       {"immersion/depth_m", 1, "unknown key"},
       {"rain", true, "must be an object"},
       {"rain/flux_kg_m2_s", -1, ">= 0"},
       {"rain/flux_kg_m2_s", "heavy", "a number"},
       {"rain/speed_m_s", -6.5, ">= 0"},
       {"rain/direction", 1, "array of three numbers"},
       {"rain/self_shelter", 1, "true or false"},
       {"rain/flux_mm_h", 10, "unknown key"},
       {"splash", Json::object(), "sphere, cone"},
       {"splash", {{"sphere", sphere}, {"cone", cone}, {"velocity_m_s", {0, -1, 0}}}, "exactly one"},
       {"splash", {{"sphere", sphere}}, "\"velocity_m_s\" is missing"},
       {"splash", {{"sphere", sphere}, {"velocity_m_s", {0, -1, 0}}, {"flux_kg_m2_s", -1}}, "flux_kg_m2_s = -1"},
       {"splash", {{"sphere", {{"radius_m", 1}}}, {"velocity_m_s", {0, -1, 0}}}, "\"centre_m\" is missing"},
       {"splash", withCone("half_angle_deg", 0), "(0, 90)"},
       {"splash", withCone("half_angle_deg", 90), "(0, 90)"},
       {"splash", withCone("reach_m", 0), "> 0"},
       {"contact_wetting/rate_kg_m2_s", -1, ">= 0"},
       {"contact_wetting/cloths", "yes", "true or false"},
       {"contact_wetting/films", Json::object(), "must be an array"},
       {"contact_wetting/films/0", 1, "must be an object"},
       {"contact_wetting/films/0/collider", -1, "whole number"},
       {"contact_wetting/films/0/collider", 0.5, "whole number"},
       {"contact_wetting/films/0/water_kg", -0.1, ">= 0"},
       {"contact_wetting/films/0", {{"collider", 0}}, "\"water_kg\" is missing"}});
}

TEST(WaterCycleBadInput, ValuesOfTransportAndLosses) {
  expectRefusals(effectsPointer, {{"diffusion/warp_diffusivity_m2_s", 0, "> 0"},
                                  {"diffusion/weft_diffusivity_m2_s", -1, "> 0"},
                                  {"diffusion/exponent", 101, "[0, 100]"},
                                  {"diffusion/warp", {1, 0}, "array of three numbers"},
                                  {"diffusion/method", "conjugate_gradient", "\"conjugate_gradients\""},
                                  {"diffusion/tolerance", 0, "(0, 1)"},
                                  {"diffusion/tolerance", 1, "(0, 1)"},
                                  {"seepage/speed_m_s", -1, ">= 0"},
                                  {"seepage/exponent", 0.5, "[1, 100]"},
                                  {"dripping/holding_saturation", 1.5, "[0, 1]"},
                                  {"dripping/time_constant_s", 0, "> 0"},
                                  {"dripping/drop_mass_kg", -1, ">= 0"},
                                  {"dripping/slope_tolerance", 2, "[0, 1]"},
                                  {"drying/temperature_c", 293, "[0, 60]"},
                                  {"drying/relative_humidity", 50, "[0, 1]"},
                                  {"drying/self_cooling", 0, "(0, 1]"},
                                  {"drying/critical_saturation", 0, "(0, 1]"},
                                  {"drying/sides", 3, "(0, 2]"},
                                  {"drying/velocity_m_s", 3, "array of three numbers"},
                                  {"drying/exposure", {0, 1}, "one value per node"}});
}

TEST(WaterCycleBadInput, ValuesOfMechanics) {
  expectRefusals(effectsPointer, {{"wet_stiffness/wet_stretch", 0, "[0.001, 1000]"},
                                  {"wet_stiffness/wet_bending", 1001, "[0.001, 1000]"},
                                  {"wet_stiffness/dry_damping_1_s", -1, ">= 0"},
                                  {"wet_stiffness/wet_damping_1_s", "much", "a number"},
                                  {"swelling/saturated_strain", -0.5, "(-0.5, 0.5)"},
                                  {"swelling/saturated_strain", 0.6, "(-0.5, 0.5)"},
                                  {"water_drag/drag_coefficient", -1, ">= 0"},
                                  {"water_drag/skin_friction", -1, ">= 0"},
                                  {"water_drag/fibre_density_kg_m3", 0, "> 0"},
                                  {"cling/adhesion_pa", -1, ">= 0"},
                                  {"cling/shear_strength_pa", -1, ">= 0"},
                                  {"cling/minimum_saturation", -0.1, "[0, 1]"},
                                  {"cling/peak_saturation", 0, "(0, 1]"},
                                  {"cling/flooded_share", 1.1, "[0, 1]"},
                                  {"wet_friction/wet_factor", -1, ">= 0"},
                                  {"wet_friction/peak_saturation", 0, "(0, 1]"},
                                  {"wet_friction/flooded_factor", -1, ">= 0"}});
}

TEST(WaterCycleBadInput, ValuesOfWaterAndMotion) {
  expectRefusals("/water", {{"", 0.5, "must be an object"},
                            {"", Json::object(), "\"level_m\" is missing"},
                            {"/level_m", "high", "a number"},
                            {"/density_kg_m3", 0, "> 0"},
                            {"/depth_m", 1, "unknown key"}});
  expectRefusals(motionPointer,
                 {{"", Json::array(), "must be an object"},
                  {"", Json::object(), "\"times_s\" is missing"},
                  {"/times_s", 1, "must be an array"},
                  {"/times_s", Json::array(), "at least one time"},
                  {"/times_s/0", -1, ">= 0"},
                  {"/times_s/1", 0, "later than the time before it"},
                  {"/times_s/2", 0.5, "later than the time before it"},
                  {"/offsets_m", Json::array({Json::array({0, 0, 0})}), "one offset for each of times_s, 3"},
                  {"/offsets_m/1", {0, 1}, "array of three numbers"}});
}

// What only the library knows to refuse: at the pointer of the effect.
TEST(WaterCycleBadInput, ADirectionOfLengthZeroIsNone) {
  for (const char* key : {"rain/direction", "diffusion/warp"}) {
    const std::string effect = std::string(key).substr(0, std::string(key).find('/'));
    expectRefusal(
        [&](Json& scene) {
          scene[Json::json_pointer(effectsPointer + key)] = {0, 0, 0};
        },
        {effectsPointer + effect, "length 0"});
  }
}

TEST(WaterCycleBadInput, AClingThatPeaksBeforeItBegins) {
  expectRefusal(
      [](Json& scene) {
        cloth(scene)["effects"]["cling"] = {{"minimum_saturation", 0.5}, {"peak_saturation", 0.4}};
      },
      {effectsPointer + "cling", "peakSaturation", "0.4"});
}

TEST(WaterCycleBadInput, AFilmOnNoColliderOrTwoOnOne) {
  const std::string pointer = effectsPointer + "contact_wetting";
  expectRefusal([](Json& scene) { cloth(scene)["effects"]["contact_wetting"]["films"][0]["collider"] = 1; },
                {pointer, "films", "no collider 1"});
  expectRefusal([](Json& scene) { scene.erase("colliders"); }, {pointer, "films", "no collider 0"});
  expectRefusal(
      [](Json& scene) {
        Json& films = cloth(scene)["effects"]["contact_wetting"]["films"];
        films.push_back(Json(films[0]));
      },
      {pointer, "twice"});
}

TEST(WaterCycleBadInput, ContactsThatBulletDoesNotList) {
  expectRefusal(
      [](Json& scene) {
        cloth(scene)["effects"]["contact_wetting"] = {{"cloths", true}};
      },
      {effectsPointer + "contact_wetting", "cloths", "VF_SS"});
  for (const char* effect : {"contact_wetting", "cling", "wet_friction"}) {
    expectRefusal(
        [&](Json& scene) {
          Json& effects = cloth(scene)["effects"];
          if (effect != std::string("contact_wetting")) effects = {{effect, Json::object()}};
          cloth(scene)["collisions"] = Json::array();
        },
        {effectsPointer + effect});
  }
}

TEST(WaterCycleBadInput, WetStiffnessOfSpringsThatAllHaveOne) {
  expectRefusal(
      [](Json& scene) {
        scene["world"] = "deformable";
        cloth(scene)["effects"] = {{"wet_stiffness", {{"wet_stretch", 0.5}}}};
      },
      {effectsPointer + "wet_stiffness", "HookeSprings"});
}

TEST(WaterCycleBadInput, EffectsOfWaterThatIsNotThere) {
  for (const char* effect : {"immersion", "water_drag"}) {
    expectRefusal(
        [&](Json& scene) {
          scene.erase("water");
          cloth(scene)["effects"] = {{effect, Json::object()}};
        },
        {effectsPointer + effect, "water"});
  }
}
