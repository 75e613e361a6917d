// SPDX-License-Identifier: Zlib
// What a scene may say of drops, and what a run tells of them.

#include "command/cli/Errors.h"
#include "command/run/DripRecord.h"
#include "command/run/RunReport.h"
#include "command/scene/DryScene.h"
#include "command/scene/SceneReader.h"
#include "command/scene/SceneWorld.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <string>

namespace wetcloth_test::drops_command_test {
namespace {

using command::InputError;
using command::Scene;

std::string fileWith(const nlohmann::json& drops) {
  nlohmann::json scene = {{"world", "soft_rigid"},
                          {"duration_s", 0.5},
                          {"cloths",
                           {{{"patch",
                              {{"columns", 8},
                               {"rows", 8},
                               {"origin_m", {-0.2, 0.5, 0.2}},
                               {"edge_u_m", {0.4, 0, 0}},
                               {"edge_v_m", {0, 0, -0.4}}}},
                             {"fabric", "cotton"},
                             {"pins", {{"edges", {"top", "bottom"}}}}}}},
                          {"colliders",
                           {{{"plane", nlohmann::json::object()}},
                            {{"cylinder", {{"from_m", {0, 0.8, 0}}, {"to_m", {0, 0.9, 0}}, {"radius_m", 0.03}}},
                             {"motion", {{"times_s", {0, 0.2}}, {"rotations_deg", {{0, 0, 0}, {0, 0, -90}}}}}}}},
                          {"drops", drops}};
  const auto file = std::filesystem::temp_directory_path() /
                    ("drops_" + std::to_string(std::hash<std::string>()(scene.dump())) + ".json");
  std::ofstream(file) << scene;
  return file.string();
}

std::string refusal(const nlohmann::json& drops) {
  const std::string file = fileWith(drops);
  std::string text;
  try {
    command::readScene(file);
  } catch (const InputError& error) {
    text = error.what();
  }
  std::filesystem::remove(file);
  return text;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

const nlohmann::json kSpout = {{"position_m", {0, 1, 0}}, {"flow_kg_s", 0.02}};

nlohmann::json spoutWith(const char* key, const nlohmann::json& value) {
  nlohmann::json spout = kSpout;
  spout[key] = value;
  return {{"pours", {spout}}};
}

TEST(DropsInScenes, WhatIsBadIsNamed) {
  EXPECT_EQ(refusal(nlohmann::json::object()), "");
  EXPECT_EQ(refusal({{"pours", {kSpout}}}), "");
  for (const char* key : {"position_m", "flow_kg_s"}) {
    nlohmann::json spout = kSpout;
    spout.erase(key);
    const std::string text = refusal({{"pours", nlohmann::json::array({spout})}});
    EXPECT_TRUE(has(text, "/drops/pours/0") && has(text, key)) << text;
  }
  EXPECT_TRUE(has(refusal(spoutWith("flow_kg_s", -1)), "/drops/pours/0/flow_kg_s = -1"));
  EXPECT_TRUE(has(refusal(spoutWith("drop_diameter_m", 0)), "/drops/pours/0/drop_diameter_m = 0"));
  EXPECT_TRUE(has(refusal(spoutWith("half_angle_deg", 90)), "/drops/pours/0/half_angle_deg = 90"));
  nlohmann::json late = kSpout;
  late["start_s"] = 2;
  late["stop_s"] = 1;
  EXPECT_TRUE(has(refusal({{"pours", {late}}}), "/drops/pours/0/stop_s"));
  EXPECT_TRUE(has(refusal({{"most", 0}}), "/drops/most = 0"));
  EXPECT_TRUE(has(refusal({{"wind_m_s", {0, nullptr, 0}}}), "/drops/wind_m_s"));
  EXPECT_TRUE(has(refusal({{"wind", {0, 0, 0}}}), "wind_m_s"));
  EXPECT_TRUE(has(refusal({{"glasses", {{{"collider", 0}, {"water_kg", 0.1}}}}}), "must be a cylinder"));
  EXPECT_TRUE(has(refusal({{"glasses", {{{"collider", 7}, {"water_kg", 0.1}}}}}), "/drops/glasses/0/collider = 7"));
  EXPECT_TRUE(has(refusal({{"glasses", {{{"collider", 1}, {"water_kg", 1}}}}}), "/drops/glasses/0/water_kg = 1"));
  const nlohmann::json full = {{"collider", 1}, {"water_kg", 0.1}};
  EXPECT_TRUE(has(refusal({{"glasses", {full, full}}}), "/drops/glasses/1 = "));
}

TEST(DropsInScenes, ARunTellsTheLedgerOfTheWorld) {
  const std::string file = fileWith({{"pours", {kSpout}}, {"glasses", {{{"collider", 1}, {"water_kg", 0.2}}}}});
  const Scene scene = command::readScene(file);
  command::SceneWorld world(scene);
  command::DripRecord drips(60);
  for (int i = 0; i < 60; ++i) {
    world.step();
    drips.note(world);
  }
  const nlohmann::ordered_json drops = command::RunReport(world, {}, drips).json().at("drops");
  const double brought = drops.at("brought").get<double>();
  // The glass is empty but for what is no full drop, and a second of the spout has come.
  EXPECT_NEAR(brought, 0.2 + 0.02, 1e-3);
  EXPECT_LT(std::fabs(drops.at("imbalance").get<double>()), 1e-12 * brought);
  EXPECT_GT(drops.at("held").get<double>(), 1e-3);
  EXPECT_GT(drops.at("films").get<double>(), 1e-3);
  std::filesystem::remove(file);
}

TEST(DropsInScenes, TheDrySceneHasNone) {
  const std::string file = fileWith(nlohmann::json::object());
  const Scene scene = command::readScene(file);
  EXPECT_TRUE(scene.drops);
  EXPECT_FALSE(command::dryScene(scene).drops);
  EXPECT_EQ(command::SceneWorld(scene, command::SceneWorld::Kind::plainBullet).drops(), nullptr);
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace wetcloth_test::drops_command_test
