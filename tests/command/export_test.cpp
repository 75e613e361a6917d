// SPDX-License-Identifier: Zlib
#include "tests/command/Command.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

namespace wetcloth_test::export_test {
namespace {

using namespace cli;
namespace fs = std::filesystem;

std::string bytesOf(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

template <class Number>
Number numberAt(const std::string& bytes, std::size_t at) {
  Number number;
  std::memcpy(&number, bytes.data() + at, sizeof number);
  return number;
}

std::vector<std::string> namesIn(const std::string& directory) {
  std::set<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(directory)) {
    names.insert(entry.path().filename().string());
  }
  return {names.begin(), names.end()};
}

/// Exports a scene, which must succeed; returns what the command says.
Json exported(const TemporaryDirectory& directory, const Json& scene, const std::string& format, const std::string& out,
              const std::vector<std::string>& more = {}) {
  std::vector<std::string> words{
      "export", directory.write("scene.json", scene.dump()), "--format", format, "--out", directory.path(out), "--json",
      "-"};
  words.insert(words.end(), more.begin(), more.end());
  const Outcome outcome = runWetcloth(words);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return outcome.status == 0 ? Json::parse(outcome.out) : Json();
}

Json namedScene(const std::vector<std::string>& names) {
  Json scene = smallScene();
  const Json cloth = scene["cloths"][0];
  scene["cloths"] = Json::array();
  for (const std::string& name : names) {
    scene["cloths"].push_back(cloth);
    scene["cloths"].back()["name"] = name;
  }
  return scene;
}

TEST(Export, FramesAreEvenlySpacedFromTheStartToTheEnd) {
  const TemporaryDirectory directory;
  const Json said = exported(directory, smallScene(), "ply", "ply", {"--fps", "20"});  // every third step of 1/60 s
  EXPECT_EQ(said.at("frames"), 3);
  EXPECT_NEAR(said.at("end_s").get<double>(), 0.1, 1e-9);
  EXPECT_EQ(namesIn(directory.path("ply")),
            (std::vector<std::string>{"cloth_0000.ply", "cloth_0001.ply", "cloth_0002.ply"}));
}

TEST(Export, AFrameBetweenTwoStepsIsMixedOfBoth) {
  const TemporaryDirectory directory;
  exported(directory, smallScene(), "obj_pc2", "coarse", {"--fps", "60"});
  exported(directory, smallScene(), "obj_pc2", "fine", {"--fps", "120"});
  const std::string coarse = bytesOf(directory.path("coarse/cloth.pc2"));
  const std::string fine = bytesOf(directory.path("fine/cloth.pc2"));
  constexpr std::size_t height = 32 + 4;  // of the first node
  constexpr std::size_t frame = std::size_t{20} * 12;
  const float first = numberAt<float>(coarse, height + 4 * frame);
  const float second = numberAt<float>(coarse, height + 5 * frame);
  ASSERT_GT(first - second, 1e-3F);
  EXPECT_EQ(numberAt<float>(fine, height + 8 * frame), first);
  EXPECT_NEAR(numberAt<float>(fine, height + 9 * frame), (first + second) / 2, 1e-6F);
}

TEST(Export, PointCacheHasItsHeaderAndAllFrames) {
  const TemporaryDirectory directory;
  const Json said = exported(directory, smallScene(), "obj_pc2", "obj");
  const std::string bytes = bytesOf(directory.path("obj/cloth.pc2"));
  ASSERT_GE(bytes.size(), 32u);
  EXPECT_EQ(bytes.substr(0, 12), std::string("POINTCACHE2") + '\0');
  EXPECT_EQ(numberAt<int>(bytes, 12), 1);
  EXPECT_EQ(numberAt<int>(bytes, 16), 20);
  EXPECT_EQ(numberAt<float>(bytes, 20), 0.0F);
  EXPECT_EQ(numberAt<float>(bytes, 24), 1.0F);
  EXPECT_EQ(numberAt<int>(bytes, 28), said.at("frames").get<int>());
  EXPECT_EQ(bytes.size(), 32 + std::size_t{240} * said.at("frames").get<std::size_t>());
}

TEST(Export, UsdHasAnimatedPointsAndWetness) {
  const TemporaryDirectory directory;
  exported(directory, smallScene(), "usda", "run.usda", {"--fps", "60"});
  const std::string text = bytesOf(directory.path("run.usda"));
  EXPECT_EQ(text.rfind("#usda 1.0\n", 0), 0u);
  for (const char* part :
       {"metersPerUnit = 1", "upAxis = \"Y\"", "timeCodesPerSecond = 60\n", "startTimeCode = 0", "endTimeCode = 6",
        "def Mesh \"cloth\"", "point3f[] points.timeSamples", "float[] primvars:wetness.timeSamples",
        "interpolation = \"vertex\"", "def Mesh \"solid\""}) {
    EXPECT_NE(text.find(part), std::string::npos) << part;
  }
  EXPECT_EQ(std::count(text.begin(), text.end(), '{'), std::count(text.begin(), text.end(), '}'));
  EXPECT_EQ(text.find("nan"), std::string::npos);
}

TEST(Export, UpIsZWhereGravityPullsAlongZ) {
  Json scene = smallScene();
  scene["gravity_m_s2"] = {0, 0, -9.81};
  const TemporaryDirectory directory;
  exported(directory, scene, "usda", "run.usda");
  EXPECT_NE(bytesOf(directory.path("run.usda")).find("upAxis = \"Z\""), std::string::npos);
}

TEST(Export, NamesBecomeIdentifiersAndStayApart) {
  const TemporaryDirectory directory;
  exported(directory, namedScene({"red towel", "Red/Towel", "7", "", "ünï\n\"x", "solid"}), "usda", "run.usda");
  const std::string text = bytesOf(directory.path("run.usda"));
  for (const char* name : {"red_towel", "Red_Towel_2", "_7", "cloth", "__n____x", "solid", "solid_2"}) {
    EXPECT_NE(text.find("def Mesh \"" + std::string(name) + "\""), std::string::npos) << name;
  }
}

TEST(Export, NamesNeverLeaveTheFolder) {
  const TemporaryDirectory directory;
  exported(directory, namedScene({"../../up", "scenery"}), "obj_pc2", "out");
  EXPECT_EQ(namesIn(directory.path("out")), (std::vector<std::string>{"______up.obj", "______up.pc2", "scenery.obj",
                                                                      "scenery_2.obj", "scenery_2.pc2"}));
}

TEST(Export, APageOfAFineClothStaysBelowTwoMegabytes) {
  Json scene = readJson(sceneFile("flag_wind_100"));
  scene.erase("$schema");
  scene["cloths"][0]["patch"]["columns"] = 48;
  scene["cloths"][0]["patch"]["rows"] = 48;
  const TemporaryDirectory directory;
  const Json said = exported(directory, scene, "html", "flag.html", {"--duration", "3.97", "--quality", "draft"});
  EXPECT_EQ(said.at("frames"), 120);
  EXPECT_EQ(said.at("cloths").at(0).at("nodes"), 2304);
  const double size = said.at("files").at(0).at("bytes").get<double>();
  std::printf("[ SIZE     ] %.2f MB\n", size / 1e6);
  EXPECT_LT(size, 2e6);
}

TEST(Export, RefusesWhatItDoesNotKnow) {
  const TemporaryDirectory directory;
  const std::string scene = directory.write("scene.json", smallScene().dump());
  const std::string out = directory.path("out");
  expectRefusal(runWetcloth({"export", scene, "--format", "vtl", "--out", out}),
                {"--format = \"vtl\"", "did you mean \"vtk\"?", "obj_pc2", "usda"});
  expectRefusal(runWetcloth({"export", scene, "--format", "usda", "--out", out + ".usd"}), {"--out", ".usda"});
  for (const char* rate : {"0", "-1", "nan", "1e9"}) {
    expectRefusal(runWetcloth({"export", scene, "--format", "ply", "--out", out, "--fps", rate}),
                  {"--fps", "[0.01, 10000]"});
  }
  expectRefusal(runWetcloth({"export", scene, "--format", "ply", "--out", out, "--fps", "10000", "--duration", "3600"}),
                {"frames of 20 nodes are 17.3 GB", "2 GB"});
  EXPECT_EQ(namesIn(directory.path("")), std::vector<std::string>{"scene.json"});
}

TEST(Export, RefusesPlacesThatItCannotHave) {
  const TemporaryDirectory directory;
  const std::string scene = directory.write("scene.json", smallScene().dump());
  fs::create_directory(directory.path("full"));
  directory.write("full/mine.txt", "mine");
  expectRefusal(runWetcloth({"export", scene, "--format", "ply", "--out", directory.path("full")}), {"full", "empty"});
  EXPECT_EQ(bytesOf(directory.path("full/mine.txt")), "mine");
  expectRefusal(runWetcloth({"export", scene, "--format", "ply", "--out", directory.path("none/ply")}),
                {"folder that exists"});
  expectRefusal(runWetcloth({"export", scene, "--format", "ply", "--out", scene}), {"must be a folder, not a file"});
  fs::create_directory(directory.path("x.usda"));
  expectRefusal(runWetcloth({"export", scene, "--format", "usda", "--out", directory.path("x.usda")}),
                {"must be a file, not a folder"});
  expectRefusal(runWetcloth({"export", scene, "--format", "ply", "--out", "/proc/ply"}), {"can be written to"});
}

TEST(Export, AnEmptyFolderIsFilledAndAFileIsReplaced) {
  const TemporaryDirectory directory;
  fs::create_directory(directory.path("ply"));
  exported(directory, smallScene(), "ply", "ply/");
  EXPECT_EQ(namesIn(directory.path("ply")).size(), 4u);
  directory.write("run.usda", "old");
  exported(directory, smallScene(), "usda", "run.usda");
  EXPECT_EQ(bytesOf(directory.path("run.usda")).rfind("#usda", 0), 0u);
}

#ifndef _WIN32
TEST(Export, DoesNotTakeThePlaceOfTheFolderItRunsIn) {
  const TemporaryDirectory directory;
  const std::string scene = directory.write("scene.json", smallScene().dump());
  fs::create_directory(directory.path("here"));
  for (const char* const out : {".", "./", "../here"}) {
    expectRefusal(runProgram({"bash", "-c", "cd \"$0\" && exec \"$@\"", directory.path("here"), WETCLOTH_COMMAND,
                              "export", scene, "--format", "ply", "--out", out, "--precision", testedPrecision()}),
                  {"--out", "the folder that the command runs in"});
  }
  EXPECT_EQ(namesIn(directory.path("")), (std::vector<std::string>{"here", "scene.json"}));
}

TEST(Export, AFullDiskLeavesNothing) {
  const TemporaryDirectory directory;
  const std::string scene = directory.write("scene.json", smallScene().dump());
  const std::vector<std::pair<std::string, std::string>> formats{
      {"ply", "out"}, {"obj_pc2", "out"}, {"vtk", "out"}, {"usda", "out.usda"}, {"html", "out.html"}};
  for (const auto& [format, out] : formats) {
    const Outcome outcome =  // no file may have more than a kilobyte
        runProgram({"bash", "-c", "trap '' XFSZ; ulimit -f 1; exec \"$@\"", "bash", WETCLOTH_COMMAND, "export", scene,
                    "--format", format, "--out", directory.path(out), "--precision", testedPrecision()});
    EXPECT_EQ(outcome.status, 1) << format;
    EXPECT_NE(outcome.err.find("could not be written (File too large)"), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_EQ(namesIn(directory.path("")), std::vector<std::string>{"scene.json"}) << format;
  }
}
#endif

TEST(Export, ARunThatFailsLeavesNothing) {
  Json scene = smallScene();
  scene.erase("colliders");
  scene["gravity_m_s2"] = {0, -1e8, 0};  // 2e8 m in 2 s
  scene["cloths"][0].erase("effects");   // of which air would brake it
  const TemporaryDirectory directory;
  const std::string file = directory.write("scene.json", scene.dump());
  const Outcome outcome = runWetcloth(
      {"export", file, "--format", "ply", "--out", directory.path("ply"), "--precision", "float32", "--duration", "2"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find("m away"), std::string::npos) << outcome.err;
  EXPECT_EQ(namesIn(directory.path("")), std::vector<std::string>{"scene.json"});
}

TEST(RenderPage, ShowsOneRun) {
  const TemporaryDirectory directory;
  const std::string scene = directory.write("scene.json", smallScene().dump());
  const std::string out = directory.path("page.html");
  expectRefusal(runWetcloth({"render", scene, "--out", out, "--compare"}), {"--compare", "page"});
  EXPECT_EQ(runWetcloth({"render", scene, "--out", out}).status, 0);
  EXPECT_EQ(bytesOf(out).rfind("<!DOCTYPE html>", 0), 0u);
}

}  // namespace
}  // namespace wetcloth_test::export_test
