// SPDX-License-Identifier: Zlib
// The figures and garments that go with the scenes: what a scene that names them gets.

#include "command/scene/SceneReader.h"
#include "tests/command/Command.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <map>
#include <string>
#include <utility>
#include <variant>

namespace wetcloth_test::shipped_garments_test {
namespace {

using namespace cli;

const std::string scenes = WETCLOTH_SOURCE_DIR "/examples/scenes/";

command::TriangleMesh sewnMesh(const std::string& garment) {
  Json scene = smallScene();
  scene["precision"] = testedPrecision();
  scene["cloths"] = {{{"garment", scenes + "garments/" + garment}, {"fabric", "cotton"}}};
  const TemporaryDirectory directory;
  return std::get<command::TriangleMesh>(
      command::readScene(directory.write("scene.json", scene.dump())).cloths[0].shape);
}

TEST(ShippedGarments, AreOnePieceOfAbout5000Nodes) {
  for (const char* garment : {"tshirt.json", "bathrobe.json"}) {
    const command::TriangleMesh mesh = sewnMesh(garment);
    EXPECT_NEAR(double(mesh.vertices.size()), 5000, 500) << garment;
    std::map<std::pair<int, int>, int> facesAt;
    for (const auto& corners : mesh.triangles) {
      for (std::size_t k = 0; k < 3; ++k) ++facesAt[std::minmax(corners[k], corners[(k + 1) % 3])];
    }
    int most = 0;
    for (const auto& [edge, faces] : facesAt) most = std::max(most, faces);
    EXPECT_EQ(most, 2) << garment << ": a seam joins two edges, no more";
  }
}

TEST(ShippedFigures, AllMotionsMoveAllParts) {
  for (const char* motion : {"walk", "stand", "turn", "crouch", "arms_pressed"}) {
    Json json = smallScene();
    json["precision"] = testedPrecision();
    json.erase("colliders");
    json["figures"] = {{{"motion", scenes + "figures/" + motion + ".bvh"}, {"parts", scenes + "figures/person.json"}}};
    const TemporaryDirectory directory;
    const std::string file = directory.write("scene.json", json.dump());
    command::Scene scene;
    try {
      scene = command::readScene(file);
    } catch (const std::exception& error) {
      if (std::string(error.what()).find("built without it") != std::string::npos) GTEST_SKIP() << error.what();
      throw;
    }
    EXPECT_GT(scene.colliders.size(), 10u);
    for (const command::Collider& part : scene.colliders) {
      for (const double time : {0.0, 1.0, 2.0}) {
        for (const btVector3& point : part.as<command::Hull>()->points) {
          const btVector3 place = part.at(time) * point;
          EXPECT_GT(place.y(), btScalar(-0.03)) << motion << ": below the ground";
          EXPECT_LT(place.length(), btScalar(2)) << motion << ": away from where it stands";
        }
      }
    }
  }
}

}  // namespace
}  // namespace wetcloth_test::shipped_garments_test
