// SPDX-License-Identifier: Zlib
#include "tests/command/WaterScene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

// What a scene may get wrong in the effects of the water cycle, in its water, and in a cloth's motion.

namespace wetcloth_test::water_cycle_bad_input_test {
namespace {

using namespace cli;

/// Has each key at a good value, and passes.
Json goodScene() { return readJson(WETCLOTH_SOURCE_DIR "/tests/scenes/water_cycle.json"); }

/// The same with a hose, and with gusts that dry.
Json otherScene() {
  Json scene = goodScene();
  Json& effects = clothOf(scene)["effects"];
  effects["splash"] =
      Json::parse(R"({"cone": {"apex_m": [0, 0, 0], "half_angle_deg": 20, "reach_m": 1}, "velocity_m_s": [0, 0, 5]})");
  effects["drying"] = Json::parse(
      R"({"gust": {"mean_m_s": [1, 0, 0], "amplitude_m_s": [0, 0, 1], "period_s": 2}, "exposure": {"below_m": 1}})");
  return scene;
}

/// The scene is refused in one line with file, pointer and value, and these words.
void expectRefused(const Json& scene, const std::string& pointer, const Json& value, const std::string& allowed) {
  SCOPED_TRACE(pointer + " = " + value.dump());
  const TemporaryDirectory directory;
  const std::string file = directory.write("scene.json", scene.dump());
  const std::string shown = value.dump().substr(0, 60);  // long values are cut off
  expectRefusal(runWetcloth({"validate", file}), {file + ": " + pointer + " = " + shown, allowed});
}

void expectRefusedAt(Json scene, const std::string& pointer, const Json& value, const std::string& allowed) {
  scene[Json::json_pointer(pointer)] = value;
  expectRefused(scene, pointer, value, allowed);
}

const std::string effectsAt = "/cloths/0/effects/";

struct BadNumber {
  std::string pointer;  ///< below the cloth's effects, or from the root
  std::vector<double> values;
  std::string allowed;
};

/// Every number that a scene can give, with what is just outside of its range.
const std::vector<BadNumber>& badNumbers() {
  static const std::vector<BadNumber> numbers{
      {"rain/flux_kg_m2_s", {-1e-9, 1e39}, "must be finite and >= 0"},
      {"rain/speed_m_s", {-1, 1e7}, "must be in [0, 1e6]"},
      {"splash/flux_kg_m2_s", {-1}, "must be finite and >= 0"},
      {"splash/sphere/radius_m", {0, -1}, "must be finite and > 0"},
      {"contact_wetting/films/0/collider", {-1, 0.5, 1}, "must be a whole number from 0 to 0"},
      {"contact_wetting/films/0/water_kg", {-1e-9}, "must be finite and >= 0"},
      {"contact_wetting/rate_kg_m2_s", {-1e-9}, "must be finite and >= 0"},
      {"diffusion/warp_diffusivity_m2_s", {0, -1e-5}, "must be finite and > 0"},
      {"diffusion/weft_diffusivity_m2_s", {0, -1e-5}, "must be finite and > 0"},
      {"diffusion/exponent", {-0.1, 100.1}, "must be in [0, 100]"},
      {"diffusion/tolerance", {0, 1}, "must be in (0, 1)"},
      {"seepage/speed_m_s", {-1e-9}, "must be finite and >= 0"},
      {"seepage/exponent", {0.9, 100.1}, "must be in [1, 100]"},
      {"dripping/holding_saturation", {-0.1, 1.1}, "must be in [0, 1]"},
      {"dripping/time_constant_s", {0, -3}, "must be finite and > 0"},
      {"dripping/drop_mass_kg", {-1e-9}, "must be finite and >= 0"},
      {"dripping/slope_tolerance", {-0.1, 1.1}, "must be in [0, 1]"},
      {"drying/temperature_c", {-0.1, 60.1, 293}, "must be in [0, 60]"},
      {"drying/relative_humidity", {-0.1, 50}, "must be in [0, 1]"},
      {"drying/self_cooling", {0, 1.1}, "must be in (0, 1]"},
      {"drying/critical_saturation", {0, 1.1}, "must be in (0, 1]"},
      {"drying/equilibrium_saturation", {-0.1, 0.3, 0.5}, "must be in [0, critical_saturation)"},
      {"drying/sides", {0, 2.1}, "must be in (0, 2]"},
      {"drying/exposure", {-0.1, 1.1}, "must be in [0, 1]"},
      {"wet_stiffness/wet_stretch", {0, 0.0009, 1001}, "must be in [0.001, 1000]"},
      {"wet_stiffness/wet_bending", {0, 0.0009, 1001}, "must be in [0.001, 1000]"},
      {"wet_stiffness/dry_damping_1_s", {-1}, "must be finite and >= 0"},
      {"wet_stiffness/wet_damping_1_s", {-1}, "must be finite and >= 0"},
      {"swelling/saturated_strain", {-0.5, 0.5}, "must be in (-0.5, 0.5)"},
      {"water_drag/drag_coefficient", {-1}, "must be finite and >= 0"},
      {"water_drag/skin_friction", {-1}, "must be finite and >= 0"},
      {"water_drag/fibre_density_kg_m3", {0, -1540}, "must be finite and > 0"},
      {"cling/adhesion_pa", {-1}, "must be finite and >= 0"},
      {"cling/shear_strength_pa", {-1}, "must be finite and >= 0"},
      {"cling/minimum_saturation", {-0.1, 1}, "must be in [0, 1)"},
      {"cling/peak_saturation", {0, 1.1}, "must be in (0, 1]"},
      {"cling/flooded_share", {-0.1, 1.1}, "must be in [0, 1]"},
      {"wet_friction/wet_factor", {-1}, "must be finite and >= 0"},
      {"wet_friction/peak_saturation", {0, 1.1}, "must be in (0, 1]"},
      {"wet_friction/flooded_factor", {-1}, "must be finite and >= 0"},
      {"/water/level_m", {1e39}, "must be a finite number"},
      {"/water/density_kg_m3", {0, -1000}, "must be finite and > 0"},
      {"/cloths/0/motion/times_s/0", {-1}, "must be finite and >= 0"},
      {"/cloths/0/motion/offsets_m/0/1", {2e8}, "must be in [-1e8, 1e8]"}};
  return numbers;
}

std::string pointerOf(const BadNumber& number) {
  return number.pointer[0] == '/' ? number.pointer : effectsAt + number.pointer;
}

/// Every pointer to a value of the scene that a user of the water cycle writes.
std::vector<std::string> pointersOf(const Json& scene) {
  std::vector<std::string> pointers;
  const Json flat = scene.flatten();
  for (const auto& [pointer, value] : flat.items()) {
    const bool isOurs = pointer.rfind(effectsAt, 0) == 0 || pointer.rfind("/cloths/0/motion", 0) == 0 ||
                        pointer.rfind("/water", 0) == 0;
    if (isOurs) pointers.push_back(pointer);
  }
  return pointers;
}

TEST(WaterCycleBadInput, TheScenesThemselvesAreGood) {
  const TemporaryDirectory directory;
  const Outcome outcome = runWetcloth({"validate", directory.write("good.json", goodScene().dump()),
                                       directory.write("other.json", otherScene().dump())});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
}

TEST(WaterCycleBadInput, NumbersOutOfRange) {
  for (const BadNumber& number : badNumbers()) {
    for (const double value : number.values) {
      // Whole numbers as they are shown: 0, not 0.0.
      const bool isWhole = value == std::floor(value) && std::fabs(value) < 1e9;
      const Json shown = isWhole ? Json(static_cast<int>(value)) : Json(value);
      expectRefusedAt(goodScene(), pointerOf(number), shown, number.allowed);
    }
  }
  expectRefusedAt(otherScene(), effectsAt + "splash/cone/half_angle_deg", 90, "must be in (0, 90)");
  expectRefusedAt(otherScene(), effectsAt + "splash/cone/half_angle_deg", 0, "must be in (0, 90)");
  expectRefusedAt(otherScene(), effectsAt + "splash/cone/reach_m", 0, "must be finite and > 0");
  expectRefusedAt(otherScene(), effectsAt + "drying/gust/period_s", 0, "must be finite and > 0");
}

TEST(WaterCycleBadInput, SeepageThatCannotBeInBalance) {
  Json scene = goodScene();
  expectRefusedAt(scene, effectsAt + "seepage/height_m", 0.1, "it stands for speed_m_s and exponent");
  scene[Json::json_pointer(effectsAt + "seepage")] = Json::object();
  expectRefusedAt(scene, effectsAt + "seepage/height_m", 0, "must be finite and > 0");
  scene[Json::json_pointer(effectsAt.substr(0, effectsAt.size() - 1))].erase("diffusion");
  expectRefusedAt(scene, effectsAt + "seepage/height_m", 0.1, "there is no \"diffusion\" to be in balance with");
}

TEST(WaterCycleBadInput, ValuesOfTheWrongType) {
  std::set<std::string> seen;
  for (const Json& scene : {goodScene(), otherScene()}) {
    for (const std::string& pointer : pointersOf(scene)) {
      if (!seen.insert(pointer).second) continue;
      const bool isText = scene.at(Json::json_pointer(pointer)).is_string();
      expectRefusedAt(scene, pointer, isText ? Json(1) : Json("NaN"), isText ? "a string" : "must be ");
    }
  }
  expectRefusedAt(goodScene(), effectsAt + "rain/flux_kg_m2_s", nullptr, "must be a number");
  expectRefusedAt(goodScene(), effectsAt + "drying/exposure", {0, 1}, "one value per node, 20 here; it has 2");
  expectRefusedAt(goodScene(), effectsAt + "diffusion/method", "explicit",
                  "must be one of factored, explicit_substeps");
}

TEST(WaterCycleBadInput, UnknownKeysAndTheNearestThatThereAre) {
  const std::vector<std::string> typos{"rain/flux_kg_m2_h",
                                       "splash/velocity_km_h",
                                       "splash/sphere/radius_mm",
                                       "contact_wetting/rate_g_m2_s",
                                       "contact_wetting/films/0/water_g",
                                       "diffusion/warp_diffusivity_mm2_s",
                                       "seepage/speed_mm_s",
                                       "dripping/drop_mass_g",
                                       "drying/temperature_k",
                                       "wet_stiffness/wet_strech",
                                       "swelling/saturated_strains",
                                       "water_drag/fibre_density_g_cm3",
                                       "cling/adhesion_kpa",
                                       "wet_friction/wet_factors",
                                       "/water/level_cm",
                                       "/cloths/0/motion/offsets_cm"};
  for (const std::string& typo : typos) {
    const std::string pointer = typo[0] == '/' ? typo : effectsAt + typo;
    const std::string unit = pointer.substr(0, pointer.rfind('_') + 1);
    expectRefusedAt(goodScene(), pointer, 1, "unknown key; did you mean \"" + unit.substr(unit.rfind('/') + 1, 4));
  }
  const Json scene = goodScene();
  for (const auto& [effect, value] : scene.at("cloths").at(0).at("effects").items()) {
    expectRefusedAt(scene, effectsAt + effect + "s", 1, "unknown key; did you mean \"" + effect + "\"?");
    expectRefusedAt(scene, effectsAt + effect, 1, "must be an object");
  }
  expectRefusedAt(scene, effectsAt + "immersion/depth_m", 1, "unknown key");
}

TEST(WaterCycleBadInput, DirectionsOfLengthZero) {
  for (const char* vector : {"rain/direction", "splash/velocity_m_s", "diffusion/warp"}) {
    expectRefusedAt(goodScene(), effectsAt + vector, {0, 0, 0}, "must be a direction, of a length in ");
    expectRefusedAt(goodScene(), effectsAt + vector, {0, 1}, "must be an array of three numbers");
  }
}

TEST(WaterCycleBadInput, EffectsThatNeedWhatIsNotThere) {
  for (const char* effect : {"immersion", "water_drag"}) {
    Json scene = smallScene();
    expectRefusedAt(scene, effectsAt + effect, Json::object(), "/water");
  }
  Json scene = goodScene();
  scene.erase("colliders");
  expectRefusedAt(scene, effectsAt + "contact_wetting/films", clothOf(scene)["effects"]["contact_wetting"]["films"],
                  "the scene has no colliders");
  scene = goodScene();
  Json& films = clothOf(scene)["effects"]["contact_wetting"]["films"];
  films.push_back(films.at(0));
  expectRefused(scene, effectsAt + "contact_wetting/films/1/collider", 0, "has a film already");
}

TEST(WaterCycleBadInput, ClothsThatExchangeWaterNeedTheirFlag) {
  for (const bool isDeformable : {false, true}) {
    Json scene = smallScene();
    if (isDeformable) scene["world"] = "deformable";
    for (const Json& flags : std::vector<Json>{nullptr, {"SDF_RS"}, {isDeformable ? "VF_SS" : "VF_DD"}}) {
      if (!flags.is_null()) clothOf(scene)["collisions"] = flags;
      clothOf(scene)["effects"] = {{"contact_wetting", Json::object()}};
      expectRefusedAt(scene, effectsAt + "contact_wetting/cloths", true, isDeformable ? "VF_DD" : "VF_SS");
    }
  }
}

TEST(WaterCycleBadInput, WhatOnlyTheLibraryKnows) {
  const TemporaryDirectory directory;
  Json scene = smallScene();
  scene["world"] = "deformable";
  clothOf(scene)["effects"] = {{"wet_stiffness", Json::object()}};
  const std::string stiffness = directory.write("stiffness.json", scene.dump());
  expectRefusal(runWetcloth({"validate", stiffness}),
                {stiffness + ": /cloths/0/effects/wet_stiffness: ", "HookeSprings"});
  clothOf(scene)["effects"]["hooke_springs"] = Json::object();
  EXPECT_EQ(runWetcloth({"validate", directory.write("springs.json", scene.dump())}).status, 0);
  for (const char* effect : {"cling", "wet_friction", "contact_wetting"}) {
    scene = goodScene();
    clothOf(scene)["collisions"] = {"CL_RS"};
    clothOf(scene)["clusters"] = 4;
    clothOf(scene)["effects"] = {{effect, goodScene()["cloths"][0]["effects"][effect]}};
    clothOf(scene)["effects"][effect].erase("cloths");
    const std::string clusters = directory.write("clusters.json", scene.dump());
    expectRefusal(runWetcloth({"validate", clusters}), {clusters + ": /cloths/0/effects/" + effect + ": ", "CL_RS"});
  }
}

TEST(WaterCycleBadInput, SaturationsThatDoNotFollowEachOther) {
  expectRefusedAt(goodScene(), effectsAt + "cling/peak_saturation", 0.1, "minimum_saturation must be below");
  Json scene = goodScene();
  clothOf(scene)["effects"]["cling"] = Json::object();
  expectRefusedAt(scene, effectsAt + "cling/minimum_saturation", 0.5, "minimum_saturation must be below");
}

TEST(WaterCycleBadInput, AlternativesOfWhichThereMustBeOne) {
  Json scene = goodScene();
  Json drying = {{"velocity_m_s", {0, 0, 1}}, {"gust", Json::object()}};
  expectRefusedAt(scene, effectsAt + "drying", drying, "must have exactly one of the keys velocity_m_s, gust");
  Json& splash = clothOf(scene)["effects"]["splash"];
  splash.erase("sphere");
  expectRefused(scene, effectsAt + "splash", splash, "exactly one of the keys sphere, cone, has none");
  splash["sphere"] = splash["cone"] = Json::object();
  expectRefused(scene, effectsAt + "splash", splash, "exactly one of the keys sphere, cone, has sphere, cone");
}

TEST(WaterCycleBadInput, KeysThatMustBeThere) {
  const std::vector<std::string> required{"/water/level_m",
                                          "/cloths/0/motion/times_s",
                                          "/cloths/0/motion/offsets_m",
                                          effectsAt + "splash/velocity_m_s",
                                          effectsAt + "splash/sphere/centre_m",
                                          effectsAt + "splash/sphere/radius_m",
                                          effectsAt + "contact_wetting/films/0/water_kg"};
  for (const std::string& pointer : required) {
    Json scene = goodScene();
    const Json::json_pointer place(pointer);
    Json& parent = scene[place.parent_pointer()];
    parent.erase(place.back());
    expectRefused(scene, place.parent_pointer().to_string(), parent, "the key \"" + place.back() + "\" is missing");
  }
}

TEST(WaterCycleBadInput, AFilmIsOnAColliderOrOnAFigure) {
  const std::string film = effectsAt + "contact_wetting/films/0";
  expectRefusedAt(goodScene(), film, {{"water_kg", 1}}, "exactly one of the keys collider, figure");
  expectRefusedAt(goodScene(), film, {{"collider", 0}, {"figure", "man"}, {"water_kg", 1}},
                  "exactly one of the keys collider, figure");
  expectRefused(
      [&] {
        Json scene = goodScene();
        scene[Json::json_pointer(film)] = {{"figure", "man"}, {"water_kg_m2", 1}};
        return scene;
      }(),
      film + "/figure", "man", "the scene has no figures");
}

TEST(WaterCycleBadInput, MotionsThatCannotBe) {
  const std::string motion = "/cloths/0/motion";
  const Json offset = {0, 0, 0};
  expectRefusedAt(goodScene(), motion + "/times_s/1", 0, "later than the time before");
  expectRefusedAt(goodScene(), motion + "/times_s", Json::array(), "at least one time");
  expectRefusedAt(goodScene(), motion + "/offsets_m", Json::array(), "one element for each of times_s, 2");
  expectRefusedAt(goodScene(), motion + "/offsets_m", {offset, offset, offset}, "one element for each of times_s, 2");
  expectRefusedAt(goodScene(), motion + "/offsets_m/1", {0, 1}, "must be an array of three numbers");
  Json scene = goodScene();
  clothOf(scene)["twist"] = {{"edge", "top"}};
  expectRefused(scene, motion, clothOf(scene)["motion"], "twist");
  for (const Json& none : std::vector<Json>{nullptr, Json::object(), {{"edges", Json::array()}}}) {
    scene = goodScene();
    clothOf(scene)["pins"] = none;
    if (none.is_null()) clothOf(scene).erase("pins");
    expectRefused(scene, motion, clothOf(scene)["motion"], "moves the cloth's pins, and it has none");
  }
}

}  // namespace
}  // namespace wetcloth_test::water_cycle_bad_input_test
