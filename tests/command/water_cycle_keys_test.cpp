// SPDX-License-Identifier: Zlib
#include "tests/command/WaterScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <string>
#include <vector>

// The schema's defaults are the library's, and each key reaches it: one cloth with all effects of the water cycle, so
// placed that each has something to do, told apart by the hash of its state.

namespace wetcloth_test::water_cycle_keys_test {
namespace {

using namespace cli;

const std::vector<std::string>& effects() {
  static const std::vector<std::string> names{
      "immersion", "rain",     "splash",        "contact_wetting", "diffusion", "seepage",     "dripping",
      "drying",    "swelling", "wet_stiffness", "water_drag",      "cling",     "wet_friction"};
  return names;
}

const Json& schema() {
  static const Json json = readJson(WETCLOTH_SOURCE_DIR "/examples/scenes/scene.schema.json");
  return json;
}

std::string camelCase(const std::string& key) {
  std::string name;
  for (std::size_t i = 0; i < key.size(); ++i) {
    if (key[i] == '_') continue;
    name += i > 0 && key[i - 1] == '_' ? static_cast<char>(std::toupper(static_cast<unsigned char>(key[i]))) : key[i];
  }
  return name;
}

/// The default of a key: JSON Schema's own, or of a vector the one in its description; null when it has none.
Json defaultOf(const Json& property) {
  if (property.contains("default")) return property.at("default");
  const std::string text = property.value("description", "");
  const std::size_t start = text.find("Default [");
  return start == std::string::npos ? Json() : Json::parse(text.substr(start + 8, text.find(']', start) - start - 7));
}

/// The keys of an effect that have a default, with it.
Json defaultsOf(const std::string& effect) {
  Json defaults = Json::object();
  for (const auto& [key, property] : schema().at("$defs").at(camelCase(effect)).at("properties").items()) {
    const Json value = defaultOf(property);
    if (!value.is_null()) defaults[key] = value;
  }
  return defaults;
}

/// A cloth that falls from a ball into water, in the rain and beside a hose.
Json everything() {
  Json scene = levelScene(Json::object(), 0.4);
  scene["colliders"] = {{{"sphere", {{"centre_m", {0.5, 0.68, 0.5}}, {"radius_m", 0.3}}}}};
  scene["water"]["level_m"] = 0.9;
  clothOf(scene)["patch"]["columns"] = 9;
  clothOf(scene)["patch"]["rows"] = 9;
  clothOf(scene)["initial_saturation"] = 0.7;
  for (const std::string& effect : effects()) clothOf(scene)["effects"][effect] = Json::object();
  Json& given = clothOf(scene)["effects"];
  given["splash"] = {{"sphere", {{"centre_m", {0.5, 1, 0.5}}, {"radius_m", 0.4}}}, {"velocity_m_s", {0.3, -1, 0}}};
  given["contact_wetting"]["films"] = {{{"collider", 0}, {"water_kg", 0.1}}};
  return scene;
}

std::string hashOf(const Json& scene) {
  static std::map<Json, std::string> known;  // many keys show in the same scene
  const auto place = known.find(scene);
  if (place != known.end()) return place->second;
  return known[scene] = runScene(scene).at("state_hash").get<std::string>();
}

struct Key {
  std::string effect;
  std::string key;
};

/// All keys with a default but those that show elsewhere: the drops' mass in the count of drops, `cloths` in a scene
/// with two of them, `self_shelter` in one that covers itself.
std::vector<Key> keysThatShow() {
  std::vector<Key> keys;
  for (const std::string& effect : effects()) {
    const Json defaults = defaultsOf(effect);
    for (const auto& [key, value] : defaults.items()) {
      if (key != "drop_mass_kg" && key != "cloths" && key != "self_shelter") keys.push_back({effect, key});
    }
  }
  return keys;
}

/// Another value that the key may have.
Json changed(const std::string& key, const Json& value) {
  if (key == "tolerance") return 0.5;
  if (key == "minimum_saturation") return 0.4;
  if (key == "equilibrium_saturation") return 0.1;
  if (key == "adhesion_pa") return 0;  // the ball is below: little pull is enough
  if (value.is_boolean()) return !value.get<bool>();
  if (value.is_array()) return Json({0.5, -0.7, 0.6});
  if (value.is_number()) return value == 0 ? Json(1) : Json(value.get<double>() / 2);
  return "conjugate_gradients";
}

/// The scene in which a key matters.
Json sceneFor(const Key& key) {
  Json scene = everything();
  Json& effect = clothOf(scene)["effects"][key.effect];
  if (key.key == "tolerance") effect["method"] = "conjugate_gradients";
  if (key.key == "warp") effect["warp_diffusivity_m2_s"] = 1e-3;
  const bool isOfALittleWater = key.key == "critical_saturation" || key.key == "equilibrium_saturation" ||
                                key.key == "minimum_saturation" || key.key == "peak_saturation";
  if (isOfALittleWater) clothOf(scene)["initial_saturation"] = 0.2;
  return scene;
}

/// An end of a key's range in the schema.
struct Bound {
  std::string effect;
  std::string key;
  double end;
  double outside;
  bool endIsIn;
};

std::vector<Bound> bounds() {
  std::vector<Bound> found;
  for (const std::string& effect : effects()) {
    const Json properties = schema().at("$defs").at(camelCase(effect)).at("properties");
    for (const auto& [key, property] : properties.items()) {
      for (const auto& [word, value] : property.items()) {
        const bool isLow = word == "minimum" || word == "exclusiveMinimum";
        if (!isLow && word != "maximum" && word != "exclusiveMaximum") continue;
        const double end = value.get<double>();
        found.push_back({effect, key, end, end + (isLow ? -1e-4 : 1e-4), word[0] == 'm'});
      }
    }
  }
  return found;
}

TEST(WaterCycleKeys, TheSchemaKnowsADefaultForEveryKeyThatMayBeLeftOut) {
  std::size_t count = 0;
  for (const std::string& effect : effects()) {
    const Json defaults = defaultsOf(effect);
    count += defaults.size();
    const Json& definition = schema().at("$defs").at(camelCase(effect));
    for (const auto& [key, property] : definition.at("properties").items()) {
      const Json required = definition.value("required", Json::array());
      const bool isGiven = std::find(required.begin(), required.end(), key) != required.end();
      const bool isAlternative =
          key == "sphere" || key == "cone" || key == "gust" || key == "films" || key == "height_m";
      EXPECT_EQ(defaults.contains(key), !isGiven && !isAlternative) << effect << "/" << key;
    }
  }
  EXPECT_GT(count, 40u);
}

TEST(WaterCycleKeys, TheSchemasDefaultsAreTheLibrarys) {
  const std::string usual = hashOf(everything());
  Json scene = everything();
  for (const std::string& effect : effects()) clothOf(scene)["effects"][effect].update(defaultsOf(effect));
  scene["water"]["density_kg_m3"] = 1000;
  EXPECT_EQ(hashOf(scene), usual);
}

TEST(WaterCycleKeys, AnotherValueMakesAnotherRun) {
  for (const Key& key : keysThatShow()) {
    Json scene = sceneFor(key);
    Json& effect = clothOf(scene)["effects"][key.effect];
    const std::string usual = hashOf(scene);
    const Json value = defaultsOf(key.effect).at(key.key);
    if (scene != everything()) {  // of that one all defaults are checked at once, above
      effect[key.key] = value;
      EXPECT_EQ(hashOf(scene), usual) << key.effect << "/" << key.key << " = " << value;
    }
    effect[key.key] = changed(key.key, value);
    EXPECT_NE(hashOf(scene), usual) << key.effect << "/" << key.key << " = " << changed(key.key, value);
  }
}

TEST(WaterCycleKeys, SeepageMayBeInBalanceWithDiffusion) {
  const auto hashOfHeight = [](double height) {
    Json scene = everything();
    clothOf(scene)["effects"]["seepage"] = {{"height_m", height}};
    return hashOf(scene);
  };
  EXPECT_NE(hashOfHeight(0.1), hashOfHeight(0.05));
}

TEST(WaterCycleKeys, TheReadersRangesAreTheSchemas) {
  const TemporaryDirectory directory;
  const Json good = readJson(WETCLOTH_SOURCE_DIR "/tests/scenes/water_cycle.json");
  std::vector<std::string> accepted{"validate"};
  std::vector<std::string> refused;
  for (const Bound& bound : bounds()) {
    Json scene = good;
    Json& value = clothOf(scene)["effects"][bound.effect][bound.key];
    for (const bool isOutside : {false, true}) {
      value = isOutside ? bound.outside : bound.end;
      std::vector<std::string>& files = isOutside || !bound.endIsIn ? refused : accepted;
      const std::string name = bound.effect + "." + bound.key + "." + value.dump() + ".json";
      files.push_back(directory.write(name, scene.dump()));
    }
  }
  ASSERT_GT(accepted.size(), 30u);
  EXPECT_EQ(runWetcloth(accepted).status, 0) << runWetcloth(accepted).err;
  for (const std::string& file : refused) EXPECT_EQ(runWetcloth({"validate", file}).status, 2) << file;
}

TEST(WaterCycleKeys, TheMassOfADropIsInTheCountOfDrops) {
  Json scene = uprightScene({{"dripping", Json::object()}}, 2);
  clothOf(scene)["initial_saturation"] = 1;
  const int usual = runScene(scene).at("drips").at("count").get<int>();
  clothOf(scene)["effects"]["dripping"]["drop_mass_kg"] = 5e-5;
  EXPECT_EQ(runScene(scene).at("drips").at("count"), usual);
  clothOf(scene)["effects"]["dripping"]["drop_mass_kg"] = 1e-5;
  EXPECT_NEAR(runScene(scene).at("drips").at("count").get<int>(), 5 * usual, usual);
}

}  // namespace
}  // namespace wetcloth_test::water_cycle_keys_test
