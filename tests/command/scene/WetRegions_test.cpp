// SPDX-License-Identifier: Zlib
// What of a cloth is wet at the beginning, and films on what it meets.

#include "command/scene/ColliderSurface.h"
#include "command/scene/SceneReader.h"
#include "command/scene/SceneWorld.h"
#include "tests/command/Command.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace wetcloth_test::wet_regions_test {
namespace {

using namespace cli;

command::Scene sceneOf(const Json& json, const TemporaryDirectory& directory) {
  return command::readScene(directory.write("scene.json", json.dump()));
}

Json box(double low, double high, double saturation) {
  const double middle = (low + high) / 2, half = (high - low) / 2;
  return {{"box", {{"centre_m", {middle, 0, 0}}, {"half_extents_m", {half, 10, 10}}}}, {"saturation", saturation}};
}

TEST(WetRegions, NodesAreAsWetAsTheLastRegionThatHoldsThem) {
  Json json = smallScene();
  json["precision"] = testedPrecision();
  json["cloths"][0]["initial_saturation"] = 0.25;
  json["cloths"][0]["wet_regions"] = {box(-10, 0.6, 1), box(-10, 0.3, 0.5)};
  const TemporaryDirectory directory;
  const command::Scene scene = sceneOf(json, directory);
  const command::SceneWorld world(scene);
  const wetcloth::WetCloth& cloth = *world.cloths()[0];
  int wet = 0, half = 0;
  for (int node = 0; node < scene.cloths[0].nodeCount(); ++node) {
    const btScalar x = cloth.body().m_nodes[node].m_x.x();
    const double expected = x <= btScalar(0.3) ? 0.5 : x <= btScalar(0.6) ? 1 : 0.25;
    EXPECT_NEAR(cloth.saturation(node), expected, 1e-9) << node;
    wet += expected == 1 ? 1 : 0;
    half += expected == 0.5 ? 1 : 0;
  }
  EXPECT_GT(wet, 0);
  EXPECT_GT(half, 0);
}

TEST(WetRegions, BadOnesAreNamed) {
  const auto complaint = [](const Json& regions) -> std::string {
    Json json = smallScene();
    json["precision"] = testedPrecision();
    json["cloths"][0]["wet_regions"] = regions;
    const TemporaryDirectory directory;
    try {
      const command::Scene scene = sceneOf(json, directory);
      const command::SceneWorld world(scene);
    } catch (const std::exception& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(complaint(Json::array({box(-10, 10, 1)})), "");
  EXPECT_NE(complaint(Json::array({box(-10, 10, 1.5)})).find("/cloths/0/wet_regions/0/saturation"), std::string::npos);
  EXPECT_NE(complaint(Json::array({box(-10, 10, std::nan(""))})).find("/cloths/0/wet_regions/0/saturation"),
            std::string::npos);
  EXPECT_NE(complaint(Json::array({{{"saturation", 1}}})).find("/cloths/0/wet_regions/0"), std::string::npos);
  EXPECT_NE(complaint(Json::array({box(50, 60, 1)})).find("no node of the cloth begins in"), std::string::npos);
  EXPECT_NE(complaint(3).find("/cloths/0/wet_regions"), std::string::npos);
}

// A box of 2 x 4 x 6 m has 88 m^2; a ball's polyhedron has less than the ball.
TEST(WetRegions, AreaOfASurface) {
  EXPECT_NEAR(command::areaOf(command::Box{{3, 1, 0}, {1, 2, 3}}), 88, 1e-4);
  const double ball = 4 * 3.14159265358979 * 0.25;
  const double area = command::areaOf(command::Sphere{{0, 1, 0}, 0.5});
  EXPECT_LT(area, ball);
  EXPECT_GT(area, 0.95 * ball);
}

}  // namespace
}  // namespace wetcloth_test::wet_regions_test
