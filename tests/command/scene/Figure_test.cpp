// SPDX-License-Identifier: Zlib
// Figures: where a motion file puts their pieces, and what is said of bad ones.

#include "command/scene/ColliderSurface.h"
#include "command/scene/SceneReader.h"
#include "command/scene/SceneWorld.h"
#include "tests/command/Command.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace wetcloth_test::figure_test {
namespace {

using namespace cli;

/// An arm of two bones of 1 m, the first along x: its shoulder turns by 90 degrees about z in 1 s and stands 2 m high.
const char* const arm = R"(HIERARCHY
ROOT Shoulder
{
  OFFSET 0 0 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT Elbow
  {
    OFFSET 1 0 0
    CHANNELS 3 Zrotation Xrotation Yrotation
    End Site
    {
      OFFSET 1 0 0
    }
  }
}
MOTION
Frames: 2
Frame Time: 1
0 2 0 0 0 0 0 0 0
0 2 0 90 0 0 90 0 0
)";

Json figureScene() {
  Json scene = smallScene();
  scene["precision"] = testedPrecision();
  scene.erase("colliders");
  scene["figures"] = {{{"motion", "arm.bvh"}, {"bone_radius_m", 0.1}}};
  return scene;
}

class Reading {
 public:
  command::Scene scene(const Json& json, const std::string& motion = arm) {
    m_directory.write("arm.bvh", motion);
    return command::readScene(m_directory.write("scene.json", json.dump()));
  }
  std::string complaint(const Json& json, const std::string& motion = arm) {
    try {
      scene(json, motion);
    } catch (const std::exception& error) {
      return error.what();
    }
    return "";
  }
  bool isWithoutAssimp() { return complaint(figureScene()).find("built without it") != std::string::npos; }

 private:
  TemporaryDirectory m_directory;
};

#define SKIP_WITHOUT_ASSIMP(reading) \
  if ((reading).isWithoutAssimp()) GTEST_SKIP() << "without assimp (Debian: libassimp-dev)"

void expectNear(const btVector3& found, const btVector3& expected) {
  EXPECT_LT((found - expected).length(), btScalar(1e-5)) << found.x() << " " << found.y() << " " << found.z();
}

TEST(Figure, BonesAreWhereTheMotionPutsThem) {
  Reading reading;
  SKIP_WITHOUT_ASSIMP(reading);
  const command::Scene scene = reading.scene(figureScene());
  ASSERT_EQ(scene.figures.size(), 1u);
  ASSERT_EQ(scene.colliders.size(), 2u);  // the upper arm and the forearm
  const btVector3 elbow(1, 0, 0);         // seen from the shoulder
  expectNear(scene.colliders[0].at(0) * elbow, btVector3(1, 2, 0));
  expectNear(scene.colliders[0].at(1) * elbow, btVector3(0, 3, 0));
  expectNear(scene.colliders[1].at(1) * elbow, btVector3(-1, 3, 0));  // the hand: the elbow has turned, too
  const btScalar half = std::sqrt(btScalar(0.5));
  expectNear(scene.colliders[0].at(0.5) * elbow, btVector3(half, 2 + half, 0));
  expectNear(scene.colliders[0].at(9) * elbow, btVector3(0, 3, 0));  // it stands still afterwards
}

TEST(Figure, IsScaledTurnedAndMovedAndGoesItsWay) {
  Reading reading;
  SKIP_WITHOUT_ASSIMP(reading);
  Json json = figureScene();
  json["figures"][0].update({{"scale", 0.5}, {"rotation_deg", {0, 90, 0}}, {"translation_m", {0, 0, 3}}});
  const btVector3 elbow(btScalar(0.5), 0, 0);
  expectNear(reading.scene(json).colliders[0].at(0) * elbow, btVector3(0, 1, btScalar(2.5)));
  json["figures"][0]["path"] = {{"times_s", {0, 1}}, {"offsets_m", {{0, 0, 0}, {4, 0, 0}}}};
  expectNear(reading.scene(json).colliders[0].at(1) * elbow, btVector3(4, btScalar(1.5), 3));
}

TEST(Figure, BulletKnowsHowFastItGoes) {
  Reading reading;
  SKIP_WITHOUT_ASSIMP(reading);
  const command::Scene scene = reading.scene(figureScene());
  command::SceneWorld world(scene);
  world.step();
  const auto& body = *btRigidBody::upcast(world.colliders()[0]);
  // A quarter turn in a second. Bullet tells it from two turns 1/240 s apart: float32 rounds them to 1e-7, and the arc
  // cosine of 1 - 1e-5 by a hundred times that.
  EXPECT_NEAR(static_cast<double>(body.getAngularVelocity().z()), SIMD_HALF_PI, 3e-3);
}

TEST(Figure, PartsAreHullsOfSpheres) {
  Reading reading;
  SKIP_WITHOUT_ASSIMP(reading);
  Json json = figureScene();
  json["figures"][0]["parts"] = {
      {{"joint", "Elbow"},
       {"spheres", {{{"centre_m", {0, 0, 0}}, {"radius_m", 0.2}}, {{"centre_m", {1, 0, 0}}, {"radius_m", 0.1}}}}}};
  const command::Scene scene = reading.scene(json);
  ASSERT_EQ(scene.colliders.size(), 1u);
  for (const btVector3& point : scene.colliders[0].as<command::Hull>()->points) {
    const btScalar one = point.length() - btScalar(0.2);
    const btScalar other = (point - btVector3(1, 0, 0)).length() - btScalar(0.1);
    EXPECT_NEAR(static_cast<double>(std::min(btFabs(one), btFabs(other))), 0, 1e-5);
    EXPECT_GE(std::min(one, other), btScalar(-1e-5));
  }
}

// As much on each piece as its surface is large.
TEST(Figure, SkinIsWetAllOver) {
  Reading reading;
  SKIP_WITHOUT_ASSIMP(reading);
  Json json = figureScene();
  json["figures"][0]["name"] = "arm";
  json["cloths"][0]["effects"]["contact_wetting"]["films"] = {{{"figure", "arm"}, {"water_kg_m2", 0.25}}};
  const command::Scene scene = reading.scene(json);
  const command::SceneWorld world(scene);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(world.filmOn(i), 0.25 * command::areaOf(scene.colliders[i]), 1e-12);
    // Round bones of 1 m: 2 pi r l and a ball's 4 pi r^2, less what a polyhedron lacks.
    EXPECT_NEAR(command::areaOf(scene.colliders[i]), SIMD_2_PI * 0.1 * 1.2, 0.04);
  }
  json["cloths"][0]["effects"]["contact_wetting"]["films"][0]["figure"] = "leg";
  EXPECT_NE(reading.complaint(json).find("/films/0/figure"), std::string::npos);
  json["cloths"][0]["effects"]["contact_wetting"]["films"] = {{{"figure", "arm"}, {"water_kg_m2", -1}}};
  EXPECT_NE(reading.complaint(json).find("/films/0/water_kg_m2"), std::string::npos);
  json["cloths"][0]["effects"]["contact_wetting"]["films"] = {{{"figure", "arm"}, {"water_kg_m2", 1}},
                                                              {{"collider", 1}, {"water_kg", 1}}};
  EXPECT_NE(reading.complaint(json).find("/films/1/collider"), std::string::npos);
}

TEST(Figure, BadOnesAreNamed) {
  Reading reading;
  SKIP_WITHOUT_ASSIMP(reading);
  const auto expectNames = [](const std::string& complaint, const std::vector<std::string>& words) {
    for (const std::string& word : words) EXPECT_NE(complaint.find(word), std::string::npos) << complaint;
    EXPECT_EQ(complaint.find('\n'), std::string::npos) << complaint;
  };
  const std::string whole = arm;
  expectNames(reading.complaint(figureScene(), whole.substr(0, whole.size() - 12)), {"/figures/0/motion"});
  expectNames(reading.complaint(figureScene(), whole.substr(0, 60)), {"/figures/0/motion"});
  std::string broken = whole;
  broken.replace(broken.rfind("90 0 0 90"), 2, "na");
  expectNames(reading.complaint(figureScene(), broken), {"/figures/0/motion"});
  std::string infinite = whole;
  infinite.replace(infinite.rfind("0 2 0 90"), 1, "1e30");
  expectNames(reading.complaint(figureScene(), infinite), {"/figures/0/motion", "Shoulder", "frame 1"});
  for (const char* const time : {"0", "-1", "nan", "1e-300"}) {
    std::string timed = whole;
    timed.replace(timed.find("Time: 1") + 6, 1, time);
    expectNames(reading.complaint(figureScene(), timed), {"/figures/0/motion", "the time of a frame"});
  }
  for (const char* const count : {"-7", "0", "4294967290", "100000000", "1e3", "x", "99999999999999999999"}) {
    std::string counted = whole;
    counted.replace(counted.find("Frames: ") + 8, 1, count);
    expectNames(reading.complaint(figureScene(), counted),
                {"/figures/0/motion", std::string("\"Frames: ") + count + '"', "1 to 1000000"});
  }
  for (const char* const offset : {"1e60", "nan", "1e7"}) {
    std::string far = whole;
    far.replace(far.rfind("OFFSET 1") + 7, 1, offset);
    expectNames(reading.complaint(figureScene(), far), {"/figures/0/motion", "Elbow", "the end of its bone"});
  }
  Json json = figureScene();
  json["figures"][0]["motion"] = "missing.bvh";
  expectNames(reading.complaint(json), {"/figures/0/motion", "no such file"});
  json = figureScene();
  json["figures"][0]["parts"] = {{{"joint", "Elbw"}, {"spheres", {{{"centre_m", {0, 0, 0}}, {"radius_m", 1}}}}}};
  expectNames(reading.complaint(json), {"/figures/0/parts/0/joint", "\"Elbow\""});
  json["figures"][0]["parts"][0]["joint"] = "Elbow";
  json["figures"][0]["parts"][0]["spheres"] = Json::array();
  expectNames(reading.complaint(json), {"/figures/0/parts/0/spheres", "at least one"});
  json = figureScene();
  json["figures"][0]["bone_radius_m"] = -1;
  expectNames(reading.complaint(json), {"/figures/0/bone_radius_m", "> 0"});
}

}  // namespace
}  // namespace wetcloth_test::figure_test
