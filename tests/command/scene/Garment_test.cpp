// SPDX-License-Identifier: Zlib
// Panels sewn together: what becomes one node, how long its links are, and where a dressed garment is.

#include "command/scene/ClothBody.h"
#include "command/scene/Dressing.h"
#include "command/scene/SceneReader.h"
#include "command/scene/SceneWorld.h"
#include "tests/command/Command.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>

namespace wetcloth_test::garment_test {
namespace {

using namespace cli;

constexpr int kSide = 5;

Json panel(const std::string& name, double z) {
  return {{"name", name},
          {"patch",
           {{"columns", kSide},
            {"rows", kSide},
            {"origin_m", {-0.2, 0, z}},
            {"edge_u_m", {0.4, 0, 0}},
            {"edge_v_m", {0, 0.4, 0}}}}};
}

Json seam(const std::string& line) {
  return {{"first", {{"panel", "front"}, {"line", line}}}, {"second", {{"panel", "back"}, {"line", line}}}};
}

/// A sack over an upright post, open below.
Json sack() {
  return {{"world", "soft_rigid"},
          {"precision", testedPrecision()},
          {"duration_s", 0.5},
          {"substeps", 1},
          {"solver", "wetcloth"},
          {"cloths",
           {{{"garment",
              {{"panels", {panel("front", 0.15), panel("back", -0.15)}},
               {"seams", {seam("left"), seam("right"), seam("top")}},
               {"sewing_s", 0.3},
               {"settling_s", 0.3}}},
             {"fabric", "cotton"},
             {"margin_m", 0.005}}}},
          {"colliders", {{{"capsule", {{"from_m", {0, -1, 0}}, {"to_m", {0, 0.3, 0}}, {"radius_m", 0.08}}}}}}};
}

command::Scene sceneOf(const Json& json, const TemporaryDirectory& directory) {
  return command::readScene(directory.write("scene.json", json.dump()));
}

struct Sack {
  TemporaryDirectory directory;
  command::Scene scene = sceneOf(sack(), directory);
  const command::TriangleMesh& mesh() const { return std::get<command::TriangleMesh>(scene.cloths[0].shape); }
};

TEST(Garment, SeamsJoinNodesInTheMiddleBetweenThem) {
  const Sack sack;
  const int onSeams = 3 * kSide - 2;  // left, top and right share two corners
  EXPECT_EQ(sack.mesh().vertices.size(), std::size_t(2 * kSide * kSide - onSeams));
  EXPECT_EQ(sack.mesh().triangles.size(), std::size_t(2 * 2 * (kSide - 1) * (kSide - 1)));
  int inTheMiddle = 0;
  for (const btVector3& place : sack.mesh().vertices) {
    if (std::abs(place.z()) < btScalar(1e-6)) ++inTheMiddle;
  }
  EXPECT_EQ(inTheMiddle, onSeams);
}

TEST(Garment, HasTheMassOfItsPanels) {
  const Sack sack;
  btSoftBodyWorldInfo info;
  const auto body = command::makeClothBody(sack.scene.cloths[0], info);
  double mass = 0;
  for (int i = 0; i < body->m_nodes.size(); ++i) mass += 1 / static_cast<double>(body->m_nodes[i].m_im);
  EXPECT_NEAR(mass, 2 * 0.4 * 0.4 * sack.scene.cloths[0].fabric.arealDensity, 1e-6);
}

// Also of links across an edge, and across a seam, where both triangles are unfolded: nothing is longer than two
// squares' diagonals, or as short as folded.
TEST(Garment, LinksAreAsLongAsInTheFlatPanels) {
  const Sack sack;
  btSoftBodyWorldInfo info;
  const auto body = command::makeClothBody(sack.scene.cloths[0], info);
  const double side = 0.4 / (kSide - 1);
  EXPECT_FALSE(body->m_bUpdateRtCst) << "Bullet would take the lengths anew";
  for (int k = 0; k < body->m_links.size(); ++k) {
    const double length = static_cast<double>(body->m_links[k].m_rl) / side;
    const double nearest = std::min(
        {std::abs(length - 1), std::abs(length - std::sqrt(2)), std::abs(length - 2), std::abs(length - std::sqrt(5))});
    EXPECT_LT(nearest, 1e-4) << length;
  }
}

TEST(Garment, NeighboursShowTheSameSide) {
  const Sack sack;
  std::map<std::pair<int, int>, int> directed;
  for (const auto& corners : sack.mesh().triangles) {
    for (std::size_t k = 0; k < 3; ++k) ++directed[{corners[k], corners[(k + 1) % 3]}];
  }
  int twice = 0;
  for (const auto& [edge, count] : directed) twice += count > 1 ? 1 : 0;
  // The two corners on top have a triangle of either panel with the same nodes.
  EXPECT_LE(twice, 6);
}

double largestStretch(const btSoftBody& body) {
  double most = 0;
  for (int k = 0; k < body.m_links.size(); ++k) {
    const btSoftBody::Link& link = body.m_links[k];
    most = std::max(most, static_cast<double>((link.m_n[1]->m_x - link.m_n[0]->m_x).length() / link.m_rl));
  }
  return most;
}

TEST(Garment, IsDrawnInOverWhatWearsIt) {
  const Sack sack;
  const auto& places = command::dressedPlaces(sack.scene)[0];
  ASSERT_EQ(places.size(), sack.mesh().vertices.size());
  for (const btVector3& place : places) {
    const btVector3 nearest(0, std::min(place.y(), btScalar(0.3)), 0);
    EXPECT_GT((place - nearest).length(), btScalar(0.08)) << "in the post";
  }
  btSoftBodyWorldInfo info;
  EXPECT_GT(largestStretch(*command::makeClothBody(sack.scene.cloths[0], info)), 1.5) << "at a seam, before it is sewn";
  const command::SceneWorld world(sack.scene);
  EXPECT_LT(largestStretch(*world.bodies()[0]), 1.3);
}

// Each panel brings 0.4 x 0.4 m of its own fabric, and nodes on seams are of the front.
TEST(Garment, PanelsHaveTheirOwnFabrics) {
  Json json = sack();
  json["cloths"][0]["garment"]["fabrics"] = {
      {{"panel", "back"},
       {"fabric", {{"preset", "coarse_wool"}, {"areal_density_kg_m2", 0.4}, {"colour", {0.5, 0.1, 0.1}}}}}};
  const TemporaryDirectory directory;
  const command::Scene scene = sceneOf(json, directory);
  const command::SceneWorld world(scene);
  const wetcloth::WetCloth& cloth = *world.cloths()[0];
  const auto& back = std::get<command::TriangleMesh>(scene.cloths[0].shape).groups.at("back");
  ASSERT_EQ(cloth.fabrics().size(), 2U);
  const double cotton = wetcloth::Fabric::cotton().capacity, wool = wetcloth::Fabric::coarseWool().capacity;
  const auto& front = std::get<command::TriangleMesh>(scene.cloths[0].shape).groups.at("front");
  for (int node = 0; node < scene.cloths[0].nodeCount(); ++node) {
    const bool isFront = std::binary_search(front.begin(), front.end(), node);
    EXPECT_TRUE(isFront || std::binary_search(back.begin(), back.end(), node));
    EXPECT_NEAR(cloth.capacity(node) / cloth.dryMass(node), isFront ? cotton : wool, 1e-6) << node;
  }
  double mass = 0;
  for (int node = 0; node < scene.cloths[0].nodeCount(); ++node) mass += cloth.dryMass(node);
  EXPECT_NEAR(mass, 0.16 * (scene.cloths[0].fabric.arealDensity + 0.4), 1e-6);
}

TEST(Garment, OfAnotherFabricKeepsThatOfItsPanels) {
  Json json = sack();
  json["cloths"][0]["garment"]["fabrics"] = {{{"panel", "back"}, {"fabric", "coarse_wool"}}};
  const TemporaryDirectory directory;
  command::Scene scene = sceneOf(json, directory);
  wetcloth::Fabric heavy = wetcloth::Fabric::cotton();
  heavy.arealDensity = 1;
  scene.cloths[0].makeOf(heavy);
  btSoftBodyWorldInfo info;
  const auto body = command::makeClothBody(scene.cloths[0], info);
  double mass = 0;
  for (int i = 0; i < body->m_nodes.size(); ++i) mass += 1 / static_cast<double>(body->m_nodes[i].m_im);
  EXPECT_NEAR(mass, 0.16 * (1 + wetcloth::Fabric::coarseWool().arealDensity), 1e-6);
  EXPECT_EQ(scene.cloths[0].garment->fabrics[0].arealDensity, 1);
}

TEST(Garment, WaterGoesAcrossASeam) {
  Json json = sack();
  json["gravity_m_s2"] = {0, 0, 0};
  json["duration_s"] = 2;
  json["cloths"][0]["effects"] = {
      {"diffusion", {{"warp_diffusivity_m2_s", 0.01}, {"weft_diffusivity_m2_s", 0.01}, {"exponent", 0}}}};
  const TemporaryDirectory directory;
  const command::Scene scene = sceneOf(json, directory);
  command::SceneWorld world(scene);
  wetcloth::WetCloth& cloth = *world.cloths()[0];
  const auto& front = std::get<command::TriangleMesh>(scene.cloths[0].shape).groups.at("front");
  std::vector<double> held(std::size_t(cloth.nodeCount()), 0);
  for (const int node : front) held[std::size_t(node)] = 0.5 * cloth.capacity(node);
  cloth.setHeld(held);
  for (int i = 0; i < 120; ++i) world.step();
  for (int node = 0; node < cloth.nodeCount(); ++node) EXPECT_GT(cloth.saturation(node), 0.05) << node;
  EXPECT_NEAR(cloth.ledger().imbalance(), 0, 1e-12);
}

TEST(Garment, BadPanelsAndSeamsAreNamed) {
  const auto refused = [](const char* pointer, const Json& value, const std::vector<std::string>& words) {
    Json json = sack();
    json[Json::json_pointer("/cloths/0/garment" + std::string(pointer))] = value;
    const TemporaryDirectory directory;
    try {
      sceneOf(json, directory);
      ADD_FAILURE() << pointer << " was taken";
    } catch (const std::exception& error) {
      for (const std::string& word : words)
        EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  };
  refused("/seams/0/first/panel", "frnt", {"/seams/0/first/panel", "\"front\""});
  refused("/seams/0/first/line", "lft", {"/seams/0/first/line", "\"left\""});
  refused("/seams/0/second", {{"panel", "back"}, {"nodes", {0, 5}}}, {"/seams/0", "5 and 2"});
  refused("/seams/0/second", {{"panel", "back"}, {"nodes", {99}}}, {"/seams/0/second/nodes/0", "from 0 to 24"});
  refused("/seams/0",
          {{"first", {{"panel", "front"}, {"nodes", {0}}}}, {"second", {{"panel", "front"}, {"nodes", {1}}}}},
          {"join two corners of a triangle", "\"front\""});
  refused("/panels/1/name", "front", {"/panels/1/name", "another panel"});
  refused("/panels", Json::array(), {"/panels", "at least one"});
  refused("/sewing_s", 0, {"/sewing_s", "> 0"});
  refused("/settling_s", -1, {"/settling_s", ">= 0"});
  refused("/fabrics", {{{"panel", "frnt"}, {"fabric", "cotton"}}}, {"/fabrics/0/panel", "\"front\""});
  refused("/file", "shirt.json", {"/cloths/0/garment", "file, panels"});
}

}  // namespace
}  // namespace wetcloth_test::garment_test
