// SPDX-License-Identifier: Zlib
// A figure whose skin and motion are in one glTF file.

#include "command/scene/SceneReader.h"
#include "tests/command/Command.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

namespace wetcloth_test::skinned_figure_test {
namespace {

using namespace cli;

/// A glTF file with its numbers beside it, of an arm: two bones of 1 m along x, 2 m high, each in a square bar of skin
/// that is 0.2 m thick. The shoulder turns by 90 degrees about z in 1 s, and so does the elbow.
class ArmFile {
 public:
  ArmFile() {
    add("SCALAR", std::vector<float>{0, 1});                                              // times
    add("VEC4", std::vector<float>{0, 0, 0, 1, 0, 0, std::sqrt(0.5F), std::sqrt(0.5F)});  // turns
    add("MAT4", std::vector<float>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0,  -2, 0, 1,    // from the skin to the shoulder
                                   1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, -2, 0, 1});  // and to the elbow
    addBars();
  }

  Json description() const {
    Json json = {{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"accessors", m_accessors}, {"bufferViews", m_views}};
    json["scenes"] = {{{"nodes", {0, 2}}}};
    json["nodes"] = {{{"name", "Shoulder"}, {"translation", {0, 2, 0}}, {"children", {1}}},
                     {{"name", "Elbow"}, {"translation", {1, 0, 0}}},
                     {{"name", "Skin"}, {"mesh", 0}, {"skin", 0}}};
    json["skins"] = {{{"joints", {0, 1}}, {"inverseBindMatrices", 2}, {"skeleton", 0}}};
    json["meshes"] = {
        {{"primitives", {{{"attributes", {{"POSITION", 3}, {"JOINTS_0", 4}, {"WEIGHTS_0", 5}}}, {"indices", 6}}}}}};
    const auto channel = [](int node) {
      return Json{{"sampler", 0}, {"target", {{"node", node}, {"path", "rotation"}}}};
    };
    json["animations"] = {{{"samplers", {{{"input", 0}, {"output", 1}}}}, {"channels", {channel(0), channel(1)}}}};
    json["buffers"] = {{{"uri", "arm.bin"}, {"byteLength", m_bytes.size()}}};
    return json;
  }

  std::string bytes() const { return m_bytes; }

  /// Both turns at the second time are this in x.
  void spoil(float value) { std::memcpy(&m_bytes[2 * sizeof(float) + 4 * sizeof(float)], &value, sizeof value); }

 private:
  template <class T>
  void add(const char* type, const std::vector<T>& values) {
    const std::string kind = type;
    const std::size_t width = kind == "SCALAR" ? 1 : kind == "VEC3" ? 3 : kind == "VEC4" ? 4 : 16;
    const int component = sizeof(T) == 4 ? 5126 : 5123;  // float, unsigned short
    m_views.push_back({{"buffer", 0}, {"byteOffset", m_bytes.size()}, {"byteLength", values.size() * sizeof(T)}});
    Json accessor = {
        {"bufferView", m_views.size() - 1}, {"componentType", component}, {"count", values.size() / width}};
    accessor["type"] = type;
    if (kind == "VEC3") accessor.update({{"min", {0, 1.9, -0.1}}, {"max", {2, 2.1, 0.1}}});
    if (kind == "SCALAR" && component == 5126) accessor.update({{"min", {0}}, {"max", {1}}});
    m_accessors.push_back(accessor);
    m_bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
  }

  void addBars() {
    std::vector<float> places, weights;
    std::vector<std::uint16_t> joints, corners;
    for (std::uint16_t bone = 0; bone < 2; ++bone) {
      for (int corner = 0; corner < 8; ++corner) {
        const float x = static_cast<float>(bone + (corner & 1)), y = (corner & 2) != 0 ? 2.1F : 1.9F;
        places.insert(places.end(), {x, y, (corner & 4) != 0 ? 0.1F : -0.1F});
        joints.insert(joints.end(), {bone, 0, 0, 0});
        weights.insert(weights.end(), {1, 0, 0, 0});
      }
      for (const int corner : {0, 1, 2, 1, 3, 2, 4, 6, 5, 5, 6, 7, 0, 4, 1, 1, 4, 5,
                               2, 3, 6, 3, 7, 6, 0, 2, 4, 2, 6, 4, 1, 5, 3, 3, 5, 7}) {
        corners.push_back(static_cast<std::uint16_t>(8 * bone + corner));
      }
    }
    add("VEC3", places);
    add("VEC4", joints);
    add("VEC4", weights);
    add("SCALAR", corners);
  }

  std::string m_bytes;
  Json m_accessors = Json::array(), m_views = Json::array();
};

class Reading {
 public:
  command::Scene scene(const ArmFile& arm) { return scene(arm.description().dump(), arm.bytes()); }

  command::Scene scene(const std::string& description, const std::string& bytes) {
    Json json = smallScene();
    json["precision"] = testedPrecision();
    json.erase("colliders");
    json["figures"] = {{{"motion", "arm.gltf"}}};
    m_directory.write("arm.gltf", description);
    m_directory.write("arm.bin", bytes);
    return command::readScene(m_directory.write("scene.json", json.dump()));
  }

  std::string complaint(const std::string& description, const std::string& bytes) {
    try {
      scene(description, bytes);
    } catch (const std::exception& error) {
      return error.what();
    }
    return "";
  }

  bool isWithoutAssimp() {
    return complaint(ArmFile().description().dump(), ArmFile().bytes()).find("built without it") != std::string::npos;
  }

 private:
  TemporaryDirectory m_directory;
};

#define SKIP_WITHOUT_ASSIMP(reading) \
  if ((reading).isWithoutAssimp()) GTEST_SKIP() << "without assimp (Debian: libassimp-dev)"

void expectBox(const command::Collider& part, double time, const btVector3& low, const btVector3& high) {
  btVector3 least(BT_LARGE_FLOAT, BT_LARGE_FLOAT, BT_LARGE_FLOAT), most = -least;
  for (const btVector3& point : part.as<command::Hull>()->points) {
    least.setMin(part.at(time) * point);
    most.setMax(part.at(time) * point);
  }
  EXPECT_LT((least - low).length(), btScalar(1e-5)) << least.x() << " " << least.y() << " " << least.z();
  EXPECT_LT((most - high).length(), btScalar(1e-5)) << most.x() << " " << most.y() << " " << most.z();
}

TEST(SkinnedFigure, ItsSkinGoesWithTheBones) {
  Reading reading;
  SKIP_WITHOUT_ASSIMP(reading);
  const command::Scene scene = reading.scene(ArmFile());
  ASSERT_EQ(scene.colliders.size(), 2u);
  const auto v = [](double x, double y, double z) { return btVector3(btScalar(x), btScalar(y), btScalar(z)); };
  expectBox(scene.colliders[0], 0, v(0, 1.9, -0.1), v(1, 2.1, 0.1));
  expectBox(scene.colliders[1], 0, v(1, 1.9, -0.1), v(2, 2.1, 0.1));
  expectBox(scene.colliders[0], 1, v(-0.1, 2, -0.1), v(0.1, 3, 0.1));  // the upper arm stands upright
  expectBox(scene.colliders[1], 1, v(-1, 2.9, -0.1), v(0, 3.1, 0.1));  // the forearm points backwards
  const btScalar half = std::sqrt(btScalar(0.5));
  const btVector3 elbow = scene.colliders[0].at(0.5) * btVector3(1, 0, 0);  // halfway it stands at 45 degrees
  EXPECT_LT((elbow - btVector3(half, 2 + half, 0)).length(), btScalar(1e-5));
}

TEST(SkinnedFigure, BadFilesAreNamed) {
  Reading reading;
  SKIP_WITHOUT_ASSIMP(reading);
  const ArmFile arm;
  const std::string description = arm.description().dump();
  const auto expectNames = [](const std::string& complaint, const std::vector<std::string>& words) {
    for (const std::string& word : words) EXPECT_NE(complaint.find(word), std::string::npos) << complaint;
    EXPECT_EQ(complaint.find('\n'), std::string::npos) << complaint;
  };
  expectNames(reading.complaint(description.substr(0, description.size() / 2), arm.bytes()), {"/figures/0/motion"});
  expectNames(reading.complaint(description, arm.bytes().substr(0, 100)), {"/figures/0/motion"});
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    ArmFile spoilt;
    spoilt.spoil(bad);
    expectNames(reading.complaint(description, spoilt.bytes()), {"/figures/0/motion", "Elbow", "frame 1:"});
  }
  // It may be left out, and assimp 5.2 reads from nowhere then: what it crashes must not be this process.
  Json withoutMatrices = arm.description();
  withoutMatrices["skins"][0].erase("inverseBindMatrices");
  const std::string complaint = reading.complaint(withoutMatrices.dump(), arm.bytes());
  if (!complaint.empty()) expectNames(complaint, {"/figures/0/motion", "assimp", "crashes"});
  // assimp takes it for OpenGEX, whatever its name, finds nothing in it and does not complain.
  expectNames(reading.complaint("{\"a\":\"geometrynode\"}", arm.bytes()), {"/figures/0/motion", "no joints"});
  // Of other formats that assimp knows, a few bytes may take it minutes.
  const std::string ply = "ply\nformat ascii 1.0\nelement vertex 30000000\nend_header\n";
  expectNames(reading.complaint(ply, arm.bytes()), {"/figures/0/motion", "neither BVH nor glTF"});
  const std::string glb = std::string("glTF\2\0\0\0\0\x28\x6b\xee", 12) + "more";
  expectNames(reading.complaint(glb, arm.bytes()), {"/figures/0/motion", "cut off", "4000000000 bytes"});
  Json still = arm.description();
  still.erase("animations");
  expectNames(reading.complaint(still.dump(), arm.bytes()), {"/figures/0/motion", "no animation"});
}

}  // namespace
}  // namespace wetcloth_test::skinned_figure_test
