// SPDX-License-Identifier: Zlib
// Meshes as people have them, through the command: each file of tests/data/meshes went wrong once.

#include "tests/command/Command.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <tuple>
#include <utility>

namespace wetcloth_test::command_meshes_test {
namespace {

using namespace cli;

const std::string kMeshes = WETCLOTH_SOURCE_DIR "/tests/data/meshes/";

std::string textOf(const std::string& name) {
  std::ifstream stream(kMeshes + name, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// A cloth of this file, without gravity, full of water.
Json floating(const Json& obj, double duration = 0.05) {
  return {{"world", "soft_rigid"},
          {"gravity_m_s2", {0, 0, 0}},
          {"duration_s", duration},
          {"cloths", {{{"obj", obj}, {"fabric", "cotton"}, {"initial_saturation", 1}, {"effects", Json::object()}}}}};
}

/// Runs a scene with an OBJ of this text beside it.
Json runText(const std::string& obj, const std::function<void(Json&)>& change = {}) {
  const TemporaryDirectory directory;
  directory.write("mesh.obj", obj);
  Json scene = floating("mesh.obj");
  if (change) change(scene);
  return runScene(directory.write("scene.json", scene.dump()));
}

Outcome validateText(const std::string& obj) {
  const TemporaryDirectory directory;
  directory.write("mesh.obj", obj);
  return runWetcloth({"validate", directory.write("scene.json", floating("mesh.obj").dump())});
}

double held(const Json& result) { return result.at("ledger").at("held").get<double>(); }

double waterOfSquareMetre() {
  static const double water = held(runText("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"));
  return water;
}

/// The area of a cloth [m^2], by its water.
double areaOf(const std::string& obj) { return held(runText(obj)) / waterOfSquareMetre(); }

double heightOf(const Json& result) { return result.at("centre_of_mass").at(1).get<double>(); }

TEST(Meshes, CornersWithVerticesOfTheirOwnAreOneCloth) {
  const TemporaryDirectory directory;
  const Json pins = {{"box", {{"centre_m", {0, 1.6, 0}}, {"half_extents_m", {10, 0.001, 10}}}}};
  double heights[3];
  int k = 0;
  for (const char* name : {"welded.obj", "seam.obj", "soup.obj"}) {
    directory.write(name, textOf(name));
    Json scene = readJson(kMeshes + "seam.json");
    scene["cloths"][0]["obj"] = name;
    scene["cloths"][0]["pins"] = pins;
    const Json result = runScene(directory.write("scene.json", scene.dump()));
    EXPECT_EQ(result.at("nodes"), 49) << name;
    heights[k++] = heightOf(result);
  }
  EXPECT_NEAR(heights[1], heights[0], 0.01);
  EXPECT_NEAR(heights[2], heights[0], 0.01);
}

TEST(Meshes, PinsByNumberAreTheFilesVertices) {
  for (const char* name : {"seam", "soup"}) EXPECT_GT(heightOf(runScene(kMeshes + name + ".json")), 1) << name;
}

TEST(Meshes, SayWhatWasJoined) {
  const Outcome outcome = runWetcloth({"validate", kMeshes + "seam.json"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.err.find("/cloths/0/obj: 7 vertices are in the place of another (within "), std::string::npos)
      << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1);
}

TEST(Meshes, AConcavePolygonHasItsArea) {
  EXPECT_NEAR(areaOf(textOf("bad_start.obj")), 0.3, 1e-5);
  EXPECT_NEAR(areaOf(textOf("ell.obj")), 3, 1e-5);
}

TEST(Meshes, APolygonHasTheSameAreaWhicheverCornerComesFirst) {
  // A star of five points, and an ell bent along an edge; turned both ways.
  const std::string star =
      "v 0 1 0\nv 0.1 0.3 0\nv 1 0.3 0\nv 0.3 0 0\nv 0.6 -1 0\nv 0 -0.3 0\nv -0.6 -1 0\nv -0.3 0 0\nv -1 0.3 0\n"
      "v -0.1 0.3 0\n";
  const std::string bent = "v 2 0 0\nv 2 1 0.1\nv 1 1 0\nv 1 2 -0.2\nv 0 2 0\nv 0 0 0.1\n";
  for (const auto& [vertices, count] : {std::pair{star, 10}, {bent, 6}}) {
    double first = 0;
    for (int start = 0; start < count; ++start) {
      for (const int way : {1, -1}) {
        std::string face = "f";
        for (int i = 0; i < count; ++i) face += " " + std::to_string((start + way * i + 2 * count) % count + 1);
        const double area = areaOf(vertices + face + "\n");
        if (first == 0) first = area;
        EXPECT_NEAR(area, first, 1e-5 * first) << face;
      }
    }
  }
}

TEST(Meshes, APolygonWithCornersInALineHasThemAll) {
  EXPECT_NEAR(areaOf("v 0 0 0\nv 1 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4 5 6\n"), 2, 1e-5);
}

TEST(Meshes, AFaceThatIsThereTwiceIsOneLayerWithBending) {
  const std::string once = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n";
  const Json single = runText(once);
  const Json twice = runText(once + "f 3 2 1\nf 4 3 1\n");
  EXPECT_EQ(single.at("links"), 6);
  EXPECT_EQ(twice.at("links"), 6);
  EXPECT_DOUBLE_EQ(held(twice), held(single));
  const Json welded = runScene(kMeshes + "double.json");
  EXPECT_LT(heightOf(welded), 2);
}

TEST(Meshes, AnEdgeOfThreeFacesKeepsItsBending) {
  const Json result = runText("v 0 0 0\nv 0 1 0\nv 1 0 0\nv -1 0 0.1\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 1 2 5\n");
  EXPECT_EQ(result.at("links"), 7 + 3);  // edges, and each pair of the three faces
}

TEST(Meshes, SeveralPartsRunInEveryWorldAndAreTold) {
  const std::string apart = "it is in 2 pieces that nothing joins";
  for (const auto& [name, words] :
       {std::pair{"two_panels_deformable", apart},
        {"two_panels_vfss", apart},
        {"bow_tie_deformable", std::string("1 part hangs on by a vertex, not by an edge")}}) {
    const std::string file = kMeshes + name + ".json";
    const Outcome validated = runWetcloth({"validate", file});
    EXPECT_EQ(validated.status, 0) << validated.err;
    EXPECT_EQ(validated.err, file + ": /cloths/0/obj: " + words + "\n");
    EXPECT_GT(runScene(file).at("steps"), 0) << name;
  }
}

TEST(Meshes, AreTalkedOfInValidateAsInRun) {
  for (const auto& entry : std::filesystem::directory_iterator(kMeshes)) {
    const std::string file = entry.path().string();
    if (entry.path().extension() != ".json") continue;
    const Outcome run = runWetcloth({"run", file, "--duration", "0.02", "--json", "-"});
    EXPECT_EQ(run.status, 0) << file;
    EXPECT_EQ(runWetcloth({"validate", file}).err, run.err) << file;
  }
}

TEST(Meshes, LinesMayGoOnEndWithCarriageReturnsAndBeginWithAMark) {
  EXPECT_NEAR(areaOf(textOf("continued_lines.obj")), 1, 1e-5);
  const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
  std::string mac = square, windows;
  for (char& c : mac) c = c == '\n' ? '\r' : c;
  for (const char c : square) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_NEAR(areaOf(mac), 1, 1e-5);
  EXPECT_NEAR(areaOf(windows), 1, 1e-5);
  EXPECT_NEAR(areaOf("\xEF\xBB\xBF" + square), 1, 1e-5);
  EXPECT_NEAR(areaOf("# C:\\meshes\\\n" + square), 1, 1e-5);
  const Outcome wrong = validateText("v 0 0 0\nv 1 \\\n 0 0\nv 1 1 zero\nf 1 2 3\n");
  expectRefusal(wrong, {"line 4", "\"zero\""});
}

TEST(Meshes, AreScaledTurnedAndMoved) {
  const std::string square = "v 0 0 0\nv 1000 0 0\nv 1000 1000 0\nv 0 1000 0\nf 1 2 3 4\n";
  const Json result = runText(square, [](Json& scene) {
    scene["cloths"][0]["obj"] = {
        {"file", "mesh.obj"}, {"scale", 0.002}, {"rotation_deg", {90, 0, 0}}, {"translation_m", {10, 20, 30}}};
  });
  EXPECT_NEAR(held(result), 4 * waterOfSquareMetre(), 1e-5);
  const double centre[] = {11, 20, 31};
  for (std::size_t axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(result["centre_of_mass"][axis].get<double>(), centre[axis], 1e-4);
}

TEST(Meshes, APlaceThatIsNotAllowedIsRefused) {
  const TemporaryDirectory directory;
  directory.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
  for (const auto& [key, value, words] :
       std::vector<std::tuple<std::string, Json, std::string>>{{"scale", 0, "> 0"},
                                                               {"scale", -1, "> 0"},
                                                               {"rotation_deg", {1, 2}, "three numbers"},
                                                               {"sclae", 1, "\"scale\""}}) {
    Json scene = floating({{"file", "mesh.obj"}, {key, value}});
    expectRefusal(runWetcloth({"validate", directory.write("scene.json", scene.dump())}),
                  {"/cloths/0/obj/" + key, value.dump(), words});
  }
  Json scene = floating({{"scale", 2}});
  expectRefusal(runWetcloth({"validate", directory.write("scene.json", scene.dump())}),
                {"/cloths/0/obj", "\"file\" is missing"});
}

Json hanging(const Json& pins) {
  Json scene = floating("mesh.obj", 1);
  scene["gravity_m_s2"] = {0, -9.81, 0};
  scene["cloths"][0]["pins"] = pins;
  return scene;
}

TEST(Meshes, ArePinnedByBoxSphereAndGroup) {
  const TemporaryDirectory directory;
  directory.write("mesh.obj",
                  "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 2 0\nv 0 2 0\ng low\nf 1 2 3 4\ng high edge\nf 4 3 5 6\n");
  const auto heightWith = [&](const Json& pins) {
    return heightOf(runScene(directory.write("scene.json", hanging(pins).dump())));
  };
  EXPECT_GT(heightWith({{"box", {{"centre_m", {0.5, 2, 0}}, {"half_extents_m", {1, 0.1, 0.1}}}}}), 0.5);
  EXPECT_GT(heightWith({{"sphere", {{"centre_m", {0, 2, 0}}, {"radius_m", 0.1}}}}), -1);
  EXPECT_GT(heightWith({{"group", "edge"}}), 0.5);
  EXPECT_LT(heightWith(Json::object()), -1);
  const auto refusal = [&](const Json& pins) {
    return runWetcloth({"validate", directory.write("scene.json", hanging(pins).dump())});
  };
  expectRefusal(refusal({{"group", "hihg"}}), {"/cloths/0/pins/group", "\"hihg\"", "\"high\"", "edge, high, low"});
  expectRefusal(refusal({{"sphere", {{"centre_m", {9, 2, 0}}, {"radius_m", 0.1}}}}),
                {"/cloths/0/pins/sphere", "pins nothing"});
  expectRefusal(refusal({{"edges", {"top"}}}), {"/cloths/0/pins/edges", "group"});
}

TEST(Meshes, APatchIsPinnedByBoxToo) {
  Json scene = readJson(kMeshes + "default_springs.json");
  scene["world"] = "soft_rigid";
  scene["cloths"][0]["pins"] = {{"box", {{"centre_m", {0, 1.5, 0}}, {"half_extents_m", {1, 0.01, 0.01}}}}};
  EXPECT_NEAR(heightOf(runScene(scene)), 0.9, 0.02);
  scene["cloths"][0]["pins"] = {{"group", "top"}};
  const TemporaryDirectory directory;
  expectRefusal(runWetcloth({"validate", directory.write("scene.json", scene.dump())}),
                {"/pins/group", "\"top\"", "OBJ"});
}

TEST(Meshes, AllVerticesOfNoFaceAreNamedAtOnce) {
  std::string obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n";
  for (int i = 0; i < 121; ++i) obj += "v " + std::to_string(i) + " 5 0\n";
  expectRefusal(validateText(obj), {"vertices 4 to 124", "faces"});
}

TEST(Meshes, ASizeThatIsHardlyMeantIsHinted) {
  const auto hintFor = [](double size) {
    const std::string s = std::to_string(size);
    const Outcome outcome = validateText("v 0 0 0\nv " + s + " 0 0\nv 0 " + s + " 0\nf 1 2 3\n");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.err;
  };
  EXPECT_EQ(hintFor(1), "");
  EXPECT_NE(hintFor(600).find("/cloths/0/obj: the cloth is 849 m across: are its lengths metres?"), std::string::npos);
  EXPECT_NE(hintFor(0.002).find("across"), std::string::npos);
}

TEST(Meshes, AnInputThatNeverEndsIsCut) {
  if (!std::filesystem::exists("/dev/zero")) GTEST_SKIP() << "this system has no /dev/zero";
  expectRefusal(runWetcloth({"validate", "/dev/zero"}), {"/dev/zero", "longer than 256 MB"});
  const TemporaryDirectory directory;
  const std::string scene = directory.write("scene.json", floating("/dev/zero").dump());
  expectRefusal(runWetcloth({"validate", scene}), {"/cloths/0/obj", "longer than 256 MB"});
}

TEST(Meshes, KeepTheirTextureCoordinatesThroughExport) {
  const TemporaryDirectory directory;
  directory.write("mesh.obj",
                  "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0.25 0.5\nvt 0.75 0.125\nvt 2 3\nvt 0 1\nvt 0.5 0.0625\n"
                  "f 1/1 2/2 3/3\nf 1/5 3/3 4/4\n");
  const std::string scene = directory.write("scene.json", floating("mesh.obj").dump());
  const std::string out = directory.path("out");
  ASSERT_EQ(runWetcloth({"export", scene, "--format", "obj_pc2", "--out", out}).status, 0);
  std::ifstream stream(out + "/cloth.obj");
  std::ostringstream text;
  text << stream.rdbuf();
  EXPECT_NE(text.str().find("vt 0.25 0.5\nvt 0.75 0.125\nvt 2 3\nvt 0 1\nvt 0.5 0.0625\n"), std::string::npos)
      << text.str();
  EXPECT_NE(text.str().find("f 1/1 2/2 3/3\nf 1/5 3/3 4/4\n"), std::string::npos) << text.str();
  const std::string usd = directory.path("cloth.usda");
  ASSERT_EQ(runWetcloth({"export", scene, "--format", "usda", "--out", usd}).status, 0);
  std::ifstream usdStream(usd);
  std::ostringstream usdText;
  usdText << usdStream.rdbuf();
  EXPECT_NE(usdText.str().find("faceVarying"), std::string::npos);
  EXPECT_NE(usdText.str().find("(0.75, 0.125)"), std::string::npos);
}

}  // namespace
}  // namespace wetcloth_test::command_meshes_test
